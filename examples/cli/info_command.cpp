#include "info_command.h"

#include <algorithm>
#include <cstdio>
#include <iostream>
#include <optional>
#include <span>

// nlohmann/json: one object for both forms of output
#include <nlohmann/json.hpp>

#include "problem_file.h"
#include "rank.h"
#include "survey.h"

namespace cli {
namespace {

using Json = nlohmann::ordered_json;
using handles::check;

mlcp_report solve(const ProblemFile& file) {
  mlcp_report report;
  mlcp_report_init(&report, sizeof report);
  check(mlcp_solve(file.solver.get(), file.problem.get(), file.enabled.get(), file.start.get(), &report), file.solver);
  return report;
}

std::span<const std::int32_t> island_of_rows(const ProblemFile& file) {
  const std::int32_t* island = nullptr;
  std::int32_t count = 0;
  check(mlcp_solver_row_islands(file.solver.get(), &island, &count));
  return {island, static_cast<std::size_t>(count)};
}

std::int32_t largest_island(std::span<const std::int32_t> island, std::int32_t islands) {
  std::vector<std::int32_t> rows(static_cast<std::size_t>(islands) + 1);
  for (const std::int32_t i : island) ++rows[static_cast<std::size_t>(i + 1)];  // the first counts rows that are disabled
  return islands == 0 ? 0 : *std::max_element(rows.begin() + 1, rows.end());
}

Json range(const Range& sizes) {
  if (sizes.largest < sizes.smallest) return nullptr;
  return {sizes.smallest, sizes.largest};
}

Json scaling(const Survey& found) {
  return {{"mass", range(found.mass)},         // Mⱼⱼ
          {"row_length", range(found.row)},  // |Jᵢ|
          {"a", range(found.scale)},
          {"k", range(found.momentum)},
          {"r", range(found.right_hand_side)}};
}

const char* name_of(mlcp_friction model) {
  switch (model) {
    case MLCP_FRICTION_CONVEX: return "convex";
    case MLCP_FRICTION_COULOMB: return "coulomb";
    case MLCP_FRICTION_BOX: return "fixed_box";
    case MLCP_FRICTION_FINDEX: return "box";  // as solve --friction names it
    default: return "none";
  }
}

/// Those that the file names; a folder is surveyed and solved without their friction.
Json contacts(const FileContacts& found) {
  Json json = {{"count", found.mu.size()}};
  if (found.mu.empty()) return json;
  const auto [fewest, most] = std::minmax_element(found.dimension.begin(), found.dimension.end());
  const auto [least, largest] = std::minmax_element(found.mu.begin(), found.mu.end());
  json["rows_of_each"] = {*fewest, *most};
  json["mu"] = {*least, *largest};
  json["mu_is_0"] = std::count(found.mu.begin(), found.mu.end(), 0.0);
  json["models"] = nullptr;
  for (const mlcp_friction model : found.model) {
    Json& count = json["models"][name_of(model)];
    count = count.is_null() ? 1 : count.get<int>() + 1;
  }
  return json;
}

/// What a reader should know before trusting or blaming a solver.
Json unusual(const ProblemFile& file, const Survey& found, const mlcp_report& report) {
  Json remarks = Json::array();
  const auto note = [&](std::int64_t count, const std::string& what) {
    if (count > 0) remarks.push_back(std::to_string(count) + " " + what);
  };
  const auto note_rows = [&](const std::vector<std::int32_t>& rows, const std::string& what) {
    constexpr std::size_t most = 8;
    std::string list;
    for (std::size_t i = 0; i < std::min(most, rows.size()); ++i) {
      list += (i == 0 ? "" : ", ") + std::to_string(file.file_row[static_cast<std::size_t>(rows[i])]);
    }
    note(static_cast<std::int64_t>(rows.size()), what + ": " + list + (rows.size() > most ? ", ..." : ""));
  };
  constexpr double wide = 1e6;
  note_rows(found.zero_rows, "rows without an entry");
  note_rows(found.parallel_rows, "rows parallel to an earlier one");
  note(found.fixed, "rows with lo = hi");
  note(found.explicit_zeros, "explicit zeros in J");
  note(found.velocities_alone, "velocities that nothing touches");
  note(found.massless, "velocities without a positive mass");
  note(report.redundant_rows, "rows redundant at the solution");
  if (found.mass.largest > wide * found.mass.smallest) remarks.push_back("masses of very different size");
  if (found.row.largest > wide * found.row.smallest) remarks.push_back("rows of very different length");
  if (found.scale.largest > wide * found.scale.smallest) remarks.push_back("rows of very different a");
  if (report.outcome != MLCP_SOLVED) remarks.push_back(std::string("not solved: ") + mlcp_outcome_text(report.outcome));
  return remarks;
}

Json describe(const std::string& path, const ProblemFile& file) {
  const Survey found = survey(file.problem.get());
  const mlcp_report report = solve(file);
  const std::span<const std::int32_t> island = island_of_rows(file);
  Json json;
  json["problem"] = path;
  json["form"] = found.velocities == 0 ? "reduced" : "global";
  json["velocities"] = found.velocities;
  json["bodies"] = found.bodies;
  json["prescribed_bodies"] = found.prescribed_bodies;
  json["rows"] = {{"in_the_file", file.file_rows}, {"left_out", file.file_rows - found.rows}, {"enabled", report.enabled_rows},
                  {"bilateral", found.bilateral},  {"unilateral", found.unilateral},          {"boxed", found.boxed},
                  {"fixed", found.fixed},          {"soft", found.soft_rows}};
  json["contacts"] = contacts(file.contacts);
  json["entries"] = {{"M", found.mass_entries}, {"J", found.jacobian_entries}, {"S", found.compliance_entries}};
  json["islands"] = {{"count", report.islands}, {"rows_of_the_largest", largest_island(island, report.islands)}};
  const std::optional<std::int32_t> rank = independent_rows(file.problem.get(), island, report.islands);
  json["independent_rows"] = rank ? Json(*rank) : Json(nullptr);
  json["scaling"] = scaling(found);
  json["solution"] = {{"status", mlcp_outcome_text(report.outcome)}, {"pivots", report.pivots},
                      {"active", report.active_rows},                {"redundant", report.redundant_rows},
                      {"largest_error", report.largest_error},       {"factor_entries", report.factor_entries}};
  json["unusual"] = unusual(file, found, report);
  return json;
}

/// "key value, key value"
std::string as_list(const Json& object);

std::string as_words(const Json& value) {
  if (value.is_null()) return "-";
  if (value.is_object()) return as_list(value);
  if (value.is_string()) return value.get<std::string>();
  if (value.is_array()) return value[0] == value[1] ? as_words(value[0]) : as_words(value[0]) + " to " + as_words(value[1]);
  if (!value.is_number_float()) return value.dump();
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value.get<double>());
  return text;
}

std::string as_list(const Json& object) {
  std::string list;
  for (const auto& [key, value] : object.items()) list += (list.empty() ? "" : ", ") + key + " " + as_words(value);
  std::replace(list.begin(), list.end(), '_', ' ');
  return list;
}

/// "name  value" a line; an object inside as "name  key value, key value".
std::string as_text(const Json& json) {
  std::string text;
  const auto add_line = [&](std::string name, const std::string& value) {
    name.resize(18, ' ');
    std::replace(name.begin(), name.end(), '_', ' ');
    text += name + value + "\n";
  };
  for (const auto& [name, value] : json.items()) {
    if (name == "unusual") {
      for (const Json& remark : value) add_line(name, as_words(remark));
    } else if (value.is_object()) {
      add_line(name, as_list(value));
    } else {
      add_line(name, name == "independent_rows" && value.is_null() ? "not counted: too large" : as_words(value));
    }
  }
  return text;
}

}  // namespace

void run_info(const std::string& path, const std::string& output) {
  const Json json = describe(path, read_problem(path));
  std::cout << (output == "json" ? json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n" : as_text(json));
}

}  // namespace cli
