#pragma once
#include "measure/certificate.h"
#include "solve/basis.h"
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
  Simplex(const Memory& m, Basis& basis)
      : certificate_row(m), certificate_y(m), basis_(basis), direction_(m), check_(m), beyond_(m), rhs_(m), rhs_size_(m), residual_(m), entered_(m) {}

  void prepare(const Problem& problem, const Mask* enabled, const Settings& settings);

  /// before: the basis holds a start. after: the basis holds the answer, as far as it got.
  /// INFEASIBLE: certificate_row and certificate_y prove it.
  mlcp_outcome solve(const Island& island, std::int32_t index, Limits& limits, Counts& counts, Array<mlcp_pivot>* trace);

  /// After INFEASIBLE: the velocity of least violation. Every row gets a compliance of 1e-7 a, which makes the island feasible and its
  /// solution tend to the least Σ violation²/a with the compliance.
  void settle(const Island& island, Limits& limits, Counts& counts);

  Array<std::int32_t> certificate_row;  ///< the caller's rows
  Array<double> certificate_y;

 private:
  mlcp_outcome run(const Island& island, Limits& limits, Counts& counts, Array<mlcp_pivot>* trace);
  mlcp_outcome start(const Island& island, Limits& limits, Counts& counts);
  void settle_point(const Island& island, Counts& counts);
  mlcp_outcome leave(const Island& island, std::int32_t entering, mlcp_outcome outcome, Counts& counts);
  mlcp_outcome treat(const Island& island, std::int32_t entering, Limits& limits, Counts& counts, Array<mlcp_pivot>* trace);
  std::int32_t entering_row(const Island& island) const;
  double pivot_along(std::int32_t entering, const double* z) const;
  void refine_direction(const Island& island, std::int32_t entering, Counts& counts);
  void find_direction(const Island& island, std::int32_t entering, Counts& counts);
  void reverse(const Island& island);
  void advance(const Island& island, double length);
  bool drop_beyond_bounds(const Island& island, Counts& counts);
  bool depends(const Island& island, std::int32_t o, Counts& counts);
  bool certify(const Island& island, std::int32_t entering, Counts& counts);
  void sharpen_certificate(const Island& island, Counts& counts);
  void collect_certificate(const Island& island, std::int32_t entering, double negligible);
  void tighten(const Island& island);

  Basis& basis_;
  Direction direction_;
  CertificateCheck check_;
  Array<std::int32_t> beyond_;
  Array<double> rhs_, rhs_size_;
  Array<long double> residual_;
  Array<std::int32_t> entered_;      // how often a row has entered
  double dependent_ = dependent_pivot;
  const Problem* problem_ = nullptr;
  const Mask* enabled_ = nullptr;
  const Settings* settings_ = nullptr;
  std::int32_t island_index_ = 0;
  bool certifying_ = true;
};

}  // namespace mlcp
