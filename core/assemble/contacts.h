#pragma once
#include "assemble/problem.h"

/// Contacts: a normal row and its tangent rows, with a model of friction. Every call: checks, then room, then changes; fails with
/// Error or bad_alloc, nothing changed.
namespace mlcp {

/// New rows between bodies, declared as contacts; struct_size has been looked at. Returns the first row.
std::int32_t contacts_add(Problem& problem, const mlcp_contacts& contacts);
std::int32_t contacts_add(Problem& problem, const mlcp_contacts_f32& contacts);

/// Arrays of `count` entries; NULL: the default of mlcp_contacts, or as it was for contacts that are there.
struct FrictionArrays {
  const mlcp_friction* model;
  const double *mu, *bound;
  const std::int32_t* facets;
};
/// Declares rows that are there: row[c] is the normal of contact c, its tangents follow.
void contacts_declare(Problem& problem, std::int32_t count, std::int32_t dimension, const std::int32_t* row,
                      const FrictionArrays& friction);
void contacts_set_friction(Problem& problem, std::int32_t first, std::int32_t count, const FrictionArrays& friction);

/// findex[i] ≥ 0: the bounds of row first + i are its lo and hi times the impulse of row findex[i]; −1: they are lo and hi.
void rows_set_findex(Problem& problem, std::int32_t first, std::int32_t count, const std::int32_t* findex);
/// The row whose impulse bounds this one, −1: none.      cost: O(log couplings).
std::int32_t coupled_to(const Problem& problem, std::int32_t row);

/// Renumbers or removes contacts and couplings with their rows. to: old row → new row or −1.
/// check: fails (STATE) when a contact would lose only some of its rows, or a coupled row its normal.
void check_contacts_renumber(const Problem& problem, std::span<const std::int32_t> to);
void contacts_renumber(Problem& problem, std::span<const std::int32_t> to);

}  // namespace mlcp
