#include "survey.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "matrix_view.h"
#include "velocities.h"

namespace cli {
namespace {

using handles::check;

/// Entries ≠ 0 by column, divided by the first: the same for rows that differ by a factor.
using Direction = std::vector<std::pair<std::int32_t, double>>;

Direction direction_of(const mlcp_matrix_view& jacobian, const std::vector<bool>& given, std::int32_t row) {
  Direction direction;
  for (std::int32_t e = jacobian.pointers[row]; e < jacobian.pointers[row + 1]; ++e) {
    const std::int32_t j = jacobian.indices[e];
    if (jacobian.values[e] != 0 && !given[static_cast<std::size_t>(j)]) direction.push_back({j, jacobian.values[e]});
  }
  std::sort(direction.begin(), direction.end());
  if (direction.empty()) return direction;
  const double first = direction.front().second;
  for (auto& [column, value] : direction) value /= first;
  return direction;
}

/// The velocities, one by one.
struct Columns {
  std::vector<bool> given, touched;
  std::vector<double> mass;  // Mⱼⱼ
};

void look_at_mass(const mlcp_problem* problem, Survey& result, Columns& columns) {
  const mlcp_matrix_view mass = view_of(problem, mlcp_problem_mass);
  result.mass_entries = mass.entries;
  each_entry(mass, mass.columns, [&](std::int32_t j, std::int32_t i, double value) {
    if (i == j) columns.mass[static_cast<std::size_t>(j)] = value;
    else if (value != 0) columns.touched[static_cast<std::size_t>(j)] = true;
  });
  for (std::size_t j = 0; j < columns.mass.size(); ++j) {
    if (columns.given[j]) continue;
    if (columns.mass[j] > 0) result.mass.take(columns.mass[j]);
    else ++result.massless;
  }
}

void look_at_rows(const mlcp_problem* problem, Survey& result, Columns& columns) {
  const auto m = static_cast<std::size_t>(result.rows);
  std::vector<double> r(m), lo(m), hi(m), compliance(m), squared(m), scale(m);
  check(mlcp_problem_get_rows(problem, result.rows, r.data(), lo.data(), hi.data(), compliance.data(), nullptr));
  const mlcp_matrix_view jacobian = view_of(problem, mlcp_problem_jacobian);
  const mlcp_matrix_view sigma = view_of(problem, mlcp_problem_compliance);
  result.jacobian_entries = jacobian.entries;
  std::vector<bool> empty(m, true);
  each_entry(jacobian, result.rows, [&](std::int32_t i, std::int32_t j, double value) {
    if (value == 0) ++result.explicit_zeros;
    if (columns.given[static_cast<std::size_t>(j)]) return;
    if (value != 0) empty[static_cast<std::size_t>(i)] = false;
    columns.touched[static_cast<std::size_t>(j)] = true;
    squared[static_cast<std::size_t>(i)] += value * value;
    const double mass = columns.mass[static_cast<std::size_t>(j)];
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
    Direction direction = direction_of(jacobian, columns.given, row);
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
  const Velocities velocities = velocities_of(problem);
  result.prescribed_bodies = velocities.prescribed_bodies;
  std::vector<double> k(velocities.given.size());
  check(mlcp_problem_get_momentum(problem, result.velocities, k.data()));
  Columns columns{std::vector<bool>(k.size()), std::vector<bool>(k.size()), std::vector<double>(k.size())};
  for (std::size_t j = 0; j < k.size(); ++j) {
    columns.given[j] = columns.touched[j] = velocities.new_index[j] < 0;
    if (!columns.given[j]) result.momentum.take(std::fabs(k[j]));
  }
  look_at_mass(problem, result, columns);
  look_at_rows(problem, result, columns);
  result.velocities_alone = static_cast<std::int32_t>(std::count(columns.touched.begin(), columns.touched.end(), false));
  return result;
}

}  // namespace cli
