// The same problem told in another way has the same solution.
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "assemble/rows.h"
#include "support/failure.h"
#include "support/random_problem.h"

namespace support {
namespace {

/// Small, with all that a problem can have; a third are of a few dozen rows.
mlcp::Problem any_problem(Random& random) {
  Shape shape;
  shape.dimension_most = 6;
  shape.feasible = 0.95;
  shape.rows_least = 1;
  if (random.chance(0.3)) {
    shape.bodies_most = 20;
    shape.rows_most = 40;
    shape.boxed_most = 40;
    shape.duplicate = 0.05;
  }
  return random_problem(random, shape);
}

/// The base solution against a variant's; both solved, or both infeasible with certificates that hold.
class Invariance : public testing::Test {
 protected:
  template <class Vary>
  void check(std::uint64_t first_seed, int count, Vary vary) {
    int compared = 0;
    for (std::uint64_t seed = first_seed; seed < first_seed + rounds(count) && !HasFailure(); ++seed) {
      seed_ = seed;
      Random random(seed);
      const mlcp::Problem problem = any_problem(random);
      const Solution base = solve(problem);
      if (base.report.outcome == MLCP_INFEASIBLE) {
        EXPECT_EQ(infeasible_fault(dense(problem), base), "") << evidence("invariance", seed, problem, settings());
        continue;
      }
      const std::string wrong = fault(dense(problem), base);
      if (!wrong.empty()) ADD_FAILURE() << wrong << '\n' << evidence("invariance", seed, problem, settings());
      const std::vector<double> v = vary(problem, random);
      EXPECT_LE(difference(v, base.v), 1e-10) << evidence("invariance", seed, problem, settings());
      ++compared;
    }
    EXPECT_GE(compared, count / 2);
  }

  /// v of a variant that must be solved.
  static std::vector<double> solved(const mlcp::Problem& problem, const mlcp::Settings& how, const mlcp::Mask* start = nullptr) {
    const Solution s = solve(problem, how, nullptr, start);
    const std::string wrong = fault(dense(problem), s);
    if (!wrong.empty()) ADD_FAILURE() << wrong << '\n' << evidence("variant", seed_, problem, how, nullptr, start);
    return s.v;
  }
  static inline std::uint64_t seed_ = 0;
};

std::vector<int> permutation(Random& random, int size) {
  std::vector<int> order(size);
  std::iota(order.begin(), order.end(), 0);
  for (int s = size; s > 1; --s) std::swap(order[s - 1], order[random.integer(0, s - 1)]);
  return order;
}

/// Rows in another order and of another length: row new = scale · row order[new], γ scales inversely.
mlcp::Problem rows_changed(const mlcp::Problem& p, const std::vector<int>& order, const std::vector<double>& scale) {
  mlcp::Problem q(p, mlcp::Memory());
  mlcp::rows_clear(q);
  const int m = p.m();
  Eigen::MatrixXd sigma = Eigen::MatrixXd::Zero(m, m);
  std::vector<int> place(m);
  for (int i = 0; i < m; ++i) place[order[i]] = i;
  for (int i = 0; i < m; ++i) {
    const int from = order[i];
    std::vector<Entry> entries;
    for (auto t = p.jacobian.pointers[from]; t < p.jacobian.pointers[from + 1]; ++t)
      entries.push_back({p.jacobian.indices[t], scale[i] * p.jacobian.values[t]});
    add_row(q, entries, scale[i] * p.r[from], {p.lo[from] / scale[i], p.hi[from] / scale[i]});
    for (auto t = p.compliance.pointers[from]; t < p.compliance.pointers[from + 1]; ++t) {
      const int other = place[p.compliance.indices[t]];
      sigma(other, i) = scale[i] * scale[other] * p.compliance.values[t];
    }
  }
  if (m > 0) set_sigma(q, sigma);
  return q;
}

TEST_F(Invariance, OrderOfRows) {
  check(1000, 1500, [](const mlcp::Problem& p, Random& random) {
    return solved(rows_changed(p, permutation(random, p.m()), std::vector<double>(p.m(), 1.0)), settings());
  });
}

TEST_F(Invariance, LengthOfRows) {
  check(10000, 1500, [](const mlcp::Problem& p, Random& random) {
    std::vector<int> order(p.m());
    std::iota(order.begin(), order.end(), 0);
    std::vector<double> scale(p.m());
    for (double& s : scale) s = std::ldexp(1.0, random.integer(-20, 20));
    return solved(rows_changed(p, order, scale), settings());
  });
}

TEST_F(Invariance, OrderOfBodies) {
  check(20000, 1500, [](const mlcp::Problem& p, Random& random) {
    const auto bodies = static_cast<int>(p.bodies.size());
    const std::vector<int> order = permutation(random, bodies);
    const Dense d = dense(p);
    mlcp::Problem q = empty_problem();
    std::vector<int> column(p.n());
    for (const int b : order) {
      const int first = p.bodies[b].offset, size = p.bodies[b].dimension, at = q.n();
      const Eigen::MatrixXd mass = d.M.block(first, first, size, size).cast<double>();
      const int id = p.bodies[b].sparse ? add_sparse_body(q, mass) : add_body(q, mass);
      if (p.bodies[b].prescribed) prescribe(q, id, {p.given_velocity.begin() + first, p.given_velocity.begin() + first + size});
      for (int j = 0; j < size; ++j) column[first + j] = at + j;
    }
    Eigen::VectorXd k(p.n());
    for (int j = 0; j < p.n(); ++j) k[column[j]] = p.momentum[j];
    set_k(q, k);
    for (int i = 0; i < p.m(); ++i) {
      std::vector<Entry> entries;
      for (auto t = p.jacobian.pointers[i]; t < p.jacobian.pointers[i + 1]; ++t)
        entries.push_back({column[p.jacobian.indices[t]], p.jacobian.values[t]});
      add_row(q, entries, p.r[i], {p.lo[i], p.hi[i]});
    }
    if (p.m() > 0) set_sigma(q, d.S.cast<double>());
    const std::vector<double> v = solved(q, settings());
    std::vector<double> back(p.n());
    for (int j = 0; j < p.n(); ++j) back[j] = v[column[j]];
    return back;
  });
}

TEST_F(Invariance, WarmStartFromAnyMask) {
  check(30000, 1500, [](const mlcp::Problem& p, Random& random) {
    const mlcp::Mask start = random_mask(random, p.m());
    return solved(p, settings(), &start);
  });
}

TEST_F(Invariance, WarmStartFromTheAnswerNeedsNoPivot) {
  check(40000, 1000, [](const mlcp::Problem& p, Random&) {
    const Solution first = solve(p, settings());
    const mlcp::Mask answer = mask_of(first.state);
    const Solution again = solve(p, settings(), nullptr, &answer);
    EXPECT_EQ(fault(dense(p), again), "");
    // which of several dependent joints is in the factor, the mask does not tell
    bool told = true;
    for (int i = 0; i < p.m(); ++i) told &= !(first.redundant[i] && first.state[i] == MLCP_ROW_ACTIVE);
    EXPECT_TRUE(again.report.pivots == 0 || !told) << evidence("warm", seed_, p, settings(), nullptr, &answer);
    return again.v;
  });
}

TEST_F(Invariance, PivotRule) {
  check(50000, 1500, [](const mlcp::Problem& p, Random& random) {
    const mlcp::Mask start = random_mask(random, p.m());
    return solved(p, settings(MLCP_PIVOT_PRINTED), random.chance(0.3) ? &start : nullptr);
  });
}

TEST_F(Invariance, RefactorizedAtEveryPivot) {
  check(60000, 1500, [](const mlcp::Problem& p, Random& random) {
    return solved(p, settings(random.chance(0.5) ? MLCP_PIVOT_PRINTED : MLCP_PIVOT_DUAL, MLCP_REFACTORIZE_ALWAYS));
  });
}

/// Three rows for a velocity, some of them coupled by Σ, and no solution: columns of rows that come before velocities have entries of both kinds.
TEST_F(Invariance, CrowdedIslandsWithCoupledRows) {
  for (const std::uint64_t seed : {8645, 41922, 55521, 62862}) {
    Random random(seed);
    const mlcp::Problem p = any_problem(random);
    mlcp::Settings how = settings();
    for (const mlcp_method method : {MLCP_METHOD_SIMPLEX, MLCP_METHOD_NEWTON, MLCP_METHOD_AUTO}) {
      how.method = method;
      EXPECT_EQ(infeasible_fault(dense(p), solve(p, how)), "") << "method " << method << ' ' << evidence("coupled", seed, p, how);
    }
  }
}

/// One solver for a sequence of problems with the same and other patterns gives what a new solver gives, to the bit.
TEST_F(Invariance, SolverThatHasSolvedBefore) {
  for (std::uint64_t seed = 70000; seed < 70000u + rounds(200) && !HasFailure(); ++seed) {
    Random random(seed);
    mlcp::Settings how = random.chance(0.5) ? settings() : mlcp::default_settings();
    how.warm_start = 0;
    mlcp::Solver solver(how, mlcp::Memory());
    mlcp::Problem problem = any_problem(random);
    for (int step = 0; step < 8; ++step) {
      if (random.chance(0.3)) problem = any_problem(random);
      Eigen::VectorXd k(problem.n());
      for (int j = 0; j < problem.n(); ++j) k[j] = random.uniform();
      set_k(problem, k);
      const Solution warm = solve(solver, problem), cold = solve(problem, how);
      ASSERT_EQ(warm.report.outcome, cold.report.outcome) << evidence("reused_solver", seed, problem, how);
      ASSERT_EQ(warm.v, cold.v) << evidence("reused_solver", seed, problem, how);
      ASSERT_EQ(warm.gamma, cold.gamma) << evidence("reused_solver", seed, problem, how);
    }
  }
}

}  // namespace
}  // namespace support
