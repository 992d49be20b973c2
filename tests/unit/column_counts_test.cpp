#include "analyze/column_counts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "analyze/analysis.h"
#include "support/random_problem.h"
#include "support/stage.h"

namespace support {
namespace {

/// Counts of an order of all nodes, made a postorder of its tree.
struct Counted {
  mlcp::KktPattern pattern{mlcp::Memory()};
  mlcp::EliminationTree tree{mlcp::Memory()};
  mlcp::ColumnCounts counts{mlcp::Memory()};
  std::vector<std::int32_t> order;

  void find(const mlcp::Problem& problem, std::vector<std::int32_t> of) {
    order = std::move(of);
    pattern.build(problem, order);
    tree.build(pattern);
    mlcp::Array<std::int32_t> sequence{mlcp::Memory()};
    tree.postorder(sequence);
    for (std::int32_t& p : sequence) p = order[p];
    order.assign(sequence.begin(), sequence.end());
    pattern.build(problem, order);
    tree.build(pattern);
    counts.find(pattern, tree);
  }
  std::vector<int> count() const { return {counts.count.begin(), counts.count.end()}; }
};

std::vector<int> counts_of(const Pattern& L) {
  std::vector<int> count;
  for (const auto& column : L) count.push_back(static_cast<int>(column.size()));
  return count;
}

std::vector<std::int32_t> all_nodes(const mlcp::Problem& problem) {
  std::vector<std::int32_t> order(problem.n() + problem.m());
  std::iota(order.begin(), order.end(), 0);
  return order;
}

std::vector<std::int32_t> shuffled(Random& random, const mlcp::Problem& problem) {
  std::vector<std::int32_t> order = all_nodes(problem);
  for (std::size_t q = order.size(); q > 1; --q) std::swap(order[q - 1], order[random.integer(0, static_cast<int>(q) - 1)]);
  return order;
}

std::vector<int> counts_of_graph(int n, const std::vector<std::pair<int, int>>& edges) {
  Eigen::MatrixXd a = Eigen::MatrixXd::Identity(n, n);
  for (const auto& [i, j] : edges) a(i, j) = a(j, i) = 1;
  const mlcp::Problem problem = reduced_problem(a, Eigen::VectorXd::Ones(n));
  Counted c;
  c.find(problem, all_nodes(problem));
  return c.count();
}

TEST(ColumnCounts, OfSmallGraphs) {
  EXPECT_EQ(counts_of_graph(0, {}), std::vector<int>{});
  EXPECT_EQ(counts_of_graph(3, {}), (std::vector<int>{0, 0, 0})) << "a forest of single nodes";
  EXPECT_EQ(counts_of_graph(4, {{0, 1}, {1, 2}, {2, 3}}), (std::vector<int>{1, 1, 1, 0})) << "a path";
  EXPECT_EQ(counts_of_graph(4, {{0, 3}, {1, 3}, {2, 3}}), (std::vector<int>{1, 1, 1, 0})) << "a star with its centre last";
  EXPECT_EQ(counts_of_graph(4, {{0, 1}, {0, 2}, {0, 3}}), (std::vector<int>{3, 2, 1, 0})) << "a star with its centre first";
  EXPECT_EQ(counts_of_graph(5, {{0, 1}, {1, 2}, {2, 3}, {3, 4}, {4, 0}}), (std::vector<int>{2, 2, 2, 1, 0})) << "a cycle";
  EXPECT_EQ(counts_of_graph(5, {{0, 2}, {1, 2}, {2, 4}, {3, 4}, {0, 4}, {1, 4}}), (std::vector<int>{2, 2, 1, 1, 0})) << "two leaves whose paths meet";
}

/// Any order at all, so also rows before their velocities; the same object for larger and smaller problems.
TEST(ColumnCounts, EqualDenseEliminationInAnyOrder) {
  Shape shape;
  shape.bodies_most = 8;
  shape.rows_most = 18;
  Counted c;
  for (int seed = 0; seed < 300; ++seed) {
    Random random(seed);
    const mlcp::Problem p = random_problem(random, shape);
    c.find(p, shuffled(random, p));
    ASSERT_EQ(c.count(), counts_of(eliminate(kkt_pattern(p, c.order)))) << "seed " << seed;
  }
}

TEST(ColumnCounts, EqualDenseEliminationOnSparseGraphs) {
  Counted c;
  for (int seed = 0; seed < 200; ++seed) {
    Random random(seed);
    const int n = random.integer(2, 40);
    Eigen::MatrixXd a = Eigen::MatrixXd::Identity(n, n);
    for (int edges = random.integer(0, 2 * n); edges > 0; --edges) {
      const int i = random.integer(0, n - 1), j = random.integer(0, n - 1);
      a(i, j) = a(j, i) = 1;
    }
    const mlcp::Problem p = reduced_problem(a, Eigen::VectorXd::Ones(n));
    c.find(p, shuffled(random, p));
    ASSERT_EQ(c.count(), counts_of(eliminate(kkt_pattern(p, c.order)))) << "seed " << seed;
  }
}

/// The orders that solves use, exact and of crowded islands.
TEST(ColumnCounts, EqualDenseEliminationInTheOrdersOfTheAnalysis) {
  for (int seed = 0; seed < 60; ++seed) {
    Random random(seed);
    const mlcp::Problem p = random_chain(random, random.integer(1, 12), random.integer(1, 4), random.integer(1, 4));
    for (const bool exact : {true, false}) {
      mlcp::Analysis analysis{mlcp::Memory()};
      analysis.run(p, nullptr, exact, {});
      mlcp::ColumnCounts counts{mlcp::Memory()};
      counts.find(analysis.pattern, analysis.tree);
      ASSERT_EQ(std::vector<int>(counts.count.begin(), counts.count.end()), counts_of(eliminate(kkt_pattern(p, analysis.pattern.node.span()))))
          << "seed " << seed;
    }
  }
}

}  // namespace
}  // namespace support
