// In place of core/factorize/kernels_choice.cpp, which a static library then leaves away: a CPU without AVX2.
#include "factorize/kernels.h"

namespace mlcp {

const Kernels& kernels_for_this_cpu() { return portable_kernels; }

}  // namespace mlcp
