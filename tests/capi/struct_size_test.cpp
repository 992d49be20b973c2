#include <cstddef>

#include "support.h"

using namespace capi;

namespace {

/// A caller's struct as a newer header would have it.
template <class Struct>
struct Newer {
  Struct known;
  uint64_t added;
};

struct StructSize : testing::Test {
  ProblemHandle problem = make_problem();
  mlcp_problem* p = problem.get();
};

}  // namespace

TEST_F(StructSize, InitFillsOnlyWhatTheCallerHas) {
  struct {
    mlcp_settings settings;
  } box;
  std::memset(&box, 0x5a, sizeof box);
  const size_t old = offsetof(mlcp_settings, max_work);
  mlcp_settings_init(&box.settings, old);
  EXPECT_EQ(box.settings.struct_size, old);
  EXPECT_EQ(box.settings.tolerance, 1e-9);
  EXPECT_EQ(box.settings.max_work, 0x5a5a5a5a5a5a5a5a);
}

TEST_F(StructSize, InitOfANewerStructZeroesTheRest) {
  Newer<mlcp_settings> newer;
  std::memset(&newer, 0x5a, sizeof newer);
  mlcp_settings_init(&newer.known, sizeof newer);
  EXPECT_EQ(newer.known.struct_size, sizeof newer);
  EXPECT_EQ(newer.added, 0u);
}

TEST_F(StructSize, InitOfNullAndNothing) {
  mlcp_settings_init(nullptr, sizeof(mlcp_settings));
  mlcp_rows_init(nullptr, sizeof(mlcp_rows));
  mlcp_report_init(nullptr, sizeof(mlcp_report));
  mlcp_rows rows;
  std::memset(&rows, 0x5a, sizeof rows);
  mlcp_rows_init(&rows, 0);
  EXPECT_EQ(rows.count, 0x5a5a5a5a);
}

TEST_F(StructSize, DefaultsAreAsDocumented) {
  mlcp_settings s;
  mlcp_settings_init(&s, sizeof s);
  EXPECT_EQ(s.struct_size, sizeof s);
  EXPECT_EQ(s.method, MLCP_METHOD_AUTO);
  EXPECT_EQ(s.pivot_rule, MLCP_PIVOT_DUAL);
  EXPECT_EQ(s.refactorize, MLCP_REFACTORIZE_WHEN_NEEDED);
  EXPECT_EQ(s.trace, 0);
  EXPECT_EQ(s.tolerance, 1e-9);
  EXPECT_EQ(s.max_iterations, 0);
  EXPECT_EQ(s.max_work, 0);
  EXPECT_EQ(s.max_seconds, 0);
  EXPECT_EQ(s.progress, nullptr);
}

TEST_F(StructSize, OlderRowsTakeDefaultsForWhatTheyLack) {
  mlcp_rows rows;
  std::memset(&rows, 0x5a, sizeof rows);
  mlcp_rows_init(&rows, offsetof(mlcp_rows, compliance));
  rows.count = 1;
  const double r = 4;
  rows.r = &r;
  ASSERT_EQ(mlcp_problem_rows_add(p, &rows, nullptr), MLCP_OK) << mlcp_problem_error(p);
  double compliance = -1, stored = 0;
  uint64_t key = 1;
  ASSERT_EQ(mlcp_problem_get_rows(p, 1, &stored, nullptr, nullptr, &compliance, &key), MLCP_OK);
  EXPECT_EQ(stored, 4);
  EXPECT_EQ(compliance, 0);
  EXPECT_EQ(key, 0u);
}

TEST_F(StructSize, NewerRowsOnlyIfTheirNewFieldsAreZero) {
  Newer<mlcp_rows> newer;
  mlcp_rows_init(&newer.known, sizeof newer);
  newer.known.count = 1;
  EXPECT_EQ(mlcp_problem_rows_add(p, &newer.known, nullptr), MLCP_OK);
  newer.added = 1;
  expect_refused(p, MLCP_ERROR_UNSUPPORTED, "rows", [&] { return mlcp_problem_rows_add(p, &newer.known, nullptr); });
}

TEST_F(StructSize, AbsurdSizes) {
  mlcp_rows rows;
  mlcp_rows_init(&rows, sizeof rows);
  for (size_t size : {size_t(0), size_t(4), size_t(8), sizeof rows - 3, size_t(1) << 20, SIZE_MAX}) {
    rows.struct_size = size;
    expect_refused(p, MLCP_ERROR_ARGUMENT, "struct_size", [&] { return mlcp_problem_rows_add(p, &rows, nullptr); });
  }
}

TEST_F(StructSize, AbsurdSizesOfTheOthers) {
  mlcp_rows_f32 rows{};
  expect_refused(p, MLCP_ERROR_ARGUMENT, "struct_size", [&] { return mlcp_problem_rows_add_f32(p, &rows, nullptr); });
  mlcp_matrix_view view{};
  EXPECT_EQ(mlcp_problem_mass(p, &view), MLCP_ERROR_ARGUMENT);
  EXPECT_EQ(mlcp_problem_jacobian(p, &view), MLCP_ERROR_ARGUMENT);
  EXPECT_EQ(mlcp_problem_compliance(p, &view), MLCP_ERROR_ARGUMENT);
  EXPECT_EQ(mlcp_problem_mass(p, nullptr), MLCP_ERROR_NULL);
  EXPECT_EQ(mlcp_problem_mass(nullptr, &view), MLCP_ERROR_NULL);
  mlcp_settings settings{};
  mlcp_solver* solver = nullptr;
  EXPECT_EQ(mlcp_solver_create(&settings, nullptr, &solver), MLCP_ERROR_ARGUMENT);
  EXPECT_EQ(solver, nullptr);
}

TEST_F(StructSize, OlderViewIsFilledAsFarAsItGoes) {
  add_body(p, 2);
  mlcp_matrix_view view;
  std::memset(&view, 0x5a, sizeof view);
  mlcp_matrix_view_init(&view, offsetof(mlcp_matrix_view, values));
  const void* untouched = view.values;
  ASSERT_EQ(mlcp_problem_mass(p, &view), MLCP_OK);
  EXPECT_EQ(view.struct_size, offsetof(mlcp_matrix_view, values));
  EXPECT_EQ(view.rows, 2);
  EXPECT_EQ(view.entries, 4);
  EXPECT_EQ(view.values, untouched);
}
