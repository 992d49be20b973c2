#pragma once
#include <string>

#include "problem_file.h"

namespace cli {

/// The answer of a solve in the order of the file's rows.
class Answer {
 public:
  /// Both must stay while the answer is in use.
  Answer(const ProblemFile& file, const mlcp_report& report) : file_(file), report_(report) {}

  /// One JSON object; numbers in the shortest form that reads back as the same double, numbers that are not finite as null.
  std::string json() const;
  /// Some lines for people, without v and γ; with `trace` a line a pivot.
  std::string text(bool trace) const;

 private:
  bool reduced() const;
  bool has_contacts() const;
  std::int32_t file_row(std::int32_t row) const;
  std::int32_t worst_body() const;

  const ProblemFile& file_;
  const mlcp_report& report_;
};

}  // namespace cli
