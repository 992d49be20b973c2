#pragma once
#include "friction/cone_rows.h"
#include "solver.h"

namespace mlcp {

/// Islands of a problem with friction whose rows contradict each other however its contacts slip, and the proofs, in the caller's rows.
///
/// A certificate of the rows inside is one where no cone of Coulomb's law takes part: those have shifts, which move r, so that what contradicts at one
/// slip may not at another. There the normals decide. Any slip asks for w_n ≥ 0, and a contradiction among those rows and the plain ones alone is
/// one of the whole problem.
class Conflicts {
 public:
  explicit Conflicts(const Memory& m) : memory_(m), proven_(m), certificates_(m), row_(m), y_(m), beta_(m), gamma_(m), normals_(m) {}

  /// None so far.
  void start(const Problem& problem);
  /// Looks at the islands that a solve of the rows inside has found infeasible; at the normals, for as long as `left` says, the first time that one of
  /// them needs it.  spent: what that took, which is nothing on other calls.
  void look(const Problem& problem, const Mask* enabled, const Generators& generators, const ConeRows& rows, const Result& inner, const Settings& left,
            mlcp_report& spent);
  /// By caller's row, whether its island is one.
  std::span<const std::uint8_t> proven() const { return proven_.span(); }
  bool any() const { return !certificates_.empty(); }
  /// Writes the certificates; islands count as in result.row_island.
  void write(Result& result) const;

 private:
  bool shifted(const Problem& problem, const Generators& generators, const ConeRows& rows, const Result& inner, const CertificateRange& range) const;
  void add(std::span<const std::int32_t> row, std::span<const double> y, const ConeRows& rows, const Result& inner);
  void look_at_normals(const Problem& problem, const Mask* enabled, const ConeRows& rows, const Result& inner, const Settings& left, mlcp_report& spent);

  Memory memory_;
  Array<std::uint8_t> proven_;
  Array<CertificateRange> certificates_;  // their islands are not known here
  Array<std::int32_t> row_;
  Array<double> y_, beta_, gamma_;
  Mask normals_;
  bool looked_at_normals_ = false;
};

}  // namespace mlcp
