#!/usr/bin/env python3
"""Breaks ratio test, row toggles, the dense factor and Newton's steps on purpose, one place at a time, and expects the unit and property tests to
notice.

    tests/mutation/run.py BUILD_FOLDER [NAME...] [--jobs N]      a copy of the tree is made and built there; names: only those mutations

Prints a line for each and ends with "N passed, N failed"; a mutation that survives is a failure: it needs a test. About half a minute each.
"""
import argparse
import os
import pathlib
import shutil
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
RATIO, FACTOR, KERNELS, BASIS = ("core/solve/ratio_test.cpp", "core/factorize/factor.cpp", "core/factorize/kernel_loops.h", "core/solve/basis.cpp")
PANELS, RESPONSE = ("core/factorize/panel_loops.h", "core/factorize/dense_response.cpp")
DENSE_INTERIOR, NORMAL = ("core/solve/dense_interior_point.cpp", "core/factorize/normal_equations.cpp")
DENSE_NEWTON, DENSE_SIMPLEX = "core/solve/dense_newton.cpp", "core/solve/dense_simplex.cpp"
NEWTON, PROXIMAL, INTERIOR = ("core/solve/newton.cpp", "core/solve/proximal.cpp", "core/solve/interior_point.cpp")
EXTENDED, SYMBOLIC = ("core/solve/extended_simplex.cpp", "core/analyze/symbolic.cpp")
ORDERING, LINEAGE, ANALYSIS = ("core/analyze/ordering.cpp", "core/analyze/lineage.cpp", "core/analyze/analysis.cpp")
QUOTIENT = "core/analyze/quotient_graph.cpp"
SYMMETRIC = "core/assemble/symmetric.cpp"
SUBSPACE, ISLANDS = "core/solve/subspace.cpp", "core/solve/island_solver.cpp"
TESTS = ("unit_tests", "property_tests", "capi_tests")

# name: file, text that stands there exactly once, what takes its place. Not among them: what only costs steps, as Newton's patience, which the limit of
# iterations and the same fallback replace; and what changes nothing: rows at rest have no part in a direction, so that they never block.
MUTATIONS = {
    "step to w = 0: sign": (RATIO, "arrive(-set.w[entering] / slopes[entering]", "arrive(set.w[entering] / slopes[entering]"),
    "step to w = 0: not for dependent rows": (RATIO, "if (!direction.dependent) arrive(", "arrive("),
    "far bound: upper forgotten": (RATIO, "if (direction.sign > 0 && k.hi[entering] < infinity)", "if (false)"),
    "far bound: lower forgotten": (RATIO, "if (direction.sign < 0 && k.lo[entering] > -infinity)", "if (false)"),
    "far bound: direction": (RATIO, "arrive(gamma - k.lo[entering]", "arrive(k.lo[entering] - gamma"),
    "blocking: slope of the impulse": (RATIO, "const double slope = -dx[position[o]];", "const double slope = dx[position[o]];"),
    "blocking: lower bounds forgotten": (RATIO, "if (slope < 0 && k.lo[o] > -infinity)", "if (false)"),
    "blocking: upper bounds forgotten": (RATIO, "if (slope > 0 && k.hi[o] < infinity)", "if (false)"),
    "blocking: distance to the wrong bound": (RATIO, "std::max(k.hi[o] - basis.gamma(o), 0.0)", "std::max(k.lo[o] - basis.gamma(o), 0.0)"),
    "blocking: last instead of first": (RATIO, "if (std::abs(distance) > step.length * std::abs(slope) ||", "if (std::abs(distance) < step.length * std::abs(slope) ||"),
    "ties: greatest index": (RATIO, "row(o) < row(step.blocking)", "row(o) > row(step.blocking)"),
    "printed rule: satisfied rows never block": (RATIO, "if (rule == MLCP_PIVOT_PRINTED && !direction.dependent)", "if (false)"),
    "printed rule: at the lower bound, slope": (RATIO, "w >= -zero && slope < 0", "w >= -zero && slope > 0"),
    "printed rule: at the upper bound, slope": (RATIO, "w <= zero && slope > 0", "w <= zero && slope < 0"),
    "removal: sign of the update": (FACTOR, "rank_one(p, 1 / pivot_[p], work)", "rank_one(p, -1 / pivot_[p], work)"),
    "removal: update skipped": (FACTOR, "const FactorStatus status = rank_one(p, 1 / pivot_[p], work);", "const FactorStatus status = FactorStatus::ok;"),
    "removal: row of L stays": (FACTOR, "values_[t] = 0;\n  clear_row(p, work);\n  in_[p] = 0;", "values_[t] = 0;\n  in_[p] = 0;"),
    "removal: pivot stays": (FACTOR, "pivot_[p] = inverse_[p] = 0;\n  return status;", "return status;"),
    "insertion: sign of the update": (FACTOR, "return rank_one(p, -1 / d, work);", "return rank_one(p, 1 / d, work);"),
    "insertion: update skipped": (FACTOR, "return rank_one(p, -1 / d, work);", "return FactorStatus::ok;"),
    "insertion: pivot without its row": (FACTOR, "d -= y[j] * (y[j] * inverse_[j]);\n        values_", "values_"),
    "insertion: row of L forgotten": (FACTOR, "values_[symbolic_->pointers[j] + place - (j - s.first)] = y[j];", ""),
    "insertion: one place beside": (FACTOR, "+ place - (j - s.first)] = y[j]", "+ place - (j - s.first) - (place > j - s.first)] = y[j]"),
    "insertion: dependent rows enter": (FACTOR, "if (drop > 0 && !(std::abs(d) > drop * kkt_->a[o])) {", "if (false) {"),
    "factor: entries of K in a column of a run": (FACTOR, "column -= p - first;\n    for", "for"),
    "factor: K's own pattern with rows that are out": (FACTOR, "column[i] = in_[row[i]] ? entry[i] : 0;", "column[i] = entry[i];"),
    "factor: a batch acts on one run alone": (FACTOR, "  cursor_[batch] = begin + a;\n  wait(batch);", "  cursor_[batch] = begin + a;"),
    "factor: pivot without a single column": (FACTOR, "pivot_[p] -= c * factor;", ""),
    "factor: pivot without the products": (FACTOR, "pivot_[p] -= product[0];", ""),
    "factor: products of a batch without its last column": (FACTOR, "first <= last && count < most_columns", "first < last && count < most_columns"),
    "factor: one column forgotten": (FACTOR, "for (; first < last && count < most_columns; ++first) {", "for (; first + 1 < last && count < most_columns; ++first) {"),
    "factor: rows that drop out stay": (FACTOR, "    in_[p] = 0;\n    clear_row(p, work);\n    std::fill_n", "    clear_row(p, work);\n    std::fill_n"),
    "solves: equal columns taken for nested ones": (FACTOR, "s.equal = symbolic_->run_end[first] < last;", ""),
    "batches: columns with other rows": (SYMBOLIC, "parent[p] != parent[p - 1] || !equal(p - 1, p)", "parent[p] != parent[p - 1]"),
    "pattern: rows before their velocities unsorted": ("core/analyze/kkt_pattern.cpp", "if (early) sort_entries(", "if (false) sort_entries("),
    "pattern: coupled rows before their velocities unsorted": ("core/analyze/kkt_pattern.cpp", "if (mixed) sort_entries(", "if (false) sort_entries("),
    "components: rows that are out touch": ("core/analyze/components.cpp", "t < jacobian.pointers[i + 1] && enabled_[i]; ++t) touched_", "t < jacobian.pointers[i + 1]; ++t) touched_"),
    "components: mass blocks are free": ("core/analyze/components.cpp", " && mass.pointers[j + 1] - t == 1", ""),
    "components: an entry alone is on the diagonal": ("core/analyze/components.cpp", " && mass.indices[t] == j)", ")"),
    "components: one of eight touched": ("core/analyze/components.cpp", "return eight == 0;", "return eight >> 8 == 0;"),
    "masses: negative diagonals": ("core/assemble/bodies.cpp", "right &= (values[j] >= 0) & (values[j] < infinity)", "right &= (values[j] < infinity)"),
    "masses: any pattern is diagonal": ("core/assemble/symmetric.cpp", "off |= a.row_indices[j] ^ j;", "off |= 0;"),
    "errors: free velocities forgotten": ("core/measure/errors.cpp", "  free_momentum(problem, free_velocities, v, e);", ""),
    "diagonal masses: momenta beyond doubles": ("core/factorize/diagonal_loops.h", "~((off <= bound * size) & (size < limit))", "~(off <= bound * size)"),
    "diagonal masses: zeros": ("core/factorize/diagonal_loops.h", "  bool all = !any(wrong);", "  bool all = true;"),
    "diagonal masses: largest residual": ("core/factorize/diagonal_loops.h", "most = off > most ? off : most;", "most = most;"),
    "masses: velocities without any are fixed": ("core/factorize/kkt_values.cpp", "diagonal[q] > 0 ? diagonal[q] : 1;", "diagonal[q] > 0 ? diagonal[q] : infinity;"),
    "proximal simplex: around 0": ("core/factorize/kkt_values.cpp", "    b[p] += more * u[p];\n", ""),
    "refinement: velocities without mass stop": (BASIS, " || values.diagonal[p] == 0", ""),
    "refinement: impulses that nothing asks for": (BASIS, "  if (!widely) return changed;\n", "  return changed;\n"),
    "factor: pivots that rounding has left": (FACTOR, "!(d > rounding * kkt_->factored[p])", "!(d > 0)"),
    "dense: many rows taken": ("core/dense_stage.cpp", "(rows <= medium && velocities <= many_velocities) ||", "(velocities <= many_velocities) ||"),
    "dense interior: sign of the upper bound": (DENSE_INTERIOR, "dgamma = -w + change - other;", "dgamma = -w + change + other;"),
    "dense interior: rows at rest stay": (DENSE_INTERIOR, "      s_.state[i] = ActiveSet::active;\n    }\n    ++flips;", "    }\n    ++flips;"),
    "dense interior: from nowhere": (DENSE_INTERIOR, "if (start && !start->impulse.empty())", "if (false)"),
    "dense interior: of the tolerance": ("core/dense_stage.cpp", "interior_[c] ? forgiven_part * settings.tolerance : ", ""),
    "normal equations: weights forgotten": (NORMAL, "-= s.weight[4 * c + q] * moved[q]", "-= moved[q]"),
    "normal equations: envelope of M alone": (NORMAL, "s.normal.first[b] = std::min(s.normal.first[b], s.tile_block[s.tile_pointers[c]]);", ""),
    "normal equations: rows that Σ couples": (NORMAL, "else if (sigma.values[t] != 0)\n      return false;", "else if (false)\n      return false;"),
    "normal equations: tiles unweighed": (PANELS, "weighed[q] *= weight[q];", "weighed[q] *= 1;"),
    "dense: many active rows": (DENSE_NEWTON, "  if (too_many()) return false;\n", ""),
    "dense: negative pivots rest": (PANELS, " || (least > 0 && -d > least)", ""),
    "dense: pivots without an inverse": (PANELS, "return finite && (", "return ("),
    "dense: second pivot of a pair": (PANELS, "determinant = product - beside * beside", "determinant = product"),
    "dense: pairs of pivots out of range": (PANELS, "if (!(__builtin_fabs(product) < 1e250 && __builtin_fabs(determinant) > 1e-250))", "if (false)"),
    "dense sweep: neighbours in a four": (PANELS, "w += a[s.stride * p + i] * by[p];", "w += 0 * by[p];"),
    "dense sweep: upper bound": (PANELS, "low ? lo : high ? hi : free", "low ? lo : free"),
    "dense slacks: magnitude": (PANELS, "reinterpret_cast<Lanes>(reinterpret_cast<Bits>(term) & no_sign)", "term"),
    "dense slacks: fours at rest": (RESPONSE, "asked |= s.state[i] != known;", "asked = s.state[i] != known;"),
    "toggle: a cleared row, once a run": (FACTOR, "if (run_end != symbolic_->run_end[q])", "if (run_end == 0)"),
    "combine: part of the last four": (KERNELS, "load_part(column + 4 * whole, count - 4 * whole, last);", "load_part(column + 4 * whole, count - 4 * whole - 1, last);"),
    "compliance over the same pattern: asymmetric": (SYMMETRIC, "return positive && equal(off);", "return positive;"),
    "compliance over the same pattern: negative": (SYMMETRIC, "return positive && equal(off);", "return equal(off);"),
    "errors: diagonal of another pattern": ("core/measure/errors.cpp", " || mass.indices[at] != j)", ")"),
    "update: stops at the first run": (FACTOR, "first = symbolic_->parent[symbolic_->run_end[first] - 1])", "first = -1)"),
    "update: scale of the rest": (KERNELS, "sigma *= d / updated;", "sigma *= updated / d;"),
    "update: pivot stays": (KERNELS, "f.pivot[j] = updated;", ""),
    "update: inverse stays": (KERNELS, "f.inverse[j] = 1 / updated;", ""),
    "update: lost pivots pass": (KERNELS, "if (!(size_of(updated) > 1e-12 * size_of(d)) || (updated > 0) != (d > 0)) {", "if (false) {"),
    "basis: a removal is not made": (BASIS, "fresh = factor.remove(position(f.o), counts.work) != FactorStatus::ok;", ""),
    "basis: an insertion is not made": (BASIS, "const FactorStatus status = factor.insert(position(f.o), counts.work, drop);", "const FactorStatus status = FactorStatus::ok;"),
    "basis: a row that leaves keeps its impulse": (BASIS, "  rest(o, to);\n", "  set.state[o] = to;\n"),
    "dense factor: pivot without its row": (PANELS, "s[c] -= z[c] * scaled;", ""),
    "dense factor: row of L not divided": (PANELS, "*reinterpret_cast<Lanes*>(z) = scaled;", ""),
    "dense factor: last entry left out": (PANELS, "q < 4 * end; ++q) {\n    double* const z", "q < 4 * end - 1; ++q) {\n    double* const z"),
    "dense factor: pivots within a block": (PANELS, "s[j] -= s[c][j] * unit;", "s[j] -= unit * unit[j];"),
    "dense forward: sign": (PANELS, "s2 += left[2] * x;", "s2 -= left[2] * x;"),
    "dense forward: within a block": (PANELS, "s[3] -= own[11] * s[2];", ""),
    "dense forward: odd columns of a panel": (PANELS, "t3 += left[7] * y;", "t3 += left[6] * y;"),
    "dense forward: one vector": (PANELS, "t += *reinterpret_cast<const Lanes*>(l + 4) * x[q + 1];", "t += *reinterpret_cast<const Lanes*>(l + 4) * x[q];"),
    "dense forward: one vector, within a block": (PANELS, "for (int q = 0; q < 3; ++q) s -=", "for (int q = 0; q < 2; ++q) s -="),
    "dense backward: sign": (PANELS, "-four, x + begin);", "four, x + begin);"),
    "dense backward: within a block": (PANELS, "y1 = y[1] - (own[6] * y2 + own[7] * y3)", "y1 = y[1] - own[6] * y2"),
    "dense response: A mirrored": (PANELS, "Lanes{s[0][r], s[1][r], s[2][r], s[3][r]};", "Lanes{s[0][r], s[1][r], s[3][r], s[2][r]};"),
    "dense response: compliance forgotten": (RESPONSE, "if (const std::int32_t j = local_[problem.n() + sigma.indices[t]]; j >= 0)", "if (const std::int32_t j = -1; j >= 0)"),
    "dense response: given velocity forgotten": (RESPONSE, "r -= given;", ""),
    "dense response: row ends early": (PANELS, "))) end = b + 1;", "))) end = b;"),
    "dense response: dependent rows stay": (RESPONSE, "least[r] = drop * ", "least[r] = -1e300 * "),
    "dense response: impulses at rest": (RESPONSE, "x[t] -= s.response(s.member[t], j) * s.gamma[j];", "x[t] += s.response(s.member[t], j) * s.gamma[j];"),
    "dense response: pivot of a row outside": (RESPONSE, "pivot -= x[t] * (x[t] * s.active.inverse[t]);", "pivot += x[t] * (x[t] * s.active.inverse[t]);"),
    "dense response: velocities": (RESPONSE, "const double* const g = s.gamma + 4 * c;", "const double* const g = s.w + 4 * c;"),
    "dense correction: of the impulses": (RESPONSE, "g[t] -= y * (v[p] * s.mass.inverse[p]);", "g[t] += y * (v[p] * s.mass.inverse[p]);"),
    "dense correction: of the velocities": (RESPONSE, "v[p] += y * g[t];", "v[p] -= y * g[t];"),
    "dense Newton: leaves to the other bound": (DENSE_NEWTON, "rest(i, s_.gamma[i] < s_.lo[i] ?", "rest(i, s_.gamma[i] > s_.lo[i] ?"),
    "dense Newton: upper bounds never passed": (DENSE_NEWTON, "if (s_.gamma[i] >= s_.lo[i] && s_.gamma[i] <= s_.hi[i]) continue;", "if (s_.gamma[i] >= s_.lo[i]) continue;"),
    "dense Newton: lower bounds never left": (DENSE_NEWTON, "s_.state[i] == ActiveSet::at_lower ? w < -zero", "s_.state[i] == ActiveSet::at_lower ? false"),
    "dense Newton: upper bounds never left": (DENSE_NEWTON, "s_.state[i] == ActiveSet::at_upper ? w > zero", "s_.state[i] == ActiveSet::at_upper ? false"),
    "dense Newton: dependent rows counted as active": (DENSE_NEWTON, "if (*s_.members < wanted) {", "if (false) {"),
    "dense Newton: no impulse at rest": (DENSE_NEWTON, "s_.gamma[i] = -ActiveSet::resting_x(to, s_.lo[i], s_.hi[i]);", "s_.gamma[i] = 0;"),
    "dense Newton: dependent rows of joints pivoted": (DENSE_NEWTON, "if (s_.state[i] == ActiveSet::out) return true;", ""),
    "dense simplex: dependent rows are driven to w = 0": (DENSE_SIMPLEX, "pivot > dependent * sum ? -sign * w / pivot : infinity", "-sign * w / pivot"),
    "dense simplex: far bound forgotten": (DENSE_SIMPLEX, "    block(*s_.members, k, sign);\n", ""),
    "dense simplex: nothing blocks": (DENSE_SIMPLEX, "block(t, i, -sign * z[t]);", ";"),
    "dense simplex: blocking row to the other bound": (DENSE_SIMPLEX, "-sign * z[blocking] > 0 ?", "sign * z[blocking] > 0 ?"),
    "dense simplex: the slack stays": (DENSE_SIMPLEX, "    w += sign * length * pivot;\n", ""),
    "dense simplex: impulses stay": (DENSE_SIMPLEX, "s_.gamma[s_.member[t]] -= sign * length * z[t];", ";"),
    "dense simplex: start beyond bounds": (DENSE_SIMPLEX, "while (drop_beyond_bounds());", "while (false);"),
    "dense simplex: the factor behind a row that leaves stays": (DENSE_SIMPLEX, "  DenseResponse::factor_active(s_, left_pivot, t);\n  return *s_.members == left;", "  return *s_.members == left;"),
    "dense factor: four rows taken for neighbours": ("core/factorize/dense_response.cpp", "four[1] == four[0] + 1 && four[2] == four[0] + 2 && ", ""),
    "dense: what neither way makes exact is left": ("core/dense_stage.cpp", "std::min(nearly_refined, nearly_refined_part * settings.tolerance)", "0.0"),
    "Newton: whole steps only": (NEWTON, "if (share > 0) flips = proximal_.largest", "if (false) flips = proximal_.largest"),
    "Newton: share never smaller": (NEWTON, "      ++share;\n", ""),
    "Newton: point not looked at again": (NEWTON, "if (finish(island, false, true) == Ending::settled) return Ending::settled;\n    if (flips_.empty())", "return Ending::settled;\n    if (flips_.empty())"),
    "Newton: violated rows without impulse pass": (NEWTON, " && empty_rows_hold(island)", ""),
    "Newton: grown impulses forgive": (NEWTON, " && !impulses_forgive(island)", ""),
    "Newton: start lost when it gives up": (NEWTON, "  if (ending != Ending::settled) {\n    basis_.values.regularise(*basis_.pattern, island, 0, 0);\n    go_back(island);", "  if (ending != Ending::settled) {\n    go_back(island);"),
    "partial step: the least instead of the most": (PROXIMAL, "return da > db ||", "return da < db ||"),
    "flips: below the lower bound": (PROXIMAL, "if (gamma < k.lo[o]) flips[count++] = {o, ActiveSet::at_lower};", ""),
    "flips: beyond the upper bound": (PROXIMAL, "if (gamma > k.hi[o]) flips[count++] = {o, ActiveSet::at_upper};", ""),
    "flips: slack at the upper bound": (PROXIMAL, "state == ActiveSet::at_upper ? w > zero", "state == ActiveSet::at_upper ? w < -zero"),
    "line search: slope of the rows": (PROXIMAL, "f -= gamma * slope[o];", "f += gamma * slope[o];"),
    "line search: whole steps": (PROXIMAL, "const double t = search(island);", "const double t = 1;"),
    "line search: curvature of the rows": (PROXIMAL, "g += slope[o] * slope[o] /", "g -= slope[o] * slope[o] /"),
    "interior points: residual not looked at": (INTERIOR, " && infeasibility_ <= feasible", ""),
    "interior points: step of the slack": (INTERIOR, "- s - s / distance * sign * dgamma", "- s + s / distance * sign * dgamma"),
    "interior points: active where the slack is": (INTERIOR, "basis_.work.slack[o] > a * (gamma - k.lo[o])", "basis_.work.slack[o] < a * (gamma - k.lo[o])"),
    "interior points: compliance of the bounds": (INTERIOR, "-= basis_.work.slack[o] / (gamma - k.lo[o])", "+= basis_.work.slack[o] / (gamma - k.lo[o])"),
    "extended: step away": (EXTENDED, "const int sign = image_[position(k)] < 0 ? 1 : -1;", "const int sign = image_[position(k)] < 0 ? -1 : 1;"),
    "extended: upper bounds passed": (EXTENDED, "if (!below && !(gamma(o) > basis_->values.hi[o])) continue;", "if (!below) continue;"),
    "extended: dependent rows start": (EXTENDED, "else if (pivot(o) > dependent * terms(o))", "else if (true)"),
    "extended: satisfied forgotten": (EXTENDED, "if (magnitude(w) > forgiven) return certify", "if (true) return certify"),
    "batches: of unequal rows": (SYMBOLIC, " || !equal(p - 1, p)", ""),
    "guess: sweeps on when the time is over": ("core/solve/gauss_seidel.cpp", "return limits_.check(counts_, 0) == MLCP_SOLVED; };", "return true; };"),
    "proximal: centre's sign": (PROXIMAL, "(-e * basis_.work.center[basis_.position(o)] - slack) / (sigma + e)", "(e * basis_.work.center[basis_.position(o)] - slack) / (sigma + e)"),
    "lineage: two trees": (LINEAGE, "return chain_end_[q];", "return q;"),
    "lineage: ends of chains": (LINEAGE, "parent[p] == p + 1 ? chain_end_[p + 1] : p", "chain_end_[p + 1 < size ? p + 1 : p]"),
    "carried order: new velocities after their rows": (ORDERING, "!crowding.crowded[n + i]; ++e) place(", "!crowding.crowded[n + i] && e < 0; ++e) place("),
    "carried order: velocities without rows forgotten": (ORDERING, "for (std::int32_t j = 0; j < n; ++j) place(j);", ""),
    "carried order: where any two meet": (ORDERING, "crowded ? std::min(at, p) : lineage_.meet(at, p)", "std::max(at, p)"),
    "carried order: kept whatever it fills in": (ANALYSIS, "if (symbolic.entries() <= allowed_entries())", "if (true)"),
    "carried order: never tried": (ANALYSIS, "if (!done_ || exact != exact_ || pause_ > 0)", "if (true)"),
    "crowded order: equal rows weigh as one": (QUOTIENT, "else if (leader[i] >= velocities_) ++weight[leader[i]];", ""),
    "crowded order: rows of one velocity among equal rows": (QUOTIENT, "if (count_of_dynamic == 1) return velocity;", ""),
    "crowded order: coupled rows follow others": (QUOTIENT, "if (!alone(i)) return -1;", ""),
    "crowded order: followers are lost": (ORDERING, "    place(elements + x);\n    order.push_back", "    order.push_back"),
    "column counts: where two paths meet": ("core/analyze/column_counts.cpp", "--count[meet(latest_[i])];", "--count[latest_[i]];"),
    "tree of the problem: rows that Σ couples": ("core/analyze/elimination_tree.cpp", "climb_from(sigma, order[p] - n, n, p);", ""),
    "parts: velocities of different rows in one four": ("core/analyze/mass_parts.cpp", "first_row(p) == first_row(last)) ++last;", "true) ++last;"),
    "refinement: rows before their velocities": ("core/factorize/refinement.cpp", "if (row && !island.crowded) continue;", "if (row) continue;"),
    "gradients: rows that Σ couples": (SUBSPACE, "sum += k.row[t] * step[pattern.row_columns[t]];", ";"),
    "gradients: impulses stay beyond their bounds": (SUBSPACE, "  put_back(free);\n", ""),
    "guess: sweeps alone": ("core/solve/gauss_seidel.cpp", "      subspace.minimise(island, gradients);\n", ""),
    "guess: rows that depend on each other go on": ("core/solve/gauss_seidel.cpp", "return velocities > 0 && active > velocities;", "return velocities > 0 && active > 2 * velocities;"),
    "warm start: states alone are thrown away": (ISLANDS, "== ActiveSet::active && basis_.gamma(o) != 0) return true;", "== ActiveSet::active) return true;"),
    "Newton: contradictions that are no rounding": (NEWTON, "return !(largest <= grown * asked);", "return false;"),
    "cones: slacks of a large friction in double": ("core/measure/cones.cpp", "constexpr double steep = 1e3;", "constexpr double steep = 1e300;"),
    "dense refinement: beyond a bound": ("core/dense_stage.cpp", "gamma = std::clamp(gamma + s.x_rows()[t], s.lo[i], s.hi[i]);", "gamma = gamma + s.x_rows()[t];"),
}


def copy_tree(work: pathlib.Path) -> None:
    """The files that git knows, as they are now, and no others. Times are those of the copy: a mutant that a killed run left is built anew."""
    names = subprocess.run(["git", "ls-files", "-z", "core", "capi", "cmake", "examples", "tests", "CMakeLists.txt", "CMakePresets.json", "VERSION", "mlcp.pc.in", "LICENSE"],
                           cwd=ROOT, check=True, capture_output=True, text=True).stdout.split("\0")
    known = {work / name for name in names if name}
    for folder in ("core", "capi", "examples", "tests"):
        for target in (work / folder).rglob("*"):
            if target.is_file() and target not in known:
                target.unlink()
    for name in filter(None, names):
        source, target = ROOT / name, work / name
        if not source.is_file() or (target.is_file() and target.read_bytes() == source.read_bytes()):
            continue
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(source, target)


def build(work: pathlib.Path, jobs: int) -> bool:
    command = ["cmake", "--build", work / "build", "-j", str(jobs), "--target", *TESTS]
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    if done.returncode:
        print(done.stdout[-3000:])
    return done.returncode == 0


def noticed(work: pathlib.Path, most_seconds: float) -> bool:
    """By a test that fails, a crash or a run without end."""
    for tests in TESTS:
        try:
            done = subprocess.run([work / "build" / "bin" / tests, "--gtest_fail_fast", "--gtest_brief=1"], cwd=work / "build", capture_output=True,
                                  timeout=most_seconds)
        except subprocess.TimeoutExpired:
            return True
        if done.returncode:
            return True
    return False


def survives(work: pathlib.Path, name: str, jobs: int, most_seconds: float) -> str:
    """"" if the tests notice it, else what is wrong."""
    file, old, new = MUTATIONS[name]
    target = work / file
    text = target.read_text()
    if text.count(old) != 1:
        return f"{file} has its text {text.count(old)} times: bring the list up to date"
    target.write_text(text.replace(old, new))
    try:
        if not build(work, jobs):
            return "does not compile"
        return "" if noticed(work, most_seconds) else "survives"
    finally:
        target.write_text(text)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build_folder", type=pathlib.Path)
    parser.add_argument("names", nargs="*", metavar="NAME")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), metavar="N", help="of the build [all processors]")
    arguments = parser.parse_args()
    if unknown := [name for name in arguments.names if name not in MUTATIONS]:
        parser.error(f"no such mutation: {', '.join(unknown)}")
    work = arguments.build_folder.resolve()
    copy_tree(work)
    # the examples are there for the scenes that tests use
    configure = ["cmake", "-S", work, "-B", work / "build", "-DCMAKE_BUILD_TYPE=Release", "-DMLCP_BUILD_TESTS=ON", "-DMLCP_BUILD_EXAMPLES=ON", "-DMLCP_INSTALL=OFF"]
    configure += ["-G", "Ninja"] if shutil.which("ninja") else []
    configure += ["-DCMAKE_CXX_COMPILER_LAUNCHER=ccache", "-DCMAKE_C_COMPILER_LAUNCHER=ccache"] if shutil.which("ccache") else []
    subprocess.run(configure, check=True, stdout=subprocess.DEVNULL)
    if not build(work, arguments.jobs):
        return 1
    start = time.monotonic()
    if noticed(work, 3600):
        print("the tests fail without any mutation")
        return 1
    most_seconds = 30 + 3 * (time.monotonic() - start)
    failed = 0
    names = arguments.names or list(MUTATIONS)
    for name in names:
        fault = survives(work, name, arguments.jobs, most_seconds)
        failed += bool(fault)
        print(f"{name}: {fault or 'noticed'}", flush=True)
    print(f"{len(names) - failed} passed, {failed} failed")
    return int(failed > 0)


if __name__ == "__main__":
    sys.exit(main())
