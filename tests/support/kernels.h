#pragma once
#include <vector>

#include "factorize/kernels.h"

namespace support {

/// Every table that this CPU can run, the portable one first.
inline std::vector<const mlcp::Kernels*> kernels_of_this_cpu() {
  std::vector<const mlcp::Kernels*> all{&mlcp::portable_kernels};
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx2")) all.push_back(&mlcp::avx2_kernels);
#endif
  if (const mlcp::Kernels* const chosen = &mlcp::kernels_for_this_cpu(); chosen != all.back()) all.push_back(chosen);
  return all;
}

}  // namespace support
