#include "report/snapshot.h"

#include "assemble/validate.h"
#include "report/bytes.h"
#include "report/compress.h"
#include "report/file.h"
#include "report/snapshot_payload.h"

namespace mlcp {

namespace {

constexpr std::size_t header_size = 40, crc_at = 36;
/// 1: without contacts, impulses in masks and the settings that came with newton and friction.
constexpr std::uint32_t version = 2, oldest_version = 1;
constexpr std::uint8_t magic[8] = {'M', 'L', 'C', 'P', 'S', 'N', 'A', 'P'};

struct Header {
  std::uint64_t size, packed;
  std::uint32_t crc, version;
};

void write_header(const Header& header, Array<std::uint8_t>& out) {
  ByteWriter to(out);
  to.bytes(magic);
  to.u32(header.version);
  to.u32(0);
  to.u64(header.size);
  to.u64(header.packed);
  to.u32(header.crc);
  to.u32(checksum(out.span()));
}

Header read_header(std::span<const std::uint8_t> bytes) {
  if (bytes.size() < header_size || !std::equal(std::begin(magic), std::end(magic), bytes.begin()))
    throw Error(MLCP_ERROR_FORMAT, "this is not a snapshot");
  ByteReader from(bytes.subspan(sizeof magic));
  const std::uint32_t found = from.u32();
  from.u32();
  const Header header{from.u64(), from.u64(), from.u32(), found};
  if (from.u32() != checksum(bytes.first(crc_at))) throw Error(MLCP_ERROR_FORMAT, "the snapshot is damaged: its header");
  if (found < oldest_version || found > version)
    throw Error(MLCP_ERROR_FORMAT, "the snapshot has version %u, this library reads %u to %u", found, oldest_version, version);
  return header;
}

void check_size(const Header& header, std::uint64_t size) {
  if (header.packed != size - header_size)
    throw Error(MLCP_ERROR_FORMAT, "the snapshot has %llu bytes behind its header, but announces %llu",
                static_cast<unsigned long long>(size - header_size), static_cast<unsigned long long>(header.packed));
}

void unpack(const Memory& memory, const Header& header, std::span<const std::uint8_t> packed, Snapshot& out) {
  if (checksum(packed) != header.crc) throw Error(MLCP_ERROR_FORMAT, "the snapshot is damaged: its checksum");
  Array<std::uint8_t> payload(memory);
  inflate_bytes(memory, packed, header.size, payload);
  read_payload(memory, payload.span(), header.version, out);
}

void load(const Memory& memory, InputFile& file, Snapshot& out) {
  std::uint8_t first[header_size];
  if (file.size() < header_size) throw Error(MLCP_ERROR_FORMAT, "this is not a snapshot");
  file.read(first);
  const Header header = read_header(first);
  check_size(header, file.size());
  Array<std::uint8_t> packed(memory);
  packed.resize(header.packed);
  file.read(packed.span());
  unpack(memory, header, packed.span(), out);
}

void check_mask(const char* name, const Mask* mask, std::int32_t rows) {
  if (mask) check_length(name, static_cast<std::int64_t>(mask->state.size()), rows);
}

}  // namespace

Snapshot::Snapshot(const Memory& memory)
    : problem(memory), settings(default_settings()), ordering(memory), enabled(memory), start(memory) {}

void snapshot_write(const SnapshotSource& source, Array<std::uint8_t>& out) {
  check_mask("rows of enabled", source.enabled, source.problem.m());
  check_mask("rows of start", source.start, source.problem.m());
  const Memory& memory = source.problem.memory;
  Array<std::uint8_t> payload(memory), packed(memory);
  write_payload(source, payload);
  deflate_bytes(memory, payload.span(), packed);
  out.clear();
  out.reserve(header_size + packed.size());
  write_header({payload.size(), packed.size(), checksum(packed.span()), version}, out);
  out.resize(header_size + packed.size());
  std::copy(packed.begin(), packed.end(), out.begin() + header_size);
}

void snapshot_read(const Memory& memory, std::span<const std::uint8_t> bytes, Snapshot& out) {
  const Header header = read_header(bytes);
  check_size(header, bytes.size());
  unpack(memory, header, bytes.subspan(header_size), out);
}

void snapshot_save(const Memory& memory, const char* path, const SnapshotSource& source) {
  Array<std::uint8_t> bytes(memory);
  snapshot_write(source, bytes);
  write_file(memory, path, bytes.span());
}

void snapshot_load(const Memory& memory, const char* path, Snapshot& out) {
  InputFile file(path);
  try {
    load(memory, file, out);
  } catch (const Error& e) {
    if (e.status != MLCP_ERROR_FORMAT) throw;
    throw Error(MLCP_ERROR_FORMAT, "\"%.240s\": %s", path, e.text);
  }
}

}  // namespace mlcp
