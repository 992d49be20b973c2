#include "exact/rational.h"

#include <cmath>

namespace exact {
namespace {

Rational exactly(support::Real x) { return Rational(static_cast<double>(x)); }

std::optional<Rational> bound(support::Real x) { return std::isfinite(x) ? std::optional(exactly(x)) : std::nullopt; }

}  // namespace

std::optional<Table> solve(Table A, Table B) {
  for (int p = 0; p < A.rows; ++p) {
    if (A(p, p) == 0) return {};
    for (int i = 0; i < A.rows; ++i) {
      if (i == p || A(i, p) == 0) continue;
      const Rational f = A(i, p) / A(p, p);
      for (int j = p + 1; j < A.columns; ++j)
        if (A(p, j) != 0) A(i, j) -= f * A(p, j);
      for (int j = 0; j < B.columns; ++j)
        if (B(p, j) != 0) B(i, j) -= f * B(p, j);
    }
  }
  for (int i = 0; i < A.rows; ++i)
    for (int j = 0; j < B.columns; ++j) B(i, j) /= A(i, i);
  return B;
}

std::optional<Reduced> reduce(const support::Dense& d) {
  std::vector<int> free, row;
  for (int j = 0; j < d.n(); ++j)
    if (d.dynamic[j]) free.push_back(j);
  for (int i = 0; i < d.m(); ++i)
    if (d.enabled[i]) row.push_back(i);
  const auto f = static_cast<int>(free.size()), m = static_cast<int>(row.size());

  Table M(f, f), right(f, m + 1);  // the columns of Jᵀ, then k
  for (int s = 0; s < f; ++s) {
    for (int t = 0; t < f; ++t) M(s, t) = exactly(d.M(free[s], free[t]));
    for (int i = 0; i < m; ++i) right(s, i) = exactly(d.J(row[i], free[s]));
    right(s, m) = exactly(d.k[free[s]]);
  }
  const std::optional<Table> X = solve(M, right);
  if (!X) return {};

  Reduced p{Table(m, m), Table(d.n(), m), Numbers(m), Numbers(d.n()), {}, {}, row};
  for (int j = 0; j < d.n(); ++j)
    if (!d.dynamic[j]) p.v0[j] = exactly(d.given[j]);
  for (int s = 0; s < f; ++s) {
    p.v0[free[s]] = (*X)(s, m);
    for (int i = 0; i < m; ++i) p.P(free[s], i) = (*X)(s, i);
  }
  for (int i = 0; i < m; ++i) {
    p.b[i] = -exactly(d.r[row[i]]);
    for (int j = 0; j < d.n(); ++j)
      if (d.J(row[i], j) != 0) p.b[i] += exactly(d.J(row[i], j)) * p.v0[j];
    for (int s = 0; s < m; ++s) {
      p.A(i, s) = exactly(d.S(row[i], row[s]));
      for (const int j : free)
        if (d.J(row[i], j) != 0) p.A(i, s) += exactly(d.J(row[i], j)) * p.P(j, s);
    }
    p.lo.push_back(bound(d.lo[row[i]]));
    p.hi.push_back(bound(d.hi[row[i]]));
  }
  return p;
}

}  // namespace exact
