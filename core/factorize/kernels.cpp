#include "factorize/kernels.h"

#include "factorize/kernel_table.h"

namespace mlcp {

const Kernels portable_kernels = kernel_table;

}  // namespace mlcp
