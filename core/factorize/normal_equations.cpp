#include "factorize/normal_equations.h"

#include <algorithm>
#include <cmath>

namespace mlcp {
namespace {

std::int64_t real_count(std::int64_t blocks, std::int64_t panels, std::int64_t mass, std::int64_t tiles) {
  return mass + 16 * tiles + BlockLdl::reals(blocks) + 4 * (6 * blocks + 16 * panels);
}
std::int64_t integer_count(std::int64_t n, std::int64_t blocks, std::int64_t panels, std::int64_t mass, std::int64_t tiles) {
  return n + 1 + mass + panels + 1 + tiles + blocks;
}

}  // namespace

void NormalEquations::prepare(const Problem& problem, const Components& components, std::span<const std::uint8_t> taken) {
  components_ = &components;
  const std::int32_t count = components.count();
  places_.resize(count);
  islands_.resize(count);
  local_.assign(problem.n(), -1);
  Place next{};
  for (std::int32_t c = 0; c < count; ++c) {
    if (!taken[c]) continue;
    const std::span<const std::int32_t> velocities = components.velocities_of(c);
    for (std::size_t p = 0; p < velocities.size(); ++p) local_[velocities[p]] = static_cast<std::int32_t>(velocities.size() - 1 - p);
    places_[c] = next;
    measure(problem, c, places_[c]);
    const std::int64_t n = velocities.size(), blocks = BlockLdl::blocks_of(components.velocity_count(c)), panels = BlockLdl::blocks_of(components.row_count(c));
    next.reals += real_count(blocks, panels, places_[c].mass, places_[c].tiles);
    next.integers += integer_count(n, blocks, panels, places_[c].mass, places_[c].tiles);
    next.states += 4 * panels;
  }
  reals_.resize(next.reals);
  integers_.resize(next.integers);
  states_.resize(next.states);
  for (std::int32_t c = 0; c < count; ++c) {
    if (!taken[c]) continue;
    islands_[c] = lay_out(c);
    find_pattern(problem, islands_[c]);
  }
}

/// Blocks of velocities that these rows touch, ascending.
std::span<const std::int32_t> NormalEquations::tiles_of(const Problem& problem, std::span<const std::int32_t> rows) {
  const SparseView jacobian = problem.jacobian_view();
  std::size_t entries = 0;
  for (const std::int32_t i : rows) entries += jacobian.pointers[i + 1] - jacobian.pointers[i];
  found_.resize(entries);
  std::int32_t* end = found_.data();
  for (const std::int32_t i : rows)
    for (std::int32_t t = jacobian.pointers[i]; t < jacobian.pointers[i + 1]; ++t)
      if (const std::int32_t p = local_[jacobian.indices[t]]; p >= 0) *end++ = p / 4;
  std::sort(found_.data(), end);
  return {found_.data(), std::unique(found_.data(), end)};
}

void NormalEquations::measure(const Problem& problem, std::int32_t c, Place& place) {
  const SparseView mass = problem.mass_view();
  place.mass = place.tiles = 0;
  for (const std::int32_t j : components_->velocities_of(c)) place.mass += mass.pointers[j + 1] - mass.pointers[j];
  const std::span<const std::int32_t> rows = components_->rows_of(c);
  for (std::size_t i = 0; i < rows.size(); i += 4) place.tiles += tiles_of(problem, rows.subspan(i, std::min<std::size_t>(4, rows.size() - i))).size();
}

NormalIsland NormalEquations::lay_out(std::int32_t c) {
  const Place& place = places_[c];
  double* real = reals_.data() + place.reals;
  std::int32_t* integer = integers_.data() + place.integers;
  const auto take = [](auto*& from, std::int64_t count) {
    const auto part = from;
    from += count;
    return part;
  };
  NormalIsland s{};
  s.kernels = kernels_;
  s.n = components_->velocity_count(c);
  s.m = components_->row_count(c);
  s.ascending = components_->velocities_of(c).data();
  s.row = components_->rows_of(c).data();
  s.blocks = BlockLdl::blocks_of(s.n);
  s.panels = BlockLdl::blocks_of(s.m);
  s.mass = take(real, place.mass);
  s.tiles = take(real, 16 * place.tiles);
  s.normal.lower = take(real, BlockLdl::reals(s.blocks));
  for (double** part : {&s.normal.inverse, &s.k, &s.reach, &s.v, &s.momentum, &s.step}) *part = take(real, s.padded_velocities());
  for (double** part : {&s.r, &s.sigma, &s.a, &s.size, &s.lo, &s.hi, &s.weight, &s.gamma, &s.w, &s.dgamma, &s.slack, &s.slope, &s.over, &s.under, &s.change, &s.other})
    *part = take(real, s.padded_rows());
  s.mass_pointers = take(integer, s.n + 1);
  s.mass_indices = take(integer, place.mass);
  s.tile_pointers = take(integer, s.panels + 1);
  s.tile_block = take(integer, place.tiles);
  s.normal.first = take(integer, s.blocks);
  s.state = states_.data() + place.states;
  return s;
}

void NormalEquations::find_pattern(const Problem& problem, NormalIsland& s) {
  const SparseView mass = problem.mass_view();
  std::int32_t next = 0;
  for (std::int32_t b = 0; b < s.blocks; ++b) s.normal.first[b] = b;
  for (std::int32_t p = 0; p < s.n; ++p) {
    s.mass_pointers[p] = next;
    const std::int32_t j = s.velocity(p);
    for (std::int32_t t = mass.pointers[j]; t < mass.pointers[j + 1]; ++t) {
      const std::int32_t q = s.mass_indices[next++] = local_[mass.indices[t]];
      s.normal.first[p / 4] = std::min(s.normal.first[p / 4], q / 4);
    }
  }
  s.mass_pointers[s.n] = next;
  next = 0;
  for (std::int32_t c = 0; c < s.panels; ++c) {
    s.tile_pointers[c] = next;
    for (const std::int32_t b : tiles_of(problem, {s.row + 4 * c, s.row + std::min(4 * c + 4, s.m)})) {
      s.tile_block[next++] = b;
      s.normal.first[b] = std::min(s.normal.first[b], s.tile_block[s.tile_pointers[c]]);
    }
  }
  s.tile_pointers[s.panels] = next;
}

bool NormalEquations::load(const Problem& problem, std::int32_t component) {
  NormalIsland& s = islands_[component];
  const SparseView mass = problem.mass_view();
  for (double* part : {s.k, s.reach, s.v}) std::fill(part + s.n, part + s.padded_velocities(), 0.0);
  for (std::int32_t p = 0; p < s.n; ++p) {
    const std::int32_t j = s.velocity(p), from = mass.pointers[j];
    double diagonal = 0;
    for (std::int32_t t = s.mass_pointers[p]; t < s.mass_pointers[p + 1]; ++t) {
      s.mass[t] = mass.values[from + t - s.mass_pointers[p]];
      if (s.mass_indices[t] == p) diagonal = s.mass[t];
    }
    if (!(diagonal > 0)) return false;
    s.step[p] = 1 / diagonal;
    s.k[p] = problem.momentum[j];
    s.reach[p] = std::abs(s.k[p] / diagonal);
  }
  std::fill(s.tiles, s.tiles + std::int64_t{16} * s.tile_pointers[s.panels], 0.0);
  for (std::int32_t i = 0; i < s.m; ++i)
    if (!load_row(problem, s, i)) return false;
  for (double* part : {s.r, s.sigma, s.a, s.size, s.lo, s.hi, s.gamma}) std::fill(part + s.m, part + s.padded_rows(), 0.0);
  return true;
}

/// before: 1/Mⱼⱼ in step.  false: Σ is negative, or couples the row to others.
bool NormalEquations::load_row(const Problem& problem, NormalIsland& s, std::int32_t i) {
  const SparseView jacobian = problem.jacobian_view(), sigma = problem.compliance_view();
  const std::int32_t row = s.row[i], first = s.tile_pointers[i / 4], last = s.tile_pointers[i / 4 + 1];
  double r = problem.r[row], size = std::abs(r), a = 0;
  for (std::int32_t t = jacobian.pointers[row]; t < jacobian.pointers[row + 1]; ++t) {
    const std::int32_t j = jacobian.indices[t], p = local_[j];
    const double entry = jacobian.values[t];
    if (p >= 0) {
      const std::int64_t tile = std::lower_bound(s.tile_block + first, s.tile_block + last, p / 4) - s.tile_block;
      s.tiles[16 * tile + 4 * (i % 4) + p % 4] = entry;
      a += entry * entry * s.step[p];
      size += std::abs(entry) * s.reach[p];
    } else {
      const double given = entry * problem.given_velocity[j];
      r -= given;
      size += 2 * std::abs(given);
    }
  }
  s.sigma[i] = 0;
  for (std::int32_t t = sigma.pointers[row]; t < sigma.pointers[row + 1]; ++t) {
    if (sigma.indices[t] == row)
      s.sigma[i] = sigma.values[t];
    else if (sigma.values[t] != 0)
      return false;
  }
  s.r[i] = r;
  s.size[i] = size;
  s.a[i] = a + s.sigma[i];
  s.lo[i] = problem.lo[row];
  s.hi[i] = problem.hi[row];
  return s.sigma[i] >= 0;
}

bool NormalEquations::factor(NormalIsland& s) {
  for (std::int32_t b = 0; b < s.blocks; ++b) std::fill(s.normal.block(b) + 16 * s.normal.first[b], s.normal.block(b + 1), 0.0);
  for (std::int32_t p = 0; p < s.n; ++p) {
    double* const row = s.normal.block(p / 4) + p % 4;
    for (std::int32_t t = s.mass_pointers[p]; t < s.mass_pointers[p + 1]; ++t)
      if (s.mass_indices[t] <= p) row[4 * s.mass_indices[t]] = s.mass[t];
  }
  for (std::int32_t p = s.n; p < s.padded_velocities(); ++p) s.normal.block(p / 4)[4 * p + p % 4] = 1;
  for (std::int32_t c = 0; c < s.panels; ++c) {
    const std::int32_t first = s.tile_pointers[c];
    s.kernels->tiles_square(s.normal, s.tile_pointers[c + 1] - first, s.tile_block + first, s.tiles + std::int64_t{16} * first, s.weight + 4 * c);
  }
  constexpr double positive[4] = {};
  for (std::int32_t b = 0; b < s.blocks; ++b)
    if (s.kernels->block_eliminate(s.normal, b, positive) < 4) return false;
  return true;
}

void NormalEquations::residuals(NormalIsland& s) {
  std::copy(s.k, s.k + s.padded_velocities(), s.momentum);
  for (std::int32_t p = 0; p < s.n; ++p) {
    double sum = 0;
    for (std::int32_t t = s.mass_pointers[p]; t < s.mass_pointers[p + 1]; ++t) sum += s.mass[t] * s.v[s.mass_indices[t]];
    s.momentum[p] -= sum;
  }
  for (std::int32_t i = 0; i < s.padded_rows(); ++i) s.w[i] = s.sigma[i] * s.gamma[i] - s.r[i];
  for (std::int32_t c = 0; c < s.panels; ++c) {
    const std::int32_t first = s.tile_pointers[c], count = s.tile_pointers[c + 1] - first;
    s.kernels->tiles_times(count, s.tile_block + first, s.tiles + std::int64_t{16} * first, s.v, s.w + 4 * c);
    s.kernels->tiles_transposed(count, s.tile_block + first, s.tiles + std::int64_t{16} * first, s.gamma + 4 * c, s.momentum);
  }
}

/// dγ = W (f − J dv), so that (M + JᵀWJ) dv = momentum + JᵀW f.
void NormalEquations::solve(NormalIsland& s) {
  std::copy(s.momentum, s.momentum + s.padded_velocities(), s.step);
  for (std::int32_t i = 0; i < s.padded_rows(); ++i) s.dgamma[i] *= s.weight[i];
  const auto tiles = [&](std::int32_t c) { return s.tiles + std::int64_t{16} * s.tile_pointers[c]; };
  for (std::int32_t c = 0; c < s.panels; ++c)
    s.kernels->tiles_transposed(s.tile_pointers[c + 1] - s.tile_pointers[c], s.tile_block + s.tile_pointers[c], tiles(c), s.dgamma + 4 * c, s.step);
  s.kernels->block_forward(s.normal, s.blocks, s.step);
  for (std::int32_t p = 0; p < s.padded_velocities(); ++p) s.step[p] *= s.normal.inverse[p];
  s.kernels->block_backward(s.normal, s.blocks, s.step);
  for (std::int32_t c = 0; c < s.panels; ++c) {
    double moved[4] = {};
    s.kernels->tiles_times(s.tile_pointers[c + 1] - s.tile_pointers[c], s.tile_block + s.tile_pointers[c], tiles(c), s.step, moved);
    for (int q = 0; q < 4; ++q) s.dgamma[4 * c + q] -= s.weight[4 * c + q] * moved[q];
  }
}

double NormalEquations::terms(const NormalIsland& s, std::int32_t i) {
  double sum = s.size[i] + std::abs(s.sigma[i] * s.gamma[i]);
  for (std::int32_t t = s.tile_pointers[i / 4]; t < s.tile_pointers[i / 4 + 1]; ++t)
    for (std::int32_t r = 0; r < 4; ++r) sum += std::abs(s.tiles[16 * std::int64_t{t} + 4 * (i % 4) + r] * s.v[4 * s.tile_block[t] + r]);
  return sum;
}

}  // namespace mlcp
