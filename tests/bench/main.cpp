/// The figures of the factor and of the simplex: how much a row toggle saves against a factorization, and how both grow. Each line
/// gives the ratio of two medians taken in turns, and beside it the error. Usage: mlcp_figures [toggle|simplex|chain]
#include <cmath>
#include <cstdio>
#include <cstring>

#include "factor_bench.h"
#include "timing.h"

namespace bench {
namespace {

/// One removal and one insertion of the same row, for active rows spread over the pile, against factorizing afresh.
void toggle() {
  std::printf("one row toggle against one factorization, sphere pile\n");
  std::printf("%10s %10s %14s %14s %8s %12s\n", "contacts", "active", "toggle [us]", "factor [us]", "ratio", "drift");
  for (const int contacts : {1000, 3000}) {
    SolvedBasis pile(scenes::pile(contacts), true);
    const mlcp::Island& island = pile.largest();
    std::vector<std::int32_t> active;
    for (std::int32_t o = island.first_row; o < island.last_row; ++o)
      if (pile.basis.set.state[o] == mlcp::ActiveSet::active) active.push_back(o);
    constexpr int toggles = 200;
    const std::size_t stride = std::max<std::size_t>(1, active.size() / toggles);
    const Pair t = alternate(
        15,
        [&] {
          for (int k = 0; k < toggles; ++k) {
            const std::int32_t p = pile.basis.position(active[k * stride % active.size()]);
            pile.basis.factor.remove(p, pile.counts.work);
            pile.basis.factor.insert(p, pile.counts.work);
          }
        },
        [&] { pile.basis.factor.factorize(island, pile.basis.set.wanted.data(), mlcp::lost_pivot, pile.counts.work); });
    for (int k = 0; k < toggles; ++k) {  // the last thing that alternate did was to factorize
      const std::int32_t p = pile.basis.position(active[k * stride % active.size()]);
      pile.basis.factor.remove(p, pile.counts.work);
      pile.basis.factor.insert(p, pile.counts.work);
    }
    const double one = t.a / (2 * toggles);
    std::printf("%10d %10zu %14.2f %14.1f %8.0f %12.1e\n", contacts, active.size(), one * 1e6, t.b * 1e6, t.b / one, pile.drift(island));
  }
}

mlcp_report solve(const scenes::Problem& problem, mlcp_solver* solver, mlcp_refactorize refactorize) {
  mlcp_settings settings;
  mlcp_settings_init(&settings, sizeof settings);
  settings.method = MLCP_METHOD_SIMPLEX;
  settings.refactorize = refactorize;
  settings.warm_start = 0;
  mlcp_solver_set_settings(solver, &settings);
  mlcp_report report;
  mlcp_report_init(&report, sizeof report);
  mlcp_solve(solver, problem.get(), nullptr, nullptr, &report);
  return report;
}

/// The paper's claim: the incremental decomposition against a factorization at every pivot, ordering and symbolic factor the same.
void simplex() {
  std::printf("whole simplex solve: row toggles against a factorization at every pivot, sphere pile\n");
  std::printf("%10s %8s %12s %12s %8s %12s %12s\n", "contacts", "pivots", "toggles [s]", "afresh [s]", "ratio", "error", "error afresh");
  for (const int contacts : {1000, 3000}) {
    const scenes::Problem problem = scenes::pile(contacts);
    mlcp_solver* solver = nullptr;
    mlcp_solver_create(nullptr, nullptr, &solver);
    mlcp_analyze(solver, problem.get(), nullptr);
    mlcp_report updates{}, afresh{};
    const Pair t = alternate(
        contacts > 2000 ? 5 : 15, [&] { updates = solve(problem, solver, MLCP_REFACTORIZE_WHEN_NEEDED); },
        [&] { afresh = solve(problem, solver, MLCP_REFACTORIZE_ALWAYS); });
    std::printf("%10d %8lld %12.4f %12.4f %8.1f %12.1e %12.1e\n", contacts, static_cast<long long>(updates.pivots), t.a, t.b, t.b / t.a,
                updates.largest_error, afresh.largest_error);
    mlcp_solver_destroy(solver);
  }
}

/// Seconds for one factorization of an acyclic chain, and for one toggle of a contact of the same chain with one at every link.
void chain() {
  std::printf("chain of links: factorization, and one toggle with a contact at every link\n");
  std::printf("%8s %14s %10s %12s %14s %14s %12s\n", "links", "factor [ms]", "exponent", "toggle [us]", "times 10^3's", "path columns", "4 log2(n)");
  double first_toggle = 0, before = 0;
  for (const int links : {1000, 10000, 100000}) {
    SolvedBasis acyclic(scenes::chain(links, false), false);
    const mlcp::Island& island = acyclic.largest();
    const auto factorize = [&] { acyclic.basis.factor.factorize(island, acyclic.basis.set.wanted.data(), mlcp::lost_pivot, acyclic.counts.work); };
    const double factor = alternate(links > 50000 ? 7 : 21, factorize, [] {}).a;

    SolvedBasis chain(scenes::chain(links, true), false);
    std::vector<std::int32_t> contacts;  // unilateral rows that are in, spread over the chain
    const mlcp::Island& touched = chain.largest();
    for (std::int32_t o = touched.first_row; o < touched.last_row; ++o)
      if (chain.basis.values.lo[o] == 0 && chain.basis.set.state[o] == mlcp::ActiveSet::active) contacts.push_back(o);
    constexpr int toggles = 500;
    std::int64_t path = 0;
    for (int k = 0; k < toggles; ++k)
      path = std::max(path, chain.basis.factor.path_columns(chain.basis.position(contacts[k * (contacts.size() - 1) / toggles])));
    const double one = alternate(15, [&] {
                         for (int k = 0; k < toggles; ++k) {
                           const std::int32_t p = chain.basis.position(contacts[k * (contacts.size() - 1) / toggles]);
                           chain.basis.factor.remove(p, chain.counts.work);
                           chain.basis.factor.insert(p, chain.counts.work);
                         }
                       }, [] {}).a / (2 * toggles);
    if (first_toggle == 0) first_toggle = one;
    std::printf("%8d %14.3f %10.2f %12.3f %14.2f %14lld %12.1f\n", links, factor * 1e3,
                before > 0 ? std::log10(factor / before) : 0.0, one * 1e6, one / first_toggle, static_cast<long long>(path),
                4 * std::log2(links));
    before = factor;
  }
}

}  // namespace
}  // namespace bench

int main(int count, char** arguments) {
  const char* which = count > 1 ? arguments[1] : "";
  const bool all = count < 2;
  if (all || !std::strcmp(which, "toggle")) bench::toggle();
  if (all || !std::strcmp(which, "simplex")) bench::simplex();
  if (all || !std::strcmp(which, "chain")) bench::chain();
  return 0;
}
