// mlcp_overshoot: how far solves run past their time limit, as a table: processor time of the solving thread from the limit on, the worst of a few
// repeats, beside the whole solve and one factorization of all islands. The promise is 10 ms and one factorization.
#include <pthread.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "hard/cases/sketch.h"
#include "scenes/scenes.h"

namespace {

constexpr double limits[] = {1e-4, 1e-3, 5e-3, 2e-2};  // s
constexpr double longest = 2;                          // s, of the solve without one of them
constexpr int repeats = 5;

struct Candidate {
  std::string name;
  hard::Problem problem;
};

/// The step after so many, with Coulomb's law on circular cones.
hard::Problem with_friction(const char* scene, std::int32_t size, int steps) {
  const auto moving = scenes::make_scene(scene, size);
  for (int step = 0; step < steps; ++step) moving->step(scenes::default_step);
  moving->prepare(scenes::default_step);
  mlcp_problem* copy = nullptr;
  handles::check(mlcp_problem_clone(moving->problem(), &copy));
  hard::Problem problem(copy);
  const std::int32_t contacts = mlcp_problem_contact_count(copy);
  const std::vector<mlcp_friction> model(static_cast<std::size_t>(contacts), MLCP_FRICTION_COULOMB);
  const std::vector<std::int32_t> facets(static_cast<std::size_t>(contacts), 0);
  handles::check(mlcp_problem_contacts_set_friction(copy, 0, contacts, model.data(), nullptr, nullptr, facets.data()), problem);
  return problem;
}

std::vector<Candidate> candidates() {
  std::vector<Candidate> all;
  all.push_back({"pile, 3000 contacts", scenes::pile(3000)});
  all.push_back({"wall of 20 × 20 bricks", scenes::wall(20, 20)});
  all.push_back({"wall of 3 × 4, contacts 50 times", hard::with_rows(scenes::wall(3, 4), {1}, 50)});
  all.push_back({"chain of 10 000 links", scenes::chain(10000, true, 1e4)});
  all.push_back({"wall of boxes hit by a ball, circular cones", with_friction("wall_of_boxes", 4, 30)});
  all.push_back({"cascade of 60 bodies, circular cones", with_friction("cascade", 60, 60)});
  return all;
}

double seconds_of(clockid_t clock) {
  timespec now;
  clock_gettime(clock, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

struct Timed {
  double seconds, past;  ///< of the processor: in all, after the limit
  mlcp_report report;
};

/// By a new solver. watched: a second thread reads this one's processor time at the limit, which stands while others have the processor.
Timed solve(const hard::Problem& problem, const mlcp_settings& settings, bool watched) {
  const handles::Solver solver = handles::make_solver(&settings);
  Timed timed;
  mlcp_report_init(&timed.report, sizeof timed.report);
  clockid_t clock;
  pthread_getcpuclockid(pthread_self(), &clock);
  double at_limit = 0;
  std::thread watch;
  if (watched)
    watch = std::thread([&] {
      std::this_thread::sleep_for(std::chrono::duration<double>(settings.max_seconds));
      at_limit = seconds_of(clock);
    });
  const double start = seconds_of(clock);
  handles::check(mlcp_solve(solver.get(), problem.get(), nullptr, nullptr, &timed.report), solver);
  const double end = seconds_of(clock);
  if (watched) watch.join();
  timed.seconds = end - start;
  timed.past = std::max(0.0, end - at_limit);
  return timed;
}

/// Islands count their factorizations apart.
double factorization(const mlcp_report& report) {
  return report.factorizations ? report.seconds_factorize / static_cast<double>(report.factorizations) * report.islands : 0;
}

/// Prints a line. returns the worst overshoot less one factorization.
double measure(const Candidate& candidate, mlcp_method method) {
  mlcp_settings settings;
  mlcp_settings_init(&settings, sizeof settings);
  settings.method = method;
  settings.max_seconds = longest;
  const Timed whole = solve(candidate.problem, settings, false);
  double one = factorization(whole.report);
  settings.max_iterations = 3;
  for (int k = 0; k < repeats; ++k) one = std::min(one, factorization(solve(candidate.problem, settings, false).report));
  settings.max_iterations = 0;
  std::printf("| %s | %d | %s | %s%.1f | %.2f |", candidate.name.c_str(), mlcp_problem_row_count(candidate.problem.get()), mlcp_method_text(method),
              whole.report.outcome == MLCP_TIME_LIMIT ? "> " : "", 1e3 * whole.seconds, 1e3 * one);
  double worst = 0;
  for (const double limit : limits) {
    settings.max_seconds = limit;
    double most = 0;
    int stopped = 0;
    for (int k = 0; k < repeats; ++k) {
      const Timed timed = solve(candidate.problem, settings, true);
      if (timed.report.outcome != MLCP_TIME_LIMIT) continue;
      ++stopped;
      most = std::max(most, timed.past);
    }
    worst = std::max(worst, most - one);
    stopped ? std::printf(" %.2f |", 1e3 * most) : std::printf(" ended before |");
  }
  std::printf("\n");
  return worst;
}

}  // namespace

int main() try {
  std::printf("| problem | rows | method | whole solve, ms | one factorization, ms |");
  for (const double limit : limits) std::printf(" past %g ms |", 1e3 * limit);
  std::printf("\n|---|---|---|---|---|---|---|---|---|\n");
  double worst = 0;
  for (const Candidate& candidate : candidates())
    for (const mlcp_method method : {MLCP_METHOD_AUTO, MLCP_METHOD_SIMPLEX}) worst = std::max(worst, measure(candidate, method));
  std::printf("\nworst overshoot beyond one factorization: %.2f ms\n", 1e3 * worst);
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
