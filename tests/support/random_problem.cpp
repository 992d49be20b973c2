#include "support/random_problem.h"

#include <algorithm>
#include <cmath>

namespace support {
namespace {

double number(Random& random, bool integers) { return integers ? random.integer(-1, 1) : random.uniform(); }

/// Products and sums of a few are exact, so that B Bᵀ is semidefinite and not nearly so.
double coarse(Random& random, bool integers) { return integers ? random.integer(-1, 1) : random.integer(-32, 32) / 32.0; }

struct Row {
  std::vector<Entry> entries;
  double r = 0, compliance = 0;
  Bounds bounds = unilateral;
};

Bounds random_bounds(Random& random, const Shape& shape, int& boxed) {
  if (random.chance(shape.bilateral)) return bilateral;
  if (random.chance(shape.boxed) && boxed < shape.boxed_most) {
    ++boxed;
    if (shape.integers) return {double(random.integer(-1, 0)), double(random.integer(0, 1))};
    const double lo = random.uniform(-1, 0.3);
    return {lo, random.chance(0.1) ? lo : lo + random.uniform(0, 2)};
  }
  if (random.chance(0.1)) return {-mlcp::infinity, random.chance(0.5) ? 0 : number(random, shape.integers)};
  return {random.chance(0.9) ? 0 : number(random, shape.integers), mlcp::infinity};
}

std::vector<Entry> random_entries(Random& random, const Shape& shape, const mlcp::Problem& problem) {
  std::vector<Entry> entries;
  const auto bodies = static_cast<int>(problem.bodies.size());
  std::vector<int> chosen;
  for (int s = random.integer(1, std::min(3, bodies)); s > 0; --s) {
    const int b = random.integer(0, bodies - 1);
    if (std::find(chosen.begin(), chosen.end(), b) == chosen.end()) chosen.push_back(b);
  }
  for (const int b : chosen)
    for (int j = 0; j < problem.bodies[b].dimension; ++j)
      if (random.chance(0.8)) entries.push_back({problem.bodies[b].offset + j, number(random, shape.integers)});
  return entries;
}

}  // namespace

Eigen::MatrixXd random_mass(Random& random, int dimension, bool sparse) {
  Eigen::MatrixXd mass = Eigen::MatrixXd::Zero(dimension, dimension);
  for (int j = 0; j < dimension; ++j) {
    for (int i = 0; i < j; ++i)
      if (!sparse || random.chance(2.0 / dimension)) mass(i, j) = mass(j, i) = random.uniform();
  }
  for (int j = 0; j < dimension; ++j) mass(j, j) = random.uniform(0.2, 1.5) + mass.col(j).cwiseAbs().sum();
  return mass * random.magnitude(-0.5, 0.5);
}

mlcp::Problem random_problem(Random& random, const Shape& shape) {
  mlcp::Problem problem = empty_problem();
  const int bodies = random.integer(shape.bodies_least, shape.bodies_most);
  for (int b = 0; b < bodies; ++b) {
    const int d = random.integer(1, shape.dimension_most);
    if (shape.integers)
      add_body(problem, d, random.integer(1, 2));
    else if (random.chance(shape.sparse_mass))
      add_sparse_body(problem, random_mass(random, d, true));
    else
      add_body(problem, random_mass(random, d, false));
  }
  Eigen::VectorXd k(problem.n()), point(problem.n());
  for (int j = 0; j < problem.n(); ++j) {
    k[j] = number(random, shape.integers);
    if (shape.integers && !shape.at_rest && k[j] == 0) k[j] = 2;
    point[j] = number(random, shape.integers);
  }
  set_k(problem, k);
  for (int b = 0; b < bodies; ++b) {
    if (!random.chance(shape.prescribed)) continue;
    std::vector<double> v;
    for (int j = 0; j < problem.bodies[b].dimension; ++j) v.push_back(point[problem.bodies[b].offset + j]);
    prescribe(problem, b, v);
  }

  const int m = random.integer(shape.rows_least, shape.rows_most);
  const bool feasible = random.chance(shape.feasible);
  std::vector<Row> rows;
  int boxed = 0;
  for (int i = 0; i < m; ++i) {
    Row row;
    row.bounds = random_bounds(random, shape, boxed);
    const bool copy = !rows.empty() && random.chance(shape.duplicate);
    row.entries = copy ? rows[random.integer(0, i - 1)].entries : random_entries(random, shape, problem);
    if (copy && random.chance(0.3))
      for (Entry& e : row.entries) e.value = -e.value;
    row.r = number(random, shape.integers);
    if (feasible) {
      row.r = 0;
      for (const Entry& e : row.entries) row.r += e.value * point[e.column];
      const double room = shape.integers ? random.integer(0, 1) : random.chance(0.3) ? 0 : random.uniform(0, 1);
      if (row.bounds.hi < mlcp::infinity) row.r += room;
      else if (row.bounds.lo > -mlcp::infinity) row.r -= room;
    }
    if (random.chance(shape.compliance)) row.compliance = shape.integers ? 1 : random.magnitude(-3, 0);
    rows.push_back(row);
    add_row(problem, row.entries, row.r, row.bounds, row.compliance);
  }
  // where r makes every term of a row cancel, what is left is rounding, and relative to that any error is large
  if (m > 0 && !feasible && !shape.integers && random.chance(shape.compliance_matrix)) {
    Eigen::MatrixXd B = Eigen::MatrixXd::Zero(m, std::max(1, m / 2));
    for (int i = 0; i < m; ++i)
      if (random.chance(0.6)) B(i, random.integer(0, static_cast<int>(B.cols()) - 1)) = coarse(random, false);
    set_sigma(problem, B * B.transpose());
  }
  return problem;
}

mlcp::Mask random_mask(Random& random, int rows) {
  mlcp::Mask mask{mlcp::Memory()};
  for (int i = 0; i < rows; ++i)
    mask.state.push_back(static_cast<mlcp_row_state>(random.integer(MLCP_ROW_DISABLED, MLCP_ROW_AT_UPPER)));
  return mask;
}

mlcp::Mask enabled_mask(Random& random, int rows, double disabled) {
  mlcp::Mask mask{mlcp::Memory()};
  for (int i = 0; i < rows; ++i)
    mask.state.push_back(static_cast<mlcp_row_state>(random.chance(disabled) ? MLCP_ROW_DISABLED : MLCP_ROW_AT_LOWER));
  return mask;
}

mlcp::Problem random_reduced(Random& random, int rows, int rank, bool integers) {
  Eigen::MatrixXd B(rows, rank);
  Eigen::VectorXd b(rows);
  for (int i = 0; i < rows; ++i) {
    for (int j = 0; j < rank; ++j) B(i, j) = coarse(random, integers);
    b[i] = coarse(random, integers);
  }
  if (rank < rows && random.chance(0.7)) {  // b = B t + room: feasible
    Eigen::VectorXd t(rank);
    for (int j = 0; j < rank; ++j) t[j] = coarse(random, integers);
    b = B * t;
    for (int i = 0; i < rows; ++i) b[i] += integers ? random.integer(0, 1) : std::abs(coarse(random, false)) / 4;
  }
  return reduced_problem(B * B.transpose(), b);
}

mlcp::Problem random_chain(Random& random, int links, int dimension, int joints) {
  mlcp::Problem problem = empty_problem();
  for (int b = 0; b < links; ++b) add_body(problem, random_mass(random, dimension, false));
  Eigen::VectorXd k(problem.n());
  for (int j = 0; j < problem.n(); ++j) k[j] = random.uniform();
  set_k(problem, k);
  for (int b = 0; b < links; ++b) {
    for (int s = 0; s < joints; ++s) {
      std::vector<Entry> entries;
      for (int j = 0; j < dimension; ++j) {
        entries.push_back({b * dimension + j, random.uniform()});
        if (b > 0) entries.push_back({(b - 1) * dimension + j, random.uniform()});
      }
      add_row(problem, entries, 0.1 * random.uniform(), bilateral);
    }
    std::vector<Entry> contact;
    for (int j = 0; j < dimension; ++j) contact.push_back({b * dimension + j, random.uniform()});
    add_row(problem, contact, 0.1 * random.uniform());
  }
  return problem;
}

}  // namespace support
