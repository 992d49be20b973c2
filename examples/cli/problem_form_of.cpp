#include <cmath>
#include <string>

#include "problem_form.h"
#include "velocities.h"

namespace cli {
namespace {

using handles::check;

/// The rows of a problem in the order of the form.
struct Order {
  std::vector<std::int32_t> old_index, new_index;

  explicit Order(std::int32_t rows) : new_index(static_cast<std::size_t>(rows), -1) {}
  void put(std::int32_t row) {
    new_index[static_cast<std::size_t>(row)] = static_cast<std::int32_t>(old_index.size());
    old_index.push_back(row);
  }
};

struct RowNumbers {
  std::vector<double> r, lo, hi, compliance;
  std::vector<std::uint64_t> key;

  explicit RowNumbers(const mlcp_problem* problem) {
    const std::int32_t count = mlcp_problem_row_count(problem);
    for (std::vector<double>* a : {&r, &lo, &hi, &compliance}) a->resize(static_cast<std::size_t>(count));
    key.resize(r.size());
    check(mlcp_problem_get_rows(problem, count, r.data(), lo.data(), hi.data(), compliance.data(), key.data()));
  }
  bool bilateral(std::size_t i) const { return lo[i] == -INFINITY && hi[i] == INFINITY; }
};

/// Contacts of the problem: how many, their dimension, coefficients and normal rows.
std::vector<std::int32_t> take_contacts(const mlcp_problem* problem, ProblemForm& form) {
  form.contacts = mlcp_problem_contact_count(problem);
  const auto count = static_cast<std::size_t>(form.contacts);
  std::vector<std::int32_t> row(count), dimension(count);
  std::vector<mlcp_friction> model(count);
  form.mu.resize(count);
  check(mlcp_problem_get_contacts(problem, form.contacts, row.data(), dimension.data(), model.data(), form.mu.data(), nullptr));
  for (std::size_t c = 0; c < count; ++c) {
    if (dimension[c] != dimension[0]) throw std::runtime_error("the form cannot hold contacts in the plane and in space at once");
    if (model[c] == MLCP_FRICTION_BOX) {
      throw std::runtime_error("the form cannot hold the fixed bounds of contact " + std::to_string(c) + " (counted from 0)");
    }
  }
  if (count > 0) form.dimension = dimension[0];
  return row;
}

Order sort_rows(const RowNumbers& rows, const std::vector<std::int32_t>& contact, ProblemForm& form) {
  const std::size_t count = rows.r.size();
  std::vector<bool> grouped(count);
  for (const std::int32_t row : contact)
    for (std::int32_t t = 0; t < form.dimension; ++t) grouped[static_cast<std::size_t>(row + t)] = true;
  Order order(static_cast<std::int32_t>(count));
  for (std::size_t i = 0; i < count; ++i) {
    if (grouped[i] || !rows.bilateral(i)) continue;
    order.put(static_cast<std::int32_t>(i));
    ++form.bilateral;
  }
  for (const std::int32_t row : contact)
    for (std::int32_t t = 0; t < form.dimension; ++t) order.put(row + t);
  for (std::size_t i = 0; i < count; ++i) {
    if (grouped[i] || rows.bilateral(i)) continue;
    if (!(rows.lo[i] == 0 && rows.hi[i] == INFINITY)) {
      throw std::runtime_error("the form cannot hold row " + std::to_string(i) +
                               " (counted from 0): neither bilateral nor unilateral");
    }
    order.put(static_cast<std::int32_t>(i));
  }
  return order;
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
Matrix move_given(const Matrix& jacobian, const Velocities& velocities, const Order& order, ProblemForm& form) {
  for (std::size_t e = 0; e < jacobian.value.size(); ++e) {
    const auto j = static_cast<std::size_t>(jacobian.column[e]);
    if (velocities.new_index[j] >= 0) continue;
    const auto row = static_cast<std::size_t>(order.new_index[static_cast<std::size_t>(jacobian.row[e])]);
    form.shift[row] += jacobian.value[e] * velocities.given[j];
  }
  return select_columns(jacobian, velocities.new_index, velocities.dynamic);
}

}  // namespace

ProblemForm form_of(const handles::Problem& handle) {
  const mlcp_problem* problem = handle.get();
  ProblemForm form;
  form.reduced = mlcp_problem_velocity_count(problem) == 0;
  const RowNumbers rows(problem);
  const std::vector<std::int32_t> contact = take_contacts(problem, form);
  const Order order = sort_rows(rows, contact, form);
  bool compliant = false, keyed = false;
  for (const std::int32_t i : order.old_index) {
    const auto row = static_cast<std::size_t>(i);
    form.shift.push_back(0.0 - rows.r[row]);
    form.key.push_back(rows.key[row]);
    compliant |= rows.compliance[row] != 0;
    keyed |= rows.key[row] != 0;
  }
  if (!keyed) form.key.clear();
  if (form.reduced) {
    form.a = select_rows_and_columns(matrix_of(problem, mlcp_problem_compliance), order.new_index, form.rows());
    return form;
  }
  if (compliant) throw std::runtime_error("the form cannot hold compliance beside velocities");
  const Velocities velocities = velocities_of(problem);
  form.mass = select_rows_and_columns(matrix_of(problem, mlcp_problem_mass), velocities.new_index, velocities.dynamic);
  form.k = dynamic_momentum(problem, velocities);
  form.jacobian = select_rows(move_given(matrix_of(problem, mlcp_problem_jacobian), velocities, order, form), order.new_index, form.rows());
  return form;
}

}  // namespace cli
