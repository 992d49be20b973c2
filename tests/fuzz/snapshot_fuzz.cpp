// Snapshots from strangers: whatever is read is a legal problem, keeps its bytes on the way out and in again, and can be solved.
#include <memory>
#include <vector>

#include "input.h"
#include "mlcp.h"
#include "report/snapshot_payload.h"

namespace {

using Bytes = std::vector<std::uint8_t>;

struct Objects {
  mlcp_problem* problem = nullptr;
  mlcp_solver* solver = nullptr;
  mlcp_mask *enabled = nullptr, *start = nullptr;

  Objects() = default;
  Objects(const Objects&) = delete;
  ~Objects() {
    mlcp_problem_destroy(problem);
    mlcp_solver_destroy(solver);
    mlcp_mask_destroy(enabled);
    mlcp_mask_destroy(start);
  }
  mlcp_status read(const Bytes& bytes) {
    char message[512];
    const mlcp_status status =
        mlcp_snapshot_read(bytes.data(), bytes.size(), nullptr, &problem, &solver, &enabled, &start, message, sizeof message);
    fuzz::require((status == MLCP_OK) == (problem && solver), "objects come with success");
    fuzz::require((status == MLCP_OK) == !*message, "a refusal says why");
    return status;
  }
  Bytes write() const {
    std::size_t size = 0;
    fuzz::require(mlcp_snapshot_write(problem, solver, enabled, start, 0, nullptr, &size, nullptr, 0) == MLCP_OK, "its size is known");
    Bytes bytes(size);
    fuzz::require(mlcp_snapshot_write(problem, solver, enabled, start, size, bytes.data(), &size, nullptr, 0) == MLCP_OK,
                  "what was read can be written");
    return bytes;
  }
};

/// The limits are ours: a snapshot may ask for any time and a thousand threads.
void solve(const Objects& o) {
  mlcp_settings settings;
  mlcp_settings_init(&settings, sizeof settings);
  fuzz::require(mlcp_solver_get_settings(o.solver, &settings) == MLCP_OK, "settings can be read");
  settings.num_threads = 1;
  settings.max_work = 1000000;
  settings.max_iterations = 200;
  settings.max_shifts = 20;
  fuzz::require(mlcp_solver_set_settings(o.solver, &settings) == MLCP_OK, "settings can be changed");
  mlcp_report report;
  mlcp_report_init(&report, sizeof report);
  fuzz::require(mlcp_solve(o.solver, o.problem, o.enabled, o.start, &report) == MLCP_OK, "what was read can be solved");
  fuzz::require(report.outcome != MLCP_SOLVED || report.largest_error <= settings.tolerance, "solved is within the tolerance");
}

/// The snapshot of a payload that is legal, empty for another.
Bytes packed(const std::uint8_t* data, std::size_t size, std::uint32_t version) {
  mlcp::Snapshot s{mlcp::Memory()};
  try {
    mlcp::read_payload(mlcp::Memory(), {data, size}, version, s);
  } catch (const mlcp::Error& e) {
    fuzz::require(e.status == MLCP_ERROR_FORMAT, "a refusal says that the format is wrong");
    return {};
  }
  mlcp::Array<std::uint8_t> bytes{mlcp::Memory()};
  mlcp::snapshot_write({s.problem, s.settings, s.ordering.span(), s.has_enabled ? &s.enabled : nullptr, s.has_start ? &s.start : nullptr},
                       bytes);
  return {bytes.begin(), bytes.end()};
}

}  // namespace

/// The first byte tells what follows: a payload of version 1 or 2, which no checksum keeps away, or a whole file.
int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::uint32_t version = data[0] % 3;
  const Bytes bytes = version > 0 ? packed(data + 1, size - 1, version) : Bytes(data + 1, data + size);
  if (bytes.empty()) return 0;
  Objects first;
  const mlcp_status status = first.read(bytes);
  fuzz::require(status == MLCP_OK || (version == 0 && status == MLCP_ERROR_FORMAT), "only a strange file is refused");
  if (status != MLCP_OK) return 0;
  const Bytes written = first.write();
  Objects second;
  fuzz::require(second.read(written) == MLCP_OK, "what was written can be read");
  fuzz::require(second.write() == written, "a snapshot keeps its bytes");
  solve(second);
  return 0;
}
