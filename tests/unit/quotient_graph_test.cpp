#include "analyze/quotient_graph.h"

#include <gtest/gtest.h>

#include <set>

#include "assemble/bodies.h"
#include "support/random_problem.h"
#include "support/stage.h"

namespace support {
namespace {

mlcp::QuotientGraph graph_of(const mlcp::Problem& problem, const mlcp::Mask* enabled = nullptr) {
  mlcp::Selection selection{mlcp::Memory()};
  selection.take(problem, enabled);
  mlcp::QuotientGraph graph{mlcp::Memory()};
  mlcp::Crowding crowding{mlcp::Memory()};
  crowding.find(problem, selection, true);
  graph.build(problem, selection, crowding);
  return graph;
}

std::set<int> elements_of(const mlcp::QuotientGraph& g, int x) {
  return {g.variable_elements.begin() + g.variable_pointers[x], g.variable_elements.begin() + g.variable_pointers[x + 1]};
}
std::set<int> neighbours_of(const mlcp::QuotientGraph& g, int x) {
  return {g.neighbours.begin() + g.neighbour_pointers[x], g.neighbours.begin() + g.neighbour_pointers[x + 1]};
}

Eigen::MatrixXd tridiagonal(int n) {
  Eigen::MatrixXd a = 4 * Eigen::MatrixXd::Identity(n, n);
  for (int i = 0; i + 1 < n; ++i) a(i, i + 1) = a(i + 1, i) = 1;
  return a;
}

TEST(QuotientGraph, SmallBodiesBecomeElements) {
  mlcp::Problem p = empty_problem();
  add_body(p, 3, 1);
  add_body(p, 6, 2);
  add_row(p, {{0, 1}, {8, 1}});
  add_row(p, {{4, 1}});
  const mlcp::QuotientGraph g = graph_of(p);
  EXPECT_EQ(g.variables, 2);
  EXPECT_EQ(g.elements, 2);
  EXPECT_EQ(elements_of(g, g.variable_of[9]).size(), 2u);
  EXPECT_TRUE(elements_of(g, g.variable_of[10]).count(g.element_of[4]));
}

TEST(QuotientGraph, VelocitiesCoupledByMassAreOneElement) {
  mlcp::Problem p = empty_problem();
  Random random(1);
  add_body(p, random_mass(random, 3, false));
  add_body(p, random_mass(random, 3, false));
  add_row(p, {{0, 1}, {2, 1}});
  const mlcp::QuotientGraph g = graph_of(p);
  EXPECT_EQ(g.elements, 2);
  EXPECT_EQ(g.element_of[0], g.element_of[2]);
  EXPECT_NE(g.element_of[0], g.element_of[3]);
  EXPECT_EQ(elements_of(g, 0), std::set<int>{g.element_of[0]});
}

TEST(QuotientGraph, LargeBodyStaysVelocities) {
  mlcp::Problem p = empty_problem();
  add_sparse_body(p, tridiagonal(20));
  add_row(p, {{0, 1}, {19, 1}});
  const mlcp::QuotientGraph g = graph_of(p);
  EXPECT_EQ(g.elements, 0);
  EXPECT_EQ(g.variables, 21);
  const int row = g.variable_of[20];
  EXPECT_EQ(neighbours_of(g, row), (std::set<int>{g.variable_of[0], g.variable_of[19]}));
  EXPECT_EQ(neighbours_of(g, g.variable_of[0]), (std::set<int>{g.variable_of[1], row}));
  EXPECT_EQ(g.own_rows.size(), 2u);
}

TEST(QuotientGraph, DisconnectedPartsOfOneMassAreApart) {
  mlcp::Problem p = empty_problem();
  add_sparse_body(p, Eigen::MatrixXd::Identity(20, 20));
  EXPECT_EQ(graph_of(p).elements, 20);
}

TEST(QuotientGraph, PrescribedBodyJoinsNothing) {
  mlcp::Problem p = empty_problem();
  for (int b = 0; b < 3; ++b) add_body(p, 1, 1);
  add_row(p, {{0, 1}, {1, -1}});
  add_row(p, {{1, 1}, {2, -1}});
  prescribe(p, 1, {0.5});
  const mlcp::QuotientGraph g = graph_of(p);
  EXPECT_EQ(g.elements, 2);
  EXPECT_EQ(g.element_of[1], -1);
  EXPECT_EQ(elements_of(g, 0).size(), 1u);
  EXPECT_EQ(Stage(p).islands().size(), 2u);
  mlcp::body_set_dynamic(p, 1);
  EXPECT_EQ(Stage(p).islands().size(), 1u);
}

TEST(QuotientGraph, RowOnTheWorldAloneTouchesNothing) {
  mlcp::Problem p = empty_problem();
  add_body(p, 1, 1);
  add_row(p, {});
  add_row(p, {{0, 1}});
  const mlcp::QuotientGraph g = graph_of(p);
  EXPECT_TRUE(elements_of(g, 0).empty());
  EXPECT_TRUE(neighbours_of(g, 0).empty());
  EXPECT_EQ(Stage(p).islands().size(), 2u);
}

TEST(QuotientGraph, DisabledRowJoinsNothing) {
  mlcp::Problem p = empty_problem();
  add_body(p, 1, 1);
  add_body(p, 1, 1);
  add_row(p, {{0, 1}, {1, -1}});
  add_row(p, {{0, 1}});
  add_row(p, {{1, 1}});
  const mlcp::Mask enabled = mask_of({MLCP_ROW_DISABLED, MLCP_ROW_ACTIVE, MLCP_ROW_ACTIVE});
  EXPECT_EQ(graph_of(p, &enabled).variables, 2);
  EXPECT_EQ(Stage(p, &enabled).islands().size(), 2u);
  EXPECT_EQ(Stage(p).islands().size(), 1u);
}

TEST(QuotientGraph, RowsCoupledByComplianceAreNeighbours) {
  const mlcp::Problem p = reduced_problem((Eigen::Matrix3d() << 1, 1, 0, 1, 2, 0, 0, 0, 1).finished(), Eigen::Vector3d(1, 1, 1));
  const mlcp::QuotientGraph g = graph_of(p);
  EXPECT_EQ(neighbours_of(g, 0), std::set<int>{1});
  EXPECT_TRUE(neighbours_of(g, 2).empty());
}

/// Two bodies, ten times two equal rows between them and five on one velocity alone: crowded, unless the pivoting method is to run.
struct Crowd {
  mlcp::Problem problem = empty_problem();
  mlcp::Selection selection{mlcp::Memory()};
  mlcp::Crowding crowding{mlcp::Memory()};
  mlcp::QuotientGraph graph{mlcp::Memory()};
  explicit Crowd(bool exact, bool coupled = false) {
    for (int b = 0; b < 2; ++b) add_body(problem, 3, 1);
    for (int i = 0; i < 20; ++i) add_row(problem, {{i / 2 % 3, 1.0 + i}, {3 + i / 2 % 2, -1}});
    for (int i = 0; i < 5; ++i) add_row(problem, {{5, 1.0 + i}});
    if (coupled) set_sigma(problem, Eigen::MatrixXd::Constant(25, 25, 0.1));
    selection.take(problem, nullptr);
    crowding.find(problem, selection, exact);
    graph.build(problem, selection, crowding);
  }
};

TEST(QuotientGraph, EqualRowsOfACrowdAreOneVariableAndRowsOfOneVelocityNone) {
  const mlcp::QuotientGraph g = Crowd(false).graph;
  EXPECT_EQ(g.elements, 0);
  EXPECT_EQ(g.variables, 6 + 10);
  for (int i = 0; i < 20; ++i) EXPECT_EQ(g.leader[i], i % 2 == 0 ? -1 : g.variable_of[6 + i - 1]);
  for (int i = 20; i < 25; ++i) EXPECT_EQ(g.leader[i], g.variable_of[5]);
  for (int x = 0; x < g.variables; ++x) EXPECT_EQ(g.weight[x], x < 6 ? 1 : 2);
}

TEST(QuotientGraph, RowsThatPivotOrAreCoupledStandForThemselves) {
  for (const Crowd& c : {Crowd(true), Crowd(false, true)}) {
    for (const int leader : c.graph.leader) EXPECT_EQ(leader, -1);
    for (const int weight : c.graph.weight) EXPECT_EQ(weight, 1);
  }
  EXPECT_EQ(Crowd(false, true).graph.variables, 6 + 25);
}

TEST(QuotientGraph, NoBodiesNoRows) {
  const mlcp::QuotientGraph g = graph_of(empty_problem());
  EXPECT_EQ(g.variables, 0);
  EXPECT_EQ(g.elements, 0);
}

/// Rows share an island exactly when dense elimination connects them.
TEST(QuotientGraph, IslandsAreConnectedComponents) {
  Shape shape;
  shape.bodies_most = 8;
  shape.prescribed = 0.3;
  for (int seed = 0; seed < 300; ++seed) {
    Random random(seed);
    const mlcp::Problem p = random_problem(random, shape);
    const Stage stage(p);
    const mlcp::KktPattern& k = stage.pattern();
    const Pattern a = kkt_pattern(p, k.node.span());
    std::vector<int> component(k.size());
    for (int q = 0; q < k.size(); ++q) component[q] = q;
    for (bool changed = true; changed;) {
      changed = false;
      for (int q = 0; q < k.size(); ++q)
        for (const int r : a[q])
          if (component[q] != component[r]) {
            component[q] = component[r] = std::min(component[q], component[r]);
            changed = true;
          }
    }
    std::set<int> roots(component.begin(), component.end());
    ASSERT_EQ(stage.islands().size(), roots.size()) << "seed " << seed;
    for (const mlcp::Island& island : stage.islands())
      for (int q = island.first; q < island.last; ++q) ASSERT_EQ(component[q], component[island.first]) << "seed " << seed;
  }
}

}  // namespace
}  // namespace support
