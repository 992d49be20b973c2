#include "factorize/kernels.h"

namespace mlcp {

const Kernels& kernels_for_this_cpu() {
#if defined(MLCP_HAS_AVX512_KERNELS)
  // Since Ice Lake and Zen 4, which the last of these tells from those before: they lower their clock for 512 bits, for all that runs on them.
  if (__builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vpopcntdq")) return avx512_kernels;
#endif
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx2")) return avx2_kernels;
#endif
  return portable_kernels;
}

}  // namespace mlcp
