#include "analyze/kkt_pattern.h"

namespace mlcp {

namespace {

/// Entries begin .. end − 1 by index, those of nearly sorted rows and columns.
void sort_entries(Array<std::int32_t>& index, Array<std::int32_t>& source, std::int32_t begin, std::int32_t end) {
  for (std::int32_t t = begin + 1; t < end; ++t) {
    const std::int32_t i = index[t], from = source[t];
    std::int32_t s = t;
    for (; s > begin && index[s - 1] > i; --s) {
      index[s] = index[s - 1];
      source[s] = source[s - 1];
    }
    index[s] = i;
    source[s] = from;
  }
}

}  // namespace

void KktPattern::build(const Problem& problem, std::span<const std::int32_t> order) {
  const SparseView mass = problem.mass_view(), jacobian = problem.jacobian_view(), sigma = problem.compliance_view();
  n = problem.n();
  const auto size = static_cast<std::int32_t>(order.size());
  node.assign(order);
  position.assign(n + problem.m(), -1);
  row_position.clear();
  row_ordinal.assign(size, -1);
  for (std::int32_t p = 0; p < size; ++p) {
    position[node[p]] = p;
    if (!is_row(p)) continue;
    row_ordinal[p] = static_cast<std::int32_t>(row_position.size());
    row_position.push_back(p);
  }

  row_pointers.clear();
  row_columns.clear();
  row_source.clear();
  diagonal_source.assign(size, -1);
  row_pointers.push_back(0);
  bool mixed = false;  // such a row is coupled to others by Σ, whose entries come among those of velocities
  for (const std::int32_t p : row_position) {
    const std::int32_t i = node[p] - n;
    bool early = false;
    for (std::int32_t t = jacobian.pointers[i]; t < jacobian.pointers[i + 1]; ++t) {
      const std::int32_t q = position[jacobian.indices[t]];
      if (q < 0) continue;
      row_columns.push_back(q);
      row_source.push_back(t);
      early |= q > p;
    }
    // a row that comes before its velocities is a column of L as it stands
    if (early) sort_entries(row_columns, row_source, row_pointers.back(), static_cast<std::int32_t>(row_columns.size()));
    for (std::int32_t t = sigma.pointers[i]; t < sigma.pointers[i + 1]; ++t) {
      const std::int32_t q = position[n + sigma.indices[t]];
      if (q == p) diagonal_source[p] = t;
      if (q < 0 || q == p) continue;
      row_columns.push_back(q);
      row_source.push_back(t);
      mixed |= early;
    }
    row_pointers.push_back(static_cast<std::int32_t>(row_columns.size()));
  }

  // each off-diagonal pair once: visit(column, row, source) with column < row
  const auto for_each_pair = [&](auto visit) {
    for (std::int32_t p = 0; p < size; ++p) {
      if (is_row(p)) {
        const std::int32_t o = row_ordinal[p];
        for (std::int32_t t = row_pointers[o]; t < row_pointers[o + 1]; ++t) {
          const std::int32_t q = row_columns[t];
          if (is_row(q) && q > p) continue;  // Σ stores both triangles
          visit(std::min(p, q), std::max(p, q), row_source[t]);
        }
      } else {
        const std::int32_t j = node[p];
        for (std::int32_t t = mass.pointers[j]; t < mass.pointers[j + 1]; ++t) {
          const std::int32_t q = position[mass.indices[t]];
          if (q == p) diagonal_source[p] = t;
          if (q < p && q >= 0) visit(q, p, t);
        }
      }
    }
  };
  lower_pointers.assign(size + 1, 0);
  upper_pointers.assign(size + 1, 0);
  for_each_pair([&](std::int32_t column, std::int32_t row, std::int32_t) {
    ++lower_pointers[column + 1];
    ++upper_pointers[row + 1];
  });
  for (std::int32_t p = 0; p < size; ++p) {
    lower_pointers[p + 1] += lower_pointers[p];
    upper_pointers[p + 1] += upper_pointers[p];
  }
  lower_rows.resize(lower_pointers[size]);
  lower_source.resize(lower_pointers[size]);
  upper_rows.resize(upper_pointers[size]);
  scratch_.assign(lower_pointers.span().first(size));
  scratch_.resize(2 * size);
  std::copy(upper_pointers.begin(), upper_pointers.begin() + size, scratch_.begin() + size);
  for_each_pair([&](std::int32_t column, std::int32_t row, std::int32_t source) {
    const std::int32_t t = scratch_[column]++;
    lower_rows[t] = row;
    lower_source[t] = source;
    upper_rows[scratch_[size + row]++] = column;
  });
  for (const std::int32_t p : row_position)
    if (mixed) sort_entries(lower_rows, lower_source, lower_pointers[p], lower_pointers[p + 1]);
}

}  // namespace mlcp
