#pragma once
#include "exact/rational.h"

namespace exact {

/// What is true of a problem.
struct Truth {
  bool feasible = false;
  Numbers gamma;    ///< a solution, where there is one
  Numbers v;        ///< the velocities
  Numbers y;        ///< a Farkas certificate over the enabled rows, where there is none
};

/// The dual active set method (Goldfarb & Idnani 1983) in rational numbers: one violated row at a time, the least index first, ratio test over
/// impulses; a dependent row that nothing blocks is the certificate. Every row that arrives raises the dual objective, so it ends.
/// active: rows (of the problem) to start from, any; a good guess saves time and changes nothing of what is true.
Truth truth(const Reduced& problem, const std::vector<int>& active);

/// "" if `truth` is one, by definition and without the method that found it.
std::string fault(const Reduced& problem, const Truth& truth);

}  // namespace exact
