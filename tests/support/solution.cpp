#include "support/solution.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace support {
namespace {

template <class T>
std::vector<T> copy(const mlcp::Array<T>& a) {
  return {a.begin(), a.end()};
}

}  // namespace

mlcp::Settings settings(mlcp_pivot_rule rule, mlcp_refactorize refactorize) {
  mlcp::Settings s = mlcp::default_settings();
  s.method = MLCP_METHOD_SIMPLEX;
  s.pivot_rule = rule;
  s.refactorize = refactorize;
  return s;
}

mlcp::Settings automatic() {
  mlcp::Settings s = settings();
  s.method = MLCP_METHOD_AUTO;
  return s;
}

Solution solve(mlcp::Solver& solver, const mlcp::Problem& problem, const mlcp::Mask* enabled, const mlcp::Mask* start) {
  Solution s;
  s.report.struct_size = sizeof s.report;
  solver.solve(problem, enabled, start, s.report);
  const mlcp::Result& r = solver.result();
  s.v = copy(r.v);
  s.gamma = copy(r.gamma);
  s.w = copy(r.w);
  s.state = copy(r.mask.state);
  s.redundant = copy(r.redundant);
  s.row_island = copy(r.row_island);
  s.island_outcome = copy(r.island_outcome);
  s.trace = copy(r.trace);
  if (!r.certificates.empty()) {
    const mlcp::CertificateRange c = r.certificates[0];
    s.certificate_row.assign(r.certificate_row.begin() + c.first, r.certificate_row.begin() + c.first + c.count);
    s.certificate_y.assign(r.certificate_y.begin() + c.first, r.certificate_y.begin() + c.first + c.count);
  }
  return s;
}

Solution solve(const mlcp::Problem& problem, const mlcp::Settings& settings, const mlcp::Mask* enabled, const mlcp::Mask* start) {
  mlcp::Solver solver(settings, mlcp::Memory());
  return solve(solver, problem, enabled, start);
}

Solution solve(const mlcp::Problem& problem, const mlcp::Mask* enabled, const mlcp::Mask* start) {
  return solve(problem, mlcp::default_settings(), enabled, start);
}

std::string fault(const Dense& d, const Solution& s, double most) {
  std::ostringstream out;
  out.precision(17);
  if (s.report.outcome != MLCP_SOLVED) out << "outcome " << s.report.outcome << ", error " << s.report.largest_error << "; ";
  const DenseErrors e = errors_of(d, widen(s.v), widen(s.gamma));
  if (!(e.momentum <= most)) out << "momentum error " << e.momentum << " at " << e.worst_velocity << "; ";
  if (!(e.constraints <= most)) out << "constraint error " << e.constraints << " at " << e.worst_row << "; ";
  if (!(std::abs(e.momentum - s.report.momentum_error) <= 1e-15 + 1e-3 * e.momentum))
    out << "reported momentum error " << s.report.momentum_error << ", recomputed " << e.momentum << "; ";
  if (!(std::abs(e.constraints - s.report.constraint_error) <= 1e-15 + 1e-3 * e.constraints))
    out << "reported constraint error " << s.report.constraint_error << ", recomputed " << e.constraints << "; ";
  for (int i = 0; i < d.m(); ++i) {
    if (!d.enabled[i] && (s.gamma[i] != 0 || s.state[i] != MLCP_ROW_DISABLED)) out << "disabled row " << i << " acts; ";
    if (d.enabled[i] && !(s.gamma[i] >= d.lo[i] && s.gamma[i] <= d.hi[i]))
      out << "impulse " << i << " = " << s.gamma[i] << " out of its bounds; ";
  }
  return out.str();
}

std::string infeasible_fault(const Dense& d, const Solution& s) {
  if (s.report.outcome != MLCP_INFEASIBLE) return "outcome " + std::to_string(s.report.outcome) + " instead of infeasible";
  return certificate_fault(d, s.certificate_row, s.certificate_y);
}

double difference(const std::vector<double>& x, const std::vector<double>& y) {
  double worst = x.size() == y.size() ? 0 : HUGE_VAL;
  for (std::size_t i = 0; i < std::min(x.size(), y.size()); ++i) {
    const double e = std::abs(x[i] - y[i]) / std::max({1.0, std::abs(x[i]), std::abs(y[i])});
    worst = e <= worst ? worst : e;
  }
  return worst;
}

double difference(const std::vector<double>& x, const Vector& y) {
  std::vector<double> rounded(y.size());
  for (std::size_t i = 0; i < rounded.size(); ++i) rounded[i] = static_cast<double>(y[static_cast<int>(i)]);
  return difference(x, rounded);
}

}  // namespace support
