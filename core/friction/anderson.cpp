#include "friction/anderson.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <cmath>
#include <limits>

namespace mlcp {
namespace {

/// A residual this much larger than the best one is a failure of the extrapolation.
constexpr double grown = 30;
/// Steps without a better point after which the extrapolation is taken to go round in circles.
constexpr std::int32_t patience = 25;
/// Regularisation of the least-squares problem, relative to its columns.
constexpr double negligible = 1e-13;

double inner(const double* w, const double* f, const double* g, std::int32_t size) {
  double s = 0;
  for (std::int32_t i = 0; i < size; ++i) s += (w[i] * f[i]) * (w[i] * g[i]);
  return s;
}

}  // namespace

void Anderson::start(std::span<const std::int32_t> bounds) {
  const std::size_t groups = bounds.empty() ? 0 : bounds.size() - 1, size = bounds.empty() ? 0 : bounds.back();
  group_.resize(groups);
  for (std::size_t g = 0; g < groups; ++g)
    group_[g] = {bounds[g], bounds[g + 1] - bounds[g], 0, 0, 0, std::numeric_limits<double>::infinity(), 1};
  weight.assign(size, 1.0);
  for (Array<double>* a : {&best_x_, &best_f_, &last_x_, &last_f_}) a->resize(size);
  dx_.resize(size * depth);
  df_.resize(size * depth);
}

void Anderson::restart(std::size_t group) {
  Group& g = group_[group];
  g = {g.first, g.size, 0, 0, 0, std::numeric_limits<double>::infinity(), 1};
}

/// Columns x − last x, f − last f go to the end of the history, the oldest falls out.
void Anderson::remember(Group& g, const double* x, const double* f) {
  double *dx = dx_.data() + std::size_t(g.first) * depth, *df = df_.data() + std::size_t(g.first) * depth;
  if (g.steps > 0) {
    if (g.kept == depth) {
      std::copy(dx + g.size, dx + depth * g.size, dx);
      std::copy(df + g.size, df + depth * g.size, df);
      --g.kept;
    }
    for (std::int32_t i = 0; i < g.size; ++i) {
      dx[g.kept * g.size + i] = x[i] - last_x_[g.first + i];
      df[g.kept * g.size + i] = f[i] - last_f_[g.first + i];
    }
    ++g.kept;
  }
  std::copy_n(x, g.size, last_x_.data() + g.first);
  std::copy_n(f, g.size, last_f_.data() + g.first);
  ++g.steps;
}

void Anderson::go_back(Group& g, double* x) {
  g.kept = g.steps = g.idle = 0;
  g.damping = g.damping > 0.2 ? 0.5 * g.damping : 1;

  for (std::int32_t i = 0; i < g.size; ++i) x[i] = best_x_[g.first + i] + g.damping * best_f_[g.first + i];
}

void Anderson::step(std::size_t index, double* x, const double* f) {
  Group& g = group_[index];
  const double* w = weight.data() + g.first;
  const double size = std::sqrt(inner(w, f, f, g.size));
  if (size < g.best) {
    if (size < 0.9 * g.best) g.idle = 0;
    g.best = size;
    std::copy_n(x, g.size, best_x_.data() + g.first);
    std::copy_n(f, g.size, best_f_.data() + g.first);
  } else if (size > grown * g.best || g.idle > patience) {
    return go_back(g, x);
  }
  ++g.idle;
  remember(g, x, f);
  const double *dx = dx_.data() + std::size_t(g.first) * depth, *df = df_.data() + std::size_t(g.first) * depth;
  // θ = argmin |f − ΔF θ|, columns scaled to length 1
  using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, depth, depth>;
  using Vector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, depth, 1>;
  Matrix normal(g.kept, g.kept);
  Vector rhs(g.kept), scale(g.kept);
  for (std::int32_t a = 0; a < g.kept; ++a) {
    const double norm = std::sqrt(inner(w, df + a * g.size, df + a * g.size, g.size));
    scale[a] = norm > 0 ? 1 / norm : 0;
  }
  for (std::int32_t a = 0; a < g.kept; ++a) {
    rhs[a] = inner(w, df + a * g.size, f, g.size) * scale[a];
    for (std::int32_t b = 0; b <= a; ++b)
      normal(a, b) = normal(b, a) = inner(w, df + a * g.size, df + b * g.size, g.size) * scale[a] * scale[b];
    normal(a, a) += negligible;
  }
  Vector theta(g.kept);
  if (g.kept > 0) theta = normal.ldlt().solve(rhs);
  for (std::int32_t i = 0; i < g.size; ++i) {
    double next = x[i] + g.damping * f[i];
    for (std::int32_t a = 0; a < g.kept; ++a)
      next -= theta[a] * scale[a] * (dx[a * g.size + i] + g.damping * df[a * g.size + i]);
    x[i] = next;
  }
}

}  // namespace mlcp
