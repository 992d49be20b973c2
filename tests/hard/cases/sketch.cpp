#include "hard/cases/sketch.h"

namespace hard {

using handles::check;

std::int32_t Sketch::body(const std::vector<double>& mass) {
  const auto d = static_cast<std::int32_t>(mass.size());
  std::vector<double> block(mass.size() * mass.size());
  for (std::size_t j = 0; j < mass.size(); ++j) block[j * mass.size() + j] = mass[j];
  const std::int32_t first = mlcp_problem_velocity_count(problem_.get());
  std::int32_t id = -1;
  check(mlcp_problem_bodies_add(problem_.get(), 1, d, block.data(), 0, &id), problem_);
  body_at_.resize(static_cast<std::size_t>(first + d), id);
  return first;
}

void Sketch::prescribe(std::int32_t first_velocity, const std::vector<double>& velocity) {
  check(mlcp_problem_body_set_prescribed(problem_.get(), body_at_[static_cast<std::size_t>(first_velocity)], velocity.data(),
                                         static_cast<std::int32_t>(velocity.size())),
        problem_);
}

void Sketch::momentum(const std::vector<double>& k) {
  check(mlcp_problem_set_momentum(problem_.get(), 0, static_cast<std::int32_t>(k.size()), k.data()), problem_);
}

std::int32_t Sketch::row(const std::vector<Entry>& entries, double r, Bounds bounds, double compliance) {
  std::vector<std::int32_t> columns;
  std::vector<double> values;
  for (const Entry& e : entries) {
    columns.push_back(e.column);
    values.push_back(e.value);
  }
  std::int32_t index = -1;
  check(mlcp_problem_row_add(problem_.get(), static_cast<std::int32_t>(entries.size()), columns.data(), values.data(), r, bounds.lo, bounds.hi,
                             compliance, 0, &index),
        problem_);
  return index;
}

void Sketch::coulomb(std::int32_t row, std::int32_t dimension, double mu) {
  check(mlcp_problem_contacts_declare(problem_.get(), 1, dimension, &row, nullptr, &mu, nullptr, nullptr), problem_);
}

void Sketch::compliance(std::int32_t rows, const std::vector<double>& dense) {
  std::vector<std::int32_t> pointers{0}, indices;
  for (std::int32_t j = 0; j < rows; ++j) {
    for (std::int32_t i = 0; i < rows; ++i) indices.push_back(i);
    pointers.push_back((j + 1) * rows);
  }
  check(mlcp_problem_set_compliance_matrix(problem_.get(), rows, pointers.data(), indices.data(), dense.data(), MLCP_FULL), problem_);
}

Problem with_rows(const Problem& problem, const std::vector<double>& scale, int copies) {
  Problem changed = handles::clone(problem);
  const std::int32_t m = mlcp_problem_row_count(problem.get());
  mlcp_matrix_view jacobian;
  mlcp_matrix_view_init(&jacobian, sizeof jacobian);
  check(mlcp_problem_jacobian(problem.get(), &jacobian));
  std::vector<double> r(static_cast<std::size_t>(m)), lo(r), hi(r);
  check(mlcp_problem_get_rows(problem.get(), m, r.data(), lo.data(), hi.data(), nullptr, nullptr));
  check(mlcp_problem_rows_clear(changed.get()), changed);
  for (int copy = 0; copy < copies; ++copy)
    for (std::int32_t i = 0; i < m; ++i) {
      const double s = scale[static_cast<std::size_t>(i) % scale.size()];
      const std::int32_t first = jacobian.pointers[i], count = jacobian.pointers[i + 1] - first;
      std::vector<double> values(jacobian.values + first, jacobian.values + first + count);
      for (double& x : values) x *= s;
      check(mlcp_problem_row_add(changed.get(), count, jacobian.indices + first, values.data(), s * r[static_cast<std::size_t>(i)],
                                 lo[static_cast<std::size_t>(i)] / s, hi[static_cast<std::size_t>(i)] / s, 0, 0, nullptr),
            changed);
    }
  return changed;
}

}  // namespace hard
