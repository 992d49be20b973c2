#pragma once
#include "factorize/tableau.h"
#include "measure/certificate.h"
#include "solve/basis.h"
#include "solve/input.h"

namespace mlcp {

/// The pivoting method (Goldfarb & Idnani 1983, as Simplex by the dual rule) on the dense tableau of one small island in extended precision. For what
/// double precision cannot hold: rows an angle δ apart have a Schur pivot of δ², which rounding in double swallows below δ = 1e-7 and here below 1e-15.
/// Rounding its answer to double leaves a rounding in every term of every equation, which is what the errors are relative to.
class ExtendedSimplex {
 public:
  explicit ExtendedSimplex(const Memory& m) : tableau_(m), x_(m), step_(m), rhs_(m), image_(m), a_(m), check_(m) {}

  /// Small enough for a dense matrix.
  static bool takes(const Island& island);

  /// From the active set that the basis holds for the island, whatever its factor, which is not of use afterwards.
  /// SOLVED: states and x of Basis::set are the answer. INFEASIBLE: proven, see certificate_rows(), and they are the velocity of least violation, as
  /// after Simplex::settle. ITERATION_LIMIT: also where M is not positive definite, or extended precision does not hold the problem either.
  /// cost: a pivot size² / 2, in numbers that are a hundred times as slow as doubles.
  mlcp_outcome solve(const SolveInput& input, const Island& island, Basis& basis, Limits& limits, Counts& counts);

  /// After SOLVED, where the answer is off: what cancels exactly comes out as rounding, which its own terms do not forgive. Velocities and impulses of up
  /// to so many roundings of the largest of the island, in terms of energy, become 0; what is as small and does not cancel is lost with them, so few first.
  void still(double roundings);

  /// Rows that the proof names: so many entries of Workspace::certificate_row and certificate_y from the island's first ordinal on.
  std::int32_t certificate_rows() const { return certificate_rows_; }

 private:
  std::int32_t position(std::int32_t o) const { return basis_->position(o) - island_.first; }
  Extended gamma(std::int32_t o) const { return -x_[position(o)]; }
  /// Change of γ of active row j for one unit of that of row k, which is not active.
  Extended share(std::int32_t j, std::int32_t k) const { return -tableau_(position(j), position(k)); }
  Extended pivot(std::int32_t o) const { return -tableau_(position(o), position(o)); }

  mlcp_outcome run(const SolveInput& input, Limits& limits, Counts& counts);
  mlcp_outcome start(Limits& limits, Counts& counts);
  Extended terms(std::int32_t k) const;
  void sweep(std::int32_t o, ActiveSet::State to, Counts& counts);
  void rest(std::int32_t o, ActiveSet::State to);
  void find_point(Counts& counts);
  bool drop_beyond_bounds(Counts& counts);
  std::int32_t entering_row();
  mlcp_outcome treat(const SolveInput& input, std::int32_t k, Limits& limits, Counts& counts);
  bool moves(std::int32_t j, std::int32_t k, Extended terms) const;
  bool find_still_step(std::int32_t k, int sign, Extended terms, Counts& counts);
  bool certify(const SolveInput& input, std::int32_t k, int sign, Extended terms, Counts& counts);
  void refine(const double* b, Extended* x, Counts& counts);
  void round();
  void round_within_bounds();

  Tableau tableau_;
  Array<Extended> x_, step_;    // by position: v and −γ; their change along a proof
  Array<Extended> rhs_, image_;  // b on what is in, x on the rest; the tableau times that: −x and b + w
  Array<Extended> a_;           // by ordinal: Schur pivot of the row beside the velocities alone
  CertificateCheck check_;
  std::int32_t certificate_rows_ = 0;
  Island island_{};
  Basis* basis_ = nullptr;
};

}  // namespace mlcp
