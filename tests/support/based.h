#pragma once
#include <gtest/gtest.h>

#include "analyze/analysis.h"
#include "solve/basis.h"

namespace support {

/// A problem with its basis, started from the mask and factored.
struct Based {
  mlcp::Problem problem;
  mlcp::Analysis analysis{mlcp::Memory()};
  mlcp::Basis basis{mlcp::Memory()};
  mlcp::Settings settings;
  mlcp::Counts counts;

  explicit Based(mlcp::Problem p, const mlcp::Mask* start = nullptr, mlcp::Settings s = mlcp::default_settings())
      : problem(std::move(p)), settings(s) {
    analysis.run(problem, nullptr, true, {});
    basis.prepare(problem, analysis, settings);
    basis.set.start(problem, analysis.pattern, basis.values, nullptr, start);
    EXPECT_TRUE(basis.refactorize(island(), mlcp::lost_pivot, counts));
  }
  const mlcp::Island& island() const { return analysis.symbolic.islands[0]; }
  int ordinal(int row) const { return analysis.pattern.row_ordinal[analysis.pattern.position[problem.n() + row]]; }
  mlcp::ActiveSet::State state(int row) const { return static_cast<mlcp::ActiveSet::State>(basis.set.state[ordinal(row)]); }
  /// A row is in the factor if and only if it is active.
  void expect_in_step() const {
    for (int o = 0; o < analysis.pattern.rows(); ++o)
      EXPECT_EQ(basis.factor.in(basis.position(o)), basis.set.state[o] == mlcp::ActiveSet::active) << o;
  }
};

}  // namespace support
