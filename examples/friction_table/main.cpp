// Speed against error of the models of friction: the same warm steps of a scene solved with each law in turn.
//   friction_table SCENE SIZE [STEPS [SECONDS]]     SECONDS: a solve may take, 1
// Every law has a solver of its own, which starts each step where it left the one before; the scene itself moves by its own law. The difference is
// that of the velocities to those of Coulomb's law on the circular cone, relative to the largest, its mean over steps where both are solved.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <vector>

#include "scenes/scenes.h"

namespace {

struct Law {
  const char* name;
  mlcp_friction model;
  std::int32_t facets;
};

constexpr Law laws[] = {{"circular cone", MLCP_FRICTION_COULOMB, 0}, {"none", MLCP_FRICTION_NONE, 0},
                        {"convex, 8 facets", MLCP_FRICTION_CONVEX, 8}, {"convex, circular", MLCP_FRICTION_CONVEX, 0},
                        {"Coulomb, 4 facets", MLCP_FRICTION_COULOMB, 4}, {"Coulomb, 8 facets", MLCP_FRICTION_COULOMB, 8},
                        {"Coulomb, 16 facets", MLCP_FRICTION_COULOMB, 16}, {"Coulomb, 32 facets", MLCP_FRICTION_COULOMB, 32}};

/// A law with its solver and what it took.
struct Candidate {
  Law law;
  scenes::Solver solver;
  std::vector<double> milliseconds, difference, v;
  double cone_error = 0, solves = 0, generators = 0;
  int solved = 0;
  bool now = false;  // the present step is solved

  Candidate(const Law& asked, double seconds) : law(asked) {
    mlcp_settings settings;
    mlcp_settings_init(&settings, sizeof settings);
    settings.facets = law.facets;
    settings.max_seconds = seconds;
    solver = scenes::make_solver(&settings);
  }

  void solve(const scenes::Problem& step) {
    const scenes::Problem problem = scenes::clone(step);
    const std::int32_t contacts = mlcp_problem_contact_count(problem.get());
    const std::vector<mlcp_friction> model(static_cast<std::size_t>(contacts), law.model);
    const std::vector<std::int32_t> facets(static_cast<std::size_t>(contacts), law.facets);
    scenes::check(mlcp_problem_contacts_set_friction(problem.get(), 0, contacts, model.data(), nullptr, nullptr, facets.data()), problem);
    mlcp_report report;
    mlcp_report_init(&report, sizeof report);
    scenes::check(mlcp_solve(solver.get(), problem.get(), nullptr, nullptr, &report), solver);
    const double* velocities = nullptr;
    std::int32_t count = 0;
    scenes::check(mlcp_solver_velocities(solver.get(), &velocities, &count));
    v.assign(velocities, velocities + count);
    now = report.outcome == MLCP_SOLVED;
    solved += now;
    milliseconds.push_back(1e3 * report.seconds);
    if (now) cone_error = std::max(cone_error, report.cone_error);
    solves += std::max(1, report.shift_iterations);
    generators = std::max(generators, static_cast<double>(report.facets));
  }

  void compare(const Candidate& reference) {
    if (!now || !reference.now) return;
    double most = 0, size = 0;
    for (std::size_t j = 0; j < v.size(); ++j) {
      most = std::max(most, std::fabs(v[j] - reference.v[j]));
      size = std::max(size, std::fabs(reference.v[j]));
    }
    difference.push_back(size > 0 ? most / size : 0);
  }
};

scenes::Problem copy_of(const scenes::Scene& scene) {
  mlcp_problem* copy = nullptr;
  scenes::check(mlcp_problem_clone(scene.problem(), &copy));
  return scenes::Problem(copy);
}

double median(std::vector<double> values) {
  if (values.empty()) return NAN;
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

double mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return values.empty() ? NAN : sum / static_cast<double>(values.size());
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc < 3 || argc > 5) {
    std::fprintf(stderr, "usage: friction_table SCENE SIZE [STEPS [SECONDS]]\n");
    return 3;
  }
  const int size = std::atoi(argv[2]), steps = argc > 3 ? std::atoi(argv[3]) : 50;
  const double seconds = argc > 4 ? std::atof(argv[4]) : 1;
  if (size < 1 || steps < 2 || !(seconds > 0)) {
    std::fprintf(stderr, "friction_table: SIZE, STEPS and SECONDS are positive, STEPS at least 2\n");
    return 3;
  }
  const auto scene = scenes::make_scene(argv[1], size);
  std::vector<Candidate> candidates;
  for (const Law& law : laws) candidates.emplace_back(law, seconds);
  std::int32_t contacts = 0;
  for (int step = 0; step < steps; ++step) {
    scene->prepare(scenes::default_step);
    const scenes::Problem problem = copy_of(*scene);
    contacts = std::max(contacts, mlcp_problem_contact_count(problem.get()));
    for (Candidate& candidate : candidates) candidate.solve(problem);
    for (Candidate& candidate : candidates) candidate.compare(candidates.front());
    scene->finish();
  }
  std::printf("%s, %d: up to %d contacts, %d steps\n%-20s %8s %10s %8s %8s %11s %11s\n", argv[1], size, contacts, steps, "law", "solved",
              "median ms", "solves", "facets", "cone error", "difference");
  for (const Candidate& c : candidates)
    std::printf("%-20s %4d/%-4d %9.3f %8.1f %8.0f %11.1e %11.1e\n", c.law.name, c.solved, steps, median(c.milliseconds), c.solves / steps,
                c.generators, c.cone_error, mean(c.difference));
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "friction_table: %s\n", error.what());
  return 4;
}
