#pragma once
#include <span>
#include <vector>

#include "drawing.h"
#include "handles.h"
#include "row_list.h"

namespace scenes {

constexpr double gravity = 9.81;       // m/s²
constexpr double default_step = 0.01;  // s

/// Bodies of one dimension with their velocities, stepped by paper (2.5). What the bodies are, where they stand and what touches
/// is known to the derived scene alone. Bodies stay in the problem over the steps, rows are made anew in each.
class Scene {
 public:
  virtual ~Scene() = default;

  /// Makes the next step's problem and start. `start` is null in the first step, then the last active set, carried over by key.
  void prepare(double h);
  /// Solves what was prepared and moves the bodies: v⁺ from the solver, q⁺ = q + h v⁺.
  const mlcp_report& finish();
  const mlcp_report& step(double h);

  const mlcp_problem* problem() const { return problem_.get(); }
  const mlcp_mask* start() const { return stepped_ ? start_.get() : nullptr; }
  const mlcp_solver* solver() const { return solver_.get(); }
  std::span<const double> velocities() const { return velocity_; }
  void use(const mlcp_settings& settings);

  /// Adds what there is to see at the present positions, and for each row that prepare() would make now where it acts.
  virtual void draw(Drawing& to) const = 0;

  /// The problem of the step from here; the scene is spent.
  static Problem problem_of_step(Scene&& scene, double h = default_step);

 protected:
  /// masses: one dense block of dimension² numbers a body.
  Scene(std::int32_t dimension, std::span<const double> masses);

  /// Every constraint near the present positions. Same rows, same order, same keys for the same positions.
  virtual void add_rows(RowList& rows) const = 0;
  /// Adds the generalised forces at the present state, the gyroscopic ones included; `force` comes in as 0.
  virtual void add_forces(std::span<double> force) const = 0;
  /// q ← q + h v
  virtual void advance(double h, std::span<const double> v) = 0;

  void set_mass(std::int32_t body, std::span<const double> mass);
  std::span<double> velocity(std::int32_t body);

  /// K of paper (2.5) for joints and for contacts that overlap.
  double stabilisation = 0.2;

 private:
  std::int32_t dimension_;
  Problem problem_;
  Solver solver_;
  Mask start_;
  bool stepped_ = false;
  double h_ = 0;
  std::vector<double> velocity_, force_;
  mlcp_report report_;
};

}  // namespace scenes
