#include "analyze/dissection.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/random_problem.h"
#include "support/stage.h"

namespace support {
namespace {

struct Cut {
  mlcp::QuotientGraph graph{mlcp::Memory()};
  mlcp::Dissection dissection{mlcp::Memory()};

  explicit Cut(const mlcp::Problem& problem) {
    mlcp::Selection selection{mlcp::Memory()};
    selection.take(problem, nullptr);
    mlcp::Crowding crowding{mlcp::Memory()};
    crowding.find(problem, selection, true);
    graph.build(problem, selection, crowding);
    dissection.cut(graph);
  }
};

Eigen::MatrixXd laplacian(int n, const std::vector<std::pair<int, int>>& edges) {
  Eigen::MatrixXd a = Eigen::MatrixXd::Identity(n, n);
  for (const auto& [i, j] : edges) {
    a(i, j) = a(j, i) = -1;
    a(i, i) += 1;
    a(j, j) += 1;
  }
  return a;
}

mlcp::Problem graph_problem(int n, const std::vector<std::pair<int, int>>& edges) {
  return reduced_problem(laplacian(n, edges), Eigen::VectorXd::Ones(n));
}

/// side × side × depth
std::vector<std::pair<int, int>> grid(int side, int depth) {
  std::vector<std::pair<int, int>> edges;
  const auto at = [&](int i, int j, int k) { return (k * side + i) * side + j; };
  for (int k = 0; k < depth; ++k)
    for (int i = 0; i < side; ++i)
      for (int j = 0; j < side; ++j) {
        if (k + 1 < depth) edges.push_back({at(i, j, k), at(i, j, k + 1)});
        if (i + 1 < side) edges.push_back({at(i, j, k), at(i + 1, j, k)});
        if (j + 1 < side) edges.push_back({at(i, j, k), at(i, j + 1, k)});
      }
  return edges;
}

/// No edge joins two subtrees, and below counts what lies under each node.
void expect_separators(const Cut& c) {
  const mlcp::Dissection& d = c.dissection;
  std::vector<std::vector<int>> above(d.parent.size());
  for (std::size_t t = 0; t < d.parent.size(); ++t)
    for (int a = static_cast<int>(t); a >= 0; a = d.parent[a]) above[t].push_back(a);
  const auto related = [&](int x, int y) {
    const auto holds = [&](int s, int t) { return std::find(above[s].begin(), above[s].end(), t) != above[s].end(); };
    return holds(d.home[x], d.home[y]) || holds(d.home[y], d.home[x]);
  };
  const mlcp::QuotientGraph& g = c.graph;
  for (int x = 0; x < g.variables; ++x) {
    ASSERT_GE(d.home[x], 0);
    for (int t = g.neighbour_pointers[x]; t < g.neighbour_pointers[x + 1]; ++t) EXPECT_TRUE(related(x, g.neighbours[t]));
  }
  for (int e = 0; e < g.elements; ++e)
    for (int s = g.element_pointers[e]; s < g.element_pointers[e + 1]; ++s)
      for (int t = g.element_pointers[e]; t < s; ++t) EXPECT_TRUE(related(g.element_variables[s], g.element_variables[t]));
  std::vector<int> below(d.parent.size(), 0);
  for (int x = 0; x < g.variables; ++x)
    for (std::size_t s = 1; s < above[d.home[x]].size(); ++s) ++below[above[d.home[x]][s]];
  for (std::size_t t = 0; t < below.size(); ++t) EXPECT_EQ(d.below[t], below[t]);
}

std::int64_t longest_path(const mlcp::Problem& problem) {
  const Stage stage(problem);
  std::int64_t longest = 0;
  for (const std::int32_t p : stage.row_positions()) longest = std::max(longest, stage.factor.path_columns(p));
  return longest;
}

TEST(Dissection, ChainHasLogarithmicPaths) {
  std::int64_t before = 0;
  for (const int links : {100, 1000, 10000}) {
    Random random(links);
    const std::int64_t longest = longest_path(random_chain(random, links, 2, 1));
    EXPECT_LE(longest, 12 + 8 * std::log2(links)) << links;
    EXPECT_TRUE(before == 0 || longest <= before + 24) << links;
    before = longest;
  }
}

TEST(Dissection, PathGraphIsCut) {
  std::vector<std::pair<int, int>> edges;
  for (int i = 0; i + 1 < 500; ++i) edges.push_back({i, i + 1});
  const Cut c(graph_problem(500, edges));
  expect_separators(c);
  EXPECT_GT(c.dissection.parent.size(), 30u);
  EXPECT_LE(longest_path(graph_problem(500, edges)), 40);
}

TEST(Dissection, TwoComponentsAreCutApart) {
  std::vector<std::pair<int, int>> edges;
  for (int i = 0; i + 1 < 200; ++i)
    if (i != 99) edges.push_back({i, i + 1});
  const Cut c(graph_problem(200, edges));
  expect_separators(c);
  EXPECT_LE(longest_path(graph_problem(200, edges)), 35);
}

TEST(Dissection, ManySingleNodes) {
  const Cut c(graph_problem(1000, {}));
  expect_separators(c);
}

TEST(Dissection, BulkyGraphIsLeftAlone) {
  EXPECT_EQ(Cut(graph_problem(512, grid(8, 8))).dissection.parent.size(), 1u);
  EXPECT_EQ(Cut(graph_problem(64, grid(8, 1))).dissection.parent.size(), 1u);
  std::vector<std::pair<int, int>> clique;
  for (int i = 0; i < 40; ++i)
    for (int j = 0; j < i; ++j) clique.push_back({i, j});
  EXPECT_EQ(Cut(graph_problem(40, clique)).dissection.parent.size(), 1u);
}

TEST(Dissection, SlenderGridIsCut) {
  const Cut c(graph_problem(400, grid(2, 100)));
  expect_separators(c);
  EXPECT_GT(c.dissection.parent.size(), 20u);
}

TEST(Dissection, EmptyGraph) { EXPECT_TRUE(Cut(empty_problem()).dissection.parent.empty()); }

TEST(Dissection, RandomGraphsAreSeparated) {
  for (int seed = 0; seed < 200; ++seed) {
    Random random(seed);
    const int n = random.integer(13, 80);
    std::vector<std::pair<int, int>> edges;
    for (int i = 1; i < n; ++i)
      if (random.chance(0.95)) edges.push_back({i, std::max(0, i - random.integer(1, 3))});
    for (int extra = random.integer(0, 4); extra > 0; --extra) {
      const int i = random.integer(0, n - 1), j = random.integer(0, n - 1);
      if (i != j) edges.push_back({i, j});
    }
    expect_separators(Cut(graph_problem(n, edges)));
    ASSERT_FALSE(HasFailure()) << "seed " << seed;
  }
}

/// Halves are cut by the levels of the whole, whether they are connected or not.
TEST(Dissection, LongTreesAndRingsAreCutByTheirLevels) {
  for (int seed = 0; seed < 8; ++seed) {
    Random random(seed);
    const int n = 500, reach = 1 + seed % 4;
    std::vector<std::pair<int, int>> edges;
    for (int i = 1; i < n; ++i) edges.push_back({i, std::max(0, i - random.integer(1, reach))});
    if (seed % 3 == 0) edges.push_back({0, n - 1});
    const Cut c(graph_problem(n, edges));
    expect_separators(c);
    EXPECT_LE(longest_path(graph_problem(n, edges)), 40) << "seed " << seed;
    EXPECT_GT(c.dissection.parent.size(), 30u) << "seed " << seed;
  }
}

/// A far half of many pieces: chains that hang on one link.
TEST(Dissection, ChainsThatMeetAreCutApart) {
  for (const int chains : {2, 3, 4, 9}) {
    constexpr int links = 80;
    std::vector<std::pair<int, int>> edges;
    for (int c = 0; c < chains; ++c)
      for (int i = 0; i < links; ++i) edges.push_back({1 + c * links + i, i > 0 ? c * links + i : 0});
    const mlcp::Problem p = graph_problem(1 + chains * links, edges);
    expect_separators(Cut(p));
    EXPECT_LE(longest_path(p), 60) << chains;
  }
}

TEST(Dissection, ElementsAreSeparated) {
  for (int seed = 0; seed < 20; ++seed) {
    Random random(seed);
    expect_separators(Cut(random_chain(random, 60, 3, 2)));
  }
}

/// By METIS, or by a level that happens to be thin.
TEST(Dissection, LargeBulkyGraphsAreCut) {
  const int side = 12;  // bodies an edge, a row for each pair of neighbours
  mlcp::Problem problem = empty_problem();
  for (int i = 0; i < side * side * side; ++i) add_body(problem, Eigen::MatrixXd::Identity(1, 1));
  for (const auto& [i, j] : grid(side, side)) add_row(problem, {{i, 1}, {j, -1}});
  const Cut c(problem), again(problem);
  expect_separators(c);
  if (!mlcp::Separator::available()) return;
  int root = 0;
  for (const int home : c.dissection.home) root += home == 0;
  EXPECT_LE(root, 4 * side * side);
  EXPECT_TRUE(std::equal(c.dissection.home.begin(), c.dissection.home.end(), again.dissection.home.begin())) << "not the same every time";
}

/// By what it tells whoever may stop it: a search of the whole rest for each part would be 200 times as much.
TEST(Dissection, CostDoesNotGrowWithTheNumberOfParts) {
  mlcp::Problem p = empty_problem();
  for (int i = 0; i < 5000; ++i) {
    add_body(p, 1, 1);
    add_row(p, {{i, 1}});
  }
  Cut c(p);
  int asked = 0;
  c.dissection.cut(c.graph, mlcp::Poll([](void* count) { return ++*static_cast<int*>(count) < 0; }, &asked));
  EXPECT_LE(asked, 1);
  expect_separators(c);
}

}  // namespace
}  // namespace support
