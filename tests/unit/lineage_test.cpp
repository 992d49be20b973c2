#include "analyze/lineage.h"

#include <gtest/gtest.h>

#include <vector>

#include "support/random.h"

namespace support {
namespace {

/// The same by walking up one step at a time.
int meet(const std::vector<std::int32_t>& parent, int p, int q) {
  const auto path = [&](int from) {
    std::vector<int> up;
    for (; from >= 0; from = parent[from]) up.push_back(from);
    return up;
  };
  const std::vector<int> of_p = path(p), of_q = path(q);
  for (const int a : of_p)
    if (std::find(of_q.begin(), of_q.end(), a) != of_q.end()) return a;
  return std::max(of_p.back(), of_q.back());
}

TEST(Lineage, OfAChainAStarAndTwoTrees) {
  const std::vector<std::int32_t> parent = {1, 4, 3, 4, -1, 6, -1};
  mlcp::Lineage lineage{mlcp::Memory()};
  lineage.build(parent);
  EXPECT_EQ(lineage.meet(0, 1), 1) << "one is above the other";
  EXPECT_EQ(lineage.meet(2, 0), 4) << "brothers";
  EXPECT_EQ(lineage.meet(3, 3), 3);
  EXPECT_EQ(lineage.meet(5, 2), 6) << "two trees: the later root";
}

TEST(Lineage, OfRandomForests) {
  for (int seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    // in postorder: every position takes some of the last subtrees that are still without a parent as its children
    const int size = random.integer(1, 40);
    std::vector<std::int32_t> parent(size, -1), open;
    for (int p = 0; p < size; ++p) {
      for (int children = random.integer(0, 3); children > 0 && !open.empty(); --children) {
        parent[open.back()] = p;
        open.pop_back();
      }
      open.push_back(p);
    }
    mlcp::Lineage lineage{mlcp::Memory()};
    lineage.build(parent);
    for (int p = 0; p < size; ++p)
      for (int q = 0; q < size; ++q) ASSERT_EQ(lineage.meet(p, q), meet(parent, p, q)) << p << " and " << q;
  }
}

}  // namespace
}  // namespace support
