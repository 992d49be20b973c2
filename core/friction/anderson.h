#pragma once
#include <cstdint>
#include <span>

#include "memory/array.h"

namespace mlcp {

/// Fixed points x = G(x) of independent groups of variables, accelerated after Anderson (1965) in the form of Walker & Ni (2011), with a
/// history of 8. Safeguard: where the residual G(x) − x has grown far beyond the best one so far, the group goes back to its best point,
/// forgets, and takes a damped plain step from there.
class Anderson {
 public:
  explicit Anderson(const Memory& m)
      : weight(m), group_(m), best_x_(m), best_f_(m), last_x_(m), last_f_(m), dx_(m), df_(m) {}

  /// bounds: first variable of each group; the last entry is the number of variables.
  void start(std::span<const std::int32_t> bounds);
  /// Forgets everything of a group.
  void restart(std::size_t group);

  Array<double> weight;  ///< of each variable in the residual's norm, to be set after start

  /// x of one group, of which G(x) − x = f is known, becomes the next point to try.
  void step(std::size_t group, double* x, const double* f);

 private:
  static constexpr std::int32_t depth = 8;
  struct Group {
    std::int32_t first, size;
    std::int32_t kept;       ///< differences in the history, the newest last
    std::int32_t steps;      ///< since the last restart
    std::int32_t idle;       ///< since the best point got much better
    double best, damping;
  };
  void remember(Group& g, const double* x, const double* f);
  void go_back(Group& g, double* x);

  Array<Group> group_;
  Array<double> best_x_, best_f_, last_x_, last_f_;
  Array<double> dx_, df_;  ///< depth columns of a group stand together
};

}  // namespace mlcp
