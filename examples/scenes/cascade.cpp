#include "cascade.h"

#include <array>
#include <cmath>
#include <utility>

#include "geometry/capsule_contacts.h"
#include "geometry/sphere_contacts.h"
#include "grid.h"
#include "random.h"

namespace scenes {
namespace {

constexpr double density = 1000;      // kg/m³
constexpr double pi = 3.14159265358979323846;
constexpr double radius = 0.05, largest = 1.15 * radius;  // m
constexpr double pill_half_length = 0.035;
// contacts are listed when their gap is below margin + horizon · the speed at which the bodies may meet
constexpr double margin = 0.005, horizon = 1.5 * default_step, fastest = 6;  // m, s, m/s
constexpr double half_depth = 0.16;   // between the panes
constexpr double half_width = 0.75;   // of the bin
constexpr Material rock = {.friction = 0.2, .restitution = 0.2};
constexpr Material pane = {.friction = 0.05};

/// A tray from its upper end to its lower end, seen from the front.
struct Tray {
  double x0, z0, x1, z1;
  static constexpr double half_thickness = 0.02;
  Box box() const { return {{0.5 * std::hypot(x1 - x0, z1 - z0), half_depth, half_thickness}}; }
  Frame frame() const {
    const double slope = std::atan2(z1 - z0, x1 - x0);
    return {{0.5 * (x0 + x1), 0, 0.5 * (z0 + z1)}, Rotation::about(axes[1], -slope)};
  }
};

constexpr Tray trays[] = {{-0.75, 2.35, 0.25, 2.00}, {0.75, 1.85, -0.25, 1.50}, {-0.75, 1.35, 0.25, 1.00}, {0.75, 0.85, -0.25, 0.55}};

const std::pair<Plane, Material> walls[] = {{{{0, 0, 1}, 0}, rock},
                                            {{{1, 0, 0}, -half_width}, rock},
                                            {{{-1, 0, 0}, -half_width}, rock},
                                            {{{0, 1, 0}, -half_depth}, pane},
                                            {{{0, -1, 0}, -half_depth}, pane}};

}  // namespace

struct Cascade::Pieces {
  std::vector<Capsule> shapes;
  std::vector<RigidBody> bodies;

  /// A lattice above the highest tray, loosened at random; every third one is a pill.
  Pieces(std::int32_t count, unsigned seed) {
    Random random(seed);
    constexpr int across = 5, deep = 2;
    const double cell = 2.15 * largest;
    for (std::int32_t i = 0; i < count; ++i) {
      const bool pill = i % 3 == 2;
      const double size = (pill ? 0.75 : 1) * random.uniform(0.85, 1.15) * radius;
      const std::int32_t column = i % across, row = i / across % deep, layer = i / (across * deep);
      Frame frame = {{-half_width + largest + 0.02 + cell * column, (row - 0.5) * cell, 2.50 + 1.05 * cell * layer}};
      for (double& coordinate : frame.origin) coordinate += random.uniform(-0.004, 0.004);
      if (pill) frame.rotation = Rotation::about(unit({1, random.uniform(-0.3, 0.3), 0}), random.uniform(-0.6, 0.6));
      shapes.push_back({pill ? pill_half_length : 0, size});
      const double length = 2 * shapes.back().half_length;
      bodies.push_back(solid(shapes.back(), density * pi * size * size * (length + 4.0 / 3 * size), frame));
    }
  }
};

Cascade::Cascade(std::int32_t bodies, unsigned seed) : Cascade(Pieces(bodies, seed)) {}

Cascade::Cascade(Pieces&& pieces) : RigidScene(Motion::Space, std::move(pieces.bodies)), shapes_(std::move(pieces.shapes)) {}

void Cascade::add_contacts(ContactList& contacts) const {
  const auto near = [&](std::int32_t a, std::int32_t b, ContactPoint at, std::int32_t feature, const Material& material) {
    at.feature = feature;
    if (at.gap <= margin + horizon * length(velocity_of(b) - velocity_of(a))) add_contact(contacts, a, b, at, material);
  };
  const auto count = static_cast<std::int32_t>(shapes_.size());
  std::vector<Point> centres;
  for (std::int32_t body = 0; body < count; ++body) {
    const Frame& at = frame(body);
    centres.push_back(at.origin);
    const double half = shape(body).half_length;
    std::int32_t feature = 0;
    for (const auto& [plane, material] : walls) {
      const std::array<ContactPoint, 2> ends = scenes::contacts(plane, {}, shape(body), at);
      for (const ContactPoint& end : std::span(ends).first(half > 0 ? 2 : 1)) near(MLCP_WORLD, body, end, feature++, material);
    }
    const Sphere part = {shape(body).radius};
    const std::array<double, 3> along = {0, -half, half};
    for (const Tray& tray : trays) {
      for (const double z : std::span(along).first(half > 0 ? 3 : 1))
        near(MLCP_WORLD, body, contact(tray.box(), tray.frame(), part, at.to_world({0, 0, z})), feature++, rock);
    }
  }
  for (const auto& [a, b] : near_pairs(centres, 2 * (largest + pill_half_length) + horizon * fastest))
    for (const ContactPoint& at : scenes::contacts(shape(a), frame(a), shape(b), frame(b))) near(a, b, at, at.feature, rock);
}

void Cascade::draw(Drawing& to) const {
  using Role = Drawing::Role;
  to.eye = {0.25, -1, 0.25};
  const auto wall = [&](const Point& centre, const Point& half_extent) { scenes::draw(to, Box{half_extent}, {centre}, Role::Machine); };
  wall({0, 0, -0.02}, {half_width + 0.04, half_depth, 0.02});
  for (const double side : {-1.0, 1.0}) wall({side * (half_width + 0.02), 0, 1.3}, {0.02, half_depth, 1.3});
  for (const Tray& tray : trays) scenes::draw(to, tray.box(), tray.frame(), Role::Machine);
  for (std::int32_t body = 0; body < static_cast<std::int32_t>(shapes_.size()); ++body) {
    if (shape(body).half_length > 0)
      scenes::draw(to, shape(body), frame(body), Role::Product);
    else
      to.spheres.push_back({frame(body).origin, shape(body).radius});
  }
  draw_actions(to);
}

}  // namespace scenes
