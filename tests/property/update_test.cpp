// Rows toggled in and out of the factor against the factor made afresh.
#include <gtest/gtest.h>

#include <cmath>

#include "support/random_problem.h"
#include "support/stage.h"

namespace support {
namespace {

/// Toggles rows of two stages' worth of factor and compares them.
class Toggling {
 public:
  Toggling(const mlcp::Problem& problem, Random& random) : random_(random), updated_(problem), fresh_(problem) {
    in_.assign(updated_.pattern().size(), 0);
    for (const int p : updated_.row_positions()) in_[p] = random_.chance(0.5);
    updated_.factorize(in_, least_pivot);
    for (const int p : updated_.row_positions()) in_[p] = updated_.factor.in(p);
  }

  /// false: the row would be dependent, or there is none
  bool toggle() {
    const std::vector<std::int32_t> rows = updated_.row_positions();
    if (rows.empty()) return false;
    const int p = rows[random_.integer(0, static_cast<int>(rows.size()) - 1)];
    mlcp::FactorStatus status;
    if (in_[p]) {
      status = updated_.factor.remove(p, updated_.work);
    } else {
      const double a = updated_.values.a[updated_.pattern().row_ordinal[p]];
      if (!(-updated_.factor.schur(updated_.island_of(p), p, updated_.work) > least_pivot * a)) return false;
      status = updated_.factor.insert(p, updated_.work);
    }
    EXPECT_EQ(status, mlcp::FactorStatus::ok);
    in_[p] = !in_[p];
    return true;
  }

  /// Relative to the largest entry, each: pivots, and solutions for a random right-hand side.
  double difference() {
    fresh_.factorize(in_, 0);
    std::vector<double> b(in_.size());
    for (double& x : b) x = random_.uniform();
    const std::vector<double> x = updated_.solve(b), y = fresh_.solve(b);
    double worst = 0, size = 1;
    for (std::size_t p = 0; p < b.size(); ++p) {
      EXPECT_EQ(updated_.factor.in(static_cast<int>(p)), fresh_.factor.in(static_cast<int>(p)));
      worst = std::max(worst, std::abs(x[p] - y[p]));
      size = std::max(size, std::abs(y[p]));
      const double d = updated_.factor.pivot(static_cast<int>(p)), f = fresh_.factor.pivot(static_cast<int>(p));
      if (f != 0) pivots_ = std::max(pivots_, std::abs(d - f) / std::abs(f));
    }
    return worst / size;
  }
  double pivot_difference() const { return pivots_; }
  double reconstruction() {
    std::vector<double> b(in_.size());
    for (double& x : b) x = random_.uniform();
    return static_cast<double>(residual_of(updated_, updated_.loaded(), updated_.solve(b), b));
  }

 private:
  static constexpr double least_pivot = 1e-3;  // well conditioned
  Random& random_;
  Stage updated_, fresh_;
  std::vector<std::uint8_t> in_;
  double pivots_ = 0;
};

void toggle_on(const Shape& shape, int problems, int toggles, std::uint64_t first_seed) {
  std::int64_t done = 0;
  for (std::uint64_t seed = first_seed; seed < first_seed + rounds(problems) && !testing::Test::HasFailure(); ++seed) {
    Random random(seed);
    Toggling t(random_problem(random, shape), random);
    for (int s = 0; s < toggles; ++s) done += t.toggle();
    EXPECT_LE(t.difference(), 1e-10) << "seed " << seed;
    EXPECT_LE(t.pivot_difference(), 1e-10) << "seed " << seed;
    EXPECT_LE(t.reconstruction(), 1e-12) << "seed " << seed;
  }
  EXPECT_GE(done, problems * toggles / 4);
}

TEST(Update, SmallProblems) {
  Shape shape;
  shape.bodies_most = 5;
  shape.dimension_most = 6;
  shape.rows_least = 1;
  shape.rows_most = 12;
  toggle_on(shape, 2000, 30, 1);
}

TEST(Update, LargeSparseBodies) {
  Shape shape;
  shape.bodies_most = 3;
  shape.dimension_most = 30;
  shape.sparse_mass = 1;
  shape.rows_least = 5;
  shape.rows_most = 25;
  toggle_on(shape, 400, 60, 10000);
}

TEST(Update, SparseCompliance) {
  Shape shape;
  shape.bodies_most = 6;
  shape.rows_least = 4;
  shape.rows_most = 20;
  shape.compliance = 0.7;
  shape.feasible = 0;
  shape.compliance_matrix = 1;
  toggle_on(shape, 1000, 40, 20000);
}

TEST(Update, ReducedProblems) {
  for (std::uint64_t seed = 30000; seed < 30000u + rounds(1000) && !HasFailure(); ++seed) {
    Random random(seed);
    const int rows = random.integer(2, 15);
    Toggling t(random_reduced(random, rows, rows + 3, false), random);
    for (int s = 0; s < 40; ++s) t.toggle();
    EXPECT_LE(t.difference(), 1e-10) << "seed " << seed;
    EXPECT_LE(t.reconstruction(), 1e-12) << "seed " << seed;
  }
}

TEST(Update, Chains) {
  std::int64_t done = 0;
  for (std::uint64_t seed = 40000; seed < 40000u + rounds(200) && !HasFailure(); ++seed) {
    Random random(seed);
    Toggling t(random_chain(random, random.integer(2, 40), random.integer(2, 4), 1), random);
    for (int s = 0; s < 200; ++s) done += t.toggle();
    EXPECT_LE(t.difference(), 1e-10) << "seed " << seed;
    EXPECT_LE(t.pivot_difference(), 1e-10) << "seed " << seed;
    EXPECT_LE(t.reconstruction(), 1e-12) << "seed " << seed;
  }
  EXPECT_GE(done, 20000);
}

/// Bodies in a grid, a row between neighbours and one with the ground: a pile.
TEST(Update, PileThousandsOfToggles) {
  Random random(50000);
  mlcp::Problem p = empty_problem();
  const int side = 8, d = 3;
  for (int b = 0; b < side * side; ++b) add_body(p, random_mass(random, d, false));
  const auto row = [&](int b, int c) {
    std::vector<Entry> entries;
    for (int j = 0; j < d; ++j) {
      entries.push_back({b * d + j, random.uniform()});
      if (c >= 0) entries.push_back({c * d + j, random.uniform()});
    }
    add_row(p, entries);
  };
  for (int i = 0; i < side; ++i)
    for (int j = 0; j < side; ++j) {
      row(i * side + j, -1);
      if (i > 0) row(i * side + j, (i - 1) * side + j);
      if (j > 0) row(i * side + j, i * side + j - 1);
    }
  Toggling t(p, random);
  for (int done = 0; done < rounds(20000);) {
    for (int s = 0; s < 1000; ++s) done += t.toggle();
    EXPECT_LE(t.difference(), 1e-10) << "after " << done << " toggles";
  }
  EXPECT_LE(t.reconstruction(), 1e-12);
}

/// All rows out one by one, then in again, in random order.
TEST(Update, AllOutAndInAgain) {
  for (std::uint64_t seed = 60000; seed < 60200; ++seed) {
    Random random(seed);
    const mlcp::Problem p = random_chain(random, 10, 3, 1);
    Stage updated(p), fresh(p);
    const std::vector<std::uint8_t> all(updated.pattern().size(), 1), none(updated.pattern().size(), 0);
    updated.factorize(all, 1e-6);
    std::vector<std::int32_t> rows;
    for (const int q : updated.row_positions())
      if (updated.factor.in(q)) rows.push_back(q);
    const auto shuffle = [&] {
      for (std::size_t s = rows.size(); s > 1; --s) std::swap(rows[s - 1], rows[random.integer(0, static_cast<int>(s) - 1)]);
    };
    shuffle();
    for (const int q : rows) ASSERT_EQ(updated.factor.remove(q, updated.work), mlcp::FactorStatus::ok) << "seed " << seed;
    fresh.factorize(none);
    for (int q = 0; q < updated.pattern().size(); ++q)
      ASSERT_NEAR(updated.factor.pivot(q), fresh.factor.pivot(q), 1e-9) << "seed " << seed;
    shuffle();
    for (const int q : rows) ASSERT_EQ(updated.factor.insert(q, updated.work), mlcp::FactorStatus::ok) << "seed " << seed;
    std::vector<double> b(all.size(), 1.0);
    ASSERT_LE(residual_of(updated, updated.loaded(), updated.solve(b), b), 1e-9) << "seed " << seed;
  }
}

}  // namespace
}  // namespace support
