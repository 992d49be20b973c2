#include "factorize/dense_response.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>

namespace mlcp {
namespace {

/// A line of the cache, in doubles: panels and blocks begin with one, and so does what kernels read by eights.
constexpr std::int64_t line = 8;

std::int64_t real_count(std::int64_t m, std::int64_t blocks, std::int64_t panels) {
  const std::int64_t by_lines = BlockLdl::reals(blocks) + 16 * blocks * panels + 16 * panels * panels + BlockLdl::reals(panels) + 16 * blocks;
  return by_lines + (12 * blocks + 16 * panels + 4 * m + 4 * (blocks + panels) + line - 1) / line * line;
}
std::int64_t integer_count(std::int64_t m, std::int64_t panels) { return 4 * panels + 2 * m; }

}  // namespace

void DenseResponse::prepare(const Problem& problem, const Components& components, std::span<const std::uint8_t> left_out) {
  components_ = &components;
  const auto stays = [&](std::int32_t c) { return !left_out.empty() && left_out[c] != 0; };
  const std::int32_t n = problem.n(), count = components.count();
  const bool same_masses = mass_version_ == components.mass_version() && std::ranges::equal(left_out, left_out_);
  if (!same_masses) mass_version_ = -1;  // until all is found anew: memory may run out
  places_.resize(count + 1);
  local_.assign(n + problem.m(), -1);
  std::int64_t reals = 0, integers = 0, velocity_blocks = 0;
  for (std::int32_t c = 0; c < count; ++c) {
    places_[c] = {reals, integers, same_masses ? places_[c].slots : 0, velocity_blocks, components.row_pointers[c]};
    if (stays(c)) continue;
    const std::int32_t own_n = components.velocity_count(c), own_m = components.row_count(c);
    const std::int32_t blocks = BlockLdl::blocks_of(own_n), panels = BlockLdl::blocks_of(own_m);
    reals += real_count(own_m, blocks, panels);
    integers += integer_count(own_m, panels);
    velocity_blocks += blocks;
    for (std::int32_t p = 0; p < own_n; ++p) local_[components.velocities[components.velocity_pointers[c] + p]] = own_n - 1 - p;
    for (std::int32_t i = 0; i < own_m; ++i) local_[n + components.rows[components.row_pointers[c] + i]] = i;
  }
  reals_.resize(reals + line - 1);
  integers_.resize(integers);
  states_.resize(3 * components.rows.size());
  members_.resize(count);
  first_.resize(velocity_blocks);
  islands_.resize(count);
  for (std::int32_t c = 0; c < count; ++c) {
    if (stays(c)) continue;
    islands_[c] = lay_out(c);
    find_row_envelopes(problem, islands_[c]);
  }
  if (same_masses) return;
  slots_.resize(problem.mass.values.size());  // more than there will be
  Slot* next = slots_.data();
  for (std::int32_t c = 0; c < count; ++c) {
    places_[c].slots = next - slots_.data();
    if (!stays(c)) next = find_mass_envelope(problem, islands_[c], next);
  }
  places_[count].slots = next - slots_.data();
  left_out_.assign(left_out);
  mass_version_ = components.mass_version();
}

/// Where the parts of component c are.
DenseIsland DenseResponse::lay_out(std::int32_t c) {
  const Place& place = places_[c];
  void* begin = reals_.data();
  std::size_t room = reals_.size() * sizeof(double);
  double* real = static_cast<double*>(std::align(line * sizeof(double), 0, begin, room)) + place.reals;
  std::int32_t* integer = integers_.data() + place.integers;
  const auto take = [](auto*& from, std::int64_t count) {
    const auto part = from;
    from += count;
    return part;
  };
  DenseIsland s{};
  s.members = members_.data() + c;
  s.kernels = kernels_;
  s.n = components_->velocity_count(c);
  const std::int64_t m = s.m = components_->row_count(c);
  s.ascending = components_->velocities.data() + components_->velocity_pointers[c];
  s.row = components_->rows.data() + components_->row_pointers[c];
  const std::int64_t blocks = s.blocks = BlockLdl::blocks_of(s.n), panels = s.panels = BlockLdl::blocks_of(s.m);
  s.mass.lower = take(real, BlockLdl::reals(blocks));
  s.y = take(real, 16 * blocks * panels);
  s.scaled = take(real, 16 * blocks);
  s.active.lower = take(real, BlockLdl::reals(panels));
  s.a = take(real, 16 * panels * panels);
  for (double** part : {&s.mass.inverse, &s.reach, &s.k}) *part = take(real, 4 * blocks);
  s.active.inverse = take(real, 4 * panels);
  for (double** part : {&s.gamma, &s.w, &s.scale}) *part = take(real, 4 * panels);
  for (double** part : {&s.b, &s.size, &s.lo, &s.hi}) *part = take(real, m);
  s.x = take(real, 4 * (blocks + panels));
  s.mass.first = first_.data() + place.blocks;
  for (std::int32_t** part : {&s.begin, &s.end, &s.active.first, &s.fours}) *part = take(integer, panels);
  for (std::int32_t** part : {&s.member, &s.pushing}) *part = take(integer, m);
  s.state = states_.data() + 3 * std::int64_t{place.rows};
  s.kept = s.state + m;
  s.tried = s.kept + m;
  return s;
}

DenseResponse::Slot* DenseResponse::find_mass_envelope(const Problem& problem, const DenseIsland& s, Slot* slot) {
  const SparseView mass = problem.mass_view();
  for (std::int32_t b = 0; b < s.blocks; ++b) {
    std::int32_t first = 4 * b;
    for (std::int32_t p = first; p < std::min(4 * b + 4, s.n); ++p) {
      const std::int32_t j = s.velocity(p), row = static_cast<std::int32_t>(BlockLdl::reals(b)) + p - 4 * b;
      for (std::int32_t t = mass.pointers[j], end = mass.pointers[j + 1]; t < end; ++t) {
        if (mass.indices[t] < j) continue;  // of the other triangle: velocities count down
        const std::int32_t q = local_[mass.indices[t]];
        first = std::min(first, q);
        *slot++ = {t, row + 4 * q};
      }
    }
    s.mass.first[b] = first / 4;
  }
  return slot;
}

void DenseResponse::find_row_envelopes(const Problem& problem, DenseIsland& s) {
  const SparseView jacobian = problem.jacobian_view();
  for (std::int32_t c = 0; c < s.panels; ++c) {
    std::int32_t begin = 4 * s.blocks;
    for (std::int32_t i = 4 * c; i < std::min(4 * c + 4, s.m); ++i)
      for (std::int32_t t = jacobian.pointers[s.row[i]]; t < jacobian.pointers[s.row[i] + 1]; ++t)
        if (const std::int32_t p = local_[jacobian.indices[t]]; p >= 0) begin = std::min(begin, p);
    s.begin[c] = begin / 4;
  }
}

bool DenseResponse::compute(const Problem& problem, std::int32_t component) {
  DenseIsland& s = islands_[component];
  const std::int64_t slots = places_[component].slots;
  if (!load_mass(problem, s, slots_.span().subspan(slots, places_[component + 1].slots - slots))) return false;
  for (std::int32_t c = 0; c < s.panels; ++c) {
    std::fill(s.panel(c) + 16 * s.begin[c], s.panel(c) + 16 * s.blocks, 0.0);
    for (std::int32_t i = 4 * c; i < std::min(4 * c + 4, s.m); ++i) load_row(problem, s, i);
    respond(s, c);
  }
  std::fill(s.gamma + s.m, s.gamma + 4 * s.panels, 0.0);
  const SparseView sigma = problem.compliance_view();
  for (std::int32_t i = 0; i < s.m; ++i) {
    for (std::int32_t t = sigma.pointers[s.row[i]]; t < sigma.pointers[s.row[i] + 1]; ++t)
      if (const std::int32_t j = local_[problem.n() + sigma.indices[t]]; j >= 0) s.row_of_a(i)[j] += sigma.values[t];
    if (!(s.response(i, i) >= 0)) return false;
  }
  return true;
}

bool DenseResponse::load_mass(const Problem& problem, DenseIsland& s, std::span<const Slot> slots) {
  for (std::int32_t b = 0; b < s.blocks; ++b) std::fill(s.mass.block(b) + 16 * s.mass.first[b], s.mass.block(b + 1), 0.0);
  for (const Slot& slot : slots) s.mass.lower[slot.to] = problem.mass.values[slot.from];
  const auto diagonal = [&](std::int32_t p) -> double& { return s.mass.block(p / 4)[4 * p + p % 4]; };
  for (std::int32_t p = 0; p < s.n; ++p) {
    s.k[p] = problem.momentum[s.velocity(p)];
    s.reach[p] = std::abs(s.k[p] / diagonal(p));
  }
  for (std::int32_t p = s.n; p < 4 * s.blocks; ++p) {
    s.k[p] = 0;
    diagonal(p) = 1;
  }
  constexpr double positive[4] = {};
  for (std::int32_t b = 0; b < s.blocks; ++b)
    if (kernels_->block_eliminate(s.mass, b, positive) < 4) return false;
  s.kernels->block_forward(s.mass, s.blocks, s.k);
  return true;
}

/// Row i of J into its panel; what it has from prescribed velocities goes into r, and that into b.
void DenseResponse::load_row(const Problem& problem, DenseIsland& s, std::int32_t i) {
  const SparseView jacobian = problem.jacobian_view();
  const std::int32_t row = s.row[i];
  double* const y = s.panel(i / 4) + i % 4;
  double r = problem.r[row], size = std::abs(r);
  for (std::int32_t t = jacobian.pointers[row], end = jacobian.pointers[row + 1]; t < end; ++t) {
    const std::int32_t j = jacobian.indices[t], p = local_[j];
    if (p >= 0) {
      y[4 * p] = jacobian.values[t];
      size += std::abs(jacobian.values[t]) * s.reach[p];
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

/// Y := L⁻¹ Y on panel c, and with it four rows of A and of b.
void DenseResponse::respond(DenseIsland& s, std::int32_t c) {
  double* const y = s.panel(c);
  const std::int32_t begin = s.begin[c], end = s.end[c] = kernels_->panel_forward(s.mass, begin, s.blocks, y);
  double sum[4];
  kernels_->panel_scale(4 * (end - begin), y + 16 * begin, s.mass.inverse + 4 * begin, s.k + 4 * begin, s.scaled + 16 * begin, sum);
  for (std::int32_t i = 4 * c; i < std::min(4 * c + 4, s.m); ++i) s.b[i] += sum[i - 4 * c];
  for (std::int32_t d = 0; d <= c; ++d) {
    const std::int32_t from = std::max(begin, s.begin[d]), to = std::min(end, s.end[d]);
    double *const tile = s.row_of_a(4 * c) + 4 * d, *const mirror = s.row_of_a(4 * d) + 4 * c;
    kernels_->panel_product(std::max(0, 4 * (to - from)), s.scaled + 16 * from, s.panel(d) + 16 * from, 4 * s.panels, tile, mirror);
  }
  for (std::int32_t i = 4 * c; i < 4 * c + 4; ++i)  // exactly symmetric: as what is below the diagonal
    for (std::int32_t k = 4 * c; k < i; ++k) s.row_of_a(k)[i] = s.response(i, k);
}

/// Loads block b of A on the members, with rows of the unit matrix behind the last one; what is above the diagonal is of no effect. A is symmetric:
/// four entries of one of its rows stand beside each other where members do.
void DenseResponse::load_active(DenseIsland& s, std::int32_t b) {
  const std::int32_t count = std::min(4, *s.members - 4 * b), columns = 4 * b + count;
  const std::int32_t* const four = s.member + 4 * b;
  double* entry = s.active.block(b);
  std::int32_t begin = columns;
  if (count == 4 && four[1] == four[0] + 1 && four[2] == four[0] + 2 && four[3] == four[0] + 3) {
    for (std::int32_t q = 0; q < columns; ++q, entry += 4) std::memcpy(entry, s.row_of_a(s.member[q]) + four[0], 4 * sizeof(double));
  } else {
    for (std::int32_t q = 0; q < columns; ++q, entry += 4) {
      const double* const a = s.row_of_a(s.member[q]);
      for (std::int32_t r = 0; r < 4; ++r) entry[r] = r < count ? a[four[r]] : 0;
    }
    for (std::int32_t q = columns; q < 4 * b + 4; ++q, entry += 4)
      for (std::int32_t r = 0; r < 4; ++r) entry[r] = q == 4 * b + r;
  }
  entry = s.active.block(b);
  for (begin = 0; begin < 4 * b && entry[4 * begin] == 0 && entry[4 * begin + 1] == 0 && entry[4 * begin + 2] == 0 && entry[4 * begin + 3] == 0;) ++begin;
  s.active.first[b] = begin / 4;
}

void DenseResponse::factor_active(DenseIsland& s, double drop, std::int32_t first) {
  for (std::int32_t b = first / 4; 4 * b < *s.members;) {
    load_active(s, b);
    double least[4] = {};
    for (std::int32_t r = 0; r < std::min(4, *s.members - 4 * b); ++r) least[r] = drop * s.response(s.member[4 * b + r], s.member[4 * b + r]);
    const std::int32_t independent = s.kernels->block_eliminate(s.active, b, least);
    if (independent == 4)
      ++b;
    else
      std::copy(s.member + 4 * b + independent + 1, s.member + (*s.members)--, s.member + 4 * b + independent);
  }
}

/// x := A⁻¹ x on the members, before: 0 behind them.
void DenseResponse::solve_members(const DenseIsland& s, double* x) {
  const std::int32_t blocks = BlockLdl::blocks_of(*s.members);
  s.kernels->block_forward(s.active, blocks, x);
  for (std::int32_t t = 0; t < 4 * blocks; ++t) x[t] *= s.active.inverse[t];
  s.kernels->block_backward(s.active, blocks, x);
}

void DenseResponse::solve_active(DenseIsland& s) {
  double* const x = s.x_rows();
  std::fill(x, x + 4 * s.panels, 0.0);
  for (std::int32_t t = 0; t < *s.members; ++t) x[t] = -s.b[s.member[t]];
  for (std::int32_t j = 0; j < s.m; ++j) {
    if (s.gamma[j] == 0) continue;
    for (std::int32_t t = 0; t < *s.members; ++t) x[t] -= s.response(s.member[t], j) * s.gamma[j];
  }
  solve_members(s, x);
  for (std::int32_t t = 0; t < *s.members; ++t) s.gamma[s.member[t]] = x[t];
}

void DenseResponse::slacks(const DenseIsland& s, std::uint8_t known) {
  List columns{0, s.pushing}, fours{0, s.fours};
  for (std::int32_t i = 0, b = 0; b < s.panels; ++b) {
    bool asked = false;
    for (const std::int32_t end = std::min(i + 4, s.m); i < end; ++i) {
      s.pushing[columns.count] = i;
      columns.count += s.gamma[i] != 0;
      asked |= s.state[i] != known;
    }
    s.fours[fours.count] = b;
    fours.count += asked;
  }
  s.kernels->column_products(fours, columns, 4 * s.panels, s.a, s.gamma, s.w, s.scale);
  for (std::int32_t k = 0; k < fours.count; ++k)
    for (std::int32_t i = 4 * s.fours[k], end = std::min(i + 4, s.m); i < end; ++i) {
      s.w[i] += s.b[i];
      s.scale[i] += s.size[i] + std::abs(s.b[i]);
    }
}

double DenseResponse::schur(const DenseIsland& s, std::int32_t i) {
  double* const x = s.x;
  double pivot = s.response(i, i);
  const std::int32_t blocks = BlockLdl::blocks_of(*s.members);
  std::fill(x, x + 4 * blocks, 0.0);
  for (std::int32_t t = 0; t < *s.members; ++t) x[t] = s.response(i, s.member[t]);
  s.kernels->block_forward(s.active, blocks, x);
  for (std::int32_t t = 0; t < *s.members; ++t) pivot -= x[t] * (x[t] * s.active.inverse[t]);
  return pivot;
}

double DenseResponse::couple(const DenseIsland& s, std::int32_t i) {
  double* const z = s.x_rows();
  const double* const a = s.row_of_a(i);
  std::fill(z + *s.members, z + 4 * BlockLdl::blocks_of(*s.members), 0.0);
  for (std::int32_t t = 0; t < *s.members; ++t) z[t] = a[s.member[t]];
  solve_members(s, z);
  double pivot = a[i];
  for (std::int32_t t = 0; t < *s.members; ++t) pivot -= a[s.member[t]] * z[t];
  return pivot;
}

void DenseResponse::velocities(const DenseIsland& s) {
  double* const v = s.x;
  std::copy(s.k, s.k + 4 * s.blocks, v);
  for (std::int32_t c = 0; c < s.panels; ++c) {
    const double* const g = s.gamma + 4 * c;
    if (g[0] == 0 && g[1] == 0 && g[2] == 0 && g[3] == 0) continue;
    const std::int64_t begin = s.begin[c];
    s.kernels->panel_add(4 * (s.end[c] - begin), s.panel(c) + 16 * begin, g, v + 4 * begin);
  }
  for (std::int32_t p = 0; p < 4 * s.blocks; ++p) v[p] *= s.mass.inverse[p];
  s.kernels->block_backward(s.mass, s.blocks, v);
}

void DenseResponse::correct(const DenseIsland& s) {
  double *const v = s.x, *const g = s.x_rows();
  std::fill(v + s.n, g, 0.0);
  s.kernels->block_forward(s.mass, s.blocks, v);
  const auto entries = [&](std::int32_t t, const auto& visit) {  // of the column of Y that belongs to member t
    const std::int32_t c = s.member[t] / 4;
    const double* const y = s.panel(c) + s.member[t] % 4;
    for (std::int32_t p = 4 * s.begin[c]; p < 4 * s.end[c]; ++p) visit(p, y[4 * p]);
  };
  for (std::int32_t t = 0; t < *s.members; ++t) entries(t, [&](std::int32_t p, double y) { g[t] -= y * (v[p] * s.mass.inverse[p]); });
  std::fill(g + *s.members, g + 4 * s.panels, 0.0);
  solve_members(s, g);
  for (std::int32_t t = 0; t < *s.members; ++t) entries(t, [&](std::int32_t p, double y) { v[p] += y * g[t]; });
  for (std::int32_t p = 0; p < s.n; ++p) v[p] *= s.mass.inverse[p];
  s.kernels->block_backward(s.mass, s.blocks, v);
}

}  // namespace mlcp
