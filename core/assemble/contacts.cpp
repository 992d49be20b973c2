#include "assemble/contacts.h"

#include "assemble/body_rows.h"
#include "assemble/validate.h"

namespace mlcp {

namespace {

/// What contacts of a call bring besides their rows.
struct FrictionFields {
  Integers<mlcp_friction> model;
  Integers<std::int32_t> facets;
  Numbers mu, bound;
};

struct Friction {
  mlcp_friction model;
  std::int32_t facets;
  double mu, bound;
};

void check_friction(const Friction& f, std::int32_t dimension, std::int32_t c) {
  if (f.model < MLCP_FRICTION_NONE || f.model > MLCP_FRICTION_FINDEX)
    throw Error(MLCP_ERROR_ARGUMENT, "model[%d] = %d is not a model of friction", c, f.model);
  if (!(f.mu >= 0) || !std::isfinite(f.mu)) throw Error(MLCP_ERROR_ARGUMENT, "mu[%d] = %g is not at least 0 and finite", c, f.mu);
  if (!(f.bound >= 0)) throw Error(MLCP_ERROR_ARGUMENT, "bound[%d] = %g is not at least 0", c, f.bound);
  if (f.facets < 0 || f.facets > most_facets || (dimension == 3 && (f.facets == 1 || f.facets == 2)))
    throw Error(MLCP_ERROR_ARGUMENT, "facets[%d] = %d: 0, or at least 3 and at most %d", c, f.facets, most_facets);
}

Friction friction_of(const FrictionFields& fields, std::int32_t c) {
  return {fields.model[c], fields.facets[c], fields.mu[c], fields.bound[c]};
}

void check_dimension(std::int32_t dimension) {
  if (dimension != 2 && dimension != 3) throw Error(MLCP_ERROR_ARGUMENT, "dimension = %d is neither 2 nor 3", dimension);
}

void check_no_overflow(double mu, double r, std::int32_t c) {
  if (!std::isfinite(mu * r)) throw Error(MLCP_ERROR_ARGUMENT, "mu[%d] = %g overflows", c, mu);
}

auto first_coupling(const Problem& problem, std::int32_t row) {
  return std::lower_bound(problem.couplings.begin(), problem.couplings.end(), row,
                          [](const Coupling& a, std::int32_t b) { return a.row < b; });
}

/// Room for that many more couplings.
void reserve_couplings(Problem& problem, std::size_t more) { problem.couplings.reserve(problem.couplings.size() + more); }

/// before: reserved. normal −1: uncoupled.
void couple(Problem& problem, std::int32_t row, std::int32_t normal) {
  Array<Coupling>& list = problem.couplings;
  const auto at = static_cast<std::size_t>(first_coupling(problem, row) - list.begin());
  const bool there = at < list.size() && list[at].row == row;
  if (normal >= 0) {
    if (!there) {
      list.push_back({row, normal});
      std::rotate(list.data() + at, list.end() - 1, list.end());
    }
    list[at] = {row, normal};
  } else if (there) {
    std::copy(list.data() + at + 1, list.data() + list.size(), list.data() + at);
    list.pop_back();
  }
}

/// What the model asks of the rows. before: room for dimension − 1 couplings.
void apply(Problem& problem, const Contact& contact, double bound) {
  for (std::int32_t row = contact.row + 1; row < contact.row + contact.dimension; ++row) {
    const bool follows = contact.model == MLCP_FRICTION_FINDEX;
    const double limit = follows ? contact.mu : contact.model == MLCP_FRICTION_BOX ? bound : infinity;
    couple(problem, row, follows ? contact.row : -1);
    problem.lo[row] = -limit;
    problem.hi[row] = limit;
  }
}

void append(Problem& problem, const FrictionFields& fields, std::int32_t c, std::int32_t dimension, std::int32_t row) {
  const Friction f = friction_of(fields, c);
  const Contact contact{row, dimension, f.model, f.facets, f.mu};
  problem.contacts.push_back(contact);
  apply(problem, contact, f.bound);
}

template <class Contacts>
std::int32_t add(Problem& problem, const Contacts& c) {
  check_count("count", c.count);
  check_dimension(c.dimension);
  const std::int32_t d = c.dimension;
  check_index_space(problem.n(), problem.m() + std::int64_t(c.count) * d);
  const FrictionFields fields{integers(c.model, mlcp_friction(MLCP_FRICTION_COULOMB), c.choice_stride),
                              integers(c.facets, 0, c.choice_stride), numbers(c.mu, 0, c.value_stride),
                              numbers(c.bound, infinity, c.value_stride)};
  const BodyRows rows{c.count * d,
                      body_side("body_a", "jacobian_a", c.body_a, c.body_stride, c.jacobian_a, c.jacobian_a_stride, d),
                      body_side("body_b", "jacobian_b", c.body_b, c.body_stride, c.jacobian_b, c.jacobian_b_stride, d),
                      {numbers(c.r, 0, c.vector_stride, d), numbers(static_cast<const double*>(nullptr), 0),
                       numbers(static_cast<const double*>(nullptr), infinity), numbers(c.compliance, 0, c.vector_stride, d),
                       integers(c.key, std::uint64_t(0), c.key_stride, d)}};
  for (std::int32_t i = 0; i < c.count; ++i) {
    check_friction(friction_of(fields, i), d, i);
    for (std::int32_t t = 1; t < d; ++t) check_no_overflow(fields.mu[i], rows.fields.r[std::int64_t(i) * d + t], i);
  }
  problem.contacts.reserve(problem.contacts.size() + c.count);
  reserve_couplings(problem, std::size_t(c.count) * (d - 1));
  const std::int32_t first = body_rows_add(problem, rows);
  for (std::int32_t i = 0; i < c.count; ++i) append(problem, fields, i, d, first + i * d);
  return first;
}

/// work.marker: rows that belong to contacts.
void mark_rows(Problem& problem) {
  problem.work.marker.start(problem.m());
  for (const Contact& contact : problem.contacts)
    for (std::int32_t t = 0; t < contact.dimension; ++t) problem.work.marker.insert(contact.row + t);
}

}  // namespace

std::int32_t contacts_add(Problem& problem, const mlcp_contacts& contacts) { return add(problem, contacts); }
std::int32_t contacts_add(Problem& problem, const mlcp_contacts_f32& contacts) { return add(problem, contacts); }

void contacts_declare(Problem& problem, std::int32_t count, std::int32_t dimension, const std::int32_t* row,
                      const FrictionArrays& friction) {
  check_count("count", count);
  check_dimension(dimension);
  check_array("row", row, count);
  const FrictionFields fields{integers(friction.model, mlcp_friction(MLCP_FRICTION_COULOMB)), integers(friction.facets, 0),
                              numbers(friction.mu, 0), numbers(friction.bound, infinity)};
  mark_rows(problem);
  for (std::int32_t c = 0; c < count; ++c) {
    check_friction(friction_of(fields, c), dimension, c);
    if (row[c] < 0 || std::int64_t(row[c]) + dimension > problem.m())
      throw Error(MLCP_ERROR_RANGE, "row[%d] = %d: it and the %d rows behind it are not all among %d rows", c, row[c], dimension - 1,
                  problem.m());
    if (problem.lo[row[c]] != 0 || problem.hi[row[c]] != infinity)
      throw Error(MLCP_ERROR_ARGUMENT, "row[%d] = %d: a normal row has the bounds 0 and infinity", c, row[c]);
    for (std::int32_t t = 0; t < dimension; ++t)
      if (!problem.work.marker.insert(row[c] + t))
        throw Error(MLCP_ERROR_ARGUMENT, "row[%d] = %d: row %d belongs to another contact", c, row[c], row[c] + t);
    for (std::int32_t t = 1; t < dimension; ++t) check_no_overflow(fields.mu[c], problem.r[row[c] + t], c);
  }
  problem.contacts.reserve(problem.contacts.size() + count);
  reserve_couplings(problem, std::size_t(count) * (dimension - 1));
  for (std::int32_t c = 0; c < count; ++c) append(problem, fields, c, dimension, row[c]);
}

void contacts_set_friction(Problem& problem, std::int32_t first, std::int32_t count, const FrictionArrays& friction) {
  check_range(first, count, static_cast<std::int32_t>(problem.contacts.size()));
  const auto wanted = [&](std::int32_t i) {
    const Contact& c = problem.contacts[first + i];
    const double bound = c.model == MLCP_FRICTION_BOX ? problem.hi[c.row + 1] : infinity;
    return Friction{friction.model ? friction.model[i] : c.model, friction.facets ? friction.facets[i] : c.facets,
                    friction.mu ? friction.mu[i] : c.mu, friction.bound ? friction.bound[i] : bound};
  };
  std::size_t more = 0;
  for (std::int32_t i = 0; i < count; ++i) {
    const Contact& c = problem.contacts[first + i];
    check_friction(wanted(i), c.dimension, i);
    for (std::int32_t t = 1; t < c.dimension; ++t) check_no_overflow(wanted(i).mu, problem.r[c.row + t], i);
    more += c.dimension - 1;
  }
  reserve_couplings(problem, more);
  for (std::int32_t i = 0; i < count; ++i) {
    Contact& c = problem.contacts[first + i];
    const Friction f = wanted(i);
    c = {c.row, c.dimension, f.model, f.facets, f.mu};
    apply(problem, c, f.bound);
  }
}

void rows_set_findex(Problem& problem, std::int32_t first, std::int32_t count, const std::int32_t* findex) {
  check_range(first, count, problem.m());
  check_array("findex", findex, count);
  mark_rows(problem);
  const auto will_be_coupled = [&](std::int32_t row) {
    return row >= first && row < first + count ? findex[row - first] >= 0 : coupled_to(problem, row) >= 0;
  };
  for (std::int32_t i = 0; i < count; ++i) {
    const std::int32_t row = first + i;
    if (problem.work.marker.contains(row) && findex[i] != coupled_to(problem, row))
      throw Error(MLCP_ERROR_ARGUMENT, "findex[%d]: row %d belongs to a contact, whose model tells its bounds", i, row);
    if (findex[i] < -1 || findex[i] >= problem.m() || findex[i] == row)
      throw Error(MLCP_ERROR_RANGE, "findex[%d] = %d is neither -1 nor another one of %d rows", i, findex[i], problem.m());
    if (findex[i] < 0) continue;
    if (will_be_coupled(findex[i]))
      throw Error(MLCP_ERROR_ARGUMENT, "findex[%d] = %d: that row's bounds follow another one themselves", i, findex[i]);
    if (!(problem.lo[row] <= 0 && problem.hi[row] >= 0) || !std::isfinite(problem.lo[row]) || !std::isfinite(problem.hi[row]))
      throw Error(MLCP_ERROR_ARGUMENT, "findex[%d]: lo = %g and hi = %g of row %d are not finite factors with 0 between them", i,
                  problem.lo[row], problem.hi[row], row);
  }
  for (const Coupling& c : problem.couplings)
    if (c.normal >= first && c.normal < first + count && findex[c.normal - first] >= 0 &&
        !(c.row >= first && c.row < first + count))
      throw Error(MLCP_ERROR_ARGUMENT, "findex[%d]: the bounds of row %d follow this one", c.normal - first, c.row);
  reserve_couplings(problem, count);
  for (std::int32_t i = 0; i < count; ++i) couple(problem, first + i, findex[i]);
}

std::int32_t coupled_to(const Problem& problem, std::int32_t row) {
  const Coupling* at = first_coupling(problem, row);
  return at != problem.couplings.end() && at->row == row ? at->normal : -1;
}

void check_contacts_renumber(const Problem& problem, std::span<const std::int32_t> to) {
  for (std::size_t c = 0; c < problem.contacts.size(); ++c)
    for (std::int32_t t = 1; t < problem.contacts[c].dimension; ++t)
      if ((to[problem.contacts[c].row + t] < 0) != (to[problem.contacts[c].row] < 0))
        throw Error(MLCP_ERROR_STATE, "rows: contact %zu would lose only some of its rows %d .. %d", c, problem.contacts[c].row,
                    problem.contacts[c].row + problem.contacts[c].dimension - 1);
  for (const Coupling& c : problem.couplings)
    if (to[c.normal] < 0 && to[c.row] >= 0)
      throw Error(MLCP_ERROR_STATE, "rows: %d bounds row %d, which would stay", c.normal, c.row);
}

void contacts_renumber(Problem& problem, std::span<const std::int32_t> to) {
  std::size_t left = 0;
  for (const Contact& contact : problem.contacts) {
    if (to[contact.row] < 0) continue;
    problem.contacts[left] = contact;
    problem.contacts[left++].row = to[contact.row];
  }
  problem.contacts.resize(left);
  left = 0;
  for (const Coupling& c : problem.couplings)
    if (to[c.row] >= 0) problem.couplings[left++] = {to[c.row], to[c.normal]};
  problem.couplings.resize(left);
}

}  // namespace mlcp
