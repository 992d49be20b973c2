// Compiled with -mavx2 (core/CMakeLists.txt); called on CPUs that have it.
#include "factorize/kernels.h"

#if defined(__x86_64__)
#include "factorize/kernel_table.h"

namespace mlcp {

const Kernels avx2_kernels = kernel_table;

}  // namespace mlcp
#endif
