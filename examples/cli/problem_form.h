#pragma once
#include "matrix.h"
#include "problem_file.h"

namespace cli {

/// What folders of Matrix Market files and FCLIB files hold alike, in their signs:
///
///     global    M v = k + Jᵀγ,  w = J v + shift        reduced   w = A γ + shift
///
/// with `bilateral` rows first (w = 0), then `contacts` groups of `dimension` rows, the normal first, then plain unilateral rows.
struct ProblemForm {
  bool reduced = false;
  std::int32_t bilateral = 0, contacts = 0, dimension = 1;
  Matrix mass, jacobian, a;
  std::vector<double> k, shift, mu;
  std::vector<std::uint64_t> key;  // of the library, 0: none; empty: none at all

  std::int32_t rows() const { return static_cast<std::int32_t>(shift.size()); }
  std::int64_t end_of_contacts() const { return bilateral + std::int64_t(contacts) * dimension; }
};

/// Without friction the tangent rows of contacts are left out; rows of a group beyond the third (rolling) always are.
ProblemFile make_problem(const ProblemForm& form, const Friction& friction);

/// Throws std::runtime_error for what the form cannot hold: rows that are neither bilateral nor unilateral (0 ≤ γ), compliance beside
/// velocities, contacts in the plane and in space at once, fixed bounds of friction.
ProblemForm form_of(const handles::Problem& problem);

}  // namespace cli
