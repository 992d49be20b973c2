#include "problem_folder.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

// nlohmann/json: meta.json
#include <nlohmann/json.hpp>

#include "matrix_market.h"
#include "problem_form.h"
#include "text_file.h"

namespace cli {
namespace {

namespace fs = std::filesystem;

struct Meta {
  bool reduced = false;
  bool friction = false;
  std::int32_t bilateral = 0, contacts = 0, dimension = 1;
};

/// A count; absent and null are `otherwise`.
std::int32_t count_in(const nlohmann::json& meta, const char* name, std::int32_t otherwise) {
  const auto found = meta.find(name);
  if (found == meta.end() || found->is_null()) return otherwise;
  if (found->is_number_integer()) {
    const auto value = found->get<std::int64_t>();
    if (value >= 0 && value <= std::numeric_limits<std::int32_t>::max()) return static_cast<std::int32_t>(value);
  }
  throw std::runtime_error(std::string("\"") + name + "\" is not a count");
}

Meta parse_meta(const std::string& text) {
  const nlohmann::json json = nlohmann::json::parse(text);
  if (!json.is_object() || !json.contains("form") || !json["form"].is_string()) throw std::runtime_error("\"form\" is missing");
  const auto form = json["form"].get<std::string>();
  if (form != "global" && form != "reduced") throw std::runtime_error("form \"" + form + "\" is neither global nor reduced");
  Meta meta;
  meta.reduced = form == "reduced";
  meta.bilateral = count_in(json, "nC", 0);
  meta.contacts = count_in(json, "contacts", 0);
  meta.dimension = count_in(json, "dim", 1);
  if (meta.dimension < 1) throw std::runtime_error("\"dim\" is not positive");
  meta.friction = json.contains("friction") && json["friction"].is_boolean() && json["friction"].get<bool>();
  return meta;
}

Meta read_meta(const fs::path& folder) {
  const fs::path path = folder / "meta.json";
  const std::string text = read_text(path);
  try {
    return parse_meta(text);
  } catch (const std::exception& error) {
    throw std::runtime_error(path.string() + ": " + error.what());
  }
}

std::optional<Matrix> find_matrix(const fs::path& folder, const std::string& name) {
  for (const char* suffix : {".mtx", ".mtx.gz"}) {
    const fs::path path = folder / (name + suffix);
    if (fs::exists(path)) return read_matrix(path);
  }
  return std::nullopt;
}

Matrix require_matrix(const fs::path& folder, const std::string& name) {
  std::optional<Matrix> matrix = find_matrix(folder, name);
  if (!matrix) throw std::runtime_error((folder / (name + ".mtx")).string() + ": no such file");
  return std::move(*matrix);
}

void check_size(const Matrix& matrix, std::int32_t rows, std::int32_t columns) {
  if (matrix.rows == rows && matrix.columns == columns) return;
  const auto size = [](std::int64_t i, std::int64_t j) { return std::to_string(i) + " x " + std::to_string(j); };
  throw std::runtime_error(matrix.source + ": is " + size(matrix.rows, matrix.columns) + ", not " + size(rows, columns));
}

void check_vector(const Matrix& matrix, std::int32_t size) {
  if (matrix.rows == 1) check_size(matrix, 1, size);
  else check_size(matrix, size, 1);
}

/// Puts entries of a matrix of one column or one row where they belong.
template <typename Number>
std::vector<Number> spread(const Matrix& matrix, std::int32_t size, const std::vector<Number>& entries) {
  check_vector(matrix, size);
  std::vector<Number> result(static_cast<std::size_t>(size));
  for (std::size_t e = 0; e < entries.size(); ++e) {
    result[static_cast<std::size_t>(std::max(matrix.row[e], matrix.column[e]))] = entries[e];
  }
  return result;
}

std::vector<double> vector_or_zero(const fs::path& folder, const std::string& name, std::int32_t size) {
  const std::optional<Matrix> matrix = find_matrix(folder, name);
  if (!matrix) return std::vector<double>(static_cast<std::size_t>(size));
  return spread(*matrix, size, matrix->value);
}

/// The library's keys, 0: none, are the file's plus one, −1: none.
std::vector<std::uint64_t> read_keys(const fs::path& folder, std::int32_t rows) {
  const std::optional<Matrix> matrix = find_matrix(folder, "key");
  if (!matrix) return std::vector<std::uint64_t>(static_cast<std::size_t>(rows));
  std::vector<std::uint64_t> whole = matrix->whole;
  for (std::size_t e = whole.size(); e < matrix->value.size(); ++e) {
    const double value = matrix->value[e];
    if (value != std::floor(value) || std::fabs(value) > 0x1p53) throw std::runtime_error(matrix->source + ": keys are integers");
    whole.push_back(static_cast<std::uint64_t>(static_cast<std::int64_t>(value)));
  }
  for (std::uint64_t& key : whole) ++key;
  return spread(*matrix, rows, whole);
}

Matrix matrix_of_rows(const fs::path& folder, const std::string& name, std::int32_t columns) {
  std::optional<Matrix> matrix = find_matrix(folder, name);
  if (!matrix) {
    matrix.emplace();
    matrix->columns = columns;
  }
  check_size(*matrix, matrix->rows, columns);
  Matrix full = expand(std::move(*matrix));  // a program that writes files may well notice that D = I is symmetric
  compress_rows(full);                       // finds entries that come twice while the file's name is known
  return full;
}

/// C above D.
Matrix stack(Matrix upper, const Matrix& lower) {
  for (std::size_t e = 0; e < lower.value.size(); ++e) upper.add(upper.rows + lower.row[e], lower.column[e], lower.value[e]);
  upper.rows += lower.rows;
  return upper;
}

void read_global(const fs::path& folder, ProblemForm& form) {
  form.mass = require_matrix(folder, "M");
  check_size(form.mass, form.mass.rows, form.mass.rows);
  form.k = vector_or_zero(folder, "k", form.mass.rows);
  const Matrix c_rows = matrix_of_rows(folder, "C", form.mass.rows), d_rows = matrix_of_rows(folder, "D", form.mass.rows);
  form.shift = vector_or_zero(folder, "c", c_rows.rows);
  const std::vector<double> d = vector_or_zero(folder, "d", d_rows.rows);
  form.shift.insert(form.shift.end(), d.begin(), d.end());
  form.bilateral = c_rows.rows;
  form.jacobian = stack(c_rows, d_rows);
}

void read_reduced(const fs::path& folder, ProblemForm& form) {
  form.a = require_matrix(folder, "A");
  check_size(form.a, form.a.rows, form.a.rows);
  compress_columns(form.a);
  form.shift = vector_or_zero(folder, "b", form.a.rows);
}

/// Contacts of the file, if its rows come in groups.
void read_contacts(const fs::path& folder, const Meta& meta, ProblemForm& form) {
  if (meta.dimension < 2 || meta.contacts == 0 || !(meta.friction || find_matrix(folder, "mu"))) return;
  form.contacts = meta.contacts;
  form.dimension = meta.dimension;
  if (form.end_of_contacts() > form.rows()) {
    throw std::runtime_error((folder / "meta.json").string() + ": contacts times dim is more than there are rows");
  }
  const Matrix mu = require_matrix(folder, "mu");
  form.mu = spread(mu, meta.contacts, mu.value);
}

}  // namespace

ProblemFile read_folder(const fs::path& folder, const Friction& friction) {
  const Meta meta = read_meta(folder);
  ProblemForm form;
  form.reduced = meta.reduced;
  form.bilateral = meta.bilateral;
  if (meta.reduced) read_reduced(folder, form);
  else read_global(folder, form);
  if (form.bilateral > form.rows()) throw std::runtime_error((folder / "meta.json").string() + ": nC is more than there are rows");
  read_contacts(folder, meta, form);
  form.key = read_keys(folder, form.rows());
  return make_problem(form, friction);
}

}  // namespace cli
