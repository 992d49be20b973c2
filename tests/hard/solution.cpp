#include "hard/solution.h"

#include <algorithm>
#include <cmath>

#include "scenes/handles.h"

namespace hard {
namespace {

using Real = long double;
using handles::check;

struct Numbers {
  mlcp_matrix_view M, J, S;
  std::vector<double> k, r, lo, hi, given;
  std::vector<bool> prescribed;

  explicit Numbers(const mlcp_problem* problem) {
    for (mlcp_matrix_view* view : {&M, &J, &S}) mlcp_matrix_view_init(view, sizeof *view);
    check(mlcp_problem_mass(problem, &M));
    check(mlcp_problem_jacobian(problem, &J));
    check(mlcp_problem_compliance(problem, &S));
    const std::int32_t n = M.rows, m = J.rows;
    k.resize(static_cast<std::size_t>(n));
    given.resize(k.size());
    prescribed.resize(k.size());
    for (std::vector<double>* x : {&r, &lo, &hi}) x->resize(static_cast<std::size_t>(m));
    check(mlcp_problem_get_momentum(problem, n, k.data()));
    check(mlcp_problem_get_rows(problem, m, r.data(), lo.data(), hi.data(), nullptr, nullptr));
    std::int32_t count = 0;
    check(mlcp_problem_bodies(problem, 0, nullptr, &count));
    std::vector<std::int32_t> ids(static_cast<std::size_t>(count));
    check(mlcp_problem_bodies(problem, count, ids.data(), &count));
    for (const std::int32_t id : ids) {
      std::int32_t offset = 0, dimension = 0, fixed = 0;
      check(mlcp_problem_body_range(problem, id, &offset, &dimension));
      check(mlcp_problem_body_state(problem, id, &fixed, dimension, given.data() + offset));
      std::fill_n(prescribed.begin() + offset, dimension, fixed != 0);
    }
  }
  std::size_t n() const { return k.size(); }
  std::size_t m() const { return r.size(); }
};

/// f(outer, inner, value) for every entry.
template <class Visit>
void each(const mlcp_matrix_view& a, std::int32_t outer, Visit visit) {
  for (std::int32_t o = 0; o < outer; ++o)
    for (std::int32_t t = a.pointers[o]; t < a.pointers[o + 1]; ++t)
      visit(static_cast<std::size_t>(o), static_cast<std::size_t>(a.indices[t]), static_cast<Real>(a.values[t]));
}

Real momentum_error(const Numbers& p, const std::vector<double>& v, const std::vector<double>& gamma) {
  std::vector<Real> sum(p.k.begin(), p.k.end()), size(p.n());
  for (std::size_t j = 0; j < p.n(); ++j) size[j] = std::abs(sum[j]), sum[j] = -sum[j];
  const auto add = [&](std::size_t j, Real term) {
    sum[j] += term;
    size[j] += std::abs(term);
  };
  each(p.M, p.M.columns, [&](std::size_t j, std::size_t i, Real x) { add(i, x * v[j]); });
  each(p.J, p.J.rows, [&](std::size_t i, std::size_t j, Real x) { add(j, -x * gamma[i]); });
  Real worst = 0;
  for (std::size_t j = 0; j < p.n(); ++j)
    if (!p.prescribed[j]) worst = std::max(worst, size[j] > 0 ? std::abs(sum[j]) / size[j] : std::abs(sum[j]));
  return worst;
}

struct Rows {
  std::vector<Real> w, scale, a;
};

Rows rows_of(const Numbers& p, const std::vector<double>& v, const std::vector<double>& gamma) {
  std::vector<Real> diagonal(p.n(), 1);
  each(p.M, p.M.columns, [&](std::size_t j, std::size_t i, Real x) {
    if (i == j && x > 0) diagonal[j] = x;
  });
  Rows rows{std::vector<Real>(p.m()), std::vector<Real>(p.m()), std::vector<Real>(p.m())};
  for (std::size_t i = 0; i < p.m(); ++i) {
    rows.w[i] = -static_cast<Real>(p.r[i]);
    rows.scale[i] = std::abs(p.r[i]);
  }
  each(p.J, p.J.rows, [&](std::size_t i, std::size_t j, Real x) {
    const Real v0 = p.prescribed[j] ? v[j] : p.k[j] / diagonal[j];
    rows.w[i] += x * v[j];
    rows.scale[i] += std::abs(x) * (std::abs(static_cast<Real>(v[j])) + std::abs(v0));
    if (!p.prescribed[j]) rows.a[i] += x * x / diagonal[j];
  });
  each(p.S, p.S.columns, [&](std::size_t j, std::size_t i, Real x) {
    rows.w[i] += x * gamma[j];
    rows.scale[i] += std::abs(x * gamma[j]);
    if (i == j) rows.a[i] += x;
  });
  const Real largest = rows.a.empty() ? 0 : *std::max_element(rows.a.begin(), rows.a.end());
  for (Real& a : rows.a)
    if (!(a > 0)) a = largest > 0 ? largest : 1;
  return rows;
}

/// Distance from (normal, tangent) to the cone tangent ≤ slope · normal.
Real to_cone(Real normal, Real tangent, Real slope) {
  if (tangent <= slope * normal) return 0;
  return slope * tangent <= -normal ? std::hypot(normal, tangent) : (tangent - slope * normal) / std::sqrt(1 + slope * slope);
}

struct Contact {
  std::size_t row, dimension;
  Real mu;
};

Real contact_error(const Rows& rows, const std::vector<double>& gamma, const Contact& c) {
  Real slip = 0, pull = 0, a = 0, scale = 0, work = 0;
  for (std::size_t t = 0; t < c.dimension; ++t) {
    const std::size_t i = c.row + t;
    a += rows.a[i] / static_cast<Real>(c.dimension);
    scale = std::max(scale, rows.scale[i]);
    work += gamma[i] * rows.w[i];
    if (t == 0) continue;
    slip += rows.w[i] * rows.w[i];
    pull += static_cast<Real>(gamma[i]) * gamma[i];
  }
  slip = std::sqrt(slip);
  pull = std::sqrt(pull);
  const Real normal = gamma[c.row], w = rows.w[c.row] + c.mu * slip, size = std::hypot(normal, pull);
  work += normal * c.mu * slip;
  // K* is the cone of slope 1/µ
  const Real defect = std::max({a * to_cone(normal, pull, c.mu), to_cone(w, slip, 1 / c.mu), size > 0 ? std::abs(work) / size : 0});
  return scale > 0 ? defect / scale : defect;
}

/// COULOMB contacts: their rows count there and not as rows; without friction there is only the normal one, which is a row like others.
std::vector<Contact> contacts_of(const mlcp_problem* problem) {
  const std::int32_t count = mlcp_problem_contact_count(problem);
  const auto size = static_cast<std::size_t>(count);
  std::vector<std::int32_t> row(size), dimension(size);
  std::vector<double> mu(size);
  check(mlcp_problem_get_contacts(problem, count, row.data(), dimension.data(), nullptr, mu.data(), nullptr));
  std::vector<Contact> contacts;
  for (std::size_t c = 0; c < size; ++c)
    contacts.push_back({static_cast<std::size_t>(row[c]), static_cast<std::size_t>(dimension[c]), mu[c]});
  return contacts;
}

bool finite(const std::vector<double>& x) {
  return std::all_of(x.begin(), x.end(), [](double y) { return std::isfinite(y); });
}

}  // namespace

Solution solve(const mlcp_problem* problem, mlcp_method method, double tolerance, std::int64_t max_iterations) {
  mlcp_settings settings;
  mlcp_settings_init(&settings, sizeof settings);
  settings.method = method;
  settings.tolerance = tolerance;
  settings.max_iterations = max_iterations;
  const handles::Solver solver = handles::make_solver(&settings);
  Solution s;
  mlcp_report_init(&s.report, sizeof s.report);
  check(mlcp_solve(solver.get(), problem, nullptr, nullptr, &s.report), solver);
  const auto copy = [](const auto* from, std::int32_t count) { return std::vector(from, from + count); };
  const double* numbers = nullptr;
  const std::int32_t* rows = nullptr;
  std::int32_t count = 0;
  check(mlcp_solver_velocities(solver.get(), &numbers, &count), solver);
  s.v = copy(numbers, count);
  check(mlcp_solver_impulses(solver.get(), &numbers, &count), solver);
  s.gamma = copy(numbers, count);
  if (mlcp_solver_certificate(solver.get(), -1, &rows, &numbers, &count) == MLCP_OK) {
    s.certificate_row = copy(rows, count);
    s.certificate_y = copy(numbers, count);
  }
  return s;
}

double largest_error(const mlcp_problem* problem, const std::vector<double>& v, const std::vector<double>& gamma) {
  if (!finite(v) || !finite(gamma)) return HUGE_VAL;
  const Numbers p(problem);
  const Rows rows = rows_of(p, v, gamma);
  Real worst = momentum_error(p, v, gamma);
  std::vector<bool> in_cone(p.m());
  for (const Contact& c : contacts_of(problem)) {
    if (c.mu > 0) worst = std::max(worst, contact_error(rows, gamma, c));
    std::fill_n(in_cone.begin() + static_cast<std::ptrdiff_t>(c.row), c.dimension, true);
    if (c.mu == 0) in_cone[c.row] = false;
  }
  for (std::size_t i = 0; i < p.m(); ++i) {
    if (in_cone[i]) continue;
    const Real low = rows.a[i] * (gamma[i] - static_cast<Real>(p.lo[i])), high = rows.a[i] * (gamma[i] - static_cast<Real>(p.hi[i]));
    const Real defect = std::abs(std::max(high, std::min(rows.w[i], low)));
    worst = std::max(worst, rows.scale[i] > 0 ? defect / rows.scale[i] : defect);
  }
  return std::isfinite(worst) ? static_cast<double>(worst) : HUGE_VAL;
}

std::string certificate_fault(const mlcp_problem* problem, const std::vector<std::int32_t>& rows, const std::vector<double>& y) {
  constexpr Real zero = 1e-12L;
  if (rows.empty()) return "no rows";
  const Numbers p(problem);
  std::vector<Real> full(p.m()), push(p.n()), push_size(p.n()), give(p.m()), give_size(p.m());
  Real gap = 0, gap_size = 0;
  const auto widen_gap = [&](Real term) {
    gap += term;
    gap_size += std::abs(term);
  };
  for (std::size_t t = 0; t < rows.size(); ++t) {
    const auto i = static_cast<std::size_t>(rows[t]);
    if (full[i] != 0) return "row " + std::to_string(i) + " twice";
    if (!std::isfinite(y[t]) || (y[t] > 0 && p.hi[i] < HUGE_VAL) || (y[t] < 0 && p.lo[i] > -HUGE_VAL)) return "y against a bound at row " + std::to_string(i);
    full[i] = y[t];
    widen_gap(full[i] * p.r[i]);
  }
  each(p.J, p.J.rows, [&](std::size_t i, std::size_t j, Real x) {
    if (p.prescribed[j]) return widen_gap(-full[i] * x * p.given[j]);
    push[j] += x * full[i];
    push_size[j] += std::abs(x * full[i]);
  });
  each(p.S, p.S.columns, [&](std::size_t j, std::size_t i, Real x) {
    give[i] += x * full[j];
    give_size[i] += std::abs(x * full[j]);
  });
  for (std::size_t j = 0; j < p.n(); ++j)
    if (std::abs(push[j]) > zero * push_size[j]) return "J'y is not 0 at velocity " + std::to_string(j);
  for (std::size_t i = 0; i < p.m(); ++i)
    if (std::abs(give[i]) > zero * give_size[i]) return "S y is not 0 at row " + std::to_string(i);
  return gap > zero * gap_size ? "" : "no gap";
}

}  // namespace hard
