#include "support.h"

using namespace capi;

namespace {

std::vector<mlcp_row_state> states_of(const mlcp_mask* mask) {
  const mlcp_row_state* states = mlcp_mask_states(mask);
  return states ? std::vector<mlcp_row_state>(states, states + mlcp_mask_size(mask)) : std::vector<mlcp_row_state>{};
}

/// The mask is as before, and the text contains `part`.
template <class Call>
void expect_mask_refused(mlcp_mask* mask, mlcp_status status, const char* part, Call call) {
  const std::vector<mlcp_row_state> before = states_of(mask);
  EXPECT_EQ(call(), status);
  EXPECT_NE(std::string(mlcp_mask_error(mask)).find(part), std::string::npos) << mlcp_mask_error(mask);
  EXPECT_EQ(states_of(mask), before);
}

using States = std::vector<mlcp_row_state>;

/// A problem with rows of these keys and no bodies.
ProblemHandle keyed(const std::vector<uint64_t>& keys) {
  ProblemHandle problem = make_problem();
  for (uint64_t key : keys) add_row(problem.get(), {}, {}, key);
  return problem;
}

}  // namespace

TEST(Mask, SetGetCount) {
  MaskHandle mask = make_mask(4, MLCP_ROW_AT_LOWER);
  const mlcp_row_state states[] = {MLCP_ROW_ACTIVE, MLCP_ROW_DISABLED};
  ASSERT_EQ(mlcp_mask_set(mask.get(), 1, 2, states), MLCP_OK);
  EXPECT_EQ(states_of(mask.get()), (States{1, 2, 0, 1}));
  EXPECT_EQ(mlcp_mask_count(mask.get(), MLCP_ROW_AT_LOWER), 2);
  EXPECT_EQ(mlcp_mask_count(mask.get(), MLCP_ROW_AT_UPPER), 0);
  mlcp_row_state out[2];
  ASSERT_EQ(mlcp_mask_get(mask.get(), 2, 2, out), MLCP_OK);
  EXPECT_EQ(out[0], MLCP_ROW_DISABLED);
  EXPECT_EQ(mlcp_mask_size(mask.get()), 4);
}

TEST(Mask, Refused) {
  MaskHandle mask = make_mask(2);
  mlcp_mask* m = mask.get();
  const mlcp_row_state bad[] = {1, 4};
  mlcp_row_state out[3];
  expect_mask_refused(m, MLCP_ERROR_ARGUMENT, "states[1] = 4", [&] { return mlcp_mask_set(m, 0, 2, bad); });
  expect_mask_refused(m, MLCP_ERROR_RANGE, "first = 1", [&] { return mlcp_mask_set(m, 1, 2, bad); });
  expect_mask_refused(m, MLCP_ERROR_NULL, "states", [&] { return mlcp_mask_set(m, 0, 2, nullptr); });
  expect_mask_refused(m, MLCP_ERROR_RANGE, "count = -1", [&] { return mlcp_mask_resize(m, -1, MLCP_ROW_ACTIVE); });
  expect_mask_refused(m, MLCP_ERROR_ARGUMENT, "state = 9", [&] { return mlcp_mask_resize(m, 3, 9); });
  EXPECT_EQ(mlcp_mask_get(m, 0, 3, out), MLCP_ERROR_RANGE);
  EXPECT_EQ(mlcp_mask_get(m, 0, 2, nullptr), MLCP_ERROR_NULL);
  mlcp_mask* made = m;
  EXPECT_EQ(mlcp_mask_create(nullptr, -1, MLCP_ROW_ACTIVE, &made), MLCP_ERROR_RANGE);
  EXPECT_EQ(made, nullptr);
  EXPECT_EQ(mlcp_mask_create(nullptr, 1, 4, &made), MLCP_ERROR_ARGUMENT);
}

TEST(Mask, Resize) {
  MaskHandle mask = make_mask(1, MLCP_ROW_AT_UPPER);
  ASSERT_EQ(mlcp_mask_resize(mask.get(), 3, MLCP_ROW_DISABLED), MLCP_OK);
  EXPECT_EQ(states_of(mask.get()), (States{3, 0, 0}));
  ASSERT_EQ(mlcp_mask_resize(mask.get(), 0, MLCP_ROW_DISABLED), MLCP_OK);
  EXPECT_EQ(mlcp_mask_states(mask.get()), nullptr);
}

TEST(Mask, EqualIgnoresKeys) {
  ProblemHandle problem = keyed({5, 6});
  MaskHandle a = make_mask(2), b = make_mask(2), c = make_mask(3);
  ASSERT_EQ(mlcp_mask_take_keys(a.get(), problem.get()), MLCP_OK);
  EXPECT_EQ(mlcp_mask_equal(a.get(), b.get()), 1);
  EXPECT_EQ(mlcp_mask_equal(a.get(), c.get()), 0);
  const mlcp_row_state lower = MLCP_ROW_AT_LOWER;
  ASSERT_EQ(mlcp_mask_set(b.get(), 1, 1, &lower), MLCP_OK);
  EXPECT_EQ(mlcp_mask_equal(a.get(), b.get()), 0);
  EXPECT_EQ(mlcp_mask_equal(a.get(), nullptr), 0);
}

TEST(Mask, CloneKeepsStatesAndKeys) {
  ProblemHandle problem = keyed({5, 6});
  MaskHandle mask = make_mask(2, MLCP_ROW_AT_UPPER), carried = make_mask(0);
  ASSERT_EQ(mlcp_mask_take_keys(mask.get(), problem.get()), MLCP_OK);
  Allocator allocator;
  mlcp_mask* raw = nullptr;
  ASSERT_EQ(mlcp_mask_clone(allocator.hooks(), mask.get(), &raw), MLCP_OK);
  MaskHandle copy(raw);
  EXPECT_GT(allocator.blocks(), 0);
  ASSERT_EQ(mlcp_mask_carry(carried.get(), problem.get(), copy.get(), MLCP_ROW_DISABLED), MLCP_OK);
  EXPECT_EQ(states_of(carried.get()), (States{3, 3}));
}

TEST(Mask, TakeKeysOfAnotherSize) {
  ProblemHandle problem = keyed({5, 6});
  MaskHandle mask = make_mask(3);
  expect_mask_refused(mask.get(), MLCP_ERROR_RANGE, "3 rows", [&] { return mlcp_mask_take_keys(mask.get(), problem.get()); });
  expect_mask_refused(mask.get(), MLCP_ERROR_NULL, "problem", [&] { return mlcp_mask_take_keys(mask.get(), nullptr); });
}

TEST(Mask, CarryByKeyEqualKeysInOrder) {
  ProblemHandle before = keyed({7, 0, 8, 7, 9}), after = keyed({9, 7, 0, 7, 7, 11, 8});
  MaskHandle mask = make_mask(5), next = make_mask(0);
  const mlcp_row_state states[] = {1, 2, 3, 2, 0};
  ASSERT_EQ(mlcp_mask_set(mask.get(), 0, 5, states), MLCP_OK);
  ASSERT_EQ(mlcp_mask_take_keys(mask.get(), before.get()), MLCP_OK);
  ASSERT_EQ(mlcp_mask_carry(next.get(), after.get(), mask.get(), MLCP_ROW_AT_LOWER), MLCP_OK);
  EXPECT_EQ(states_of(next.get()), (States{0, 1, 1, 2, 1, 1, 3}));
  // onto itself
  ASSERT_EQ(mlcp_mask_carry(mask.get(), after.get(), mask.get(), MLCP_ROW_AT_LOWER), MLCP_OK);
  EXPECT_EQ(mlcp_mask_equal(mask.get(), next.get()), 1);
  ASSERT_EQ(mlcp_mask_carry(mask.get(), before.get(), mask.get(), MLCP_ROW_ACTIVE), MLCP_OK);
  EXPECT_EQ(states_of(mask.get()), (States{1, 2, 3, 2, 0}));
}

TEST(Mask, CarryManyKeys) {
  const int32_t count = 5000;
  std::vector<uint64_t> keys;
  for (int32_t i = 0; i < count; ++i) keys.push_back(uint64_t(i + 1) << 32);
  ProblemHandle before = keyed(keys), after = keyed({keys.rbegin(), keys.rend()});
  MaskHandle mask = make_mask(count), next = make_mask(0);
  States states;
  for (int32_t i = 0; i < count; ++i) states.push_back(static_cast<mlcp_row_state>(i % 4));
  ASSERT_EQ(mlcp_mask_set(mask.get(), 0, count, states.data()), MLCP_OK);
  ASSERT_EQ(mlcp_mask_take_keys(mask.get(), before.get()), MLCP_OK);
  ASSERT_EQ(mlcp_mask_carry(next.get(), after.get(), mask.get(), MLCP_ROW_ACTIVE), MLCP_OK);
  EXPECT_EQ(states_of(next.get()), States(states.rbegin(), states.rend()));
}

TEST(Mask, CarryWithoutKeys) {
  ProblemHandle problem = keyed({1, 2});
  MaskHandle previous = make_mask(2, MLCP_ROW_AT_UPPER), mask = make_mask(0);
  ASSERT_EQ(mlcp_mask_carry(mask.get(), problem.get(), previous.get(), MLCP_ROW_AT_LOWER), MLCP_OK);
  EXPECT_EQ(states_of(mask.get()), (States{1, 1}));
}

TEST(Mask, CarryRefused) {
  ProblemHandle problem = keyed({1, 2});
  MaskHandle mask = make_mask(1), previous = make_mask(1);
  mlcp_mask* m = mask.get();
  expect_mask_refused(m, MLCP_ERROR_ARGUMENT, "otherwise = 4",
                      [&] { return mlcp_mask_carry(m, problem.get(), previous.get(), 4); });
  expect_mask_refused(m, MLCP_ERROR_NULL, "problem", [&] { return mlcp_mask_carry(m, nullptr, previous.get(), 0); });
  expect_mask_refused(m, MLCP_ERROR_NULL, "previous", [&] { return mlcp_mask_carry(m, problem.get(), nullptr, 0); });
}

TEST(Mask, CarryAllocatesNothingTheSecondTime) {
  Allocator allocator;
  mlcp_mask* raw = nullptr;
  ASSERT_EQ(mlcp_mask_create(allocator.hooks(), 0, MLCP_ROW_ACTIVE, &raw), MLCP_OK);
  MaskHandle mask(raw);
  ProblemHandle problem = keyed({1, 2, 3, 4});
  for (int step = 0; step < 3; ++step) {
    if (step > 1) allocator.fail_at(0);
    ASSERT_EQ(mlcp_mask_carry(mask.get(), problem.get(), mask.get(), MLCP_ROW_ACTIVE), MLCP_OK);
  }
}

TEST(Mask, NullHandles) {
  mlcp_mask* out = nullptr;
  EXPECT_EQ(mlcp_mask_create(nullptr, 0, MLCP_ROW_ACTIVE, nullptr), MLCP_ERROR_NULL);
  EXPECT_EQ(mlcp_mask_clone(nullptr, nullptr, &out), MLCP_ERROR_NULL);
  EXPECT_EQ(mlcp_mask_size(nullptr), 0);
  EXPECT_EQ(mlcp_mask_count(nullptr, MLCP_ROW_ACTIVE), 0);
  EXPECT_EQ(mlcp_mask_states(nullptr), nullptr);
  EXPECT_EQ(mlcp_mask_resize(nullptr, 0, MLCP_ROW_ACTIVE), MLCP_ERROR_NULL);
  EXPECT_STREQ(mlcp_mask_error(nullptr), "");
  mlcp_mask_destroy(nullptr);
}
