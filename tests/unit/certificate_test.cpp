#include "measure/certificate.h"

#include <gtest/gtest.h>

#include <limits>

#include "support/random_problem.h"
#include "support/solution.h"

namespace support {
namespace {

bool holds(const mlcp::Problem& problem, const std::vector<std::int32_t>& rows, const std::vector<double>& y,
           const mlcp::Mask* enabled = nullptr) {
  return mlcp::CertificateCheck(mlcp::Memory()).holds(problem, enabled, rows, y);
}

/// v ≥ 1 and −v ≥ 0
mlcp::Problem squeezed(Bounds bounds = unilateral, double compliance = 0) {
  mlcp::Problem p = empty_problem();
  add_body(p, 1, 1);
  add_row(p, {{0, 1}}, 1, bounds, compliance);
  add_row(p, {{0, -1}}, 0);
  return p;
}

TEST(Certificate, TrueOneIsAccepted) {
  EXPECT_TRUE(holds(squeezed(), {0, 1}, {1, 1}));
  EXPECT_TRUE(holds(squeezed(), {1, 0}, {5, 5}));
  EXPECT_TRUE(holds(squeezed(bilateral), {0, 1}, {1, 1}));
}

TEST(Certificate, WrongSignIsRefused) { EXPECT_FALSE(holds(squeezed(), {0, 1}, {-1, -1})); }

TEST(Certificate, FiniteBoundIsRefused) {
  EXPECT_FALSE(holds(squeezed({0, 10}), {0, 1}, {1, 1})) << "at γ = hi the row may stay violated";
  EXPECT_TRUE(holds(squeezed({-3, mlcp::infinity}), {0, 1}, {1, 1}));
}

TEST(Certificate, MomentumThatRemainsIsRefused) {
  EXPECT_FALSE(holds(squeezed(), {0, 1}, {1, 0.999}));
  EXPECT_FALSE(holds(squeezed(), {0}, {1}));
  EXPECT_TRUE(holds(squeezed(), {0, 1}, {1, 1 + 1e-13})) << "rounding";
}

TEST(Certificate, NoGapIsRefused) {
  mlcp::Problem p = empty_problem();
  add_body(p, 1, 1);
  add_row(p, {{0, 1}}, 1);
  add_row(p, {{0, -1}}, -1);
  EXPECT_FALSE(holds(p, {0, 1}, {1, 1})) << "v = 1 satisfies both";
}

TEST(Certificate, SoftRowGivesWay) { EXPECT_FALSE(holds(squeezed(unilateral, 1e-3), {0, 1}, {1, 1})); }

TEST(Certificate, PrescribedVelocityCountsAsGiven) {
  mlcp::Problem p = empty_problem();
  add_body(p, 1, 1);
  add_row(p, {{0, 1}}, 0);
  prescribe(p, 0, {-2});
  EXPECT_TRUE(holds(p, {0}, {1}));
  prescribe(p, 0, {2});
  EXPECT_FALSE(holds(p, {0}, {1}));
}

TEST(Certificate, ZeroRow) {
  mlcp::Problem p = empty_problem();
  add_row(p, {}, 1);
  add_row(p, {}, -1);
  EXPECT_TRUE(holds(p, {0}, {1}));
  EXPECT_FALSE(holds(p, {1}, {1}));
}

TEST(Certificate, NothingAndNanAreRefused) {
  EXPECT_FALSE(holds(squeezed(), {}, {}));
  EXPECT_FALSE(holds(squeezed(), {0, 1}, {std::numeric_limits<double>::quiet_NaN(), 1}));
  EXPECT_FALSE(holds(squeezed(), {0, 1}, {mlcp::infinity, mlcp::infinity}));
}

/// Σ couples the certificate's rows with a third one, which counts only if it is enabled.
TEST(Certificate, ComplianceWithADisabledRowIsForgiven) {
  mlcp::Problem p = reduced_problem((Eigen::Matrix2d() << 0, 1, 1, 0).finished(), Eigen::Vector2d(-1, 0));
  const mlcp::Mask enabled = mask_of({MLCP_ROW_AT_LOWER, MLCP_ROW_DISABLED});
  EXPECT_FALSE(holds(p, {0}, {1}));
  EXPECT_TRUE(holds(p, {0}, {1}, &enabled));
}

/// The same verdict as Farkas written out, on perturbed certificates of infeasible problems.
TEST(Certificate, EqualsTheDefinitionWrittenOut) {
  int accepted = 0, refused = 0;
  for (int seed = 0; seed < 3000; ++seed) {
    Random random(seed);
    const mlcp::Problem p = random_problem(random, {.rows_least = 3, .prescribed = 0.3, .feasible = 0.1});
    const Solution s = solve(p);
    if (s.report.outcome != MLCP_INFEASIBLE) continue;
    std::vector<double> y = s.certificate_y;
    const int change = random.integer(0, 4);
    double& one = y[random.integer(0, static_cast<int>(y.size()) - 1)];
    if (change == 1) one = -one;
    if (change == 2) one *= 1.01;
    if (change == 3)
      for (double& x : y) x = -x;
    if (change == 4)
      for (double& x : y) x *= 1e6;
    const bool verdict = holds(p, s.certificate_row, y);
    ASSERT_EQ(verdict, certificate_fault(dense(p), s.certificate_row, y).empty()) << "seed " << seed;
    (verdict ? accepted : refused) += 1;
  }
  EXPECT_GT(accepted, 100);
  EXPECT_GT(refused, 100);
}

}  // namespace
}  // namespace support
