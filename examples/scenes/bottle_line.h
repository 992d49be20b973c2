#pragma once
#include "rigid_scene.h"

namespace scenes {

/// The packaging machine of the paper's Fig. 5: a conveyor brings bottles, guides crowd them from a wide belt into a single lane, a star
/// wheel takes them one by one around a half turn, and a second conveyor carries them away; bottles that have left come in again.
///
/// Models every bottle as a disc that moves and turns in the plane of the belts, three velocities each, and the star wheel on a shaft
/// whose turning is prescribed, joined to it by a clutch that slips before glass breaks. Bottles touch each other, the guides and the wheel's fingers with friction. A belt is two rows and one for
/// spin: each drives the bottle to the belt's velocity with at most µ m g (for the spin two thirds of the radius times that).
/// Leaves out tipping, so heights need no unknowns; the belt's friction is a box instead of a circle, each direction for itself.
class BottleLine : public RigidScene {
 public:
  explicit BottleLine(std::int32_t bottles, unsigned seed = 1);

  /// How often a bottle has left the machine, in order of bottles.
  std::span<const std::int32_t> rounds() const { return rounds_; }

  bool driven() const override { return true; }
  void draw(Drawing& to) const override;

 protected:
  void add_rows(RowList& rows) const override;
  void add_contacts(ContactList& contacts) const override;
  void advance(double h, std::span<const double> v) override;

 private:
  std::int32_t count() const { return static_cast<std::int32_t>(rounds_.size()); }
  void send_in_again(std::int32_t bottle);

  std::int32_t shaft_, wheel_;
  Joint bearing_;
  std::vector<std::int32_t> rounds_;
};

}  // namespace scenes
