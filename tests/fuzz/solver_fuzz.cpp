// The solver: bytes become a small problem, everything that is called solved is recomputed from the input in long double, every certificate
// is checked. A wrong answer is a finding, whatever the numbers were.
#include <cmath>

#include "assemble/contacts.h"
#include "contact_solver.h"
#include "factorize/extended.h"
#include "input.h"
#include "support/build.h"
#include "support/dense.h"

namespace {

using fuzz::Input;
using support::Dense;
using support::Real;
using support::Vector;

constexpr Real rounding_of_denormals = 1e-321L;  ///< what a few products lose in double when they underflow
constexpr double rounding_of_errors = 1 + 1e-3;  ///< of the report, computed in double

double positive(Input& in) {
  const double x = std::fabs(in.number());
  return x > 0 ? x : 1;
}

void add_body(Input& in, mlcp::Problem& p) {
  const int d = in.integer(1, 3);
  Eigen::MatrixXd mass = Eigen::MatrixXd::Zero(d, d);
  for (int j = 0; j < d; ++j) mass(j, j) = positive(in);
  if (in.flag())
    for (int j = 1; j < d; ++j) mass(j, j - 1) = mass(j - 1, j) = in.number();
  const int body = in.one_in(4) ? support::add_sparse_body(p, mass) : support::add_body(p, mass);
  if (in.one_in(5)) support::prescribe(p, body, std::vector<double>(static_cast<std::size_t>(d), in.number()));
}

support::Bounds bounds(Input& in) {
  switch (in.integer(0, 5)) {
    case 0: return support::bilateral;
    case 1: {
      const double lo = in.number();
      return {lo, lo + std::fabs(in.number())};
    }
    case 2: return {-mlcp::infinity, in.number()};
    default: return support::unilateral;
  }
}

/// Entries anywhere; now and then those of an earlier row, scaled.
std::vector<support::Entry> entries(Input& in, const mlcp::Problem& p) {
  std::vector<support::Entry> row;
  if (p.m() > 0 && in.one_in(4)) {
    const int twin = in.integer(0, p.m() - 1);
    const double scale = in.flag() ? 1 : in.number();
    for (auto t = p.jacobian.pointers[twin]; t < p.jacobian.pointers[twin + 1]; ++t)
      row.push_back({p.jacobian.indices[t], scale * p.jacobian.values[t]});
    return row;
  }
  for (int j = 0; j < p.n(); ++j)
    if (in.flag()) row.push_back({j, in.number()});
  return row;
}

void declare_contacts(Input& in, mlcp::Problem& p) {
  std::int32_t row = in.integer(0, 3);
  for (const int dimension = in.integer(2, 3); row + dimension <= p.m(); row += dimension) {
    const mlcp_friction model = in.integer(MLCP_FRICTION_NONE, MLCP_FRICTION_FINDEX);
    const double mu = std::fabs(in.number()), bound = std::fabs(in.number());
    try {
      mlcp::contacts_declare(p, 1, dimension, &row, {&model, &mu, &bound, nullptr});
    } catch (const mlcp::Error&) {  // its rows are bilateral
    }
  }
}

void add_rows(Input& in, mlcp::Problem& p) {
  const int rows = in.integer(0, 9);
  const bool reduced = p.n() == 0, contacts = in.one_in(3);
  for (int i = 0; i < rows; ++i)
    support::add_row(p, entries(in, p), in.number(), contacts && !in.one_in(6) ? support::unilateral : bounds(in),
                     in.one_in(4) && !reduced ? std::fabs(in.number()) : 0, static_cast<std::uint64_t>(in.integer(0, 4)));
  if (reduced || in.one_in(6)) {
    Eigen::MatrixXd factor = Eigen::MatrixXd::Zero(rows, in.integer(1, 9));
    for (int i = 0; i < factor.size(); ++i) factor.data()[i] = in.integer(-2, 2);
    support::set_sigma(p, factor * factor.transpose());
  }
  if (contacts) declare_contacts(in, p);
}

mlcp::Problem make_problem(Input& in) {
  mlcp::Problem p = support::empty_problem();
  for (int bodies = in.integer(0, 4); bodies > 0; --bodies) add_body(in, p);
  Eigen::VectorXd k(p.n());
  for (int j = 0; j < p.n(); ++j) k[j] = in.number();
  support::set_k(p, k);
  add_rows(in, p);
  return p;
}

mlcp::Mask any_mask(Input& in, int rows) {
  std::vector<mlcp_row_state> states;
  for (int i = 0; i < rows; ++i) states.push_back(static_cast<mlcp_row_state>(in.integer(0, 3)));
  return support::mask_of(states);
}

mlcp::Settings make_settings(Input& in) {
  mlcp::Settings s = mlcp::default_settings();
  s.method = in.integer(0, 3);
  s.pivot_rule = in.integer(0, 1);
  s.refactorize = in.one_in(5);
  s.impulses = in.one_in(4);
  s.canonical = in.one_in(4);
  s.warm_start = in.flag();
  s.tolerance = in.one_in(4) ? 1e-12 : 1e-9;
  s.max_work = in.one_in(6) ? in.integer(1, 200) : 30000;
  s.max_shifts = 60;
  return s;
}

/// Distance of (n, t) to the circular cone t ≤ c n, whose edge doubles hit to rounding.
Real distance(Real n, Real t, Real c) {
  if (t <= c * n * (1 + 4 * std::numeric_limits<double>::epsilon())) return 0;
  if (c * t <= -n) return std::hypot(n, t);
  return (t - c * n) / std::sqrt(1 + c * c);
}

/// The law of contact c, as the header states its error: max(a dist(γ, K), dist(w̃, K*), |γ·w̃|/|γ|) over the scale.
Real cone_error(const mlcp::Contact& c, const Vector& w, const Vector& gamma, const Vector& a, const Vector& scale) {
  const int last = c.row + c.dimension - 1;
  Real slip = 0, force = 0, power = 0, mean = a[c.row], largest = scale[c.row];
  for (int i = c.row + 1; i <= last; ++i) {
    slip = std::hypot(slip, w[i]);
    force = std::hypot(force, gamma[i]);
    power += w[i] * gamma[i];
    mean += a[i];
    largest = std::max(largest, scale[i]);
  }
  mean /= c.dimension;
  const Real mu = c.mu, normal = w[c.row] + (c.model == MLCP_FRICTION_COULOMB ? mu * slip : 0), g = std::hypot(gamma[c.row], force);
  power += normal * gamma[c.row];
  const Real dual = mu * slip <= normal ? 0 : slip <= -mu * normal ? std::hypot(normal, slip) : (mu * slip - normal) / std::sqrt(1 + mu * mu);
  const Real error = std::max({mean * distance(gamma[c.row], force, mu), dual, g > 0 ? std::fabs(power) / g : Real(0)});
  return error <= rounding_of_denormals ? 0 : largest > 0 ? error / largest : error;
}

/// Σ|terms| and w of every row, and its scale a: see the header. w in more than long double: the law of Coulomb takes µ times the slip.
struct RowNumbers {
  Vector w, size, a;
  explicit RowNumbers(const Dense& d, const Vector& v, const Vector& gamma) : w(d.m()), size(d.r.cwiseAbs()), a(d.S.diagonal()) {
    for (int i = 0; i < d.m(); ++i) {
      mlcp::Extended slack = -d.r[i];
      for (int j = 0; j < d.n(); ++j) {
        const Real v0 = d.dynamic[j] ? d.k[j] / d.M(j, j) : v[j];
        slack += static_cast<mlcp::Extended>(d.J(i, j)) * v[j];
        size[i] += std::fabs(d.J(i, j)) * (std::fabs(v[j]) + std::fabs(v0));
        if (d.dynamic[j]) a[i] += d.J(i, j) * d.J(i, j) / d.M(j, j);
      }
      for (int s = 0; s < d.m(); ++s) {
        slack += static_cast<mlcp::Extended>(d.S(i, s)) * gamma[s];
        size[i] += std::fabs(d.S(i, s) * gamma[s]);
      }
      w[i] = static_cast<Real>(slack);
    }
  }
};

/// CONVEX and COULOMB with µ > 0 and all their rows.
bool has_cone(const mlcp::Contact& c, const Dense& d) {
  if ((c.model != MLCP_FRICTION_CONVEX && c.model != MLCP_FRICTION_COULOMB) || !(c.mu > 0)) return false;
  for (int i = c.row; i < c.row + c.dimension; ++i)
    if (!d.enabled[i]) return false;
  return true;
}

/// Friction rows of contacts that have none are left out, those of FINDEX have the bounds that the normal impulse gives.
void apply_friction(const mlcp::Problem& p, const Vector& gamma, Dense& d) {
  for (const mlcp::Contact& c : p.contacts) {
    const bool left_out = !d.enabled[c.row] || (c.model <= MLCP_FRICTION_COULOMB && !has_cone(c, d));
    for (int i = c.row + 1; i < c.row + c.dimension; ++i) {
      if (left_out) d.enabled[i] = false;
      if (c.model != MLCP_FRICTION_FINDEX) continue;
      // as doubles: a row that nothing moves measures its impulse by the largest a, which may be 1e13 times what one rounding is
      d.hi[i] = static_cast<double>(c.mu * std::max(gamma[c.row], Real(0)));
      d.lo[i] = -d.hi[i];
    }
  }
}

void check_solved(const mlcp::Problem& p, const mlcp::Mask* enabled, const mlcp::Result& result, double tolerance) {
  Dense d = support::dense(p, enabled);
  const Vector v = support::widen(result.v.span()), gamma = support::widen(result.gamma.span());
  apply_friction(p, gamma, d);
  const support::DenseErrors errors = support::errors_of(d, v, gamma, rounding_of_denormals);
  fuzz::require(errors.momentum <= tolerance * rounding_of_errors, "momentum of a solved problem");
  const RowNumbers rows(d, v, gamma);
  for (const mlcp::Contact& c : p.contacts) {
    if (!has_cone(c, d)) continue;
    fuzz::require(cone_error(c, rows.w, gamma, rows.a, rows.size) <= tolerance * rounding_of_errors, "the law of a contact of a solved problem");
    for (int i = c.row; i < c.row + c.dimension; ++i) d.enabled[i] = false;
  }
  for (int i = 0; i < d.m(); ++i)
    fuzz::require(!d.enabled[i] || errors.row[i] <= tolerance * rounding_of_errors, "a row of a solved problem");
}

void check(const mlcp::Problem& p, const mlcp::Mask* enabled, const mlcp::ContactSolver& solver, const mlcp_report& report) {
  const mlcp::Result& result = solver.result();
  fuzz::require(report.outcome >= MLCP_SOLVED && report.outcome < MLCP_BAD_INPUT, "an outcome that the header has");
  if (report.outcome == MLCP_SOLVED) {
    fuzz::require(report.largest_error <= solver.settings().tolerance, "solved is within the tolerance");
    check_solved(p, enabled, result, solver.settings().tolerance);
  }
  if (!p.contacts.empty()) return;
  const Dense d = support::dense(p, enabled);
  for (const mlcp::CertificateRange& c : result.certificates) {
    const std::string fault = support::certificate_fault(d, result.certificate_row.span().subspan(c.first, c.count),
                                                         result.certificate_y.span().subspan(c.first, c.count));
    fuzz::require(fault.empty(), fault.c_str());
  }
}

}  // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Input in(data, size);
  try {
    const mlcp::Settings settings = make_settings(in);
    mlcp::Problem p = make_problem(in);
    mlcp::ContactSolver solver(settings, mlcp::Memory());
    mlcp_report report{};
    // a step, and another one with other rows and from another start, by the same solver
    for (int step = 0; step < 2; ++step) {
      const mlcp::Mask enabled = any_mask(in, p.m()), start = any_mask(in, p.m());
      const mlcp::Mask* left = in.one_in(3) ? &enabled : nullptr;
      solver.solve(p, left, in.one_in(3) ? &start : nullptr, report);
      check(p, left, solver, report);
    }
  } catch (const mlcp::Error& e) {
    fuzz::require(e.status == MLCP_ERROR_ARGUMENT || e.status == MLCP_ERROR_RANGE, e.text);  // numbers that are not legal
  }
  return 0;
}
