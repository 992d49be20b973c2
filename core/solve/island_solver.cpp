#include "solve/island_solver.h"

#include "solve/gauss_seidel.h"
#include "solve/newton.h"
#include "solve/proximal_simplex.h"
#include "solve/redundancy.h"
#include "solve/simplex.h"

namespace mlcp {
namespace {

/// Islands of so few rows are pivoted: each step is a solve that Newton needs too.
constexpr std::int32_t few_rows = 2;
/// Of crowded islands of so many rows a change takes hundreds of pivots, where the steps of interior points are as few as ever.
constexpr std::int32_t many_rows = 300;
/// A guess by Gauss-Seidel pays where a row's response is about as short as the row: bodies, not robots.
constexpr std::int64_t short_response = 24;

/// One island on its way through the methods.
class Run {
 public:
  Run(const SolveInput& input, Basis& basis, CertificateCheck& check, Watch& watch, std::int32_t index, IslandEnd& end)
      : input_(input), basis_(basis), check_(check), island_(basis.factor.symbolic().islands[index]), index_(index), end_(end),
        rows_(island_.last_row - island_.first_row),
        limits_(watch, index, static_cast<std::int32_t>(basis.factor.symbolic().islands.size()), 50 * (static_cast<std::int64_t>(rows_) + 10)) {}

  void solve(bool warm, Array<mlcp_pivot>* trace) {
    go(warm, trace);
    end_.kept = end_.outcome == MLCP_SOLVED && !end_.crowded && end_.method != MLCP_METHOD_PGS && end_.epsilon <= sharp_epsilon && !end_.semidefinite &&
                input_.settings.impulses != MLCP_IMPULSES_LEAST_NORM && input_.settings.method != MLCP_METHOD_SIMPLEX;
  }

  /// From the factor that is there, where `before` has kept one: a few full steps, else a few pivots from the same active set, which is close.
  /// before: Basis::reload.
  void solve_again(const Mask& start, const IslandEnd& before, Array<mlcp_pivot>* trace) {
    const auto flips = ask(start, before.kept);
    if (before.kept) {
      Newton newton(basis_, limits_, end_.counts);
      end_.method = MLCP_METHOD_NEWTON;
      end_.epsilon = before.epsilon;
      end_.outcome = newton.resume(island_, flips, before.epsilon);
      end_.kept = end_.outcome == MLCP_SOLVED;
      if (end_.outcome != MLCP_ITERATION_LIMIT) return;
      limits_.restart(end_.counts);
      ask(start, false);
    }
    if (before.semidefinite || before.method == MLCP_METHOD_PGS || input_.settings.method == MLCP_METHOD_NEWTON) return solve(true, trace);
    if (island_.crowded) {
      if (rows_ < many_rows || !interior_points()) give_up();
      return;
    }
    pivot(trace);
    if (end_.outcome == MLCP_ITERATION_LIMIT) try_again(trace);
  }

 private:
  void go(bool warm, Array<mlcp_pivot>* trace) {
    const mlcp_method method = input_.settings.method;
    if (!island_.crowded && (method == MLCP_METHOD_SIMPLEX || rows_ == 0 || (method == MLCP_METHOD_AUTO && rows_ <= few_rows))) {
      pivot(trace);
      if (end_.outcome == MLCP_ITERATION_LIMIT) try_again(trace);
      return;
    }
    if (method == MLCP_METHOD_PGS && sweep()) return;
    const bool pivots_open = method == MLCP_METHOD_AUTO && !input_.follows_shifts && !island_.crowded;
    const bool improves = warm && improvable();
    if (improves) guess(true);
    if (newton(warm, {.guess = warm && !improves && guessable(), .pivots = pivots_open})) return;
    if (left_.guess) {
      go_back_to_start();
      if (newton(false, {.pivots = pivots_open})) return;
    }
    if (left_.pivots && (pivots_end(trace) || newton(warm, {}))) return;
    give_up();
    if (island_.crowded) return;
    limits_.restart(end_.counts);
    pivot(trace);
    if (end_.outcome == MLCP_ITERATION_LIMIT) try_again(trace);
  }

  /// In favour of the pivoting method; a crowded island needs another order for that.
  void give_up() {
    end_.outcome = MLCP_ITERATION_LIMIT;
    end_.gave_up = true;
    end_.crowded = island_.crowded;
  }

  /// From where full steps got to. false: no answer, or a proof that there is none; an error within the tolerance would be one, which the other ways may find.
  bool pivots_end(Array<mlcp_pivot>* trace) {
    limits_.restart(end_.counts);
    pivot(trace);
    if (end_.outcome != MLCP_ITERATION_LIMIT && end_.outcome != MLCP_INFEASIBLE) return true;
    end_.certificate_rows = 0;
    limits_.restart(end_.counts);
    return false;
  }

  bool spent() const { return input_.settings.max_iterations > 0 && end_.counts.pivots >= input_.settings.max_iterations; }

  /// From rows at rest.
  void try_again(Array<mlcp_pivot>* trace) {
    if (spent()) return;
    restart();
    pivot(trace);
    if (end_.outcome == MLCP_ITERATION_LIMIT) pivot_as_singular(trace);
  }

  /// From rows at rest: M may be singular but for rounding.
  void pivot_as_singular(Array<mlcp_pivot>* trace) {
    if (rows_ == island_.last - island_.first || spent()) return;
    restart();
    pivot_semidefinite(trace);
  }

  /// Puts impulses where `start` has them, and rows too, unless a factor is to follow them: then the changes that are left to make.
  std::span<const Flip> ask(const Mask& start, bool kept) {
    ActiveSet& set = basis_.set;
    Flip* flips = basis_.work.flips.data() + island_.first_row;
    std::size_t count = 0;
    for (std::int32_t o = island_.first_row; o < island_.last_row; ++o) {
      const std::int32_t p = basis_.position(o), i = basis_.pattern->node[p] - input_.problem.n();
      const ActiveSet::State to = set.state[o] == ActiveSet::disabled ? ActiveSet::disabled : ActiveSet::starting(input_.problem, i, &start);
      set.deferred[o] = 0;
      if (kept && to != set.state[o])
        flips[count++] = {o, to};
      else if (to != ActiveSet::active)
        basis_.rest(o, to);
      else
        set.state[o] = to;
      if (to == ActiveSet::active) set.x[p] = start.impulse.empty() ? 0 : -start.impulse[i];
    }
    return {flips, count};
  }

  void pivot(Array<mlcp_pivot>* trace) {
    Simplex simplex(input_, basis_, check_, limits_, end_.counts);
    end_.method = MLCP_METHOD_SIMPLEX;
    end_.epsilon = 0;
    end_.outcome = simplex.solve(island_, index_, trace);
    if (end_.outcome == MLCP_SOLVED && leaves_rows()) end_.outcome = MLCP_ITERATION_LIMIT;
    if (end_.outcome == MLCP_INFEASIBLE) settle(simplex);
    if (end_.outcome != MLCP_NOT_POSITIVE_DEFINITE) return;
    end_.indefinite = basis_.factor.failed_position(island_);
    if (rows_ > 0) pivot_semidefinite(trace);  // that may hold what M does not
  }

  /// Whether rows that pivots have left violated, as they could not move them, are off by more than the tolerance.
  bool leaves_rows() {
    ActiveSet& set = basis_.set;
    const auto deferred = set.deferred.span().subspan(island_.first_row, rows_), kept = basis_.work.state.span().subspan(island_.first_row, rows_);
    if (std::ranges::find(deferred, 1) == deferred.end()) return false;
    std::ranges::copy(deferred, kept.begin());
    std::ranges::fill(deferred, 0);
    slack_tolerances(island_, *basis_.pattern, basis_.values, input_.settings.tolerance, set);
    bool left = false;
    for (std::int32_t o = island_.first_row; o < island_.last_row; ++o) left |= set.violated(o);
    std::ranges::copy(kept, deferred.begin());
    slack_tolerances(island_, *basis_.pattern, basis_.values, basis_.zero(), set);
    return left;
  }

  /// The velocity of least violation beside the proof.
  void settle(auto& simplex) {
    end_.certificate_rows = simplex.certificate_rows();
    limits_.restart(end_.counts);
    simplex.settle(island_);
  }

  void pivot_semidefinite(Array<mlcp_pivot>* trace) {
    ProximalSimplex simplex(input_, basis_, check_, limits_, end_.counts);
    end_.semidefinite = true;
    end_.outcome = simplex.solve(island_, index_, trace);
    if (end_.outcome == MLCP_INFEASIBLE) settle(simplex);
    if (end_.outcome != MLCP_NOT_POSITIVE_DEFINITE) end_.indefinite = -1;
  }

  bool sweep() {
    GaussSeidel sweeps(basis_, limits_, end_.counts);
    if (!sweeps.prepare(island_)) return false;
    end_.method = MLCP_METHOD_PGS;
    end_.outcome = sweeps.solve(island_, input_.settings.tolerance);
    return true;
  }

  /// false: it gave up.
  bool newton(bool warm, Newton::Left open) {
    if (!warm) guess(false);
    Newton newton(basis_, limits_, end_.counts);
    end_.method = MLCP_METHOD_NEWTON;
    end_.outcome = newton.solve(island_, warm, open);
    left_ = newton.left();
    end_.epsilon = newton.epsilon();
    end_.semidefinite = newton.semidefinite();
    if (end_.outcome == MLCP_NOT_POSITIVE_DEFINITE) end_.indefinite = basis_.factor.failed_position(island_);
    return end_.outcome != MLCP_ITERATION_LIMIT;
  }

  /// warm: from impulses that are nearly right.
  void guess(bool warm) {
    if (!guessable()) return;
    GaussSeidel sweeps(basis_, limits_, end_.counts);
    if (sweeps.prepare(island_)) sweeps.guess(island_, warm);
  }

  /// Steps of a friction iteration go on from loads as they are shared.
  bool improvable() {
    const GaussSeidel sweeps(basis_, limits_, end_.counts);
    return !input_.follows_shifts && guessable() && sweeps.cycles_pay(island_) && !sweeps.must_depend(island_) && knows_impulses();
  }

  /// A start may be a mask of states alone.
  bool knows_impulses() const {
    for (std::int32_t o = island_.first_row; o < island_.last_row; ++o)
      if (basis_.set.state[o] == ActiveSet::active && basis_.gamma(o) != 0) return true;
    return false;
  }

  /// false: they gave up.
  bool interior_points() {
    Newton newton(basis_, limits_, end_.counts);
    end_.method = MLCP_METHOD_NEWTON;
    end_.outcome = newton.solve_by_interior_points(island_);
    end_.epsilon = newton.epsilon();
    end_.kept = end_.outcome == MLCP_SOLVED && end_.epsilon <= sharp_epsilon;
    return end_.outcome != MLCP_ITERATION_LIMIT;
  }

  bool guessable() const {
    const MassParts& parts = basis_.response.parts();
    const auto& row_pointers = basis_.pattern->row_pointers;
    const std::int64_t entries = parts.response_pointers[island_.last_row] - parts.response_pointers[island_.first_row] +
                                 (island_.last - island_.first == rows_ ? row_pointers[island_.last_row] - row_pointers[island_.first_row] : 0);
    return rows_ > few_rows && entries > 0 && entries <= short_response * rows_;
  }

  /// To the impulses that Newton began with; the active set follows from them.
  void go_back_to_start() {
    for (std::int32_t o = island_.first_row; o < island_.last_row; ++o)
      if (basis_.set.state[o] != ActiveSet::disabled) basis_.set.x[basis_.position(o)] = basis_.work.center[basis_.position(o)];
  }

  /// Back to rows at rest, but those that may push both ways.
  void restart() {
    limits_.restart(end_.counts);
    for (std::int32_t o = island_.first_row; o < island_.last_row; ++o) {
      if (basis_.set.state[o] == ActiveSet::disabled) continue;
      basis_.set.deferred[o] = 0;
      const double lo = basis_.values.lo[o], hi = basis_.values.hi[o];
      if (lo < 0 && hi > 0)
        basis_.set.state[o] = ActiveSet::active;
      else
        basis_.rest(o, ActiveSet::resting(lo, hi));
    }
  }

  const SolveInput& input_;
  Basis& basis_;
  CertificateCheck& check_;
  const Island& island_;
  const std::int32_t index_;
  IslandEnd& end_;
  const std::int32_t rows_;
  Limits limits_;
  Newton::Left left_;
};

}  // namespace

IslandEnd solve_island(const SolveInput& input, Basis& basis, CertificateCheck& check, Watch& watch, std::int32_t index, bool warm,
                       Array<mlcp_pivot>* trace) {
  IslandEnd end;
  end.outcome = watch.stopped();
  if (end.outcome != MLCP_SOLVED) return end;
  try {
    Run(input, basis, check, watch, index, end).solve(warm, trace);
  } catch (const Stopped&) {
    end.outcome = watch.stopped();
  }
  return end;
}

void solve_island_again(const SolveInput& input, Basis& basis, CertificateCheck& check, Watch& watch, std::int32_t index, const Mask& start,
                        Array<mlcp_pivot>* trace, IslandEnd& end) {
  const IslandEnd before = end;
  end = {};
  end.outcome = watch.stopped();
  if (end.outcome != MLCP_SOLVED) return;
  try {
    Run(input, basis, check, watch, index, end).solve_again(start, before, trace);
  } catch (const Stopped&) {
    end.outcome = watch.stopped();
  }
}

void finish_island(const SolveInput& input, Basis& basis, Watch& watch, std::int32_t index, std::uint8_t* redundant, IslandEnd& end) {
  if (end.outcome != MLCP_SOLVED && end.outcome != MLCP_ITERATION_LIMIT) return;
  if (end.crowded || end.method == MLCP_METHOD_PGS) return;
  const Island& island = basis.factor.symbolic().islands[index];
  const bool shared = mark_redundant(island, basis, end.epsilon, input.problem.n(), redundant, end.counts);
  if (input.settings.impulses != MLCP_IMPULSES_LEAST_NORM || !shared || end.outcome != MLCP_SOLVED) return;
  Limits limits(watch, index, 1, 50 * (static_cast<std::int64_t>(island.last_row - island.first_row) + 10));
  limits.restart(end.counts);
  Newton newton(basis, limits, end.counts);
  newton.least_norm(island);
}

}  // namespace mlcp
