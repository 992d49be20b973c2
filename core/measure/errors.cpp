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
  for (std::int32_t j = 0, t = 0; j < n; ++j) {
    double sum = -problem.momentum[j], size = std::abs(sum);
    for (const std::int32_t end = mass.pointers[j + 1]; t < end; ++t) {
      const double term = mass.values[t] * v[mass.indices[t]];
      sum += term;
      size += std::abs(term);
    }
    sum_[j] = sum;
    size_[j] = size;
  }
  for (std::int32_t i = 0; i < m; ++i) {
    if (gamma[i] == 0) continue;
    for (std::int32_t t = jacobian.pointers[i]; t < jacobian.pointers[i + 1]; ++t) {
      const double term = jacobian.values[t] * gamma[i];
      sum_[jacobian.indices[t]] -= term;
      size_[jacobian.indices[t]] += std::abs(term);
    }
  }
  velocity_error.resize(n);
  for (const Body& body : problem.bodies) {
    for (std::int32_t j = body.offset; j < body.offset + body.dimension; ++j) {
      if (body.prescribed) {
        velocity_error[j] = 0;
        continue;
      }
      const double absolute = or_infinite(std::abs(sum_[j])), size = size_[j];
      const double relative = size > 0 && size < infinity ? absolute / size : size == 0 ? absolute : infinity;
      velocity_error[j] = relative;
      e.momentum_residual = std::max(e.momentum_residual, absolute);
      if (e.worst_velocity < 0 || relative > e.momentum || (relative == e.momentum && j < e.worst_velocity)) e.worst_velocity = j;
      e.momentum = std::max(e.momentum, relative);
    }
  }
}

void Measure::rows(const Problem& problem, const Mask* enabled, std::span<const double> v, std::span<const double> gamma,
                   Errors& e) {
  const std::int32_t n = problem.n(), m = problem.m();
  const SparseView mass = problem.mass_view(), jacobian = problem.jacobian_view(), sigma = problem.compliance_view();
  // size_ := 1/M_jj, 0 for prescribed velocities
  size_.resize(n);
  for (const Body& body : problem.bodies) {
    for (std::int32_t j = body.offset; j < body.offset + body.dimension; ++j) {
      double diagonal = 0;
      if (!body.sparse)  // a dense block
        diagonal = mass.values[mass.pointers[j] + j - body.offset];
      else
        for (std::int32_t t = mass.pointers[j]; t < mass.pointers[j + 1]; ++t)
          if (mass.indices[t] == j) diagonal = mass.values[t];
      size_[j] = body.prescribed ? 0 : diagonal > 0 ? diagonal : 1;
    }
  }
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
      const double x = jacobian.values[t], v0 = size_[j] > 0 ? problem.momentum[j] / size_[j] : v[j];
      sum += x * v[j];
      size += std::abs(x) * (std::abs(v[j]) + std::abs(v0));
      if (size_[j] > 0) square += (x / size_[j]) * x;
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

Errors Measure::run(const Problem& problem, const Mask* enabled, std::span<const double> v, std::span<const double> gamma) {
  Errors e;
  momentum(problem, v, gamma, e);
  rows(problem, enabled, v, gamma, e);
  return e;
}

}  // namespace mlcp
