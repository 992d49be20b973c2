#include "factorize/mass_response.h"

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "analyze/analysis.h"
#include "support/dense.h"
#include "support/random_problem.h"

namespace support {
namespace {

TEST(MassResponse, IsTheColumnOfInverseMassTimesJacobian) {
  for (int seed = 0; seed < 40; ++seed) {
    Random random(seed);
    const mlcp::Problem p = random_chain(random, random.integer(1, 6), random.integer(1, 6), 1);
    mlcp::Analysis analysis{mlcp::Memory()};
    analysis.run(p, nullptr, true, {});
    mlcp::KktValues values{mlcp::Memory()};
    values.load(p, analysis.pattern);
    mlcp::MassResponse response{mlcp::Memory()};
    response.prepare(analysis.parts, analysis.pattern);
    std::int64_t work = 0;
    const Dense d = dense(p);
    const Matrix inverse = d.M.inverse();
    for (const mlcp::Island& island : analysis.symbolic.islands) {
      ASSERT_TRUE(response.compute(island, values, work));
      for (std::int32_t o = island.first_row; o < island.last_row; ++o) {
        const int row = analysis.pattern.node[analysis.pattern.row_position[o]] - p.n();
        const Vector expected = inverse * d.J.row(row).transpose();
        std::vector<double> x(analysis.pattern.size(), 0.0);
        response.velocity.assign(response.velocity.size(), 0.0);
        response.rows().add(o, 1, response.velocity.data());
        response.give(island, x.data());
        ASSERT_NEAR(response.rows().product(o, response.velocity.data()), static_cast<double>(d.J.row(row) * expected), 1e-12) << "seed " << seed;
        for (int j = 0; j < p.n(); ++j) ASSERT_NEAR(x[analysis.pattern.position[j]], static_cast<double>(expected[j]), 1e-12) << "seed " << seed;
        ASSERT_NEAR(response.diagonal[o], static_cast<double>(d.J.row(row) * expected), 1e-12) << "seed " << seed;
      }
    }
  }
}

TEST(MassResponse, LargePartsAndIndefiniteOnesAreRefused) {
  Random random(2);
  for (const bool large : {true, false}) {
    mlcp::Problem p = empty_problem();
    if (large)
      add_sparse_body(p, random_mass(random, mlcp::MassParts::largest + 1, false));
    else
      add_sparse_body(p, (Eigen::Matrix2d() << 1, 2, 2, 1).finished());
    add_row(p, {{0, 1}});
    mlcp::Analysis analysis{mlcp::Memory()};
    analysis.run(p, nullptr, true, {});
    mlcp::KktValues values{mlcp::Memory()};
    values.load(p, analysis.pattern);
    mlcp::MassResponse response{mlcp::Memory()};
    response.prepare(analysis.parts, analysis.pattern);
    std::int64_t work = 0;
    EXPECT_FALSE(response.compute(analysis.symbolic.islands[0], values, work));
  }
}

}  // namespace
}  // namespace support
