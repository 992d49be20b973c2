#include "wall_of_boxes.h"

#include "geometry/box_contacts.h"
#include "geometry/sphere_contacts.h"
#include "grid.h"

namespace scenes {
namespace {

constexpr Box box = {{0.20, 0.10, 0.10}};
constexpr Sphere ball = {0.18};
constexpr double box_mass = 8, ball_mass = 25, ball_speed = 6;  // kg, m/s
constexpr double joint = 0.002;      // between boxes of a course, m
constexpr double margin = 0.002, horizon = 1.5 * default_step;  // contacts are listed up to this gap and this time before they meet
constexpr Material wood = {.friction = 0.5};

std::vector<RigidBody> bodies_of(std::int32_t courses) {
  std::vector<RigidBody> bodies;
  const double pitch = 2 * box.half_extent[0] + joint;
  for (std::int32_t level = 0; level < courses; ++level) {
    const std::int32_t across = courses - level % 2;
    for (std::int32_t i = 0; i < across; ++i)
      bodies.push_back(solid(box, box_mass, {{(i - 0.5 * (across - 1)) * pitch, 0, (2 * level + 1) * box.half_extent[2]}}));
  }
  bodies.push_back(solid(ball, ball_mass, {{0.1, -1.2, 0.55 * courses * 2 * box.half_extent[2]}}));
  return bodies;
}

}  // namespace

WallOfBoxes::WallOfBoxes(std::int32_t courses)
    : RigidScene(Motion::Space, bodies_of(courses)), boxes_(static_cast<std::int32_t>(bodies().size()) - 1) {
  set_velocity(boxes_, rate_along(ball_speed * axes[1], {0, 0, 0}));
}

void WallOfBoxes::add_contacts(ContactList& contacts) const {
  const auto reach = [&](std::int32_t a, std::int32_t b) { return margin + horizon * length(velocity_of(b) - velocity_of(a)); };
  const auto touch = [&](std::int32_t a, std::int32_t b, const std::vector<ContactPoint>& points) {
    for (const ContactPoint& at : points) add_contact(contacts, a, b, at, wood);
  };
  const auto touch_ball = [&](std::int32_t a, const ContactPoint& at) {
    if (at.gap <= reach(a, boxes_)) add_contact(contacts, a, boxes_, at, wood);
  };
  std::vector<Point> centres;
  for (std::int32_t b = 0; b < boxes_; ++b) {
    centres.push_back(frame(b).origin);
    touch(MLCP_WORLD, b, scenes::contacts(Plane{}, {}, box, frame(b), reach(MLCP_WORLD, b)));
    touch_ball(b, contact(box, frame(b), ball, frame(boxes_).origin));
  }
  touch_ball(MLCP_WORLD, contact(Plane{}, {}, ball, frame(boxes_).origin));
  for (const auto& [a, b] : near_pairs(centres, 2 * length(box.half_extent)))
    touch(a, b, scenes::contacts(box, frame(a), box, frame(b), reach(a, b)));
}

void WallOfBoxes::draw(Drawing& to) const {
  to.eye = {0.55, -1, 0.45};
  const double s = 1.8;
  to.faces.push_back({{{-s, -s, 0}, {s, -s, 0}, {s, s, 0}, {-s, s, 0}}, Drawing::Role::Ground});
  for (std::int32_t b = 0; b < boxes_; ++b) to.boxes.push_back(corners(box, frame(b)));
  to.spheres.push_back({frame(boxes_).origin, ball.radius, Drawing::Role::Product});
  draw_actions(to);
}

}  // namespace scenes
