// Every family over its parameter, by every method: the answer that is known, with an error recomputed here of at most 1e-12, or the truth that
// there is none.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "hard/cases/case.h"
#include "hard/solution.h"

namespace hard {
namespace {

constexpr double tolerance = 1e-12, tolerance_of_friction = 1e-9, tolerance_of_sweeps = 1e-9;
constexpr std::int64_t most_sweeps = 2000;

double largest(const std::vector<double>& x) {
  double most = 0;
  for (const double y : x) most = std::max(most, std::abs(y));
  return most;
}

/// max |v − known| / max |known|
double distance(const std::vector<double>& v, const std::vector<double>& known) {
  double worst = 0;
  for (std::size_t j = 0; j < known.size(); ++j) worst = std::max(worst, std::abs(v[j] - known[j]));
  const double scale = largest(known);
  return scale > 0 ? worst / scale : worst;
}

/// Whether an outcome is what is to be said of a case.
bool fits(mlcp_outcome outcome, Fate fate) {
  switch (fate) {
    case Fate::solved: return outcome == MLCP_SOLVED;
    case Fate::infeasible: return outcome == MLCP_INFEASIBLE;
    // only a singular mass can be, which may be what is told
    case Fate::unbounded: return outcome == MLCP_UNBOUNDED || outcome == MLCP_NOT_POSITIVE_DEFINITE;
    case Fate::told: return outcome == MLCP_SOLVED || outcome == MLCP_INFEASIBLE;
  }
  return false;
}

/// What may never be, by any method: success or a proof that the numbers do not bear out.
void expect_true(const mlcp_problem* problem, const Solution& s, double within) {
  const double error = largest_error(problem, s.v, s.gamma);
  if (s.report.outcome == MLCP_SOLVED) {
    EXPECT_LE(error, within);
    // the library sums in double: a sum of n terms is right to n half units of its terms
    const double rounding = 0.5 * 2.2e-16 * (static_cast<double>(s.v.size()) + static_cast<double>(s.gamma.size()));
    EXPECT_LE(std::abs(error - s.report.largest_error), 1e-15 + rounding + 1e-3 * error) << "the report says " << s.report.largest_error;
  }
  if (s.report.outcome == MLCP_INFEASIBLE) {
    EXPECT_EQ(certificate_fault(problem, s.certificate_row, s.certificate_y), "");
  }
}

class HardCase : public testing::TestWithParam<Family> {
 protected:
  template <class Look>
  void sweep(Look look) {
    for (const double value : GetParam().values) {
      if (value > MLCP_HARD_LONGEST && std::string(GetParam().parameter) == "links") continue;
      SCOPED_TRACE(GetParam().name + std::string(", ") + GetParam().parameter + " " + std::to_string(value));
      look(GetParam().make(value));
    }
  }
  void by(mlcp_method method) {
    sweep([&](const Case& c) {
      // the iteration for friction ends at its tolerance, all else at rounding
      const double asked = mlcp_problem_contact_count(c.problem.get()) > 0 ? tolerance_of_friction : tolerance;
      const Solution s = solve(c.problem.get(), method, asked);
      expect_true(c.problem.get(), s, asked);
      EXPECT_TRUE(fits(s.report.outcome, c.fate)) << mlcp_outcome_text(s.report.outcome) << ", error " << s.report.largest_error;
      if (s.report.outcome == MLCP_SOLVED && !c.v.empty()) {
        EXPECT_LE(distance(s.v, c.v), c.v_accuracy);
      }
    });
  }
};

TEST_P(HardCase, Simplex) { by(MLCP_METHOD_SIMPLEX); }
TEST_P(HardCase, Newton) { by(MLCP_METHOD_NEWTON); }
TEST_P(HardCase, Auto) { by(MLCP_METHOD_AUTO); }

/// Sweeps may end at their limit, but say so.
TEST_P(HardCase, SweepsAreHonest) {
  sweep([&](const Case& c) {
    const Solution s = solve(c.problem.get(), MLCP_METHOD_PGS, tolerance_of_sweeps, most_sweeps);
    expect_true(c.problem.get(), s, tolerance_of_sweeps);
    if (c.fate == Fate::infeasible || c.fate == Fate::unbounded) {
      EXPECT_NE(s.report.outcome, MLCP_SOLVED);
    }
  });
}

std::string test_name(const testing::TestParamInfo<Family>& chosen) {
  std::string name = chosen.param.name;
  std::replace_if(name.begin(), name.end(), [](char c) { return !std::isalnum(static_cast<unsigned char>(c)); }, '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(Of, HardCase, testing::ValuesIn(families().begin(), families().end()), test_name);

}  // namespace

void PrintTo(const Family& family, std::ostream* out) { *out << family.name; }

}  // namespace hard
