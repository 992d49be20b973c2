#include "bottle_line.h"

#include <algorithm>
#include <cmath>

#include "geometry/sphere_contacts.h"
#include "grid.h"
#include "random.h"

namespace scenes {
namespace {

constexpr double pi = 3.14159265358979323846;

constexpr Sphere bottle = {0.035};
constexpr double bottle_mass = 0.5, bottle_height = 0.22;
constexpr Material glass = {.friction = 0.05};
constexpr double margin = 0.01;                     // contacts wider open than this are not listed, m

// The wheel turns about the origin, counterclockwise seen from above: bottles come along y = −pitch and leave along y = +pitch.
constexpr std::int32_t fingers = 14;
constexpr double pitch = 0.20;                      // radius of the bottles' way around the wheel
constexpr Capsule finger = {0.035, 0.009};
constexpr double finger_middle = 0.168;             // distance from the wheel's axis
constexpr double wheel_speed = 1.1, clutch = 8;     // rad/s, N m

constexpr double clearance = 0.003, guide_radius = 0.006;
constexpr double from_guide = 0.035 + clearance + guide_radius;  // of the middle of a bottle that runs along it
constexpr double entry = -1.30, plate = -0.16;      // x where the belts begin and where they meet the dead plate
constexpr double wide = 0.02, funnel_begin = -0.85, funnel_end = -0.40;  // the slanting guide: from y = wide down to the lane
constexpr double belt_speed = 0.28, belt_friction = 0.3;
constexpr double shake = 2e-3, shakes = 7;          // m/s and 1/s: belts and plate shake sideways and turn the bottles a little

struct Guide {
  Point from, to;
  Frame frame() const {
    const Point along = unit(to - from);
    // a frame whose z points along; the guide lies in the plane
    return {0.5 * (from + to), {std::sqrt(0.5), std::sqrt(0.5) * cross(axes[2], along)}};
  }
  Capsule capsule() const { return {0.5 * length(to - from), guide_radius}; }
};

std::vector<Guide> make_guides() {
  const double lane = -pitch - from_guide, inner = -pitch + from_guide, back = pitch - from_guide, outer = pitch + from_guide;
  std::vector<Guide> guides = {{{entry, lane, 0}, {0, lane, 0}},
                               {{entry, wide, 0}, {funnel_begin, wide, 0}},
                               {{funnel_begin, wide, 0}, {funnel_end, inner, 0}},
                               {{funnel_end, inner, 0}, {-0.19, inner, 0}},
                               {{-0.19, back, 0}, {entry, back, 0}},
                               {{0, outer, 0}, {entry, outer, 0}}};
  // around the wheel, on the outside of its chords
  constexpr int parts = 24;
  const double radius = (pitch + from_guide) / std::cos(0.5 * pi / parts);
  const auto at = [&](int i) { return Point{radius * std::sin(pi * i / parts), -radius * std::cos(pi * i / parts), 0}; };
  for (int i = 0; i < parts; ++i) guides.push_back({at(i), at(i + 1)});
  return guides;
}

const std::vector<Guide>& guides() {
  static const std::vector<Guide> made = make_guides();
  return made;
}

/// Finger i of the wheel in the wheel's frame, its z axis away from the middle.
Frame finger_frame(std::int32_t i) {
  const Rotation turn = Rotation::about(axes[2], 2 * pi * i / fingers);
  return {turn * Point{finger_middle, 0, 0}, turn * Rotation::about(axes[1], 0.5 * pi)};
}

/// Places on the infeed belt, staggered rows across, filled from the front.
Point place(std::int32_t i) {
  constexpr std::int32_t across = 2;
  const std::int32_t row = i / across, column = i % across;
  return {funnel_begin + 0.05 - 0.085 * row, -pitch + 0.085 * column + (row % 2 == 0 ? 0.0 : 0.04), 0};
}

std::vector<RigidBody> bodies_of(std::int32_t bottles, unsigned seed) {
  Random random(seed);
  std::vector<RigidBody> bodies;
  for (std::int32_t i = 0; i < bottles; ++i) {
    const double moment = 0.5 * bottle_mass * bottle.radius * bottle.radius;
    Point at = place(i);
    for (std::size_t axis = 0; axis < 2; ++axis) at[axis] += random.uniform(-0.003, 0.003);
    bodies.push_back({bottle_mass, {moment, moment, moment}, {at}});
  }
  const RigidBody wheel = {5, {0.05, 0.05, 0.1}, {}};
  bodies.insert(bodies.end(), {wheel, wheel});  // and its shaft
  return bodies;
}

/// What moves under a bottle: the belts, or the dead plate around the wheel.
Point belt_velocity(const Point& at) {
  if (at[0] > plate) return {0, 0, 0};
  return {at[1] < 0.5 * (wide + pitch - from_guide) ? belt_speed : -belt_speed, 0, 0};
}

}  // namespace

BottleLine::BottleLine(std::int32_t bottles, unsigned seed)
    : RigidScene(Motion::Flat, bodies_of(bottles, seed)), shaft_(bottles), wheel_(bottles + 1),
      bearing_(joint(shaft_, wheel_, {{0, 0, 0}, Rotation::about(axes[0], -0.5 * pi)})), rounds_(static_cast<std::size_t>(bottles)) {
  prescribe(shaft_, rate_about(wheel_speed * axes[2]));
}

void BottleLine::add_rows(RowList& rows) const {
  constexpr double grip = belt_friction * bottle_mass * gravity;
  const double sideways = shake * std::cos(2 * pi * shakes * time());
  add_pin(rows, bearing_);
  const Twist turn = rate_about(axes[2]);
  add_motor(rows, shaft_, wheel_, -turn, turn, 0, clutch, 100, {{0, 0, 0}, {0, 0, 0}});
  for (std::int32_t i = 0; i < count(); ++i) {
    const Point& at = frame(i).origin;
    const Point belt = belt_velocity(at) + Point{0, sideways, 0};
    add_motor(rows, MLCP_WORLD, i, {}, rate_along(axes[0], {0, 0, 0}), belt[0], grip, 100, {at, axes[0]});
    add_motor(rows, MLCP_WORLD, i, {}, rate_along(axes[1], {0, 0, 0}), belt[1], grip, 101, {at, axes[1]});
    add_motor(rows, MLCP_WORLD, i, {}, turn, sideways / bottle.radius, 2.0 / 3 * bottle.radius * grip, 102, {at, {0, 0, 0}});
  }
}

void BottleLine::add_contacts(ContactList& contacts) const {
  const auto near = [&](std::int32_t a, std::int32_t b, ContactPoint at, std::int32_t feature) {
    at.feature = feature;
    if (at.gap <= margin) add_contact(contacts, a, b, at, glass);
  };
  std::vector<Point> centres;
  for (std::int32_t i = 0; i < count(); ++i) {
    const Point& at = centres.emplace_back(frame(i).origin);
    for (std::size_t g = 0; g < guides().size(); ++g)
      near(MLCP_WORLD, i, contact(guides()[g].capsule(), guides()[g].frame(), bottle, at), static_cast<std::int32_t>(g));
    if (at[0] < plate - 0.1) continue;
    for (std::int32_t f = 0; f < fingers; ++f) near(wheel_, i, contact(finger, frame(wheel_) * finger_frame(f), bottle, at), f);
  }
  for (const auto& [a, b] : near_pairs(centres, 2 * bottle.radius + margin))
    near(a, b, contact(bottle, centres[static_cast<std::size_t>(a)], bottle, centres[static_cast<std::size_t>(b)]), 0);
}

void BottleLine::advance(double h, std::span<const double> v) {
  RigidScene::advance(h, v);
  for (std::int32_t i = 0; i < count(); ++i)
    if (frame(i).origin[0] < entry - 0.05 && frame(i).origin[1] > 0.5 * pitch) send_in_again(i);
}

/// Puts a bottle at the beginning of the infeed where there is room; else it goes on and is asked again.
void BottleLine::send_in_again(std::int32_t leaving) {
  for (std::int32_t column = 0; column < 2; ++column) {
    const Point free = {entry + 0.04, -pitch + 0.08 * column, 0};
    const auto away = [&](const RigidBody& body) { return length(body.frame.origin - free) > 2.2 * bottle.radius; };
    if (!std::all_of(bodies().begin(), bodies().begin() + count(), away)) continue;
    place_body(leaving, {free});
    set_velocity(leaving, rate_along(belt_speed * axes[0], {0, 0, 0}));
    ++rounds_[static_cast<std::size_t>(leaving)];
    return;
  }
}

void BottleLine::draw(Drawing& to) const {
  using Role = Drawing::Role;
  to.eye = {-0.25, -0.72, 0.75};
  const auto flat = [&](double x0, double y0, double x1, double y1) {
    to.faces.push_back({{{x0, y0, 0}, {x1, y0, 0}, {x1, y1, 0}, {x0, y1, 0}}, Role::Ground});
  };
  const double lane = -pitch - from_guide, outer = pitch + from_guide, middle = pitch - from_guide;
  flat(plate, lane, outer, outer);
  for (const double sign : {1.0, -1.0}) {
    const double y0 = sign > 0 ? lane : middle, y1 = sign > 0 ? wide : outer;
    flat(entry, y0, plate, y1);
    // slats that move with the belt
    constexpr double slat = 0.09;
    const double moved = std::fmod(belt_speed * time(), slat);
    for (double x = entry + (sign > 0 ? moved : slat - moved); x + 0.006 < plate; x += slat) flat(x, y0, x + 0.006, y1);
  }
  for (const Guide& guide : guides()) {
    Frame raised = guide.frame();
    raised.origin[2] = 0.07;
    scenes::draw(to, Box{{guide_radius, guide_radius, guide.capsule().half_length}}, raised, Role::Machine);
  }
  const AnnularCam::Station disc[] = {{0.04, 0}, {0.04, 0.15}, {0.055, 0.15}, {0.055, 0}};
  draw_turned(to, disc, frame(wheel_), Role::Drive, 28);
  for (std::int32_t f = 0; f < fingers; ++f)
    scenes::draw(to, Box{{0.0075, finger.radius, 0.04}}, frame(wheel_) * Frame{{0, 0, 0.0475}} * finger_frame(f), Role::Drive);
  const AnnularCam::Station body[] = {{0, 0}, {0, 0.033}, {0.13, 0.035}, {0.175, 0.014}, {bottle_height, 0.014}, {bottle_height, 0}};
  for (std::int32_t i = 0; i < count(); ++i) draw_turned(to, body, frame(i), Role::Product, 12);
  draw_actions(to);
}

}  // namespace scenes
