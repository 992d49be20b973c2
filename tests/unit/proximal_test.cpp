// The descent on the proximal problem against f of proximal.h by its definition: where a line search goes wrong, other methods would mend it unseen.
#include "solve/proximal.h"

#include <gtest/gtest.h>

#include "support/based.h"
#include "support/dense.h"
#include "support/random_problem.h"

namespace support {
namespace {

constexpr double epsilon = 1e-2;

/// Gradient of f at v, δ = 0.
Vector gradient(const Based& b, const Dense& d, const Vector& v) {
  Vector g = d.M * v - d.k;
  const Vector w = d.J * v - d.r;
  for (int i = 0; i < d.m(); ++i) {
    const int o = b.ordinal(i);
    const Real e = static_cast<Real>(epsilon) * b.basis.values.a[o], c = -b.basis.work.center[b.basis.position(o)];
    const Real gamma = (e * c - w[i]) / (d.S(i, i) + e);
    g -= std::clamp(gamma, d.lo[i], d.hi[i]) * d.J.row(i).transpose();
  }
  return g;
}

Vector point(const Based& b, int n) {
  Vector v(n);
  for (int j = 0; j < n; ++j) v[j] = b.basis.work.point[b.analysis.pattern.position[j]];
  return v;
}

TEST(Proximal, DescentGoesToTheMinimumOnEachLineAndEndsAtThatOfAll) {
  int steps = 0, partial = 0;
  for (int seed = 0; seed < 100; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    Based b(random_chain(random, random.integer(2, 30), 3, 1));
    const Dense d = dense(b.problem);
    mlcp::Proximal proximal(b.basis, b.counts);
    proximal.enter(b.island());
    proximal.center_here(b.island());
    ASSERT_TRUE(proximal.soften(b.island(), epsilon, 0, 0));
    proximal.newton_point(b.island());
    proximal.start_descent(b.island());
    for (int outer = 0; outer < 3; ++outer) {
      bool ended = false;
      for (int step = 0; step < 60 && !ended; ++step) {
        const auto flips = proximal.flips_of_descent(b.island());
        if ((ended = step > 0 && flips.empty())) break;
        b.basis.change(b.island(), flips, 0, b.counts);
        const Vector from = point(b, d.n());
        const double t = proximal.descend(b.island());
        const Vector to = point(b, d.n()), way = to - from;
        const Real slope = gradient(b, d, from).dot(way), rest = gradient(b, d, to).dot(way);
        EXPECT_LE(slope, 1e-12 * d.k.norm() * way.norm());
        EXPECT_LE(std::abs(rest), 1e-8 * std::abs(slope) + 1e-12 * d.k.norm() * way.norm());
        ++steps;
        partial += std::abs(t - 1) > 1e-6;
      }
      EXPECT_TRUE(ended);
      EXPECT_LE(gradient(b, d, point(b, d.n())).norm(), 1e-9 * d.k.norm());
      proximal.recenter(b.island());
    }
  }
  EXPECT_GT(steps, 200);
  EXPECT_GT(partial, 50);
}

}  // namespace
}  // namespace support
