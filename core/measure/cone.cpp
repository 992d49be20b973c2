#include "measure/cone.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace mlcp {
namespace {

double dot(const ContactVector& a, const ContactVector& b) { return a.n * b.n + mlcp::dot(a.t, b.t); }
double length(const ContactVector& a) { return std::sqrt(dot(a, a)); }
ContactVector scaled(double s, const ContactVector& a) { return {s * a.n, {s * a.t.x, s * a.t.y}}; }
ContactVector sum(const ContactVector& a, const ContactVector& b) { return {a.n + b.n, {a.t.x + b.t.x, a.t.y + b.t.y}}; }
ContactVector difference(const ContactVector& a, const ContactVector& b) { return {a.n - b.n, {a.t.x - b.t.x, a.t.y - b.t.y}}; }

/// Angle of t in units of the pyramid's sectors, 0 … N.
double sector_angle(Tangent t, std::int32_t facets) {
  const long double turn = std::atan2(static_cast<long double>(t.y), static_cast<long double>(t.x)) / (2 * std::numbers::pi_v<long double>);
  return static_cast<double>((turn < 0 ? turn + 1 : turn) * facets);
}

}  // namespace

double length(Tangent t) { return std::sqrt(dot(t, t)); }

Tangent Cone::direction(std::int32_t j) const {
  if (2 * j % facets == 0) return {j % facets == 0 ? 1.0 : -1.0, 0};
  const long double angle = 2 * std::numbers::pi_v<long double> * j / facets;
  const bool upright = 4 * std::int64_t(j) % facets == 0;
  return {upright ? 0.0 : static_cast<double>(std::cos(angle)), static_cast<double>(std::sin(angle))};
}

std::int32_t Cone::nearest_facet(Tangent t) const {
  const auto j = static_cast<std::int32_t>(std::ceil(sector_angle(t, facets) - 0.5));
  return j >= facets ? 0 : j;
}

Tangent Cone::against(Tangent slip) const {
  const double size = length(slip);
  if (!(size > 0)) return {};
  const Tangent d{-slip.x / size, planar ? 0 : -slip.y / size};
  return pyramid() ? direction(nearest_facet(d)) : d;
}

double Cone::support(Tangent slip) const { return pyramid() ? std::max(0.0, -mlcp::dot(against(slip), slip)) : length(slip); }

ContactVector Cone::project_circular(const ContactVector& x) const {
  const double s = mlcp::length(x.t);
  if (s <= mu * x.n) return x;
  if (mu * s <= -x.n || s == 0) return {};
  const double n = (x.n + mu * s) / (1 + mu * mu), t = mu * n / s;
  return {n, {t * x.t.x, t * x.t.y}};
}

/// The pyramid is symmetric about the planes through its edges and the middles of its facets, so that a point and its projection lie in the
/// same sector: two generators are all that matter.
ContactVector Cone::project_sector(const ContactVector& x) const {
  const auto j = static_cast<std::int32_t>(std::floor(sector_angle(x.t, facets)));
  const Tangent d = direction(j), e = direction(j + 1);
  const ContactVector g{1, {mu * d.x, mu * d.y}}, h{1, {mu * e.x, mu * e.y}};
  // the facet's inner normal: g × h, upwards
  const ContactVector normal{mu * mu * (d.x * e.y - d.y * e.x), {mu * (d.y - e.y), mu * (e.x - d.x)}};
  if (dot(normal, x) >= 0) return x;
  // least squares over β ≥ 0 of |x − β g − δ h|
  const double gg = dot(g, g), gh = dot(g, h), hh = dot(h, h), gx = dot(g, x), hx = dot(h, x), determinant = gg * hh - gh * gh;
  const double beta = hh * gx - gh * hx, delta = gg * hx - gh * gx;
  if (beta >= 0 && delta >= 0 && determinant > 0) return sum(scaled(beta / determinant, g), scaled(delta / determinant, h));
  const bool first = gx * gx / gg >= hx * hx / hh ? gx > 0 : !(hx > 0);
  return first ? scaled(std::max(0.0, gx) / gg, g) : scaled(std::max(0.0, hx) / hh, h);
}

ContactVector Cone::project(const ContactVector& x) const {
  if (!pyramid() || mu == 0) return project_circular(x);
  if (x.t.x == 0 && x.t.y == 0) return x.n >= 0 ? x : ContactVector{};
  return project_sector(x);
}

double Cone::defect(const ContactVector& gamma, const ContactVector& w, double a) const {
  const double size = length(gamma);
  const double outside = a * length(difference(gamma, project(gamma))), dual = length(project(scaled(-1, w)));
  return std::max({outside, dual, size > 0 ? std::abs(dot(gamma, w)) / size : 0.0});
}

}  // namespace mlcp
