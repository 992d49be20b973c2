// Speed against error of laws of friction, numbers of facets and methods: the same problems solved with each of them in turns.
//   friction_table --scene NAME [--size N] [--steps N]      warm steps of a scene, which moves by its own law
//   friction_table [--warm] PROBLEM...                      folders, snapshots or FCLIB files; --warm: they are steps of one motion
// Errors are those that the library recomputes, medians. The difference is that of the velocities to those of Coulomb's law on the circular cone,
// relative to the largest of them (of slacks, where a problem has no velocities), mean over all problems that the reference solves.
// CLI11: arguments with checks and help
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "candidate.h"
#include "cli/problem_file.h"
#include "scenes/scenes.h"

namespace {

struct Options {
  std::string scene;
  std::int32_t size = 0;  // 0: the scene's own
  int steps = 50, turns = 1;
  bool warm = false;
  double seconds = 1, reference_seconds = 10;
  std::vector<std::string> problems, methods = {"auto", "newton", "simplex", "pgs"}, laws;
};

std::vector<scenes::Problem> steps_of(const Options& options) {
  const auto exhibits = scenes::gallery();
  const auto found = std::find_if(exhibits.begin(), exhibits.end(), [&](const auto& one) { return options.scene == one.name; });
  const std::int32_t usual = found == exhibits.end() ? 1 : found->default_size;
  const auto scene = scenes::make_scene(options.scene, options.size > 0 ? options.size : usual);
  std::vector<scenes::Problem> steps;
  for (int step = 0; step < options.steps; ++step) {
    scene->prepare(scenes::default_step);
    mlcp_problem* copy = nullptr;
    scenes::check(mlcp_problem_clone(scene->problem(), &copy));
    steps.emplace_back(copy);
    scene->finish();
  }
  return steps;
}

std::vector<scenes::Problem> read(const Options& options) {
  std::vector<scenes::Problem> problems;
  for (const std::string& path : options.problems) problems.push_back(cli::read_problem(path, {MLCP_FRICTION_COULOMB, 0}).problem);
  return problems;
}

mlcp_method method_of(std::string_view name) {
  for (mlcp_method method = 0; mlcp_method_text(method) != std::string_view("unknown"); ++method)
    if (name == mlcp_method_text(method)) return method;
  throw std::runtime_error("there is no method " + std::string(name));
}

double median(std::vector<double> values) {
  if (values.empty()) return NAN;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

double mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return values.empty() ? NAN : sum / static_cast<double>(values.size());
}

/// The laws asked for by their first letters, with every method asked for; those without friction first.
std::vector<Candidate> candidates(const Options& options) {
  std::vector<Candidate> made;
  const auto wanted = [&](const Law& law) {
    return options.laws.empty() || law.model == MLCP_FRICTION_NONE ||
           std::any_of(options.laws.begin(), options.laws.end(), [&](const std::string& name) { return std::string(law.name).starts_with(name); });
  };
  for (const Law& law : laws())
    for (const std::string& method : options.methods)
      if (wanted(law)) made.emplace_back(law, method_of(method), options.seconds, options.warm);
  return made;
}

void print(const std::vector<Candidate>& all) {
  std::printf("%-20s %-8s %9s %10s %8s %7s %7s %9s %11s\n", "law, facets", "method", "solved", "median ms", "x none", "solves", "facets", "error",
              "difference");
  for (const Candidate& c : all) {
    const auto plain = std::find_if(all.begin(), all.end(), [&](const Candidate& other) { return other.method == c.method; });
    std::printf("%-20s %-8s %4d/%-4d %10.4f %8.1f %7.1f %7d %9.0e %11.1e\n", c.law.name, mlcp_method_text(c.method), c.solved, c.solves,
                median(c.milliseconds), median(c.milliseconds) / median(plain->milliseconds), static_cast<double>(c.shifts) / c.solves, c.facets,
                median(c.error), mean(c.difference));
  }
}

void run(Options options) {
  if (options.scene.empty() == options.problems.empty()) throw std::runtime_error("a scene or problems, one of both");
  if (!options.scene.empty()) options.warm = true;
  const std::vector<scenes::Problem> problems = options.scene.empty() ? read(options) : steps_of(options);
  std::int32_t contacts = 0;
  for (const scenes::Problem& problem : problems) contacts = std::max(contacts, mlcp_problem_contact_count(problem.get()));
  if (contacts == 0) throw std::runtime_error("there are no contacts with friction");
  Candidate reference(reference_law(), MLCP_METHOD_AUTO, options.reference_seconds, options.warm);
  std::vector<Candidate> all = candidates(options);
  for (int turn = 0; turn < options.turns; ++turn) {
    for (Candidate& candidate : all) candidate.begin_turn();
    reference.begin_turn();
    for (const scenes::Problem& problem : problems) {
      reference.solve(problem);
      for (Candidate& candidate : all) {
        candidate.solve(problem);
        candidate.compare(reference);
      }
    }
  }
  std::printf("%zu problems, up to %d contacts, %s; the reference is solved in %d of %d\n", problems.size(), contacts,
              options.warm ? "warm" : "cold", reference.solved, reference.solves);
  print(all);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Speed against error of laws of friction, numbers of facets and methods", "friction_table");
  Options options;
  app.add_option("PROBLEM", options.problems, "Folders of Matrix Market files, snapshots or FCLIB files");
  app.add_flag("--warm", options.warm, "The problems are steps of one motion: each starts where the one before it ended");
  app.add_option("--scene", options.scene, "A scene instead; its steps are warm");
  app.add_option("--size", options.size, "Of the scene [its own]")->check(CLI::PositiveNumber);
  app.add_option("--steps", options.steps, "Of the scene")->check(CLI::PositiveNumber)->capture_default_str();
  app.add_option("--turns", options.turns, "How often all is solved")->check(CLI::PositiveNumber)->capture_default_str();
  app.add_option("--seconds", options.seconds, "A solve may take")->check(CLI::PositiveNumber)->capture_default_str();
  app.add_option("--reference-seconds", options.reference_seconds, "A solve of the reference may take")->check(CLI::PositiveNumber)->capture_default_str();
  app.add_option("--method", options.methods, "auto, newton, simplex, pgs [all], separated by commas")->delimiter(',');
  app.add_option("--law", options.laws, "box, convex, Coulomb, or \"Coulomb, 8\" [all]")->allow_extra_args(false);
  try {
    app.parse(argc, argv);
    run(options);
    return 0;
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 3;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "friction_table: %s\n", error.what());
    return 4;
  }
}
