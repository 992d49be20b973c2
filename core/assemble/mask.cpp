#include "assemble/mask.h"

#include "assemble/problem.h"
#include "assemble/validate.h"

namespace mlcp {

namespace {

void check_state(const Argument& argument, mlcp_row_state state) {
  if (state <= MLCP_ROW_AT_UPPER) return;
  if (argument.index < 0) throw Error(MLCP_ERROR_ARGUMENT, "%s = %d is not a row state", argument.name, state);
  throw Error(MLCP_ERROR_ARGUMENT, "%s[%lld] = %d is not a row state", argument.name, static_cast<long long>(argument.index),
              state);
}

std::int32_t size_of(const Mask& mask) { return static_cast<std::int32_t>(mask.state.size()); }

}  // namespace

void Mask::reserve(std::size_t rows) {
  state.reserve(rows);
  key.reserve(rows);
  impulse.reserve(rows);
}

void Mask::swap(Mask& other) noexcept {
  state.swap(other.state);
  key.swap(other.key);
  impulse.swap(other.impulse);
  slip.swap(other.slip);
}

void Mask::trim() {
  state.trim();
  key.trim();
  impulse.trim();
  slip.trim();
}

void mask_resize(Mask& mask, std::int32_t count, mlcp_row_state state) {
  check_count("count", count);
  check_state({"state"}, state);
  const bool keyed = !mask.key.empty(), moved = !mask.impulse.empty(), slips = !mask.slip.empty();
  mask.state.reserve(count);
  if (keyed) mask.key.reserve(count);
  if (moved) mask.impulse.reserve(count);
  if (slips) mask.slip.reserve(count);
  mask.state.resize(count, state);
  if (keyed) mask.key.resize(count, 0);
  if (moved) mask.impulse.resize(count, 0);
  if (slips) mask.slip.resize(count, 0);
}

void mask_set(Mask& mask, std::int32_t first, std::int32_t count, const mlcp_row_state* states) {
  check_range(first, count, size_of(mask));
  check_array("states", states, count);
  for (std::int32_t i = 0; i < count; ++i) check_state({"states", i}, states[i]);
  std::copy_n(states, count, mask.state.data() + first);
  if (!mask.slip.empty()) std::fill_n(mask.slip.data() + first, count, 0.0);
}

void mask_get(const Mask& mask, std::int32_t first, std::int32_t count, mlcp_row_state* states) {
  check_range(first, count, size_of(mask));
  check_array("states", states, count);
  std::copy_n(mask.state.data() + first, count, states);
}

void mask_set_impulses(Mask& mask, std::int32_t first, std::int32_t count, const double* impulses) {
  check_range(first, count, size_of(mask));
  check_array("impulses", impulses, count);
  check_finite("impulses", impulses, count);
  if (mask.impulse.empty()) mask.impulse.assign(mask.state.size(), 0.0);
  std::copy_n(impulses, count, mask.impulse.data() + first);
}

void mask_get_impulses(const Mask& mask, std::int32_t first, std::int32_t count, double* impulses) {
  check_range(first, count, size_of(mask));
  check_array("impulses", impulses, count);
  if (mask.impulse.size() != mask.state.size()) throw Error(MLCP_ERROR_STATE, "the mask has no impulses");
  std::copy_n(mask.impulse.data() + first, count, impulses);
}

std::int32_t mask_count(const Mask& mask, mlcp_row_state state) {
  return static_cast<std::int32_t>(std::count(mask.state.begin(), mask.state.end(), state));
}

bool mask_equal(const Mask& a, const Mask& b) {
  return std::equal(a.state.begin(), a.state.end(), b.state.begin(), b.state.end());
}

void mask_take_keys(Mask& mask, const Problem& problem) {
  if (size_of(mask) != problem.m())
    throw Error(MLCP_ERROR_RANGE, "the mask has %d rows, the problem %d", size_of(mask), problem.m());
  mask.key.assign(problem.key.span());
}

void mask_carry(Mask& mask, const Problem& problem, const Mask& previous, mlcp_row_state otherwise, CarryWorkspace& work) {
  check_state({"otherwise"}, otherwise);
  work.table.build(previous.key.span());
  const bool moved = !previous.impulse.empty(), slips = !previous.slip.empty();
  work.rows.reserve(problem.m());
  work.rows.state.resize(problem.m());
  work.rows.impulse.resize(moved ? problem.m() : 0);
  work.rows.slip.resize(slips ? problem.m() : 0);
  for (std::int32_t i = 0; i < problem.m(); ++i) {
    const std::int32_t row = work.table.take(problem.key[i]);
    work.rows.state[i] = row < 0 ? otherwise : previous.state[row];
    if (moved) work.rows.impulse[i] = row < 0 ? 0 : previous.impulse[row];
    if (slips) work.rows.slip[i] = row < 0 ? 0 : previous.slip[row];
  }
  work.rows.key.assign(problem.key.span());
  mask.swap(work.rows);
}

}  // namespace mlcp
