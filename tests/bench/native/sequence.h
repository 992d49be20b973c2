#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "assembly.h"

namespace bench {

/// The steps of a scene one after the other, as a simulator takes them: one problem and one solver for warm steps, new ones for each
/// cold step.
class Sequence {
 public:
  /// The problems must have the same bodies.
  Sequence(std::span<const mlcp_problem* const> steps, const mlcp_settings& settings);

  struct Step {
    double seconds;           // rows cleared and added, masses and momenta set, mask carried over by key, solve
    double error;             // the report's
    double oracle;            // factorization and solve of the final active set, its analysis left out
    std::int32_t outcome;
  };
  /// warm false: every step from nothing. oracle: measured after each step, else 0.
  std::vector<Step> run(bool warm, bool oracle) const;

 private:
  std::vector<Assembly> steps_;
  mlcp_settings settings_;
};

}  // namespace bench
