#include "factorize/kernels.h"

namespace mlcp {

const Kernels& kernels_for_this_cpu() {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx2")) return avx2_kernels;
#endif
  return portable_kernels;
}

}  // namespace mlcp
