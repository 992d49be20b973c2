#include "measure/errors.h"

#include <algorithm>
#include <cmath>

namespace mlcp {
namespace {

double or_infinite(double e) { return std::isfinite(e) ? e : infinity; }

}  // namespace

double natural_residual(double w, double a, double gamma, double lo, double hi) {
  const double upper = a * (gamma - lo), lower = a * (gamma - hi);  // lower ≤ upper
  return std::max(lower, std::min(w, upper));
}

void Measure::momentum(const Problem& problem, std::span<const double> v, std::span<const double> gamma, Errors& e) {
  const std::int32_t n = problem.n(), m = problem.m();
  const SparseView mass = problem.mass_view(), jacobian = problem.jacobian_view();
  sum_.resize(n);
  size_.resize(n);
  diagonal_.resize(n);
  for (std::int32_t j = 0, t = 0; j < n; ++j) {
    const double k = problem.momentum[j];
    double sum = -k, size = std::abs(k);
    std::int32_t diagonal = -1;
    for (const std::int32_t end = mass.pointers[j + 1]; t < end; ++t) {
      const std::int32_t other = mass.indices[t];
      const double term = mass.values[t] * v[other];
      sum += term;
      size += std::abs(term);
      if (other == j) diagonal = t;
    }
    sum_[j] = sum;
    size_[j] = size;
    diagonal_[j] = diagonal < 0 ? 0 : mass.values[diagonal];
  }
  for (std::int32_t i = 0; i < m; ++i) {
    if (gamma[i] == 0) continue;
    for (std::int32_t t = jacobian.pointers[i]; t < jacobian.pointers[i + 1]; ++t) {
      const double term = jacobian.values[t] * gamma[i];
      sum_[jacobian.indices[t]] -= term;
      size_[jacobian.indices[t]] += std::abs(term);
    }
  }
  for (const Body& body : problem.bodies) {
    const std::int32_t begin = body.offset, end = begin + body.dimension;
    if (body.prescribed) {
      std::fill(sum_.begin() + begin, sum_.begin() + end, 0.0);
      continue;
    }
    for (std::int32_t j = begin; j < end; ++j) {
      if (e.worst_velocity < 0) e.worst_velocity = j;
      const double absolute = std::abs(sum_[j]);
      if (!(absolute <= e.momentum_residual)) e.momentum_residual = or_infinite(absolute);
      if (absolute <= e.momentum * size_[j] && size_[j] < infinity) continue;  // without a division
      const double relative = velocity_error(j);
      if (!(relative > e.momentum)) continue;
      e.worst_velocity = j;
      e.momentum = relative;
    }
  }
}

double Measure::velocity_error(std::int32_t j) const {
  const double absolute = or_infinite(std::abs(sum_[j])), size = size_[j];
  return absolute == 0 ? 0 : size == 0 ? absolute : size < infinity && absolute < infinity ? absolute / size : infinity;
}

void Measure::scale_by_contact(std::span<const std::int32_t> contact_of_row) {
  if (contact_of_row.empty()) return;
  largest_.assign(contact_of_row.size(), 0.0);
  for (std::size_t i = 0; i < scale.size(); ++i)
    if (const std::int32_t c = contact_of_row[i]; c >= 0) largest_[c] = std::max(largest_[c], scale[i]);
  for (std::size_t i = 0; i < scale.size(); ++i)
    if (const std::int32_t c = contact_of_row[i]; c >= 0) scale[i] = largest_[c];
}

void Measure::rows(const Problem& problem, const Mask* enabled, std::span<const double> v, std::span<const double> gamma,
                   std::span<const std::int32_t> contact_of_row, Errors& e) {
  const std::int32_t n = problem.n(), m = problem.m();
  const SparseView jacobian = problem.jacobian_view(), sigma = problem.compliance_view();
  reach_.assign(n, -1.0);  // |v| + |v₀| where a row has asked for it
  inverse_.resize(n);      // likewise
  w.assign(m, 0.0);
  scale.assign(m, 0.0);
  a.assign(m, 0.0);
  residual.assign(m, 0.0);
  error.assign(m, 0.0);
  double largest_a = 0;
  for (std::int32_t i = 0; i < m; ++i) {
    if (enabled && enabled->state[i] == MLCP_ROW_DISABLED) continue;
    double sum = -problem.r[i], size = std::abs(problem.r[i]), square = problem.sigma(i);
    for (std::int32_t t = jacobian.pointers[i]; t < jacobian.pointers[i + 1]; ++t) {
      const std::int32_t j = jacobian.indices[t];
      const double x = jacobian.values[t];
      if (reach_[j] < 0) {
        if (problem.prescribed(j))
          diagonal_[j] = 0;
        else if (!(diagonal_[j] > 0))
          diagonal_[j] = 1;
        reach_[j] = std::abs(v[j]) + std::abs(diagonal_[j] > 0 ? problem.momentum[j] / diagonal_[j] : v[j]);
        inverse_[j] = diagonal_[j] > 0 ? std::min(1 / diagonal_[j], std::numeric_limits<double>::max()) : 0;
      }
      sum += x * v[j];
      size += std::abs(x) * reach_[j];
      square += (x * inverse_[j]) * x;
    }
    for (std::int32_t t = sigma.pointers[i]; t < sigma.pointers[i + 1]; ++t) {
      const double term = sigma.values[t] * gamma[sigma.indices[t]];
      sum += term;
      size += std::abs(term);
    }
    w[i] = sum;
    scale[i] = size > 0 ? size : 1;
    a[i] = square;
    largest_a = std::max(largest_a, square);
  }
  scale_by_contact(contact_of_row);
  for (std::int32_t i = 0; i < m; ++i) {
    if (enabled && enabled->state[i] == MLCP_ROW_DISABLED) continue;
    if (!(a[i] > 0)) a[i] = largest_a > 0 ? largest_a : 1;
    residual[i] = or_infinite(std::abs(natural_residual(w[i], a[i], gamma[i], problem.lo[i], problem.hi[i])));
    error[i] = or_infinite(residual[i] / scale[i]);
    if (!std::isfinite(gamma[i]) || !std::isfinite(w[i]) || !std::isfinite(scale[i])) error[i] = infinity;
  }
  take_maxima(enabled, e);
}

void Measure::take_maxima(const Mask* enabled, Errors& e) const {
  e.constraints = e.constraint_residual = 0;
  e.worst_row = -1;
  for (std::int32_t i = 0; i < static_cast<std::int32_t>(error.size()); ++i) {
    if (enabled && enabled->state[i] == MLCP_ROW_DISABLED) continue;
    e.constraint_residual = std::max(e.constraint_residual, residual[i]);
    if (e.worst_row < 0 || error[i] > e.constraints) e.worst_row = i;
    e.constraints = std::max(e.constraints, error[i]);
  }
}

Errors Measure::run(const Problem& problem, const Mask* enabled, std::span<const double> v, std::span<const double> gamma,
                    std::span<const std::int32_t> contact_of_row) {
  Errors e;
  momentum(problem, v, gamma, e);
  rows(problem, enabled, v, gamma, contact_of_row, e);
  return e;
}

}  // namespace mlcp
