#include "factorize/dense_tableau.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <gtest/gtest.h>

#include "support/kernels.h"
#include "support/random_problem.h"

namespace support {
namespace {

using Dense = Eigen::MatrixXd;

/// A of one small island, which it keeps alive.
struct Island {
  mlcp::Problem problem;
  mlcp::Components components{mlcp::Memory()};
  mlcp::DenseResponse response{mlcp::Memory()};
  mlcp::DenseIsland* island = nullptr;

  explicit Island(Random& random)
      : problem(random_problem(random, {.bodies_most = 3, .rows_least = 4, .rows_most = 14, .prescribed = 0, .compliance = 1, .duplicate = 0})) {
    components.update(problem, nullptr);
    response.prepare(problem, components);
    for (int c = 0; c < components.count(); ++c)
      if (components.row_count(c) > 0 && response.compute(problem, c)) island = &response.island(c);
  }
  Dense A() const {
    Dense a(island->m, island->m);
    for (int i = 0; i < island->m; ++i)
      for (int j = 0; j < island->m; ++j) a(i, j) = island->response(i, j);
    return a;
  }
};

Dense entries(const mlcp::DenseTableau& Q, int m) {
  Dense q(m, m);
  for (int i = 0; i < m; ++i)
    for (int j = 0; j < m; ++j) q(i, j) = Q(i, j);
  return q;
}

/// The definition, by dense inverses; and rows that go out again leave what was there before.
TEST(DenseTableau, IsInverseAndSchurComplementOfWhatIsIn) {
  int looked_at = 0;
  for (int seed = 0; seed < 200; ++seed) {
    Random random(seed);
    const Island one(random);
    if (!one.island) continue;
    const Dense A = one.A();
    std::vector<int> in, out;
    for (int i = 0; i < A.rows(); ++i) (random.chance(0.5) ? in : out).push_back(i);
    if (in.empty()) continue;
    const Eigen::VectorXd eigenvalues = Eigen::SelfAdjointEigenSolver<Dense>(Dense(A(in, in))).eigenvalues();
    if (!(eigenvalues.minCoeff() > 1e-5 * eigenvalues.maxCoeff())) continue;
    ++looked_at;
    mlcp::DenseTableau Q(*one.island);
    Q.load();
    for (const int i : in) Q.take_in(i);
    const Dense inverse = Dense(A(in, in)).inverse();
    Dense expected(A.rows(), A.cols());
    expected(in, in) = -inverse;
    expected(out, in) = A(out, in) * inverse;
    expected(in, out) = expected(out, in).transpose();
    expected(out, out) = A(out, out) - A(out, in) * inverse * A(in, out);
    EXPECT_LE((entries(Q, one.island->m) - expected).norm(), 1e-8 * expected.norm()) << "seed " << seed;
    for (const int i : in) Q.take_out(i);
    EXPECT_LE((entries(Q, one.island->m) - A).norm(), 1e-8 * (A.norm() + expected.norm())) << "seed " << seed;
  }
  EXPECT_GT(looked_at, 100);
}

TEST(DenseTableau, SweepsWithTheSameBitsOnEveryCpu) {
  for (int seed = 0; seed < 100; ++seed) {
    Random random(seed);
    const int size = random.integer(1, 21), stride = (size + 3) / 4 * 4, pivot = random.integer(0, size - 1);
    std::vector<double> t(stride * stride), column(stride);
    for (double& entry : t) entry = random.uniform();
    const std::vector<double> before = t;
    mlcp::portable_kernels.sweep(size, stride, t.data(), pivot, 1, column.data());
    for (const mlcp::Kernels* kernels : kernels_of_this_cpu()) {
      std::vector<double> again = before;
      kernels->sweep(size, stride, again.data(), pivot, 1, column.data());
      for (int i = 0; i < size; ++i)
        for (int j = 0; j <= i; ++j) ASSERT_EQ(t[i * stride + j], again[i * stride + j]) << "seed " << seed;
    }
  }
}

}  // namespace
}  // namespace support
