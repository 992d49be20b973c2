// The dense factor by blocks and the kernels that work on its panels, against the products written down, with the same bits from either kernel.
#include "factorize/block_ldl.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <vector>

#include "factorize/kernels.h"
#include "support/kernels.h"
#include "support/random.h"

namespace support {
namespace {

constexpr double positive[4] = {};

/// A symmetric positive definite matrix of 4 · blocks rows, zero beyond a random envelope, and its factor.
struct Case {
  int blocks, size;
  Eigen::MatrixXd A;
  std::vector<double> lower, inverse;
  std::vector<std::int32_t> first;

  Case(Random& random, int count) : blocks(count), size(4 * count), A(Eigen::MatrixXd::Identity(size, size) * size), lower(mlcp::BlockLdl::reals(count)), inverse(size) {
    for (int b = 0; b < blocks; ++b) {
      first.push_back(random.integer(0, b));
      for (int p = 4 * b; p < 4 * b + 4; ++p)
        for (int q = 4 * first[b]; q < p; ++q) A(p, q) = A(q, p) = random.uniform();
    }
  }
  mlcp::BlockLdl factor() { return {lower.data(), inverse.data(), first.data()}; }

  /// How many rows of block b have pivots above least.
  std::int32_t eliminate(const mlcp::Kernels& kernels, int b, const double* least = positive) {
    double* const block = factor().block(b);
    for (int q = 4 * first[b]; q < 4 * b + 4; ++q)
      for (int r = 0; r < 4; ++r) block[4 * q + r] = q <= 4 * b + r ? A(4 * b + r, q) : 0;
    return kernels.block_eliminate(factor(), b, least);
  }
  void eliminate(const mlcp::Kernels& kernels) {
    for (int b = 0; b < blocks; ++b) ASSERT_EQ(eliminate(kernels, b), 4);
  }
  Eigen::MatrixXd L() {
    Eigen::MatrixXd l = Eigen::MatrixXd::Identity(size, size);
    for (int b = 0; b < blocks; ++b)
      for (int q = 4 * first[b]; q < 4 * b + 4; ++q)
        for (int r = 0; r < 4; ++r) l(4 * b + r, q) += factor().block(b)[4 * q + r];
    return l;
  }
};

class BlockLdl : public testing::Test {
 protected:
  template <class Check>
  void each(Check check) {
    for (const mlcp::Kernels* kernels : kernels_of_this_cpu())
      for (int seed = 0; seed < 200; ++seed) {
        SCOPED_TRACE(seed);
        Random random(seed);
        Case c(random, random.integer(1, 7));
        c.eliminate(mlcp::portable_kernels);
        check(c, random, *kernels);
        if (HasFatalFailure()) return;
      }
  }
};

TEST_F(BlockLdl, IsTheFactorOfItsMatrix) {
  each([](Case& c, Random&, const mlcp::Kernels&) {
    const Eigen::MatrixXd l = c.L(), product = l * Eigen::Map<Eigen::VectorXd>(c.inverse.data(), c.size).cwiseInverse().asDiagonal() * l.transpose();
    ASSERT_LT((product - c.A).cwiseAbs().maxCoeff(), 1e-12);
    ASSERT_EQ(Eigen::MatrixXd(l.triangularView<Eigen::StrictlyUpper>()).cwiseAbs().maxCoeff(), 0);
  });
}

TEST_F(BlockLdl, SolvesWithItsTriangles) {
  each([](Case& c, Random& random, const mlcp::Kernels& kernels) {
    Eigen::VectorXd x(c.size);
    for (double& entry : x) entry = random.uniform();
    Eigen::VectorXd forward = x, backward = x;
    mlcp::portable_kernels.block_forward(c.factor(), c.blocks, forward.data());
    mlcp::portable_kernels.block_backward(c.factor(), c.blocks, backward.data());
    Eigen::VectorXd forward_here = x, backward_here = x;
    kernels.block_forward(c.factor(), c.blocks, forward_here.data());
    kernels.block_backward(c.factor(), c.blocks, backward_here.data());
    ASSERT_EQ(forward, forward_here);
    ASSERT_EQ(backward, backward_here);
    ASSERT_LT((c.L() * forward - x).cwiseAbs().maxCoeff(), 1e-13);
    ASSERT_LT((c.L().transpose() * backward - x).cwiseAbs().maxCoeff(), 1e-13);
  });
}

TEST_F(BlockLdl, PanelsAreSolvedAndMultipliedWithTheSameBitsOnEveryCpu) {
  each([](Case& c, Random& random, const mlcp::Kernels& kernels) {
    const int begin = random.integer(0, c.blocks - 1);
    Eigen::Matrix<double, -1, 4, Eigen::RowMajor> y = Eigen::MatrixXd::Zero(c.size, 4);
    for (int p = 4 * begin; p < c.size; ++p)
      for (int r = 0; r < 4; ++r) y(p, r) = random.chance(0.3) ? random.uniform() : 0;
    Case other = c;
    other.eliminate(kernels);
    ASSERT_EQ(c.lower, other.lower);
    ASSERT_EQ(c.inverse, other.inverse);

    Eigen::Matrix<double, -1, 4, Eigen::RowMajor> solved = y, again = y, scaled = y, scaled_again = y;
    const int end = mlcp::portable_kernels.panel_forward(c.factor(), begin, c.blocks, solved.data());
    ASSERT_EQ(kernels.panel_forward(c.factor(), begin, c.blocks, again.data()), end);
    ASSERT_EQ(solved, again);
    ASSERT_LT((c.L() * solved - y).cwiseAbs().maxCoeff(), 1e-13);
    ASSERT_EQ(solved.bottomRows(c.size - 4 * end).cwiseAbs().sum(), 0);
    ASSERT_TRUE(end == begin || solved.middleRows(4 * end - 4, 4).cwiseAbs().sum() > 0);

    Eigen::VectorXd k(c.size);
    for (double& entry : k) entry = random.uniform();
    double sum[4], sum_again[4], tile[16], tile_again[16], mirror[16], mirror_again[16];
    mlcp::portable_kernels.panel_scale(c.size, solved.data(), c.inverse.data(), k.data(), scaled.data(), sum);
    kernels.panel_scale(c.size, solved.data(), c.inverse.data(), k.data(), scaled_again.data(), sum_again);
    mlcp::portable_kernels.panel_product(c.size, scaled.data(), solved.data(), 4, tile, mirror);
    kernels.panel_product(c.size, scaled.data(), solved.data(), 4, tile_again, mirror_again);
    const Eigen::VectorXd inverse = Eigen::Map<Eigen::VectorXd>(c.inverse.data(), c.size);
    ASSERT_EQ(scaled, inverse.asDiagonal() * solved);
    for (int r = 0; r < 4; ++r) {
      ASSERT_EQ(sum[r], sum_again[r]);
      ASSERT_NEAR(sum[r], scaled.col(r).dot(k), 1e-13);
      for (int lane = 0; lane < 4; ++lane) {
        ASSERT_EQ(tile[4 * r + lane], tile_again[4 * r + lane]);
        ASSERT_EQ(mirror[4 * lane + r], tile[4 * r + lane]);
        ASSERT_EQ(mirror_again[4 * lane + r], tile[4 * r + lane]);
        ASSERT_NEAR(tile[4 * r + lane], scaled.col(r).dot(solved.col(lane)), 1e-13);
      }
    }
  });
}

TEST_F(BlockLdl, TilesAreMultipliedWithTheSameBitsOnEveryCpu) {
  each([](Case& c, Random& random, const mlcp::Kernels& kernels) {
    std::vector<std::int32_t> block;
    for (int b = 0; b < c.blocks; ++b)
      if (random.chance(0.6)) block.push_back(b);
    const int count = static_cast<int>(block.size());
    Eigen::MatrixXd J = Eigen::MatrixXd::Zero(4, c.size);
    std::vector<double> tiles;
    for (const int b : block)
      for (int q = 0; q < 4; ++q)
        for (int r = 0; r < 4; ++r) tiles.push_back(J(q, 4 * b + r) = random.chance(0.7) ? random.uniform() : 0);
    Eigen::VectorXd x(c.size);
    for (double& entry : x) entry = random.uniform();
    Eigen::Vector4d y, weight;
    for (int q = 0; q < 4; ++q) y[q] = random.uniform(), weight[q] = random.uniform(0, 1);

    Eigen::Vector4d times = y, times_again = y;
    mlcp::portable_kernels.tiles_times(count, block.data(), tiles.data(), x.data(), times.data());
    kernels.tiles_times(count, block.data(), tiles.data(), x.data(), times_again.data());
    ASSERT_EQ(times, times_again);
    ASSERT_LT((times - y - J * x).cwiseAbs().maxCoeff(), 1e-13);
    Eigen::VectorXd transposed = x, transposed_again = x;
    mlcp::portable_kernels.tiles_transposed(count, block.data(), tiles.data(), y.data(), transposed.data());
    kernels.tiles_transposed(count, block.data(), tiles.data(), y.data(), transposed_again.data());
    ASSERT_EQ(transposed, transposed_again);
    ASSERT_LT((transposed - x - J.transpose() * y).cwiseAbs().maxCoeff(), 1e-13);

    std::vector<double> lower(c.lower.size()), lower_again;
    for (double& entry : lower) entry = random.uniform();
    const std::vector<double> before = lower_again = lower;
    mlcp::portable_kernels.tiles_square({lower.data(), c.inverse.data(), c.first.data()}, count, block.data(), tiles.data(), weight.data());
    kernels.tiles_square({lower_again.data(), c.inverse.data(), c.first.data()}, count, block.data(), tiles.data(), weight.data());
    const Eigen::MatrixXd square = J.transpose() * weight.asDiagonal() * J;
    for (int p = 0; p < c.size; ++p)
      for (int q = 0; q <= p; ++q) {
        const std::size_t at = mlcp::BlockLdl::reals(p / 4) + 4 * q + p % 4;
        ASSERT_EQ(lower[at], lower_again[at]);
        ASSERT_NEAR(lower[at] - before[at], square(p, q), 1e-13);
      }
  });
}

/// Products of two pivots, which are found together, may overflow or vanish.
TEST_F(BlockLdl, PivotsOfAnySizeAreFound) {
  for (const double scale : {std::ldexp(1, 700), std::ldexp(1, -700), std::ldexp(1, 400), std::ldexp(1, -500)})
    each([&](Case& c, Random&, const mlcp::Kernels& kernels) {
      Case other = c;
      other.A *= scale;
      other.eliminate(kernels);
      for (int p = 0; p < c.size; ++p) ASSERT_NEAR(other.inverse[p] * scale, c.inverse[p], 1e-13 * c.inverse[p]);
      ASSERT_LT((other.L() - c.L()).cwiseAbs().maxCoeff(), 1e-13);
    });
}

TEST_F(BlockLdl, SaysWhichRowHasNoPivot) {
  for (int seed = 0; seed < 100; ++seed) {
    Random random(seed);
    Case c(random, 3);
    const int row = random.integer(0, 3);
    c.A(8 + row, 8 + row) = -1;
    for (const mlcp::Kernels* kernels : kernels_of_this_cpu()) {
      for (int b = 0; b < 2; ++b) ASSERT_EQ(c.eliminate(*kernels, b), 4);
      ASSERT_EQ(c.eliminate(*kernels, 2), row);
    }
    const double least[4] = {1e3, 0, 0, 0};
    EXPECT_EQ(c.eliminate(mlcp::portable_kernels, 1, least), 0);
  }
}

TEST_F(BlockLdl, NegativePivotsCountWhereALeastSizeIsAskedFor) {
  for (int seed = 0; seed < 100; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    Case c(random, 3);
    const int row = 8 + random.integer(0, 3);
    c.A(row, row) = -2;
    const double least[4] = {1e-9, 1e-9, 1e-9, 1e-9};
    for (int b = 0; b < 3; ++b) ASSERT_EQ(c.eliminate(mlcp::portable_kernels, b, least), 4);
    const Eigen::MatrixXd l = c.L(), product = l * Eigen::Map<Eigen::VectorXd>(c.inverse.data(), c.size).cwiseInverse().asDiagonal() * l.transpose();
    ASSERT_LT((product - c.A).cwiseAbs().maxCoeff(), 1e-10);
    ASSERT_LT(c.inverse[row], 0);
  }
}

}  // namespace
}  // namespace support
