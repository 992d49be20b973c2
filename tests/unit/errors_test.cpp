#include "measure/errors.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "analyze/components.h"
#include "assemble/bodies.h"
#include "assemble/contacts.h"
#include "measure/cones.h"
#include "support/random_problem.h"
#include "support/solution.h"

namespace support {
namespace {

mlcp::Errors measure(const mlcp::Problem& problem, const std::vector<double>& v, const std::vector<double>& gamma,
                     const mlcp::Mask* enabled = nullptr) {
  return mlcp::Measure(mlcp::Memory()).run(problem, enabled, v, gamma);
}

/// A body on the ground: m = 2, k = −2, v ≥ 0.
mlcp::Problem resting_body(Bounds bounds = unilateral, double r = 0) {
  mlcp::Problem p = empty_problem();
  add_body(p, 1, 2);
  set_k(p, Eigen::VectorXd::Constant(1, -2));
  add_row(p, {{0, 1}}, r, bounds);
  return p;
}

TEST(Errors, NaturalResidualIsTheMedian) {
  EXPECT_EQ(mlcp::natural_residual(3, 1, 0, 0, mlcp::infinity), 0) << "w > 0 at lo";
  EXPECT_EQ(mlcp::natural_residual(-3, 1, 0, 0, mlcp::infinity), -3) << "penetrating, no impulse";
  EXPECT_EQ(mlcp::natural_residual(0, 1, 7, 0, mlcp::infinity), 0) << "active";
  EXPECT_EQ(mlcp::natural_residual(3, 2, 7, 0, mlcp::infinity), 3) << "pushing while open";
  EXPECT_EQ(mlcp::natural_residual(3, 2, 0.5, 0, mlcp::infinity), 1) << "the impulse is the smaller fault";
  EXPECT_EQ(mlcp::natural_residual(0, 2, -1, 0, mlcp::infinity), -2) << "pulling contact";
  EXPECT_EQ(mlcp::natural_residual(-5, 1, 4, -4, 4), 0) << "motor at its limit";
  EXPECT_EQ(mlcp::natural_residual(5, 1, 4, -4, 4), 5) << "motor at the wrong limit";
  EXPECT_EQ(mlcp::natural_residual(1e9, 1, 3, 3, 3), 0) << "lo = hi";
  EXPECT_EQ(mlcp::natural_residual(-0.5, 1, 9, -mlcp::infinity, mlcp::infinity), -0.5) << "joint that opens";
}

TEST(Errors, ExactSolutionHasNone) {
  const mlcp::Errors e = measure(resting_body(), {0}, {2});
  EXPECT_EQ(e.momentum, 0);
  EXPECT_EQ(e.constraints, 0);
  EXPECT_EQ(e.worst_row, 0);
  EXPECT_EQ(e.worst_velocity, 0);
}

TEST(Errors, FallingThroughTheGround) {
  const mlcp::Errors e = measure(resting_body(), {-1}, {0});
  EXPECT_EQ(e.momentum, 0);
  EXPECT_EQ(e.constraint_residual, 1);
  EXPECT_DOUBLE_EQ(e.constraints, 0.5) << "over |v| + |v0| = 2";
}

TEST(Errors, RowsAndBodiesOfAnySizeWeighTheSame) {
  for (const double length : {1e-8, 1.0, 1e8})
    for (const double mass : {1e-6, 1.0, 1e6}) {
      mlcp::Problem p = empty_problem();
      add_body(p, 1, 2 * mass);
      set_k(p, Eigen::VectorXd::Constant(1, -2 * mass));
      add_row(p, {{0, length}}, 0);
      EXPECT_NEAR(measure(p, {-1e-3}, {1.998 * mass / length}).constraints, 1e-3 / 1.001, 1e-12) << length << ' ' << mass;
    }
}

TEST(Errors, ZeroRowThatHolds) {
  mlcp::Problem p = empty_problem();
  add_row(p, {}, -1);
  EXPECT_EQ(measure(p, {}, {0}).constraints, 0);
  EXPECT_EQ(measure(p, {}, {0.5}).constraints, 0.5) << "a = 1 where no row has any";
}

TEST(Errors, ZeroRowThatCannotHold) {
  mlcp::Problem p = empty_problem();
  add_row(p, {}, 1);
  EXPECT_EQ(measure(p, {}, {0}).constraints, 1);
  EXPECT_EQ(measure(p, {}, {1e100}).constraints, 1) << "no impulse mends it";
}

TEST(Errors, BoxedZeroRowIsRightAtItsFarBound) {
  mlcp::Problem p = empty_problem();
  add_row(p, {}, 1, {-2, 3});
  EXPECT_EQ(measure(p, {}, {3}).constraints, 0);
  EXPECT_GT(measure(p, {}, {-2}).constraints, 0.5);
}

TEST(Errors, DisabledRowsAndPrescribedVelocitiesDoNotCount) {
  mlcp::Problem p = resting_body();
  const mlcp::Mask off = mask_of({MLCP_ROW_DISABLED});
  EXPECT_EQ(measure(p, {-1}, {0}, &off).constraints, 0);
  EXPECT_EQ(measure(p, {-1}, {0}, &off).worst_row, -1);
  prescribe(p, 0, {1});
  EXPECT_EQ(measure(p, {1}, {0}).momentum, 0);
  EXPECT_EQ(measure(p, {1}, {0}).worst_velocity, -1);
}

TEST(Errors, WhatIsNotFiniteIsAnInfiniteError) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double bad : {nan, mlcp::infinity, -mlcp::infinity}) {
    EXPECT_EQ(measure(resting_body(), {bad}, {2}).momentum, mlcp::infinity);
    EXPECT_EQ(measure(resting_body(), {bad}, {2}).constraints, mlcp::infinity);
    EXPECT_EQ(measure(resting_body(), {0}, {bad}).momentum, mlcp::infinity);
    EXPECT_EQ(measure(resting_body(), {0}, {bad}).constraints, mlcp::infinity);
    mlcp::Problem p = empty_problem();
    add_row(p, {}, 0);
    EXPECT_EQ(measure(p, {}, {bad}).largest(), mlcp::infinity);
  }
}

TEST(Errors, OverflowIsAnInfiniteError) {
  mlcp::Problem p = empty_problem();
  add_body(p, 1, 1e300);
  add_row(p, {{0, 1e300}});
  EXPECT_EQ(measure(p, {1e300}, {0}).momentum, mlcp::infinity);
}

/// Two problems of equal sizes, one after the other: where the diagonal of M stood in the first says nothing about the second.
TEST(Errors, AnotherPatternOfTheMassIsLookedAtAnew) {
  const auto problem = [](std::vector<std::int32_t> pointers, std::vector<std::int32_t> rows, std::vector<double> values) {
    mlcp::Problem p = empty_problem();
    mlcp::body_add_sparse(p, 2, pointers.data(), rows.data(), values.data(), MLCP_FULL);
    set_k(p, Eigen::VectorXd::Constant(2, 1));
    add_row(p, {{0, 1}, {1, 1}}, 0, unilateral);
    return p;
  };
  const mlcp::Problem sorted = problem({0, 2, 4}, {0, 1, 0, 1}, {4, 1, 1, 4}), reversed = problem({0, 2, 4}, {1, 0, 1, 0}, {1, 4, 4, 1});
  mlcp::Measure measure{mlcp::Memory()};
  const std::vector<double> v{0.2, 0.1}, gamma{0};
  const mlcp::Errors first = measure.run(sorted, nullptr, v, gamma);
  const double scale = measure.scale[0], a = measure.a[0];
  const mlcp::Errors second = measure.run(reversed, nullptr, v, gamma);
  EXPECT_EQ(measure.scale[0], scale);
  EXPECT_EQ(measure.a[0], a);
  EXPECT_EQ(second.momentum, first.momentum);
}

TEST(Errors, EmptyProblemHasNone) {
  const mlcp::Errors e = measure(empty_problem(), {}, {});
  EXPECT_EQ(e.largest(), 0);
  EXPECT_EQ(e.worst_row, -1);
  EXPECT_EQ(e.worst_velocity, -1);
}

/// As small as its own number makes it, also beside a row of its contact that has no numbers at all.
TEST(Errors, ZeroRowOfAContactIsNoScaleForTheOthers) {
  mlcp::Problem p = empty_problem();
  add_row(p, {}, 0);
  add_row(p, {}, 1e-170, {-mlcp::infinity, mlcp::infinity});
  mlcp::Measure measure{mlcp::Memory()};
  const std::vector<std::int32_t> contact_of_row{0, 0};
  measure.run(p, nullptr, {}, std::vector<double>{0, 0}, contact_of_row);
  EXPECT_EQ(measure.error[0], 0);
  EXPECT_EQ(measure.error[1], 1);
  const std::int32_t row = 0;
  const mlcp_friction model = MLCP_FRICTION_CONVEX;
  const double mu = 1, bound = 0;
  mlcp::contacts_declare(p, 1, 2, &row, {&model, &mu, &bound, nullptr});
  mlcp::Errors errors = measure.run(p, nullptr, {}, std::vector<double>{0, 0});
  mlcp::ConeMeasure cones{mlcp::Memory()};
  cones.run(p, nullptr, mlcp::default_settings().facets, {}, std::vector<double>{0, 0}, measure, errors);
  EXPECT_NEAR(errors.cones, std::sqrt(0.5), 1e-12) << "dist(w, K*) of a cone with µ = 1";
}

/// Coulomb's law multiplies the slip by µ: the last bit of a slip beside terms of 1 decides whether w̃ is in K* or far from it.
TEST(Errors, SlacksThatALargeFrictionMultipliesAreExact) {
  mlcp::Problem p = empty_problem();
  add_body(p, 3, 1);
  add_row(p, {{0, 1}}, 1e-3);
  add_row(p, {{0, 1}, {1, 1}, {2, 1}}, 0, {-mlcp::infinity, mlcp::infinity});
  const std::int32_t row = 0;
  const mlcp_friction model = MLCP_FRICTION_COULOMB;
  const double mu = 1e12, bound = 0;
  mlcp::contacts_declare(p, 1, 2, &row, {&model, &mu, &bound, nullptr});
  const std::vector<double> v{0x1p-60, 1, -1}, no_force{0, 0};
  mlcp::Measure measure{mlcp::Memory()};
  mlcp::Errors errors = measure.run(p, nullptr, v, no_force);
  ASSERT_EQ(measure.w[1], 0) << "in double";
  mlcp::ConeMeasure cones{mlcp::Memory()};
  cones.run(p, nullptr, mlcp::default_settings().facets, v, no_force, measure, errors);
  EXPECT_EQ(measure.w[1], 0x1p-60);
}

/// Two rows of one contact: the error of each is relative to the larger scale, that of a third row to its own.
TEST(Errors, RowsOfAContactAreMeasuredTogether) {
  mlcp::Problem p = empty_problem();
  add_body(p, 3, 1);
  for (int j = 0; j < 3; ++j) add_row(p, {{j, 1}}, 0, {-mlcp::infinity, mlcp::infinity});
  const std::vector<double> v{1e-3, 1e-17, 1e-17}, gamma{1, 1, 1};
  const std::vector<std::int32_t> contact_of_row{0, 0, -1};
  mlcp::Measure alone{mlcp::Memory()}, together{mlcp::Memory()};
  alone.run(p, nullptr, v, gamma);
  together.run(p, nullptr, v, gamma, contact_of_row);
  EXPECT_EQ(alone.error[1], 1);
  EXPECT_EQ(together.error[1], 1e-17 / 1e-3);
  EXPECT_EQ(together.error[0], alone.error[0]);
  EXPECT_EQ(together.error[2], alone.error[2]);
  EXPECT_EQ(together.residual[1], alone.residual[1]);
}

/// Random points of random problems against the definitions of the design, written out.
TEST(Errors, PartsInAnyOrderAddUpToTheWhole) {
  Random random(23);
  Shape shape;
  shape.bodies_most = 12;
  shape.rows_most = 10;
  shape.prescribed = 0.4;
  int several = 0, shared = 0;
  for (int round = 0; round < 400; ++round) {
    const mlcp::Problem p = random_problem(random, shape);
    const mlcp::Mask enabled = enabled_mask(random, p.m(), 0.2);
    std::vector<double> v(p.n()), gamma(p.m());
    for (double& x : v) x = random.uniform() - 0.5;
    for (int i = 0; i < p.m(); ++i) gamma[i] = enabled.state[i] == MLCP_ROW_DISABLED || random.chance(0.3) ? 0 : random.uniform();
    for (const mlcp::Body& body : p.bodies)
      if (body.prescribed) std::copy_n(p.given_velocity.begin() + body.offset, body.dimension, v.begin() + body.offset);
    std::vector<std::int32_t> contact;
    for (int i = 0; round % 2 && i < p.m(); ++i) contact.push_back(i / 2);
    mlcp::Components components{mlcp::Memory()};
    components.update(p, &enabled);
    mlcp::Measure whole{mlcp::Memory()}, parts{mlcp::Memory()};
    const mlcp::Errors expected = whole.run(p, &enabled, v, gamma, contact);
    const mlcp::Errors free = parts.begin(p, &enabled, components.free_velocities.span(), v);
    std::vector<mlcp::Measure::Part> found(components.count());
    for (int c = components.count() - 1; c >= 0; --c) {
      found[c] = parts.part(p, components.velocities_of(c), components.rows_of(c), v, gamma);
      shared += !found[c].complete;
    }
    several += components.count() > 1;
    const mlcp::Errors e = parts.end(p, &enabled, gamma, contact, free, found);
    for (const auto numbers : {&mlcp::Measure::w, &mlcp::Measure::scale, &mlcp::Measure::a, &mlcp::Measure::residual, &mlcp::Measure::error})
      for (int i = 0; i < p.m(); ++i) ASSERT_EQ((parts.*numbers)[i], (whole.*numbers)[i]) << round << ", row " << i;
    for (int c = 0; c < components.count(); ++c)
      for (const int j : components.velocities_of(c)) ASSERT_EQ(parts.velocity_error(j), whole.velocity_error(j)) << round << ", velocity " << j;
    EXPECT_EQ(e.constraints, expected.constraints);
    EXPECT_EQ(e.constraint_residual, expected.constraint_residual);
    EXPECT_EQ(e.worst_row, expected.worst_row);
    EXPECT_DOUBLE_EQ(e.momentum, expected.momentum);
    EXPECT_EQ(e.momentum_residual, expected.momentum_residual);
    ASSERT_EQ(e.worst_velocity < 0, expected.worst_velocity < 0);
    EXPECT_DOUBLE_EQ(e.worst_velocity < 0 ? 0 : whole.velocity_error(e.worst_velocity), expected.momentum);
  }
  EXPECT_GT(several, 100);
  EXPECT_GT(shared, 20) << "rows without an a of their own";
}

TEST(Errors, EqualTheDefinitionsWrittenOut) {
  for (int seed = 0; seed < 2000; ++seed) {
    Random random(seed);
    const bool reduced = random.chance(0.2);
    const mlcp::Problem p = reduced ? random_reduced(random, 5, 3, random.chance(0.5))
                                    : random_problem(random, {.integers = random.chance(0.3), .prescribed = 0.3});
    const mlcp::Mask enabled = enabled_mask(random, p.m(), 0.2);
    std::vector<double> v(p.n()), gamma(p.m());
    for (int j = 0; j < p.n(); ++j) v[j] = p.prescribed(j) ? p.given_velocity[j] : random.uniform();
    for (int i = 0; i < p.m(); ++i) gamma[i] = enabled.state[i] == MLCP_ROW_DISABLED || random.chance(0.3) ? 0 : random.uniform();
    const mlcp::Errors e = measure(p, v, gamma, &enabled);
    const DenseErrors d = errors_of(dense(p, &enabled), widen(v), widen(gamma));
    const auto momentum = static_cast<double>(d.momentum), constraints = static_cast<double>(d.constraints);
    ASSERT_NEAR(e.momentum, momentum, 1e-13 * momentum + 1e-16) << "seed " << seed;
    ASSERT_NEAR(e.constraints, constraints, 1e-13 * constraints + 1e-16) << "seed " << seed;
    ASSERT_EQ(e.worst_velocity < 0, d.worst_velocity < 0) << "seed " << seed;
    ASSERT_EQ(e.worst_row < 0, d.worst_row < 0) << "seed " << seed;
    const Real worst_velocity = e.worst_velocity < 0 ? 0 : d.velocity[e.worst_velocity];
    const Real worst_row = e.worst_row < 0 ? 0 : d.row[e.worst_row];
    ASSERT_NEAR(static_cast<double>(worst_velocity), momentum, 1e-15) << "seed " << seed;
    ASSERT_NEAR(static_cast<double>(worst_row), constraints, 1e-15) << "seed " << seed;
  }
}

}  // namespace
}  // namespace support
