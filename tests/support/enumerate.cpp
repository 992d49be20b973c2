#include <algorithm>
#include <cmath>

#include "support/dense.h"

namespace support {
namespace {

constexpr Real singular = 1e-13L;  // a pivot up to this, relative to the diagonal

/// The largest sum of terms that any w has from the data alone, bounds included.
Real terms_by_data(const Reduced& p) {
  Vector bound = Vector::Zero(p.b.size());
  for (int i = 0; i < bound.size(); ++i)
    for (const Real x : {p.lo[i], p.hi[i]})
      if (std::isfinite(x)) bound[i] = std::max(bound[i], std::abs(x));
  return bound.size() ? (p.size + p.A.cwiseAbs() * bound).maxCoeff() : 0;
}

/// Depth first over the states of the rows; the Cholesky factor of the active block grows and shrinks with the path.
class Search {
 public:
  Search(const Reduced& p, Real zero)
      : p_(p), zero_(zero), m_(static_cast<int>(p.b.size())), L_(Matrix::Zero(m_, m_)), gamma_(Vector::Zero(m_)),
        largest_(1e4L * terms_by_data(p)) {}

  bool run(int i = 0) {
    if (i == m_) return point();
    const bool low = std::isfinite(p_.lo[i]), high = std::isfinite(p_.hi[i]);
    if (p_.lo[i] < p_.hi[i] && push(i)) {
      if (run(i + 1)) return true;
      active_.pop_back();
    }
    if (low && rest(i, p_.lo[i])) return true;
    if (high && !(low && p_.lo[i] == p_.hi[i]) && rest(i, p_.hi[i])) return true;
    return !low && !high && rest(i, 0);
  }
  const Vector& gamma() const { return gamma_; }

 private:
  bool rest(int i, Real bound) {
    gamma_[i] = bound;
    return run(i + 1);
  }

  bool push(int i) {
    const auto f = static_cast<int>(active_.size());
    Real pivot = p_.A(i, i);
    for (int s = 0; s < f; ++s) {
      Real x = p_.A(i, active_[s]);
      for (int t = 0; t < s; ++t) x -= L_(f, t) * L_(s, t);
      L_(f, s) = x / L_(s, s);
      pivot -= L_(f, s) * L_(f, s);
    }
    if (!(pivot > singular * p_.A(i, i))) return false;
    L_(f, f) = std::sqrt(pivot);
    active_.push_back(i);
    return true;
  }

  /// γ of the active rows, then the conditions of every row.
  bool point() {
    const auto f = static_cast<int>(active_.size());
    for (const int i : active_) gamma_[i] = 0;
    x_.resize(f);
    for (int s = 0; s < f; ++s) {
      x_[s] = -p_.b[active_[s]];
      for (int j = 0; j < m_; ++j) x_[s] -= p_.A(active_[s], j) * gamma_[j];
      for (int t = 0; t < s; ++t) x_[s] -= L_(s, t) * x_[t];
      x_[s] /= L_(s, s);
    }
    for (int s = f - 1; s >= 0; --s) {
      for (int t = s + 1; t < f; ++t) x_[s] -= L_(t, s) * x_[t];
      x_[s] /= L_(s, s);
    }
    for (int s = 0; s < f; ++s) gamma_[active_[s]] = x_[s];
    for (int i = 0; i < m_; ++i) {
      Real w = p_.b[i], terms = 0;
      for (int j = 0; j < m_; ++j) {
        w += p_.A(i, j) * gamma_[j];
        terms += std::abs(p_.A(i, j) * gamma_[j]);
      }
      const Real size = p_.size[i] + std::min(terms, largest_);  // an infinite γ would excuse any slack
      const Real a = p_.A(i, i) > 0 ? p_.A(i, i) : 1;
      const Real lower = a * (gamma_[i] - p_.hi[i]), upper = a * (gamma_[i] - p_.lo[i]);
      if (!(std::abs(std::max(lower, std::min(w, upper))) <= zero_ * size)) return false;
    }
    return true;
  }

  const Reduced& p_;
  Real zero_;
  int m_;
  Matrix L_;
  Vector gamma_;
  Real largest_;
  std::vector<int> active_;
  std::vector<Real> x_;
};

}  // namespace

std::optional<Vector> enumerate(const Reduced& p, Real zero) {
  Search search(p, zero);
  if (!search.run()) return {};
  return search.gamma();
}

}  // namespace support
