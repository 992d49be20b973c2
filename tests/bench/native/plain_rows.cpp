#include "plain_rows.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "scenes/handles.h"

namespace bench {
namespace {

using handles::check;

/// What the library reads back of rows and contacts.
class Source {
 public:
  explicit Source(const mlcp_problem* problem) {
    mlcp_matrix_view_init(&jacobian_, sizeof jacobian_);
    check(mlcp_problem_jacobian(problem, &jacobian_));
    const std::int32_t m = mlcp_problem_row_count(problem), count = mlcp_problem_contact_count(problem);
    for (auto* array : {&r, &lo, &hi, &compliance}) array->resize(static_cast<std::size_t>(m));
    key.resize(r.size());
    check(mlcp_problem_get_rows(problem, m, r.data(), lo.data(), hi.data(), compliance.data(), key.data()));
    normal.resize(static_cast<std::size_t>(count));
    dimension.resize(normal.size());
    model.resize(normal.size());
    mu.resize(normal.size());
    check(mlcp_problem_get_contacts(problem, count, normal.data(), dimension.data(), model.data(), mu.data(), nullptr));
  }

  struct Entry {
    std::int32_t column;
    double value;
  };
  /// Adds `factor` times row i.
  void add(std::int32_t i, double factor, std::vector<Entry>& to) const {
    for (std::int32_t e = jacobian_.pointers[i]; e < jacobian_.pointers[i + 1]; ++e) to.push_back({jacobian_.indices[e], factor * jacobian_.values[e]});
  }

  std::vector<double> r, lo, hi, compliance, mu;
  std::vector<std::uint64_t> key;
  std::vector<std::int32_t> normal, dimension;
  std::vector<mlcp_friction> model;

 private:
  mlcp_matrix_view jacobian_;
};

using Entries = std::vector<Source::Entry>;

/// One entry a column, as they came first.
void merge(Entries& entries) {
  std::stable_sort(entries.begin(), entries.end(), [](const auto& a, const auto& b) { return a.column < b.column; });
  Entries merged;
  for (const auto& [column, value] : entries) {
    if (!merged.empty() && merged.back().column == column)
      merged.back().value += value;
    else
      merged.push_back({column, value});
  }
  entries = std::move(merged);
}

void append(PlainRows& to, const Entries& entries, std::span<const Velocity> velocity, double r, double lo, double hi, double compliance, std::uint64_t key,
            std::int32_t source) {
  for (const auto& [column, value] : entries) {
    const auto [number, given] = velocity[column];
    if (number < 0) {
      r -= value * given;
      continue;
    }
    to.columns.push_back(number);
    to.values.push_back(value);
  }
  to.pointers.push_back(static_cast<std::int32_t>(to.columns.size()));
  to.r.push_back(r);
  to.lo.push_back(lo);
  to.hi.push_back(hi);
  to.compliance.push_back(compliance);
  to.key.push_back(key);
  to.source.push_back(source);
}

void append_row(PlainRows& to, const Source& from, std::int32_t i, std::span<const Velocity> velocity) {
  Entries entries;
  from.add(i, 1, entries);
  append(to, entries, velocity, from.r[i], from.lo[i], from.hi[i], from.compliance[i], from.key[i], i);
}

/// A row n + µ (t₁ cos θ + t₂ sin θ) a facet.
void append_pyramid(PlainRows& to, const Source& from, std::size_t contact, std::span<const Velocity> velocity, std::int32_t facets) {
  const std::int32_t first = from.normal[contact], dimension = from.dimension[contact], count = dimension == 2 ? 2 : facets;
  std::vector<std::array<double, 3>> weights;  // of normal and tangents
  for (std::int32_t k = 0; k < count; ++k) {
    const double angle = 2 * std::numbers::pi * k / count;
    weights.push_back({1, from.mu[contact] * (dimension == 2 ? 1 - 2 * k : std::cos(angle)), dimension == 2 ? 0 : from.mu[contact] * std::sin(angle)});
  }
  PlainRows::Block block{static_cast<std::int32_t>(to.r.size()), count, {}};
  const std::span<const double> compliance(from.compliance.data() + first, static_cast<std::size_t>(dimension));
  const auto sigma = [&](std::int32_t k, std::int32_t l) {
    double sum = 0;
    for (std::int32_t t = 0; t < dimension; ++t) sum += weights[k][t] * weights[l][t] * compliance[t];
    return sum;
  };
  for (std::int32_t k = 0; k < count; ++k) {
    Entries entries;
    double r = 0;
    for (std::int32_t t = 0; t < dimension; ++t) {
      from.add(first + t, weights[k][t], entries);
      r += weights[k][t] * from.r[first + t];
    }
    merge(entries);
    // of its own, and not 0, which stands for none
    const std::uint64_t key = from.key[first] == 0 ? 0 : (from.key[first] ^ (static_cast<std::uint64_t>(k + 1) * 0x9e3779b97f4a7c15u)) | 1;
    append(to, entries, velocity, r, 0, std::numeric_limits<double>::infinity(), sigma(k, k), key, -1);
    for (std::int32_t l = 0; l < count; ++l) block.sigma.push_back(sigma(k, l));
  }
  if (std::ranges::any_of(compliance, [](double c) { return c != 0; })) to.compliant.push_back(std::move(block));
}

}  // namespace

PlainRows::PlainRows(const mlcp_problem* problem, std::span<const Velocity> velocity, std::int32_t facets) {
  const Source from(problem);
  const auto m = static_cast<std::int32_t>(from.r.size());
  std::vector<std::int32_t> contact_of(from.r.size(), -1);
  for (std::size_t c = 0; c < from.normal.size(); ++c) std::fill_n(contact_of.begin() + from.normal[c], from.dimension[c], static_cast<std::int32_t>(c));
  for (std::int32_t i = 0; i < m; ++i) {
    const std::int32_t c = contact_of[i];
    if (c < 0) {
      append_row(*this, from, i, velocity);
      continue;
    }
    const std::int32_t first = from.normal[c];
    const bool boxed = from.model[c] == MLCP_FRICTION_BOX, rubs = facets > 0 && from.model[c] != MLCP_FRICTION_NONE && (boxed || from.mu[c] > 0);
    if (rubs && from.model[c] == MLCP_FRICTION_FINDEX) throw std::runtime_error("bounds that hang on impulses are not benchmarked");
    if (rubs && !boxed) {
      if (i == first) append_pyramid(*this, from, static_cast<std::size_t>(c), velocity, facets);
    } else if (rubs || i == first) {
      append_row(*this, from, i, velocity);
    }
  }
}

}  // namespace bench
