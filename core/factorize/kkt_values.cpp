#include "factorize/kkt_values.h"

#include <cmath>

namespace mlcp {

void KktValues::load(const Problem& problem, const KktPattern& pattern) {
  const std::int32_t n = pattern.n, positions = pattern.size();
  const double* mass = problem.mass.values.data();
  const double* jacobian = problem.jacobian.values.data();
  const double* sigma = problem.compliance.values.data();
  const SparseView j = problem.jacobian_view();

  diagonal.resize(positions);
  b.resize(positions);
  size.resize(positions);
  for (std::int32_t p = 0; p < positions; ++p) {
    const std::int32_t s = pattern.diagonal_source[p];
    if (pattern.is_row(p)) {
      diagonal[p] = s < 0 ? 0.0 : -sigma[s];
    } else {
      diagonal[p] = s < 0 ? 0.0 : mass[s];
      b[p] = problem.momentum[pattern.node[p]];
      size[p] = std::abs(b[p]);
    }
  }
  factored.assign(diagonal.span());
  lower.resize(pattern.lower_rows.size());
  for (std::int32_t p = 0; p < positions; ++p) {
    const bool column_is_row = pattern.is_row(p);
    for (std::int32_t t = pattern.lower_pointers[p]; t < pattern.lower_pointers[p + 1]; ++t) {
      const std::int32_t s = pattern.lower_source[t];
      const bool row_is_row = pattern.is_row(pattern.lower_rows[t]);
      lower[t] = column_is_row != row_is_row ? jacobian[s] : row_is_row ? -sigma[s] : mass[s];
    }
  }

  const std::int32_t rows = pattern.rows();
  row.resize(pattern.row_columns.size());
  a.resize(rows);
  root_a.resize(rows);
  lo.resize(rows);
  hi.resize(rows);
  for (std::int32_t o = 0; o < rows; ++o) {
    const std::int32_t p = pattern.row_position[o], i = pattern.node[p] - n;
    double sum = -diagonal[p], terms = 0;
    for (std::int32_t t = pattern.row_pointers[o]; t < pattern.row_pointers[o + 1]; ++t) {
      const std::int32_t q = pattern.row_columns[t], s = pattern.row_source[t];
      if (pattern.is_row(q)) {
        row[t] = -sigma[s];
      } else {
        row[t] = jacobian[s];
        const double mass_of_q = diagonal[q] > 0 ? diagonal[q] : 1;  // as in Measure
        sum += (row[t] / mass_of_q) * row[t];
        terms += std::abs(row[t] * (b[q] / mass_of_q));
      }
    }
    a[o] = sum;
    root_a[o] = sum > 0 ? std::sqrt(sum) : 1;
    lo[o] = problem.lo[i];
    hi[o] = problem.hi[i];
    double r = problem.r[i];
    terms += std::abs(r);
    for (std::int32_t t = j.pointers[i]; t < j.pointers[i + 1]; ++t) {
      if (pattern.position[j.indices[t]] >= 0) continue;
      const double given = j.values[t] * problem.given_velocity[j.indices[t]];
      r -= given;
      terms += 2 * std::abs(given);  // v and v₀
    }
    b[p] = r;
    size[p] = terms;
  }
}

void KktValues::soften(const Problem& problem, const KktPattern& pattern, std::int32_t first, std::int32_t last, double amount) {
  for (std::int32_t o = first; o < last; ++o) {
    const std::int32_t p = pattern.row_position[o], s = pattern.diagonal_source[p];
    factored[p] = diagonal[p] = -((s < 0 ? 0.0 : problem.compliance.values[s]) + amount * a[o]);
  }
}

void KktValues::regularise(const KktPattern& pattern, const Island& island, double epsilon, double delta) {
  for (std::int32_t o = island.first_row; o < island.last_row; ++o) {
    const std::int32_t p = pattern.row_position[o];
    factored[p] = diagonal[p] - epsilon * a[o];
  }
  const double otherwise = delta > 0 ? largest_mass(pattern, island) : 0;
  for (std::int32_t p = island.first; p < island.last; ++p)
    if (!pattern.is_row(p)) factored[p] = diagonal[p] + delta * (diagonal[p] > 0 ? diagonal[p] : otherwise);
}

/// 1 where there is no mass at all.
double KktValues::largest_mass(const KktPattern& pattern, const Island& island) const {
  double largest = 0;
  for (std::int32_t p = island.first; p < island.last; ++p)
    if (!pattern.is_row(p)) largest = std::max(largest, diagonal[p]);
  return largest > 0 ? largest : 1;
}

void KktValues::add_proximal_mass(const KktPattern& pattern, const Island& island, double delta, const double* u) {
  regularise(pattern, island, 0, delta);
  for (std::int32_t p = island.first; p < island.last; ++p) {
    if (pattern.is_row(p)) continue;
    const double more = factored[p] - diagonal[p];
    diagonal[p] = factored[p];
    b[p] += more * u[p];
    size[p] += std::abs(more * u[p]);
  }
}

void KktValues::take_proximal_mass_away(const Problem& problem, const KktPattern& pattern, const Island& island) {
  for (std::int32_t p = island.first; p < island.last; ++p) {
    if (pattern.is_row(p)) continue;
    const std::int32_t s = pattern.diagonal_source[p];
    diagonal[p] = s < 0 ? 0.0 : problem.mass.values[s];
    b[p] = problem.momentum[pattern.node[p]];
    size[p] = std::abs(b[p]);
  }
}

void KktValues::measure_together(const KktPattern& pattern, std::span<const Island> islands, std::span<const std::int32_t> contact_of_row) {
  together.clear();
  if (contact_of_row.empty()) return;
  together.resize(pattern.rows());
  first_.assign(contact_of_row.size(), -1);
  for (const Island& island : islands)
    for (std::int32_t o = island.first_row; o < island.last_row; ++o) {
      const std::int32_t contact = contact_of_row[pattern.node[pattern.row_position[o]] - pattern.n];
      if (contact >= 0 && first_[contact] < island.first_row) first_[contact] = o;
      together[o] = contact >= 0 ? first_[contact] : o;
    }
}

}  // namespace mlcp
