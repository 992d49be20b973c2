#pragma once
#include <span>
#include <string>
#include <vector>

#include "scenes/handles.h"

/// Problems that break solvers, each with what is known of its answer. On mlcp.h alone.
namespace hard {

using handles::Problem;

enum class Fate {
  solved,
  infeasible,
  unbounded,
  told  ///< so near the border of feasibility that either is right within the tolerance, as long as it is true
};

struct Case {
  Problem problem;
  Fate fate = Fate::solved;
  std::vector<double> v = {};  ///< the velocities; empty: not known in closed form
  double v_accuracy = 1e-12;   ///< of max |v|: what the condition of the problem leaves of 1e-16
};

/// One case, swept over the parameter that makes it hard.
struct Family {
  const char* name;
  const char* parameter;
  std::vector<double> values;
  Case (*make)(double value);
};

/// All of them.
std::span<const Family> families();

std::vector<Family> multibody_families();
std::vector<Family> contact_families();
std::vector<Family> friction_families();
std::vector<Family> impossible_families();
std::vector<Family> matrix_families();

}  // namespace hard
