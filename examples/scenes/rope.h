#pragma once
#include "scene.h"

namespace scenes {

/// A rope lying over a row of pegs on the ground, both ends free.
///
/// Models the rope as point masses in the plane, two velocities each, with one bilateral row of fixed distance from each to the
/// next, and one contact row each, with the peg or the ground, whichever is nearer. The points start at random small heights
/// and speeds, so that some contacts carry and some open. Leaves out bending, torsion, friction and the rope touching itself,
/// which a rope that lies along pegs does not need.
class Rope : public Scene {
 public:
  explicit Rope(std::int32_t links, unsigned seed = 1);
  void draw(Drawing& to) const override;

 protected:
  void add_rows(RowList& rows) const override;
  void add_forces(std::span<double> force) const override;
  void advance(double h, std::span<const double> v) override;
  double potential_energy() const override;

 private:
  struct Node {
    double x, y;
  };
  std::vector<Node> nodes_;
  std::vector<double> rest_length_;  // of the link from node i to i + 1
};

/// The first step of a rope of `links` links: that many joints, and one contact more.
Problem rope(int links, unsigned seed = 1);

}  // namespace scenes
