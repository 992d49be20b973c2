#include "report/compress.h"

#include <zlib.h>

#include "memory/error.h"

namespace mlcp {

namespace {

constexpr std::size_t chunk = std::size_t(1) << 18;
constexpr std::size_t header = alignof(std::max_align_t);  ///< in front of every block: its size
constexpr std::uint64_t largest_ratio = 1032;              ///< of deflate, 258 bytes in two bits

// zlib is C: no exception may pass through it
void* allocate(void* memory, uInt items, uInt size) {
  const std::size_t bytes = header + std::size_t(items) * size;
  try {
    void* block = static_cast<const Memory*>(memory)->reallocate(nullptr, 0, bytes);
    std::memcpy(block, &bytes, sizeof bytes);
    return static_cast<char*>(block) + header;
  } catch (const std::bad_alloc&) {
    return Z_NULL;
  }
}

void release(void* memory, void* pointer) {
  void* block = static_cast<char*>(pointer) - header;
  std::size_t bytes;
  std::memcpy(&bytes, block, sizeof bytes);
  static_cast<const Memory*>(memory)->release(block, bytes);
}

/// Ends the stream however the function is left.
struct Stream {
  z_stream z{};
  int (*end)(z_stream*);

  Stream(const Memory& memory, int (*e)(z_stream*)) : end(e) {
    z.zalloc = allocate;
    z.zfree = release;
    z.opaque = const_cast<Memory*>(&memory);
  }
  ~Stream() { end(&z); }
  Stream(const Stream&) = delete;
  Stream& operator=(const Stream&) = delete;
};

void check_memory(int code) {
  if (code == Z_MEM_ERROR) throw std::bad_alloc();
}

/// The next piece of what is to go in.
void feed(z_stream& z, std::span<const std::uint8_t>& from) {
  if (z.avail_in > 0) return;
  const std::size_t size = std::min(from.size(), chunk);
  z.next_in = const_cast<Bytef*>(from.data());
  z.avail_in = static_cast<uInt>(size);
  from = from.subspan(size);
}

}  // namespace

void deflate_bytes(const Memory& memory, std::span<const std::uint8_t> from, Array<std::uint8_t>& out) {
  Stream stream(memory, deflateEnd);
  z_stream& z = stream.z;
  const int begun = deflateInit(&z, Z_DEFAULT_COMPRESSION);
  check_memory(begun);
  if (begun != Z_OK) throw Error(MLCP_ERROR_INTERNAL, "zlib cannot begin: %d", begun);
  int code = Z_OK;
  while (code != Z_STREAM_END) {
    feed(z, from);
    const std::size_t before = out.size();
    out.resize(before + chunk);
    z.next_out = out.data() + before;
    z.avail_out = chunk;
    code = deflate(&z, from.empty() ? Z_FINISH : Z_NO_FLUSH);
    out.resize(out.size() - z.avail_out);
    if (code != Z_OK && code != Z_STREAM_END) throw Error(MLCP_ERROR_INTERNAL, "zlib cannot compress: %d", code);
  }
}

void inflate_bytes(const Memory& memory, std::span<const std::uint8_t> from, std::uint64_t size, Array<std::uint8_t>& out) {
  if (size / largest_ratio > from.size()) throw Error(MLCP_ERROR_FORMAT, "the snapshot is damaged: impossible size");
  out.clear();
  Stream stream(memory, inflateEnd);
  z_stream& z = stream.z;
  const int begun = inflateInit(&z);
  check_memory(begun);
  int code = begun;
  while (code == Z_OK) {
    feed(z, from);
    const std::size_t before = out.size(), room = static_cast<std::size_t>(std::min<std::uint64_t>(size - before, chunk));
    std::uint8_t beyond;  // one byte more than was announced is an error too
    out.resize(before + room);
    z.next_out = room ? out.data() + before : &beyond;
    z.avail_out = room ? static_cast<uInt>(room) : 1;
    code = inflate(&z, Z_NO_FLUSH);
    check_memory(code);
    if (room) out.resize(out.size() - z.avail_out);
    if (!room && z.avail_out == 0) code = Z_DATA_ERROR;
  }
  if (code != Z_STREAM_END || out.size() != size || z.avail_in > 0 || !from.empty())
    throw Error(MLCP_ERROR_FORMAT, "the snapshot is damaged: it does not decompress");
}

std::uint32_t checksum(std::span<const std::uint8_t> bytes) {
  uLong crc = crc32(0, Z_NULL, 0);
  while (!bytes.empty()) {
    const std::size_t size = std::min(bytes.size(), chunk);
    crc = crc32(crc, bytes.data(), static_cast<uInt>(size));
    bytes = bytes.subspan(size);
  }
  return static_cast<std::uint32_t>(crc);
}

}  // namespace mlcp
