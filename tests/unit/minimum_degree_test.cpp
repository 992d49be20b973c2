#include "analyze/minimum_degree.h"

#include <gtest/gtest.h>

#include <numeric>

#include "support/random_problem.h"
#include "support/stage.h"

namespace support {
namespace {

using Edges = std::vector<std::pair<int, int>>;

mlcp::Problem graph_problem(int n, const Edges& edges) {
  Eigen::MatrixXd a = Eigen::MatrixXd::Identity(n, n);
  for (const auto& [i, j] : edges)
    if (i != j) a(i, j) = a(j, i) = 1;
  return reduced_problem(a, Eigen::VectorXd::Ones(n));
}

/// Without dissection: one piece, nothing waits.
std::vector<int> order_of(const mlcp::Problem& problem) {
  mlcp::Selection selection{mlcp::Memory()};
  selection.take(problem, nullptr);
  mlcp::QuotientGraph graph{mlcp::Memory()};
  mlcp::Crowding crowding{mlcp::Memory()};
  crowding.find(problem, selection, true);
  graph.build(problem, selection, crowding);
  mlcp::Dissection one{mlcp::Memory()};
  one.home.assign(graph.variables, 0);
  one.parent.push_back(-1);
  one.below.push_back(0);
  mlcp::MinimumDegree degree{mlcp::Memory()};
  degree.run(graph, one);
  return {degree.order.begin(), degree.order.end()};
}

void expect_permutation(std::vector<int> order, int n) {
  std::sort(order.begin(), order.end());
  std::vector<int> all(n);
  std::iota(all.begin(), all.end(), 0);
  EXPECT_EQ(order, all);
}

std::int64_t entries_of_factor(int n, const Edges& edges, const std::vector<int>& order) {
  std::vector<int> position(n);
  for (int p = 0; p < n; ++p) position[order[p]] = p;
  Pattern a(n);
  for (const auto& [i, j] : edges)
    if (i != j) a[std::min(position[i], position[j])].insert(std::max(position[i], position[j]));
  return entries(eliminate(a));
}

/// Exact minimum degree, least index on ties.
std::vector<int> naive_order(int n, const Edges& edges) {
  std::vector<std::set<int>> adjacent(n);
  for (const auto& [i, j] : edges) {
    if (i == j) continue;
    adjacent[i].insert(j);
    adjacent[j].insert(i);
  }
  std::vector<int> order;
  std::vector<bool> done(n);
  for (int step = 0; step < n; ++step) {
    int best = -1;
    for (int i = 0; i < n; ++i)
      if (!done[i] && (best < 0 || adjacent[i].size() < adjacent[best].size())) best = i;
    done[best] = true;
    order.push_back(best);
    for (const int i : adjacent[best]) {
      adjacent[i].erase(best);
      for (const int j : adjacent[best])
        if (i != j) adjacent[i].insert(j);
    }
  }
  return order;
}

/// The order of a graph, checked to be one; returns entries of the factor.
std::int64_t fill_of(int n, const Edges& edges) {
  const std::vector<int> order = order_of(graph_problem(n, edges));
  expect_permutation(order, n);
  return testing::Test::HasFailure() ? -1 : entries_of_factor(n, edges, order);
}

TEST(MinimumDegree, EmptyGraph) { EXPECT_TRUE(order_of(empty_problem()).empty()); }

TEST(MinimumDegree, NoEdges) { EXPECT_EQ(fill_of(50, {}), 0); }

TEST(MinimumDegree, StarEliminatesLeavesFirst) {
  Edges edges;
  for (int i = 1; i < 40; ++i) edges.push_back({0, i});
  EXPECT_EQ(fill_of(40, edges), 39);
}

TEST(MinimumDegree, PathAndTreeFillNothing) {
  Edges path, tree;
  Random random(3);
  for (int i = 1; i < 200; ++i) {
    path.push_back({i - 1, i});
    tree.push_back({random.integer(0, i - 1), i});
  }
  EXPECT_EQ(fill_of(200, path), 199);
  EXPECT_EQ(fill_of(200, tree), 199);
}

TEST(MinimumDegree, CycleFillsOneEntryAStep) {
  Edges edges;
  for (int i = 0; i < 100; ++i) edges.push_back({i, (i + 1) % 100});
  EXPECT_EQ(fill_of(100, edges), 2 * 100 - 3);
}

TEST(MinimumDegree, CliqueIsOneSupervariable) {
  Edges edges;
  for (int i = 0; i < 30; ++i)
    for (int j = 0; j < i; ++j) edges.push_back({i, j});
  EXPECT_EQ(fill_of(30, edges), 30 * 29 / 2);
}

TEST(MinimumDegree, TwoCliquesSharingANode) {
  Edges edges;
  for (int i = 0; i < 20; ++i)
    for (int j = 0; j < i; ++j) {
      edges.push_back({i, j});
      edges.push_back({i + 19, j + 19});
    }
  EXPECT_EQ(fill_of(39, edges), 2 * 20 * 19 / 2);
}

TEST(MinimumDegree, GridNearExactMinimumDegree) {
  for (const int side : {5, 12, 25}) {
    Edges edges;
    for (int i = 0; i < side; ++i)
      for (int j = 0; j < side; ++j) {
        if (i + 1 < side) edges.push_back({i * side + j, (i + 1) * side + j});
        if (j + 1 < side) edges.push_back({i * side + j, i * side + j + 1});
      }
    const int n = side * side;
    EXPECT_LE(fill_of(n, edges), 1.15 * static_cast<double>(entries_of_factor(n, edges, naive_order(n, edges)))) << side;
  }
}

TEST(MinimumDegree, RandomGraphsNearExactMinimumDegree) {
  double sum = 0, naive = 0;
  for (int seed = 0; seed < 300; ++seed) {
    Random random(seed);
    const int n = random.integer(1, 60);
    Edges edges;
    for (int e = random.integer(0, 3 * n); e > 0; --e) edges.push_back({random.integer(0, n - 1), random.integer(0, n - 1)});
    const auto mine = static_cast<double>(fill_of(n, edges));
    const auto exact = static_cast<double>(entries_of_factor(n, edges, naive_order(n, edges)));
    ASSERT_FALSE(HasFailure()) << "seed " << seed;
    EXPECT_LE(mine, 1.3 * exact + 10) << "seed " << seed;
    sum += mine;
    naive += exact;
  }
  EXPECT_LE(sum, 1.03 * naive);
}

TEST(MinimumDegree, EqualRowsAreMergedAndAllOrdered) {
  mlcp::Problem p = empty_problem();
  add_body(p, 3, 1);
  for (int i = 0; i < 50; ++i) add_row(p, {{0, 1}, {1, 1}, {2, 1}});
  expect_permutation(order_of(p), 50);
}

TEST(MinimumDegree, RowWaitsForItsVelocities) {
  for (int seed = 0; seed < 100; ++seed) {
    Random random(seed);
    mlcp::Problem p = empty_problem();
    add_sparse_body(p, random_mass(random, random.integer(13, 40), true));
    const int n = p.n();
    for (int i = random.integer(1, 20); i > 0; --i) {
      std::vector<Entry> entries;
      for (int j = 0; j < n; ++j)
        if (random.chance(0.1)) entries.push_back({j, random.uniform()});
      add_row(p, entries);
    }
    mlcp::Selection selection{mlcp::Memory()};
    selection.take(p, nullptr);
    mlcp::QuotientGraph g{mlcp::Memory()};
    mlcp::Crowding crowding{mlcp::Memory()};
    crowding.find(p, selection, true);
    g.build(p, selection, crowding);
    const std::vector<int> order = order_of(p);
    expect_permutation(order, g.variables);
    ASSERT_FALSE(HasFailure()) << "seed " << seed;
    std::vector<int> position(g.variables);
    for (int q = 0; q < g.variables; ++q) position[order[q]] = q;
    for (int i = 0; i < p.m(); ++i)
      for (auto t = p.jacobian.pointers[i]; t < p.jacobian.pointers[i + 1]; ++t)
        if (const int x = g.variable_of[p.jacobian.indices[t]]; x >= 0) {
          ASSERT_LT(position[x], position[g.variable_of[n + i]]) << "seed " << seed;
        }
  }
}

}  // namespace
}  // namespace support
