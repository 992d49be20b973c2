#pragma once
#include "rigid_scene.h"

namespace scenes {

/// A table on four legs and a load on it, at rest: four legs carry what three would, so that what each leg carries is not unique. With
/// `impulses = least_norm` a load in the middle is shared equally.
///
/// Models the table as one rigid body in space that touches the ground with the ends of its legs, and the load as a ball that touches the
/// table's top, all with friction. Leaves out the elasticity of the legs, which would decide how a real table shares its load.
class Table : public RigidScene {
 public:
  /// x, y: where the load stands, from the middle of the table, m.
  explicit Table(double x = 0, double y = 0);
  static constexpr double table_mass = 12, load_mass = 5;  // kg
  static constexpr std::int32_t legs = 4;                   // contacts 0 … 3 are the legs'
  void draw(Drawing& to) const override;

 protected:
  void add_rows(RowList&) const override {}
  void add_contacts(ContactList& contacts) const override;
};

}  // namespace scenes
