#pragma once
#include "scene.h"

namespace scenes {

/// A chain of rods in the plane, hung from the world by its first pin, released at rest on a straight line 16° from the vertical.
///
/// Models three velocities a link (x, y, angle) and two bilateral rows a pin: an acyclic mechanism, on which the paper promises
/// O(n). With contacts every lower pin stands a little, and at random, above a slope along that line, and has one contact row
/// with it: the worst case for the paper's order of elimination (bodies, joints, contacts). Leaves out friction, the rods'
/// thickness and contacts between links: none is needed for that. mass_ratio makes the last link heavier than each other one.
///
/// A step takes the directions of joints from its start, so that the tension T is a spring against turning that is integrated explicitly: links of
/// mass m and length l that turn by ±θ in turns swing with ω² = 12 T/(m l), and the chain stays straight only with h < 2/ω. That is 10.8 ms for 30
/// links and 1.9 ms for 1000. With longer steps K creates the energy of what the joints lost.
class Chain : public Scene {
 public:
  Chain(std::int32_t links, bool contacts, double mass_ratio = 1, unsigned seed = 1);
  void draw(Drawing& to) const override;

 protected:
  void add_rows(RowList& rows) const override;
  void add_forces(std::span<double> force) const override;
  void advance(double h, std::span<const double> v) override;
  double potential_energy() const override;

 private:
  /// Positions, and the mass that Scene is told of.
  struct Link {
    double x, y, angle;
    double half_x, half_y;  // centre to lower pin, at angle 0; the upper pin lies opposite
    double mass;
  };
  using Links = std::vector<Link>;
  Chain(Links&& links, bool contacts);
  static Links on_slope(std::int32_t count, bool contacts, double mass_ratio, unsigned seed);
  static std::vector<double> mass_blocks(const Links& links);

  Links links_;
  bool contacts_;
};

/// The first step of a chain.
Problem chain(int links, bool contacts, double mass_ratio = 1);

}  // namespace scenes
