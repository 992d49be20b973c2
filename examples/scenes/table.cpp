#include "table.h"

#include "geometry/sphere_contacts.h"

namespace scenes {
namespace {

constexpr Box top = {{0.50, 0.35, 0.02}};
constexpr Box leg = {{0.03, 0.03, 0.34}};
constexpr Sphere ball = {0.10};
constexpr double leg_inset = 0.05;  // of a leg's axis from the table's edges, m
constexpr Material wood = {.friction = 0.4};
constexpr std::int32_t table_body = 0, load_body = 1;

/// The middle of a leg, from the table's origin in the middle of its top.
Point leg_place(std::int32_t i) {
  const double x = top.half_extent[0] - leg_inset, y = top.half_extent[1] - leg_inset;
  return {i % 2 == 0 ? -x : x, i / 2 == 0 ? -y : y, -top.half_extent[2] - leg.half_extent[2]};
}

Point foot(std::int32_t i) { return leg_place(i) - Point{0, 0, leg.half_extent[2]}; }

constexpr double height = top.half_extent[2] + 2 * leg.half_extent[2];  // of the origin above the ground

std::vector<RigidBody> bodies_of(double x, double y) {
  // as if the mass were in the top
  return {solid(top, Table::table_mass, {{0, 0, height}}),
          solid(ball, Table::load_mass, {{x, y, height + top.half_extent[2] + ball.radius}})};
}

}  // namespace

Table::Table(double x, double y) : RigidScene(Motion::Space, bodies_of(x, y)) {}

void Table::add_contacts(ContactList& contacts) const {
  for (std::int32_t i = 0; i < legs; ++i) {
    const Point at = frame(table_body).to_world(foot(i));
    add_contact(contacts, MLCP_WORLD, table_body, {at, axes[2], at[2], i}, wood);
  }
  add_contact(contacts, table_body, load_body, contact(top, frame(table_body), ball, frame(load_body).origin), wood);
}

void Table::draw(Drawing& to) const {
  const double s = 0.8;
  to.faces.push_back({{{-s, -s, 0}, {s, -s, 0}, {s, s, 0}, {-s, s, 0}}, Drawing::Role::Ground});
  to.boxes.push_back(corners(top, frame(table_body)));
  for (std::int32_t i = 0; i < legs; ++i) to.boxes.push_back(corners(leg, frame(table_body) * Frame{leg_place(i)}));
  to.spheres.push_back({frame(load_body).origin, ball.radius, Drawing::Role::Product});
  draw_actions(to);
}

}  // namespace scenes
