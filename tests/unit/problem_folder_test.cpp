#include "cli/problem_folder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "cli/matrix_view.h"
#include "cli/rank.h"
#include "cli/survey.h"
#include "cli/text_file.h"
#include "scenes/scenes.h"
#include "support/scratch_folder.h"

namespace cli {
namespace {

namespace fs = std::filesystem;

/// A folder of the test's own, gone at its end.
class ProblemFolder : public testing::Test {
 protected:
  void SetUp() override {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = support::scratch_folder() / (std::string("mlcp_problem_folder_") + test->name());
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  void write(const std::string& name, const std::string& text) const { write_text(folder_ / name, text); }
  void write_vector(const std::string& name, const std::string& numbers) const {
    const auto count = std::count(numbers.begin(), numbers.end(), '\n');
    write(name, "%%MatrixMarket matrix array real general\n" + std::to_string(count) + " 1\n" + numbers);
  }
  void write_coordinates(const std::string& name, const std::string& kind, const std::string& lines) const {
    write(name, "%%MatrixMarket matrix coordinate real " + kind + "\n" + lines);
  }
  std::string error() const {
    try {
      read_folder(folder_);
    } catch (const std::exception& error) {
      return error.what();
    }
    return "";
  }

  fs::path folder_;
};

struct RowData {
  std::vector<double> r, lo, hi, compliance;
  std::vector<std::uint64_t> key;
  explicit RowData(const handles::Problem& problem) {
    const std::int32_t count = mlcp_problem_row_count(problem.get());
    for (auto* values : {&r, &lo, &hi, &compliance}) values->resize(static_cast<std::size_t>(count));
    key.resize(static_cast<std::size_t>(count));
    handles::check(
        mlcp_problem_get_rows(problem.get(), count, r.data(), lo.data(), hi.data(), compliance.data(), key.data()));
  }
};

constexpr double infinity = std::numeric_limits<double>::infinity();

TEST_F(ProblemFolder, global_signs_and_rows_left_out) {
  write("meta.json", R"({"form": "global", "contacts": 1, "dim": 3, "friction": true})");
  write_coordinates("M.mtx", "symmetric", "2 2 2\n1 1 2\n2 2 3\n");
  write_vector("k.mtx", "5\n6\n");
  write_coordinates("C.mtx", "general", "1 2 1\n1 1 1\n");
  write_vector("c.mtx", "0.5\n");
  write_coordinates("D.mtx", "general", "4 2 4\n1 2 1\n2 1 1\n3 1 2\n4 2 -1\n");
  write_vector("d.mtx", "1\n2\n3\n4\n");
  write_vector("mu.mtx", "0.5\n");
  write_vector("key.mtx", "0\n1\n2\n3\n-1\n");
  const ProblemFile file = read_folder(folder_);
  EXPECT_EQ(file.file_rows, 5);
  EXPECT_EQ(file.file_row, (std::vector<std::int32_t>{0, 1, 4}));
  const RowData rows(file.problem);
  EXPECT_EQ(rows.r, (std::vector<double>{-0.5, -1, -4}));
  EXPECT_EQ(rows.lo, (std::vector<double>{-infinity, 0, 0}));
  EXPECT_EQ(rows.hi, (std::vector<double>(3, infinity)));
  EXPECT_EQ(rows.key, (std::vector<std::uint64_t>{1, 2, 0}));
}

TEST_F(ProblemFolder, reduced_problem_is_compliance) {
  write("meta.json", R"({"form": "reduced", "nC": 1, "contacts": null, "dim": 1})");
  write_coordinates("A.mtx", "symmetric", "2 2 3\n1 1 2\n2 1 1\n2 2 4\n");
  write_vector("b.mtx", "-1\n7\n");
  const ProblemFile file = read_folder(folder_);
  EXPECT_EQ(mlcp_problem_velocity_count(file.problem.get()), 0);
  const RowData rows(file.problem);
  EXPECT_EQ(rows.r, (std::vector<double>{1, -7}));
  EXPECT_EQ(rows.lo, (std::vector<double>{-infinity, 0}));
  EXPECT_EQ(rows.compliance, (std::vector<double>{2, 4}));
}

TEST_F(ProblemFolder, empty_problems_are_legal) {
  write("meta.json", R"({"form": "global"})");
  write_coordinates("M.mtx", "general", "0 0 0\n");
  const ProblemFile file = read_folder(folder_);
  EXPECT_EQ(mlcp_problem_velocity_count(file.problem.get()), 0);
  EXPECT_EQ(mlcp_problem_row_count(file.problem.get()), 0);
}

TEST_F(ProblemFolder, a_jacobian_stored_as_symmetric_is_read_whole) {
  write("meta.json", R"({"form": "global"})");
  write_coordinates("M.mtx", "symmetric", "2 2 2\n1 1 2\n2 2 3\n");
  write_coordinates("D.mtx", "symmetric", "2 2 2\n1 1 1\n2 1 5\n");
  EXPECT_EQ(mlcp_problem_entry_count(read_folder(folder_).problem.get()), 3);
}

TEST_F(ProblemFolder, errors_name_the_file) {
  EXPECT_NE(error().find("meta.json: no such file"), std::string::npos);
  write("meta.json", "{");
  EXPECT_NE(error().find("meta.json: "), std::string::npos);
  write("meta.json", R"({"form": "other"})");
  EXPECT_NE(error().find("neither global nor reduced"), std::string::npos);
  write("meta.json", R"({"form": "global", "dim": 3, "contacts": 1, "friction": true})");
  EXPECT_NE(error().find("M.mtx: no such file"), std::string::npos);
  write_coordinates("M.mtx", "symmetric", "2 2 2\n1 1 2\n2 2 3\n");
  write_coordinates("D.mtx", "general", "3 1 1\n1 1 1\n");
  EXPECT_NE(error().find("D.mtx: is 3 x 1, not 3 x 2"), std::string::npos);
  write_coordinates("D.mtx", "general", "3 2 2\n1 1 1\n1 1 1\n");
  EXPECT_NE(error().find("D.mtx: entry 1 1 comes twice"), std::string::npos);
  write_coordinates("D.mtx", "general", "3 2 1\n1 1 1\n");
  EXPECT_NE(error().find("mu.mtx: no such file"), std::string::npos);
  write_vector("mu.mtx", "0.1\n0.2\n");
  EXPECT_NE(error().find("mu.mtx: is 2 x 1, not 1 x 1"), std::string::npos);
  write_vector("mu.mtx", "0.1\n");
  write_vector("d.mtx", "1\n");
  EXPECT_NE(error().find("d.mtx: is"), std::string::npos);
  write_vector("d.mtx", "1\n1\n1\n");
  write_coordinates("M.mtx", "general", "2 2 3\n1 1 2\n1 2 1\n2 2 3\n");
  EXPECT_NE(error().find("M.mtx: "), std::string::npos);
  EXPECT_NE(error().find("symmetric: entry (0, 1)"), std::string::npos) << error();
  EXPECT_TRUE(error().ends_with("(counted from 0)")) << error();
}

TEST_F(ProblemFolder, a_written_problem_reads_back_the_same) {
  const handles::Problem before = scenes::rope(12);
  fs::remove(folder_);
  write_folder(folder_, before);
  const ProblemFile file = read_folder(folder_);
  const RowData after(file.problem), all(before);
  // bilateral rows went to the front
  std::vector<std::size_t> order;
  for (const bool bilateral : {true, false}) {
    for (std::size_t i = 0; i < all.lo.size(); ++i) {
      if ((all.lo[i] == -infinity) == bilateral) order.push_back(i);
    }
  }
  ASSERT_EQ(after.r.size(), all.r.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    EXPECT_EQ(after.r[i], all.r[order[i]]);
    EXPECT_EQ(after.key[i], all.key[order[i]]);
  }
  EXPECT_EQ(mlcp_problem_entry_count(file.problem.get()), mlcp_problem_entry_count(before.get()));
  EXPECT_THROW(write_folder(folder_, before), std::runtime_error);
}

TEST_F(ProblemFolder, errors_in_a_part_of_the_matrix_say_so) {
  write("meta.json", R"({"form": "reduced", "contacts": 1, "dim": 2, "friction": true})");
  write_vector("mu.mtx", "0.5\n");
  write_coordinates("A.mtx", "general", "3 3 4\n1 1 1\n2 2 1\n3 3 1\n3 1 0.5\n");
  EXPECT_TRUE(error().ends_with("(counted from 0, without the rows of friction)")) << error();
}

/// A given velocity, 2, between two that are to be found.
handles::Problem half_prescribed() {
  handles::Problem problem = handles::make_problem();
  const double masses[] = {3, 4, 5}, given = 2, k[] = {7, 8, 9};
  handles::check(mlcp_problem_bodies_add(problem.get(), 3, 1, masses, 0, nullptr), problem);
  handles::check(mlcp_problem_body_set_prescribed(problem.get(), 1, &given, 1), problem);
  handles::check(mlcp_problem_set_momentum(problem.get(), 0, 3, k), problem);
  const std::int32_t columns[] = {2, 1, 0};
  const double first[] = {1, 5, 0.5}, second[] = {-1, -1};
  handles::check(mlcp_problem_row_add(problem.get(), 3, columns, first, 1, 0, infinity, 0, 0, nullptr), problem);
  handles::check(mlcp_problem_row_add(problem.get(), 2, columns, second, 0.5, -infinity, infinity, 0, 0, nullptr), problem);
  return problem;
}

TEST_F(ProblemFolder, prescribed_bodies_go_into_the_right_hand_side) {
  fs::remove(folder_);
  write_folder(folder_, half_prescribed());
  const ProblemFile file = read_folder(folder_);
  ASSERT_EQ(mlcp_problem_velocity_count(file.problem.get()), 2);
  double k[2];
  handles::check(mlcp_problem_get_momentum(file.problem.get(), 2, k));
  EXPECT_EQ(k[0], 7);
  EXPECT_EQ(k[1], 9);
  const RowData rows(file.problem);  // the bilateral one first
  EXPECT_EQ(rows.r, (std::vector<double>{0.5 + 2, 1 - 5 * 2}));
  EXPECT_EQ(rows.lo, (std::vector<double>{-infinity, 0}));
  const mlcp_matrix_view mass = view_of(file.problem.get(), mlcp_problem_mass);
  const mlcp_matrix_view jacobian = view_of(file.problem.get(), mlcp_problem_jacobian);
  EXPECT_EQ(std::vector<double>(mass.values, mass.values + mass.entries), (std::vector<double>{3, 5}));
  EXPECT_EQ(std::vector<double>(jacobian.values, jacobian.values + jacobian.entries), (std::vector<double>{-1, 1, 0.5}));
  EXPECT_EQ(std::vector<std::int32_t>(jacobian.indices, jacobian.indices + 3), (std::vector<std::int32_t>{1, 1, 0}));
}

TEST_F(ProblemFolder, nothing_but_prescribed_bodies) {
  handles::Problem problem = half_prescribed();
  const double still = 0;
  for (const std::int32_t body : {0, 2}) {
    handles::check(mlcp_problem_body_set_prescribed(problem.get(), body, &still, 1), problem);
  }
  fs::remove(folder_);
  write_folder(folder_, problem);
  const ProblemFile file = read_folder(folder_);
  EXPECT_EQ(mlcp_problem_velocity_count(file.problem.get()), 0);
  EXPECT_EQ(RowData(file.problem).r, (std::vector<double>{2.5, -9}));
}

TEST_F(ProblemFolder, survey_leaves_given_velocities_out) {
  handles::Problem problem = half_prescribed();
  const std::int32_t column = 1;
  const double value = 1e9;
  handles::check(mlcp_problem_row_add(problem.get(), 1, &column, &value, 0, 0, infinity, 0, 0, nullptr), problem);
  const Survey found = survey(problem.get());
  EXPECT_EQ(found.prescribed_bodies, 1);
  EXPECT_EQ(found.bodies, 3);
  EXPECT_EQ(found.velocities_alone, 0);
  EXPECT_EQ(found.zero_rows, (std::vector<std::int32_t>{2}));
  EXPECT_EQ(found.row.largest, std::sqrt(1.25));
  EXPECT_EQ(found.mass.largest, 5);
  const std::vector<std::int32_t> island(3, 0);
  EXPECT_EQ(independent_rows(problem.get(), island, 1), 2);
}

TEST_F(ProblemFolder, what_the_form_cannot_hold_is_refused) {
  handles::Problem problem = scenes::tower(1);
  const double compliance = 1e-3, hi = 5;
  handles::check(mlcp_problem_rows_set_compliance(problem.get(), 0, 1, &compliance));
  EXPECT_THROW(write_folder(folder_ / "soft", problem), std::runtime_error);
  problem = scenes::tower(1);
  const double lo = 0;
  handles::check(mlcp_problem_rows_set_bounds(problem.get(), 0, 1, &lo, &hi));
  EXPECT_THROW(write_folder(folder_ / "boxed", problem), std::runtime_error);
}

}  // namespace
}  // namespace cli
