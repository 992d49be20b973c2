#include "solve/settings.h"

#include <algorithm>

#include <cmath>
#include <cstdint>

#include "assemble/problem.h"
#include "memory/error.h"

namespace mlcp {

namespace {

constexpr std::int32_t most_threads = 1024;

}  // namespace

Settings default_settings() {
  Settings settings{};
  settings.struct_size = sizeof settings;
  settings.method = MLCP_METHOD_AUTO;
  settings.pivot_rule = MLCP_PIVOT_DUAL;
  settings.refactorize = MLCP_REFACTORIZE_WHEN_NEEDED;
  settings.tolerance = 1e-9;
  settings.warm_start = 1;
  settings.num_threads = 1;
  return settings;
}

void check_settings(const Settings& settings) {
  const auto refuse = [](const char* field, double value, const char* why) {
    throw Error(MLCP_ERROR_ARGUMENT, "settings.%s = %g %s", field, value, why);
  };
  if (settings.method < MLCP_METHOD_AUTO || settings.method > MLCP_METHOD_PGS)
    refuse("method", settings.method, "is unknown");
  if (settings.pivot_rule < MLCP_PIVOT_DUAL || settings.pivot_rule > MLCP_PIVOT_PRINTED)
    refuse("pivot_rule", settings.pivot_rule, "is unknown");
  if (settings.refactorize < MLCP_REFACTORIZE_WHEN_NEEDED || settings.refactorize > MLCP_REFACTORIZE_ALWAYS)
    refuse("refactorize", settings.refactorize, "is unknown");
  if (!(settings.tolerance > 0) || !std::isfinite(settings.tolerance))
    refuse("tolerance", settings.tolerance, "is not a positive number");
  if (settings.impulses < MLCP_IMPULSES_ANY || settings.impulses > MLCP_IMPULSES_LEAST_NORM) refuse("impulses", settings.impulses, "is unknown");
  if (settings.num_threads < 0 || settings.num_threads > most_threads) refuse("num_threads", settings.num_threads, "is not in 0 .. 1024");
  if (settings.max_iterations < 0) refuse("max_iterations", static_cast<double>(settings.max_iterations), "is negative");
  if (settings.max_work < 0) refuse("max_work", static_cast<double>(settings.max_work), "is negative");
  if (settings.facets < 0 || settings.facets > most_facets || settings.facets == 1 || settings.facets == 2)
    refuse("facets", settings.facets, "is neither 0 nor in 3 .. 1048576");
  if (settings.max_shifts < 0) refuse("max_shifts", settings.max_shifts, "is negative");
  if (!(settings.max_seconds >= 0)) refuse("max_seconds", settings.max_seconds, "is negative");
}

double zero_slack(const Settings& settings) { return std::clamp(settings.tolerance * 1e-4, 2e-15, 1e-13); }

}  // namespace mlcp
