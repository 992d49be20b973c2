// Bodies with contacts whose friction pyramids are plain rows: many more rows than velocities, few of them active. Cold, and from the last active set after
// changes, as an engine steps them.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "support/build.h"
#include "support/random_problem.h"
#include "support/solution.h"

namespace support {
namespace {

struct Contact {
  int a, b;  // bodies; b < 0: the world
  std::array<std::array<double, 6>, 3> frame;  // rates of the normal and of two tangents with the velocities of a
  double r, heavy;
};

/// Rates of one facet, µ times a direction along the tangents added to the normal.
std::vector<Entry> facet(const Contact& contact, int dimension, double mu, double angle, bool flat) {
  std::vector<Entry> entries;
  for (int j = 0; j < dimension; ++j) {
    const auto& [normal, s, t] = contact.frame;
    const double rate = normal[j] + (flat ? 0 : mu * (std::cos(angle) * s[j] + std::sin(angle) * t[j]));
    if (rate == 0) continue;
    entries.push_back({dimension * contact.a + j, rate});
    if (contact.b >= 0) entries.push_back({dimension * contact.b + j, -contact.heavy * rate});
  }
  return entries;
}

/// Chains of bodies, so that some are infeasible; rates that are rounded, so that rows depend on each other; boxes among the rows.
mlcp::Problem crowded_pyramids(Random& random) {
  const int bodies = random.integer(2, 24), dimension = random.chance(0.5) ? 3 : 6, contacts = random.integer(5, 40), facets = random.integer(1, 6);
  mlcp::Problem p = random_chain(random, bodies, dimension, 0);
  const double mu = random.uniform(0, 1.2);
  const bool rounded = random.chance(0.3), boxes = random.chance(0.3), heavy = random.chance(0.2);
  for (int k = 0; k < contacts && p.m() < 190; ++k) {
    Contact contact{random.integer(0, bodies - 1), random.chance(0.5) ? random.integer(0, bodies - 1) : -1, {}, 0, heavy ? 10.0 : 1.0};
    if (contact.a == contact.b) contact.b = -1;
    for (auto& rates : contact.frame)
      for (double& rate : rates) {
        rate = random.uniform(-1, 1);
        if (rounded) rate = std::round(4 * rate) / 4;
      }
    contact.r = random.chance(0.3) ? 0 : -random.uniform(0, 0.3);
    for (int f = 0; f < facets; ++f) {
      const std::vector<Entry> entries = facet(contact, dimension, mu, 2 * std::numbers::pi * f / facets, facets == 1);
      if (entries.empty()) continue;
      const double width = random.uniform(0, 0.5);
      if (boxes && random.chance(0.3))
        add_row(p, entries, random.uniform(-0.2, 0.2), {-width, width});
      else
        add_row(p, entries, contact.r);
    }
  }
  return p;
}

struct Tally {
  int solved = 0, infeasible = 0;
};

/// Five steps, each as the simplex solves it.
void step(int seed, Tally& tally) {
  Random random(seed);
  mlcp::Problem p = crowded_pyramids(random);
  mlcp::Solver solver(automatic(), mlcp::Memory());
  mlcp::Mask start{mlcp::Memory()};
  for (int count = 0; count < 5; ++count) {
    const Solution s = solve(solver, p, nullptr, count > 0 ? &start : nullptr), expected = solve(p, settings());
    ASSERT_EQ(s.report.outcome, expected.report.outcome) << "seed " << seed << ", step " << count;
    if (s.report.outcome == MLCP_INFEASIBLE) {
      ++tally.infeasible;
      return;
    }
    ASSERT_EQ(fault(dense(p), s, 1e-10), "") << "seed " << seed << ", step " << count;
    ASSERT_LT(difference(s.v, expected.v), 1e-8) << "seed " << seed << ", step " << count;
    ++tally.solved;
    start.state.assign(s.state);
    start.impulse.assign(s.gamma);
    for (double& r : p.r)
      if (random.chance(0.3)) r -= 1e-3 * random.uniform(0, 1);
    for (double& k : p.momentum) k += 1e-2 * random.uniform(-1, 1);
  }
}

TEST(CrowdedPyramids, AreWhatTheSimplexSaysFromStepToStep) {
  Tally tally;
  for (int seed = 0; seed < rounds(400); ++seed) ASSERT_NO_FATAL_FAILURE(step(seed, tally));
  EXPECT_GT(tally.solved, 1000);
  EXPECT_GT(tally.infeasible, 10);
}

}  // namespace
}  // namespace support
