#include "survey.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "matrix_view.h"

namespace cli {
namespace {

using handles::check;

/// Entries ≠ 0 by column, divided by the first: the same for rows that differ by a factor.
using Direction = std::vector<std::pair<std::int32_t, double>>;

Direction direction_of(const mlcp_matrix_view& jacobian, std::int32_t row) {
  Direction direction;
  for (std::int32_t e = jacobian.pointers[row]; e < jacobian.pointers[row + 1]; ++e) {
    if (jacobian.values[e] != 0) direction.push_back({jacobian.indices[e], jacobian.values[e]});
  }
  std::sort(direction.begin(), direction.end());
  if (direction.empty()) return direction;
  const double first = direction.front().second;
  for (auto& [column, value] : direction) value /= first;
  return direction;
}

void look_at_mass(const mlcp_problem* problem, Survey& result, std::vector<double>& diagonal, std::vector<bool>& touched) {
  const mlcp_matrix_view mass = view_of(problem, mlcp_problem_mass);
  result.mass_entries = mass.entries;
  diagonal.assign(static_cast<std::size_t>(result.velocities), 0);
  each_entry(mass, mass.columns, [&](std::int32_t j, std::int32_t i, double value) {
    if (i == j) diagonal[static_cast<std::size_t>(j)] = value;
    else if (value != 0) touched[static_cast<std::size_t>(j)] = true;
  });
  for (std::size_t j = 0; j < diagonal.size(); ++j) {
    if (diagonal[j] > 0) result.mass.take(diagonal[j]);
    else ++result.massless;
  }
}

void look_at_rows(const mlcp_problem* problem, Survey& result, const std::vector<double>& diagonal, std::vector<bool>& touched) {
  const auto m = static_cast<std::size_t>(result.rows);
  std::vector<double> r(m), lo(m), hi(m), compliance(m), squared(m), scale(m);
  check(mlcp_problem_get_rows(problem, result.rows, r.data(), lo.data(), hi.data(), compliance.data(), nullptr));
  const mlcp_matrix_view jacobian = view_of(problem, mlcp_problem_jacobian);
  const mlcp_matrix_view sigma = view_of(problem, mlcp_problem_compliance);
  result.jacobian_entries = jacobian.entries;
  std::vector<bool> empty(m, true);
  each_entry(jacobian, result.rows, [&](std::int32_t i, std::int32_t j, double value) {
    if (value == 0) ++result.explicit_zeros;
    else empty[static_cast<std::size_t>(i)] = false;
    touched[static_cast<std::size_t>(j)] = true;
    squared[static_cast<std::size_t>(i)] += value * value;
    const double mass = diagonal[static_cast<std::size_t>(j)];
    if (mass > 0) scale[static_cast<std::size_t>(i)] += value * value / mass;
  });
  each_entry(sigma, result.rows, [&](std::int32_t j, std::int32_t, double value) {
    if (value == 0) return;
    ++result.compliance_entries;
    empty[static_cast<std::size_t>(j)] = false;
  });
  std::map<Direction, std::int32_t> seen;
  for (std::size_t i = 0; i < m; ++i) {
    if (lo[i] == hi[i]) ++result.fixed;
    else if (std::isinf(lo[i]) && std::isinf(hi[i])) ++result.bilateral;
    else if (std::isinf(lo[i]) || std::isinf(hi[i])) ++result.unilateral;
    else ++result.boxed;
    const auto row = static_cast<std::int32_t>(i);
    if (compliance[i] != 0) ++result.soft_rows;
    if (empty[i]) result.zero_rows.push_back(row);
    Direction direction = direction_of(jacobian, row);
    if (!direction.empty() && !seen.emplace(std::move(direction), row).second) result.parallel_rows.push_back(row);
    result.row.take(std::sqrt(squared[i]));
    result.scale.take(scale[i] + compliance[i]);
    result.right_hand_side.take(std::fabs(r[i]));
  }
}

}  // namespace

void Range::take(double size) {
  if (size <= 0) return;
  smallest = std::min(smallest, size);
  largest = std::max(largest, size);
}

Survey survey(const mlcp_problem* problem) {
  Survey result;
  result.velocities = mlcp_problem_velocity_count(problem);
  result.bodies = mlcp_problem_body_count(problem);
  result.rows = mlcp_problem_row_count(problem);
  std::vector<double> diagonal, k(static_cast<std::size_t>(result.velocities));
  std::vector<bool> touched(k.size());
  check(mlcp_problem_get_momentum(problem, result.velocities, k.data()));
  for (const double momentum : k) result.momentum.take(std::fabs(momentum));
  look_at_mass(problem, result, diagonal, touched);
  look_at_rows(problem, result, diagonal, touched);
  result.velocities_alone = static_cast<std::int32_t>(std::count(touched.begin(), touched.end(), false));
  return result;
}

}  // namespace cli
