#include "factorize/kernels.h"

#include "factorize/kernel_loops.h"
#include "factorize/panel_loops.h"

namespace mlcp {

const Kernels portable_kernels{forward, combine, backward, rank_one, panel_forward, block_eliminate, panel_scale, panel_product, sweep};

}  // namespace mlcp
