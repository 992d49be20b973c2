#include "friction/cone_rows.h"

#include <algorithm>

namespace mlcp {
namespace {

/// One row of G: the generator in terms of the block's rows; 1 for a block that is a row.
struct Weights {
  double value[3] = {1, 0, 0};
  explicit Weights() = default;
  Weights(double mu, Tangent d) : value{1, mu * d.x, mu * d.y} {}
};

double sum(const Weights& g, const double* x, std::int32_t rows) {
  double s = x[0];
  for (std::int32_t a = 1; a < rows; ++a) s += g.value[a] * x[a];
  return s;
}

/// gᵀ B h, B three by three of which rows × columns are there.
double form(const Weights& g, const double* b, const Weights& h, std::int32_t rows, std::int32_t columns) {
  double s = 0;
  for (std::int32_t a = 0; a < rows; ++a) s += g.value[a] * sum(h, b + 3 * a, columns);
  return s;
}
/// The same of Bᵀ in the same order of operations: both triangles get the same bits.
double form_transposed(const Weights& g, const double* b, const Weights& h, std::int32_t rows, std::int32_t columns) {
  double t[9] = {};
  for (std::int32_t i = 0; i < rows; ++i)
    for (std::int32_t j = 0; j < columns; ++j) t[3 * j + i] = b[3 * i + j];
  return form(h, t, g, columns, rows);
}

}  // namespace

void ConeRows::Touched::start(std::size_t size) {
  finish();  // what was left when there was no memory to go on
  if (place.size() < size) place.resize(size, -1);
  index.clear();
  coefficient.clear();
}

double* ConeRows::Touched::at(std::int32_t i, std::int32_t width) {
  if (place[i] < 0) {
    index.push_back(i);
    place[i] = static_cast<std::int32_t>(index.size()) - 1;
    for (std::int32_t k = 0; k < width; ++k) coefficient.push_back(0);
  }
  return coefficient.data() + std::size_t(place[i]) * width;
}

void ConeRows::Touched::finish() {
  for (const std::int32_t i : index) place[i] = -1;
}

void ConeRows::copy_bodies(const Problem& problem) {
  inner.bodies = problem.bodies;
  inner.body_of = problem.body_of;
  inner.mass.pointers = problem.mass.pointers;
  inner.mass.indices = problem.mass.indices;
  inner.mass.values = problem.mass.values;
  inner.momentum = problem.momentum;
  inner.given_velocity = problem.given_velocity;
  inner.free_ids = problem.free_ids;
}

void ConeRows::number_rows(const Problem& problem, const Generators& generators) {
  const std::int32_t m = problem.m();
  constexpr std::int32_t no_cone = -1;
  block_of_.assign(m, -1);
  local_of_.assign(m, 0);
  // for the moment: the cone at a normal row, −2 for its tangents
  for (std::int32_t c = 0; c < generators.cones(); ++c) {
    const Contact& contact = problem.contacts[generators.contact[c]];
    block_of_[contact.row] = c;
    local_of_[contact.row] = contact.dimension;
    for (std::int32_t t = 1; t < contact.dimension; ++t) block_of_[contact.row + t] = -2;
  }
  block_row_.clear();
  block_first_.clear();
  cone_at_.clear();
  row_of.clear();
  cone_of_row.clear();
  inner_of.assign(m, -1);
  for (std::int32_t i = 0; i < m; ++i) {
    if (block_of_[i] == -2) continue;
    const std::int32_t cone = block_of_[i] >= 0 ? block_of_[i] : no_cone, rows = cone >= 0 ? local_of_[i] : 1;
    const auto block = static_cast<std::int32_t>(block_row_.size()), first = static_cast<std::int32_t>(row_of.size());
    block_row_.push_back(i);
    block_first_.push_back(first);
    cone_at_.push_back(cone);
    inner_of[i] = first;
    for (std::int32_t t = 0; t < rows; ++t) {
      block_of_[i + t] = block;
      local_of_[i + t] = t;
    }
    i += rows - 1;
    const std::int32_t inside = cone >= 0 ? generators.first[cone + 1] - generators.first[cone] : 1;
    for (std::int32_t k = 0; k < inside; ++k) {
      row_of.push_back(block_row_.back());
      cone_of_row.push_back(cone);
    }
  }
  block_first_.push_back(static_cast<std::int32_t>(row_of.size()));
}

std::int32_t ConeRows::rows_of(const Problem& problem, const Generators& generators, std::int32_t block) const {
  return cone_at_[block] < 0 ? 1 : problem.contacts[generators.contact[cone_at_[block]]].dimension;
}

/// columns_: what rows `row` … row + rows − 1 of J touch, with their entries.
void ConeRows::gather_columns(const Problem& problem, std::int32_t row, std::int32_t rows) {
  columns_.start(problem.n());
  for (std::int32_t a = 0; a < rows; ++a)
    for (std::int32_t e = problem.jacobian.pointers[row + a]; e < problem.jacobian.pointers[row + a + 1]; ++e)
      columns_.at(problem.jacobian.indices[e], 3)[a] = problem.jacobian.values[e];
  columns_.finish();
}

void ConeRows::add_row(const Problem& problem, std::int32_t row) {
  const std::int32_t first = problem.jacobian.pointers[row], last = problem.jacobian.pointers[row + 1];
  for (std::int32_t e = first; e < last; ++e) {
    inner.jacobian.indices.push_back(problem.jacobian.indices[e]);
    inner.jacobian.values.push_back(problem.jacobian.values[e]);
  }
  inner.jacobian.pointers.push_back(static_cast<std::int32_t>(inner.jacobian.values.size()));
  inner.r.push_back(problem.r[row]);
  inner.lo.push_back(problem.lo[row]);
  inner.hi.push_back(problem.hi[row]);
}

void ConeRows::add_cone(const Problem& problem, const Generators& generators, std::int32_t cone) {
  const Contact& contact = problem.contacts[generators.contact[cone]];
  gather_columns(problem, contact.row, contact.dimension);
  for (std::int32_t k = generators.first[cone]; k < generators.first[cone + 1]; ++k) {
    for (const std::int32_t column : columns_.index) inner.jacobian.indices.push_back(column);
    inner.jacobian.values.resize(inner.jacobian.indices.size());
    inner.jacobian.pointers.push_back(static_cast<std::int32_t>(inner.jacobian.values.size()));
    inner.r.push_back(0);
    inner.lo.push_back(0);
    inner.hi.push_back(infinity);
  }
  write_rows(problem, generators, cone);
  write_shift(problem, generators, cone, 0);
}

void ConeRows::build(const Problem& problem, const Mask* outer, const Generators& generators) {
  copy_bodies(problem);
  number_rows(problem, generators);
  inner.jacobian.pointers.resize(1);
  inner.jacobian.indices.clear();
  inner.jacobian.values.clear();
  inner.r.clear();
  inner.lo.clear();
  inner.hi.clear();
  enabled.state.clear();
  for (std::size_t block = 0; block < block_row_.size(); ++block) {
    const std::int32_t row = block_row_[block];
    if (cone_at_[block] < 0)
      add_row(problem, row);
    else
      add_cone(problem, generators, cone_at_[block]);
    enabled.state.resize(inner.r.size(), outer ? outer->state[row] : static_cast<mlcp_row_state>(MLCP_ROW_ACTIVE));
  }
  inner.key.assign(inner.r.size(), 0);
  write_compliance(problem, generators);
}

void ConeRows::write_rows(const Problem& problem, const Generators& generators, std::int32_t cone) {
  const Contact& contact = problem.contacts[generators.contact[cone]];
  gather_columns(problem, contact.row, contact.dimension);
  std::int32_t row = inner_of[contact.row];
  for (std::int32_t k = generators.first[cone]; k < generators.first[cone + 1]; ++k, ++row) {
    const Weights g(contact.mu, generators.direction[k]);
    double* values = inner.jacobian.values.data() + inner.jacobian.pointers[row];
    for (std::size_t t = 0; t < columns_.index.size(); ++t) values[t] = sum(g, columns_.coefficient.data() + 3 * t, contact.dimension);
  }
}

void ConeRows::write_shift(const Problem& problem, const Generators& generators, std::int32_t cone, double shift) {
  const Contact& contact = problem.contacts[generators.contact[cone]];
  std::int32_t row = inner_of[contact.row];
  for (std::int32_t k = generators.first[cone]; k < generators.first[cone + 1]; ++k, ++row)
    inner.r[row] = sum(Weights(contact.mu, generators.direction[k]), problem.r.data() + contact.row, contact.dimension) - shift;
}

/// blocks_: what rows `row` … row + rows − 1 of Σ touch, ascending, a matrix of 3 × 3 for each block.
void ConeRows::gather_blocks(const Problem& problem, std::int32_t row, std::int32_t rows) {
  const SparseArrays& sigma = problem.compliance;
  blocks_.start(block_row_.size());
  for (std::int32_t a = 0; a < rows; ++a)
    for (std::int32_t e = sigma.pointers[row + a]; e < sigma.pointers[row + a + 1]; ++e)
      blocks_.at(block_of_[sigma.indices[e]], 9)[3 * a + local_of_[sigma.indices[e]]] = sigma.values[e];
}

/// Σ of the generators, G Σ Gᵀ. A block of its own that is 0 keeps its diagonal alone, so that a hard contact has no entries off it.
void ConeRows::write_compliance(const Problem& problem, const Generators& generators) {
  auto& [pointers, indices, values] = inner.compliance;
  pointers.resize(1);
  indices.clear();
  values.clear();
  inner.diagonal.resize(row_of.size());
  const auto weights = [&](std::int32_t block, std::int32_t k) {
    const std::int32_t cone = cone_at_[block];
    return cone < 0 ? Weights() : Weights(problem.contacts[generators.contact[cone]].mu, generators.direction[generators.first[cone] + k]);
  };
  const auto blocks = static_cast<std::int32_t>(block_row_.size());
  for (std::int32_t i = 0; i < blocks; ++i) {
    const std::int32_t rows = rows_of(problem, generators, i);
    gather_blocks(problem, block_row_[i], rows);
    std::sort(blocks_.index.begin(), blocks_.index.end());
    const double* own = blocks_.coefficient.data() + 9 * std::size_t(blocks_.place[i]);
    const bool hard = std::all_of(own, own + 9, [](double x) { return x == 0; });
    for (std::int32_t row = block_first_[i]; row < block_first_[i + 1]; ++row) {
      const Weights g = weights(i, row - block_first_[i]);
      for (const std::int32_t j : blocks_.index) {
        const double* b = blocks_.coefficient.data() + 9 * std::size_t(blocks_.place[j]);
        const std::int32_t columns = rows_of(problem, generators, j);
        for (std::int32_t column = block_first_[j]; column < block_first_[j + 1]; ++column) {
          if (j == i && hard && column != row) continue;
          if (column == row) inner.diagonal[row] = static_cast<std::int32_t>(values.size());
          const Weights h = weights(j, column - block_first_[j]);
          indices.push_back(column);
          values.push_back(row <= column ? form(g, b, h, rows, columns) : form_transposed(g, b, h, rows, columns));
        }
      }
      pointers.push_back(static_cast<std::int32_t>(values.size()));
    }
    blocks_.finish();
  }
}

void ConeRows::impulses(const Problem& problem, const Generators& generators, std::span<const double> beta,
                        std::span<double> gamma) const {
  std::fill(gamma.begin(), gamma.end(), 0.0);
  for (std::size_t row = 0; row < row_of.size(); ++row)
    if (cone_of_row[row] < 0) gamma[row_of[row]] = beta[row];
  for (std::int32_t c = 0; c < generators.cones(); ++c) {
    const Contact& contact = problem.contacts[generators.contact[c]];
    const double* b = beta.data() + inner_of[contact.row];
    ContactVector g;
    for (std::int32_t k = generators.first[c]; k < generators.first[c + 1]; ++k, ++b) {
      g.n += *b;
      g.t.x += contact.mu * *b * generators.direction[k].x;
      g.t.y += contact.mu * *b * generators.direction[k].y;
    }
    gamma[contact.row] = g.n;
    gamma[contact.row + 1] = g.t.x;
    if (contact.dimension == 3) gamma[contact.row + 2] = g.t.y;
  }
}

}  // namespace mlcp
