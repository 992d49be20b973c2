#pragma once
#include "assemble/symmetric.h"

namespace mlcp {

/// Σ as a whole, m × m. fails: Error, bad_alloc; nothing changed.
void set_compliance_matrix(Problem& problem, const SymmetricInput& matrix);

}  // namespace mlcp
