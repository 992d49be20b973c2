#include <algorithm>
#include <map>
#include <random>

#include "support.h"

using namespace capi;

namespace {

/// Bodies come and go at random; every velocity carries its name in k, every row in its values.
struct Churn {
  ProblemHandle problem = make_problem();
  mlcp_problem* p = problem.get();
  std::mt19937 random;
  std::map<int32_t, int32_t> names;  ///< id → name of the body's first velocity
  std::map<int32_t, int32_t> dimensions;
  int32_t next_name = 1;

  explicit Churn(unsigned seed) : random(seed) {}

  int32_t range(int32_t id) const {
    int32_t first = -1;
    EXPECT_EQ(mlcp_problem_body_range(p, id, &first, nullptr), MLCP_OK);
    return first;
  }

  /// Mass, momentum and the smallest free id.
  void add() {
    const int32_t d = 1 + static_cast<int32_t>(random() % 4);
    std::vector<int32_t> pointers, rows;
    std::vector<double> values;
    for (int32_t j = 0; j < d; ++j) {
      pointers.push_back(static_cast<int32_t>(rows.size()));
      for (int32_t i = d - 1; i >= j; --i) {
        rows.push_back(i);
        values.push_back(i == j ? 100 + next_name : 0.5);
      }
    }
    pointers.push_back(static_cast<int32_t>(rows.size()));
    int32_t id = -1;
    if (random() % 2) {
      std::vector<double> mass(static_cast<size_t>(d) * d, 0.5);
      for (int32_t j = 0; j < d; ++j) mass[static_cast<size_t>(j) * d + j] = 100 + next_name;
      ASSERT_EQ(mlcp_problem_bodies_add(p, 1, d, mass.data(), 0, &id), MLCP_OK);
    } else {
      ASSERT_EQ(mlcp_problem_body_add_sparse(p, d, pointers.data(), rows.data(), values.data(), MLCP_LOWER, &id), MLCP_OK);
    }
    int32_t free = 0;
    while (names.count(free)) ++free;
    EXPECT_EQ(id, free);
    names[id] = next_name;
    dimensions[id] = d;
    std::vector<double> k(d);
    for (double& x : k) x = next_name++;
    ASSERT_EQ(mlcp_problem_set_momentum(p, range(id), d, k.data()), MLCP_OK);
  }

  void add_rows() {
    for (const auto& [id, name] : names)
      if (random() % 3 == 0) add_row(p, {range(id)}, {static_cast<double>(name)});
  }

  void remove() {
    if (names.empty()) return;
    auto at = names.begin();
    std::advance(at, random() % names.size());
    const mlcp_status status = mlcp_problem_body_remove(p, at->first);
    if (status == MLCP_ERROR_STATE) return;
    ASSERT_EQ(status, MLCP_OK);
    dimensions.erase(at->first);
    names.erase(at);
  }

  void check() const {
    const int32_t n = mlcp_problem_velocity_count(p);
    std::vector<double> k(n);
    ASSERT_EQ(mlcp_problem_get_momentum(p, n, k.data()), MLCP_OK);
    const std::vector<double> mass = dense(mass_of(p), false);
    int32_t offset = 0;
    for (const auto& [id, name] : names) {
      ASSERT_EQ(range(id), offset);
      const int32_t d = dimensions.at(id);
      for (int32_t i = 0; i < d; ++i) {
        EXPECT_EQ(k[offset + i], name + i);
        for (int32_t j = 0; j < n; ++j) {
          const bool inside = j >= offset && j < offset + d;
          EXPECT_EQ(mass[static_cast<size_t>(offset + i) * n + j], !inside ? 0 : j == offset + i ? 100 + name : 0.5);
        }
      }
      offset += d;
    }
    EXPECT_EQ(n, offset);
    const Matrix j = jacobian_of(p);
    for (size_t e = 0; e < j.values.size(); ++e) EXPECT_EQ(k[j.indices[e]], j.values[e]);
  }
};

}  // namespace

TEST(BodyChurn, OffsetsMassesAndColumnsFollow) {
  for (unsigned seed = 1; seed <= 10; ++seed) {
    Churn churn(seed);
    for (int step = 0; step < 60; ++step) {
      if (step % 20 == 10) churn.add_rows();
      if (step % 20 == 19) {
        ASSERT_EQ(mlcp_problem_rows_clear(churn.p), MLCP_OK);
      }
      if (churn.random() % 5 < 3)
        churn.add();
      else
        churn.remove();
      churn.check();
    }
    // a replay knows the same ids
    const Bytes bytes = snapshot(churn.p);
    mlcp_problem* raw = nullptr;
    ASSERT_EQ(mlcp_snapshot_read(bytes.data(), bytes.size(), nullptr, &raw, nullptr, nullptr, nullptr, nullptr, 0), MLCP_OK);
    churn.problem.reset(raw);
    churn.p = raw;
    EXPECT_EQ(snapshot(raw), bytes);
    for (int i = 0; i < 5; ++i) churn.add();
    churn.check();
  }
}
