// What is not a problem of this kind is refused before any solve, with the argument and the index; an indefinite sparse mass in the solve.
#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <string>

#include "hard/cases/sketch.h"
#include "hard/solution.h"

namespace hard {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// The text with which the library refuses.
std::string refusal(const std::function<void(Sketch&)>& add) {
  Sketch s;
  s.body(2, 1);
  try {
    add(s);
  } catch (const std::exception& error) {
    return error.what();
  }
  return "";
}

void expect_named(const std::function<void(Sketch&)>& add, const char* argument) {
  const std::string text = refusal(add);
  EXPECT_NE(text.find(argument), std::string::npos) << (text.empty() ? "not refused" : text);
}

std::function<void(Sketch&)> reduced(std::int32_t rows, std::vector<double> A) {
  return [=](Sketch& s) {
    for (int i = 0; i < rows; ++i) s.row({}, 1);
    s.compliance(rows, A);
  };
}

TEST(Refused, NotANumber) {
  expect_named([](Sketch& s) { s.body(1, nan); }, "mass");
  expect_named([](Sketch& s) { s.momentum({0, nan}); }, "k[1]");
  expect_named([](Sketch& s) { s.row({{0, nan}}); }, "values[0]");
  expect_named([](Sketch& s) { s.row({{0, 1}}, nan); }, "r");
  expect_named([](Sketch& s) { s.row({{0, 1}}, 0, {nan, 1}); }, "lo");
  expect_named([](Sketch& s) { s.row({{0, 1}}, 0, unilateral, nan); }, "compliance");
}

TEST(Refused, InfinityWhereItIsNotABound) {
  expect_named([](Sketch& s) { s.body(1, inf); }, "mass");
  expect_named([](Sketch& s) { s.momentum({-inf, 0}); }, "k[0]");
  expect_named([](Sketch& s) { s.row({{1, inf}}); }, "values[0]");
  expect_named([](Sketch& s) { s.row({{0, 1}}, -inf); }, "r");
  expect_named([](Sketch& s) { s.row({{0, 1}}, 0, {inf, inf}); }, "lo");
}

TEST(Refused, BoundsThatCross) { expect_named([](Sketch& s) { s.row({{0, 1}}, 0, {1, -1}); }, "lo"); }
TEST(Refused, NegativeCompliance) { expect_named([](Sketch& s) { s.row({{0, 1}}, 0, unilateral, -1e-3); }, "compliance"); }
TEST(Refused, TheSameVelocityTwiceInARow) { expect_named([](Sketch& s) { s.row({{0, 1}, {0, 2}}); }, "column"); }
TEST(Refused, VelocityThatIsNotThere) { expect_named([](Sketch& s) { s.row({{2, 1}}); }, "columns[0]"); }
TEST(Refused, NegativeMass) { expect_named([](Sketch& s) { s.body(1, -1); }, "mass"); }

TEST(Refused, NegativeFriction) {
  expect_named([](Sketch& s) {
    s.row({{0, 1}});
    s.row({{1, 1}}, 0, bilateral);
    s.coulomb(0, 2, -0.1);
  }, "mu");
}

/// Murty's and Kostreva's matrices make pivoting methods exponential, and are not symmetric.
TEST(Refused, MurtysMatrix) { expect_named(reduced(3, {1, 0, 0, 2, 1, 0, 2, 2, 1}), "symmetric"); }
TEST(Refused, KostrevasMatrix) { expect_named(reduced(3, {1, 0, 2, 2, 1, 0, 0, 2, 1}), "symmetric"); }

TEST(Refused, AsymmetricOrIndefiniteMass) {
  const Problem problem = handles::make_problem();
  const double asymmetric[] = {2, 1, 1 + 1e-9, 2}, indefinite[] = {1, 2, 2, 1};
  EXPECT_EQ(mlcp_problem_bodies_add(problem.get(), 1, 2, asymmetric, 0, nullptr), MLCP_ERROR_ARGUMENT);
  EXPECT_NE(std::string(mlcp_problem_error(problem.get())).find("symmetric"), std::string::npos) << mlcp_problem_error(problem.get());
  EXPECT_EQ(mlcp_problem_bodies_add(problem.get(), 1, 2, indefinite, 0, nullptr), MLCP_ERROR_ARGUMENT);
  EXPECT_NE(std::string(mlcp_problem_error(problem.get())).find("definite"), std::string::npos) << mlcp_problem_error(problem.get());
}

TEST(Refused, IndefiniteSparseMassNamesTheBody) {
  for (const mlcp_method method : {MLCP_METHOD_SIMPLEX, MLCP_METHOD_NEWTON, MLCP_METHOD_AUTO}) {
    const Problem problem = handles::make_problem();
    const std::int32_t pointers[] = {0, 2, 4}, rows[] = {0, 1, 0, 1};
    const double fine[] = {2, 1, 1, 2}, indefinite[] = {1, 2, 2, 1};
    std::int32_t body = -1;
    for (const double* mass : {fine, indefinite})
      handles::check(mlcp_problem_body_add_sparse(problem.get(), 2, pointers, rows, mass, MLCP_FULL, &body), problem);
    const std::int32_t columns[] = {0, 2};
    const double values[] = {1, -1};
    handles::check(mlcp_problem_row_add(problem.get(), 2, columns, values, 0, 0, inf, 0, 0, nullptr), problem);
    const Solution s = solve(problem.get(), method, 1e-9);
    EXPECT_EQ(s.report.outcome, MLCP_NOT_POSITIVE_DEFINITE) << mlcp_method_text(method);
    EXPECT_EQ(s.report.worst_body, body);
  }
}

}  // namespace
}  // namespace hard
