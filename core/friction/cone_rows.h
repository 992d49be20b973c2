#pragma once
#include "friction/generators.h"

namespace mlcp {

/// The problem in which each cone is a few unilateral rows, its generators: row g = n + µ d·t, so that
///     J_g = J_n + µ d·J_t,   Σ → G Σ Gᵀ,   r_g = r_n + µ d·r_t − s,   γ = Gᵀβ,   w_g = w_n + s + µ d·w_t
/// with s the shift of the cone. Every other row stays as it is; tangent rows of cones have no row inside. Reused from solve to solve.
class ConeRows {
 public:
  explicit ConeRows(const Memory& m)
      : inner(m), enabled(m), start(m), inner_of(m), row_of(m), cone_of_row(m), block_of_(m), local_of_(m), block_row_(m),
        block_first_(m), cone_at_(m), columns_(m), blocks_(m) {}

  /// cost: entries of M, J and, times the generators a row, of Σ.
  void build(const Problem& problem, const Mask* outer, const Generators& generators);
  /// The rows of a cone whose generators point elsewhere now. Σ needs write_compliance afterwards.
  void write_rows(const Problem& problem, const Generators& generators, std::int32_t cone);
  void write_compliance(const Problem& problem, const Generators& generators);
  void write_shift(const Problem& problem, const Generators& generators, std::int32_t cone, double shift);
  /// γ = Gᵀβ, and likewise a Farkas multiplier.
  void impulses(const Problem& problem, const Generators& generators, std::span<const double> beta, std::span<double> gamma) const;

  Problem inner;
  Mask enabled, start;              ///< of the inner rows
  Array<std::int32_t> inner_of;     ///< m: first inner row, −1 for tangents of cones
  Array<std::int32_t> row_of;       ///< inner row → the caller's row, the normal of a cone
  Array<std::int32_t> cone_of_row;  ///< inner row → cone or −1

 private:
  /// What the rows of a block touch: columns of J or blocks of Σ, with the coefficients of up to three rows (by three columns).
  struct Touched {
    Array<std::int32_t> index, place;  ///< in order; index → place or −1
    Array<double> coefficient;
    explicit Touched(const Memory& m) : index(m), place(m), coefficient(m) {}
    void start(std::size_t size);
    double* at(std::int32_t i, std::int32_t width);
    void finish();
  };

  void copy_bodies(const Problem& problem);
  void number_rows(const Problem& problem, const Generators& generators);
  void add_row(const Problem& problem, std::int32_t row);
  void add_cone(const Problem& problem, const Generators& generators, std::int32_t cone);
  void gather_columns(const Problem& problem, std::int32_t row, std::int32_t rows);
  void gather_blocks(const Problem& problem, std::int32_t row, std::int32_t rows);
  std::int32_t rows_of(const Problem& problem, const Generators& generators, std::int32_t block) const;

  // a block: the rows of a cone, or one other row
  Array<std::int32_t> block_of_, local_of_;          // by row: its block, its place among the block's rows
  Array<std::int32_t> block_row_, block_first_, cone_at_;  // by block: first row, first inner row, cone or −1
  Touched columns_, blocks_;
};

}  // namespace mlcp
