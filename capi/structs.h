#pragma once
#include <algorithm>
#include <cstring>

#include "memory/error.h"

/// Structs of callers that were compiled against an older or a newer mlcp.h: `struct_size` tells how much of it they have.
namespace mlcp {

constexpr std::size_t largest_struct = 4096;  ///< more is an uninitialised struct_size

template <class Struct>
void check_struct_size(const char* name, std::size_t size) {
  if (size <= sizeof(std::size_t) || size > largest_struct || size % alignof(Struct) != 0)
    throw Error(MLCP_ERROR_ARGUMENT, "%s.struct_size = %zu: call the init function first", name, size);
}

/// The caller's fields over `defaults`, which stand for those that he does not know.
/// fails: UNSUPPORTED, when he sets a field that this library does not know.
template <class Struct>
Struct import_struct(const char* name, const Struct* from, Struct defaults) {
  if (!from) throw Error(MLCP_ERROR_NULL, "%s is NULL", name);
  const std::size_t size = from->struct_size;
  check_struct_size<Struct>(name, size);
  const unsigned char* bytes = reinterpret_cast<const unsigned char*>(from);
  if (size > sizeof defaults && std::any_of(bytes + sizeof defaults, bytes + size, [](unsigned char b) { return b != 0; }))
    throw Error(MLCP_ERROR_UNSUPPORTED, "%s has a field that this version of the library does not know", name);
  std::memcpy(&defaults, from, std::min(size, sizeof defaults));
  defaults.struct_size = sizeof defaults;
  return defaults;
}

/// As much of `value` as the caller's struct holds; its struct_size stays. before: check_struct_size.
template <class Struct>
void export_struct(const Struct& value, Struct* to) {
  const std::size_t size = to->struct_size;
  std::memcpy(static_cast<void*>(to), &value, std::min(size, sizeof value));
  to->struct_size = size;
}

/// What init functions do: `defaults` in as much as there is, zeros behind.
template <class Struct>
void init_struct(const Struct& defaults, Struct* to, std::size_t size) {
  if (!to || size < sizeof(std::size_t)) return;
  unsigned char* bytes = reinterpret_cast<unsigned char*>(to);
  const std::size_t known = std::min(size, sizeof defaults);
  std::memcpy(bytes, &defaults, known);
  if (size <= largest_struct) std::fill(bytes + known, bytes + size, static_cast<unsigned char>(0));
  std::memcpy(bytes, &size, sizeof size);
}

}  // namespace mlcp
