#include "support.h"

using namespace capi;

TEST(TimeStep, MomentumIsMvPlusHq) {
  ProblemHandle problem = make_problem();
  mlcp_problem* p = problem.get();
  const double mass[] = {2, 1, 1, 3};
  ASSERT_EQ(mlcp_problem_bodies_add(p, 1, 2, mass, 0, nullptr), MLCP_OK);
  add_body(p, 1, 4);
  const double v[] = {1, 2, 3}, q[] = {10, 20, 30};
  ASSERT_EQ(mlcp_timestep_momentum(p, 0.5, 3, v, q), MLCP_OK);
  double k[3];
  ASSERT_EQ(mlcp_problem_get_momentum(p, 3, k), MLCP_OK);
  EXPECT_EQ(k[0], 2 * 1 + 1 * 2 + 0.5 * 10);
  EXPECT_EQ(k[1], 1 * 1 + 3 * 2 + 0.5 * 20);
  EXPECT_EQ(k[2], 4 * 3 + 0.5 * 30);
}

TEST(TimeStep, MomentumRefused) {
  ProblemHandle problem = make_problem();
  mlcp_problem* p = problem.get();
  add_body(p, 2, 1e300);
  const double v[] = {1, 1}, bad[] = {1, not_a_number}, fast[] = {1e20, 1}, q[] = {0, 0};
  expect_refused(p, MLCP_ERROR_ARGUMENT, "h = 0", [&] { return mlcp_timestep_momentum(p, 0, 2, v, q); });
  expect_refused(p, MLCP_ERROR_ARGUMENT, "h = ", [&] { return mlcp_timestep_momentum(p, not_a_number, 2, v, q); });
  expect_refused(p, MLCP_ERROR_ARGUMENT, "h = inf", [&] { return mlcp_timestep_momentum(p, inf, 2, v, q); });
  expect_refused(p, MLCP_ERROR_RANGE, "count = 3", [&] { return mlcp_timestep_momentum(p, 1, 3, v, q); });
  expect_refused(p, MLCP_ERROR_NULL, "v is NULL", [&] { return mlcp_timestep_momentum(p, 1, 2, nullptr, q); });
  expect_refused(p, MLCP_ERROR_NULL, "q is NULL", [&] { return mlcp_timestep_momentum(p, 1, 2, v, nullptr); });
  expect_refused(p, MLCP_ERROR_ARGUMENT, "v[1]", [&] { return mlcp_timestep_momentum(p, 1, 2, bad, q); });
  expect_refused(p, MLCP_ERROR_ARGUMENT, "q[1]", [&] { return mlcp_timestep_momentum(p, 1, 2, v, bad); });
  expect_refused(p, MLCP_ERROR_ARGUMENT, "v[0]", [&] { return mlcp_timestep_momentum(p, 1, 2, fast, q); });
  EXPECT_EQ(mlcp_timestep_momentum(nullptr, 1, 2, v, q), MLCP_ERROR_NULL);
}

TEST(TimeStep, RowsOpenGapClosesFully) {
  const double phi[] = {0.5, -0.5, 0}, phi_t[] = {1, 2, 3};
  double r[3];
  ASSERT_EQ(mlcp_timestep_rows(0.25, 0.5, 1, 3, phi, phi_t, r), MLCP_OK);
  EXPECT_EQ(r[0], -2 - 1);
  EXPECT_EQ(r[1], 1 - 2);
  EXPECT_EQ(r[2], -3);
  ASSERT_EQ(mlcp_timestep_rows(0.25, 0.5, 0, 3, phi, nullptr, r), MLCP_OK);
  EXPECT_EQ(r[0], -1);
  double in_place[] = {0.5, -0.5};
  ASSERT_EQ(mlcp_timestep_rows(0.25, 0, 1, 2, in_place, nullptr, in_place), MLCP_OK);
  EXPECT_EQ(in_place[0], -2);
  EXPECT_EQ(in_place[1], 0);
}

TEST(TimeStep, RowsRefused) {
  const double phi[] = {0, not_a_number};
  double r[] = {7, 7};
  EXPECT_EQ(mlcp_timestep_rows(1, 1, 0, 2, phi, nullptr, r), MLCP_ERROR_ARGUMENT);
  EXPECT_EQ(r[0], 7);
  EXPECT_EQ(mlcp_timestep_rows(0, 1, 0, 1, phi, nullptr, r), MLCP_ERROR_ARGUMENT);
  EXPECT_EQ(mlcp_timestep_rows(1, 1.5, 0, 1, phi, nullptr, r), MLCP_ERROR_ARGUMENT);
  EXPECT_EQ(mlcp_timestep_rows(1, -0.5, 0, 1, phi, nullptr, r), MLCP_ERROR_ARGUMENT);
  EXPECT_EQ(mlcp_timestep_rows(1, not_a_number, 0, 1, phi, nullptr, r), MLCP_ERROR_ARGUMENT);
  EXPECT_EQ(mlcp_timestep_rows(1, 1, 0, -1, phi, nullptr, r), MLCP_ERROR_RANGE);
  EXPECT_EQ(mlcp_timestep_rows(1, 1, 0, 1, nullptr, nullptr, r), MLCP_ERROR_NULL);
  EXPECT_EQ(mlcp_timestep_rows(1, 1, 0, 1, phi, nullptr, nullptr), MLCP_ERROR_NULL);
  EXPECT_EQ(mlcp_timestep_rows(1, 1, 0, 0, nullptr, nullptr, nullptr), MLCP_OK);
}

TEST(TimeStep, RestitutionTurnsTheSpeedOfRowsThatCloseFastEnough) {
  const double h = 0.5, slowest = 0.25, e[] = {0.5, 0.5, 0.5, 0.5, 0};
  const double phi[] = {1, 1.5, -0.1, 0, 0}, rate[] = {-2, -2, -0.25, 3, -4};
  double r[] = {-2, -3, 0.04, 0, 0};  // closes just so; stays open; too slow; opens; does not bounce
  ASSERT_EQ(mlcp_timestep_restitution(h, slowest, 5, e, phi, rate, nullptr, r), MLCP_OK);
  const double expected[] = {1, -3, 0.04, 0, 0};
  for (int i = 0; i < 5; ++i) EXPECT_EQ(r[i], expected[i]) << i;
  // on a belt that moves away at 1 m/s: J v before = rate - phi_t = -3, after at least 0.5 * 2 - 1
  const double phi_t[] = {1};
  r[0] = -3;
  ASSERT_EQ(mlcp_timestep_restitution(h, slowest, 1, e, phi, rate, phi_t, r), MLCP_OK);
  EXPECT_EQ(r[0], 0);
  // what pushes an overlap apart faster than it would bounce stays
  const double deep[] = {-1};
  r[0] = 7;
  ASSERT_EQ(mlcp_timestep_restitution(h, slowest, 1, e, deep, rate, nullptr, r), MLCP_OK);
  EXPECT_EQ(r[0], 7);
}

TEST(TimeStep, RestitutionRefused) {
  const double e[] = {1, 1.5}, fine[] = {0, 0}, fast[] = {-1, -1}, bad[] = {0, not_a_number};
  double r[] = {7, 7};
  const auto call = [&](double h, double slowest, int32_t count, const double* restitution, const double* phi, const double* rate,
                        const double* phi_t) { return mlcp_timestep_restitution(h, slowest, count, restitution, phi, rate, phi_t, r); };
  EXPECT_EQ(call(1, 0, 2, e, fine, fast, nullptr), MLCP_ERROR_ARGUMENT);
  EXPECT_EQ(call(0, 0, 1, e, fine, fast, nullptr), MLCP_ERROR_ARGUMENT);
  EXPECT_EQ(call(1, -1, 1, e, fine, fast, nullptr), MLCP_ERROR_ARGUMENT);
  EXPECT_EQ(call(1, 0, -1, e, fine, fast, nullptr), MLCP_ERROR_RANGE);
  EXPECT_EQ(call(1, 0, 2, fine, bad, fast, nullptr), MLCP_ERROR_ARGUMENT);
  EXPECT_EQ(call(1, 0, 2, fine, fine, bad, nullptr), MLCP_ERROR_ARGUMENT);
  EXPECT_EQ(call(1, 0, 2, fine, fine, fast, bad), MLCP_ERROR_ARGUMENT);
  EXPECT_EQ(call(1, 0, 1, nullptr, fine, fast, nullptr), MLCP_ERROR_NULL);
  EXPECT_EQ(call(1, 0, 1, e, nullptr, fast, nullptr), MLCP_ERROR_NULL);
  EXPECT_EQ(call(1, 0, 1, e, fine, nullptr, nullptr), MLCP_ERROR_NULL);
  EXPECT_EQ(mlcp_timestep_restitution(1, 0, 1, e, fine, fast, nullptr, nullptr), MLCP_ERROR_NULL);
  EXPECT_EQ(call(1, 0, 0, nullptr, nullptr, nullptr, nullptr), MLCP_OK);
  for (const double value : r) EXPECT_EQ(value, 7);
}

TEST(TimeStep, SpringIsImplicitEuler) {
  const double h = 0.01, s = 300, d = 7, phi = 0.02;
  double compliance = 0, r = 0;
  ASSERT_EQ(mlcp_timestep_spring(h, s, d, phi, &compliance, &r), MLCP_OK);
  // the row J v + Σγ = r is the force γ/h = −s (φ + h Jv) − d Jv
  const double velocity = -0.3, gamma = (r - velocity) / compliance;
  EXPECT_NEAR(gamma / h, -s * (phi + h * velocity) - d * velocity, 1e-12);
}

TEST(TimeStep, SpringRefused) {
  double compliance = 7, r = 7;
  EXPECT_EQ(mlcp_timestep_spring(0.01, 0, 0, 1, &compliance, &r), MLCP_ERROR_ARGUMENT);
  EXPECT_EQ(mlcp_timestep_spring(0.01, -1, 1, 1, &compliance, &r), MLCP_ERROR_ARGUMENT);
  EXPECT_EQ(mlcp_timestep_spring(0.01, 1, -1, 1, &compliance, &r), MLCP_ERROR_ARGUMENT);
  EXPECT_EQ(mlcp_timestep_spring(-1, 1, 1, 1, &compliance, &r), MLCP_ERROR_ARGUMENT);
  EXPECT_EQ(mlcp_timestep_spring(0.01, 1, 1, inf, &compliance, &r), MLCP_ERROR_ARGUMENT);
  EXPECT_EQ(mlcp_timestep_spring(1e-300, 0, 1e-300, 0, &compliance, &r), MLCP_ERROR_ARGUMENT);
  EXPECT_EQ(mlcp_timestep_spring(0.01, 1, 1, 1, nullptr, &r), MLCP_ERROR_NULL);
  EXPECT_EQ(mlcp_timestep_spring(0.01, 1, 1, 1, &compliance, nullptr), MLCP_ERROR_NULL);
  EXPECT_EQ(compliance, 7);
  EXPECT_EQ(r, 7);
}

TEST(TimeStep, ErpCfm) {
  double compliance = 0, r = 0;
  ASSERT_EQ(mlcp_timestep_erp_cfm(0.5, 0.25, 2, 4, &compliance, &r), MLCP_OK);
  EXPECT_EQ(compliance, 4);
  EXPECT_EQ(r, -2);
  EXPECT_EQ(mlcp_timestep_erp_cfm(0.5, 1.25, 2, 4, &compliance, &r), MLCP_ERROR_ARGUMENT);
  EXPECT_EQ(mlcp_timestep_erp_cfm(0.5, -0.25, 2, 4, &compliance, &r), MLCP_ERROR_ARGUMENT);
  EXPECT_EQ(mlcp_timestep_erp_cfm(0.5, 0.25, -2, 4, &compliance, &r), MLCP_ERROR_ARGUMENT);
  EXPECT_EQ(mlcp_timestep_erp_cfm(0, 0.25, 2, 4, &compliance, &r), MLCP_ERROR_ARGUMENT);
  EXPECT_EQ(mlcp_timestep_erp_cfm(0.5, 0.25, 2, not_a_number, &compliance, &r), MLCP_ERROR_ARGUMENT);
  EXPECT_EQ(mlcp_timestep_erp_cfm(0.5, 0.25, 2, 4, nullptr, &r), MLCP_ERROR_NULL);
  EXPECT_EQ(compliance, 4);
}

TEST(Names, EveryEnumeratorHasOne) {
  for (mlcp_status s = MLCP_OK; s <= MLCP_ERROR_INTERNAL; ++s) EXPECT_STRNE(mlcp_status_text(s), mlcp_status_text(1000));
  for (mlcp_outcome o = MLCP_SOLVED; o <= MLCP_BAD_INPUT; ++o) EXPECT_STRNE(mlcp_outcome_text(o), mlcp_outcome_text(-1));
  for (mlcp_method m = MLCP_METHOD_AUTO; m <= MLCP_METHOD_SIMPLEX; ++m) EXPECT_STRNE(mlcp_method_text(m), mlcp_method_text(-1));
  EXPECT_STREQ(mlcp_outcome_text(MLCP_NOT_POSITIVE_DEFINITE), "not_positive_definite");
  EXPECT_STREQ(mlcp_method_text(MLCP_METHOD_SIMPLEX), "simplex");
  EXPECT_EQ(mlcp_abi_version(), MLCP_ABI_VERSION);
  int major = -1, minor = -1, patch = -1;
  EXPECT_EQ(std::sscanf(mlcp_version(), "%d.%d.%d", &major, &minor, &patch), 3);
}
