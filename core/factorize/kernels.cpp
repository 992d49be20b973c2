#include "factorize/kernels.h"

#include "factorize/kernel_loops.h"
#include "factorize/panel_loops.h"

namespace mlcp {

const Kernels portable_kernels{forward,       combine,        products,       backward,    rank_one,      panel_forward, block_eliminate,
                               block_forward, block_backward, panel_add, panel_scale, panel_product, tiles_square,
                               tiles_times, tiles_transposed, impulse_sweep, column_products, sweep};

}  // namespace mlcp
