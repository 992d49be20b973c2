#include "support/dense.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

namespace support {
namespace {

/// 1 stands for a mass of 0.
Real inverse_mass(const Dense& d, int j) { return !d.dynamic[j] ? 0 : d.M(j, j) > 0 ? 1 / d.M(j, j) : 1; }

Vector row_scales(const Dense& d) {
  Vector a(d.m());
  Real largest = 0;
  for (int i = 0; i < d.m(); ++i) {
    a[i] = d.S(i, i);
    for (int j = 0; j < d.n(); ++j) a[i] += d.J(i, j) * d.J(i, j) * inverse_mass(d, j);
    if (d.enabled[i]) largest = std::max(largest, a[i]);
  }
  for (int i = 0; i < d.m(); ++i)
    if (!(a[i] > 0)) a[i] = largest > 0 ? largest : 1;
  return a;
}

Real median(Real x, Real y, Real z) { return std::max(std::min(x, y), std::min(std::max(x, y), z)); }

}  // namespace

Dense dense(const mlcp::Problem& p, const mlcp::Mask* enabled) {
  const int n = p.n(), m = p.m();
  Dense d{Matrix::Zero(n, n), Matrix::Zero(m, n), Matrix::Zero(m, m), Vector(n), Vector(m), Vector(m), Vector(m), Vector(n),
          {}, {}};
  for (int j = 0; j < n; ++j) {
    for (auto t = p.mass.pointers[j]; t < p.mass.pointers[j + 1]; ++t) d.M(p.mass.indices[t], j) += p.mass.values[t];
    d.k[j] = p.momentum[j];
    d.given[j] = p.given_velocity[j];
    d.dynamic.push_back(!p.prescribed(j));
  }
  for (int i = 0; i < m; ++i) {
    for (auto t = p.jacobian.pointers[i]; t < p.jacobian.pointers[i + 1]; ++t)
      d.J(i, p.jacobian.indices[t]) += p.jacobian.values[t];
    for (auto t = p.compliance.pointers[i]; t < p.compliance.pointers[i + 1]; ++t)
      d.S(p.compliance.indices[t], i) += p.compliance.values[t];
    d.r[i] = p.r[i];
    d.lo[i] = p.lo[i];
    d.hi[i] = p.hi[i];
    d.enabled.push_back(!enabled || enabled->state[i] != MLCP_ROW_DISABLED);
  }
  return d;
}

Vector widen(std::span<const double> x) {
  Vector y(static_cast<Eigen::Index>(x.size()));
  std::copy(x.begin(), x.end(), y.data());
  return y;
}

DenseErrors errors_of(const Dense& d, const Vector& v, const Vector& gamma, Real negligible) {
  DenseErrors e;
  e.velocity = Vector::Zero(d.n());
  e.row = Vector::Zero(d.m());
  for (int j = 0; j < d.n(); ++j) {
    if (!d.dynamic[j]) continue;
    Real residual = -d.k[j], size = std::abs(d.k[j]);
    for (int i = 0; i < d.n(); ++i) {
      residual += d.M(j, i) * v[i];
      size += std::abs(d.M(j, i) * v[i]);
    }
    for (int i = 0; i < d.m(); ++i) {
      residual -= d.J(i, j) * gamma[i];
      size += std::abs(d.J(i, j) * gamma[i]);
    }
    if (std::abs(residual) <= negligible) residual = 0;
    const Real error = e.velocity[j] = size > 0 ? std::abs(residual) / size : std::abs(residual);
    if (e.worst_velocity < 0 || error > e.momentum) e.worst_velocity = j;
    e.momentum = std::max(e.momentum, error);
  }
  const Vector a = row_scales(d);
  for (int i = 0; i < d.m(); ++i) {
    if (!d.enabled[i]) continue;
    Real w = -d.r[i], size = std::abs(d.r[i]);
    for (int j = 0; j < d.n(); ++j) {
      const Real v0 = d.dynamic[j] ? d.k[j] / (d.M(j, j) > 0 ? d.M(j, j) : 1) : v[j];
      w += d.J(i, j) * v[j];
      size += std::abs(d.J(i, j)) * (std::abs(v[j]) + std::abs(v0));
    }
    for (int s = 0; s < d.m(); ++s) {
      w += d.S(i, s) * gamma[s];
      size += std::abs(d.S(i, s) * gamma[s]);
    }
    Real residual = std::abs(median(w, a[i] * (gamma[i] - d.lo[i]), a[i] * (gamma[i] - d.hi[i])));
    if (residual <= negligible) residual = 0;
    const Real error = e.row[i] = size > 0 ? residual / size : residual;
    if (e.worst_row < 0 || error > e.constraints) e.worst_row = i;
    e.constraints = std::max(e.constraints, error);
  }
  return e;
}

std::string certificate_fault(const Dense& d, std::span<const std::int32_t> rows, std::span<const double> y, Real zero) {
  if (rows.empty()) return "no rows";
  Vector full = Vector::Zero(d.m());
  for (std::size_t s = 0; s < rows.size(); ++s) {
    const int i = rows[s];
    if (full[i] != 0) return "row " + std::to_string(i) + " is there twice";
    if (!d.enabled[i]) return "row " + std::to_string(i) + " is disabled";
    if (!std::isfinite(y[s])) return "not finite";
    if (y[s] > 0 && std::isfinite(d.hi[i])) return "y > 0 on row " + std::to_string(i) + " with finite hi";
    if (y[s] < 0 && std::isfinite(d.lo[i])) return "y < 0 on row " + std::to_string(i) + " with finite lo";
    full[i] = y[s];
  }
  for (int j = 0; j < d.n(); ++j) {
    if (!d.dynamic[j]) continue;
    const Vector terms = d.J.col(j).cwiseProduct(full);
    if (std::abs(terms.sum()) > zero * terms.cwiseAbs().sum() + 1e-300L) return "J'y is not 0 at velocity " + std::to_string(j);
  }
  for (int i = 0; i < d.m(); ++i) {
    const Vector terms = d.S.col(i).cwiseProduct(full);
    if (d.enabled[i] && std::abs(terms.sum()) > zero * terms.cwiseAbs().sum() + 1e-300L)
      return "S y is not 0 at row " + std::to_string(i);
  }
  Real gap = 0, size = 0;
  for (int i = 0; i < d.m(); ++i) {
    gap += full[i] * d.r[i];
    size += std::abs(full[i] * d.r[i]);
    for (int j = 0; j < d.n(); ++j) {
      if (d.dynamic[j]) continue;
      gap -= full[i] * d.J(i, j) * d.given[j];
      size += std::abs(full[i] * d.J(i, j) * d.given[j]);
    }
  }
  return gap > zero * size ? "" : "r'y is not positive";
}

Matrix solve_spd(const Matrix& A, const Matrix& b) { return A.rows() ? Matrix(A.ldlt().solve(b)) : b; }

Vector velocities(const Dense& d, const Vector& gamma) {
  std::vector<int> free;
  for (int j = 0; j < d.n(); ++j)
    if (d.dynamic[j]) free.push_back(j);
  const auto f = static_cast<int>(free.size());
  Matrix M(f, f);
  Vector rhs(f);
  for (int s = 0; s < f; ++s) {
    for (int t = 0; t < f; ++t) M(s, t) = d.M(free[s], free[t]);
    rhs[s] = d.k[free[s]];
    for (int i = 0; i < d.m(); ++i) rhs[s] += d.J(i, free[s]) * gamma[i];
  }
  const Vector x = solve_spd(M, rhs);
  Vector v = d.given;
  for (int s = 0; s < f; ++s) v[free[s]] = x[s];
  return v;
}

Reduced reduce(const Dense& d) {
  Reduced p;
  std::vector<int> free, fixed;
  for (int j = 0; j < d.n(); ++j) (d.dynamic[j] ? free : fixed).push_back(j);
  for (int i = 0; i < d.m(); ++i)
    if (d.enabled[i]) p.row.push_back(i);
  const auto f = static_cast<int>(free.size()), m = static_cast<int>(p.row.size());
  Matrix M(f, f), J(m, f);
  Vector k(f);
  p.A.resize(m, m);
  p.b.resize(m);
  p.size.resize(m);
  p.lo.resize(m);
  p.hi.resize(m);
  for (int s = 0; s < f; ++s) {
    k[s] = d.k[free[s]];
    for (int t = 0; t < f; ++t) M(s, t) = d.M(free[s], free[t]);
  }
  for (int i = 0; i < m; ++i) {
    const int row = p.row[i];
    for (int s = 0; s < f; ++s) J(i, s) = d.J(row, free[s]);
    for (int s = 0; s < m; ++s) p.A(i, s) = d.S(row, p.row[s]);
    p.b[i] = -d.r[row];
    p.size[i] = std::abs(d.r[row]);
    for (const int j : fixed) {
      p.b[i] += d.J(row, j) * d.given[j];
      p.size[i] += std::abs(d.J(row, j) * d.given[j]);
    }
    p.lo[i] = d.lo[row];
    p.hi[i] = d.hi[row];
  }
  if (f > 0 && m > 0) {
    p.A += J * solve_spd(M, J.transpose());
    const Vector v0 = solve_spd(M, k);
    p.b += J * v0;
    p.size += J.cwiseAbs() * v0.cwiseAbs();
    p.A = ((p.A + p.A.transpose()) / 2).eval();
  }
  return p;
}

namespace {

std::optional<Vector> expand(const Dense& d, const Reduced& p, const std::optional<Vector>& reduced) {
  if (!reduced) return {};
  Vector gamma = Vector::Zero(d.m());
  for (std::size_t s = 0; s < p.row.size(); ++s) gamma[p.row[s]] = (*reduced)[static_cast<int>(s)];
  return gamma;
}

}  // namespace

std::optional<Vector> oracle(const Dense& d) {
  const Reduced p = reduce(d);
  return expand(d, p, enumerate(p));
}

std::optional<Vector> forgiving_oracle(const Dense& d) {
  Reduced p = reduce(d);
  if (p.size.size()) p.size.setConstant(p.size.maxCoeff());
  return expand(d, p, enumerate(p, 1e-13L));
}

}  // namespace support
