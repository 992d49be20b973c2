#include "exact/oracle.h"

#include <algorithm>

namespace exact {
namespace {

enum State { lower, upper, active, out };  // out: at 0 between infinite bounds

class Method {
 public:
  Method(const Reduced& p, const std::vector<int>& start) : p_(p), state_(p.m()), gamma_(p.m()) {
    for (int i = 0; i < p.m(); ++i) rest(i, p.lo[i] ? lower : p.hi[i] ? upper : out);
    for (int i = 0; i < p.m(); ++i) {
      const bool wanted = std::find(start.begin(), start.end(), p.row[i]) != start.end();
      if (!wanted || (p.lo[i] && p.hi[i] && *p.lo[i] == *p.hi[i])) continue;
      if (schur(i) > 0) state_[i] = active;
    }
    do place_active();
    while (drop_beyond_bounds());
  }

  Truth run() {
    for (int i = violated(); i >= 0; i = violated())
      if (!treat(i)) return {false, {}, {}, certificate_};
    Truth t{true, gamma_, p_.v0, {}};
    for (std::size_t j = 0; j < t.v.size(); ++j)
      for (int i = 0; i < p_.m(); ++i)
        if (gamma_[i] != 0) t.v[j] += p_.P(static_cast<int>(j), i) * gamma_[i];
    return t;
  }

 private:
  void rest(int i, State s) {
    state_[i] = s;
    gamma_[i] = s == lower ? *p_.lo[i] : s == upper ? *p_.hi[i] : Rational(0);
  }
  std::vector<int> active_rows() const {
    std::vector<int> rows;
    for (int i = 0; i < p_.m(); ++i)
      if (state_[i] == active) rows.push_back(i);
    return rows;
  }
  /// A_FF X = B; F is independent, so its block is positive definite.
  Table solve_active(const std::vector<int>& F, const Table& B) const {
    Table A(static_cast<int>(F.size()), static_cast<int>(F.size()));
    for (int s = 0; s < A.rows; ++s)
      for (int t = 0; t < A.rows; ++t) A(s, t) = p_.A(F[s], F[t]);
    return *solve(A, B);
  }
  Rational w(int i) const {
    Rational sum = p_.b[i];
    for (int j = 0; j < p_.m(); ++j)
      if (gamma_[j] != 0) sum += p_.A(i, j) * gamma_[j];
    return sum;
  }
  /// Change of the active impulses per unit of row i's that keeps their w.
  Numbers response(int i, const std::vector<int>& F) const {
    Table B(static_cast<int>(F.size()), 1);
    for (int s = 0; s < B.rows; ++s) B(s, 0) = -p_.A(F[s], i);
    return solve_active(F, B).entry;
  }
  Rational schur(int i) const {
    const std::vector<int> F = active_rows();
    const Numbers d = response(i, F);
    Rational sum = p_.A(i, i);
    for (std::size_t s = 0; s < F.size(); ++s) sum += p_.A(i, F[s]) * d[s];
    return sum;
  }
  void place_active() {
    const std::vector<int> F = active_rows();
    for (const int i : F) gamma_[i] = 0;
    Table B(static_cast<int>(F.size()), 1);
    for (int s = 0; s < B.rows; ++s) B(s, 0) = -w(F[s]);
    const Table x = solve_active(F, B);
    for (int s = 0; s < B.rows; ++s) gamma_[F[s]] = x(s, 0);
  }
  bool drop_beyond_bounds() {
    const std::size_t before = active_rows().size();
    for (const int i : active_rows()) {
      if (p_.lo[i] && gamma_[i] < *p_.lo[i]) rest(i, lower);
      else if (p_.hi[i] && gamma_[i] > *p_.hi[i]) rest(i, upper);
    }
    return active_rows().size() < before;
  }
  int violated() const {
    for (int i = 0; i < p_.m(); ++i) {
      if (state_[i] == active || (p_.lo[i] && p_.hi[i] && *p_.lo[i] == *p_.hi[i])) continue;
      const int sign = sgn(w(i));
      if ((sign < 0 && state_[i] != upper) || (sign > 0 && state_[i] != lower)) return i;
    }
    return -1;
  }
  /// Until row i holds or is at its far bound. false: nothing blocks, and certificate_ says why there is no solution.
  bool treat(int i) {
    const int sign = -sgn(w(i));
    while (true) {
      const std::vector<int> F = active_rows();
      Numbers d = response(i, F);
      Rational slope = p_.A(i, i);
      for (std::size_t s = 0; s < F.size(); ++s) slope += p_.A(i, F[s]) * d[s];
      std::optional<Rational> length;
      int blocking = -1;
      State to = active;
      const auto block = [&](const Rational& step, int row, State state) {
        if (length && *length <= step) return;
        length = step;
        blocking = row;
        to = state;
      };
      if (slope > 0) block(abs(w(i)) / slope, i, active);
      if (const auto& far = sign > 0 ? p_.hi[i] : p_.lo[i]) block(abs(*far - gamma_[i]), i, sign > 0 ? upper : lower);
      for (std::size_t s = 0; s < F.size(); ++s) {
        d[s] *= sign;
        const auto& bound = d[s] > 0 ? p_.hi[F[s]] : p_.lo[F[s]];
        if (d[s] != 0 && bound) block((*bound - gamma_[F[s]]) / d[s], F[s], d[s] > 0 ? upper : lower);
      }
      if (!length) {
        certificate_.assign(p_.m(), 0);
        certificate_[i] = sign;
        for (std::size_t s = 0; s < F.size(); ++s) certificate_[F[s]] = d[s];
        return false;
      }
      for (std::size_t s = 0; s < F.size(); ++s) gamma_[F[s]] += *length * d[s];
      gamma_[i] += sign * *length;
      if (to == active)
        state_[i] = active;
      else
        rest(blocking, to);
      if (blocking == i) return true;
    }
  }

  const Reduced& p_;
  std::vector<State> state_;
  Numbers gamma_, certificate_;
};

}  // namespace

Truth truth(const Reduced& problem, const std::vector<int>& active) { return Method(problem, active).run(); }

std::string fault(const Reduced& p, const Truth& t) {
  for (int i = 0; i < p.m(); ++i) {
    const std::string name = " at row " + std::to_string(p.row[i]);
    if (t.feasible) {
      Rational w = p.b[i];
      for (int j = 0; j < p.m(); ++j) w += p.A(i, j) * t.gamma[j];
      if ((p.lo[i] && t.gamma[i] < *p.lo[i]) || (p.hi[i] && t.gamma[i] > *p.hi[i])) return "impulse beyond its bounds" + name;
      if (w > 0 && !(p.lo[i] && t.gamma[i] == *p.lo[i])) return "w > 0 and not at lo" + name;
      if (w < 0 && !(p.hi[i] && t.gamma[i] == *p.hi[i])) return "w < 0 and not at hi" + name;
    } else {
      Rational moved = 0;  // A y = 0 exactly when Jᵀy = 0 and Σy = 0
      for (int j = 0; j < p.m(); ++j) moved += p.A(i, j) * t.y[j];
      if (moved != 0) return "A y is not 0" + name;
      if ((t.y[i] > 0 && p.hi[i]) || (t.y[i] < 0 && p.lo[i])) return "y against a finite bound" + name;
    }
  }
  if (t.feasible) return "";
  Rational gap = 0;  // yᵀ(r − J v) = −yᵀb for every v, since Jᵀy = 0
  for (int i = 0; i < p.m(); ++i) gap -= t.y[i] * p.b[i];
  return gap > 0 ? "" : "no gap";
}

}  // namespace exact
