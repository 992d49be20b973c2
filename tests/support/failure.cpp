#include "support/failure.h"

#include "report/snapshot.h"

namespace support {

std::string evidence(const std::string& name, std::uint64_t seed, const mlcp::Problem& problem, const mlcp::Settings& settings,
                     const mlcp::Mask* enabled, const mlcp::Mask* start) {
  const std::string path = "failed_" + name + "_" + std::to_string(seed) + ".mlcp";
  std::string kept = "snapshot in " + path;
  try {
    mlcp::snapshot_save(mlcp::Memory(), path.c_str(), {problem, settings, {}, enabled, start});
  } catch (const mlcp::Error& e) {
    kept = std::string("no snapshot: ") + e.text;
  }
  return "seed " + std::to_string(seed) + ", " + kept + "\n" + text(problem, enabled, start);
}

}  // namespace support
