#include "assemble/mask.h"

#include "handles.h"

using namespace mlcp;

mlcp_status mlcp_mask_create(const mlcp_allocator* allocator, int32_t count, mlcp_row_state state, mlcp_mask** mask) {
  if (!mask) return MLCP_ERROR_NULL;
  *mask = nullptr;
  return guard(nullptr, [&] {
    const Memory memory = memory_of(allocator);
    Mask rows(memory);
    mask_resize(rows, count, state);
    mlcp_mask* handle = make_handle<mlcp_mask>(memory, memory);
    handle->mask.swap(rows);
    *mask = handle;
  });
}

void mlcp_mask_destroy(mlcp_mask* mask) {
  if (mask) free_handle(mask, mask->mask.memory);
}

mlcp_status mlcp_mask_clone(const mlcp_allocator* allocator, const mlcp_mask* mask, mlcp_mask** copy) {
  if (!copy) return MLCP_ERROR_NULL;
  *copy = nullptr;
  return look(mask, [&](const mlcp_mask& from) {
    const Memory memory = memory_of(allocator);
    Mask rows(memory);
    rows.state.assign(from.mask.state.span());
    rows.key.assign(from.mask.key.span());
    rows.impulse.assign(from.mask.impulse.span());
    rows.slip.assign(from.mask.slip.span());
    mlcp_mask* handle = make_handle<mlcp_mask>(memory, memory);
    handle->mask.swap(rows);
    *copy = handle;
  });
}

const char* mlcp_mask_error(const mlcp_mask* mask) { return mask ? mask->error.text : ""; }

int32_t mlcp_mask_size(const mlcp_mask* mask) { return mask ? static_cast<int32_t>(mask->mask.state.size()) : 0; }

mlcp_status mlcp_mask_resize(mlcp_mask* mask, int32_t count, mlcp_row_state state) {
  return edit(mask, [&](mlcp_mask& m) { mask_resize(m.mask, count, state); });
}

mlcp_status mlcp_mask_set(mlcp_mask* mask, int32_t first, int32_t count, const mlcp_row_state* states) {
  return edit(mask, [&](mlcp_mask& m) { mask_set(m.mask, first, count, states); });
}

mlcp_status mlcp_mask_get(const mlcp_mask* mask, int32_t first, int32_t count, mlcp_row_state* states) {
  return look(mask, [&](const mlcp_mask& m) { mask_get(m.mask, first, count, states); });
}

const mlcp_row_state* mlcp_mask_states(const mlcp_mask* mask) {
  return mask && !mask->mask.state.empty() ? mask->mask.state.data() : nullptr;
}

int32_t mlcp_mask_count(const mlcp_mask* mask, mlcp_row_state state) { return mask ? mask_count(mask->mask, state) : 0; }

int32_t mlcp_mask_equal(const mlcp_mask* a, const mlcp_mask* b) { return a && b && mask_equal(a->mask, b->mask); }

mlcp_status mlcp_mask_set_impulses(mlcp_mask* mask, int32_t first, int32_t count, const double* impulses) {
  return edit(mask, [&](mlcp_mask& m) { mask_set_impulses(m.mask, first, count, impulses); });
}

mlcp_status mlcp_mask_get_impulses(const mlcp_mask* mask, int32_t first, int32_t count, double* impulses) {
  return look(mask, [&](const mlcp_mask& m) { mask_get_impulses(m.mask, first, count, impulses); });
}

mlcp_status mlcp_mask_take_keys(mlcp_mask* mask, const mlcp_problem* problem) {
  return edit(mask, [&](mlcp_mask& m) {
    require(problem, "problem");
    mask_take_keys(m.mask, problem->problem);
  });
}

mlcp_status mlcp_mask_carry(mlcp_mask* mask, const mlcp_problem* problem, const mlcp_mask* previous, mlcp_row_state otherwise) {
  return edit(mask, [&](mlcp_mask& m) {
    require(problem, "problem");
    require(previous, "previous");
    mask_carry(m.mask, problem->problem, previous->mask, otherwise, m.work);
  });
}
