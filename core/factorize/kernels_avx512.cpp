// Compiled with AVX-512 (core/CMakeLists.txt); called on CPUs that have it.
#include "factorize/kernels.h"

#if defined(__AVX512F__)
#include "factorize/kernel_table.h"

namespace mlcp {

const Kernels avx512_kernels = kernel_table;

}  // namespace mlcp
#endif
