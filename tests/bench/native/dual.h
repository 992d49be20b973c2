#pragma once
#include <Eigen/Dense>
#include <Eigen/SparseCore>
#include <cstdint>
#include <vector>

#include "mlcp.h"

namespace bench {

/// The reduced form that engines hand to a dense solver: w = A γ + b with A = J M⁻¹Jᵀ + Σ, b = J M⁻¹k − r. A block of M is what its
/// pattern connects: a body, a robot, a cloth. Blocks that no row touches are passed over.
class Dual {
 public:
  explicit Dual(const mlcp_problem* problem);

  /// The pattern of A and where each block of M adds to it.
  void analyze();
  /// Its numbers. fails: std::runtime_error, a block of M is not positive definite.
  void form();

  Eigen::SparseMatrix<double> A;  // both triangles, rows ascending in every column
  Eigen::VectorXd b;

 private:
  /// Ranges in the arrays below.
  struct Block {
    std::int32_t velocities = 0, velocities_end = 0;
    std::int32_t rows = 0, rows_end = 0;
    std::int64_t slots = 0;  // of A, for pairs of rows, column by column
  };

  void find_blocks();
  void find_rows();
  void find_pattern();
  void add_block(const Block& block);
  void solve_dense(const Block& block);
  void solve_sparse(const Block& block);

  mlcp_matrix_view mass_, jacobian_, sigma_;
  std::vector<double> k_, r_;

  std::vector<Block> blocks_;
  std::vector<std::int32_t> block_of_, local_;  // of a velocity
  std::vector<std::int32_t> velocities_, rows_;
  std::vector<std::int32_t> entry_pointers_;    // by position in rows_
  std::vector<std::int32_t> entries_;           // of J
  std::vector<std::int32_t> slots_, sigma_slots_;
  Eigen::MatrixXd block_mass_, right_, product_;
};

}  // namespace bench
