#include "answer.h"

#include <cstdarg>
#include <cstdio>
#include <span>

// nlohmann/json: prints numbers so that they read back as the same bits
#include <nlohmann/json.hpp>

namespace cli {
namespace {

using Json = nlohmann::ordered_json;
using handles::check;

template <typename Value>
using Getter = mlcp_status (*)(const mlcp_solver*, const Value**, std::int32_t*);

template <typename Value>
std::span<const Value> lent(const ProblemFile& file, Getter<Value> get) {
  const Value* values = nullptr;
  std::int32_t count = 0;
  check(get(file.solver.get(), &values, &count));
  return {values, static_cast<std::size_t>(count)};
}

std::span<const mlcp_pivot> trace_of(const ProblemFile& file) {
  const mlcp_pivot* pivots = nullptr;
  std::int64_t count = 0;
  check(mlcp_solver_trace(file.solver.get(), &pivots, &count));
  return {pivots, static_cast<std::size_t>(count)};
}

const char* state_name(mlcp_row_state state) {
  constexpr const char* names[] = {"disabled", "at_lower", "active", "at_upper"};
  return state < 4 ? names[state] : "?";
}

const char* contact_state_name(mlcp_contact_state state) {
  constexpr const char* names[] = {"disabled", "open", "sticking", "sliding"};
  return state < 4 ? names[state] : "?";
}

struct Certificate {
  std::span<const std::int32_t> rows;
  std::span<const double> y;
};

Certificate certificate_of(const ProblemFile& file) {
  const std::int32_t* rows = nullptr;
  const double* y = nullptr;
  std::int32_t count = 0;
  if (mlcp_solver_certificate(file.solver.get(), -1, &rows, &y, &count) != MLCP_OK) return {};
  const auto size = static_cast<std::size_t>(count);
  return {{rows, size}, {y, size}};
}

Json counts(const ProblemFile& file, const mlcp_report& report) {
  return {{"rows", file.file_rows},
          {"rows_left_out", file.file_rows - static_cast<std::int32_t>(file.file_row.size())},
          {"enabled_rows", report.enabled_rows},
          {"active_rows", report.active_rows},
          {"redundant_rows", report.redundant_rows},
          {"islands", report.islands},
          {"islands_failed", report.islands_failed},
          {"pivots", report.pivots},
          {"toggles", report.toggles},
          {"factorizations", report.factorizations},
          {"refinements", report.refinements},
          {"work", report.work},
          {"factor_entries", report.factor_entries}};
}

Json contact_numbers(const ProblemFile& file, const mlcp_report& report) {
  const auto state = lent(file, mlcp_solver_contact_states);
  Json names = Json::array();
  for (const mlcp_contact_state s : state) names.push_back(contact_state_name(s));
  return {{"open", report.contacts_open},
          {"sticking", report.contacts_sticking},
          {"sliding", report.contacts_sliding},
          {"generators", report.generators},
          {"facets", report.facets},
          {"shift_iterations", report.shift_iterations},
          {"islands_by_lemke", report.islands_by_lemke},
          {"states", names}};
}

void print(std::string& text, const char* format, ...) __attribute__((format(printf, 2, 3)));
void print(std::string& text, const char* format, ...) {
  char line[256];
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(line, sizeof line, format, arguments);
  va_end(arguments);
  text += line;
}

}  // namespace

std::int32_t Answer::file_row(std::int32_t row) const {
  return row < 0 ? -1 : file_.file_row[static_cast<std::size_t>(row)];
}

bool Answer::reduced() const { return mlcp_problem_velocity_count(file_.problem.get()) == 0; }

std::int32_t Answer::worst_body() const { return reduced() ? file_row(report_.worst_body) : report_.worst_body; }

bool Answer::has_contacts() const { return mlcp_problem_contact_count(file_.problem.get()) > 0; }

std::string Answer::json() const {
  const auto v = lent(file_, mlcp_solver_velocities);
  const auto impulses = lent(file_, mlcp_solver_impulses);
  std::vector<double> gamma(static_cast<std::size_t>(file_.file_rows));
  for (std::size_t i = 0; i < impulses.size(); ++i) gamma[static_cast<std::size_t>(file_.file_row[i])] = impulses[i];
  Json json;
  json["status"] = mlcp_outcome_text(report_.outcome);
  json["method"] = mlcp_method_text(report_.method);
  json["iterations"] = report_.pivots;
  json["seconds"] = report_.seconds;
  json["v"] = std::vector<double>(v.begin(), v.end());
  json["gamma"] = gamma;
  json["errors"] = {{"momentum", report_.momentum_error},
                    {"constraints", report_.constraint_error},
                    {"largest", report_.largest_error},
                    {"worst_row", file_row(report_.worst_row)},
                    {"worst_velocity", report_.worst_velocity},
                    {"momentum_residual", report_.momentum_residual},
                    {"constraint_residual", report_.constraint_residual},
                    {"cones", report_.cone_error},
                    {"worst_contact", report_.worst_contact},
                    {"cone_residual", report_.cone_residual}};
  json["counts"] = counts(file_, report_);
  if (has_contacts()) json["friction"] = contact_numbers(file_, report_);
  json["times"] = {{"analyze", report_.seconds_analyze},
                   {"factorize", report_.seconds_factorize},
                   {"solve", report_.seconds_solve},
                   {"report", report_.seconds_report}};
  if (report_.outcome == MLCP_NOT_POSITIVE_DEFINITE) json[reduced() ? "not_definite_at_row" : "not_definite_body"] = worst_body();
  if (const Certificate certificate = certificate_of(file_); !certificate.rows.empty()) {
    Json& out = json["certificate"] = {{"rows", Json::array()}, {"y", certificate.y}};
    for (const std::int32_t row : certificate.rows) out["rows"].push_back(file_row(row));
  }
  for (const mlcp_pivot& pivot : trace_of(file_)) {
    json["trace"].push_back({{"island", pivot.island},
                             {"entering", file_row(pivot.entering)},
                             {"blocking", file_row(pivot.blocking)},
                             {"to", state_name(pivot.to)},
                             {"dependent", pivot.dependent != 0},
                             {"step", pivot.step},
                             {"violation", pivot.violation},
                             {"schur", pivot.schur}});
  }
  return json.dump() + "\n";
}

std::string Answer::text(bool trace) const {
  std::string text;
  const mlcp_report& r = report_;
  if (trace) text += "  island  entering  blocking        to        step   violation      schur\n";
  for (const mlcp_pivot& pivot : trace ? trace_of(file_) : std::span<const mlcp_pivot>()) {
    print(text, "%8d %9d %9d %9s %11.3e %11.3e %10.2e%s\n", pivot.island, file_row(pivot.entering), file_row(pivot.blocking),
          state_name(pivot.to), pivot.step, pivot.violation, pivot.schur, pivot.dependent ? "  dependent" : "");
  }
  print(text, "%s by %s: %lld pivots in %.6f s\n", mlcp_outcome_text(r.outcome), mlcp_method_text(r.method),
        static_cast<long long>(r.pivots), r.seconds);
  print(text, "errors     momentum %.1e (velocity %d), constraints %.1e (row %d)\n", r.momentum_error, r.worst_velocity,
        r.constraint_error, file_row(r.worst_row));
  print(text, "residuals  momentum %.1e N s, constraints %.1e m/s\n", r.momentum_residual, r.constraint_residual);
  print(text, "rows       %d in the file, %d enabled, %d active, %d redundant; %d islands", file_.file_rows, r.enabled_rows,
        r.active_rows, r.redundant_rows, r.islands);
  if (r.islands_failed > 0) print(text, ", %d not solved", r.islands_failed);
  text += '\n';
  if (has_contacts())
    print(text, "contacts   %d open, %d sticking, %d sliding; cones %.1e (contact %d), %d solves, up to %d facets\n", r.contacts_open,
          r.contacts_sticking, r.contacts_sliding, r.cone_error, r.worst_contact, r.shift_iterations, r.facets);
  print(text, "work       %lld factorizations, %lld toggles, %lld refinements, %lld entries in the factor\n",
        static_cast<long long>(r.factorizations), static_cast<long long>(r.toggles), static_cast<long long>(r.refinements),
        static_cast<long long>(r.factor_entries));
  if (r.outcome == MLCP_NOT_POSITIVE_DEFINITE) {
    print(text, "not positive definite at %s %d\n", reduced() ? "row" : "body", worst_body());
  }
  const Certificate certificate = certificate_of(file_);
  for (std::size_t i = 0; i < certificate.rows.size(); ++i) {
    print(text, "conflict   row %d, multiplier %.6g\n", file_row(certificate.rows[i]), certificate.y[i]);
  }
  return text;
}

}  // namespace cli
