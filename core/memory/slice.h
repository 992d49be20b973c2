#pragma once
#include <Eigen/Core>
#include <cstdint>

namespace mlcp {

/// Entries first .. last − 1 of an array that somebody else owns, as a vector to compute with. Allocates nothing.
template <class T>
Eigen::Map<Eigen::Array<T, Eigen::Dynamic, 1>> slice(T* data, std::int32_t first, std::int32_t last) {
  return {data + first, last - first};
}
template <class T>
Eigen::Map<const Eigen::Array<T, Eigen::Dynamic, 1>> slice(const T* data, std::int32_t first, std::int32_t last) {
  return {data + first, last - first};
}

}  // namespace mlcp
