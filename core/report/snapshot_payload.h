#pragma once
#include "report/snapshot.h"

namespace mlcp {

void write_payload(const SnapshotSource& source, Array<std::uint8_t>& out);
/// fails: Error (FORMAT) that names section and offset, bad_alloc; `out` is then half filled.
void read_payload(const Memory& memory, std::span<const std::uint8_t> payload, std::uint32_t version, Snapshot& out);

}  // namespace mlcp
