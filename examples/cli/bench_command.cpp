#include "bench_command.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <iostream>
#include <string_view>

// nlohmann/json: one object for both forms of output
#include <nlohmann/json.hpp>

#include "problem_file.h"

namespace cli {
namespace {

using Json = nlohmann::ordered_json;
using handles::check;

constexpr int fewest_turns = 3, most_turns = 101;

double now() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// One method at one tolerance.
struct Candidate {
  mlcp_settings settings;
  std::vector<double> cold, known;
  mlcp_report report;  // of the last solve
  mlcp_status status = MLCP_OK;

  void take_turn(const ProblemFile& file) {
    const double start = now();
    const handles::Solver solver = handles::make_solver(&settings);
    status = mlcp_solve(solver.get(), file.problem.get(), file.enabled.get(), nullptr, &report);
    const double between = now();
    if (status != MLCP_OK) return;
    check(mlcp_solve(solver.get(), file.problem.get(), file.enabled.get(), nullptr, &report), solver);
    cold.push_back(between - start);
    known.push_back(now() - between);
  }
};

/// Every method that this library has a name for.
std::vector<Candidate> candidates(const ProblemFile& file, const BenchOptions& options) {
  std::vector<Candidate> found;
  for (mlcp_method method = 0; mlcp_method_text(method) != std::string_view("unknown"); ++method) {
    for (const double tolerance : options.tolerances) {
      Candidate& candidate = found.emplace_back();
      mlcp_settings_init(&candidate.settings, sizeof candidate.settings);
      check(mlcp_solver_get_settings(file.solver.get(), &candidate.settings));
      candidate.settings.method = method;
      candidate.settings.tolerance = tolerance;
      candidate.settings.trace = 0;
      candidate.settings.warm_start = 0;  // a known pattern is not a warm start
      if (options.max_seconds) candidate.settings.max_seconds = *options.max_seconds;
      mlcp_report_init(&candidate.report, sizeof candidate.report);
    }
  }
  return found;
}

Json result(const Candidate& candidate) {
  Json json = {{"method", mlcp_method_text(candidate.settings.method)}, {"tolerance", candidate.settings.tolerance}};
  if (candidate.status != MLCP_OK) {
    json["status"] = mlcp_status_text(candidate.status);
    return json;
  }
  json["status"] = mlcp_outcome_text(candidate.report.outcome);
  json["cold_seconds"] = median(candidate.cold);
  json["known_seconds"] = median(candidate.known);
  json["error"] = candidate.report.largest_error;
  json["turns"] = candidate.cold.size();
  return json;
}

Json measure(const std::string& path, const BenchOptions& options) {
  const ProblemFile file = read_problem(path);
  std::vector<Candidate> all = candidates(file, options);
  const double end = now() + options.seconds;
  for (int turn = 0; turn < most_turns && (turn < fewest_turns || now() < end); ++turn)
    for (Candidate& candidate : all) candidate.take_turn(file);
  Json json = {{"problem", path},
               {"velocities", mlcp_problem_velocity_count(file.problem.get())},
               {"rows", mlcp_problem_row_count(file.problem.get())},
               {"results", Json::array()}};
  for (const Candidate& candidate : all) json["results"].push_back(result(candidate));
  return json;
}

void print(const Json& measured) {
  std::printf("%s: %d velocities, %d rows\n", measured["problem"].get<std::string>().c_str(), measured["velocities"].get<int>(),
              measured["rows"].get<int>());
  std::printf("  %-10s %9s %12s %12s %9s %6s  %s\n", "method", "tolerance", "cold [ms]", "known [ms]", "error", "turns", "status");
  for (const Json& one : measured["results"]) {
    std::printf("  %-10s %9.0e", one["method"].get<std::string>().c_str(), one["tolerance"].get<double>());
    if (one.contains("error"))
      std::printf(" %12.4f %12.4f %9.1e %6d", 1e3 * one["cold_seconds"].get<double>(), 1e3 * one["known_seconds"].get<double>(),
                  one["error"].get<double>(), one["turns"].get<int>());
    else
      std::printf(" %12s %12s %9s %6s", "", "", "", "");
    std::printf("  %s\n", one["status"].get<std::string>().c_str());
  }
  std::fflush(stdout);
}

}  // namespace

void run_bench(const BenchOptions& options) {
  Json all = Json::array();
  for (const std::string& path : options.problems) {
    all.push_back(measure(path, options));
    if (options.output == "text") print(all.back());
  }
  if (options.output == "json") std::cout << Json{{"version", mlcp_version()}, {"problems", all}}.dump() << "\n";
}

}  // namespace cli
