#include "cli/problem_form.h"

#include <gtest/gtest.h>

#include "cli/fclib_file.h"
#include "cli/problem_folder.h"
#include "support/scratch_folder.h"

namespace cli {
namespace {

namespace fs = std::filesystem;

/// Two contacts in space and a joint: on a body of 4 velocities, or as a reduced problem.
ProblemForm example(bool reduced) {
  ProblemForm form;
  form.reduced = reduced;
  form.bilateral = 1;
  form.contacts = 2;
  form.dimension = 3;
  form.mu = {0.5, 0.25};
  form.shift = {0.125, -1, 0.5, 0.25, -2, 0.75, -0.5};
  Matrix& square = reduced ? form.a : form.mass;
  square.rows = square.columns = reduced ? 7 : 4;
  for (std::int32_t i = 0; i < square.rows; ++i) {
    square.add(i, i, 3 + i);
    if (i > 0) {
      square.add(i, i - 1, 0.5);
      square.add(i - 1, i, 0.5);
    }
  }
  form.k = {1, 2, -3, -4};
  form.jacobian.rows = 7;
  form.jacobian.columns = 4;
  for (std::int32_t i = 0; i < 7; ++i)
    for (std::int32_t j = 0; j < 4; ++j)
      if ((i + j) % 3 != 0) form.jacobian.add(i, j, 1.0 + i - 0.5 * j);
  return form;
}

std::vector<double> impulses(const ProblemFile& file) {
  const double* gamma = nullptr;
  std::int32_t count = 0;
  handles::check(mlcp_solve(file.solver.get(), file.problem.get(), nullptr, nullptr, nullptr));
  handles::check(mlcp_solver_impulses(file.solver.get(), &gamma, &count));
  return {gamma, gamma + count};
}

struct ProblemForms : testing::TestWithParam<bool> {
  Friction coulomb{MLCP_FRICTION_COULOMB, 0};
  ProblemFile file = make_problem(example(GetParam()), coulomb);
  fs::path path = support::scratch_folder() / ("mlcp_problem_form_" + std::string(GetParam() ? "reduced" : "global"));

  ProblemForms() { fs::remove_all(path); }
  ~ProblemForms() override { fs::remove_all(path); }
};

TEST_P(ProblemForms, a_folder_brings_contacts_back) {
  write_folder(path, file.problem);
  const ProblemFile again = read_folder(path, coulomb);
  EXPECT_EQ(mlcp_problem_contact_count(again.problem.get()), 2);
  EXPECT_EQ(impulses(again), impulses(file));
  EXPECT_EQ(mlcp_problem_row_count(read_folder(path).problem.get()), 3) << "without friction the tangent rows are left out";
}

TEST_P(ProblemForms, fixed_bounds_of_friction_are_refused) {
  const mlcp_friction box = MLCP_FRICTION_BOX;
  handles::check(mlcp_problem_contacts_set_friction(file.problem.get(), 1, 1, &box, nullptr, nullptr, nullptr));
  EXPECT_THROW(form_of(file.problem), std::runtime_error);
}

TEST_P(ProblemForms, an_fclib_file_brings_contacts_back) {
#ifdef MLCP_WITH_FCLIB
  write_fclib(path, file.problem);
  EXPECT_TRUE(is_fclib(path));
  const ProblemFile again = read_fclib(path, coulomb);
  EXPECT_EQ(mlcp_problem_contact_count(again.problem.get()), 2);
  EXPECT_EQ(impulses(again), impulses(file));
  EXPECT_THROW(write_fclib(path, file.problem), std::runtime_error) << "it is there already";
#else
  EXPECT_THROW(write_fclib(path, file.problem), std::runtime_error);
#endif
}

INSTANTIATE_TEST_SUITE_P(Forms, ProblemForms, testing::Bool(), [](const auto& form) { return form.param ? "reduced" : "global"; });

}  // namespace
}  // namespace cli
