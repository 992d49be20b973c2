#pragma once
#include <string>
#include <vector>

#include "mlcp.h"

namespace hard {

/// What a solve by the C ABI left.
struct Solution {
  mlcp_report report;
  std::vector<double> v, gamma;
  std::vector<std::int32_t> certificate_row;  ///< of the first infeasible island; empty if there is none
  std::vector<double> certificate_y;
};

/// From a new solver. max_iterations 0: the default.
Solution solve(const mlcp_problem* problem, mlcp_method method, double tolerance, std::int64_t max_iterations = 0);

/// The errors of section "report" of mlcp.h, from the problem's own numbers in extended precision, without a line of the library's code. The
/// largest of the three; infinite where something is not finite.
double largest_error(const mlcp_problem* problem, const std::vector<double>& v, const std::vector<double>& gamma);

/// "" if y on the rows proves by itself that there is no solution, else what is wrong: |Jᵀy| and |Σy| ≤ 1e-12 of their terms, y only against
/// infinite bounds, yᵀ(r − J v_given) > 0.
std::string certificate_fault(const mlcp_problem* problem, const std::vector<std::int32_t>& rows, const std::vector<double>& y);

}  // namespace hard
