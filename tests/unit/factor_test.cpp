#include "factorize/factor.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "analyze/check_analysis.h"
#include "assemble/bodies.h"
#include "support/random_problem.h"
#include "support/stage.h"

namespace support {
namespace {

std::vector<std::uint8_t> random_rows(Random& random, const Stage& stage, double share) {
  std::vector<std::uint8_t> wanted(stage.pattern().size(), 0);
  for (const int p : stage.row_positions()) wanted[p] = random.chance(share);
  return wanted;
}

std::vector<double> random_vector(Random& random, int size) {
  std::vector<double> b(size);
  for (double& x : b) x = random.uniform();
  return b;
}

/// Pivots as dense elimination has them, solves with a small residual, zeros on what is out.
void expect_factor_of(Stage& stage, Random& random, double tolerance = 1e-12) {
  const Matrix K = stage.loaded();
  const Vector pivots = pivots_of(stage, K);
  for (int p = 0; p < K.rows(); ++p)
    ASSERT_NEAR(stage.factor.pivot(p), static_cast<double>(pivots[p]), tolerance * std::abs(static_cast<double>(pivots[p]))) << p;
  const std::vector<double> b = random_vector(random, static_cast<int>(K.rows())), x = stage.solve(b);
  ASSERT_LE(residual_of(stage, K, x, b), tolerance);
  for (int p = 0; p < K.rows(); ++p) {
    ASSERT_TRUE(stage.factor.in(p) || x[p] == 0);
  }
}

Shape independent_rows() {
  Shape shape;
  shape.bodies_most = 8;
  shape.rows_most = 14;
  shape.dimension_most = 6;
  shape.duplicate = 0;
  return shape;
}

TEST(Factor, ActiveSubsetsEqualDenseElimination) {
  for (int seed = 0; seed < 500; ++seed) {
    Random random(seed);
    const mlcp::Problem p = random_problem(random, independent_rows());
    Stage stage(p);
    ASSERT_EQ(stage.factorize(random_rows(random, stage, random.uniform(0, 1)), 1e-7), mlcp::FactorStatus::ok);
    expect_factor_of(stage, random, 1e-7);  // pivots down to 1e-7 a
    ASSERT_FALSE(HasFatalFailure()) << "seed " << seed;
  }
}

/// Rows before the velocities that they touch and among rows that Σ couples them to: columns of both kinds of entries.
TEST(Factor, CrowdedIslandsWithCoupledRowsAreThoseOfTheDenseMatrix) {
  Shape shape;
  shape.bodies_most = 4;
  shape.dimension_most = 4;
  shape.rows_least = 20;
  shape.rows_most = 40;
  shape.compliance = 0.7;
  shape.compliance_matrix = 1;
  int crowded = 0, mixed = 0;
  for (int seed = 0; seed < 200; ++seed) {
    Random random(seed);
    const mlcp::Problem p = random_problem(random, shape);
    mlcp::Analysis analysis{mlcp::Memory()};
    analysis.run(p, nullptr, false, {});
    ASSERT_TRUE(mlcp::check_analysis(analysis)) << "seed " << seed;
    const mlcp::KktPattern& pattern = analysis.pattern;
    const int size = pattern.size();
    crowded += analysis.crowding.any();
    for (const int row : pattern.row_position) {
      const auto begin = pattern.lower_rows.begin() + pattern.lower_pointers[row], end = pattern.lower_rows.begin() + pattern.lower_pointers[row + 1];
      const auto is_row = [&](int q) { return pattern.is_row(q); };
      mixed += std::any_of(begin, end, is_row) && !std::all_of(begin, end, is_row);
    }
    mlcp::KktValues values{mlcp::Memory()};
    values.load(p, pattern);
    mlcp::Factor factor{mlcp::Memory()};
    factor.prepare(pattern, analysis.symbolic, values);
    std::vector<std::uint8_t> wanted(size);
    for (std::uint8_t& w : wanted) w = random.chance(0.7);
    for (const mlcp::Island& island : analysis.symbolic.islands) values.regularise(pattern, island, 1e-2, 0);
    Matrix K = Matrix::Zero(size, size);
    for (int q = 0; q < size; ++q) {
      K(q, q) = values.factored[q];
      for (int t = pattern.lower_pointers[q]; t < pattern.lower_pointers[q + 1]; ++t) K(pattern.lower_rows[t], q) = K(q, pattern.lower_rows[t]) = values.lower[t];
    }
    std::vector<double> x = random_vector(random, size), b = x;
    std::int64_t work = 0;
    for (const mlcp::Island& island : analysis.symbolic.islands) {
      ASSERT_EQ(factor.factorize(island, wanted.data(), 0, work), mlcp::FactorStatus::ok) << "seed " << seed;
      factor.solve(island, x.data(), work);
    }
    for (int i = 0; i < size; ++i) {
      if (!factor.in(i)) continue;
      Real residual = b[i], terms = std::abs(b[i]);
      for (int j = 0; j < size; ++j) {
        if (!factor.in(j)) continue;
        residual -= K(i, j) * x[j];
        terms += std::abs(K(i, j) * x[j]);
      }
      ASSERT_LE(std::abs(residual), 1e-10 * terms) << "seed " << seed << ", position " << i;
    }
  }
  EXPECT_GT(crowded, 100);
  EXPECT_GT(mixed, 100);
}

/// A = B Bᵀ of rank 2 with two rows an angle δ apart: the pivot of the third is 0 and comes out as a rounding of A over δ².
TEST(Factor, PivotsThatAreRoundingBesideTheirTermsAreDropped) {
  int above = 0;
  for (int seed = 0; seed < 200; ++seed) {
    Random random(seed);
    Eigen::MatrixXd B(3, 2);
    for (int j = 0; j < 2; ++j) {
      B(0, j) = random.integer(20, 60) / 64.0;
      B(1, j) = 1.5 * B(0, j) + random.integer(1, 3) * (2 * j - 1) / 512.0;
      B(2, j) = random.integer(-60, 60) / 64.0;
    }
    const mlcp::Problem p = reduced_problem(B * B.transpose(), Eigen::Vector3d::Zero());
    Stage stage(p);
    const std::vector<std::uint8_t> all(3, 1);
    const auto in = [&] {
      int count = 0;
      for (const int q : stage.row_positions()) count += stage.factor.in(q);
      return count;
    };
    ASSERT_EQ(stage.factorize(all, 1e-13), mlcp::FactorStatus::ok);
    EXPECT_EQ(in(), 2) << "seed " << seed;
    ASSERT_EQ(stage.factorize(all, 0), mlcp::FactorStatus::ok);
    for (int q = 0; q < 3; ++q) above += stage.factor.in(q) && std::abs(stage.factor.pivot(q)) <= 1e-11 * stage.values.a[q] && std::abs(stage.factor.pivot(q)) > 1e-13 * stage.values.a[q];
  }
  EXPECT_GE(above, 10) << "pivots alone do not tell";
}

/// A row an angle of 1e-6 from another has a pivot of 1e-12 a, and is independent.
TEST(Factor, SmallPivotsOfIndependentRowsStay) {
  for (const double angle : {1e-3, 1e-4, 1e-5, 1e-6}) {
    mlcp::Problem p = empty_problem();
    add_body(p, 2, 1);
    add_row(p, {{0, 1}});
    add_row(p, {{0, 1}, {1, angle}});
    Stage stage(p);
    ASSERT_EQ(stage.factorize(std::vector<std::uint8_t>(4, 1), 1e-13), mlcp::FactorStatus::ok);
    for (const int q : stage.row_positions()) EXPECT_TRUE(stage.factor.in(q)) << angle;
  }
}

TEST(Factor, ChainsEqualDenseElimination) {
  for (const int links : {1, 2, 7, 40}) {
    Random random(links);
    Stage stage(random_chain(random, links, 3, 1));
    ASSERT_EQ(stage.factorize(random_rows(random, stage, 1)), mlcp::FactorStatus::ok);
    expect_factor_of(stage, random, 1e-9);
    ASSERT_FALSE(HasFatalFailure()) << links;
  }
}

TEST(Factor, WithoutRowsItIsTheMassMatrix) {
  Random random(5);
  Stage stage(random_chain(random, 4, 3, 1));
  ASSERT_EQ(stage.factorize(random_rows(random, stage, 0)), mlcp::FactorStatus::ok);
  for (const int p : stage.row_positions()) EXPECT_FALSE(stage.factor.in(p));
  expect_factor_of(stage, random);
}

TEST(Factor, ZeroVelocityPivotIsReported) {
  mlcp::Problem p = empty_problem();
  const Eigen::Matrix2d singular = (Eigen::Matrix2d() << 1, 1, 1, 1).finished();
  add_body(p, 1, 1);
  add_sparse_body(p, singular);
  add_row(p, {{0, 1}, {1, 1}});
  Stage stage(p);
  EXPECT_EQ(stage.factorize({0, 0, 0, 0}), mlcp::FactorStatus::not_positive_definite);
  const int node = stage.pattern().node[stage.factor.failed_position(stage.islands()[0])];
  EXPECT_EQ(p.body_of[node], 1);
}

TEST(Factor, IndefiniteMassIsReported) {
  mlcp::Problem p = empty_problem();
  add_sparse_body(p, (Eigen::Matrix2d() << 1, 2, 2, 1).finished());
  add_row(p, {{0, 1}});
  Stage stage(p);
  EXPECT_EQ(stage.factorize({0, 0, 0}), mlcp::FactorStatus::not_positive_definite);
}

TEST(Factor, DependentRowIsLeftOut) {
  mlcp::Problem p = empty_problem();
  Random random(3);
  add_body(p, random_mass(random, 3, false));
  add_row(p, {{0, 1}, {1, 2}});
  add_row(p, {{0, 2}, {1, 4}});
  add_row(p, {{0, 1}, {1, 2}, {2, 1e-3}});
  Stage stage(p);
  ASSERT_EQ(stage.factorize({1, 1, 1, 1, 1, 1}), mlcp::FactorStatus::ok);
  int in = 0;
  for (const int q : stage.row_positions()) in += stage.factor.in(q);
  EXPECT_EQ(in, 2) << "the parallel row goes, the nearly parallel one stays";
  expect_factor_of(stage, random, 1e-9);
}

TEST(Factor, DependentRowWithComplianceStays) {
  mlcp::Problem p = empty_problem();
  add_body(p, 1, 1);
  add_row(p, {{0, 1}}, 0, unilateral, 1e-3);
  add_row(p, {{0, 1}}, 0, unilateral, 1e-3);
  Stage stage(p);
  ASSERT_EQ(stage.factorize({1, 1, 1}), mlcp::FactorStatus::ok);
  for (const int q : stage.row_positions()) EXPECT_TRUE(stage.factor.in(q));
}

TEST(Factor, ZeroRowIsLeftOut) {
  mlcp::Problem p = empty_problem();
  add_row(p, {});
  Stage stage(p);
  ASSERT_EQ(stage.factorize({1}), mlcp::FactorStatus::ok);
  EXPECT_FALSE(stage.factor.in(0));
}

TEST(Factor, SchurComplementOfARowThatIsOut) {
  for (int seed = 0; seed < 300; ++seed) {
    Random random(seed);
    const mlcp::Problem p = random_problem(random, independent_rows());
    Stage stage(p);
    ASSERT_EQ(stage.factorize(random_rows(random, stage, 0.5), 1e-6), mlcp::FactorStatus::ok);
    const Matrix K = stage.loaded();
    std::vector<double> x(K.rows());
    for (const int q : stage.row_positions()) {
      if (stage.factor.in(q)) continue;
      const mlcp::Island& island = stage.island_of(q);
      const double schur = stage.factor.solve_row(island, q, x.data(), stage.work);
      // K x = K(:,q) on what is in
      Real complement = K(q, q), scale = stage.values.a[stage.pattern().row_ordinal[q]];
      for (int i = island.first; i < island.last; ++i) {
        if (!stage.factor.in(i)) continue;
        complement -= K(q, i) * x[i];
        Real residual = K(i, q), size = std::abs(K(i, q));
        for (int j = island.first; j < island.last; ++j) {
          if (!stage.factor.in(j)) continue;
          residual -= K(i, j) * x[j];
          size += std::abs(K(i, j) * x[j]);
        }
        ASSERT_LE(std::abs(residual), 1e-8 * size + 1e-12) << "seed " << seed;
      }
      ASSERT_NEAR(schur, static_cast<double>(complement), 1e-8 * static_cast<double>(scale)) << "seed " << seed;
      ASSERT_EQ(stage.factor.schur(island, q, stage.work), schur) << "seed " << seed;
    }
  }
}

TEST(Factor, PathsLeadToTheRoot) {
  Random random(9);
  const Stage stage(random_chain(random, 10, 2, 1));
  for (const int q : stage.row_positions()) {
    std::int64_t count = 0;
    for (int p = stage.analysis.symbolic.parent[q]; p >= 0; p = stage.analysis.symbolic.parent[p]) ++count;
    EXPECT_EQ(stage.factor.path_columns(q), count);
  }
}

}  // namespace
}  // namespace support
