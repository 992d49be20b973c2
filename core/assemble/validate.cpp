#include "assemble/validate.h"

#include <algorithm>
#include <limits>

namespace mlcp {

namespace {

constexpr std::int64_t index_limit = std::numeric_limits<std::int32_t>::max();
constexpr double asymmetry_limit = 1e-12;
constexpr double pivot_limit = 1e-12;

struct Label {
  char text[48];
  explicit Label(const Argument& a) {
    if (a.index < 0)
      std::snprintf(text, sizeof text, "%s", a.name);
    else
      std::snprintf(text, sizeof text, "%s[%lld]", a.name, static_cast<long long>(a.index));
  }
};

void check_dense_values(const Argument& argument, const double* mass, std::int32_t d) {
  for (std::int32_t j = 0; j < d; ++j)
    for (std::int32_t i = 0; i < d; ++i)
      if (!std::isfinite(mass[std::size_t(j) * d + i]))
        throw Error(MLCP_ERROR_ARGUMENT, "%s: entry (%d, %d) = %g is not finite", Label(argument).text, j, i,
                    mass[std::size_t(j) * d + i]);
  for (std::int32_t j = 0; j < d; ++j)
    if (!(mass[std::size_t(j) * d + j] > 0))
      throw Error(MLCP_ERROR_ARGUMENT, "%s: diagonal entry %d = %.17g is not positive", Label(argument).text, j,
                  mass[std::size_t(j) * d + j]);
}

void check_dense_symmetry(const Argument& argument, const double* mass, std::int32_t d) {
  for (std::int32_t j = 0; j < d; ++j)
    for (std::int32_t i = j + 1; i < d; ++i) {
      const double a = mass[std::size_t(j) * d + i], b = mass[std::size_t(i) * d + j];
      if (!nearly_symmetric(a, b, mass[std::size_t(i) * d + i], mass[std::size_t(j) * d + j]))
        throw Error(MLCP_ERROR_ARGUMENT, "%s is not symmetric: entry (%d, %d) = %.17g, entry (%d, %d) = %.17g",
                    Label(argument).text, j, i, a, i, j, b);
    }
}

[[noreturn]] void refuse_pivot(const Argument& argument, std::int32_t j) {
  throw Error(MLCP_ERROR_ARGUMENT, "%s is not positive definite: pivot %d is negative", Label(argument).text, j);
}

/// A pivot that is zero to rounding is left out; in a semidefinite matrix its column is then below √pivot_limit of the
/// diagonals, and a larger entry is an indefinite 2 × 2 minor.
void check_zero_pivot(const Argument& argument, const double* factor, const double* mass, std::int32_t d, std::int32_t j) {
  const double scale_j = std::sqrt(mass[std::size_t(j) * d + j]);
  for (std::int32_t i = j + 1; i < d; ++i) {
    const double scale = scale_j * std::sqrt(mass[std::size_t(i) * d + i]);
    if (!(std::fabs(factor[std::size_t(j) * d + i]) <= 2 * std::sqrt(pivot_limit) * scale)) refuse_pivot(argument, j);
  }
}

}  // namespace

void check_index_space(std::int64_t velocities, std::int64_t rows) {
  if (velocities + rows > index_limit)
    throw Error(MLCP_ERROR_RANGE, "%lld velocities and %lld rows are more than 32-bit indices can number",
                static_cast<long long>(velocities), static_cast<long long>(rows));
}

void check_entries(const char* what, std::int64_t entries) {
  if (entries > index_limit)
    throw Error(MLCP_ERROR_RANGE, "%lld entries of %s are more than 32-bit pointers can reach", static_cast<long long>(entries),
                what);
}

void check_count(const char* name, std::int64_t count) {
  if (count < 0) throw Error(MLCP_ERROR_RANGE, "%s = %lld is negative", name, static_cast<long long>(count));
}

void check_array(const char* name, const void* array, std::int64_t count) {
  if (!array && count > 0) throw Error(MLCP_ERROR_NULL, "%s is NULL", name);
}

void check_range(std::int32_t first, std::int32_t count, std::int32_t size) {
  check_count("first", first);
  check_count("count", count);
  if (std::int64_t(first) + count > size)
    throw Error(MLCP_ERROR_RANGE, "first = %d, count = %d reach beyond the end, %d", first, count, size);
}

void check_length(const char* name, std::int64_t count, std::int64_t expected) {
  if (count != expected)
    throw Error(MLCP_ERROR_RANGE, "%s = %lld, but %lld are needed", name, static_cast<long long>(count),
                static_cast<long long>(expected));
}

void check_finite(const char* name, const double* values, std::int64_t count, std::int64_t first) {
  // x − x is 0 for what is finite and else not a number
  double probe[4] = {};
  std::int64_t i = 0;
  for (; i + 4 <= count; i += 4)
    for (int k = 0; k < 4; ++k) probe[k] += values[i + k] - values[i + k];
  for (; i < count; ++i) probe[0] += values[i] - values[i];
  if ((probe[0] + probe[1]) + (probe[2] + probe[3]) == 0) return;
  for (i = 0; i < count; ++i)
    if (!std::isfinite(values[i]))
      throw Error(MLCP_ERROR_ARGUMENT, "%s[%lld] = %g is not finite", name, static_cast<long long>(first + i), values[i]);
}

std::int32_t check_pointers(const char* name, const std::int32_t* pointers, std::int32_t outer) {
  if (outer == 0) return 0;
  check_array(name, pointers, outer);
  if (pointers[0] != 0) throw Error(MLCP_ERROR_ARGUMENT, "%s[0] = %d, but has to be 0", name, pointers[0]);
  for (std::int32_t j = 0; j < outer; ++j)
    if (pointers[j + 1] < pointers[j])
      throw Error(MLCP_ERROR_ARGUMENT, "%s[%d] = %d is below %s[%d] = %d", name, j + 1, pointers[j + 1], name, j, pointers[j]);
  return pointers[outer];
}

void check_bounds(double lo, double hi, std::int64_t index) {
  const auto i = static_cast<long long>(index);
  if (std::isnan(lo) || lo == std::numeric_limits<double>::infinity())
    throw Error(MLCP_ERROR_ARGUMENT, "lo[%lld] = %g is not a lower bound", i, lo);
  if (std::isnan(hi) || hi == -std::numeric_limits<double>::infinity())
    throw Error(MLCP_ERROR_ARGUMENT, "hi[%lld] = %g is not an upper bound", i, hi);
  if (lo > hi) throw Error(MLCP_ERROR_ARGUMENT, "lo[%lld] = %.17g is above hi[%lld] = %.17g", i, lo, i, hi);
}

void check_compliance(double compliance, bool has_entries, std::int64_t index) {
  if (!std::isfinite(compliance))
    throw Error(MLCP_ERROR_ARGUMENT, "compliance[%lld] = %g is not finite", static_cast<long long>(index), compliance);
  if (compliance < 0 && has_entries)
    throw Error(MLCP_ERROR_ARGUMENT, "compliance[%lld] = %.17g is negative", static_cast<long long>(index), compliance);
}

bool nearly_symmetric(double a, double b, double a_ii, double a_jj) {
  if (a == b) return true;
  const double scale = std::sqrt(std::fabs(a_ii)) * std::sqrt(std::fabs(a_jj));
  return std::fabs(a - b) <= asymmetry_limit * std::max(scale, std::max(std::fabs(a), std::fabs(b)));
}

void check_dense_mass(const Argument& argument, const double* mass, std::int32_t d, double* factor) {
  check_dense_values(argument, mass, d);
  check_dense_symmetry(argument, mass, d);
  // right-looking L D Lᵀ on the lower triangle of what will be stored, column j at factor + j d
  for (std::int32_t j = 0; j < d; ++j)
    for (std::int32_t i = j; i < d; ++i)
      factor[std::size_t(j) * d + i] = middle(mass[std::size_t(j) * d + i], mass[std::size_t(i) * d + j]);
  for (std::int32_t j = 0; j < d; ++j) {
    double* column = factor + std::size_t(j) * d;
    const double pivot = column[j], limit = pivot_limit * mass[std::size_t(j) * d + j];
    if (!(pivot >= -limit)) refuse_pivot(argument, j);
    if (pivot <= limit) {
      check_zero_pivot(argument, factor, mass, d, j);
      continue;
    }
    for (std::int32_t k = j + 1; k < d; ++k) {
      const double l = column[k] / pivot;
      if (l == 0) continue;
      for (std::int32_t i = k; i < d; ++i) factor[std::size_t(k) * d + i] -= l * column[i];
    }
  }
}

}  // namespace mlcp
