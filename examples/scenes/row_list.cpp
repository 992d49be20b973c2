#include "row_list.h"

#include <algorithm>
#include <cmath>

namespace scenes {

std::uint64_t row_key(std::int32_t body_a, std::int32_t body_b, std::int32_t feature) {
  const auto part = [](std::int32_t value) { return static_cast<std::uint64_t>(value + 2); };  // MLCP_WORLD becomes 1
  return part(body_a) << 40 | part(body_b) << 16 | (part(feature) - 1);
}

void RowList::add(Role role, std::int32_t body_a, std::int32_t body_b, std::span<const double> jacobian_a,
                  std::span<const double> jacobian_b, double phi, double limit, std::int32_t feature) {
  const auto dimension = static_cast<std::size_t>(dimension_);
  const std::size_t start = jacobian_.size();
  jacobian_.resize(start + 2 * dimension);
  for (std::size_t i = 0; i < jacobian_a.size(); ++i) jacobian_[start + i] = jacobian_a[i];
  for (std::size_t i = 0; i < jacobian_b.size(); ++i) jacobian_[start + dimension + i] = jacobian_b[i];
  role_.push_back(role);
  body_a_.push_back(body_a);
  body_b_.push_back(body_b);
  phi_.push_back(phi);
  limit_.push_back(limit);
  key_.push_back(row_key(body_a, body_b, feature));
}

void RowList::add(RowKind kind, std::int32_t body_a, std::int32_t body_b, std::span<const double> jacobian_a,
                  std::span<const double> jacobian_b, double phi, std::int32_t feature) {
  add(kind == RowKind::Joint ? Role::Joint : Role::Contact, body_a, body_b, jacobian_a, jacobian_b, phi, INFINITY, feature);
}

void RowList::add(RowKind kind, std::int32_t body_a, std::int32_t body_b, std::initializer_list<double> jacobian_a,
                  std::initializer_list<double> jacobian_b, double phi, std::int32_t feature) {
  const auto span = [](std::initializer_list<double> list) { return std::span(list.begin(), list.size()); };
  add(kind, body_a, body_b, span(jacobian_a), span(jacobian_b), phi, feature);
}

void RowList::add_motor(std::int32_t body_a, std::int32_t body_b, std::span<const double> jacobian_a, std::span<const double> jacobian_b,
                        double speed, double force, std::int32_t feature) {
  add(Role::Motor, body_a, body_b, jacobian_a, jacobian_b, speed, force, feature);
}

bool RowList::all_contacts() const {
  return std::all_of(role_.begin(), role_.end(), [](Role role) { return role == Role::Contact; });
}

double RowList::deepest() const {
  double depth = 0;
  for (std::size_t i = 0; i < phi_.size(); ++i)
    if (role_[i] == Role::Contact) depth = std::max(depth, -phi_[i]);
  return depth;
}

double RowList::drift() const {
  double worst = 0;
  for (std::size_t i = 0; i < phi_.size(); ++i)
    if (role_[i] == Role::Joint) worst = std::max(worst, std::fabs(phi_[i]));
  return worst;
}

double RowList::rate(std::size_t row, std::span<const double> v) const {
  const auto dimension = static_cast<std::size_t>(dimension_);
  double sum = 0;
  for (std::size_t side = 0; side < 2; ++side) {
    const std::int32_t body = (side == 0 ? body_a_ : body_b_)[row];
    if (body == MLCP_WORLD) continue;
    for (std::size_t i = 0; i < dimension; ++i)
      sum += jacobian_[(2 * row + side) * dimension + i] * v[static_cast<std::size_t>(body) * dimension + i];
  }
  return sum;
}

void RowList::add_multiple(std::size_t row, double s, std::span<double> y) const {
  const auto dimension = static_cast<std::size_t>(dimension_);
  for (std::size_t side = 0; side < 2; ++side) {
    const std::int32_t body = (side == 0 ? body_a_ : body_b_)[row];
    if (body == MLCP_WORLD) continue;
    for (std::size_t i = 0; i < dimension; ++i)
      y[static_cast<std::size_t>(body) * dimension + i] += s * jacobian_[(2 * row + side) * dimension + i];
  }
}

void RowList::push(double stiffness, double damping, std::span<const double> v, std::span<double> force) const {
  for (std::size_t i = 0; i < phi_.size(); ++i)
    if (phi_[i] < 0) add_multiple(i, std::max(0.0, -stiffness * phi_[i] - damping * rate(i, v)), force);
}

void RowList::apply_normal_matrix(std::span<const double> x, std::span<double> y) const {
  for (std::size_t i = 0; i < phi_.size(); ++i) add_multiple(i, rate(i, x), y);
}

void RowList::add_to(const Problem& problem, double h, double stabilisation) const {
  if (phi_.empty()) return;
  std::vector<double> r(phi_.size()), lo(phi_.size()), hi(phi_.size());
  for (std::size_t i = 0; i < phi_.size(); ++i) {
    const bool contact = role_[i] == Role::Contact;
    hi[i] = h * limit_[i];
    lo[i] = contact ? 0.0 : -hi[i];
    if (role_[i] == Role::Motor)
      r[i] = phi_[i];
    else
      check(mlcp_timestep_rows(h, stabilisation, contact, 1, &phi_[i], nullptr, &r[i]));
  }
  mlcp_rows rows;
  mlcp_rows_init(&rows, sizeof rows);
  rows.count = count();
  rows.body_a = body_a_.data();
  rows.body_b = body_b_.data();
  rows.jacobian_a = jacobian_.data();
  rows.jacobian_b = jacobian_.data() + dimension_;
  rows.jacobian_a_stride = rows.jacobian_b_stride = 2 * dimension_ * static_cast<std::ptrdiff_t>(sizeof(double));
  rows.r = r.data();
  rows.lo = lo.data();
  rows.hi = hi.data();
  rows.key = key_.data();
  check(mlcp_problem_rows_add(problem.get(), &rows, nullptr), problem);
}

}  // namespace scenes
