#include "cli/info_command.h"

#include <gtest/gtest.h>

// nlohmann/json: reads what the command prints
#include <nlohmann/json.hpp>

#include <filesystem>

#include "cli/problem_folder.h"
#include "scenes/scenes.h"
#include "support/scratch_folder.h"

namespace cli {
namespace {

namespace fs = std::filesystem;

/// The table of the scenes as a snapshot, its legs with Coulomb's law, the load without friction; and as a folder, which names no model.
class InfoCommand : public testing::Test {
 protected:
  void SetUp() override {
    const handles::Problem problem = scenes::Scene::problem_of_step(scenes::Table());
    const std::int32_t load = scenes::Table::legs;
    const std::vector<mlcp_friction> coulomb(static_cast<std::size_t>(load), MLCP_FRICTION_COULOMB);
    const double mu = 0;
    handles::check(mlcp_problem_contacts_set_friction(problem.get(), 0, load, coulomb.data(), nullptr, nullptr, nullptr), problem);
    handles::check(mlcp_problem_contacts_set_friction(problem.get(), load, 1, nullptr, &mu, nullptr, nullptr), problem);
    fs::remove_all(folder_);
    write_folder(folder_, problem);
    char message[512];
    handles::check(mlcp_snapshot_save(snapshot_.c_str(), problem.get(), nullptr, nullptr, nullptr, message, sizeof message), message);
  }
  void TearDown() override {
    fs::remove_all(folder_);
    fs::remove(snapshot_);
  }

  static std::string output(const fs::path& problem, const char* form) {
    testing::internal::CaptureStdout();
    run_info(problem.string(), form);
    return testing::internal::GetCapturedStdout();
  }

  const std::string name_ = std::string("mlcp_info_") + testing::UnitTest::GetInstance()->current_test_info()->name();
  const fs::path folder_ = support::scratch_folder() / name_, snapshot_ = support::scratch_folder() / (name_ + ".mlcp");
};

TEST_F(InfoCommand, names_contacts_coefficients_and_models_of_a_snapshot) {
  const auto contacts = nlohmann::json::parse(output(snapshot_, "json"))["contacts"];
  EXPECT_EQ(contacts, nlohmann::json::parse(
                          R"({"count": 5, "rows_of_each": [3, 3], "mu": [0, 0.4], "mu_is_0": 1, "models": {"coulomb": 4, "convex": 1}})"));
  EXPECT_NE(output(snapshot_, "text").find("contacts          count 5, rows of each 3, mu 0 to 0.4, mu is 0 1, models coulomb 4, convex 1\n"),
            std::string::npos);
}

TEST_F(InfoCommand, names_contacts_of_a_folder_that_is_read_without_friction) {
  const auto found = nlohmann::json::parse(output(folder_, "json"));
  EXPECT_EQ(found["contacts"], nlohmann::json::parse(R"({"count": 5, "rows_of_each": [3, 3], "mu": [0, 0.4], "mu_is_0": 1, "models": null})"));
  EXPECT_EQ(found["rows"]["left_out"], 10);
}

TEST_F(InfoCommand, says_that_there_are_no_contacts) {
  handles::Problem rope = scenes::rope(3);
  char message[512];
  handles::check(mlcp_snapshot_save(snapshot_.c_str(), rope.get(), nullptr, nullptr, nullptr, message, sizeof message), message);
  EXPECT_EQ(nlohmann::json::parse(output(snapshot_, "json"))["contacts"], nlohmann::json::parse(R"({"count": 0})"));
}

}  // namespace
}  // namespace cli
