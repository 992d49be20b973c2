#include "dense_stage.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "analyze/crowding.h"
#include "factorize/small_ldl.h"

namespace mlcp {
namespace {

/// What the dense way is for. Beyond, sparse factors touch less, and an order that was found once is worth keeping.
constexpr std::int32_t small = 96;
/// Up to here it is for islands with so many entries that a sparse factor would fill in anyway,
constexpr std::int32_t medium = 200;
constexpr double hardly_sparse = 0.1;
/// and for so many rows on up to so many velocities.
constexpr std::int32_t many_velocities = 400;
/// For so many rows on none, whose A is there already, if few of them are active.
constexpr std::int32_t many_rows = 400;
/// Crowded ones of up to so many velocities are for interior points, whose steps cost as much as the velocities, not the rows.
constexpr std::int32_t crowded_velocities = medium;
/// Bodies that no row touches are solved one by one.
constexpr std::int32_t largest_alone = 12;
/// Errors above this are refined, and left to the sparse way if that does not help.
constexpr double refined = 1e-13;
/// Rows of bodies that stand on each other in more points than they need are off by so much whichever of them carry the load, the sparse way too. Of the tolerance, for
/// smaller ones.
constexpr double nearly_refined = 4e-13, nearly_refined_part = 1e-3;
/// A momentum error up to this is rounding.
constexpr double settled = 2e-15;
constexpr int most_refinements = 3;
/// Of the error before: less of it has to be left, or there is nothing to be had by refinement.
constexpr double worth_it = 0.5;
/// Of the tolerance: rows of crowded islands may contradict each other by that much, as in Newton::finish.
constexpr double forgiven_part = 0.1;
/// Of the terms of a momentum: a thousandth of a rounding.
constexpr double lost = 2.5e-19;
/// A velocity with so many times the momentum of an impulse, or less, has no other cause.
constexpr double brought_about = 4;
/// |w| up to this, relative to the scale of its error: the row holds.
constexpr double holds = 1e-9;
/// Of what counts as zero: well below, so that a slack which is just above it by one sum is so by another.
constexpr double below = 0.1;

}  // namespace

/// Entries of M, J and (where there are rows alone) Σ that component c has, as a part of those that it could have.
double DenseStage::density(const Problem& problem, std::int32_t c) const {
  const SparseView mass = problem.mass_view(), jacobian = problem.jacobian_view(), sigma = problem.compliance_view();
  const auto count = [](const SparseView& a, const std::int32_t* columns, std::int32_t number) {
    double sum = 0;
    for (std::int32_t i = 0; i < number; ++i) sum += a.pointers[columns[i] + 1] - a.pointers[columns[i]];
    return sum;
  };
  const std::int32_t *velocity = components.velocities.data() + components.velocity_pointers[c], *row = components.rows.data() + components.row_pointers[c];
  const double n = components.velocity_count(c), m = components.row_count(c);
  return n > 0 ? (count(mass, velocity, components.velocity_count(c)) / 2 + count(jacobian, row, components.row_count(c))) / (n * n / 2 + n * m)
               : count(sigma, row, components.row_count(c)) / (m * m);
}

bool DenseStage::couples_rows(const Problem& problem, std::int32_t c) const {
  const SparseView sigma = problem.compliance_view();
  for (const std::int32_t i : components.rows_of(c))
    for (std::int32_t t = sigma.pointers[i]; t < sigma.pointers[i + 1]; ++t)
      if (sigma.indices[t] != i) return true;
  return false;
}

bool DenseStage::takes(const SolveInput& input) {
  const Settings& s = input.settings;
  if (s.method != MLCP_METHOD_AUTO || s.trace || s.impulses != MLCP_IMPULSES_ANY || s.max_iterations > 0 || s.max_work > 0) return false;
  knew_ = !components.update(input.problem, input.enabled) && looked_;
  prepared_ &= knew_;
  if (knew_) return fits_;
  looked_ = false;  // until all of what follows is there: memory may run out
  fits_ = true;
  crowded_ = false;
  interior_.assign(components.count(), 0);
  alone_.resize(components.count());
  for (std::int32_t c = 0; c < components.count(); ++c) alone_[c] = is_alone(c);
  for (std::int32_t c = 0; c < components.count() && fits_; ++c) {
    const std::int32_t velocities = components.velocity_count(c), rows = components.row_count(c), size = std::max(velocities, rows);
    fits_ = size <= small || (velocities == 0 && rows <= many_rows) || (rows <= medium && velocities <= many_velocities) ||
            (size <= medium && density(input.problem, c) >= hardly_sparse);
    if (fits_ || velocities > crowded_velocities || !too_many(rows, velocities) || couples_rows(input.problem, c)) continue;
    interior_[c] = 1;
    fits_ = crowded_ = true;
  }
  looked_ = true;
  return fits_;
}

bool DenseStage::solve(const SolveInput& input, const Mask* start, Watch& watch, Crew& crew, Measure& measure, Result& result, Errors& errors,
                       Counts& counts) {
  const Problem& problem = input.problem;
  const std::int32_t count = components.count();
  if (!prepared_) {
    left_out_.resize(count);
    for (std::int32_t c = 0; c < count; ++c) left_out_[c] = interior_[c] | alone_[c];
    response_.prepare(problem, components, left_out_.span());
    if (crowded_) normal_.prepare(problem, components, interior_.span());
  }
  prepared_ = true;
  counts_.assign(count, Counts{});
  released_.assign(count, 0);
  solved_.resize(count);
  parts_.resize(count);
  result.gamma.assign(problem.m(), 0.0);
  result.mask.state.assign(problem.m(), MLCP_ROW_DISABLED);
  const Errors free = measure.begin(problem, input.enabled, components.free_velocities.span(), result.v.span());
  const auto cost = [&](std::int32_t c) { return 10 + std::int64_t{components.velocity_count(c)} * (components.velocity_count(c) + components.row_count(c)); };
  const auto look = [&](std::int32_t c) {
    parts_[c] = measure.part(problem, components.velocities_of(c), components.rows_of(c), result.v.span(), result.gamma.span());
  };
  crew.run(count, tasks_, false, cost, [&](std::int32_t c) {
    const mlcp_progress begins{sizeof(mlcp_progress), 0, 0, 0, c, count, 0};
    solved_[c] = watch.check(begins) == MLCP_SOLVED && solve_island(input, start, watch, c, result);
    if (solved_[c]) look(c);  // while its numbers are at hand
  });
  for (std::int32_t c = 0; c < count; ++c) {
    if (!solved_[c]) return false;
    counts += counts_[c];
  }
  double before = infinity;
  for (int round = 0;; ++round) {
    errors = measure.end(problem, input.enabled, result.gamma.span(), input.contact_of_row, free, parts_.span());
    if (errors.largest() <= refined) break;
    // a row at rest has the error 1 until it is exactly at rest, which takes two rounds
    const double enough = worth_it * std::exchange(before, errors.largest());
    const bool helps = round < 2 || errors.largest() <= enough || std::ranges::find(released_, 1) != released_.end();
    released_.assign(count, 0);
    if (round == most_refinements || !helps) {
      for (std::int32_t c = 0; c < count; ++c)
        if (!right_enough(c, input.settings)) return false;
      if (errors.largest() <= forgiven_part * input.settings.tolerance) break;
      return false;
    }
    crew.run(count, tasks_, false, cost, [&](std::int32_t c) {
      solved_[c] = !refine(input, c, measure, round > 0, result);
      if (solved_[c]) return;
      stop(problem, c, measure, result);
      look(c);
    });
    for (std::int32_t c = 0; c < count; ++c) counts.refinements += !solved_[c];
  }
  for (std::int32_t c = 0; c < count; ++c) mark_redundant(c, measure, result);
  return true;
}

/// Though refinement has not made it exact.
bool DenseStage::right_enough(std::int32_t c, const Settings& settings) const {
  const double enough = interior_[c] ? forgiven_part * settings.tolerance : std::min(nearly_refined, nearly_refined_part * settings.tolerance);
  return parts_[c].complete && parts_[c].errors.largest() <= std::max(refined, enough);
}

bool DenseStage::solve_crowded(const SolveInput& input, const Mask* start, Watch& watch, std::int32_t c, Result& result) {
  if (!normal_.load(input.problem, c)) return false;
  NormalIsland& island = normal_.island(c);
  if (!DenseInteriorPoint(island, zero_slack(input.settings), watch, counts_[c]).solve(input.problem, start)) return false;
  for (std::int32_t p = 0; p < island.n; ++p) result.v[island.velocity(p)] = island.v[p];
  for (std::int32_t i = 0; i < island.m; ++i) {
    result.gamma[island.row[i]] = island.gamma[i];
    result.mask.state[island.row[i]] = row_state(island.state[i]);
  }
  return true;
}

bool DenseStage::is_alone(std::int32_t c) const {
  const std::int32_t d = components.velocity_count(c);
  if (components.row_count(c) > 0 || d > largest_alone) return false;
  const std::span<const std::int32_t> velocity = components.velocities_of(c);
  return velocity.back() - velocity.front() == d - 1;
}

/// v = M⁻¹ k
bool DenseStage::solve_alone(const Problem& problem, std::int32_t c, Result& result) {
  const std::int32_t first = components.velocities_of(c).front(), d = components.velocity_count(c);
  const SparseView mass = problem.mass_view();
  double block[largest_alone * largest_alone];
  std::fill_n(block, d * d, 0.0);
  for (std::int32_t p = 0; p < d; ++p)
    for (std::int32_t t = mass.pointers[first + p]; t < mass.pointers[first + p + 1]; ++t) block[d * p + (mass.indices[t] - first)] = mass.values[t];
  if (!small_factor(d, block)) return false;
  double* const v = result.v.data() + first;
  std::copy_n(problem.momentum.data() + first, d, v);
  small_solve(d, block, v);
  ++counts_[c].factorizations;
  return true;
}

bool DenseStage::solve_island(const SolveInput& input, const Mask* start, Watch& watch, std::int32_t c, Result& result) {
  if (alone_[c]) return solve_alone(input.problem, c, result);
  if (interior_[c]) return solve_crowded(input, start, watch, c, result);
  if (!response_.compute(input.problem, c)) return false;
  if (!newton(input, c, zero_slack(input.settings)).solve(input.problem, start)) return false;
  take_answer(response_.island(c), result);
  return true;
}

/// Steps of a friction iteration go on from loads as they are shared.
DenseNewton DenseStage::newton(const SolveInput& input, std::int32_t c, double zero) {
  return {response_.island(c), zero, !input.follows_shifts, counts_[c]};
}

void DenseStage::take_answer(const DenseIsland& island, Result& result) {
  DenseResponse::velocities(island);
  for (std::int32_t p = 0; p < island.n; ++p) result.v[island.velocity(p)] = island.x[p];
  for (std::int32_t i = 0; i < island.m; ++i) {
    result.gamma[island.row[i]] = island.gamma[i];
    result.mask.state[island.row[i]] = row_state(island.state[i]);
  }
}

/// A correction that would push an active row's impulse beyond its bound: the row rests there, and the island is solved again without it. Cut off at the bound,
/// the impulse would not go with the velocities any more.      returns whether there was one; where that leads nowhere the answer stays as it was.
bool DenseStage::release(const SolveInput& input, std::int32_t c, Result& result) {
  DenseIsland& s = response_.island(c);
  bool any = false;
  for (std::int32_t t = 0; t < *s.members; ++t) {
    const std::int32_t i = s.member[t];
    const double gamma = result.gamma[s.row[i]] + s.x_rows()[t];
    if (gamma >= s.lo[i] && gamma <= s.hi[i]) continue;
    const bool low = gamma < s.lo[i];
    s.state[i] = low ? ActiveSet::at_lower : ActiveSet::at_upper;
    s.gamma[i] = low ? s.lo[i] : s.hi[i];
    any = true;
  }
  if (any && newton(input, c, zero_slack(input.settings)).solve_on()) take_answer(s, result);
  return any;
}

/// Rows at rest that are off, though within what counted as zero for the method: it goes on from them.
/// returns whether there was one; where that leads nowhere the answer stays as it was.
bool DenseStage::take_in(const SolveInput& input, std::int32_t c, const Measure& measure, Result& result) {
  DenseIsland& s = response_.island(c);
  bool any = false;
  for (std::int32_t i = 0; i < s.m && !any; ++i)
    any = s.state[i] != ActiveSet::active && s.lo[i] < s.hi[i] && s.response(i, i) > 0 && measure.error[s.row[i]] > refined;
  if (any && newton(input, c, below * zero_slack(input.settings)).solve_on()) take_answer(s, result);
  return any;
}

/// One step against the residuals that the measurement has found. Once momentum is rounding its residual is left out, as in Refinement: then the
/// correction is as small as the rows' own residuals.  false: there is nothing to do.
bool DenseStage::refine(const SolveInput& input, std::int32_t c, const Measure& measure, bool again, Result& result) {
  if (alone_[c]) return false;
  double momentum = 0, rows = 0;
  for (const std::int32_t j : components.velocities_of(c)) momentum = std::max(momentum, measure.velocity_error(j));
  for (const std::int32_t i : components.rows_of(c)) rows = std::max(rows, measure.error[i]);
  if (std::max(momentum, rows) <= refined) return false;
  const bool rows_alone = momentum <= (again ? refined : settled);
  if (interior_[c])
    correct_crowded(c, measure, rows_alone, result);
  else if (again && take_in(input, c, measure, result))
    released_[c] = 1;
  else
    correct(input, c, measure, rows_alone, result);
  return true;
}

void DenseStage::correct(const SolveInput& input, std::int32_t c, const Measure& measure, bool rows_alone, Result& result) {
  DenseIsland& s = response_.island(c);
  for (std::int32_t p = 0; p < s.n; ++p) s.x[p] = rows_alone ? 0 : -measure.momentum_residual(s.velocity(p));
  for (std::int32_t t = 0; t < *s.members; ++t) s.x_rows()[t] = -measure.w[s.row[s.member[t]]];
  DenseResponse::correct(s);
  released_[c] = release(input, c, result);
  if (released_[c]) return;
  for (std::int32_t p = 0; p < s.n; ++p) result.v[s.velocity(p)] += s.x[p];
  for (std::int32_t t = 0; t < *s.members; ++t) {
    const std::int32_t i = s.member[t];
    double& gamma = result.gamma[s.row[i]];
    gamma = std::clamp(gamma + s.x_rows()[t], s.lo[i], s.hi[i]);  // what is within rounding of a bound does not leave it
  }
}

void DenseStage::correct_crowded(std::int32_t c, const Measure& measure, bool rows_alone, Result& result) {
  NormalIsland& s = normal_.island(c);
  for (std::int32_t p = 0; p < s.n; ++p) s.momentum[p] = rows_alone ? 0 : -measure.momentum_residual(s.velocity(p));
  for (std::int32_t i = 0; i < s.padded_rows(); ++i) s.dgamma[i] = i < s.m ? -measure.w[s.row[i]] : 0;
  NormalEquations::solve(s);
  for (std::int32_t p = 0; p < s.n; ++p) result.v[s.velocity(p)] += s.step[p];
  for (std::int32_t i = 0; i < s.m; ++i) {
    double& gamma = result.gamma[s.row[i]];
    gamma = std::clamp(gamma + s.dgamma[i], s.lo[i], s.hi[i]);
  }
}

/// As Refinement::stop: a velocity far below the rounding of its momentum is 0. A row without other terms is off by its whole size, however small steps make
/// that, and each of them moves the velocities of all rows a little.
/// So is an impulse that no slack feels, and velocities that it alone has brought about: steps would make both smaller for ever, not 0.
void DenseStage::stop(const Problem& problem, std::int32_t c, const Measure& measure, Result& result) {
  const SparseView jacobian = problem.jacobian_view();
  for (const std::int32_t i : components.rows_of(c)) {
    const double gamma = std::abs(result.gamma[i]);
    if (gamma == 0 || gamma * measure.a[i] > lost * measure.scale[i] || problem.lo[i] > 0 || problem.hi[i] < 0) continue;
    result.gamma[i] = 0;
    for (std::int32_t t = jacobian.pointers[i]; t < jacobian.pointers[i + 1]; ++t) {
      const std::int32_t j = jacobian.indices[t];
      if (!problem.prescribed(j) && std::abs(measure.mass(j) * result.v[j]) <= brought_about * std::abs(jacobian.values[t] * gamma)) result.v[j] = 0;
    }
  }
  for (const std::int32_t j : components.velocities_of(c)) {
    if (std::abs(measure.mass(j) * result.v[j]) <= lost * measure.momentum_scale(j)) result.v[j] = 0;
  }
}

/// As mark_redundant: rows that hold, rest, and have a Schur pivot of at most dependent_pivot · a.
void DenseStage::mark_redundant(std::int32_t c, const Measure& measure, Result& result) {
  if (left_out_[c]) return;
  const DenseIsland& s = response_.island(c);
  for (std::int32_t i = 0; i < s.m; ++i) {
    const std::int32_t row = s.row[i];
    if (s.state[i] == ActiveSet::active) continue;
    if (s.lo[i] == s.hi[i] || !(std::abs(measure.w[row]) <= holds * measure.scale[row])) continue;
    result.redundant[row] = DenseResponse::schur(s, i) <= dependent_pivot * measure.a[row];
  }
}

}  // namespace mlcp
