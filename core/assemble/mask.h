#pragma once
#include "assemble/keys.h"
#include "memory/array.h"
#include "memory/error.h"

namespace mlcp {

struct Problem;

/// One state a row and, if known, its key, its impulse and how its contact slips: `key`, `impulse` and `slip` are empty or as long as `state`.
/// slip, of contacts that a solve has found: on the normal row µ|w_T|, 0 when it does not slip; on the tangent rows w_T when it slips, else
/// γ_T/(µ γ_n). On rows whose bounds follow another row: the impulse of that row.
struct Mask {
  Memory memory;
  Array<mlcp_row_state> state;
  Array<std::uint64_t> key;
  Array<double> impulse, slip;

  explicit Mask(const Memory& m) : memory(m), state(m), key(m), impulse(m), slip(m) {}
  void reserve(std::size_t rows);  ///< slip excepted, which few masks have
  void swap(Mask& other) noexcept;
  void trim();
};

/// Makes the mask `count` rows long; new rows get `state`, no key.
void mask_resize(Mask& mask, std::int32_t count, mlcp_row_state state);
void mask_set(Mask& mask, std::int32_t first, std::int32_t count, const mlcp_row_state* states);
void mask_get(const Mask& mask, std::int32_t first, std::int32_t count, mlcp_row_state* states);
std::int32_t mask_count(const Mask& mask, mlcp_row_state state);
void mask_set_impulses(Mask& mask, std::int32_t first, std::int32_t count, const double* impulses);
/// fails: STATE, it has none.
void mask_get_impulses(const Mask& mask, std::int32_t first, std::int32_t count, double* impulses);
/// States only.
bool mask_equal(const Mask& a, const Mask& b);
/// The keys of the problem's rows; fails: RANGE, the sizes differ.
void mask_take_keys(Mask& mask, const Problem& problem);

/// Scratch of mask_carry.
struct CarryWorkspace {
  KeyTable table;
  Mask rows;
  explicit CarryWorkspace(const Memory& memory) : table(memory), rows(memory) {}
};

/// States, impulses, slips and keys for the rows of `problem`: those that the row with the same key had in `previous`, else `otherwise` and 0.
/// `previous` may be the mask itself.      cost: expected O(m).
void mask_carry(Mask& mask, const Problem& problem, const Mask& previous, mlcp_row_state otherwise, CarryWorkspace& work);

}  // namespace mlcp
