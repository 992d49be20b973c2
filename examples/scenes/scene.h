#pragma once
#include <span>
#include <vector>

#include "contact_list.h"
#include "drawing.h"
#include "handles.h"
#include "row_list.h"

namespace scenes {

constexpr double gravity = 9.81;       // m/s²
constexpr double default_step = 0.01;  // s

/// Bodies of one dimension with their velocities, stepped by paper (2.5). What the bodies are, where they stand and what touches
/// is known to the derived scene alone. Bodies stay in the problem over the steps, rows and contacts are made anew in each.
class Scene {
 public:
  virtual ~Scene() = default;

  /// Makes the next step's problem and start. `start` is null in the first step, then the last active set, carried over by key.
  void prepare(double h);
  /// Solves what was prepared and moves the bodies: v⁺ from the solver, q⁺ = q + h v⁺.
  const mlcp_report& finish();
  const mlcp_report& step(double h);

  /// A spring and a damper in place of every contact, N/m and N s/m.
  struct Springs {
    double stiffness, damping;
  };
  /// A step of the penalty method of paper (2.1) instead, to compare: forces at the present state, v⁺ = v + h M⁻¹Q, q⁺ = q + h v⁺.
  /// fails: both, std::logic_error where the scene has joints, motors or friction.
  void step_by_penalty(double h, const Springs& springs);
  /// With a longer step nothing comes to rest, if all contacts listed now are closed: h = 2 (√(1 + ζ²) − ζ)/ω, ω² = s λ(M⁻¹JᵀJ) the largest, ζ = d ω/(2 s). INFINITY without contacts.
  double largest_step_by_penalty(const Springs& springs) const;

  const mlcp_problem* problem() const { return problem_.get(); }
  const mlcp_mask* start() const { return stepped_ ? start_.get() : nullptr; }
  const mlcp_solver* solver() const { return solver_.get(); }
  std::span<const double> velocities() const { return velocity_; }
  void use(const mlcp_settings& settings);
  /// The law of every contact with friction from now on. Until then convex pyramids of 8 facets (Anitescu 2006), as the paper proposes: what
  /// slides opens by µ times its way in a step, which is little where things roll or stick.
  void use(const FrictionLaw& law) { law_ = law; }

  /// −gap of the deepest contact or limit, at least 0, and |φ| of the worst joint, at the present positions; m, or rad where a row turns.
  struct Violation {
    double penetration, drift;
  };
  Violation violation() const;
  /// Kinetic and potential, J.
  double energy() const;

  /// What the scene itself measures of what it does, at the present positions.
  struct Measure {
    const char* name;
    double value;
  };
  virtual std::vector<Measure> measures() const { return {}; }
  /// Whether something does work on the bodies: a motor, a belt, a hand that moves a body.
  virtual bool driven() const { return false; }

  /// Adds what there is to see at the present positions, and for each row that prepare() would make now where it acts.
  virtual void draw(Drawing& to) const = 0;

  /// The problem of the step from here; the scene is spent.
  static Problem problem_of_step(Scene&& scene, double h = default_step);

 protected:
  /// masses: one dense block of dimension² numbers a body. rows_of_contact: 2 in the plane, 3 in space.
  Scene(std::int32_t dimension, std::span<const double> masses, std::int32_t rows_of_contact = 3);

  /// Every constraint near the present positions. Same rows, same order, same keys for the same positions.
  virtual void add_rows(RowList& rows) const = 0;
  /// Every contact with friction near the present positions; its rows come after all others. None where a scene has no friction.
  virtual void add_contacts(ContactList&) const {}
  /// Adds the generalised forces at the present state, the gyroscopic ones included; `force` comes in as 0.
  virtual void add_forces(std::span<double> force) const = 0;
  /// q ← q + h v
  virtual void advance(double h, std::span<const double> v) = 0;
  virtual double potential_energy() const = 0;

  void set_mass(std::int32_t body, std::span<const double> mass);
  std::span<double> velocity(std::int32_t body);
  /// From now on the body moves as it is told.
  void prescribe(std::int32_t body, std::span<const double> velocity);
  double time() const { return time_; }  // since the start, s

  RowList listed_rows() const;
  ContactList listed_contacts() const;

  /// K of paper (2.5) for joints and for contacts that overlap.
  double stabilisation = 0.2;

 private:
  RowList rows_for_springs() const;

  std::int32_t dimension_, rows_of_contact_;
  FrictionLaw law_;
  Problem problem_;
  Solver solver_;
  Mask start_;
  bool stepped_ = false;
  double h_ = 0, time_ = 0;
  std::vector<double> velocity_, force_;
  mlcp_report report_;
};

}  // namespace scenes
