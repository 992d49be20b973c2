#include "factorize/kernels.h"

#include "factorize/kernel_loops.h"

namespace mlcp {

const Kernels portable_kernels{forward, combine, backward, rank_one};

}  // namespace mlcp
