#pragma once
#include <string>
#include <vector>

#include "solver.h"
#include "support/dense.h"

/// One solve with everything it leaves, and what is to hold of it.
namespace support {

struct Solution {
  mlcp_report report{};
  std::vector<double> v, gamma, w;
  std::vector<mlcp_row_state> state;
  std::vector<std::uint8_t> redundant;
  std::vector<std::int32_t> row_island, certificate_row;  ///< the first certificate
  std::vector<double> certificate_y;
  std::vector<mlcp_outcome> island_outcome;
  std::vector<mlcp_pivot> trace;
};

/// Of the simplex.
mlcp::Settings settings(mlcp_pivot_rule rule = MLCP_PIVOT_DUAL, mlcp_refactorize refactorize = MLCP_REFACTORIZE_WHEN_NEEDED);
/// Of auto.
mlcp::Settings automatic();
Solution solve(const mlcp::Problem& problem, const mlcp::Settings& settings, const mlcp::Mask* enabled = nullptr,
               const mlcp::Mask* start = nullptr);
Solution solve(const mlcp::Problem& problem, const mlcp::Mask* enabled = nullptr, const mlcp::Mask* start = nullptr);
/// With a solver that has solved before.
Solution solve(mlcp::Solver& solver, const mlcp::Problem& problem, const mlcp::Mask* enabled = nullptr,
               const mlcp::Mask* start = nullptr);

/// "" if the outcome is solved, the errors recomputed here are at most `most` and the report says the same, else what is wrong.
std::string fault(const Dense& d, const Solution& s, double most = 1e-12);
/// "" if the outcome is infeasible and its certificate holds.
std::string infeasible_fault(const Dense& d, const Solution& s);

/// max |x − y| / max(1, |x|, |y|)
double difference(const std::vector<double>& x, const std::vector<double>& y);
double difference(const std::vector<double>& x, const Vector& y);

}  // namespace support
