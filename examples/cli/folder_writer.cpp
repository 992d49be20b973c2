#include <string>

// nlohmann/json: meta.json
#include <nlohmann/json.hpp>

#include "matrix_market.h"
#include "problem_folder.h"
#include "problem_form.h"
#include "text_file.h"

namespace cli {
namespace {

namespace fs = std::filesystem;

Matrix lower_triangle(const Matrix& full) {
  Matrix lower;
  lower.rows = full.rows;
  lower.columns = full.columns;
  lower.symmetric = true;
  for (std::size_t e = 0; e < full.value.size(); ++e) {
    if (full.row[e] >= full.column[e]) lower.add(full.row[e], full.column[e], full.value[e]);
  }
  return lower;
}

void write_global(const fs::path& folder, const ProblemForm& form) {
  write_text(folder / "M.mtx", format_matrix(lower_triangle(form.mass)));
  write_text(folder / "k.mtx", format_vector(form.k));
  std::vector<std::int32_t> c_index(form.shift.size()), d_index(form.shift.size());
  for (std::int32_t i = 0; i < form.rows(); ++i) {
    c_index[static_cast<std::size_t>(i)] = i < form.bilateral ? i : -1;
    d_index[static_cast<std::size_t>(i)] = i - form.bilateral;
  }
  const std::span<const double> shift(form.shift);
  const auto bilateral = static_cast<std::size_t>(form.bilateral);
  if (form.bilateral > 0) {
    write_text(folder / "C.mtx", format_matrix(select_rows(form.jacobian, c_index, form.bilateral)));
    write_text(folder / "c.mtx", format_vector(shift.first(bilateral)));
  }
  write_text(folder / "D.mtx", format_matrix(select_rows(form.jacobian, d_index, form.rows() - form.bilateral)));
  write_text(folder / "d.mtx", format_vector(shift.subspan(bilateral)));
}

void write_reduced(const fs::path& folder, const ProblemForm& form) {
  write_text(folder / "A.mtx", format_matrix(lower_triangle(form.a)));
  write_text(folder / "b.mtx", format_vector(form.shift));
}

}  // namespace

void write_folder(const fs::path& folder, const handles::Problem& problem) {
  ProblemForm form = form_of(problem);
  if (fs::exists(folder) && !fs::is_empty(folder)) throw std::runtime_error(folder.string() + ": is there and not empty");
  fs::create_directories(folder);
  if (form.reduced) write_reduced(folder, form);
  else write_global(folder, form);
  for (std::uint64_t& key : form.key) --key;  // a file's −1 is the library's 0: none
  if (!form.key.empty()) write_text(folder / "key.mtx", format_vector(form.key));
  const bool friction = form.contacts > 0;
  if (friction) write_text(folder / "mu.mtx", format_vector(form.mu));
  nlohmann::ordered_json meta = {{"form", form.reduced ? "reduced" : "global"}, {"nC", form.bilateral}, {"contacts", nullptr},
                                 {"dim", form.dimension}, {"friction", friction}};
  if (friction) meta["contacts"] = form.contacts;
  write_text(folder / "meta.json", meta.dump(1) + "\n");
}

}  // namespace cli
