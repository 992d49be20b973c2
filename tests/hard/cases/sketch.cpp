#include "hard/cases/sketch.h"

#include <algorithm>

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

namespace {

/// The rows of a problem.
struct RowNumbers {
  mlcp_matrix_view jacobian;
  std::vector<double> r, lo, hi;

  explicit RowNumbers(const Problem& problem) : r(static_cast<std::size_t>(mlcp_problem_row_count(problem.get()))), lo(r), hi(r) {
    mlcp_matrix_view_init(&jacobian, sizeof jacobian);
    check(mlcp_problem_jacobian(problem.get(), &jacobian));
    check(mlcp_problem_get_rows(problem.get(), jacobian.rows, r.data(), lo.data(), hi.data(), nullptr, nullptr));
  }
};

/// Given velocities by column, 0 elsewhere; whether they are.
struct GivenVelocities {
  std::vector<double> value;
  std::vector<bool> given;

  explicit GivenVelocities(const Problem& problem)
      : value(static_cast<std::size_t>(mlcp_problem_velocity_count(problem.get()))), given(value.size()) {
    std::int32_t count = 0;
    check(mlcp_problem_bodies(problem.get(), 0, nullptr, &count));
    std::vector<std::int32_t> ids(static_cast<std::size_t>(count));
    check(mlcp_problem_bodies(problem.get(), count, ids.data(), &count));
    for (const std::int32_t id : ids) {
      std::int32_t offset = 0, dimension = 0, prescribed = 0;
      check(mlcp_problem_body_range(problem.get(), id, &offset, &dimension));
      check(mlcp_problem_body_state(problem.get(), id, &prescribed, dimension, value.data() + offset));
      std::fill_n(given.begin() + offset, dimension, prescribed != 0);
    }
  }
};

}  // namespace

Problem with_rows(const Problem& problem, const std::vector<double>& scale, int copies) {
  Problem changed = handles::clone(problem);
  const RowNumbers rows(problem);
  check(mlcp_problem_rows_clear(changed.get()), changed);
  for (int copy = 0; copy < copies; ++copy)
    for (std::size_t i = 0; i < rows.r.size(); ++i) {
      const double s = scale[i % scale.size()];
      const std::int32_t first = rows.jacobian.pointers[i], count = rows.jacobian.pointers[i + 1] - first;
      std::vector<double> values(rows.jacobian.values + first, rows.jacobian.values + first + count);
      for (double& x : values) x *= s;
      check(mlcp_problem_row_add(changed.get(), count, rows.jacobian.indices + first, values.data(), s * rows.r[i], rows.lo[i] / s, rows.hi[i] / s, 0, 0,
                                 nullptr),
            changed);
    }
  return changed;
}

Problem with_given_velocities_in_r(const Problem& problem) {
  const RowNumbers rows(problem);
  const GivenVelocities v(problem);
  Problem changed = handles::clone(problem);
  if (std::find(v.given.begin(), v.given.end(), true) == v.given.end()) return changed;
  check(mlcp_problem_rows_clear(changed.get()), changed);
  for (std::size_t i = 0; i < rows.r.size(); ++i) {
    std::vector<std::int32_t> columns;
    std::vector<double> values;
    double r = rows.r[i];
    for (std::int32_t t = rows.jacobian.pointers[i]; t < rows.jacobian.pointers[i + 1]; ++t) {
      const std::int32_t j = rows.jacobian.indices[t];
      if (v.given[static_cast<std::size_t>(j)]) {
        r -= rows.jacobian.values[t] * v.value[static_cast<std::size_t>(j)];
      } else {
        columns.push_back(j);
        values.push_back(rows.jacobian.values[t]);
      }
    }
    check(mlcp_problem_row_add(changed.get(), static_cast<std::int32_t>(columns.size()), columns.data(), values.data(), r, rows.lo[i], rows.hi[i], 0, 0,
                               nullptr),
          changed);
  }
  return changed;
}

}  // namespace hard
