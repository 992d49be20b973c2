#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

#include "assemble/mask.h"
#include "assemble/problem.h"

/// Problems through the assemble functions, in the short spelling that tests read well in.
namespace support {

struct Entry {
  int column;
  double value;
};
struct Bounds {
  double lo, hi;
};
constexpr Bounds unilateral{0, mlcp::infinity}, bilateral{-mlcp::infinity, mlcp::infinity};

mlcp::Problem empty_problem();
/// Returns the body's id.
int add_body(mlcp::Problem& problem, const Eigen::MatrixXd& mass);
/// mass · I
int add_body(mlcp::Problem& problem, int dimension, double mass);
/// Entries that are 0 are not stored, those on the diagonal are.
int add_sparse_body(mlcp::Problem& problem, const Eigen::MatrixXd& mass);
void prescribe(mlcp::Problem& problem, int body, std::vector<double> velocity);
void set_k(mlcp::Problem& problem, const Eigen::VectorXd& k);
int add_row(mlcp::Problem& problem, const std::vector<Entry>& entries, double r = 0, Bounds bounds = unilateral,
            double compliance = 0, std::uint64_t key = 0);
void set_sigma(mlcp::Problem& problem, const Eigen::MatrixXd& sigma);
mlcp::Mask mask_of(const std::vector<mlcp_row_state>& states);

/// n = 0: w = A z + b, 0 ≤ z ⊥ w ≥ 0; entries of A that are 0 are not stored.
mlcp::Problem reduced_problem(const Eigen::MatrixXd& A, const Eigen::VectorXd& b);

/// Every number with 17 digits, to build the problem again by hand.
std::string text(const mlcp::Problem& problem, const mlcp::Mask* enabled = nullptr, const mlcp::Mask* start = nullptr);

}  // namespace support
