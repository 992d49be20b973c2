#pragma once
#include <span>

#include "assemble/problem.h"
#include "report/result.h"

namespace mlcp {

/// (M v − k − Jᵀγ) on the velocities of a prescribed body: the impulse that keeps it at its velocity.
/// fails: Error; RANGE when the problem is not as large as the one that was solved, STATE on a dynamic body.
/// cost:  O(entries of J).
void reaction(const Problem& problem, const Result& result, std::int32_t body, std::span<double> out);

}  // namespace mlcp
