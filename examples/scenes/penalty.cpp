// The penalty method of paper (2.1) on a scene: what the complementarity problem is compared with.
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "scene.h"

namespace scenes {
namespace {

/// x ← M⁻¹x, the dense block of one body after the other, by L D Lᵀ.
void divide_by_mass(const mlcp_matrix_view& mass, std::size_t dimension, std::span<double> x) {
  std::vector<double> block(dimension * dimension);
  for (std::size_t first = 0; first < x.size(); first += dimension) {
    for (std::size_t j = 0; j < dimension; ++j)
      for (std::int32_t e = mass.pointers[first + j]; e < mass.pointers[first + j + 1]; ++e)
        block[(static_cast<std::size_t>(mass.indices[e]) - first) * dimension + j] = mass.values[e];
    const auto at = [&](std::size_t i, std::size_t j) -> double& { return block[i * dimension + j]; };
    double* const y = &x[first];
    for (std::size_t j = 0; j < dimension; ++j)  // L below the diagonal, D on it, y = L\x
      for (std::size_t i = j + 1; i < dimension; ++i) {
        const double l = at(i, j) / at(j, j);
        for (std::size_t k = j + 1; k < dimension; ++k) at(i, k) -= l * at(j, k);
        y[i] -= l * y[j];
      }
    for (std::size_t j = dimension; j-- > 0;) {  // the upper half is D Lᵀ
      for (std::size_t k = j + 1; k < dimension; ++k) y[j] -= at(j, k) * y[k];
      y[j] /= at(j, j);
    }
  }
}

mlcp_matrix_view mass_of(const Problem& problem) {
  mlcp_matrix_view mass;
  mlcp_matrix_view_init(&mass, sizeof mass);
  check(mlcp_problem_mass(problem.get(), &mass));
  return mass;
}

}  // namespace

RowList Scene::rows_for_springs() const {
  RowList rows = listed_rows();
  if (!rows.all_contacts() || listed_contacts().count() > 0)
    throw std::logic_error("springs stand for contacts without friction, not for joints, motors or friction");
  return rows;
}

void Scene::step_by_penalty(double h, const Springs& springs) {
  std::fill(force_.begin(), force_.end(), 0.0);
  add_forces(force_);
  rows_for_springs().push(springs.stiffness, springs.damping, velocity_, force_);
  divide_by_mass(mass_of(problem_), static_cast<std::size_t>(dimension_), force_);
  for (std::size_t j = 0; j < velocity_.size(); ++j) velocity_[j] += h * force_[j];
  advance(h, velocity_);
  time_ += h;
}

double Scene::largest_step_by_penalty(const Springs& springs) const {
  const RowList rows = rows_for_springs();
  const mlcp_matrix_view mass = mass_of(problem_);
  // λ, the largest eigenvalue of M⁻¹JᵀJ, by the power method; ω² = s λ
  std::vector<double> u(velocity_.size()), next(u.size());
  for (std::size_t j = 0; j < u.size(); ++j) u[j] = std::cos(static_cast<double>(j * j));
  double lambda = 0;
  for (int round = 0; round < 300; ++round) {
    std::fill(next.begin(), next.end(), 0.0);
    rows.apply_normal_matrix(u, next);
    divide_by_mass(mass, static_cast<std::size_t>(dimension_), next);
    double size = 0;
    for (const double value : next) size += value * value;
    lambda = std::sqrt(size);
    if (lambda == 0) return INFINITY;
    for (std::size_t j = 0; j < u.size(); ++j) u[j] = next[j] / lambda;
  }
  const double omega = std::sqrt(springs.stiffness * lambda), zeta = 0.5 * springs.damping / springs.stiffness * omega;
  return 2 * (std::sqrt(1 + zeta * zeta) - zeta) / omega;
}

}  // namespace scenes
