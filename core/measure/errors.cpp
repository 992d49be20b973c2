#include "measure/errors.h"

#include <algorithm>
#include <cmath>

#include "factorize/kernels.h"

namespace mlcp {
namespace {

double or_infinite(double e) { return std::isfinite(e) ? e : infinity; }

/// The larger error, and the first of equals.
void take(double& largest, std::int32_t& worst, double error, std::int32_t index) {
  if (index < 0 || error < largest) return;
  if (worst < 0 || error > largest || index < worst) worst = index;
  largest = error;
}

}  // namespace

double relative_error(double absolute, double size) {
  return absolute == 0 ? 0 : size == 0 ? absolute : size < infinity && absolute < infinity ? absolute / size : infinity;
}

double natural_residual(double w, double a, double gamma, double lo, double hi) {
  const double upper = a * (gamma - lo), lower = a * (gamma - hi);  // lower ≤ upper
  return std::max(lower, std::min(w, upper));
}

void Measure::momentum(const Problem& problem, std::span<const std::int32_t> velocities, std::span<const std::int32_t> rows, std::span<const double> v,
                       std::span<const double> gamma, Errors& e) {
  const SparseView mass = problem.mass_view(), jacobian = problem.jacobian_view();
  for (const std::int32_t j : velocities) {
    const double k = problem.momentum[j];
    double sum = -k, size = std::abs(k);
    const std::int32_t begin = mass.pointers[j], end = mass.pointers[j + 1];
    for (std::int32_t t = begin; t < end; ++t) {
      const double term = mass.values[t] * v[mass.indices[t]];
      sum += term;
      size += std::abs(term);
    }
    sum_[j] = sum;
    size_[j] = size;
    std::int32_t& at = diagonal_at_[j];
    if (at < begin || at >= end || mass.indices[at] != j) at = static_cast<std::int32_t>(std::find(mass.indices + begin, mass.indices + end, j) - mass.indices);
    diagonal_[j] = at == end ? 0 : mass.values[at];
    reach_[j] = -1;
  }
  for (const std::int32_t i : rows) {
    if (gamma[i] == 0) continue;
    for (std::int32_t t = jacobian.pointers[i], end = jacobian.pointers[i + 1]; t < end; ++t) {
      const std::int32_t j = jacobian.indices[t];
      if (size_[j] < 0) continue;
      const double term = jacobian.values[t] * gamma[i];
      sum_[j] -= term;
      size_[j] += std::abs(term);
    }
  }
  for (const std::int32_t j : velocities) {
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

/// momentum() of velocities whose mass is one entry and that no row touches. Nobody asks for their numbers one by one.
void Measure::free_momentum(const Problem& problem, std::span<const VelocityRuns::Run> runs, std::span<const double> v, Errors& e) const {
  constexpr std::int32_t some = 32;  // at a time, without divisions where none is worse than what was met before
  const Kernels& kernels = kernels_for_this_cpu();
  if (!runs.empty()) e.worst_velocity = runs[0].first;
  for (const auto [first, last] : runs)
    for (std::int32_t begin = first; begin < last; begin += some) {
      const std::int32_t count = std::min(some, last - begin);
      const double *const mass = problem.mass.values.data() + problem.mass.pointers[begin], *const k = problem.momentum.data() + begin, *const x = v.data() + begin;
      if (kernels.diagonal_within(count, mass, x, k, e.momentum, &e.momentum_residual)) continue;
      for (std::int32_t i = 0; i < count; ++i) {
        const double term = mass[i] * x[i], absolute = or_infinite(std::abs(term - k[i])), relative = relative_error(absolute, std::abs(k[i]) + std::abs(term));
        e.momentum_residual = std::max(e.momentum_residual, absolute);
        if (!(relative > e.momentum)) continue;
        e.worst_velocity = begin + i;
        e.momentum = relative;
      }
    }
}

double Measure::velocity_error(std::int32_t j) const {
  return relative_error(or_infinite(std::abs(sum_[j])), size_[j]);
}

void Measure::scale_by_contact(std::span<const std::int32_t> contact_of_row) {
  if (contact_of_row.empty()) return;
  largest_.assign(contact_of_row.size(), 0.0);
  for (std::size_t i = 0; i < scale.size(); ++i)
    if (const std::int32_t c = contact_of_row[i]; c >= 0) largest_[c] = std::max(largest_[c], scale[i]);
  for (std::size_t i = 0; i < scale.size(); ++i)
    if (const std::int32_t c = contact_of_row[i]; c >= 0) scale[i] = largest_[c];
}

void Measure::rows(const Problem& problem, std::span<const std::int32_t> rows, std::span<const double> v, std::span<const double> gamma) {
  const SparseView jacobian = problem.jacobian_view(), sigma = problem.compliance_view();
  for (const std::int32_t i : rows) {
    double sum = -problem.r[i], size = std::abs(problem.r[i]), square = problem.sigma(i);
    for (std::int32_t t = jacobian.pointers[i], end = jacobian.pointers[i + 1]; t < end; ++t) {
      const std::int32_t j = jacobian.indices[t];
      const double x = jacobian.values[t];
      if (reach_[j] < 0) {
        if (!(diagonal_[j] > 0)) diagonal_[j] = 1;
        const double inverse = 1 / diagonal_[j];  // out of range: the mass is denormal, its velocity need not be
        reach_[j] = std::abs(v[j]) + std::abs(inverse < infinity ? problem.momentum[j] * inverse : problem.momentum[j] / diagonal_[j]);
        inverse_[j] = std::min(inverse, std::numeric_limits<double>::max());
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
    scale[i] = size;
    a[i] = square;
  }
}

void Measure::judge_row(const Problem& problem, std::int32_t i, double gamma) {
  residual[i] = or_infinite(std::abs(natural_residual(w[i], a[i], gamma, problem.lo[i], problem.hi[i])));
  error[i] = relative_error(residual[i], scale[i]);
  if (!std::isfinite(gamma) || !std::isfinite(w[i]) || !std::isfinite(scale[i])) error[i] = infinity;
}

void Measure::take_row(std::int32_t i, Errors& e) const {
  e.constraint_residual = std::max(e.constraint_residual, residual[i]);
  if (e.worst_row < 0 || error[i] > e.constraints) e.worst_row = i;
  e.constraints = std::max(e.constraints, error[i]);
}

void Measure::judge_together(const Problem& problem, const Mask* enabled, std::span<const double> gamma, std::span<const std::int32_t> contact_of_row) {
  double largest_a = 0;
  for (const double square : a) largest_a = std::max(largest_a, square);
  scale_by_contact(contact_of_row);
  for (std::int32_t i = 0; i < problem.m(); ++i) {
    if (enabled && enabled->state[i] == MLCP_ROW_DISABLED) continue;
    if (!(a[i] > 0)) a[i] = largest_a > 0 ? largest_a : 1;
    judge_row(problem, i, gamma[i]);
  }
}

void Measure::take_maxima(const Mask* enabled, Errors& e) const {
  e.constraints = e.constraint_residual = 0;
  e.worst_row = -1;
  for (std::int32_t i = 0; i < static_cast<std::int32_t>(error.size()); ++i)
    if (!enabled || enabled->state[i] != MLCP_ROW_DISABLED) take_row(i, e);
}

Errors Measure::begin(const Problem& problem, const Mask* enabled, std::span<const VelocityRuns::Run> free_velocities, std::span<const double> v) {
  const std::int32_t n = problem.n(), m = problem.m();
  for (Array<double>* by_velocity : {&sum_, &size_, &diagonal_, &reach_, &inverse_}) by_velocity->resize(n);
  diagonal_at_.resize(n, -1);
  for (Array<double>* by_row : {&w, &scale, &a, &residual, &error}) by_row->resize(m);
  for (std::int32_t i = 0; enabled && i < m; ++i)
    if (enabled->state[i] == MLCP_ROW_DISABLED) w[i] = scale[i] = a[i] = residual[i] = error[i] = 0;
  for (const Body& body : problem.bodies) {
    if (!body.prescribed) continue;
    for (std::int32_t j = body.offset; j < body.offset + body.dimension; ++j) {
      sum_[j] = diagonal_[j] = inverse_[j] = 0;
      size_[j] = -1;
      reach_[j] = 2 * std::abs(v[j]);
    }
  }
  Errors e;
  free_momentum(problem, free_velocities, v, e);
  return e;
}

Measure::Part Measure::part(const Problem& problem, std::span<const std::int32_t> velocities, std::span<const std::int32_t> rows, std::span<const double> v,
                            std::span<const double> gamma) {
  Part found;
  momentum(problem, velocities, rows, v, gamma, found.errors);
  this->rows(problem, rows, v, gamma);
  for (const std::int32_t i : rows) {
    found.complete &= a[i] > 0;
    judge_row(problem, i, gamma[i]);
    take_row(i, found.errors);
  }
  return found;
}

Errors Measure::end(const Problem& problem, const Mask* enabled, std::span<const double> gamma, std::span<const std::int32_t> contact_of_row, Errors e,
                    std::span<const Part> parts) {
  bool complete = contact_of_row.empty();
  for (const Part& part : parts) {
    const Errors& more = part.errors;
    e.momentum_residual = std::max(e.momentum_residual, more.momentum_residual);
    e.constraint_residual = std::max(e.constraint_residual, more.constraint_residual);
    take(e.momentum, e.worst_velocity, more.momentum, more.worst_velocity);
    take(e.constraints, e.worst_row, more.constraints, more.worst_row);
    complete &= part.complete;
  }
  if (complete) return e;
  judge_together(problem, enabled, gamma, contact_of_row);
  take_maxima(enabled, e);
  return e;
}

Errors Measure::run(const Problem& problem, const Mask* enabled, std::span<const double> v, std::span<const double> gamma,
                    std::span<const std::int32_t> contact_of_row) {
  velocities_.clear();
  for (const Body& body : problem.bodies)
    for (std::int32_t j = body.offset; !body.prescribed && j < body.offset + body.dimension; ++j) velocities_.push_back(j);
  rows_.clear();
  for (std::int32_t i = 0; i < problem.m(); ++i)
    if (!enabled || enabled->state[i] != MLCP_ROW_DISABLED) rows_.push_back(i);
  const Errors free = begin(problem, enabled, {}, v);
  const Part all = part(problem, velocities_.span(), rows_.span(), v, gamma);
  return end(problem, enabled, gamma, contact_of_row, free, {&all, 1});
}

}  // namespace mlcp
