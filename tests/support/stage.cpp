#include "support/stage.h"

#include <algorithm>
#include <cmath>

namespace support {

Matrix kkt_matrix(const Dense& d) {
  const int n = d.n(), m = d.m();
  Matrix K(n + m, n + m);
  K.topLeftCorner(n, n) = d.M;
  K.bottomLeftCorner(m, n) = d.J;
  K.topRightCorner(n, m) = d.J.transpose();
  K.bottomRightCorner(m, m) = -d.S;
  return K;
}

Pattern kkt_pattern(const mlcp::Problem& problem, std::span<const std::int32_t> order) {
  const int n = problem.n();
  std::vector<int> position(n + problem.m(), -1);
  for (std::size_t p = 0; p < order.size(); ++p) position[order[p]] = static_cast<int>(p);
  Pattern a(order.size());
  const auto add = [&](int node, int other) {
    const int p = position[node], q = position[other];
    if (p >= 0 && q >= 0 && p != q) a[std::min(p, q)].insert(std::max(p, q));
  };
  const auto add_all = [&](const mlcp::SparseView& s, int outer_first, int inner_first) {
    for (int j = 0; j < s.outer; ++j)
      for (int t = s.pointers[j]; t < s.pointers[j + 1]; ++t) add(outer_first + j, inner_first + s.indices[t]);
  };
  add_all(problem.mass_view(), 0, 0);
  add_all(problem.jacobian_view(), n, 0);
  add_all(problem.compliance_view(), n, n);
  return a;
}

Pattern eliminate(Pattern a) {
  for (std::size_t j = 0; j < a.size(); ++j)
    for (auto i = a[j].begin(); i != a[j].end(); ++i) a[*i].insert(std::next(i), a[j].end());
  return a;
}

std::int64_t entries(const Pattern& a) {
  std::int64_t sum = 0;
  for (const auto& column : a) sum += static_cast<std::int64_t>(column.size());
  return sum;
}

std::vector<int> tree_of(const Pattern& L) {
  std::vector<int> parent;
  for (const auto& column : L) parent.push_back(column.empty() ? -1 : *column.begin());
  return parent;
}

Stage::Stage(const mlcp::Problem& problem, const mlcp::Mask* enabled)
    : analysis(mlcp::Memory()), values(mlcp::Memory()), factor(mlcp::Memory()) {
  analysis.run(problem, enabled, true, {});
  values.load(problem, analysis.pattern);
  factor.prepare(analysis.pattern, analysis.symbolic, values);
  islands_.assign(analysis.symbolic.islands.begin(), analysis.symbolic.islands.end());
}

mlcp::FactorStatus Stage::factorize(const std::vector<std::uint8_t>& wanted, double drop) {
  mlcp::FactorStatus worst = mlcp::FactorStatus::ok;
  for (const mlcp::Island& island : islands_)
    if (const mlcp::FactorStatus s = factor.factorize(island, wanted.data(), drop, work); s != mlcp::FactorStatus::ok) worst = s;
  return worst;
}

Matrix Stage::loaded() const {
  const int size = pattern().size();
  Matrix K = Matrix::Zero(size, size);
  for (int p = 0; p < size; ++p) {
    K(p, p) = values.diagonal[p];
    for (auto t = pattern().lower_pointers[p]; t < pattern().lower_pointers[p + 1]; ++t)
      K(pattern().lower_rows[t], p) = K(p, pattern().lower_rows[t]) = values.lower[t];
  }
  return K;
}

std::vector<double> Stage::solve(const std::vector<double>& b) {
  std::vector<double> x = b;
  for (const mlcp::Island& island : islands_) factor.solve(island, x.data(), work);
  return x;
}

const mlcp::Island& Stage::island_of(std::int32_t position) const {
  return *std::find_if(islands_.begin(), islands_.end(), [&](const mlcp::Island& i) { return position < i.last; });
}

std::vector<std::int32_t> Stage::row_positions() const {
  return {pattern().row_position.begin(), pattern().row_position.end()};
}

Real residual_of(const Stage& stage, const Matrix& K, const std::vector<double>& x, const std::vector<double>& b) {
  Real worst = 0, scale = 0;
  for (int p = 0; p < K.rows(); ++p) {
    if (!stage.factor.in(p)) continue;
    Real sum = b[p], size = std::abs(b[p]);
    for (int q = 0; q < K.cols(); ++q) {
      if (!stage.factor.in(q)) continue;
      sum -= K(p, q) * x[q];
      size += std::abs(K(p, q) * x[q]);
    }
    worst = std::max(worst, std::abs(sum));
    scale = std::max(scale, size);
  }
  return scale > 0 ? worst / scale : worst;
}

Vector pivots_of(const Stage& stage, const Matrix& K) {
  const auto size = static_cast<int>(K.rows());
  Matrix A = K;
  Vector d = Vector::Zero(size);
  for (int p = 0; p < size; ++p) {
    if (!stage.factor.in(p)) continue;
    d[p] = A(p, p);
    for (int i = p + 1; i < size; ++i)
      if (stage.factor.in(i))
        for (int j = p + 1; j < size; ++j)
          if (stage.factor.in(j)) A(i, j) -= A(i, p) * A(p, j) / d[p];
  }
  return d;
}

}  // namespace support
