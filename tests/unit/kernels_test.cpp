// The portable loops and those for AVX2 and AVX-512 give the same bits: on every CPU the same results.
#include "factorize/kernels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>
#include <vector>

#include "support/kernels.h"
#include "support/random.h"

namespace support {
namespace {

/// A stretch of nested columns with rows scattered over a vector, some columns out.
struct Columns {
  std::vector<std::int64_t> pointers{0};
  std::vector<std::int32_t> rows;
  std::vector<double> values, pivot, inverse, gathered, x;
  std::vector<std::uint8_t> in;
  mlcp::Stretch stretch{};

  Columns(Random& random, int columns, int tail) : stretch{0, columns, columns - 1 + tail, nullptr} {
    const int size = columns + 3 * tail + 1;
    for (int j = 1; j < columns; ++j) rows.push_back(j);
    for (int i = 0; i < tail; ++i) rows.push_back(columns + 3 * i + random.integer(0, 2));
    stretch.rows = rows.data();
    for (int j = 0; j < columns; ++j) {
      in.push_back(random.chance(0.7));
      pivot.push_back(in[j] ? random.uniform() + (j % 2 ? 3 : -3) : 0);
      inverse.push_back(in[j] ? 1 / pivot[j] : 0);
      for (int i = j; i < columns - 1 + tail; ++i) values.push_back(in[j] && random.chance(0.9) ? random.uniform() : 0);
      pointers.push_back(static_cast<std::int64_t>(values.size()));
    }
    for (int i = 0; i < size; ++i) x.push_back(i < columns && !in[i] ? 0 : random.uniform());
    gathered.resize(size);
  }
  mlcp::FactorArrays arrays() { return {values.data(), pointers.data(), in.data(), pivot.data(), inverse.data(), gathered.data()}; }
};

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0);
}

class Kernels : public testing::Test {
 protected:
  template <class Run>
  void compare(Run run) {
    for (const mlcp::Kernels* other : kernels_of_this_cpu())  // the portable ones alone where there is no AVX2: then this proves nothing
    for (int seed = 0; seed < 3000; ++seed) {
      Random random(seed);
      const int columns = random.integer(1, 14), tail = random.integer(0, 23);
      Columns a(random, columns, tail), b = a;
      b.stretch.rows = b.rows.data();
      const auto of_a = run(mlcp::portable_kernels, a), of_b = run(*other, b);
      ASSERT_EQ(of_a, of_b) << "seed " << seed;
      ASSERT_TRUE(same_bits(a.x, b.x) && same_bits(a.values, b.values) && same_bits(a.pivot, b.pivot)) << "seed " << seed;
    }
  }
};

TEST_F(Kernels, ForwardGivesTheSameBits) {
  compare([](const mlcp::Kernels& k, Columns& c) { return k.forward(c.arrays(), c.stretch, c.x.data()); });
}

TEST_F(Kernels, BackwardGivesTheSameBits) {
  compare([](const mlcp::Kernels& k, Columns& c) { return k.backward(c.arrays(), c.stretch, c.x.data()); });
}

TEST_F(Kernels, RankOneGivesTheSameBits) {
  compare([](const mlcp::Kernels& k, Columns& c) {
    double sigma = 0.25;
    return std::pair(k.rank_one(c.arrays(), c.stretch, c.x.data(), sigma), sigma);
  });
}

/// Against the sums written down literally.
TEST_F(Kernels, BackwardSolvesTheTransposedColumns) {
  for (int seed = 0; seed < 1000; ++seed) {
    Random random(seed);
    Columns c(random, random.integer(1, 14), random.integer(0, 23));
    std::vector<double> x = c.x;
    for (int j = c.stretch.last - 1; j >= 0; --j) {
      double sum = 0;
      for (std::int64_t t = c.pointers[j]; t < c.pointers[j + 1]; ++t) sum += c.values[t] * x[c.rows[j + t - c.pointers[j]]];
      x[j] = c.in[j] ? (x[j] - sum) / c.pivot[j] : 0;
    }
    mlcp::portable_kernels.backward(c.arrays(), c.stretch, c.x.data());
    for (std::size_t i = 0; i < x.size(); ++i) ASSERT_NEAR(c.x[i], x[i], 1e-12 * (1 + std::abs(x[i]))) << "seed " << seed << " at " << i;
  }
}

/// Columns with equal rows that do not act on each other are solved with as if each stood alone.
TEST_F(Kernels, EqualColumnsAreSolvedWithAsOneByOne) {
  for (const mlcp::Kernels* kernels : kernels_of_this_cpu())
    for (int seed = 0; seed < 500; ++seed) {
      Random random(seed);
      const int columns = random.integer(1, 11), tail = random.integer(1, 19);
      Columns together(random, columns, tail);
      together.stretch.count = tail;
      together.stretch.rows += columns - 1;
      together.stretch.equal = true;
      for (int j = 0; j < columns; ++j) together.pointers[j + 1] = std::int64_t{tail} * (j + 1);
      together.values.resize(static_cast<std::size_t>(columns) * tail);
      for (double& entry : together.values) entry = random.uniform();
      Columns apart = together;
      const auto alone = [&](int j) {
        mlcp::Stretch s = together.stretch;
        s.first = j;
        s.last = j + 1;
        s.equal = false;
        return s;
      };
      kernels->forward(together.arrays(), together.stretch, together.x.data());
      for (int j = 0; j < columns; ++j) kernels->forward(apart.arrays(), alone(j), apart.x.data());
      ASSERT_TRUE(same_bits(together.x, apart.x)) << "forward, seed " << seed;
      kernels->backward(together.arrays(), together.stretch, together.x.data());
      for (int j = columns - 1; j >= 0; --j) kernels->backward(apart.arrays(), alone(j), apart.x.data());
      for (int j = 0; j < columns; ++j)  // of a column that is out, x is 0 or left as it is
        ASSERT_TRUE(!together.in[j] || together.x[j] == apart.x[j]) << "backward, seed " << seed;
    }
}

/// Σ_j c_j c_jᵀ / d_j on top of what is there, each entry summed in order of j, on either CPU.
TEST_F(Kernels, ProductsSumOuterProductsInOrder) {
  for (int seed = 0; seed < 500; ++seed) {
    Random random(seed);
    const int count = random.integer(1, 16), columns = random.integer(1, 40), stride = (count + 3) / 4 * 4;
    std::vector<std::vector<double>> c(columns, std::vector<double>(count));
    std::vector<const double*> pointers;
    std::vector<double> inverse(columns), before(static_cast<std::size_t>(stride) * stride);
    for (double& entry : before) entry = random.uniform();
    for (int k = 0; k < columns; ++k) {
      inverse[k] = random.uniform();
      for (double& entry : c[k]) entry = random.uniform();
      pointers.push_back(c[k].data());
    }
    for (const mlcp::Kernels* kernels : kernels_of_this_cpu()) {
      std::vector<double> block = before;
      kernels->products(count, columns, pointers.data(), inverse.data(), block.data());
      for (int a = 0; a < count; ++a)
        for (int b = a; b < count; ++b) {
          double expected = before[stride * a + b];
          for (int k = 0; k < columns; ++k) expected += c[k][b] * (c[k][a] * inverse[k]);
          ASSERT_EQ(block[stride * a + b], expected) << "seed " << seed << " at " << a << ", " << b;
        }
    }
  }
}

/// Σ_k f_k c_k, each entry summed in order of k, on either CPU.
TEST_F(Kernels, CombineSumsColumnsInOrder) {
  for (int seed = 0; seed < 500; ++seed) {
    Random random(seed);
    const int count = random.integer(0, 21), columns = random.integer(1, 33);
    std::vector<std::vector<double>> c(columns, std::vector<double>(count));
    std::vector<const double*> pointers;
    std::vector<double> f(columns), expected(count, 0.0);
    for (int k = 0; k < columns; ++k) {
      f[k] = random.uniform();
      for (double& entry : c[k]) entry = random.uniform();
      pointers.push_back(c[k].data());
      for (int i = 0; i < count; ++i) expected[i] += c[k][i] * f[k];
    }
    for (const mlcp::Kernels* kernels : kernels_of_this_cpu()) {
      std::vector<double> sum(count, 1e300);
      kernels->combine(count, columns, pointers.data(), f.data(), sum.data());
      ASSERT_EQ(sum, expected) << "seed " << seed;
    }
  }
}

/// Random rows of a dense A with explicit zeros, in rows of `stride` entries, and impulses.
struct DenseRows {
  int size, stride;
  std::vector<double> a, inverse, b, lo, hi, gamma;
  std::vector<std::uint8_t> state;

  explicit DenseRows(Random& random) : size(random.integer(1, 37)), stride((size + 3) / 4 * 4), a(stride * stride), b(stride) {
    for (int i = 0; i < size; ++i)
      for (int j = 0; j < i; ++j) a[i * stride + j] = a[j * stride + i] = random.chance(0.7) ? random.uniform() : 0;
    for (int i = 0; i < size; ++i) {
      a[i * stride + i] = size;
      b[i] = random.uniform();
      inverse.push_back(random.chance(0.9) ? 1.0 / size : 0);
      lo.push_back(random.chance(0.8) ? 0 : -1e300);
      hi.push_back(random.chance(0.8) ? 1e300 : 0.01);
      gamma.push_back(random.chance(0.5) ? random.uniform(0, 0.01) : 0);
      state.push_back(mlcp::DenseSweep::between);
    }
  }
  /// A γ + b, and the magnitude of the terms.
  std::pair<double, double> slack(int i) const {
    double w = b[i], terms = std::abs(b[i]);
    for (int j = 0; j < size; ++j) w += a[i * stride + j] * gamma[j], terms += std::abs(a[i * stride + j] * gamma[j]);
    return {w, terms};
  }
};

/// Each impulse in turn makes its row's slack 0 or comes to rest at a bound, and the slacks go with the impulses.
TEST_F(Kernels, ImpulseSweepIsProjectedGaussSeidel) {
  for (const mlcp::Kernels* kernels : kernels_of_this_cpu())
    for (int seed = 0; seed < 500; ++seed) {
      Random random(seed);
      DenseRows one(random), expected = one, portable = one;
      const auto sweep = [](const mlcp::Kernels& by, DenseRows& r) {
        std::vector<double> w(r.stride);
        for (int i = 0; i < r.size; ++i) w[i] = r.slack(i).first;
        const bool changed = by.impulse_sweep({r.size, r.stride, r.a.data(), r.inverse.data(), r.lo.data(), r.hi.data(), r.gamma.data(), w.data(), r.state.data()});
        return std::pair(w, changed);
      };
      bool any = false;
      for (int i = 0; i < expected.size; ++i) {
        if (expected.inverse[i] == 0) continue;
        const double free = expected.gamma[i] - expected.slack(i).first / one.size;
        const auto state = free <= one.lo[i] ? mlcp::DenseSweep::at_lower : free >= one.hi[i] ? mlcp::DenseSweep::at_upper : mlcp::DenseSweep::between;
        expected.gamma[i] = std::clamp(free, one.lo[i], one.hi[i]);
        any |= state != expected.state[i];
        expected.state[i] = state;
      }
      const auto [w, changed] = sweep(*kernels, one);
      ASSERT_EQ(changed, any) << "seed " << seed;
      ASSERT_EQ(one.state, expected.state) << "seed " << seed;
      for (int i = 0; i < one.size; ++i) {
        ASSERT_NEAR(one.gamma[i], expected.gamma[i], 1e-14) << "seed " << seed << " at " << i;
        ASSERT_NEAR(w[i], expected.slack(i).first, 1e-13) << "seed " << seed << " at " << i;
      }
      ASSERT_TRUE(same_bits(w, sweep(mlcp::portable_kernels, portable).first) && same_bits(one.gamma, portable.gamma)) << "seed " << seed;
    }
}

/// Only the fours asked for, each entry summed in the order of the columns, on every CPU.
TEST_F(Kernels, ColumnProductsSumInTheOrderOfTheList) {
  for (const mlcp::Kernels* kernels : kernels_of_this_cpu())
    for (int seed = 0; seed < 500; ++seed) {
      Random random(seed);
      const DenseRows r(random);
      std::vector<std::int32_t> columns, fours;
      for (int j = 0; j < r.size; ++j)
        if (random.chance(0.5)) columns.push_back(j);
      for (int b = 0; b < r.stride / 4; ++b)
        if (random.chance(0.6)) fours.push_back(b);
      std::vector<double> sum(r.stride, -7), size = sum, expected = sum, sizes = sum;
      for (const int b : fours)
        for (int i = 4 * b; i < 4 * b + 4; ++i) {
          expected[i] = sizes[i] = 0;
          for (const int j : columns) expected[i] += r.a[j * r.stride + i] * r.gamma[j], sizes[i] += std::abs(r.a[j * r.stride + i] * r.gamma[j]);
        }
      kernels->column_products({static_cast<int>(fours.size()), fours.data()}, {static_cast<int>(columns.size()), columns.data()}, r.stride, r.a.data(),
                               r.gamma.data(), sum.data(), size.data());
      ASSERT_EQ(sum, expected) << "seed " << seed;
      ASSERT_EQ(size, sizes) << "seed " << seed;
    }
}

TEST_F(Kernels, DiagonalsAreSolvedAndMeasuredEntryByEntry) {
  constexpr double huge = 1.7e308, nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  for (const mlcp::Kernels* kernels : kernels_of_this_cpu())
    for (int count = 1; count <= 19; ++count)
      for (int odd = 0; odd < count; ++odd) {
        Random random(100 * count + odd);
        std::vector<double> d(count), k(count), x(count);
        for (int i = 0; i < count; ++i) {
          d[i] = 1.5 + random.uniform();
          k[i] = random.uniform();
        }
        ASSERT_TRUE(kernels->diagonal_solve(count, d.data(), k.data(), x.data()));
        double largest = 0, expected = 0.25;
        for (int i = 0; i < count; ++i) {
          ASSERT_EQ(x[i], k[i] / d[i]);
          largest = std::max(largest, std::abs(d[i] * x[i] - k[i]));
        }
        double found = 0;
        EXPECT_TRUE(kernels->diagonal_within(count, d.data(), x.data(), k.data(), 1e-15, &found));
        EXPECT_EQ(found, largest);
        x[odd] += expected / d[odd];
        expected = std::abs(d[odd] * x[odd] - k[odd]);
        EXPECT_FALSE(kernels->diagonal_within(count, d.data(), x.data(), k.data(), 1e-15, &found));
        EXPECT_EQ(found, expected);
        // a residual of which the terms are out of range, and what is no number
        d[odd] = 1;
        for (const auto& [velocity, momentum] : {std::pair(huge, huge / 2), {nan, 1.0}, {inf, 1.0}, {1.0, nan}}) {
          x[odd] = velocity;
          k[odd] = momentum;
          EXPECT_FALSE(kernels->diagonal_within(count, d.data(), x.data(), k.data(), 1, &found)) << velocity;
        }
        for (const double no_mass : {0.0, -0.0, -1.0}) {
          d[odd] = no_mass;
          EXPECT_FALSE(kernels->diagonal_solve(count, d.data(), k.data(), x.data()));
          EXPECT_EQ(x[odd], 0);
        }
      }
}

}  // namespace
}  // namespace support
