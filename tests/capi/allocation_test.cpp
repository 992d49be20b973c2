#include <functional>

#include "support.h"

using namespace capi;

namespace {

using Edit = std::function<mlcp_status(mlcp_problem*)>;

/// Every call that may allocate, in an order that builds a problem.
std::vector<Edit> edits() {
  return {
      [](mlcp_problem* p) { return mlcp_problem_bodies_add(p, 1, 3, diagonal_mass(3, 2).data(), 0, nullptr); },
      [](mlcp_problem* p) {
        std::vector<double> masses = diagonal_mass(2), more = masses;
        masses.insert(masses.end(), more.begin(), more.end());
        return mlcp_problem_bodies_add(p, 2, 2, masses.data(), 0, nullptr);
      },
      [](mlcp_problem* p) {
        const int32_t pointers[] = {0, 2, 4}, rows[] = {0, 1, 0, 1};
        const double values[] = {2, 1, 1, 2};
        return mlcp_problem_body_add_sparse(p, 2, pointers, rows, values, MLCP_FULL, nullptr);
      },
      [](mlcp_problem* p) {
        const int32_t pointers[] = {0, 2, 3}, rows[] = {0, 1, 1};
        const double values[] = {2, 1, 2};
        return mlcp_problem_body_add_sparse(p, 2, pointers, rows, values, MLCP_LOWER, nullptr);
      },
      [](mlcp_problem* p) {
        const double mass[] = {3, 1, 4};
        return mlcp_problem_body_set_mass(p, 4, mass, 3);
      },
      [](mlcp_problem* p) { return mlcp_problem_body_set_mass(p, 1, diagonal_mass(2, 7).data(), 4); },
      [](mlcp_problem* p) {
        const int32_t columns[] = {1, 8};
        const double values[] = {1, 2};
        return mlcp_problem_row_add(p, 2, columns, values, 0, -1, 1, 0, 5, nullptr);
      },
      [](mlcp_problem* p) { return mlcp_problem_body_remove(p, 2); },
      [](mlcp_problem* p) { return mlcp_problem_bodies_add(p, 1, 4, diagonal_mass(4).data(), 0, nullptr); },
      [](mlcp_problem* p) {
        mlcp_rows rows;
        mlcp_rows_init(&rows, sizeof rows);
        const int32_t a[] = {0, 2, 0};
        const double j[] = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10};
        rows.count = 3;
        rows.body_a = a;
        rows.jacobian_a = j;
        return mlcp_problem_rows_add(p, &rows, nullptr);
      },
      [](mlcp_problem* p) {
        const int32_t pointers[] = {0, 2, 3}, columns[] = {0, 7, 3};
        const double values[] = {1, 2, 3};
        return mlcp_problem_rows_add_csr(p, 2, pointers, columns, values, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr);
      },
      [](mlcp_problem* p) {
        std::vector<int32_t> pointers(mlcp_problem_velocity_count(p) + 1, 2);
        pointers[0] = 0;
        const int32_t rows[] = {1, 0};
        const double values[] = {1, 2};
        const double* none = nullptr;
        return mlcp_problem_rows_add_csc(p, 2, pointers.data(), rows, values, none, none, none, none, nullptr, nullptr);
      },
      [](mlcp_problem* p) {
        const int32_t pointers[] = {0, 2, 3, 3, 3, 3, 3, 3, 3}, rows[] = {0, 1, 1};
        const double values[] = {2, 1, 2};
        return mlcp_problem_set_compliance_matrix(p, 8, pointers, rows, values, MLCP_LOWER);
      },
      [](mlcp_problem* p) {
        const int32_t rows[] = {6, 2};
        return mlcp_problem_rows_remove(p, 2, rows);
      },
      [](mlcp_problem* p) {
        const std::vector<double> v(mlcp_problem_velocity_count(p), 1.0);
        return mlcp_timestep_momentum(p, 0.5, static_cast<int32_t>(v.size()), v.data(), v.data());
      },
      [](mlcp_problem* p) { return mlcp_problem_reserve(p, 20, 100, 200, 1000); },
      [](mlcp_problem* p) { return mlcp_problem_trim(p); },
  };
}

}  // namespace

TEST(Allocation, CreateFailsCleanlyAtEveryCall) {
  Allocator allocator;
  mlcp_status status = MLCP_ERROR_OUT_OF_MEMORY;
  for (int64_t n = 0; status == MLCP_ERROR_OUT_OF_MEMORY; ++n) {
    allocator.fail_at(n);
    mlcp_problem* problem = nullptr;
    status = mlcp_problem_create(allocator.hooks(), &problem);
    EXPECT_EQ(status == MLCP_OK, problem != nullptr);
    mlcp_problem_destroy(problem);
    EXPECT_EQ(allocator.blocks(), 0);
  }
  EXPECT_EQ(status, MLCP_OK);
}

TEST(Allocation, EveryEditFailsCleanlyAtEveryCall) {
  Allocator allocator;
  ProblemHandle failing = make_problem(allocator.hooks()), plain = make_problem();
  int edit_number = 0;
  for (const Edit& edit : edits()) {
    SCOPED_TRACE(edit_number++);
    ASSERT_EQ(edit(plain.get()), MLCP_OK) << mlcp_problem_error(plain.get());
    mlcp_status status = MLCP_ERROR_OUT_OF_MEMORY;
    for (int64_t n = 0; status == MLCP_ERROR_OUT_OF_MEMORY && n < 100; ++n) {
      const Bytes before = snapshot(failing.get());
      allocator.fail_at(n);
      status = edit(failing.get());
      allocator.fail_at(-1);
      if (status != MLCP_OK) {
        EXPECT_EQ(snapshot(failing.get()), before);
        EXPECT_STRNE(mlcp_problem_error(failing.get()), "");
      }
    }
    ASSERT_EQ(status, MLCP_OK);
    EXPECT_EQ(snapshot(failing.get()), snapshot(plain.get()));
  }
}

TEST(Allocation, CloneFailsCleanlyAtEveryCall) {
  Allocator allocator;
  ProblemHandle problem = make_rich_problem(allocator.hooks());
  const int64_t blocks = allocator.blocks();
  mlcp_status status = MLCP_ERROR_OUT_OF_MEMORY;
  for (int64_t n = 0; status == MLCP_ERROR_OUT_OF_MEMORY && n < 100; ++n) {
    allocator.fail_at(n);
    mlcp_problem* copy = nullptr;
    status = mlcp_problem_clone(problem.get(), &copy);
    allocator.fail_at(-1);
    if (copy) {
      EXPECT_EQ(snapshot(copy), snapshot(problem.get()));
    }
    mlcp_problem_destroy(copy);
    EXPECT_EQ(allocator.blocks(), blocks);
  }
  EXPECT_EQ(status, MLCP_OK);
}

TEST(Allocation, SnapshotFailsCleanlyAtEveryCall) {
  Allocator allocator;
  ProblemHandle problem = make_rich_problem(allocator.hooks());
  const Bytes bytes = snapshot(problem.get());
  const int64_t blocks = allocator.blocks();
  mlcp_status status = MLCP_ERROR_OUT_OF_MEMORY;
  for (int64_t n = 0; status == MLCP_ERROR_OUT_OF_MEMORY && n < 200; ++n) {
    allocator.fail_at(n);
    size_t size = 0;
    status = mlcp_snapshot_write(problem.get(), nullptr, nullptr, nullptr, 0, nullptr, &size, nullptr, 0);
    EXPECT_EQ(allocator.blocks(), blocks);
  }
  EXPECT_EQ(status, MLCP_OK);
  status = MLCP_ERROR_OUT_OF_MEMORY;
  for (int64_t n = 0; status == MLCP_ERROR_OUT_OF_MEMORY && n < 1000; ++n) {
    allocator.fail_at(n);
    mlcp_problem* copy = nullptr;
    mlcp_solver* solver = nullptr;
    status = mlcp_snapshot_read(bytes.data(), bytes.size(), allocator.hooks(), &copy, &solver, nullptr, nullptr, nullptr, 0);
    if (status != MLCP_OK) {
      EXPECT_TRUE(!copy && !solver);
    }
    mlcp_problem_destroy(copy);
    mlcp_solver_destroy(solver);
    EXPECT_EQ(allocator.blocks(), blocks);
  }
  EXPECT_EQ(status, MLCP_OK);
}

TEST(Allocation, MaskFailsCleanlyAtEveryCall) {
  ProblemHandle problem = make_rich_problem();
  Allocator allocator;
  mlcp_status status = MLCP_ERROR_OUT_OF_MEMORY;
  mlcp_mask* mask = nullptr;
  for (int64_t n = 0; !mask && n < 20; ++n) {
    allocator.fail_at(n);
    status = mlcp_mask_create(allocator.hooks(), 2, MLCP_ROW_AT_UPPER, &mask);
    if (!mask) {
      EXPECT_EQ(allocator.blocks(), 0);
    }
  }
  ASSERT_EQ(status, MLCP_OK);
  MaskHandle owner(mask);
  status = MLCP_ERROR_OUT_OF_MEMORY;
  for (int64_t n = 0; status != MLCP_OK && n < 20; ++n) {
    allocator.fail_at(n);
    status = mlcp_mask_carry(mask, problem.get(), mask, MLCP_ROW_ACTIVE);
    if (status != MLCP_OK) {
      EXPECT_EQ(mlcp_mask_size(mask), 2);
    }
  }
  EXPECT_EQ(status, MLCP_OK);
  status = MLCP_ERROR_OUT_OF_MEMORY;
  for (int64_t n = 0; status != MLCP_OK && n < 20; ++n) {
    allocator.fail_at(n);
    status = mlcp_mask_resize(mask, 100, MLCP_ROW_ACTIVE);
    if (status != MLCP_OK) {
      EXPECT_EQ(mlcp_mask_size(mask), 4);
    }
  }
  EXPECT_EQ(status, MLCP_OK);
}

TEST(Allocation, ReserveMakesAddingFree) {
  Allocator allocator;
  ProblemHandle problem = make_problem(allocator.hooks());
  mlcp_problem* p = problem.get();
  ASSERT_EQ(mlcp_problem_reserve(p, 10, 60, 30, 360), MLCP_OK);
  allocator.fail_at(0);
  for (int i = 0; i < 10; ++i) add_body(p, 6);
  for (int i = 0; i < 30; ++i) add_row(p, {0, 1, 2, 3, 4, 5, 12, 13, 14, 15, 16, 17}, std::vector<double>(12, 1.0));
  EXPECT_EQ(mlcp_problem_entry_count(p), 360);
  EXPECT_EQ(allocator.calls(), 0);
}

TEST(Allocation, SecondFrameIsFree) {
  Allocator allocator;
  ProblemHandle problem = make_problem(allocator.hooks());
  mlcp_problem* p = problem.get();
  for (int frame = 0; frame < 3; ++frame) {
    if (frame > 0) allocator.fail_at(0);
    ASSERT_EQ(mlcp_problem_clear(p), MLCP_OK);
    for (int i = 0; i < 20; ++i) add_body(p, 3);
    for (int i = 0; i < 19; ++i) add_row(p, {3 * i, 3 * i + 3}, {1, -1});
    ASSERT_EQ(mlcp_problem_rows_clear(p), MLCP_OK);
    for (int i = 0; i < 19; ++i) add_row(p, {3 * i, 3 * i + 3}, {1, -1});
  }
  EXPECT_EQ(allocator.calls(), 0);
}

TEST(Allocation, TrimGivesBack) {
  Allocator allocator;
  ProblemHandle problem = make_problem(allocator.hooks());
  const size_t empty = allocator.bytes();
  ASSERT_EQ(mlcp_problem_reserve(problem.get(), 100, 600, 1000, 10000), MLCP_OK);
  EXPECT_GT(allocator.bytes(), empty + 100000);
  ASSERT_EQ(mlcp_problem_trim(problem.get()), MLCP_OK);
  EXPECT_LE(allocator.bytes(), empty);
}

TEST(Allocation, HalfAnAllocator) {
  Allocator allocator;
  mlcp_allocator half = *allocator.hooks();
  half.release = nullptr;
  mlcp_problem* problem = nullptr;
  EXPECT_EQ(mlcp_problem_create(&half, &problem), MLCP_ERROR_NULL);
  mlcp_allocator none{};
  EXPECT_EQ(mlcp_problem_create(&none, &problem), MLCP_OK);
  mlcp_problem_destroy(problem);
}
