#include "analyze/elimination_tree.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "support/random_problem.h"
#include "support/stage.h"

namespace support {
namespace {

std::vector<int> order_of(const mlcp::Problem& problem, bool reversed = false) {
  std::vector<int> order(problem.n() + problem.m());
  for (std::size_t p = 0; p < order.size(); ++p) order[p] = static_cast<int>(reversed ? order.size() - 1 - p : p);
  return order;
}

struct Tree {
  mlcp::KktPattern pattern{mlcp::Memory()};
  mlcp::EliminationTree tree{mlcp::Memory()};
  Tree(const mlcp::Problem& problem, const std::vector<std::int32_t>& order) {
    pattern.build(problem, order);
    tree.build(pattern);
  }
  std::vector<int> parent() const { return {tree.parent.begin(), tree.parent.end()}; }
};

mlcp::Problem graph_problem(int n, const std::vector<std::pair<int, int>>& edges) {
  Eigen::MatrixXd a = Eigen::MatrixXd::Identity(n, n);
  for (const auto& [i, j] : edges) a(i, j) = a(j, i) = 1;
  return reduced_problem(a, Eigen::VectorXd::Ones(n));
}

TEST(EliminationTree, PathIsAPath) {
  const mlcp::Problem p = graph_problem(4, {{0, 1}, {1, 2}, {2, 3}});
  EXPECT_EQ(Tree(p, order_of(p)).parent(), (std::vector<int>{1, 2, 3, -1}));
}

TEST(EliminationTree, StarHangsOnItsCentre) {
  const mlcp::Problem p = graph_problem(4, {{0, 3}, {1, 3}, {2, 3}});
  EXPECT_EQ(Tree(p, order_of(p)).parent(), (std::vector<int>{3, 3, 3, -1}));
  EXPECT_EQ(Tree(p, order_of(p, true)).parent(), (std::vector<int>{1, 2, 3, -1})) << "the centre first fills everything";
}

TEST(EliminationTree, NoEdgesIsAForestOfRoots) {
  const mlcp::Problem p = graph_problem(3, {});
  EXPECT_EQ(Tree(p, order_of(p)).parent(), (std::vector<int>{-1, -1, -1}));
}

TEST(EliminationTree, Empty) { EXPECT_TRUE(Tree(empty_problem(), {}).parent().empty()); }

TEST(EliminationTree, EqualsDenseElimination) {
  for (int seed = 0; seed < 300; ++seed) {
    Random random(seed);
    const mlcp::Problem p = random_problem(random, {.bodies_most = 6, .rows_most = 12});
    std::vector<std::int32_t> order = order_of(p);
    for (std::size_t q = order.size(); q > 1; --q) std::swap(order[q - 1], order[random.integer(0, static_cast<int>(q) - 1)]);
    ASSERT_EQ(Tree(p, order).parent(), tree_of(eliminate(kkt_pattern(p, order)))) << "seed " << seed;
  }
}

TEST(EliminationTree, PostorderKeepsSubtreesTogetherAndIsIdempotent) {
  for (int seed = 0; seed < 300; ++seed) {
    Random random(seed);
    const mlcp::Problem p = random_problem(random, {.bodies_most = 6, .rows_most = 12});
    std::vector<std::int32_t> order = order_of(p);
    for (std::size_t q = order.size(); q > 1; --q) std::swap(order[q - 1], order[random.integer(0, static_cast<int>(q) - 1)]);
    Tree before(p, order);
    mlcp::Array<std::int32_t> sequence{mlcp::Memory()};
    before.tree.postorder(sequence);
    std::vector<std::int32_t> after(order.size());
    for (std::size_t q = 0; q < order.size(); ++q) after[q] = order[sequence[q]];
    Tree posted(p, after);
    // a node comes right behind its last child, and descendants are contiguous
    const std::vector<int> parent = posted.parent();
    std::vector<int> least(parent.size());
    for (std::size_t q = 0; q < parent.size(); ++q) least[q] = static_cast<int>(q);
    for (std::size_t q = 0; q < parent.size(); ++q)
      if (parent[q] >= 0) least[parent[q]] = std::min(least[parent[q]], least[q]);
    std::vector<int> size(parent.size(), 1);
    for (std::size_t q = 0; q < parent.size(); ++q)
      if (parent[q] >= 0) size[parent[q]] += size[q];
    for (std::size_t q = 0; q < parent.size(); ++q) ASSERT_EQ(static_cast<int>(q) - least[q] + 1, size[q]) << "seed " << seed;
    posted.tree.postorder(sequence);
    for (std::size_t q = 0; q < sequence.size(); ++q) ASSERT_EQ(sequence[q], static_cast<int>(q)) << "seed " << seed;
    // the same fill
    ASSERT_EQ(entries(eliminate(kkt_pattern(p, order))), entries(eliminate(kkt_pattern(p, after)))) << "seed " << seed;
  }
}

std::vector<int> list(const mlcp::Array<std::int32_t>& a) { return {a.begin(), a.end()}; }

/// Some of the nodes, every row behind the velocities that it touches.
std::vector<std::int32_t> some_order(Random& random, const mlcp::Problem& problem) {
  const int n = problem.n();
  std::vector<double> when(n + problem.m());
  for (double& t : when) t = random.uniform(0, 1);
  std::vector<std::int32_t> order;
  for (int node = 0; node < static_cast<int>(when.size()); ++node)
    if (random.chance(0.85)) order.push_back(node);
  for (int i = 0; i < problem.m(); ++i)
    for (auto t = problem.jacobian.pointers[i]; t < problem.jacobian.pointers[i + 1]; ++t)
      when[n + i] = std::max(when[n + i], when[problem.jacobian.indices[t]]);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return when[a] < when[b]; });
  return order;
}

/// By the same tree for all of them: smaller problems come after larger ones.
TEST(EliminationTree, OfTheProblemIsThatOfThePattern) {
  Shape shape;
  shape.bodies_most = 6;
  shape.rows_most = 14;
  mlcp::EliminationTree tree{mlcp::Memory()};
  for (int seed = 0; seed < 400; ++seed) {
    Random random(seed);
    const mlcp::Problem p = seed % 4 ? random_problem(random, shape) : random_reduced(random, random.integer(1, 12), 3, true);
    const std::vector<std::int32_t> order = some_order(random, p);
    tree.build(p, order);
    ASSERT_EQ(list(tree.parent), tree_of(eliminate(kkt_pattern(p, order)))) << "seed " << seed;
    ASSERT_EQ(list(tree.parent), Tree(p, order).parent()) << "seed " << seed;
  }
}

TEST(EliminationTree, RelabelledIsThatOfTheRelabelledOrder) {
  Shape shape;
  shape.bodies_most = 6;
  shape.rows_most = 14;
  mlcp::EliminationTree tree{mlcp::Memory()};
  mlcp::Array<std::int32_t> sequence{mlcp::Memory()};
  int moved = 0;
  for (int seed = 0; seed < 300; ++seed) {
    Random random(seed);
    const mlcp::Problem p = random_problem(random, shape);
    std::vector<std::int32_t> order = some_order(random, p);
    tree.build(p, order);
    tree.postorder(sequence);
    tree.relabel(sequence.span());
    std::vector<std::int32_t> after;
    for (const std::int32_t q : sequence) after.push_back(order[q]);
    moved += after != order;
    ASSERT_EQ(list(tree.parent), Tree(p, after).parent()) << "seed " << seed;
    tree.postorder(sequence);
    ASSERT_TRUE(std::is_sorted(sequence.begin(), sequence.end())) << "seed " << seed;
  }
  EXPECT_GT(moved, 150);
}

}  // namespace
}  // namespace support
