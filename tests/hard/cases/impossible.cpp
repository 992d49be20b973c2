// What has no solution, and what nearly has none.
#include <cmath>

#include "hard/cases/sketch.h"

namespace hard {
namespace {

/// A body between two walls that close at that speed each.
Case squeezed(double speed) {
  Sketch s;
  const auto body = s.body(1, 1), left = s.body(1, 1), right = s.body(1, 1);
  s.momentum({0, 0, 0});
  s.prescribe(left, {speed});
  s.prescribe(right, {-speed});
  s.row({{body, 1}, {left, -1}});
  s.row({{right, 1}, {body, -1}});
  return {s.take(), Fate::infeasible};
}

/// The same with a row of bodies between, each with a bystander on top that has nothing to do with it.
Case squeezed_row(double bodies) {
  Sketch s;
  const int n = static_cast<int>(bodies);
  for (int i = 0; i < n; ++i) s.body(2, 1 + i % 3);
  const auto left = s.body(1, 1), right = s.body(1, 1);
  s.prescribe(left, {1});
  s.prescribe(right, {-1});
  for (int i = 0; i < n; ++i) s.row({{2 * i + 1, 1}}, 0.1);
  s.row({{0, 1}, {left, -1}});
  for (int i = 1; i < n; ++i) s.row({{2 * i, 1}, {2 * i - 2, -1}});
  s.row({{right, 1}, {2 * n - 2, -1}});
  return {s.take(), Fate::infeasible};
}

/// Two joints in one direction that ask for different speeds, 10^−power apart.
Case joints_that_differ(double power) {
  Sketch s;
  s.body(2, 1);
  s.momentum({1, 1});
  s.row({{0, 3}, {1, 4}}, 5, bilateral);
  s.row({{0, 6}, {1, 8}}, 10 * (1 + std::pow(10.0, -power)), bilateral);
  return {s.take(), power <= 8 ? Fate::infeasible : power <= 12 ? Fate::told : Fate::solved};
}

/// Walls that follow each other at 1 m/s and 1 m/s ∓ 10^−power: they close (infeasible) or leave that much room.
Case follow(double power, bool closing) {
  Sketch s;
  s.body(1, 1);
  s.momentum({0});
  const double ahead = closing ? 1 - std::pow(10.0, -power) : 1 + std::pow(10.0, -power);
  s.row({{0, 1}}, 1);
  s.row({{0, -1}}, -ahead);
  // 1e-9, the tolerance, lies between
  const Fate fate = !closing || power >= 12 ? Fate::solved : power <= 8 ? Fate::infeasible : Fate::told;
  return {s.take(), fate, fate == Fate::solved ? std::vector<double>{1} : std::vector<double>{}, 1e-12};
}
Case almost_infeasible(double power) { return follow(power, false); }
Case almost_feasible(double power) { return follow(power, true); }

/// A loop of bars whose drive asks for what the joints forbid.
Case driven_loop(double bars) {
  Sketch s;
  const int n = static_cast<int>(bars);
  for (int i = 0; i < n; ++i) s.body(1, 1);
  for (int i = 0; i < n; ++i) s.row({{i, 1}, {(i + 1) % n, -1}}, i == 0 ? 0.5 : 0, bilateral);
  s.row({{0, 1}}, 2, unilateral);
  return {s.take(), Fate::infeasible};
}

/// n = 0, A = 0 in a direction in which b pulls: the dual is unbounded, which for a reduced problem is infeasible.
Case singular_reduced(double rows) {
  Sketch s;
  const int m = static_cast<int>(rows);
  for (int i = 0; i < m; ++i) s.row({}, 1);
  std::vector<double> A(static_cast<std::size_t>(m) * m, 0.0);
  for (int i = 0; i < m; ++i)
    for (int j = 0; j < m; ++j) A[static_cast<std::size_t>(i) * m + j] = (i + j) % 2 ? -1 : 1;
  s.compliance(m, A);
  return {s.take(), Fate::infeasible};
}

/// A body without mass in one direction that is pushed that way, down a slope that nothing closes.
Case massless_slide(double push) {
  Problem problem = handles::make_problem();
  const std::int32_t pointers[] = {0, 1, 2}, rows[] = {0, 1};
  const double mass[] = {1, 0}, k[] = {0, push};
  const std::int32_t columns[] = {0, 1};
  const double jacobian[] = {1, 1};
  handles::check(mlcp_problem_body_add_sparse(problem.get(), 2, pointers, rows, mass, MLCP_FULL, nullptr), problem);
  handles::check(mlcp_problem_set_momentum(problem.get(), 0, 2, k), problem);
  handles::check(mlcp_problem_row_add(problem.get(), 2, columns, jacobian, 0, 0, inf, 0, 0, nullptr), problem);
  return {std::move(problem), Fate::unbounded};
}

}  // namespace

std::vector<Family> impossible_families() {
  const std::vector<double> powers{1, 2, 4, 6, 8, 10, 12, 14, 15};
  return {{"closing walls", "m/s", {1e-12, 1e-9, 1e-6, 1e-3, 1, 1e6}, squeezed},
          {"row of bodies between closing walls", "bodies", {1, 3, 10, 100, 1000}, squeezed_row},
          {"joints that differ by 10^-p", "p", powers, joints_that_differ},
          {"walls with 10^-p of room", "p", powers, almost_infeasible},
          {"walls that lack 10^-p of room", "p", powers, almost_feasible},
          {"driven loop", "bars", {2, 3, 10, 100}, driven_loop},
          {"reduced, of rank 1", "rows", {2, 3, 10, 40}, singular_reduced},
          {"without mass, pushed", "push", {1e-6, 1, 1e6}, massless_slide}};
}

}  // namespace hard
