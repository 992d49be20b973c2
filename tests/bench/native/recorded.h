#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "scenes/handles.h"

namespace bench {

/// Which steps of a scene from the gallery: of length h, s; the first one is number `first` from the start.
struct Recording {
  std::string scene;
  std::int32_t size;
  unsigned seed;
  double h;
  std::int32_t first, steps;
};

/// The problems of those steps as the scene made them, contacts with friction and prescribed bodies included.
/// fails: std::runtime_error, the library did not solve one of them.
std::vector<handles::Problem> record(const Recording& which);

/// Plain rows (see PlainRows) over the bodies that move.
handles::Problem plain(const mlcp_problem* problem, std::int32_t facets);

}  // namespace bench
