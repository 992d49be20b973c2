// The paper's theorems and corollaries, with the corrections of its readers.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "assemble/compliance.h"
#include "support/failure.h"
#include "support/random_problem.h"

namespace support {
namespace {

/// (2.6): bilateral rows C v = c first, then unilateral rows D v ≥ d.
struct Mechanism {
  mlcp::Problem problem = empty_problem();
  Matrix M, C, D;
  Vector k, c, d;

  Mechanism(Random& random, bool integers, int unilateral_rows) {
    const int bodies = random.integer(1, 4);
    for (int b = 0; b < bodies; ++b) {
      const int size = random.integer(1, 4);
      if (integers) add_body(problem, size, random.integer(1, 2));
      else add_body(problem, random_mass(random, size, false));
    }
    const int n = problem.n(), joints = random.integer(0, n / 3);
    const auto number = [&] { return integers ? static_cast<double>(random.integer(-1, 1)) : random.uniform(); };
    Eigen::VectorXd momentum(n), point(n);
    for (int j = 0; j < n; ++j) {
      momentum[j] = integers ? 2 * random.integer(0, 1) - 1 : random.uniform();
      point[j] = number();
    }
    set_k(problem, momentum);
    for (int i = 0; i < joints + unilateral_rows; ++i) {
      std::vector<Entry> entries;
      double r = 0;
      for (int j = 0; j < n; ++j) {
        if (!random.chance(0.6)) continue;
        entries.push_back({j, number()});
        r += entries.back().value * point[j];
      }
      const bool joint = i < joints;
      if (!joint) r -= integers ? random.integer(0, 1) : random.uniform(0, 1);
      add_row(problem, entries, r, joint ? bilateral : unilateral);
    }
    const Dense all = dense(problem);
    M = all.M;
    k = all.k;
    C = all.J.topRows(joints);
    c = all.r.head(joints);
    D = all.J.bottomRows(unilateral_rows);
    d = all.r.tail(unilateral_rows);
  }

  bool independent_joints() const {
    if (C.rows() == 0) return true;
    const Matrix A = C * solve_spd(M, C.transpose());
    return Eigen::SelfAdjointEigenSolver<Matrix>(A).eigenvalues().minCoeff() > 1e-6L;
  }
};

/// (2.7)-(2.8) with the M⁻¹ that the printed B has lost: α = A γ_D + B.
struct DenseLcp {
  Reduced lcp;

  explicit DenseLcp(const Mechanism& p) {
    const Matrix X = solve_spd(p.M, p.D.transpose());
    const Vector v0 = solve_spd(p.M, p.k);
    lcp.A = p.D * X;
    lcp.b = p.D * v0 - p.d;
    if (p.C.rows() > 0) {
      const Matrix S = p.C * solve_spd(p.M, p.C.transpose()), W = p.C * X;
      lcp.A -= W.transpose() * solve_spd(S, W);
      lcp.b -= W.transpose() * solve_spd(S, Vector(p.C * v0 - p.c));
    }
    const auto m = lcp.b.size();
    lcp.lo = Vector::Zero(m);
    lcp.hi = Vector::Constant(m, std::numeric_limits<Real>::infinity());
    lcp.size = p.D.cwiseAbs() * v0.cwiseAbs() + p.d.cwiseAbs();
  }
  /// v and γ_C from γ_D, by the two block rows of (2.6) that were eliminated.
  static Vector velocity(const Mechanism& p, const Vector& gamma_d) {
    Vector free = solve_spd(p.M, Vector(p.k + p.D.transpose() * gamma_d));
    if (p.C.rows() == 0) return free;
    const Matrix X = solve_spd(p.M, p.C.transpose());
    return free - X * solve_spd(p.C * X, Vector(p.C * free - p.c));
  }
};

class Paper : public testing::TestWithParam<bool> {};

TEST_P(Paper, Theorem1TheReducedLcpHasTheSameSolution) {
  int compared = 0;
  for (std::uint64_t seed = 1; seed <= 1000 && !HasFailure(); ++seed) {
    Random random(seed);
    const Mechanism p(random, GetParam(), random.integer(1, 7));
    if (!p.independent_joints()) continue;
    const DenseLcp reduced(p);
    const std::optional<Vector> gamma = enumerate(reduced.lcp);
    ASSERT_TRUE(gamma) << evidence("theorem_1", seed, p.problem, settings());
    const Solution s = solve(p.problem);
    EXPECT_EQ(fault(dense(p.problem), s), "") << evidence("theorem_1", seed, p.problem, settings());
    EXPECT_LE(difference(s.v, DenseLcp::velocity(p, *gamma)), 1e-10) << evidence("theorem_1", seed, p.problem, settings());
    // and the solver on (2.8) itself: n = 0
    const Matrix symmetric = (reduced.lcp.A + reduced.lcp.A.transpose()) / 2;
    const mlcp::Problem lcp = reduced_problem(symmetric.cast<double>(), reduced.lcp.b.cast<double>());
    const Solution t = solve(lcp);
    if (t.report.outcome == MLCP_SOLVED) {
      EXPECT_LE(difference(s.v, DenseLcp::velocity(p, widen(t.gamma))), 1e-7) << evidence("theorem_1", seed, lcp, settings());
      ++compared;
    }
  }
  EXPECT_GE(compared, 900 * (GetParam() ? 0.8 : 1)) << "rounded semidefinite matrices may be infeasible, but seldom";
}

TEST_P(Paper, Corollary11TheMatrixIsSymmetricPositiveSemidefinite) {
  for (std::uint64_t seed = 1; seed <= 500; ++seed) {
    Random random(seed);
    const Mechanism p(random, GetParam(), random.integer(1, 12));
    if (!p.independent_joints()) continue;
    const Matrix A = DenseLcp(p).lcp.A;
    const Real size = A.cwiseAbs().maxCoeff();
    ASSERT_LE((A - A.transpose()).cwiseAbs().maxCoeff(), 1e-15L * size) << "seed " << seed;
    ASSERT_GE(Eigen::SelfAdjointEigenSolver<Matrix>(A).eigenvalues().minCoeff(), -1e-15L * size) << "seed " << seed;
  }
}

/// (2.9): v minimises ½vᵀM v − kᵀv over D v ≥ d, C v = c. Other feasible points are solutions for other momenta.
TEST_P(Paper, Corollary12TheVelocityMinimisesTheQp) {
  for (std::uint64_t seed = 1; seed <= 500 && !HasFailure(); ++seed) {
    Random random(seed);
    Mechanism p(random, GetParam(), random.integer(1, 10));
    const Vector v = widen(solve(p.problem).v);
    const auto objective = [&](const Vector& x) -> Real { return x.dot(p.M * x) / 2 - p.k.dot(x); };
    const Vector slack = p.D * v - p.d;
    ASSERT_GE(slack.minCoeff(), -1e-12L) << evidence("corollary_12", seed, p.problem, settings());
    for (int other = 0; other < 10; ++other) {
      Eigen::VectorXd k(p.problem.n());
      for (int j = 0; j < k.size(); ++j) k[j] = 3 * random.uniform();
      set_k(p.problem, k);
      const Vector feasible = widen(solve(p.problem).v);
      for (const Real t : {0.01L, 0.5L, 1.0L})
        ASSERT_GE(objective(v + t * (feasible - v)), objective(v) - 1e-12L) << "seed " << seed;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Numbers, Paper, testing::Values(false, true),
                         [](const auto& param) { return param.param ? "integers" : "real"; });

/// Theorem 2, with what it leaves open filled in: both rules end within the limit at a solution.
void expect_finite(const mlcp::Problem& problem, std::uint64_t seed = 0) {
  const Dense d = dense(problem);
  for (const mlcp_pivot_rule rule : {MLCP_PIVOT_DUAL, MLCP_PIVOT_PRINTED}) {
    const Solution s = solve(problem, settings(rule));
    std::string wrong = s.report.outcome == MLCP_INFEASIBLE ? infeasible_fault(d, s) : fault(d, s);
    if (s.report.pivots > 50 * (problem.m() + 10)) wrong += " too many pivots";
    ASSERT_EQ(wrong, "") << "rule " << rule << ' ' << evidence("theorem_2", seed, problem, settings(rule));
  }
}

/// Fathi (1979): A = L Lᵀ, L unit lower triangular with 2 below the diagonal, b = −1: 2ⁿ pivots for some methods.
TEST(PaperTheorem2, FathisExponentialLcp) {
  for (int n = 1; n <= 14; ++n) {
    Eigen::MatrixXd L = Eigen::MatrixXd::Identity(n, n);
    for (int i = 0; i < n; ++i) L.row(i).head(i).setConstant(2);
    expect_finite(reduced_problem(L * L.transpose(), Eigen::VectorXd::Constant(n, -1)));
    mlcp::Problem p = empty_problem();
    add_body(p, n, 1);
    for (int i = 0; i < n; ++i) {
      std::vector<Entry> entries;
      for (int j = 0; j <= i; ++j) entries.push_back({j, L(i, j)});
      add_row(p, entries, 1);
    }
    expect_finite(p);
    ASSERT_FALSE(testing::Test::HasFatalFailure()) << n;
  }
}

/// Murty's matrix is not symmetric, so it is no problem of bodies: the error says so.
TEST(PaperTheorem2, MurtysMatrixIsRefused) {
  Eigen::Matrix3d A = Eigen::Matrix3d::Identity();
  A(0, 1) = A(0, 2) = A(1, 2) = 2;
  mlcp::Problem p = empty_problem();
  for (int i = 0; i < 3; ++i) add_row(p, {}, 1);
  EXPECT_THROW(set_sigma(p, A), mlcp::Error);
}

/// Boxes on boxes, four corners each, all in one column: every contact after the third of a box is redundant, all ties.
TEST(PaperTheorem2, StackedBoxes) {
  for (const int boxes : {1, 2, 5, 10, 20}) {
    mlcp::Problem p = empty_problem();
    const Eigen::Matrix3d mass = Eigen::Vector3d(1, 0.1, 0.1).asDiagonal();  // height, two tilts
    for (int b = 0; b < boxes; ++b) add_body(p, mass);
    Eigen::VectorXd k = Eigen::VectorXd::Zero(3 * boxes);
    for (int b = 0; b < boxes; ++b) k[3 * b] = -9.81;
    set_k(p, k);
    for (int b = 0; b < boxes; ++b)
      for (const double x : {-0.5, 0.5})
        for (const double y : {-0.5, 0.5}) {
          std::vector<Entry> entries{{3 * b, 1}, {3 * b + 1, x}, {3 * b + 2, y}};
          if (b > 0)
            for (int j = 0; j < 3; ++j) entries.push_back({3 * (b - 1) + j, -entries[j].value});
          add_row(p, entries);
        }
    expect_finite(p);
    ASSERT_FALSE(testing::Test::HasFatalFailure()) << boxes;
    for (const double v : solve(p, settings()).v) ASSERT_NEAR(v, 0, 1e-12);
  }
}

TEST(PaperTheorem2, DuplicatedRowsAndTies) {
  for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(rounds(300)) && !testing::Test::HasFailure(); ++seed) {
    Random random(seed);
    mlcp::Problem p = empty_problem();
    const int n = random.integer(2, 15);
    for (int j = 0; j < n; ++j) add_body(p, 1, 1);
    Eigen::VectorXd k(n);
    for (int j = 0; j < n; ++j) k[j] = 2 * random.integer(0, 1) - 1;
    set_k(p, k);
    for (int i = random.integer(n, 3 * n); i > 0; --i) {
      std::vector<Entry> entries;
      const int a = random.integer(0, n - 1), b = random.integer(0, n - 1);
      entries.push_back({a, static_cast<double>(2 * random.integer(0, 1) - 1)});
      if (a != b) entries.push_back({b, static_cast<double>(2 * random.integer(0, 1) - 1)});
      for (int copies = random.integer(1, 3); copies > 0; --copies) add_row(p, entries, random.chance(0.1) ? -1 : 0);
    }
    expect_finite(p, seed);
  }
}

}  // namespace
}  // namespace support
