#pragma once
#include <limits>

#include "hard/cases/case.h"

namespace hard {

constexpr double inf = std::numeric_limits<double>::infinity();

struct Entry {
  std::int32_t column;
  double value;
};
struct Bounds {
  double lo, hi;
};
constexpr Bounds unilateral{0, inf}, bilateral{-inf, inf};

/// A small problem, written down in a few lines. What the library refuses is thrown.
class Sketch {
 public:
  Sketch() : problem_(handles::make_problem()) {}

  /// mass · I; returns the first velocity
  std::int32_t body(std::int32_t dimension, double mass) { return body(std::vector<double>(static_cast<std::size_t>(dimension), mass)); }
  /// A diagonal mass.
  std::int32_t body(const std::vector<double>& mass);
  /// For the body whose velocities start there.
  void prescribe(std::int32_t first_velocity, const std::vector<double>& velocity);
  void momentum(const std::vector<double>& k);
  std::int32_t row(const std::vector<Entry>& entries, double r = 0, Bounds bounds = unilateral, double compliance = 0);
  /// Rows row, row + 1 (, row + 2) become a contact with Coulomb's friction.
  void coulomb(std::int32_t row, std::int32_t dimension, double mu);
  void compliance(std::int32_t rows, const std::vector<double>& dense);

  const Problem& problem() const { return problem_; }
  Problem take() { return std::move(problem_); }

 private:
  Problem problem_;
  std::vector<std::int32_t> body_at_;  ///< by velocity
};

/// The same problem with every row as `change` leaves it: entries and r times scale[i], and each row `copies` times.
Problem with_rows(const Problem& problem, const std::vector<double>& scale, int copies);

/// The same problem for solvers that know no prescribed velocities: r carries them, and no row touches those bodies. Diagonal Σ is not kept.
Problem with_given_velocities_in_r(const Problem& problem);

}  // namespace hard
