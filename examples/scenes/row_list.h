#pragma once
#include <cstdint>
#include <initializer_list>
#include <span>
#include <vector>

#include "drawing.h"
#include "handles.h"

namespace scenes {

using namespace handles;

/// Identity of a row over time: the two bodies and a feature of the pair (a corner, a wall, a row of a joint). Never 0.
/// Bodies below 2²⁴ − 2, features below 2¹⁶ − 1.
std::uint64_t row_key(std::int32_t body_a, std::int32_t body_b, std::int32_t feature);

enum class RowKind { Joint, Contact };  // bilateral and unilateral; a contact's row is also a limit's

/// Rows of one step, gathered and then handed over in one bulk call. All bodies have the same dimension.
class RowList {
 public:
  explicit RowList(std::int32_t dimension) : dimension_(dimension) {}

  /// One row: ∂φ/∂q of both bodies, `dimension` numbers each (ignored for MLCP_WORLD), and φ in m: the gap of a contact, the
  /// error of a joint.
  void add(RowKind kind, std::int32_t body_a, std::int32_t body_b, std::span<const double> jacobian_a,
           std::span<const double> jacobian_b, double phi, std::int32_t feature);
  void add(RowKind kind, std::int32_t body_a, std::int32_t body_b, std::initializer_list<double> jacobian_a,
           std::initializer_list<double> jacobian_b, double phi, std::int32_t feature);

  /// A row that drives its rate towards `speed` with at most `force`, in m/s and N, or rad/s and N m.
  void add_motor(std::int32_t body_a, std::int32_t body_b, std::span<const double> jacobian_a, std::span<const double> jacobian_b,
                 double speed, double force, std::int32_t feature);
  /// Where the row that was added last acts, and along what on its body b.
  void acts(const Drawing::Action& action) { actions_.push_back(action); }

  /// r by the time stepping of paper (2.5) with step h and stabilisation K, then mlcp_problem_rows_add.
  void add_to(const Problem& problem, double h, double stabilisation) const;

  /// Adds the forces of springs and dampers that stand for contacts, Jᵀ max(0, −s φ − d J v) where φ < 0.
  void push(double stiffness, double damping, std::span<const double> v, std::span<double> force) const;
  /// y ← y + JᵀJ x
  void apply_normal_matrix(std::span<const double> x, std::span<double> y) const;

  /// Adds the actions that were told.
  void draw(Drawing& to) const { to.actions.insert(to.actions.end(), actions_.begin(), actions_.end()); }

  std::int32_t count() const { return static_cast<std::int32_t>(phi_.size()); }
  bool all_contacts() const;
  double deepest() const;  // −φ of the deepest contact or limit, at least 0
  double drift() const;    // |φ| of the worst joint

 private:
  enum class Role { Joint, Contact, Motor };
  void add(Role role, std::int32_t body_a, std::int32_t body_b, std::span<const double> jacobian_a, std::span<const double> jacobian_b,
           double phi, double limit, std::int32_t feature);

  /// Jᵢ v and y ← y + s Jᵢᵀ
  double rate(std::size_t row, std::span<const double> v) const;
  void add_multiple(std::size_t row, double s, std::span<double> y) const;

  std::int32_t dimension_;
  std::vector<Role> role_;
  std::vector<std::int32_t> body_a_, body_b_;
  std::vector<double> jacobian_;  // 2·dimension a row: a's block, b's block
  std::vector<double> phi_;       // of a motor: its speed
  std::vector<double> limit_;     // of a motor: its largest force
  std::vector<std::uint64_t> key_;
  std::vector<Drawing::Action> actions_;
};

}  // namespace scenes
