/// All loops of Kernels for the instruction set of the file that includes this.
#include "factorize/kernel_loops.h"
#include "factorize/panel_loops.h"
#include "factorize/diagonal_loops.h"

namespace mlcp {
namespace {

constexpr Kernels kernel_table{forward,       combine,        products,  backward,    rank_one,      panel_forward, block_eliminate,
                               block_forward, block_backward, panel_add, panel_scale, panel_product, tiles_square,  tiles_times,
                               tiles_transposed, impulse_sweep, column_products, diagonal_solve, diagonal_within};

}  // namespace
}  // namespace mlcp
