#include "box_stack.h"

#include <utility>

namespace scenes {
namespace {

constexpr std::size_t dimension = 6;  // of a body: linear velocity, then angular velocity in the world's frame

using Block = std::array<double, dimension * dimension>;

/// Principal moments of inertia of a solid box.
Point moments(const Box& box) {
  const Point& e = box.half_extent;
  return box.mass / 3 * Point{e[1] * e[1] + e[2] * e[2], e[0] * e[0] + e[2] * e[2], e[0] * e[0] + e[1] * e[1]};
}

constexpr Point axes[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

/// diag(m, m, m, Σ Iₖ eₖ eₖᵀ) with the box's axes eₖ in the world's frame.
Block mass_block(const Box& box) {
  Block block = {};
  for (std::size_t i = 0; i < 3; ++i) block[i * dimension + i] = box.mass;
  const Point inertia = moments(box);
  for (std::size_t k = 0; k < 3; ++k) {
    const Point e = box.rotation * axes[k];
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) block[(3 + i) * dimension + 3 + j] += inertia[k] * (e[i] * e[j]);
    }
  }
  return block;
}

std::vector<double> mass_blocks(std::span<const Box> boxes) {
  std::vector<double> blocks;
  for (const Box& box : boxes) {
    const Block block = mass_block(box);
    blocks.insert(blocks.end(), block.begin(), block.end());
  }
  return blocks;
}

/// I ω in the world's frame
Point angular_momentum(const Box& box, const Point& omega) {
  const Point inertia = moments(box);
  Point sum = {0, 0, 0};
  for (std::size_t k = 0; k < 3; ++k) {
    const Point e = box.rotation * axes[k];
    sum = sum + inertia[k] * dot(e, omega) * e;
  }
  return sum;
}

/// The rate at which a point `arm` away from the centre moves along `n`, per velocity of the body.
std::array<double, dimension> rate_along(const Point& n, const Point& arm) {
  const Point turn = cross(arm, n);
  return {n[0], n[1], n[2], turn[0], turn[1], turn[2]};
}

}  // namespace

BoxStack::BoxStack(std::vector<Box> boxes, std::vector<Support> supports)
    : Scene(dimension, mass_blocks(boxes)), boxes_(std::move(boxes)), supports_(std::move(supports)) {}

void BoxStack::add_rows(RowList& rows) const {
  for (const Support& support : supports_) {
    const Box& upper = boxes_[static_cast<std::size_t>(support.upper)];
    const bool on_ground = support.lower == MLCP_WORLD;
    const Box ground = {{0, 0, 0}, {0, 0, 0}, 0};
    const Box& lower = on_ground ? ground : boxes_[static_cast<std::size_t>(support.lower)];
    const Point n = lower.rotation * axes[2];
    for (std::size_t corner = 0; corner < support.points.size(); ++corner) {
      const Point arm = upper.rotation * support.points[corner];
      const Point point = upper.centre + arm;
      const Point below = point - lower.centre;
      const double gap = dot(n, below) - lower.half_extent[2];
      const auto a = rate_along(-1.0 * n, below), b = rate_along(n, arm);
      rows.add(RowKind::Contact, support.lower, support.upper, a, b, gap, static_cast<std::int32_t>(corner));
    }
  }
}

void BoxStack::add_forces(std::span<double> force) const {
  for (std::size_t i = 0; i < boxes_.size(); ++i) {
    force[dimension * i + 2] -= gravity * boxes_[i].mass;
    const auto v = velocities().subspan(dimension * i, dimension);
    const Point omega = {v[3], v[4], v[5]};
    const Point gyroscopic = cross(omega, angular_momentum(boxes_[i], omega));
    for (std::size_t axis = 0; axis < 3; ++axis) force[dimension * i + 3 + axis] -= gyroscopic[axis];
  }
}

void BoxStack::advance(double h, std::span<const double> v) {
  for (std::size_t i = 0; i < boxes_.size(); ++i) {
    Box& box = boxes_[i];
    const auto u = v.subspan(dimension * i, dimension);
    box.centre = box.centre + h * Point{u[0], u[1], u[2]};
    box.rotation.advance(h, {u[3], u[4], u[5]});
    set_mass(static_cast<std::int32_t>(i), mass_block(box));
  }
}

void BoxStack::draw(Drawing& to) const {
  for (const Box& box : boxes_) {
    Drawing::Corners& corners = to.boxes.emplace_back();
    for (std::size_t c = 0; c < corners.size(); ++c) {
      const Point& e = box.half_extent;
      corners[c] = box.centre + box.rotation * Point{c & 4 ? e[0] : -e[0], c & 2 ? e[1] : -e[1], c & 1 ? e[2] : -e[2]};
    }
  }
  for (const Support& support : supports_) {
    const Box& upper = boxes_[static_cast<std::size_t>(support.upper)];
    const Rotation face = support.lower == MLCP_WORLD ? Rotation{} : boxes_[static_cast<std::size_t>(support.lower)].rotation;
    for (const Point& point : support.points)
      to.actions.push_back({upper.centre + upper.rotation * point, face * axes[2]});
  }
}

}  // namespace scenes
