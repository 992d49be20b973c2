#include "cli/bench_command.h"

#include <gtest/gtest.h>

// nlohmann/json: reads what the command prints
#include <nlohmann/json.hpp>

#include <filesystem>
#include <set>

#include "scenes/scenes.h"
#include "support/scratch_folder.h"

namespace cli {
namespace {

/// A snapshot of a small rope, gone at the end of the test.
class BenchCommand : public testing::Test {
 protected:
  void SetUp() override {
    path_ = support::scratch_folder() /
            (std::string("mlcp_bench_") + testing::UnitTest::GetInstance()->current_test_info()->name() + ".mlcp");
    char message[512];
    scenes::check(mlcp_snapshot_save(path_.c_str(), scenes::rope(10).get(), nullptr, nullptr, nullptr, message, sizeof message), message);
  }
  void TearDown() override { std::filesystem::remove(path_); }

  std::string output(BenchOptions options) const {
    options.problems = {path_.string()};
    options.seconds = 0;
    testing::internal::CaptureStdout();
    run_bench(options);
    return testing::internal::GetCapturedStdout();
  }

  std::filesystem::path path_;
};

TEST_F(BenchCommand, json_has_every_method_at_every_tolerance_within_that_tolerance) {
  BenchOptions options;
  options.output = "json";
  options.tolerances = {1e-6, 1e-9};
  const auto problems = nlohmann::json::parse(output(options))["problems"];
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_EQ(problems[0]["rows"], 21);
  std::set<std::string> methods;
  for (const auto& result : problems[0]["results"]) {
    methods.insert(result["method"]);
    SCOPED_TRACE(result.dump());
    EXPECT_GE(result["turns"], 3);
    EXPECT_GT(result["cold_seconds"], 0);
    EXPECT_GT(result["known_seconds"], 0);
    if (result["status"] == "solved") {
      EXPECT_LE(result["error"].get<double>(), result["tolerance"].get<double>());
    }
  }
  EXPECT_TRUE(methods.contains("auto"));
  EXPECT_TRUE(methods.contains("simplex"));
  EXPECT_EQ(problems[0]["results"].size(), 2 * methods.size());
}

TEST_F(BenchCommand, text_has_a_line_a_method_and_tolerance) {
  BenchOptions options;
  options.tolerances = {1e-9};
  const std::string text = output(options);
  EXPECT_NE(text.find("21 rows"), std::string::npos) << text;
  EXPECT_NE(text.find("simplex"), std::string::npos) << text;
  EXPECT_NE(text.find("solved"), std::string::npos) << text;
}

TEST(BenchCommandInput, a_problem_that_is_not_there_is_an_error_that_names_it) {
  BenchOptions options;
  options.problems = {"/nowhere/at/all"};
  try {
    run_bench(options);
    FAIL() << "no error";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("/nowhere/at/all"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace cli
