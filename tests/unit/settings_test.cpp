#include "solve/settings.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>

#include "memory/error.h"

namespace support {
namespace {

std::string refusal(const std::function<void(mlcp::Settings&)>& change) {
  mlcp::Settings s = mlcp::default_settings();
  change(s);
  try {
    mlcp::check_settings(s);
  } catch (const mlcp::Error& e) {
    EXPECT_EQ(e.status, MLCP_ERROR_ARGUMENT);
    return e.text;
  }
  return "";
}

TEST(Settings, DefaultsAreLegal) {
  EXPECT_EQ(refusal([](mlcp::Settings&) {}), "");
  EXPECT_EQ(mlcp::default_settings().struct_size, sizeof(mlcp_settings));
  EXPECT_EQ(mlcp::default_settings().tolerance, 1e-9);
}

TEST(Settings, BadOnesAreRefusedByName) {
  EXPECT_NE(refusal([](mlcp::Settings& s) { s.method = 77; }).find("method"), std::string::npos);
  EXPECT_NE(refusal([](mlcp::Settings& s) { s.pivot_rule = -1; }).find("pivot_rule"), std::string::npos);
  EXPECT_NE(refusal([](mlcp::Settings& s) { s.refactorize = 2; }).find("refactorize"), std::string::npos);
  EXPECT_NE(refusal([](mlcp::Settings& s) { s.max_iterations = -1; }).find("max_iterations"), std::string::npos);
  EXPECT_NE(refusal([](mlcp::Settings& s) { s.max_work = -1; }).find("max_work"), std::string::npos);
  EXPECT_NE(refusal([](mlcp::Settings& s) { s.max_seconds = -1; }).find("max_seconds"), std::string::npos);
  EXPECT_NE(refusal([](mlcp::Settings& s) { s.max_seconds = NAN; }).find("max_seconds"), std::string::npos);
  for (const double bad : {0.0, -1e-9, static_cast<double>(NAN), static_cast<double>(INFINITY)})
    EXPECT_NE(refusal([bad](mlcp::Settings& s) { s.tolerance = bad; }).find("tolerance"), std::string::npos) << bad;
}

}  // namespace
}  // namespace support
