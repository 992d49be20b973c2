#pragma once
#include <cmath>
#include <cstdint>
#include <span>

#include "memory/error.h"

/// Checks of what callers hand in. Each one throws an Error that names the argument and the index, and allocates nothing.
namespace mlcp {

/// An argument in a text: its name, with the index of a part of it unless that is negative.
struct Argument {
  const char* name;
  std::int64_t index = -1;
};

/// Velocities and rows together are numbered by 32 bits in the factor.
void check_index_space(std::int64_t velocities, std::int64_t rows);
/// fails: RANGE, more entries than 32-bit pointers reach.
void check_entries(const char* what, std::int64_t entries);

void check_count(const char* name, std::int64_t count);
/// fails: NULL, when `count` > 0 and there is no array.
void check_array(const char* name, const void* array, std::int64_t count);
/// first .. first + count − 1 lies in 0 .. size − 1.
void check_range(std::int32_t first, std::int32_t count, std::int32_t size);
void check_length(const char* name, std::int64_t count, std::int64_t expected);
void check_finite(const char* name, const double* values, std::int64_t count, std::int64_t first = 0);

/// The pointers of a compressed matrix: start at 0 and never fall. Returns the number of entries.
std::int32_t check_pointers(const char* name, const std::int32_t* pointers, std::int32_t outer);

/// lo < +inf, hi > −inf, lo ≤ hi, no NaN; `index` is only for the text.
void check_bounds(double lo, double hi, std::int64_t index);
/// Finite, and not negative on a row with entries of J.
void check_compliance(double compliance, bool has_entries, std::int64_t index);

/// |a − b| ≤ 1e-12 max(√|aᵢᵢ|√|aⱼⱼ|, |a|, |b|): in a semidefinite matrix the first one is the largest, and a reduced problem
/// with a zero on its diagonal may still round its two triangles apart.
bool nearly_symmetric(double a, double b, double a_ii, double a_jj);
/// Half-way between two nearly equal numbers, without overflow; a itself when they are equal.
inline double middle(double a, double b) { return a == b ? a : a + 0.5 * (b - a); }

/// A dense mass, d × d: finite, symmetric, positive diagonal, no pivot of L D Lᵀ below −1e-12 Mⱼⱼ.
/// factor: d² doubles to work in.     cost: d³/6.
void check_dense_mass(const Argument& argument, const double* mass, std::int32_t d, double* factor);

}  // namespace mlcp
