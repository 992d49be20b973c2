#include "analyze/components.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "analyze/union_find.h"

namespace mlcp {

bool Components::covers(const Problem& problem, const Mask* enabled) const {
  if (!known_ || static_cast<std::int32_t>(enabled_.size()) != problem.m() || !prescribes_the_same(problem)) return false;
  for (std::int32_t i = 0; i < problem.m(); ++i)
    if (static_cast<bool>(enabled_[i]) != (!enabled || enabled->state[i] != MLCP_ROW_DISABLED)) return false;
  return pattern_.fits(problem);
}

/// Velocity by velocity: the bodies may be others than those of the last update, over the same patterns.
bool Components::prescribes_the_same(const Problem& problem) const {
  if (static_cast<std::int32_t>(fixed_.size()) != problem.n()) return false;
  return std::ranges::all_of(problem.bodies, [&](const Body& body) {
    // one sparse body may have all velocities of a scene
    return body.dimension == 0 ||
           std::memchr(fixed_.data() + body.offset, !body.prescribed, static_cast<std::size_t>(body.dimension)) == nullptr;
  });
}

bool Components::update(const Problem& problem, const Mask* enabled) {
  if (covers(problem, enabled)) return false;
  const bool same_masses = masses_stay(problem);
  known_ = false;
  fixed_.assign(problem.n(), 0);
  for (const Body& body : problem.bodies)
    if (body.prescribed) std::fill_n(fixed_.begin() + body.offset, body.dimension, std::uint8_t{1});
  enabled_.assign(problem.m(), 1);
  if (enabled)
    for (std::int32_t i = 0; i < problem.m(); ++i) enabled_[i] = enabled->state[i] != MLCP_ROW_DISABLED;
  set_free_apart(problem);
  if (!same_masses) join_masses(problem);
  join_rows(problem);
  std::swap(velocity_pointers, last_pointers_);
  std::swap(velocities, last_velocities_);
  sort(problem);
  if (!same_masses || !std::ranges::equal(velocity_pointers, last_pointers_) || !std::ranges::equal(velocities, last_velocities_)) ++mass_version_;
  pattern_.take(problem);
  return known_ = true;
}

/// What M joins is what it was at the last update.
bool Components::masses_stay(const Problem& problem) const { return known_ && prescribes_the_same(problem) && pattern_.fits_mass(problem); }

/// Most velocities of a scene may be free: what follows looks at the others alone.
void Components::set_free_apart(const Problem& problem) {
  const std::int32_t n = problem.n(), m = problem.m();
  const SparseView mass = problem.mass_view(), jacobian = problem.jacobian_view();
  touched_.assign(n, 0);
  for (std::int32_t i = 0; i < m; ++i)
    for (std::int32_t t = jacobian.pointers[i]; t < jacobian.pointers[i + 1] && enabled_[i]; ++t) touched_[jacobian.indices[t]] = 1;
  free_velocities.clear();
  coupled_.clear();
  coupled_.reserve(n);
  for (const Body& body : problem.bodies) {
    if (body.prescribed) continue;
    const std::int32_t first = body.offset, last = first + body.dimension;
    if (body.diagonal) {
      split(first, last);
      continue;
    }
    for (std::int32_t j = first; j < last; ++j) {
      const std::int32_t t = mass.pointers[j];
      // an entry alone may stand off the diagonal, as a zero
      if (!touched_[j] && mass.pointers[j + 1] - t == 1 && mass.indices[t] == j)
        free_velocities.add(j, j + 1);
      else
        coupled_.push_back(j);
    }
  }
}

/// Velocities of a diagonal mass: those that rows touch are coupled, runs between them are free.
void Components::split(std::int32_t first, std::int32_t last) {
  const std::uint8_t* const touched = touched_.data();
  const auto none_of_eight = [&](std::int32_t j) {
    std::uint64_t eight;
    std::memcpy(&eight, touched + j, sizeof eight);
    return eight == 0;
  };
  for (std::int32_t j = first; j < last;) {
    const std::int32_t begin = j;
    while (j + 8 <= last && none_of_eight(j)) j += 8;
    while (j < last && !touched[j]) ++j;
    if (j > begin) free_velocities.add(begin, j);
    for (; j < last && touched[j]; ++j) coupled_.push_back(j);
  }
}

/// Velocities that are in coupled_ at one time and not at another have a diagonal mass, which joins nothing.
void Components::join_masses(const Problem& problem) {
  const SparseView mass = problem.mass_view();
  start_sets(joined_, problem.n());
  for (const std::int32_t j : coupled_) {
    const Body& body = problem.bodies[problem.body_of[j]];
    // a robot's root moves all of it
    if (!body.sparse || mass.pointers[body.offset + 1] - mass.pointers[body.offset] == body.dimension)
      joined_[j] = body.offset;
    else
      for (std::int32_t t = mass.pointers[j]; t < mass.pointers[j + 1]; ++t)
        if (mass.indices[t] < j) join(joined_, j, mass.indices[t]);
  }
}

void Components::join_rows(const Problem& problem) {
  const std::int32_t n = problem.n(), m = problem.m();
  const SparseView jacobian = problem.jacobian_view(), sigma = problem.compliance_view();
  parent_.resize(n + m);
  std::copy(joined_.begin(), joined_.end(), parent_.begin());
  for (std::int32_t i = 0; i < m; ++i) parent_[n + i] = n + i;
  for (std::int32_t i = 0; i < m; ++i) {
    if (!enabled_[i]) continue;
    for (std::int32_t t = jacobian.pointers[i]; t < jacobian.pointers[i + 1]; ++t)
      if (!fixed_[jacobian.indices[t]]) join(parent_, n + i, jacobian.indices[t]);
    for (std::int32_t t = sigma.pointers[i]; t < sigma.pointers[i + 1]; ++t)
      if (enabled_[sigma.indices[t]]) join(parent_, n + i, n + sigma.indices[t]);
  }
}

/// Roots are the smallest members, so that a pass over the nodes meets each root first and components are in the order of those.
void Components::sort(const Problem& problem) {
  const std::int32_t n = problem.n(), m = problem.m();
  index_.resize(n + m);  // of a root: its component
  of_row.assign(m, -1);
  velocity_pointers.assign(1, 0);
  row_pointers.assign(1, 0);
  const auto component_of = [&](std::int32_t node) {
    const std::int32_t root = parent_[node] = root_of(parent_, node);
    if (root == node) {
      index_[root] = count();
      velocity_pointers.push_back(0);
      row_pointers.push_back(0);
    }
    return index_[root];
  };
  for (const std::int32_t j : coupled_) ++velocity_pointers[component_of(j) + 1];
  for (std::int32_t i = 0; i < m; ++i) {
    if (!enabled_[i]) continue;
    of_row[i] = component_of(n + i);
    ++row_pointers[of_row[i] + 1];
  }
  for (std::int32_t c = 0; c < count(); ++c) {
    velocity_pointers[c + 1] += velocity_pointers[c];
    row_pointers[c + 1] += row_pointers[c];
  }
  velocities.resize(velocity_pointers.back());
  rows.resize(row_pointers.back());
  // filled from behind, so that the pointers end where they were to begin
  for (std::int32_t c = count(); c > 0; --c) {
    velocity_pointers[c] = velocity_pointers[c - 1];
    row_pointers[c] = row_pointers[c - 1];
  }
  for (const std::int32_t j : coupled_) velocities[velocity_pointers[index_[parent_[j]] + 1]++] = j;
  for (std::int32_t i = 0; i < m; ++i)
    if (of_row[i] >= 0) rows[row_pointers[of_row[i] + 1]++] = i;
}

}  // namespace mlcp
