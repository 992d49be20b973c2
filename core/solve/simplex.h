#pragma once
#include "measure/certificate.h"
#include "solve/basis.h"
#include "solve/input.h"
#include "solve/ratio_test.h"

namespace mlcp {

/// The paper's simplex (§3.1, pseudocode Risolvi_LCP) on the sparse KKT matrix, one island at a time. A is never formed. With the dual rule
/// (after Goldfarb & Idnani 1983) each entering row strictly raises the dual objective, so no active set comes back and the
/// method is finite; with the printed rule the least index breaks ties.
///
/// Where the paper is mended (see core/README.md): only satisfied rows block; the Schur pivot of the entering row is tested before it
/// enters, and a dependent row never does: its step is infinite, an impulse that reaches its bound releases another row, and
/// if there is none, the step is a Farkas certificate.
class Simplex {
 public:
  Simplex(const SolveInput& input, Basis& basis, CertificateCheck& check, Limits& limits, Counts& counts)
      : input_(input), basis_(basis), check_(check), limits_(limits), counts_(counts) {}

  /// before: the basis holds a start. after: the basis holds the answer, as far as it got.
  /// INFEASIBLE: certificate() proves it.
  mlcp_outcome solve(const Island& island, std::int32_t index, Array<mlcp_pivot>* trace);

  /// After INFEASIBLE: the velocity of least violation. Every row gets a compliance of 1e-7 a, which makes the island feasible and its
  /// solution tend to the least Σ violation²/a with the compliance.
  void settle(const Island& island);

  /// Rows that the proof names: so many entries of Workspace::certificate_row and certificate_y from the island's first ordinal on.
  std::int32_t certificate_rows() const { return certificate_rows_; }

 private:
  mlcp_outcome run(const Island& island, Array<mlcp_pivot>* trace);
  mlcp_outcome start(const Island& island);
  void settle_point(const Island& island);
  mlcp_outcome leave(const Island& island, std::int32_t entering, mlcp_outcome outcome);
  mlcp_outcome treat(const Island& island, std::int32_t entering, Array<mlcp_pivot>* trace);
  mlcp_outcome stand_still(const Island& island, std::int32_t entering, bool& again);
  void record(Array<mlcp_pivot>& trace, std::int32_t entering, const Step& step) const;
  std::int32_t entering_row(const Island& island) const;
  double pivot_along(std::int32_t entering, const double* z) const;
  void refine_direction(const Island& island, std::int32_t entering);
  void find_direction(const Island& island, std::int32_t entering);
  void reverse(const Island& island);
  void advance(const Island& island, double length);
  bool drop_beyond_bounds(const Island& island);
  bool depends(const Island& island, std::int32_t o);
  bool certify(const Island& island, std::int32_t entering);
  void sharpen_certificate(const Island& island);
  double collect_certificate(const Island& island, std::int32_t entering, double negligible);
  void tighten(const Island& island);

  const SolveInput& input_;
  Basis& basis_;
  CertificateCheck& check_;
  Limits& limits_;
  Counts& counts_;
  Direction direction_;
  double dependent_ = dependent_pivot;
  std::int32_t island_index_ = 0, certificate_rows_ = 0;
  bool certifying_ = true;
};

}  // namespace mlcp
