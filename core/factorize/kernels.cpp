#include "factorize/kernels.h"

#include "factorize/kernel_loops.h"

namespace mlcp {

const Kernels portable_kernels{forward, combine, backward, rank_one};

const Kernels& kernels_for_this_cpu() {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx2")) return avx2_kernels;
#endif
  return portable_kernels;
}

}  // namespace mlcp
