// CLI11: subcommands, checks and help
#include <CLI/CLI.hpp>
// nlohmann/json: the answer to bad input where JSON was asked for
#include <nlohmann/json.hpp>

#include <iostream>

#include "bench_command.h"
#include "convert_command.h"
#include "info_command.h"
#include "mlcp.h"
#include "solve_command.h"

namespace {

using cli::Exit;

constexpr const char* counting = "Rows, velocities and bodies count from 0; lines and entries of Matrix Market files from 1.";

void add_output(CLI::App& command, std::string& output) {
  command.add_option("--output", output, "text or json")->check(CLI::IsMember({"text", "json"}))->capture_default_str();
}

void add_solve(CLI::App& app, cli::SolveOptions& options) {
  CLI::App& solve = *app.add_subcommand("solve", "Solve a problem; exit 0: solved, 1: a limit, 2: no solution, 3: bad input");
  solve.add_option("PROBLEM", options.problem, "Folder of Matrix Market files, snapshot or FCLIB file")->required();
  solve.add_option("--method", options.method, "auto, simplex, newton or pgs [auto]");
  solve.add_option("--tolerance", options.tolerance, "On the largest relative error [1e-9]");
  solve.add_option("--max-seconds", options.max_seconds, "Give up after that time [never]");
  solve.add_option("--friction", options.friction,
                   "none, convex, coulomb, or box: bounds mu times the normal impulse [a snapshot's own, else none]");
  solve.add_option("--facets", options.facets, "Of the pyramids in space, at least 3 [the circular cone, to the tolerance]");
  solve.add_option("--pivot-rule", options.pivot_rule, "dual or printed [dual]");
  solve.add_option("--refactorize", options.refactorize, "when-needed or always [when-needed]");
  solve.add_flag("--trace", options.trace, "Print every pivot");
  add_output(solve, options.output);
  solve.footer(std::string("A snapshot brings its own settings; what is given here goes first.\n") + counting);
}

void add_bench(CLI::App& app, cli::BenchOptions& options) {
  CLI::App& bench = *app.add_subcommand("bench", "Time against error for every method, medians of solves in turns");
  bench.add_option("PROBLEM", options.problems, "Folders of Matrix Market files, or snapshots")->required();
  bench.add_option("--tolerance", options.tolerances, "One or more, separated by commas")->delimiter(',')->capture_default_str();
  bench.add_option("--seconds", options.seconds, "For all turns on one problem; three turns at least")->capture_default_str();
  bench.add_option("--max-seconds", options.max_seconds, "Of one solve [no limit]");
  add_output(bench, options.output);
  bench.footer("Wall clock, from no active set. cold: a new solver, analysis included; known: the same solver once more.\n"
               "A method that stops at a limit or cannot do a problem says so in its status; the exit code does not.");
}

/// Message on standard error; where JSON was asked for, also an object on standard output.
int bad_input(const std::string& message, bool json) {
  std::cerr << "mlcp: " << message << "\n";
  if (json) {
    const nlohmann::ordered_json answer = {{"status", mlcp_outcome_text(MLCP_BAD_INPUT)}, {"message", message}};
    std::cout << answer.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) << "\n";
  }
  return Exit::BadInput;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Exact solver for the mixed linear complementarity problem of rigid-body contact", "mlcp");
  app.set_version_flag("--version", mlcp_version());
  app.require_subcommand(1);

  cli::SolveOptions solve;
  add_solve(app, solve);

  std::string info_path, info_output = "text";
  CLI::App& info = *app.add_subcommand("info", "Sizes, islands, rank, scaling, what is unusual about a problem");
  info.add_option("PROBLEM", info_path, "Folder of Matrix Market files, snapshot or FCLIB file")->required();
  add_output(info, info_output);
  info.footer(counting);

  cli::BenchOptions bench;
  add_bench(app, bench);

  std::string from, to;
  CLI::App& convert = *app.add_subcommand("convert", "Between folder, snapshot and FCLIB file");
  convert.add_option("IN", from, "Folder, snapshot or FCLIB file")->required();
  convert.add_option("OUT", to, "Snapshot if it ends in .mlcp, FCLIB file if in .hdf5, else a new folder")->required();
  convert.footer(std::string("A folder has no prescribed bodies: their velocities go into c and d, and v is without them.\n"
                             "Refused: disabled rows, rows neither bilateral nor unilateral, compliance beside velocities.\n") +
                 counting);

  try {
    app.parse(argc, argv);
    if (info.parsed()) cli::run_info(info_path, info_output);
    if (convert.parsed()) cli::run_convert(from, to);
    if (app.got_subcommand("bench")) cli::run_bench(bench);
    return app.got_subcommand("solve") ? cli::run_solve(solve) : Exit::Solved;
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? Exit::Solved : Exit::BadInput;
  } catch (const std::exception& error) {
    const std::string& output = app.got_subcommand("solve") ? solve.output : app.got_subcommand("bench") ? bench.output : info_output;
    return bad_input(error.what(), output == "json");
  }
}
