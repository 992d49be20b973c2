#pragma once
#include <cmath>

#include "geometry/contact_point.h"
#include "row_list.h"

namespace scenes {

/// What two surfaces are like where they touch.
struct Material {
  double friction = 0;           // coefficient µ; of Coulomb's law, 0: none
  double restitution = 0;        // Newton's coefficient, of approaches faster than `slow`
  double stiffness = INFINITY;   // of the surfaces, N/m; what sticks creeps, since no step remembers how far it was pushed aside
};

struct FrictionLaw {
  mlcp_friction model = MLCP_FRICTION_CONVEX;
  std::int32_t facets = 8;  // 0: the circular cone
};

constexpr double slow = 0.05;  // m/s

/// Contacts with friction of one step, gathered and then handed over in one bulk call, after the rows. All bodies have the same dimension.
class ContactList {
 public:
  /// rows: a contact's, 2 in the plane and 3 in space.
  ContactList(std::int32_t dimension, std::int32_t rows) : dimension_(dimension), rows_(rows) {}

  /// One contact. Of both bodies rows·dimension numbers, the normal first (ignored for MLCP_WORLD); directions: of the rows, on b.
  void add(std::int32_t body_a, std::int32_t body_b, std::span<const double> jacobian_a, std::span<const double> jacobian_b,
           std::span<const Point> directions, const ContactPoint& at, const Material& material);

  /// r by the time stepping of paper (2.5) with step h and stabilisation K, from velocities v, then mlcp_problem_contacts_add.
  void add_to(const Problem& problem, double h, double stabilisation, const FrictionLaw& law, std::span<const double> v) const;

  void draw(Drawing& to) const;
  std::int32_t count() const { return static_cast<std::int32_t>(gap_.size()); }
  std::span<const double> gaps() const { return gap_; }

 private:
  /// The normal row's rate at velocities v.
  double approach(std::size_t contact, std::span<const double> v) const;

  std::int32_t dimension_, rows_;
  std::vector<std::int32_t> body_a_, body_b_;
  std::vector<double> jacobian_;  // 2·rows·dimension a contact: a's block, b's block
  std::vector<double> gap_, friction_, restitution_, stiffness_;
  std::vector<std::uint64_t> key_;
  std::vector<Drawing::Action> actions_;
};

}  // namespace scenes
