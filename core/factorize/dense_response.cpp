#include "factorize/dense_response.h"

#include <algorithm>

namespace mlcp {
namespace {

std::int64_t triangle(std::int64_t size) { return size * (size - 1) / 2; }

std::int64_t real_count(std::int64_t n, std::int64_t m) { return triangle(n) + 3 * n + m * n + m * m + triangle(m) + 6 * m + n + m; }
std::int64_t integer_count(std::int64_t n, std::int64_t m) { return n + 4 * m; }

}  // namespace

void DenseResponse::prepare(const Problem& problem, const Components& components) {
  components_ = &components;
  const std::int32_t n = problem.n(), count = components.count();
  places_.resize(count);
  local_.assign(n + problem.m(), -1);
  std::int64_t reals = 0, integers = 0;
  for (std::int32_t c = 0; c < count; ++c) {
    places_[c] = {reals, integers, components.row_pointers[c]};
    const std::int32_t own_n = components.velocity_count(c), own_m = components.row_count(c);
    reals += real_count(own_n, own_m);
    integers += integer_count(own_n, own_m);
    for (std::int32_t p = 0; p < own_n; ++p) local_[components.velocities[components.velocity_pointers[c] + p]] = own_n - 1 - p;
    for (std::int32_t i = 0; i < own_m; ++i) local_[n + components.rows[components.row_pointers[c] + i]] = i;
  }
  reals_.resize(reals);
  integers_.resize(integers);
  states_.resize(components.rows.size());
  members_.resize(count);
  for (std::int32_t c = 0; c < count; ++c) {
    DenseIsland s = island(c);
    find_envelopes(problem, s);
  }
}

DenseIsland DenseResponse::island(std::int32_t c) {
  const Place& place = places_[c];
  double* real = reals_.data() + place.reals;
  std::int32_t* integer = integers_.data() + place.integers;
  const auto take = [](auto*& from, std::int64_t count) {
    const auto part = from;
    from += count;
    return part;
  };
  DenseIsland s{};
  s.members = members_.data() + c;
  const std::int64_t n = s.n = components_->velocity_count(c), m = s.m = components_->row_count(c);
  s.ascending = components_->velocities.data() + components_->velocity_pointers[c];
  s.row = components_->rows.data() + components_->row_pointers[c];
  s.mass.lower = take(real, triangle(n));
  s.mass.inverse = take(real, n);
  s.diagonal = take(real, n);
  s.k = take(real, n);
  s.y = take(real, m * n);
  s.a = take(real, m * m);
  s.active.lower = take(real, triangle(m));
  for (double** part : {&s.active.inverse, &s.b, &s.size, &s.lo, &s.hi, &s.gamma}) *part = take(real, m);
  s.x = take(real, n + m);
  s.mass.first = take(integer, n);
  for (std::int32_t** part : {&s.begin, &s.end, &s.active.first, &s.member}) *part = take(integer, m);
  s.state = states_.data() + place.rows;
  return s;
}

void DenseResponse::find_envelopes(const Problem& problem, DenseIsland& s) {
  const SparseView mass = problem.mass_view(), jacobian = problem.jacobian_view();
  for (std::int32_t p = 0; p < s.n; ++p) {
    const std::int32_t j = s.velocity(p);
    std::int32_t first = p;
    for (std::int32_t t = mass.pointers[j]; t < mass.pointers[j + 1]; ++t) first = std::min(first, local_[mass.indices[t]]);
    s.mass.first[p] = first;
  }
  for (std::int32_t i = 0; i < s.m; ++i) {
    s.begin[i] = s.n;
    for (std::int32_t t = jacobian.pointers[s.row[i]]; t < jacobian.pointers[s.row[i] + 1]; ++t)
      if (const std::int32_t p = local_[jacobian.indices[t]]; p >= 0) s.begin[i] = std::min(s.begin[i], p);
  }
}

bool DenseResponse::compute(const Problem& problem, std::int32_t c) {
  DenseIsland s = island(c);
  if (!load_mass(problem, s)) return false;
  for (std::int32_t i = 0; i < s.m; ++i) {
    load_row(problem, s, i);
    respond(s, i);
  }
  const SparseView sigma = problem.compliance_view();
  for (std::int32_t i = 0; i < s.m; ++i) {
    for (std::int32_t t = sigma.pointers[s.row[i]]; t < sigma.pointers[s.row[i] + 1]; ++t)
      if (const std::int32_t j = local_[problem.n() + sigma.indices[t]]; j >= 0) s.a[static_cast<std::int64_t>(i) * s.m + j] += sigma.values[t];
    if (!(s.response(i, i) >= 0)) return false;
  }
  return true;
}

bool DenseResponse::load_mass(const Problem& problem, DenseIsland& s) {
  const SparseView mass = problem.mass_view();
  for (std::int32_t p = 0; p < s.n; ++p) {
    const std::int32_t j = s.velocity(p);
    double* row = s.mass.row(p);
    std::fill(row + s.mass.first[p], row + p, 0.0);
    double diagonal = 0;
    for (std::int32_t t = mass.pointers[j]; t < mass.pointers[j + 1]; ++t) {
      const std::int32_t q = local_[mass.indices[t]];
      if (q < p) row[q] = mass.values[t];
      if (q == p) diagonal = mass.values[t];
    }
    s.diagonal[p] = diagonal;
    s.k[p] = problem.momentum[j];
    if (!(s.mass.eliminate(p, diagonal) > 0)) return false;
  }
  s.mass.forward(0, s.n, s.k);
  return true;
}

/// Row i of J into y; what it has from prescribed velocities goes into r, and that into b.
void DenseResponse::load_row(const Problem& problem, DenseIsland& s, std::int32_t i) {
  const SparseView jacobian = problem.jacobian_view();
  const std::int32_t row = s.row[i];
  double* y = s.y + static_cast<std::int64_t>(i) * s.n;
  double r = problem.r[row], size = std::abs(r);
  if (s.begin[i] < s.n) std::fill(y + s.begin[i], y + s.n, 0.0);
  for (std::int32_t t = jacobian.pointers[row]; t < jacobian.pointers[row + 1]; ++t) {
    const std::int32_t j = jacobian.indices[t], p = local_[j];
    if (p >= 0) {
      y[p] = jacobian.values[t];
      size += std::abs(jacobian.values[t] * (problem.momentum[j] / s.diagonal[p]));
    } else {
      const double given = jacobian.values[t] * problem.given_velocity[j];
      r -= given;
      size += 2 * std::abs(given);
    }
  }
  s.b[i] = -r;
  s.size[i] = size;
  s.lo[i] = problem.lo[row];
  s.hi[i] = problem.hi[row];
}

/// y := L⁻¹ y, and with it row i of A and bᵢ.
void DenseResponse::respond(DenseIsland& s, std::int32_t i) {
  double* y = s.y + static_cast<std::int64_t>(i) * s.n;
  const std::int32_t begin = s.begin[i];
  std::int32_t end = begin;  // behind what is not 0 so far: in a robot, the joints of other limbs end before their own begin
  for (std::int32_t p = begin; p < s.n; ++p) {
    const std::int32_t from = std::max(s.mass.first[p], begin);
    if (from < end) y[p] -= dot(s.mass.row(p) + from, y + from, end - from);
    if (y[p] != 0) end = p + 1;
  }
  s.end[i] = end;
  for (std::int32_t p = begin; p < end; ++p) s.x[p] = y[p] * s.mass.inverse[p];
  double* a = s.a + static_cast<std::int64_t>(i) * s.m;
  for (std::int32_t j = 0; j <= i; ++j) {
    const std::int32_t from = std::max(begin, s.begin[j]), to = std::min(end, s.end[j]);
    const double sum = from < to ? dot(s.x + from, s.y + static_cast<std::int64_t>(j) * s.n + from, to - from) : 0.0;
    a[j] = s.a[static_cast<std::int64_t>(j) * s.m + i] = sum;
  }
  if (begin < end) s.b[i] += dot(s.x + begin, s.k + begin, end - begin);
}

void DenseResponse::factor_active(DenseIsland& s, double drop) {
  std::int32_t kept = 0;
  for (std::int32_t t = 0; t < *s.members; ++t) {
    const std::int32_t i = s.member[t];
    double* row = s.active.row(kept);
    std::int32_t begin = kept;
    for (std::int32_t q = kept; q-- > 0;) {
      row[q] = s.response(i, s.member[q]);
      if (row[q] != 0) begin = q;
    }
    s.active.first[kept] = begin;
    if (s.active.eliminate(kept, s.response(i, i)) > drop * s.response(i, i)) s.member[kept++] = i;
  }
  *s.members = kept;
}

void DenseResponse::solve_active(DenseIsland& s) {
  double* x = s.x + s.n;
  for (std::int32_t t = 0; t < *s.members; ++t) x[t] = -s.b[s.member[t]];
  for (std::int32_t j = 0; j < s.m; ++j) {
    if (s.gamma[j] == 0) continue;
    for (std::int32_t t = 0; t < *s.members; ++t) x[t] -= s.response(s.member[t], j) * s.gamma[j];
  }
  s.active.forward(0, *s.members, x);
  for (std::int32_t t = 0; t < *s.members; ++t) x[t] *= s.active.inverse[t];
  s.active.backward(*s.members, x);
  for (std::int32_t t = 0; t < *s.members; ++t) s.gamma[s.member[t]] = x[t];
}

double DenseResponse::schur(const DenseIsland& s, std::int32_t i) {
  double *x = s.x, pivot = s.response(i, i);
  for (std::int32_t t = 0; t < *s.members; ++t) x[t] = s.response(i, s.member[t]);
  s.active.forward(0, *s.members, x);
  for (std::int32_t t = 0; t < *s.members; ++t) pivot -= x[t] * (x[t] * s.active.inverse[t]);
  return pivot;
}

void DenseResponse::velocities(const DenseIsland& s) {
  std::copy(s.k, s.k + s.n, s.x);
  for (std::int32_t i = 0; i < s.m; ++i) {
    if (s.gamma[i] == 0) continue;
    const double* y = s.y + static_cast<std::int64_t>(i) * s.n;
    for (std::int32_t p = s.begin[i]; p < s.end[i]; ++p) s.x[p] += y[p] * s.gamma[i];
  }
  for (std::int32_t p = 0; p < s.n; ++p) s.x[p] *= s.mass.inverse[p];
  s.mass.backward(s.n, s.x);
}

void DenseResponse::correct(const DenseIsland& s) {
  double *v = s.x, *g = s.x + s.n;
  s.mass.forward(0, s.n, v);
  for (std::int32_t t = 0; t < *s.members; ++t) {
    const double* y = s.y + static_cast<std::int64_t>(s.member[t]) * s.n;
    for (std::int32_t p = s.begin[s.member[t]]; p < s.end[s.member[t]]; ++p) g[t] -= y[p] * (v[p] * s.mass.inverse[p]);
  }
  s.active.forward(0, *s.members, g);
  for (std::int32_t t = 0; t < *s.members; ++t) g[t] *= s.active.inverse[t];
  s.active.backward(*s.members, g);
  for (std::int32_t t = 0; t < *s.members; ++t) {
    const double* y = s.y + static_cast<std::int64_t>(s.member[t]) * s.n;
    for (std::int32_t p = s.begin[s.member[t]]; p < s.end[s.member[t]]; ++p) v[p] += y[p] * g[t];
  }
  for (std::int32_t p = 0; p < s.n; ++p) v[p] *= s.mass.inverse[p];
  s.mass.backward(s.n, v);
}

}  // namespace mlcp
