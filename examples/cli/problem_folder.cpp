#include "problem_folder.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

// nlohmann/json: meta.json
#include <nlohmann/json.hpp>

#include "matrix_market.h"
#include "text_file.h"

namespace cli {
namespace {

namespace fs = std::filesystem;
using handles::check;

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

/// Which rows of the file are in the problem: all but the tangent rows of contacts. Fills file.file_row; returns for each row
/// of the file its index in the problem or −1.
std::vector<std::int32_t> choose_rows(const fs::path& folder, const Meta& meta, std::int32_t bilateral, ProblemFile& file) {
  const bool grouped = meta.dimension > 1 && meta.contacts > 0 && (meta.friction || find_matrix(folder, "mu"));
  std::int64_t end_of_contacts = bilateral;
  if (grouped) {
    end_of_contacts += static_cast<std::int64_t>(meta.contacts) * meta.dimension;
    if (end_of_contacts > file.file_rows) {
      throw std::runtime_error((folder / "meta.json").string() + ": contacts times dim is more than there are rows");
    }
    check_vector(require_matrix(folder, "mu"), meta.contacts);
  }
  std::vector<std::int32_t> new_index(static_cast<std::size_t>(file.file_rows), -1);
  for (std::int32_t i = 0; i < file.file_rows; ++i) {
    const bool in_group = i >= bilateral && i < end_of_contacts;
    if (in_group && (i - bilateral) % meta.dimension != 0) continue;
    new_index[static_cast<std::size_t>(i)] = static_cast<std::int32_t>(file.file_row.size());
    file.file_row.push_back(i);
  }
  return new_index;
}

/// The numbers of the rows that were chosen, in the library's signs: r = −`shift`.
struct RowNumbers {
  std::vector<double> r, lo;
  std::vector<std::uint64_t> key;

  RowNumbers(const std::vector<std::int32_t>& file_row, std::int32_t bilateral, const std::vector<double>& shift,
             const std::vector<std::uint64_t>& keys) {
    for (const std::int32_t i : file_row) {
      r.push_back(0.0 - shift[static_cast<std::size_t>(i)]);
      lo.push_back(i < bilateral ? -INFINITY : 0.0);
      key.push_back(keys[static_cast<std::size_t>(i)]);
    }
  }
};

void add_rows(ProblemFile& file, const Compressed& jacobian, const RowNumbers& rows) {
  const auto count = static_cast<std::int32_t>(rows.r.size());
  if (count == 0) return;
  check(mlcp_problem_rows_add_csr(file.problem.get(), count, jacobian.pointers.data(), jacobian.indices.data(),
                                  jacobian.values.data(), rows.r.data(), rows.lo.data(), nullptr, nullptr, rows.key.data(),
                                  nullptr),
        file.problem);
}

/// C above D.
Matrix stack(Matrix upper, const Matrix& lower) {
  for (std::size_t e = 0; e < lower.value.size(); ++e) upper.add(upper.rows + lower.row[e], lower.column[e], lower.value[e]);
  upper.rows += lower.rows;
  return upper;
}

/// The library's own words on what stands in a file. It counts from 0, and only the rows that were chosen.
[[noreturn]] void refuse(const Matrix& matrix, const ProblemFile& file) {
  const bool whole = file.file_row.size() == static_cast<std::size_t>(file.file_rows);
  throw std::runtime_error(matrix.source + ": " + mlcp_problem_error(file.problem.get()) + " (counted from 0" +
                           (whole ? ")" : ", without the rows of friction)"));
}

void add_body(const fs::path& folder, const Matrix& mass, ProblemFile& file) {
  const std::vector<double> k = vector_or_zero(folder, "k", mass.rows);
  if (mass.rows == 0) return;
  const Compressed columns = compress_columns(mass);
  const mlcp_triangle triangle = mass.symmetric ? MLCP_LOWER : MLCP_FULL;
  if (mlcp_problem_body_add_sparse(file.problem.get(), mass.rows, columns.pointers.data(), columns.indices.data(),
                                   columns.values.data(), triangle, nullptr) != MLCP_OK) {
    refuse(mass, file);
  }
  check(mlcp_problem_set_momentum(file.problem.get(), 0, mass.rows, k.data()), file.problem);
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

void read_global(const fs::path& folder, const Meta& meta, ProblemFile& file) {
  const Matrix mass = require_matrix(folder, "M");
  check_size(mass, mass.rows, mass.rows);
  add_body(folder, mass, file);

  const Matrix c_rows = matrix_of_rows(folder, "C", mass.rows), d_rows = matrix_of_rows(folder, "D", mass.rows);
  std::vector<double> shift = vector_or_zero(folder, "c", c_rows.rows);
  const std::vector<double> d = vector_or_zero(folder, "d", d_rows.rows);
  shift.insert(shift.end(), d.begin(), d.end());
  file.file_rows = c_rows.rows + d_rows.rows;
  const std::vector<std::int32_t> new_index = choose_rows(folder, meta, c_rows.rows, file);
  const auto count = static_cast<std::int32_t>(file.file_row.size());
  const Compressed jacobian = compress_rows(select_rows(stack(c_rows, d_rows), new_index, count));
  add_rows(file, jacobian, RowNumbers(file.file_row, c_rows.rows, shift, read_keys(folder, file.file_rows)));
}

void read_reduced(const fs::path& folder, const Meta& meta, ProblemFile& file) {
  const Matrix a = require_matrix(folder, "A");
  check_size(a, a.rows, a.rows);
  compress_columns(a);
  if (meta.bilateral > a.rows) throw std::runtime_error((folder / "meta.json").string() + ": nC is more than there are rows");
  file.file_rows = a.rows;
  const std::vector<std::int32_t> new_index = choose_rows(folder, meta, meta.bilateral, file);
  const auto count = static_cast<std::int32_t>(file.file_row.size());
  Compressed empty;
  empty.pointers.assign(static_cast<std::size_t>(count) + 1, 0);
  add_rows(file, empty,
           RowNumbers(file.file_row, meta.bilateral, vector_or_zero(folder, "b", a.rows), read_keys(folder, a.rows)));
  const Compressed columns = compress_columns(select_rows_and_columns(a, new_index, count));
  if (mlcp_problem_set_compliance_matrix(file.problem.get(), count, columns.pointers.data(), columns.indices.data(),
                                         columns.values.data(), a.symmetric ? MLCP_LOWER : MLCP_FULL) != MLCP_OK) {
    refuse(a, file);
  }
}

}  // namespace

ProblemFile read_folder(const fs::path& folder) {
  const Meta meta = read_meta(folder);
  ProblemFile file;
  file.problem = handles::make_problem();
  file.solver = handles::make_solver();
  if (meta.reduced) read_reduced(folder, meta, file);
  else read_global(folder, meta, file);
  return file;
}

}  // namespace cli
