#include "dual.h"

#include <Eigen/Cholesky>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <numeric>
#include <stdexcept>

#include "scenes/handles.h"

namespace bench {
namespace {

using handles::check;

/// A block of M with at most so many velocities is factored dense.
constexpr Eigen::Index largest_dense = 300;

mlcp_matrix_view make_view() {
  mlcp_matrix_view view;
  mlcp_matrix_view_init(&view, sizeof view);
  return view;
}

void require_definite(bool definite) {
  if (!definite) throw std::runtime_error("M is not positive definite: there is no reduced form");
}

}  // namespace

Dual::Dual(const mlcp_problem* problem) : mass_(make_view()), jacobian_(make_view()), sigma_(make_view()) {
  check(mlcp_problem_mass(problem, &mass_));
  check(mlcp_problem_jacobian(problem, &jacobian_));
  check(mlcp_problem_compliance(problem, &sigma_));
  k_.resize(static_cast<std::size_t>(mass_.columns));
  r_.resize(static_cast<std::size_t>(jacobian_.rows));
  check(mlcp_problem_get_momentum(problem, mass_.columns, k_.data()));
  check(mlcp_problem_get_rows(problem, jacobian_.rows, r_.data(), nullptr, nullptr, nullptr, nullptr));
}

void Dual::analyze() {
  find_blocks();
  find_rows();
  find_pattern();
}

/// Connected parts of M, and the velocities of each.
void Dual::find_blocks() {
  const std::int32_t n = mass_.columns;
  std::vector<std::int32_t> root(static_cast<std::size_t>(n));
  std::iota(root.begin(), root.end(), 0);
  const auto find = [&](std::int32_t j) {
    while (root[j] != j) j = root[j] = root[root[j]];
    return j;
  };
  for (std::int32_t j = 0; j < n; ++j)
    for (std::int32_t e = mass_.pointers[j]; e < mass_.pointers[j + 1]; ++e)
      if (mass_.indices[e] != j) {
        const std::int32_t a = find(j), c = find(mass_.indices[e]);
        root[std::max(a, c)] = std::min(a, c);
      }
  blocks_.clear();
  block_of_.resize(static_cast<std::size_t>(n));
  local_.resize(static_cast<std::size_t>(n));
  for (std::int32_t j = 0; j < n; ++j) {
    const std::int32_t top = find(j);
    if (top == j) {
      block_of_[j] = static_cast<std::int32_t>(blocks_.size());
      blocks_.emplace_back();
    } else {
      block_of_[j] = block_of_[top];
    }
    local_[j] = blocks_[block_of_[j]].velocities_end++;
  }
  std::int32_t first = 0;
  for (Block& block : blocks_) {
    block.velocities = first;
    first = block.velocities_end += first;
  }
  velocities_.resize(static_cast<std::size_t>(n));
  for (std::int32_t j = 0; j < n; ++j) velocities_[blocks_[block_of_[j]].velocities + local_[j]] = j;
}

/// The rows that touch each block, and their entries.
void Dual::find_rows() {
  const std::int32_t m = jacobian_.rows;
  const auto visit = [&](auto each) {  // each(block, row, first entry there of that row?, entry)
    std::vector<std::int32_t> last(blocks_.size(), -1);
    for (std::int32_t i = 0; i < m; ++i)
      for (std::int32_t e = jacobian_.pointers[i]; e < jacobian_.pointers[i + 1]; ++e) {
        const std::int32_t c = block_of_[jacobian_.indices[e]];
        each(c, i, last[c] != i, e);
        last[c] = i;
      }
  };
  std::vector<std::int32_t> entry_end(blocks_.size(), 0);
  visit([&](std::int32_t c, std::int32_t, bool first, std::int32_t) {
    blocks_[c].rows_end += first;
    ++entry_end[c];
  });
  std::int32_t row = 0, entry = 0;
  for (std::size_t c = 0; c < blocks_.size(); ++c) {
    const std::int32_t count = blocks_[c].rows_end;
    blocks_[c].rows = blocks_[c].rows_end = row;
    row += count;
    entry += entry_end[c];
    entry_end[c] = entry - entry_end[c];
  }
  rows_.resize(static_cast<std::size_t>(row));
  entry_pointers_.assign(static_cast<std::size_t>(row) + 1, entry);
  entries_.resize(static_cast<std::size_t>(entry));
  visit([&](std::int32_t c, std::int32_t i, bool first, std::int32_t e) {
    if (first) {
      entry_pointers_[blocks_[c].rows_end] = entry_end[c];
      rows_[blocks_[c].rows_end++] = i;
    }
    entries_[entry_end[c]++] = e;
  });
}

/// A has a clique for every block, Σ, and its diagonal.
void Dual::find_pattern() {
  const std::int32_t m = jacobian_.rows;
  std::vector<std::int32_t> mark(static_cast<std::size_t>(m), -1), column;
  A.resize(m, m);
  std::vector<std::int32_t> indices;
  for (std::int32_t j = 0; j < m; ++j) {
    column.assign(1, j);
    mark[j] = j;
    const auto add = [&](std::int32_t i) {
      if (mark[i] != j) column.push_back(i);
      mark[i] = j;
    };
    std::int32_t before = -1;
    for (std::int32_t e = jacobian_.pointers[j]; e < jacobian_.pointers[j + 1]; ++e) {
      const std::int32_t c = block_of_[jacobian_.indices[e]];
      if (c == before) continue;
      before = c;
      std::for_each(rows_.begin() + blocks_[c].rows, rows_.begin() + blocks_[c].rows_end, add);
    }
    std::for_each(sigma_.indices + sigma_.pointers[j], sigma_.indices + sigma_.pointers[j + 1], add);
    std::sort(column.begin(), column.end());
    A.outerIndexPtr()[j] = static_cast<std::int32_t>(indices.size());
    indices.insert(indices.end(), column.begin(), column.end());
  }
  A.outerIndexPtr()[m] = static_cast<std::int32_t>(indices.size());
  A.resizeNonZeros(static_cast<Eigen::Index>(indices.size()));
  std::copy(indices.begin(), indices.end(), A.innerIndexPtr());

  const auto slot = [&](std::int32_t row, std::int32_t in_column) {
    const std::int32_t* first = A.innerIndexPtr() + A.outerIndexPtr()[in_column];
    const std::int32_t* last = A.innerIndexPtr() + A.outerIndexPtr()[in_column + 1];
    return static_cast<std::int32_t>(std::lower_bound(first, last, row) - A.innerIndexPtr());
  };
  slots_.clear();
  for (Block& block : blocks_) {
    block.slots = static_cast<std::int64_t>(slots_.size());
    for (std::int32_t a = block.rows; a < block.rows_end; ++a)
      for (std::int32_t c = block.rows; c < block.rows_end; ++c) slots_.push_back(slot(rows_[c], rows_[a]));
  }
  sigma_slots_.clear();
  for (std::int32_t j = 0; j < m; ++j)
    for (std::int32_t e = sigma_.pointers[j]; e < sigma_.pointers[j + 1]; ++e) sigma_slots_.push_back(slot(sigma_.indices[e], j));
}

void Dual::form() {
  std::fill_n(A.valuePtr(), A.nonZeros(), 0.0);
  b = -Eigen::Map<const Eigen::VectorXd>(r_.data(), static_cast<Eigen::Index>(r_.size()));
  for (std::size_t e = 0; e < sigma_slots_.size(); ++e) A.valuePtr()[sigma_slots_[e]] += sigma_.values[e];
  for (const Block& block : blocks_)
    if (block.rows < block.rows_end) add_block(block);
}

/// A += J_c M_c⁻¹ J_cᵀ and b += J_c M_c⁻¹ k_c of the block.
void Dual::add_block(const Block& block) {
  const Eigen::Index n = block.velocities_end - block.velocities, m = block.rows_end - block.rows;
  right_.setZero(n, m + 1);  // Jᵀ and k
  for (std::int32_t a = block.rows; a < block.rows_end; ++a)
    for (std::int32_t e = entry_pointers_[a]; e < entry_pointers_[a + 1]; ++e)
      right_(local_[jacobian_.indices[entries_[e]]], a - block.rows) = jacobian_.values[entries_[e]];
  for (Eigen::Index j = 0; j < n; ++j) right_(j, m) = k_[velocities_[block.velocities + j]];
  n <= largest_dense ? solve_dense(block) : solve_sparse(block);
  const std::int32_t* slot = slots_.data() + block.slots;
  for (Eigen::Index column = 0; column < m; ++column)
    for (Eigen::Index row = 0; row < m; ++row) A.valuePtr()[*slot++] += product_(row, column);
  for (Eigen::Index row = 0; row < m; ++row) b[rows_[block.rows + row]] += product_(row, m);
}

/// product = (L⁻¹Jᵀ)ᵀ L⁻¹[Jᵀ k] with L Lᵀ = M_c.
void Dual::solve_dense(const Block& block) {
  const Eigen::Index n = right_.rows();
  block_mass_.setZero(n, n);
  for (Eigen::Index j = 0; j < n; ++j) {
    const std::int32_t column = velocities_[block.velocities + j];
    for (std::int32_t e = mass_.pointers[column]; e < mass_.pointers[column + 1]; ++e)
      block_mass_(local_[mass_.indices[e]], j) = mass_.values[e];
  }
  const Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> factor(block_mass_);
  require_definite(factor.info() == Eigen::Success);
  factor.matrixL().solveInPlace(right_);
  product_.noalias() = right_.leftCols(right_.cols() - 1).transpose() * right_;
}

void Dual::solve_sparse(const Block& block) {
  const Eigen::Index n = right_.rows();
  std::vector<Eigen::Triplet<double>> triplets;
  for (std::int32_t j = block.velocities; j < block.velocities_end; ++j)
    for (std::int32_t e = mass_.pointers[velocities_[j]]; e < mass_.pointers[velocities_[j] + 1]; ++e)
      triplets.emplace_back(local_[mass_.indices[e]], j - block.velocities, mass_.values[e]);
  Eigen::SparseMatrix<double> mass(n, n);
  mass.setFromTriplets(triplets.begin(), triplets.end());
  const Eigen::SimplicialLLT<Eigen::SparseMatrix<double>> factor(mass);
  require_definite(factor.info() == Eigen::Success);
  const Eigen::SparseMatrix<double> jacobian = right_.leftCols(right_.cols() - 1).transpose().sparseView();
  product_ = jacobian * factor.solve(right_);
}

}  // namespace bench
