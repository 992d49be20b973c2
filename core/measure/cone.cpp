#include "measure/cone.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace mlcp {
namespace {

double dot(const ContactVector& a, const ContactVector& b) { return a.n * b.n + mlcp::dot(a.t, b.t); }
double length(const ContactVector& a) { return std::sqrt(dot(a, a)); }
ContactVector scaled(double s, const ContactVector& a) { return {s * a.n, {s * a.t.x, s * a.t.y}}; }
ContactVector sum(const ContactVector& a, const ContactVector& b) { return {a.n + b.n, {a.t.x + b.t.x, a.t.y + b.t.y}}; }
ContactVector difference(const ContactVector& a, const ContactVector& b) { return {a.n - b.n, {a.t.x - b.t.x, a.t.y - b.t.y}}; }

/// A power of two next to the largest of the numbers, 1 for zeros: squares of what is divided by it are in range.
double magnitude(double x, double y, double z = 0) {
  const double largest = std::max({std::abs(x), std::abs(y), std::abs(z)});
  int exponent = 0;
  std::frexp(largest, &exponent);
  return largest > 0 ? std::ldexp(1.0, std::clamp(exponent, -1021, 1023)) : 1.0;
}

/// Angle of t in units of the pyramid's sectors, 0 … N.
double sector_angle(Tangent t, std::int32_t facets) {
  const long double turn = std::atan2(static_cast<long double>(t.y), static_cast<long double>(t.x)) / (2 * std::numbers::pi_v<long double>);
  return static_cast<double>((turn < 0 ? turn + 1 : turn) * facets);
}

Tangent computed_direction(std::int32_t j, std::int32_t facets) {
  if (2 * j % facets == 0) return {j % facets == 0 ? 1.0 : -1.0, 0};
  const long double angle = 2 * std::numbers::pi_v<long double> * j / facets;
  const bool upright = 4 * std::int64_t(j) % facets == 0;
  return {upright ? 0.0 : static_cast<double>(std::cos(angle)), static_cast<double>(std::sin(angle))};
}

/// Those of the pyramids that are common, since a sine takes longer than all else that is done with a facet.
class CommonDirections {
 public:
  static constexpr std::int32_t most_facets = 16;
  CommonDirections() {
    for (std::int32_t n = 1; n <= most_facets; ++n)
      for (std::int32_t j = 0; j < n; ++j) directions_[n - 1][j] = computed_direction(j, n);
  }
  Tangent operator()(std::int32_t j, std::int32_t facets) const { return directions_[facets - 1][j]; }

 private:
  Tangent directions_[most_facets][most_facets];
};

}  // namespace

double length(Tangent t) {
  const double unit = magnitude(t.x, t.y), x = t.x / unit, y = t.y / unit;
  return unit * std::sqrt(x * x + y * y);
}

Tangent Cone::direction(std::int32_t j) const {
  if (facets > CommonDirections::most_facets || j < 0 || j >= facets) return computed_direction(j, facets);
  static const CommonDirections common;
  return common(j, facets);
}

std::int32_t Cone::nearest_facet(Tangent t) const {
  const auto j = static_cast<std::int32_t>(std::ceil(sector_angle(t, facets) - 0.5));
  return j >= facets ? 0 : j;
}

Tangent Cone::against(Tangent slip) const {
  const double size = length(slip);
  if (!(size > 0 && size < std::numeric_limits<double>::infinity())) return {};
  const Tangent d{-slip.x / size, planar ? 0 : -slip.y / size};
  return pyramid() ? direction(nearest_facet(d)) : d;
}

double Cone::support(Tangent slip) const { return pyramid() ? std::max(0.0, -mlcp::dot(against(slip), slip)) : length(slip); }

ContactVector Cone::project_circular(const ContactVector& x) const {
  const double s = mlcp::length(x.t);
  if (s <= mu * x.n) return x;
  if (mu * s <= -x.n || s == 0) return {};
  const double up = mu > 1 ? 1 / mu : 1, out = mu > 1 ? 1 : mu;  // along the edge: (1, µ), or as long and in range for any µ
  const double along = (up * x.n + out * s) / (up * up + out * out), t = out * along / s;
  return {up * along, {t * x.t.x, t * x.t.y}};
}

/// The pyramid is symmetric about the planes through its edges and the middles of its facets, so that a point and its projection lie in the
/// same sector: two generators are all that matter.
ContactVector Cone::project_sector(const ContactVector& x) const {
  const auto j = static_cast<std::int32_t>(std::floor(sector_angle(x.t, facets)));
  const Tangent d = direction(j), e = direction(j + 1);
  const double up = mu > 1 ? 1 / mu : 1, out = mu > 1 ? 1 : mu;
  const ContactVector g{up, {out * d.x, out * d.y}}, h{up, {out * e.x, out * e.y}};
  // the facet's inner normal: g × h, upwards
  const ContactVector normal{out * (d.x * e.y - d.y * e.x), {up * (d.y - e.y), up * (e.x - d.x)}};
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
  // all of it is homogeneous in γ and in w
  const double gamma_unit = magnitude(gamma.n, gamma.t.x, gamma.t.y), w_unit = magnitude(w.n, w.t.x, w.t.y);
  const ContactVector g = scaled(1 / gamma_unit, gamma), u = scaled(1 / w_unit, w);
  const double size = length(g), outside = a * (gamma_unit * length(difference(g, project(g)))), dual = w_unit * length(project(scaled(-1, u)));
  const double power = size > 0 ? w_unit * (std::abs(dot(g, u)) / size) : 0.0;
  return std::isnan(outside + dual + power) ? std::numeric_limits<double>::infinity() : std::max({outside, dual, power});
}

}  // namespace mlcp
