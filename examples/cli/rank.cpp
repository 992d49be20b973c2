#include "rank.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "matrix_view.h"
#include "velocities.h"

namespace cli {
namespace {

using SparseRow = std::vector<std::pair<std::int32_t, double>>;

/// Rows of [J D⁻¹ᐟ² Σ A⁻¹ᐟ²] with D = diag M and A = diag a, so that units drop out.
std::vector<SparseRow> scaled_rows(const mlcp_problem* problem) {
  const std::int32_t n = mlcp_problem_velocity_count(problem), m = mlcp_problem_row_count(problem);
  std::vector<double> mass(static_cast<std::size_t>(n), 1), a(static_cast<std::size_t>(m));
  each_entry(view_of(problem, mlcp_problem_mass), n, [&](std::int32_t j, std::int32_t i, double value) {
    if (i == j && value > 0) mass[static_cast<std::size_t>(j)] = value;
  });
  const Velocities velocities = velocities_of(problem);
  std::vector<SparseRow> rows(static_cast<std::size_t>(m));
  each_entry(view_of(problem, mlcp_problem_jacobian), m, [&](std::int32_t i, std::int32_t j, double value) {
    if (velocities.new_index[static_cast<std::size_t>(j)] < 0) return;
    const double scaled = value / std::sqrt(mass[static_cast<std::size_t>(j)]);
    rows[static_cast<std::size_t>(i)].push_back({j, scaled});
    a[static_cast<std::size_t>(i)] += scaled * scaled;
  });
  const mlcp_matrix_view sigma = view_of(problem, mlcp_problem_compliance);
  each_entry(sigma, m, [&](std::int32_t j, std::int32_t i, double value) {
    if (i == j) a[static_cast<std::size_t>(j)] += value;
  });
  each_entry(sigma, m, [&](std::int32_t j, std::int32_t i, double value) {
    if (value == 0) return;
    const double scale = a[static_cast<std::size_t>(j)] > 0 ? std::sqrt(a[static_cast<std::size_t>(j)]) : 1;
    rows[static_cast<std::size_t>(i)].push_back({n + j, value / scale});
  });
  return rows;
}

/// Rows of equal length, one behind the other.
struct Dense {
  std::size_t rows, columns;
  std::vector<double> values;
  std::span<double> row(std::size_t i) { return std::span(values).subspan(i * columns, columns); }
};

double dot(std::span<const double> a, std::span<const double> b) {
  double sum = 0;
  for (std::size_t j = 0; j < a.size(); ++j) sum += a[j] * b[j];
  return sum;
}

/// Uses the rows up.
std::int32_t rank_of(Dense& matrix) {
  constexpr double negligible = 1e-9;
  for (std::size_t i = 0; i < matrix.rows; ++i) {
    const double length = std::sqrt(dot(matrix.row(i), matrix.row(i)));
    for (double& value : matrix.row(i)) value = length > 0 ? value / length : 0;
  }
  for (std::size_t rank = 0; rank < matrix.rows; ++rank) {
    std::size_t longest = rank;
    double largest = 0;
    for (std::size_t i = rank; i < matrix.rows; ++i) {
      const double squared = dot(matrix.row(i), matrix.row(i));
      if (squared <= largest) continue;
      largest = squared;
      longest = i;
    }
    if (largest <= negligible * negligible) return static_cast<std::int32_t>(rank);
    std::swap_ranges(matrix.row(rank).begin(), matrix.row(rank).end(), matrix.row(longest).begin());
    for (std::size_t i = rank + 1; i < matrix.rows; ++i) {
      const double s = dot(matrix.row(i), matrix.row(rank)) / largest;
      for (std::size_t j = 0; j < matrix.columns; ++j) matrix.row(i)[j] -= s * matrix.row(rank)[j];
    }
  }
  return static_cast<std::int32_t>(matrix.rows);
}

/// The rows of one island, over the columns that they have entries in. place: −1 for every column, before and after.
Dense gather(std::span<const SparseRow> all, std::span<const std::int32_t> chosen, std::vector<std::int32_t>& place) {
  std::vector<std::int32_t> columns;
  for (const std::int32_t i : chosen) {
    for (const auto& [j, value] : all[static_cast<std::size_t>(i)]) {
      std::int32_t& there = place[static_cast<std::size_t>(j)];
      if (there >= 0) continue;
      there = static_cast<std::int32_t>(columns.size());
      columns.push_back(j);
    }
  }
  Dense matrix{chosen.size(), columns.size(), std::vector<double>(chosen.size() * columns.size())};
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    for (const auto& [j, value] : all[static_cast<std::size_t>(chosen[i])]) {
      matrix.row(i)[static_cast<std::size_t>(place[static_cast<std::size_t>(j)])] = value;
    }
  }
  for (const std::int32_t j : columns) place[static_cast<std::size_t>(j)] = -1;
  return matrix;
}

}  // namespace

std::optional<std::int32_t> independent_rows(const mlcp_problem* problem, std::span<const std::int32_t> island,
                                             std::int32_t islands) {
  constexpr double most_work = 4e9;  // multiplications
  const std::vector<SparseRow> rows = scaled_rows(problem);
  std::vector<std::vector<std::int32_t>> members(static_cast<std::size_t>(islands));
  for (std::size_t i = 0; i < island.size(); ++i) {
    if (island[i] >= 0) members[static_cast<std::size_t>(island[i])].push_back(static_cast<std::int32_t>(i));
  }
  std::vector<std::int32_t> place(static_cast<std::size_t>(mlcp_problem_velocity_count(problem)) + rows.size(), -1);
  std::int32_t rank = 0;
  double work = 0;
  for (const std::vector<std::int32_t>& chosen : members) {
    const auto count = static_cast<double>(chosen.size());
    if (count * count > most_work) return std::nullopt;
    Dense matrix = gather(rows, chosen, place);
    work += count * static_cast<double>(matrix.columns) * static_cast<double>(std::min(matrix.rows, matrix.columns));
    if (work > most_work) return std::nullopt;
    rank += rank_of(matrix);
  }
  return rank;
}

}  // namespace cli
