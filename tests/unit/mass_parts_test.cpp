#include "analyze/mass_parts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "analyze/analysis.h"
#include "support/random_problem.h"

namespace support {
namespace {

/// Of every position: the least one that M connects it with, by Warshall's algorithm.
std::vector<int> connected(const mlcp::Problem& problem, const mlcp::KktPattern& pattern) {
  const int size = pattern.size();
  std::vector<int> least(size);
  for (int p = 0; p < size; ++p) least[p] = p;
  for (bool changed = true; changed;) {
    changed = false;
    for (int p = 0; p < size; ++p) {
      if (pattern.is_row(p)) continue;
      const int j = pattern.node[p];
      for (auto t = problem.mass.pointers[j]; t < problem.mass.pointers[j + 1]; ++t) {
        const int q = pattern.position[problem.mass.indices[t]];
        if (q < 0 || least[q] >= least[p]) continue;
        least[p] = least[q];
        changed = true;
      }
    }
  }
  return least;
}

void expect_parts(const mlcp::Problem& problem, const mlcp::Analysis& analysis) {
  const mlcp::KktPattern& pattern = analysis.pattern;
  const mlcp::MassParts& parts = analysis.parts;
  const std::vector<int> least = connected(problem, pattern);
  std::map<int, std::set<int>> components;
  for (int p = 0; p < pattern.size(); ++p)
    if (!pattern.is_row(p)) components[least[p]].insert(p);
  const auto first_row = [&](int p) {
    const auto begin = pattern.lower_pointers[p];
    return begin < pattern.lower_pointers[p + 1] ? pattern.lower_rows[begin] : -1;
  };

  // a part is one component, or up to four velocities in sequence that only rows couple, and the same row first
  std::vector<std::set<int>> members(parts.count());
  for (int p = 0; p < pattern.size(); ++p) {
    if (pattern.is_row(p)) {
      ASSERT_EQ(parts.part_of[p], -1);
      continue;
    }
    const std::set<int>& component = components[least[p]];
    ASSERT_EQ(parts.part_of[p] < 0, static_cast<int>(component.size()) > mlcp::MassParts::largest);
    if (parts.part_of[p] < 0) continue;
    members[parts.part_of[p]].insert(p);
    for (const int q : component) ASSERT_EQ(parts.part_of[q], parts.part_of[p]);
  }
  int last_first = -1;
  for (int part = 0; part < parts.count(); ++part) {
    const std::set<int>& of = members[part];
    ASSERT_FALSE(of.empty());
    const int first = *of.begin();
    ASSERT_GT(first, last_first) << "parts ascend with their first position";
    last_first = first;
    ASSERT_EQ(std::vector<int>(of.begin(), of.end()), std::vector<int>(parts.members.begin() + parts.pointers[part], parts.members.begin() + parts.pointers[part + 1]));
    ASSERT_EQ(parts.first_four[part + 1] - parts.first_four[part], (parts.size(part) + 3) / 4);
    ASSERT_EQ(parts.block[part + 1] - parts.block[part], parts.size(part) * parts.size(part));
    if (components[first] == of) continue;
    ASSERT_LE(of.size(), 4u);
    for (const int p : of) {
      ASSERT_EQ(components[p].size(), 1u);
      ASSERT_EQ(first_row(p), first_row(first));
      ASSERT_GE(first_row(p), 0);
    }
    ASSERT_EQ(*of.rbegin() - first + 1, static_cast<int>(of.size()));
  }

  // the parts of an island are a range
  ASSERT_EQ(static_cast<int>(parts.before.size()), pattern.size() + 1);
  for (int p = 0; p <= pattern.size(); ++p)
    ASSERT_EQ(parts.before[p], std::count_if(members.begin(), members.end(), [&](const std::set<int>& of) { return *of.begin() < p; }));
  for (const mlcp::Island& island : analysis.symbolic.islands)
    for (int part = parts.before[island.first]; part < parts.before[island.last]; ++part)
      for (const int p : members[part]) ASSERT_TRUE(p >= island.first && p < island.last);

  // rows: entries of J before those of Σ, and all fours of every part that they touch, once
  for (int o = 0; o < pattern.rows(); ++o) {
    const auto begin = pattern.row_pointers[o], end = pattern.row_pointers[o + 1];
    std::set<int> touched;
    bool large = false;
    for (auto t = begin; t < end; ++t) {
      const int q = pattern.row_columns[t];
      ASSERT_EQ(pattern.is_row(q), t >= parts.beside[o]);
      if (pattern.is_row(q)) continue;
      large |= parts.part_of[q] < 0;
      if (parts.part_of[q] >= 0) touched.insert(parts.part_of[q]);
    }
    ASSERT_TRUE(begin <= parts.beside[o] && parts.beside[o] <= end);
    ASSERT_EQ(parts.reachable[o], !large);
    std::vector<int> fours;
    std::int64_t entries = 0;
    std::set<int> listed;
    for (int s = parts.response_part_pointers[o]; s < parts.response_part_pointers[o + 1]; ++s) {
      const int part = parts.response_parts[s];
      ASSERT_TRUE(listed.insert(part).second);
      entries += parts.size(part);
      for (int f = parts.first_four[part]; f < parts.first_four[part + 1]; ++f) fours.push_back(f);
    }
    ASSERT_EQ(listed, touched);
    ASSERT_EQ(fours, std::vector<int>(parts.fours.begin() + parts.four_pointers[o], parts.fours.begin() + parts.four_pointers[o + 1]));
    ASSERT_EQ(parts.response_pointers[o + 1] - parts.response_pointers[o], entries);
  }
}

/// Masses without entries off the diagonal.
void add_diagonal_body(mlcp::Problem& problem, int dimension, double mass) {
  add_sparse_body(problem, Eigen::MatrixXd(mass * Eigen::MatrixXd::Identity(dimension, dimension)));
}

/// Bodies with dense, sparse and diagonal masses, rows on some of their velocities.
mlcp::Problem mixed(Random& random) {
  mlcp::Problem p = empty_problem();
  for (int b = random.integer(1, 6); b > 0; --b) {
    const int d = random.integer(1, 9);
    if (random.chance(0.5))
      add_diagonal_body(p, d, random.uniform(1, 2));
    else
      add_sparse_body(p, random_mass(random, d, random.chance(0.5)));
  }
  set_k(p, Eigen::VectorXd::Ones(p.n()));
  for (int i = random.integer(1, 12); i > 0; --i) {
    std::vector<Entry> entries;
    for (int j = 0; j < p.n(); ++j)
      if (random.chance(3.0 / p.n())) entries.push_back({j, random.uniform()});
    add_row(p, entries, 0, unilateral, random.chance(0.3) ? 1 : 0);
  }
  return p;
}

TEST(MassParts, AreWhatMassesConnect) {
  mlcp::Analysis analysis{mlcp::Memory()};
  Shape shape;
  shape.dimension_most = 9;
  shape.rows_most = 10;
  for (int seed = 0; seed < 300; ++seed) {
    Random random(seed);
    const mlcp::Problem p = seed % 2 ? mixed(random) : random_problem(random, shape);
    analysis.run(p, nullptr, true, {});
    expect_parts(p, analysis);
    ASSERT_FALSE(HasFatalFailure()) << "seed " << seed;
  }
}

/// Velocities in sequence that do not go together, as orders of the caller have them.
TEST(MassParts, AreWhatMassesConnectInAnyOrder) {
  mlcp::Analysis analysis{mlcp::Memory()};
  for (int seed = 0; seed < 300; ++seed) {
    Random random(seed);
    const mlcp::Problem p = mixed(random);
    analysis.run(p, nullptr, true, {});
    std::vector<double> when(p.n() + p.m());
    for (double& t : when) t = random.uniform(0, 1);
    for (int i = 0; i < p.m(); ++i)
      for (auto t = p.jacobian.pointers[i]; t < p.jacobian.pointers[i + 1]; ++t) when[p.n() + i] = std::max(when[p.n() + i], when[p.jacobian.indices[t]]);
    std::vector<std::int32_t> order(analysis.ordering.order.begin(), analysis.ordering.order.end());
    std::sort(order.begin(), order.end());
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return when[a] < when[b]; });
    analysis.run(p, nullptr, true, order);
    expect_parts(p, analysis);
    ASSERT_FALSE(HasFatalFailure()) << "seed " << seed;
  }
}

TEST(MassParts, CrowdedIslandsToo) {
  mlcp::Analysis analysis{mlcp::Memory()};
  for (int seed = 0; seed < 30; ++seed) {
    Random random(seed);
    const mlcp::Problem p = random_chain(random, random.integer(4, 10), random.integer(1, 4), random.integer(4, 9));
    analysis.run(p, nullptr, false, {});
    expect_parts(p, analysis);
    ASSERT_FALSE(HasFatalFailure()) << "seed " << seed;
  }
}

TEST(MassParts, VelocitiesOfAPointMassFillOneFour) {
  mlcp::Problem p = empty_problem();
  for (int b = 0; b < 3; ++b) add_diagonal_body(p, 3, 1 + b);
  for (int b = 0; b < 3; ++b) {
    std::vector<Entry> entries;
    for (int j = 0; j < 3; ++j) {
      entries.push_back({3 * b + j, 1.0 + j});
      if (b > 0) entries.push_back({3 * b - 3 + j, -1.0 - j});
    }
    add_row(p, entries);
  }
  mlcp::Analysis analysis{mlcp::Memory()};
  analysis.run(p, nullptr, true, {});
  ASSERT_EQ(analysis.parts.count(), 3);
  EXPECT_EQ(analysis.parts.first_four.back(), 3);
  for (int part = 0; part < 3; ++part) EXPECT_EQ(analysis.parts.size(part), 3);
}

TEST(MassParts, MoreThanFourVelocitiesAloneAreSeveralParts) {
  mlcp::Problem p = empty_problem();
  add_diagonal_body(p, 10, 2);
  std::vector<Entry> entries;
  for (int j = 0; j < 10; ++j) entries.push_back({j, 1.0});
  add_row(p, entries);
  mlcp::Analysis analysis{mlcp::Memory()};
  analysis.run(p, nullptr, true, {});
  expect_parts(p, analysis);
  ASSERT_EQ(analysis.parts.count(), 3);
  EXPECT_EQ(analysis.parts.size(0), 4);
  EXPECT_EQ(analysis.parts.size(1), 4);
  EXPECT_EQ(analysis.parts.size(2), 2);
}

TEST(MassParts, LargePartsAreStruckOut) {
  mlcp::Problem p = empty_problem();
  Random random(4);
  constexpr int largest = mlcp::MassParts::largest;
  add_body(p, random_mass(random, largest, false));
  add_body(p, random_mass(random, largest + 1, false));
  add_row(p, {{0, 1}});
  add_row(p, {{largest, 1}});
  add_row(p, {{0, 1}, {largest, 1}});
  mlcp::Analysis analysis{mlcp::Memory()};
  analysis.run(p, nullptr, true, {});
  expect_parts(p, analysis);
  EXPECT_EQ(analysis.parts.count(), 1);
  for (const int row : {0, 1, 2}) {
    const int o = analysis.pattern.row_ordinal[analysis.pattern.position[p.n() + row]];
    EXPECT_EQ(analysis.parts.reachable[o], row == 0) << row;
  }
}

}  // namespace
}  // namespace support
