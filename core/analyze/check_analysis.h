#pragma once
#include "analyze/analysis.h"

namespace mlcp {

/// What factorize relies on, for assertions: the order is a permutation with every row after its velocities; a column's rows ascend and
/// its first one is its parent; islands tile the order and each is one tree; runs nest.
/// cost: O(entries of L).
bool check_analysis(const Analysis& analysis);

}  // namespace mlcp
