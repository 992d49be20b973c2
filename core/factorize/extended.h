#pragma once
#include <limits>

namespace mlcp {

/// The widest numbers that the compiler computes with by itself: 113 bits on x86-64, in libgcc's arithmetic, which every program of GCC and Clang has
/// linked already; where long double is as wide, or there is nothing wider, that. No function of a mathematical library is needed.
#ifdef __SIZEOF_FLOAT128__
__extension__ using Extended = __float128;
constexpr double extended_epsilon = 0x1p-112;
#else
using Extended = long double;
constexpr double extended_epsilon = static_cast<double>(std::numeric_limits<long double>::epsilon());
#endif

inline Extended magnitude(Extended x) { return x < 0 ? -x : x; }

}  // namespace mlcp
