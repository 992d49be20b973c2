// The very same arrays through ODE's dSolveLCP, as DART packages it, and through mlcp: a table of what either answers and how far off it is.
// Exit code 1 if mlcp fails, or differs where dSolveLCP is right.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <exception>
#include <random>
#include <vector>

#include <dart/external/odelcpsolver/lcp.h>

#include "cases.h"
#include "swap.h"

namespace {

using Clock = std::chrono::steady_clock;
double since(Clock::time_point start) { return std::chrono::duration<double, std::milli>(Clock::now() - start).count(); }

constexpr double right = 1e-9;  // an answer with errors below is a right one

struct Answer {
  bool claims;
  double milliseconds;
  std::vector<double> x, w;
};

Answer by_ode(Case arrays) {  // a copy: dSolveLCP overwrites them
  Answer answer{false, 0, std::vector<double>(arrays.b.size()), std::vector<double>(arrays.b.size())};
  const Clock::time_point start = Clock::now();
  answer.claims = dart::external::ode::dSolveLCP(arrays.n, arrays.A.data(), answer.x.data(), arrays.b.data(), answer.w.data(), arrays.nub,
                                                 arrays.lo.data(), arrays.hi.data(), arrays.findex.data());
  answer.milliseconds = since(start);
  return answer;
}

/// What helps it over ties and dependent rows: b larger by up to 1e-14 of its largest entry, at random, and A's diagonal by 1e-10, the CFM of engines.
Case perturbed(Case arrays) {
  std::minstd_rand random(1);
  std::uniform_real_distribution<double> part(0, 1);
  double largest = 0;
  for (const double b : arrays.b) largest = std::max(largest, std::abs(b));
  for (double& b : arrays.b) b += 1e-14 * largest * part(random);
  const std::size_t n = arrays.b.size(), stride = arrays.A.size() / std::max<std::size_t>(n, 1);
  for (std::size_t i = 0; i < n; ++i) arrays.A[i * stride + i] *= 1 + 1e-10;
  return arrays;
}

Answer by_mlcp(const Case& arrays) {
  Answer answer{false, 0, std::vector<double>(arrays.b.size()), std::vector<double>(arrays.b.size())};
  Swap swap;
  const Clock::time_point start = Clock::now();
  answer.claims = swap.solve(arrays.n, arrays.A.data(), answer.x.data(), arrays.b.data(), answer.w.data(), arrays.nub, arrays.lo.data(),
                             arrays.hi.data(), arrays.findex.data());
  answer.milliseconds = since(start);
  return answer;
}

/// Recomputed from the arrays and x alone, in extended precision; w is replaced by A x − b. bounds: of friction from the final normal impulses.
/// max |median(w, Aᵢᵢ(x − lo), Aᵢᵢ(x − hi))| over the largest Σ|Aᵢⱼ||xⱼ| + |bᵢ|; infinite for what is not a number.
double error(const Case& arrays, Answer& answer) {
  const std::size_t n = arrays.b.size(), stride = arrays.A.size() / std::max<std::size_t>(n, 1);
  long double worst = 0, scale = 0;
  for (std::size_t i = 0; i < n; ++i) {
    long double w = -arrays.b[i], size = std::abs(arrays.b[i]);
    for (std::size_t j = 0; j < n; ++j) {
      const long double term = static_cast<long double>(arrays.A[i * stride + j]) * answer.x[j];
      w += term;
      size += std::abs(term);
    }
    const int normal = arrays.findex[i];
    const double factor = normal < 0 ? 1 : std::max(0.0, answer.x[static_cast<std::size_t>(normal)]);
    const long double a = arrays.A[i * stride + i];
    const long double above = std::isinf(arrays.lo[i]) ? INFINITY : a * (answer.x[i] - factor * arrays.lo[i]);
    const long double below = std::isinf(arrays.hi[i]) ? -INFINITY : a * (answer.x[i] - factor * arrays.hi[i]);
    worst = std::max(worst, std::abs(std::clamp(w, below, above)));
    if (!std::isfinite(answer.x[i])) return INFINITY;
    scale = std::max(scale, size);
    answer.w[i] = static_cast<double>(w);
  }
  return static_cast<double>(scale > 0 ? worst / scale : worst);
}

const char* word(const Answer& answer) { return answer.claims ? "solved" : "failed"; }

double difference(const std::vector<double>& a, const std::vector<double>& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
  return largest;
}

}  // namespace

int main() try {
  bool good = true;
  std::printf("| %-32s | rows | dSolveLCP | error | ms | perturbed | error | mlcp   | error | ms | slacks apart, m/s |\n", "case");
  std::printf("|---|---|---|---|---|---|---|---|---|---|---|\n");
  for (const Case& arrays : all_cases()) {
    Answer ode = by_ode(arrays), helped = by_ode(perturbed(arrays)), ours = by_mlcp(arrays);
    const double ode_error = error(arrays, ode), our_error = error(arrays, ours), apart = difference(ode.w, ours.w);
    std::printf("| %-32s | %4d | %-9s | %5.0e | %.2g | %-9s | %5.0e | %-6s | %5.0e | %.2g | %17.0e |\n", arrays.name.c_str(), arrays.n,
                word(ode), ode_error, ode.milliseconds, word(helped), error(arrays, helped), word(ours), our_error, ours.milliseconds, apart);
    good = good && ours.claims && our_error <= right;
    // w is unique for a symmetric positive semidefinite A without findex
    const bool coupled = std::any_of(arrays.findex.begin(), arrays.findex.end(), [](int i) { return i >= 0; });
    if (!coupled && ode_error <= right) good = good && apart <= 1e-6;
  }
  if (!good) std::fprintf(stderr, "mlcp failed, or differs where dSolveLCP is right\n");
  return good ? 0 : 1;
} catch (const std::exception& failure) {
  std::fprintf(stderr, "swap: %s\n", failure.what());
  return 1;
}
