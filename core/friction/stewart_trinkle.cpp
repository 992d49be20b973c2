#include "friction/stewart_trinkle.h"

#include <algorithm>
#include <cmath>

namespace mlcp {
namespace {

/// Islands beyond these are not small: Lemke's dictionary has most_unknowns² entries, the mass of the island most_velocities².
constexpr std::size_t most_unknowns = 600, most_velocities = 600, most_rows = 300;
/// A circular cone is solved as a pyramid this fine.
constexpr std::int32_t fine = 16;
constexpr double redundant = 1e-12;

bool on(const Mask* enabled, std::int32_t row) { return !enabled || enabled->state[row] != MLCP_ROW_DISABLED; }

}  // namespace

/// Rows of the island: those of cones first, contact by contact, then the other ones; bilateral_ says which of these are.
bool StewartTrinkle::collect(const Problem& problem, const Mask* enabled, std::span<const std::int32_t> row_island, std::int32_t island) {
  contact_.clear();
  row_.clear();
  bilateral_.clear();
  local_.assign(std::max(problem.m(), problem.n()), -1);
  for (std::size_t c = 0; c < problem.contacts.size(); ++c) {
    const Contact& contact = problem.contacts[c];
    if (row_island[contact.row] != island || !has_cone(contact, enabled)) continue;
    contact_.push_back(static_cast<std::int32_t>(c));
    for (std::int32_t t = 0; t < contact.dimension; ++t) {
      local_[contact.row + t] = static_cast<std::int32_t>(row_.size());
      row_.push_back(contact.row + t);
    }
    if (row_.size() > most_rows) return false;
  }
  for (std::int32_t i = 0; i < problem.m(); ++i) {
    if (row_island[i] != island || local_[i] >= 0 || !on(enabled, i)) continue;
    const bool free = problem.lo[i] == -infinity && problem.hi[i] == infinity;
    if (!free && (problem.lo[i] != 0 || problem.hi[i] != infinity)) return false;
    local_[i] = static_cast<std::int32_t>(row_.size());
    if (free) bilateral_.push_back(local_[i]);
    row_.push_back(i);
    if (row_.size() > most_rows) return false;
  }
  return true;
}

/// Dynamic velocities that the rows touch, and all that M couples them to. local_ becomes velocity → place.
void StewartTrinkle::collect_velocities(const Problem& problem) {
  local_.assign(std::max(problem.m(), problem.n()), -1);
  velocity_.clear();
  const auto add = [&](std::int32_t j) {
    if (local_[j] >= 0 || problem.prescribed(j)) return;
    local_[j] = static_cast<std::int32_t>(velocity_.size());
    velocity_.push_back(j);
  };
  for (const std::int32_t i : row_)
    for (std::int32_t e = problem.jacobian.pointers[i]; e < problem.jacobian.pointers[i + 1]; ++e) add(problem.jacobian.indices[e]);
  for (std::size_t s = 0; s < velocity_.size() && velocity_.size() <= most_velocities; ++s)
    for (std::int32_t e = problem.mass.pointers[velocity_[s]]; e < problem.mass.pointers[velocity_[s] + 1]; ++e)
      add(problem.mass.indices[e]);
}

/// A = J M⁻¹Jᵀ + Σ and b = J M⁻¹k + J v_given − r through M = L Lᵀ: half = L⁻¹(Jᵀ, k).
bool StewartTrinkle::form_delassus(const Problem& problem) {
  collect_velocities(problem);
  const std::size_t n = velocity_.size(), m = row_.size();
  if (n > most_velocities) return false;
  mass_.assign(n * n, 0.0);
  half_.assign((m + 1) * n, 0.0);  // a row of J or k after the other
  a_.assign(m * m, 0.0);
  b_.resize(m);
  for (std::size_t s = 0; s < n; ++s) {
    const std::int32_t j = velocity_[s];
    half_[m * n + s] = problem.momentum[j];
    for (std::int32_t e = problem.mass.pointers[j]; e < problem.mass.pointers[j + 1]; ++e)
      if (local_[problem.mass.indices[e]] >= 0) mass_[s * n + local_[problem.mass.indices[e]]] = problem.mass.values[e];
  }
  for (std::size_t i = 0; i < m; ++i) {
    b_[i] = -problem.r[row_[i]];
    for (std::int32_t e = problem.jacobian.pointers[row_[i]]; e < problem.jacobian.pointers[row_[i] + 1]; ++e) {
      const std::int32_t j = problem.jacobian.indices[e];
      if (local_[j] >= 0)
        half_[i * n + local_[j]] = problem.jacobian.values[e];
      else
        b_[i] += problem.jacobian.values[e] * problem.given_velocity[j];
    }
  }
  for (std::size_t j = 0; j < n; ++j) {
    double pivot = mass_[j * n + j];
    for (std::size_t t = 0; t < j; ++t) pivot -= mass_[j * n + t] * mass_[j * n + t];
    if (!(pivot > 0)) return false;
    mass_[j * n + j] = std::sqrt(pivot);
    for (std::size_t i = j + 1; i < n; ++i) {
      double s = mass_[i * n + j];
      for (std::size_t t = 0; t < j; ++t) s -= mass_[i * n + t] * mass_[j * n + t];
      mass_[i * n + j] = s / mass_[j * n + j];
    }
  }
  for (std::size_t i = 0; i <= m; ++i) {
    double* x = half_.data() + i * n;
    for (std::size_t j = 0; j < n; ++j) {
      for (std::size_t t = 0; t < j; ++t) x[j] -= mass_[j * n + t] * x[t];
      x[j] /= mass_[j * n + j];
    }
  }
  const auto product = [&](std::size_t i, std::size_t j) {
    double s = 0;
    for (std::size_t t = 0; t < n; ++t) s += half_[i * n + t] * half_[j * n + t];
    return s;
  };
  for (std::size_t i = 0; i < m; ++i) {
    b_[i] += product(i, m);
    for (std::size_t j = 0; j <= i; ++j) a_[i * m + j] = a_[j * m + i] = product(i, j);
  }
  local_.assign(std::max(problem.m(), problem.n()), -1);
  for (std::size_t i = 0; i < m; ++i) local_[row_[i]] = static_cast<std::int32_t>(i);
  for (std::size_t i = 0; i < m; ++i)
    for (std::int32_t e = problem.compliance.pointers[row_[i]]; e < problem.compliance.pointers[row_[i] + 1]; ++e)
      if (local_[problem.compliance.indices[e]] >= 0) a_[i * m + local_[problem.compliance.indices[e]]] += problem.compliance.values[e];
  return true;
}

/// Schur complement, largest pivot first; rows that depend on others are left out.
void StewartTrinkle::eliminate_bilateral() {
  const std::size_t m = row_.size();
  double largest = 0;
  for (std::size_t i = 0; i < m; ++i) largest = std::max(largest, a_[i * m + i]);
  scale_ = largest > 0 ? largest : 1;
  while (!bilateral_.empty()) {
    const auto best = std::max_element(bilateral_.begin(), bilateral_.end(),
                                       [&](std::int32_t i, std::int32_t j) { return a_[i * m + i] < a_[j * m + j]; });
    const std::size_t p = *best;
    *best = bilateral_.back();
    bilateral_.pop_back();
    const double pivot = a_[p * m + p];
    if (!(pivot > redundant * largest)) return;
    for (std::size_t i = 0; i < m; ++i) {
      const double f = a_[i * m + p] / pivot;
      if (i == p || f == 0) continue;
      b_[i] -= f * b_[p];
      for (std::size_t j = 0; j < m; ++j) a_[i * m + j] -= f * a_[p * m + j];
    }
    for (std::size_t j = 0; j < m; ++j) a_[p * m + j] = a_[j * m + p] = 0;
    b_[p] = 0;
  }
}

void StewartTrinkle::list_unknowns(const Problem& problem, std::int32_t facets) {
  unknown_.clear();
  std::int32_t row = 0;
  for (const std::int32_t c : contact_) {
    const Contact& contact = problem.contacts[c];
    Cone cone = cone_of(contact, facets);
    if (!cone.planar && cone.facets == 0) cone.facets = fine;
    const std::int32_t count = cone.planar ? 2 : cone.facets, normal = static_cast<std::int32_t>(unknown_.size());
    const bool coulomb = contact.model == MLCP_FRICTION_COULOMB;
    if (coulomb) unknown_.push_back({row, 1, {1, 0, 0}, -1, 0});
    for (std::int32_t j = 0; j < count; ++j) {
      const Tangent d = cone.planar ? Tangent{j == 0 ? 1.0 : -1.0, 0} : cone.direction(j);
      if (coulomb)
        unknown_.push_back({row, contact.dimension, {0, d.x, d.y}, -1, 0});
      else
        unknown_.push_back({row, contact.dimension, {1, cone.mu * d.x, cone.mu * d.y}, -1, 0});
    }
    if (coulomb) unknown_.push_back({row, 0, {cone.mu, 0, 0}, normal, count});
    row += contact.dimension;
  }
  for (; row < static_cast<std::int32_t>(row_.size()); ++row)
    if (problem.lo[row_[row]] == 0) unknown_.push_back({row, 1, {1, 0, 0}, -1, 0});
}

double StewartTrinkle::along(const Unknown& u, const double* x) const {
  double s = 0;
  for (std::int32_t t = 0; t < u.rows; ++t) s += u.weight[t] * x[u.row + t];
  return s;
}

/// Impulses in units of 1/scale, so that all entries are near 1 in size.
void StewartTrinkle::form_lcp(const Problem&) {
  const std::size_t k = unknown_.size(), m = row_.size();
  matrix_.assign(k * k, 0.0);
  q_.resize(k);
  z_.resize(k);
  w_.resize(m);
  for (std::size_t i = 0; i < k; ++i) {
    const Unknown& u = unknown_[i];
    q_[i] = along(u, b_.data());
    if (u.cone >= 0) {  // λ: µ γ_n − eᵀβ, and λ in the rows of β
      matrix_[i * k + u.cone] = u.weight[0];
      for (std::int32_t j = u.cone + 1; j <= u.cone + u.facets; ++j) {
        matrix_[i * k + j] = -1;
        matrix_[j * k + i] = 1;
      }
      continue;
    }
    for (std::size_t t = 0; t < m; ++t) {
      double s = 0;
      for (std::int32_t a = 0; a < u.rows; ++a) s += u.weight[a] * a_[(u.row + a) * m + t];
      w_[t] = s / scale_;
    }
    for (std::size_t j = 0; j < k; ++j)
      if (unknown_[j].cone < 0) matrix_[i * k + j] = along(unknown_[j], w_.data());
  }
}

bool StewartTrinkle::solve(const Problem& problem, const Mask* enabled, std::span<const std::int32_t> row_island, std::int32_t island,
                           std::int32_t facets) {
  if (!collect(problem, enabled, row_island, island)) return false;
  list_unknowns(problem, facets);
  if (unknown_.size() > most_unknowns || !form_delassus(problem)) return false;
  eliminate_bilateral();
  form_lcp(problem);
  if (!lemke_.solve(static_cast<std::int32_t>(unknown_.size()), matrix_.span(), q_.span(), z_.span())) return false;
  const std::size_t m = row_.size();
  gamma_.assign(m, 0.0);
  for (std::size_t i = 0; i < unknown_.size(); ++i)
    for (std::int32_t t = 0; t < unknown_[i].rows; ++t) gamma_[unknown_[i].row + t] += unknown_[i].weight[t] * z_[i] / scale_;
  for (std::size_t i = 0; i < m; ++i) {
    w_[i] = b_[i];
    for (std::size_t j = 0; j < m; ++j) w_[i] += a_[i * m + j] * gamma_[j];
  }
  return true;
}

Tangent StewartTrinkle::slip(const Problem& problem, std::int32_t contact) const {
  const Contact& c = problem.contacts[contact];
  const auto row = std::find(row_.begin(), row_.end(), c.row) - row_.begin();
  return {w_[row + 1], c.dimension == 3 ? w_[row + 2] : 0.0};
}

}  // namespace mlcp
