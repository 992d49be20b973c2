#include "factorize/dense_tableau.h"

#include <algorithm>

namespace mlcp {

void DenseTableau::load() {
  for (std::int32_t i = 0; i < s_.m; ++i) std::copy_n(s_.row_of_a(i), std::min<std::int64_t>((i + 4) / 4 * 4, stride_), s_.tableau + i * stride_);
}

}  // namespace mlcp
