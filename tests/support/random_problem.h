#pragma once
#include "support/build.h"
#include "support/random.h"

namespace support {

/// What a random problem is made of; probabilities are per body or per row.
struct Shape {
  int bodies_least = 1, bodies_most = 4, dimension_most = 3, rows_least = 0, rows_most = 7, boxed_most = 4;
  bool integers = false;  ///< numbers from {−1, 0, 1}: ties everywhere
  bool at_rest = false;   ///< integers: k may be 0
  double sparse_mass = 0.2, prescribed = 0.1, bilateral = 0.2, boxed = 0.2;
  double compliance = 0.2, compliance_matrix = 0.3, duplicate = 0.15;
  double feasible = 0.7;  ///< the whole problem: r such that some v satisfies every row with room to spare
  double disabled = 0.1;  ///< of enabled_mask
};

mlcp::Problem random_problem(Random& random, const Shape& shape);
/// Any states, for a start.
mlcp::Mask random_mask(Random& random, int rows);
/// Rows disabled with that probability, the rest at lower.
mlcp::Mask enabled_mask(Random& random, int rows, double disabled);
/// n = 0 with A = B Bᵀ of the given rank.
mlcp::Problem random_reduced(Random& random, int rows, int rank, bool integers);
/// Symmetric positive definite; sparse: some entries are 0.
Eigen::MatrixXd random_mass(Random& random, int dimension, bool sparse);
/// A slender mechanism: bodies of `dimension` in a line, `joints` bilateral rows between neighbours, a contact on each.
mlcp::Problem random_chain(Random& random, int links, int dimension, int joints);

}  // namespace support
