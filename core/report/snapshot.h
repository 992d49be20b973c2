#pragma once
#include "assemble/mask.h"
#include "assemble/problem.h"
#include "solve/settings.h"

/// All that a solve depends on, as bytes: a replay by the same build gives the same bits.
///
///   magic      8 bytes "MLCPSNAP"
///   version    u32, 2                       reserved  u32, 0
///   size       u64, of the payload          packed    u64, of the payload compressed
///   crc        u32, of the packed bytes     crc       u32, of the 36 bytes before it
///   packed bytes (zlib)
///
/// Little endian. Counts stand in front of arrays as u32. Payload of version 1: settings (method, pivot rule, refactorize, trace,
/// tolerance, iterations, work, seconds); bodies in order of id (dimension, 0: free; mass as it was given); k; rows (r, lo, hi,
/// key, J by rows, S by columns); enabled and start mask; ordering. Version 2 adds: facets and shifts to the settings; contacts (row,
/// dimension, model, facets, mu) and coupled rows (row, normal) after the rows; how contacts slip to each mask.
namespace mlcp {

struct SnapshotSource {
  const Problem& problem;
  const Settings& settings;                ///< callbacks are left out
  std::span<const std::int32_t> ordering;  ///< left out when it is not for this problem
  const Mask *enabled, *start;             ///< may be NULL
};

/// fails: Error (RANGE, a mask is not m long), bad_alloc.
void snapshot_write(const SnapshotSource& source, Array<std::uint8_t>& out);

struct Snapshot {
  Problem problem;
  Settings settings;
  Array<std::int32_t> ordering;
  bool has_enabled = false, has_start = false;
  Mask enabled, start;

  explicit Snapshot(const Memory& memory);
};

/// before: `out` is new. Everything is added by the calls that callers use, so it is checked as theirs.
/// fails: Error (FORMAT), bad_alloc.
void snapshot_read(const Memory& memory, std::span<const std::uint8_t> bytes, Snapshot& out);

/// fails: Error (IO), and as above.
void snapshot_save(const Memory& memory, const char* path, const SnapshotSource& source);
void snapshot_load(const Memory& memory, const char* path, Snapshot& out);

}  // namespace mlcp
