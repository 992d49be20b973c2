#pragma once
#include <string>
#include <vector>

/// The arrays of dSolveLCP, as DART makes them of a scene: rows of A padded (dPAD), for a contact its normal and, with friction, two tangents
/// whose findex is the normal.
struct Case {
  std::string name;
  int n = 0, nub = 0;
  std::vector<double> A, b, lo, hi;
  std::vector<int> findex;
};

/// Boxes and balls that rest, slide and hang; redundant contacts, mass ratios, degenerate ties, and Fathi's exponential example.
std::vector<Case> all_cases();
