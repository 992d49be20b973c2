#include "assemble/problem.h"

#include "assemble/bodies.h"
#include "assemble/compliance.h"
#include "assemble/contacts.h"
#include "assemble/rows.h"
#include "assemble/storage.h"
#include "assemble/validate.h"
#include "assemble/values.h"
#include "handles.h"
#include "structs.h"

using namespace mlcp;

namespace {

void set_if(int32_t* out, int32_t value) {
  if (out) *out = value;
}

void lend(const SparseView& matrix, int32_t rows, int32_t columns, mlcp_matrix_view* out) {
  require(out, "view");
  check_struct_size<mlcp_matrix_view>("view", out->struct_size);
  export_struct({sizeof(mlcp_matrix_view), rows, columns, matrix.entries(), matrix.pointers, matrix.indices, matrix.values}, out);
}

/// In space, without anything else.
template <class Contacts>
Contacts default_contacts() {
  Contacts contacts{};
  contacts.dimension = 3;
  return contacts;
}

}  // namespace

// ------------------------------------------------------------------------------------------------------- whole problem

mlcp_status mlcp_problem_create(const mlcp_allocator* allocator, mlcp_problem** problem) {
  if (!problem) return MLCP_ERROR_NULL;
  *problem = nullptr;
  return guard(nullptr, [&] {
    const Memory memory = memory_of(allocator);
    *problem = make_handle<mlcp_problem>(memory, memory);
  });
}

void mlcp_problem_destroy(mlcp_problem* problem) {
  if (problem) free_handle(problem, problem->problem.memory);
}

mlcp_status mlcp_problem_clone(const mlcp_problem* problem, mlcp_problem** copy) {
  if (!copy) return MLCP_ERROR_NULL;
  *copy = nullptr;
  return look(problem, [&](const mlcp_problem& p) { *copy = make_handle<mlcp_problem>(p.problem.memory, p.problem); });
}

const char* mlcp_problem_error(const mlcp_problem* problem) { return problem ? problem->error.text : ""; }

int32_t mlcp_problem_velocity_count(const mlcp_problem* problem) { return problem ? problem->problem.n() : 0; }
int32_t mlcp_problem_row_count(const mlcp_problem* problem) { return problem ? problem->problem.m() : 0; }
int32_t mlcp_problem_body_count(const mlcp_problem* problem) {
  return problem ? static_cast<int32_t>(problem->problem.bodies.size()) - problem->problem.free_ids : 0;
}
int64_t mlcp_problem_entry_count(const mlcp_problem* problem) {
  return problem ? static_cast<int64_t>(problem->problem.jacobian.values.size()) : 0;
}

mlcp_status mlcp_problem_reserve(mlcp_problem* problem, int32_t bodies, int32_t velocities, int32_t rows, int64_t entries) {
  return edit(problem, [&](mlcp_problem& p) { reserve(p.problem, bodies, velocities, rows, entries); });
}

mlcp_status mlcp_problem_trim(mlcp_problem* problem) {
  return edit(problem, [](mlcp_problem& p) { trim(p.problem); });
}

mlcp_status mlcp_problem_clear(mlcp_problem* problem) {
  return edit(problem, [](mlcp_problem& p) { clear(p.problem); });
}

// -------------------------------------------------------------------------------------------------------------- bodies

mlcp_status mlcp_problem_bodies_add(mlcp_problem* problem, int32_t count, int32_t dimension, const double* masses,
                                    ptrdiff_t stride_bytes, int32_t* ids) {
  return edit(problem, [&](mlcp_problem& p) { bodies_add(p.problem, count, dimension, masses, stride_bytes, ids); });
}

mlcp_status mlcp_problem_body_add_sparse(mlcp_problem* problem, int32_t dimension, const int32_t* column_pointers,
                                         const int32_t* row_indices, const double* values, mlcp_triangle triangle, int32_t* id) {
  return edit(problem, [&](mlcp_problem& p) {
    set_if(id, body_add_sparse(p.problem, dimension, column_pointers, row_indices, values, triangle));
  });
}

mlcp_status mlcp_problem_body_set_mass(mlcp_problem* problem, int32_t body, const double* mass, int64_t count) {
  return edit(problem, [&](mlcp_problem& p) { body_set_mass(p.problem, body, mass, count); });
}

mlcp_status mlcp_problem_body_remove(mlcp_problem* problem, int32_t body) {
  return edit(problem, [&](mlcp_problem& p) { body_remove(p.problem, body); });
}

mlcp_status mlcp_problem_body_range(const mlcp_problem* problem, int32_t body, int32_t* offset, int32_t* dimension) {
  return look(problem, [&](const mlcp_problem& p) {
    const Body& b = body_at(p.problem, body);
    set_if(offset, b.offset);
    set_if(dimension, b.dimension);
  });
}

mlcp_status mlcp_problem_bodies(const mlcp_problem* problem, int32_t capacity, int32_t* ids, int32_t* count) {
  return look(problem, [&](const mlcp_problem& p) {
    check_count("capacity", capacity);
    require(count, "count");
    *count = mlcp_problem_body_count(problem);
    if (!ids) return;
    if (capacity < *count) throw Error(MLCP_ERROR_RANGE, "capacity = %d, but %d are needed", capacity, *count);
    for (size_t id = 0; id < p.problem.bodies.size(); ++id)
      if (p.problem.bodies[id].dimension > 0) *ids++ = static_cast<int32_t>(id);
  });
}

mlcp_status mlcp_problem_body_set_prescribed(mlcp_problem* problem, int32_t body, const double* velocity, int32_t count) {
  return edit(problem, [&](mlcp_problem& p) { body_set_prescribed(p.problem, body, velocity, count); });
}

mlcp_status mlcp_problem_body_set_dynamic(mlcp_problem* problem, int32_t body) {
  return edit(problem, [&](mlcp_problem& p) { body_set_dynamic(p.problem, body); });
}

mlcp_status mlcp_problem_body_state(const mlcp_problem* problem, int32_t body, int32_t* prescribed, int32_t count,
                                    double* velocity) {
  return look(problem, [&](const mlcp_problem& p) {
    const Body& b = body_at(p.problem, body);
    if (velocity) check_length("count", count, b.dimension);
    set_if(prescribed, b.prescribed);
    if (velocity) std::copy_n(p.problem.given_velocity.data() + b.offset, count, velocity);
  });
}

mlcp_status mlcp_problem_set_momentum(mlcp_problem* problem, int32_t first, int32_t count, const double* k) {
  return edit(problem, [&](mlcp_problem& p) { set_momentum(p.problem, first, count, k); });
}

// ---------------------------------------------------------------------------------------------------------------- rows

void mlcp_rows_init(mlcp_rows* rows, size_t struct_size) { init_struct(mlcp_rows{}, rows, struct_size); }
void mlcp_rows_f32_init(mlcp_rows_f32* rows, size_t struct_size) { init_struct(mlcp_rows_f32{}, rows, struct_size); }

mlcp_status mlcp_problem_rows_add(mlcp_problem* problem, const mlcp_rows* rows, int32_t* first) {
  return edit(problem, [&](mlcp_problem& p) {
    set_if(first, rows_add(p.problem, import_struct("rows", rows, mlcp_rows{})));
  });
}

mlcp_status mlcp_problem_rows_add_f32(mlcp_problem* problem, const mlcp_rows_f32* rows, int32_t* first) {
  return edit(problem, [&](mlcp_problem& p) {
    set_if(first, rows_add(p.problem, import_struct("rows", rows, mlcp_rows_f32{})));
  });
}

mlcp_status mlcp_problem_row_add(mlcp_problem* problem, int32_t count, const int32_t* columns, const double* values, double r,
                                 double lo, double hi, double compliance, uint64_t key, int32_t* index) {
  return edit(problem, [&](mlcp_problem& p) {
    set_if(index, row_add(p.problem, count, columns, values, r, lo, hi, compliance, key));
  });
}

mlcp_status mlcp_problem_rows_add_csr(mlcp_problem* problem, int32_t count, const int32_t* row_pointers, const int32_t* columns,
                                      const double* values, const double* r, const double* lo, const double* hi,
                                      const double* compliance, const uint64_t* key, int32_t* first) {
  return edit(problem, [&](mlcp_problem& p) {
    set_if(first, rows_add_csr(p.problem, count, row_pointers, columns, values, {r, lo, hi, compliance, key}));
  });
}

mlcp_status mlcp_problem_rows_add_csc(mlcp_problem* problem, int32_t count, const int32_t* column_pointers,
                                      const int32_t* row_indices, const double* values, const double* r, const double* lo,
                                      const double* hi, const double* compliance, const uint64_t* key, int32_t* first) {
  return edit(problem, [&](mlcp_problem& p) {
    set_if(first, rows_add_csc(p.problem, count, column_pointers, row_indices, values, {r, lo, hi, compliance, key}));
  });
}

mlcp_status mlcp_problem_set_compliance_matrix(mlcp_problem* problem, int32_t count, const int32_t* column_pointers,
                                               const int32_t* row_indices, const double* values, mlcp_triangle triangle) {
  return edit(problem, [&](mlcp_problem& p) {
    set_compliance_matrix(p.problem, {count, column_pointers, row_indices, values, triangle});
  });
}

mlcp_status mlcp_problem_rows_set_r(mlcp_problem* problem, int32_t first, int32_t count, const double* r) {
  return edit(problem, [&](mlcp_problem& p) { rows_set_r(p.problem, first, count, r); });
}

mlcp_status mlcp_problem_rows_set_bounds(mlcp_problem* problem, int32_t first, int32_t count, const double* lo,
                                         const double* hi) {
  return edit(problem, [&](mlcp_problem& p) { rows_set_bounds(p.problem, first, count, lo, hi); });
}

mlcp_status mlcp_problem_rows_set_compliance(mlcp_problem* problem, int32_t first, int32_t count, const double* compliance) {
  return edit(problem, [&](mlcp_problem& p) { rows_set_compliance(p.problem, first, count, compliance); });
}

mlcp_status mlcp_problem_rows_set_keys(mlcp_problem* problem, int32_t first, int32_t count, const uint64_t* keys) {
  return edit(problem, [&](mlcp_problem& p) { rows_set_keys(p.problem, first, count, keys); });
}

mlcp_status mlcp_problem_row_set_jacobian(mlcp_problem* problem, int32_t row, const double* values, int32_t count) {
  return edit(problem, [&](mlcp_problem& p) { row_set_jacobian(p.problem, row, values, count); });
}

mlcp_status mlcp_problem_rows_remove(mlcp_problem* problem, int32_t count, const int32_t* rows) {
  return edit(problem, [&](mlcp_problem& p) { rows_remove(p.problem, count, rows); });
}

mlcp_status mlcp_problem_rows_clear(mlcp_problem* problem) {
  return edit(problem, [](mlcp_problem& p) { rows_clear(p.problem); });
}

// ------------------------------------------------------------------------------------------------------------ contacts

void mlcp_contacts_init(mlcp_contacts* contacts, size_t struct_size) {
  init_struct(default_contacts<mlcp_contacts>(), contacts, struct_size);
}
void mlcp_contacts_f32_init(mlcp_contacts_f32* contacts, size_t struct_size) {
  init_struct(default_contacts<mlcp_contacts_f32>(), contacts, struct_size);
}

mlcp_status mlcp_problem_contacts_add(mlcp_problem* problem, const mlcp_contacts* contacts, int32_t* first) {
  return edit(problem, [&](mlcp_problem& p) {
    set_if(first, contacts_add(p.problem, import_struct("contacts", contacts, default_contacts<mlcp_contacts>())));
  });
}

mlcp_status mlcp_problem_contacts_add_f32(mlcp_problem* problem, const mlcp_contacts_f32* contacts, int32_t* first) {
  return edit(problem, [&](mlcp_problem& p) {
    set_if(first, contacts_add(p.problem, import_struct("contacts", contacts, default_contacts<mlcp_contacts_f32>())));
  });
}

mlcp_status mlcp_problem_contacts_declare(mlcp_problem* problem, int32_t count, int32_t dimension, const int32_t* row,
                                          const mlcp_friction* model, const double* mu, const double* bound,
                                          const int32_t* facets) {
  return edit(problem, [&](mlcp_problem& p) { contacts_declare(p.problem, count, dimension, row, {model, mu, bound, facets}); });
}

mlcp_status mlcp_problem_contacts_set_friction(mlcp_problem* problem, int32_t first, int32_t count, const mlcp_friction* model,
                                               const double* mu, const double* bound, const int32_t* facets) {
  return edit(problem, [&](mlcp_problem& p) { contacts_set_friction(p.problem, first, count, {model, mu, bound, facets}); });
}

int32_t mlcp_problem_contact_count(const mlcp_problem* problem) {
  return problem ? static_cast<int32_t>(problem->problem.contacts.size()) : 0;
}

mlcp_status mlcp_problem_get_contacts(const mlcp_problem* problem, int32_t count, int32_t* row, int32_t* dimension,
                                      mlcp_friction* model, double* mu, int32_t* facets) {
  return look(problem, [&](const mlcp_problem& p) {
    check_length("count", count, mlcp_problem_contact_count(problem));
    for (int32_t c = 0; c < count; ++c) {
      const Contact& contact = p.problem.contacts[c];
      if (row) row[c] = contact.row;
      if (dimension) dimension[c] = contact.dimension;
      if (model) model[c] = contact.model;
      if (mu) mu[c] = contact.mu;
      if (facets) facets[c] = contact.facets;
    }
  });
}

mlcp_status mlcp_problem_rows_set_findex(mlcp_problem* problem, int32_t first, int32_t count, const int32_t* findex) {
  return edit(problem, [&](mlcp_problem& p) { rows_set_findex(p.problem, first, count, findex); });
}

mlcp_status mlcp_problem_get_findex(const mlcp_problem* problem, int32_t count, int32_t* findex) {
  return look(problem, [&](const mlcp_problem& p) {
    check_length("count", count, p.problem.m());
    check_array("findex", findex, count);
    for (int32_t i = 0; i < count; ++i) findex[i] = coupled_to(p.problem, i);
  });
}

// -------------------------------------------------------------------------------------------------------- reading back

mlcp_status mlcp_problem_get_momentum(const mlcp_problem* problem, int32_t count, double* k) {
  return look(problem, [&](const mlcp_problem& p) {
    check_length("count", count, p.problem.n());
    if (k) std::copy_n(p.problem.momentum.data(), count, k);
  });
}

mlcp_status mlcp_problem_get_rows(const mlcp_problem* problem, int32_t count, double* r, double* lo, double* hi,
                                  double* compliance, uint64_t* key) {
  return look(problem, [&](const mlcp_problem& p) {
    check_length("count", count, p.problem.m());
    if (r) std::copy_n(p.problem.r.data(), count, r);
    if (lo) std::copy_n(p.problem.lo.data(), count, lo);
    if (hi) std::copy_n(p.problem.hi.data(), count, hi);
    if (key) std::copy_n(p.problem.key.data(), count, key);
    for (int32_t i = 0; compliance && i < count; ++i) compliance[i] = p.problem.sigma(i);
  });
}

void mlcp_matrix_view_init(mlcp_matrix_view* view, size_t struct_size) { init_struct(mlcp_matrix_view{}, view, struct_size); }

mlcp_status mlcp_problem_mass(const mlcp_problem* problem, mlcp_matrix_view* mass) {
  return look(problem, [&](const mlcp_problem& p) { lend(p.problem.mass_view(), p.problem.n(), p.problem.n(), mass); });
}

mlcp_status mlcp_problem_jacobian(const mlcp_problem* problem, mlcp_matrix_view* jacobian) {
  return look(problem, [&](const mlcp_problem& p) { lend(p.problem.jacobian_view(), p.problem.m(), p.problem.n(), jacobian); });
}

mlcp_status mlcp_problem_compliance(const mlcp_problem* problem, mlcp_matrix_view* compliance) {
  return look(problem, [&](const mlcp_problem& p) {
    lend(p.problem.compliance_view(), p.problem.m(), p.problem.m(), compliance);
  });
}
