#include <cmath>
#include <string>

// nlohmann/json: meta.json
#include <nlohmann/json.hpp>

#include "matrix_market.h"
#include "problem_folder.h"
#include "text_file.h"
#include "velocities.h"

namespace cli {
namespace {

namespace fs = std::filesystem;
using handles::check;

/// The rows of a problem, sorted as the form wants them.
struct Rows {
  std::int32_t bilateral = 0;
  std::vector<std::int32_t> old_index, new_index;
  std::vector<double> shift;  // −r: c and d, or b
  std::vector<std::uint64_t> key;
  bool compliant = false, keyed = false;
};

Rows sort_rows(const mlcp_problem* problem) {
  const std::int32_t count = mlcp_problem_row_count(problem);
  const auto size = static_cast<std::size_t>(count);
  std::vector<double> r(size), lo(size), hi(size), compliance(size);
  std::vector<std::uint64_t> key(size);
  check(mlcp_problem_get_rows(problem, count, r.data(), lo.data(), hi.data(), compliance.data(), key.data()));
  Rows rows;
  rows.new_index.resize(size);
  for (const bool want_bilateral : {true, false}) {
    for (std::size_t i = 0; i < size; ++i) {
      const bool bilateral = lo[i] == -INFINITY && hi[i] == INFINITY;
      if (!bilateral && !(lo[i] == 0 && hi[i] == INFINITY)) {
        throw std::runtime_error("a folder cannot hold row " + std::to_string(i) +
                                 " (counted from 0): neither bilateral nor unilateral");
      }
      if (bilateral != want_bilateral) continue;
      rows.bilateral += bilateral;
      rows.new_index[i] = static_cast<std::int32_t>(rows.old_index.size());
      rows.old_index.push_back(static_cast<std::int32_t>(i));
      rows.shift.push_back(0.0 - r[i]);
      rows.key.push_back(key[i] - 1);
      rows.compliant |= compliance[i] != 0;
      rows.keyed |= key[i] != 0;
    }
  }
  return rows;
}

/// Compressed rows (or columns of a symmetric matrix) as entries.
Matrix entries_of(const mlcp_matrix_view& view, std::int32_t rows) {
  Matrix matrix;
  matrix.rows = rows;
  matrix.columns = view.columns;
  for (std::int32_t i = 0; i < rows; ++i) {
    for (std::int32_t e = view.pointers[i]; e < view.pointers[i + 1]; ++e) matrix.add(i, view.indices[e], view.values[e]);
  }
  return matrix;
}

Matrix lower_triangle(const Matrix& full) {
  Matrix lower;
  lower.rows = full.rows;
  lower.columns = full.columns;
  lower.symmetric = true;
  for (std::size_t e = 0; e < full.value.size(); ++e) {
    if (full.row[e] >= full.column[e]) lower.add(full.row[e], full.column[e], full.value[e]);
  }
  return lower;
}

using View = mlcp_status (*)(const mlcp_problem*, mlcp_matrix_view*);

Matrix matrix_of(const mlcp_problem* problem, View view_of) {
  mlcp_matrix_view view;
  mlcp_matrix_view_init(&view, sizeof view);
  check(view_of(problem, &view));
  return entries_of(view, view.rows);
}

std::vector<double> dynamic_momentum(const mlcp_problem* problem, const Velocities& velocities) {
  std::vector<double> k(velocities.given.size());
  check(mlcp_problem_get_momentum(problem, static_cast<std::int32_t>(k.size()), k.data()));
  std::size_t kept = 0;
  for (std::size_t j = 0; j < k.size(); ++j) {
    if (velocities.new_index[j] >= 0) k[kept++] = k[j];
  }
  k.resize(kept);
  return k;
}

/// The columns of given velocities leave the Jacobian for the right-hand side, −r := −r + J v.
Matrix move_given(const Matrix& jacobian, const Velocities& velocities, Rows& rows) {
  for (std::size_t e = 0; e < jacobian.value.size(); ++e) {
    const auto j = static_cast<std::size_t>(jacobian.column[e]);
    if (velocities.new_index[j] >= 0) continue;
    const auto row = static_cast<std::size_t>(rows.new_index[static_cast<std::size_t>(jacobian.row[e])]);
    rows.shift[row] += jacobian.value[e] * velocities.given[j];
  }
  return select_columns(jacobian, velocities.new_index, velocities.dynamic);
}

void write_global(const fs::path& folder, const mlcp_problem* problem, Rows& rows) {
  const Velocities velocities = velocities_of(problem);
  const Matrix mass =
      select_rows_and_columns(matrix_of(problem, mlcp_problem_mass), velocities.new_index, velocities.dynamic);
  write_text(folder / "M.mtx", format_matrix(lower_triangle(mass)));
  write_text(folder / "k.mtx", format_vector(dynamic_momentum(problem, velocities)));
  const Matrix jacobian = move_given(matrix_of(problem, mlcp_problem_jacobian), velocities, rows);
  const auto count = static_cast<std::int32_t>(rows.old_index.size());
  std::vector<std::int32_t> c_index(rows.new_index), d_index(rows.new_index);
  for (std::int32_t& i : c_index) i = i < rows.bilateral ? i : -1;
  for (std::int32_t& i : d_index) i = i - rows.bilateral;
  const std::span<const double> shift(rows.shift);
  const auto bilateral = static_cast<std::size_t>(rows.bilateral);
  if (rows.bilateral > 0) {
    write_text(folder / "C.mtx", format_matrix(select_rows(jacobian, c_index, rows.bilateral)));
    write_text(folder / "c.mtx", format_vector(shift.first(bilateral)));
  }
  write_text(folder / "D.mtx", format_matrix(select_rows(jacobian, d_index, count - rows.bilateral)));
  write_text(folder / "d.mtx", format_vector(shift.subspan(bilateral)));
}

void write_reduced(const fs::path& folder, const mlcp_problem* problem, const Rows& rows) {
  const Matrix a = matrix_of(problem, mlcp_problem_compliance);
  const auto count = static_cast<std::int32_t>(rows.old_index.size());
  write_text(folder / "A.mtx", format_matrix(lower_triangle(select_rows_and_columns(a, rows.new_index, count))));
  write_text(folder / "b.mtx", format_vector(rows.shift));
}

}  // namespace

void write_folder(const fs::path& folder, const handles::Problem& problem) {
  Rows rows = sort_rows(problem.get());
  const bool reduced = mlcp_problem_velocity_count(problem.get()) == 0;
  if (!reduced && rows.compliant) throw std::runtime_error("a folder cannot hold compliance beside velocities");
  if (fs::exists(folder) && !fs::is_empty(folder)) throw std::runtime_error(folder.string() + ": is there and not empty");
  fs::create_directories(folder);
  if (reduced) write_reduced(folder, problem.get(), rows);
  else write_global(folder, problem.get(), rows);
  if (rows.keyed) write_text(folder / "key.mtx", format_vector(rows.key));
  const nlohmann::ordered_json meta = {{"form", reduced ? "reduced" : "global"}, {"nC", rows.bilateral}, {"contacts", nullptr},
                                       {"dim", 1}, {"friction", false}};
  write_text(folder / "meta.json", meta.dump(1) + "\n");
}

}  // namespace cli
