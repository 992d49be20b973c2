#pragma once
#include <cstdint>
#include <span>

#include "memory/array.h"

/// zlib over the caller's memory.
namespace mlcp {

/// Appends.      fails: bad_alloc.
void deflate_bytes(const Memory& memory, std::span<const std::uint8_t> from, Array<std::uint8_t>& out);

/// Exactly `size` bytes; room grows with what comes out, so that a lie about the size costs nothing.
/// fails: Error (FORMAT), bad_alloc.
void inflate_bytes(const Memory& memory, std::span<const std::uint8_t> from, std::uint64_t size, Array<std::uint8_t>& out);

std::uint32_t checksum(std::span<const std::uint8_t> bytes);

}  // namespace mlcp
