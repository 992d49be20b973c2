#pragma once
#include "packing.h"
#include "scene.h"

namespace scenes {

/// Spheres of mixed size, poured into a box and settled.
///
/// Models three velocities a sphere: without friction no contact turns it, so spin stays what it was and needs no unknowns.
/// Contacts are sphere against sphere, floor and four walls, every one nearer than a margin; the open ones are what a collision
/// detector hands over too, and the solver must find them open. Leaves out friction and rolling.
class Pile : public Scene {
 public:
  explicit Pile(std::int32_t spheres, unsigned seed = 1);

  const Packing& packing() const { return packing_; }

  /// Sets the margin so that the next step has exactly that many contacts, those with the smallest gaps. Equal gaps at
  /// the limit all count. At most about eight a sphere exist.
  void limit_contacts(std::int32_t count);

  void draw(Drawing& to) const override;

 protected:
  void add_rows(RowList& rows) const override;
  void add_forces(std::span<double> force) const override;
  void advance(double h, std::span<const double> v) override;
  double potential_energy() const override;

 private:
  explicit Pile(Packing&& packing);

  Packing packing_;
  double margin_ = 0.1 * mean_radius;
};

/// The step of a settled pile with `contacts` contacts, most of them active; from 1 to as many as memory holds.
Problem pile(int contacts, unsigned seed = 1);

}  // namespace scenes
