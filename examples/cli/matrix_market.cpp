#include "matrix_market.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string_view>
#include <system_error>

#include "text_file.h"

namespace cli {
namespace {

enum class Field { Real, Integer, Pattern };

struct Header {
  bool coordinate = false, symmetric = false;
  Field field = Field::Real;
};

/// Lines with something on them, comments left out, and the words of the present one. std::from_chars: the same numbers in
/// every locale.
class Lines {
 public:
  Lines(std::string_view text, const std::string& source) : rest_(text), source_(source) {}

  /// The very next line, comment or not.
  bool next_raw() {
    if (rest_.empty()) return false;
    const std::size_t end = std::min(rest_.find('\n'), rest_.size());
    words_ = rest_.substr(0, end);
    rest_.remove_prefix(std::min(end + 1, rest_.size()));
    ++number_;
    return true;
  }
  bool next() {
    while (next_raw()) {
      skip_blanks();
      if (!words_.empty() && words_.front() != '%') return true;
    }
    return false;
  }
  std::string_view word() {
    skip_blanks();
    const auto end = std::find_if(words_.begin(), words_.end(), is_blank);
    const std::string_view word = words_.substr(0, static_cast<std::size_t>(end - words_.begin()));
    words_.remove_prefix(word.size());
    return word;
  }
  void expect_end() {
    skip_blanks();
    if (!words_.empty()) fail("unexpected \"" + std::string(words_.substr(0, 20)) + "\"");
  }
  std::size_t characters_left() const { return rest_.size(); }

  [[noreturn]] void fail(const std::string& what) const {
    throw std::runtime_error(source_ + ":" + std::to_string(number_) + ": " + what);
  }

  std::int64_t integer(std::int64_t lo, std::int64_t hi, const char* name) {
    std::int64_t value = 0;
    const std::string_view text = word();
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (text.empty()) fail(std::string(name) + " is missing");
    if (error == std::errc::invalid_argument || end != text.data() + text.size()) fail(std::string(name) + " is not an integer");
    if (error != std::errc() || value < lo || value > hi) {
      fail(std::string(name) + " " + std::string(text) + " is not in " + std::to_string(lo) + ".." + std::to_string(hi));
    }
    return value;
  }

  double real() {
    std::string_view text = word();
    if (text.empty()) fail("a value is missing");
    if (text.front() == '+') text.remove_prefix(1);
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool read = error != std::errc::invalid_argument && end == text.data() + text.size();
    if (!read) fail("\"" + std::string(text) + "\" is no number");
    if (error == std::errc::result_out_of_range) {
      const std::size_t exponent = text.find_first_of("eE");
      const bool tiny = exponent != std::string_view::npos && text.substr(exponent + 1).starts_with('-');
      value = tiny ? 0 : INFINITY;
    }
    if (!std::isfinite(value)) fail("\"" + std::string(text) + "\" is not finite");
    return value;
  }

  /// An integer modulo 2⁶⁴.
  std::uint64_t whole() {
    std::string_view text = word();
    if (text.empty()) fail("a value is missing");
    const bool negative = text.front() == '-';
    if (negative || text.front() == '+') text.remove_prefix(1);
    std::uint64_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size()) fail("\"" + std::string(text) + "\" is no 64-bit integer");
    return negative ? 0 - value : value;
  }

 private:
  static bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }
  void skip_blanks() {
    while (!words_.empty() && is_blank(words_.front())) words_.remove_prefix(1);
  }

  std::string_view rest_, words_;
  const std::string& source_;
  int number_ = 0;
};

std::string lower_case(std::string_view word) {
  std::string text(word);
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

Header read_header(Lines& lines) {
  if (!lines.next_raw() || lower_case(lines.word()) != "%%matrixmarket" || lower_case(lines.word()) != "matrix") {
    lines.fail("does not begin with \"%%MatrixMarket matrix\"");
  }
  Header header;
  const std::string format = lower_case(lines.word()), field = lower_case(lines.word()), symmetry = lower_case(lines.word());
  if (format != "coordinate" && format != "array") lines.fail("format \"" + format + "\" is neither coordinate nor array");
  header.coordinate = format == "coordinate";
  if (field == "integer") header.field = Field::Integer;
  else if (field == "pattern" && header.coordinate) header.field = Field::Pattern;
  else if (field != "real" && field != "double") lines.fail("field \"" + field + "\" is not real, integer or pattern");
  if (symmetry != "general" && symmetry != "symmetric") lines.fail("symmetry \"" + symmetry + "\" is not general or symmetric");
  header.symmetric = symmetry == "symmetric";
  lines.expect_end();
  return header;
}

bool is_negative(std::uint64_t whole) { return whole > 0 - whole; }  // closer to 0 from below

double signed_value(std::uint64_t whole) {
  return is_negative(whole) ? -static_cast<double>(0 - whole) : static_cast<double>(whole);
}

void read_value(Lines& lines, const Header& header, Matrix& matrix) {
  if (header.field == Field::Pattern) {
    matrix.value.push_back(1);
  } else if (header.field == Field::Integer) {
    matrix.whole.push_back(lines.whole());
    matrix.value.push_back(signed_value(matrix.whole.back()));
  } else {
    matrix.value.push_back(lines.real());
  }
  lines.expect_end();
}

void next_entry(Lines& lines, std::int64_t done, std::int64_t entries) {
  if (!lines.next()) lines.fail("ends after " + std::to_string(done) + " of " + std::to_string(entries) + " entries");
}

void read_coordinates(Lines& lines, const Header& header, std::int64_t entries, Matrix& matrix) {
  for (std::int64_t e = 0; e < entries; ++e) {
    next_entry(lines, e, entries);
    matrix.row.push_back(static_cast<std::int32_t>(lines.integer(1, matrix.rows, "row") - 1));
    matrix.column.push_back(static_cast<std::int32_t>(lines.integer(1, matrix.columns, "column") - 1));
    read_value(lines, header, matrix);
  }
}

void read_array(Lines& lines, const Header& header, std::int64_t entries, Matrix& matrix) {
  std::int64_t done = 0;
  for (std::int32_t j = 0; j < matrix.columns; ++j) {
    for (std::int32_t i = header.symmetric ? j : 0; i < matrix.rows; ++i) {
      next_entry(lines, done++, entries);
      matrix.row.push_back(i);
      matrix.column.push_back(j);
      read_value(lines, header, matrix);
    }
  }
}

/// Keeps a damaged size line from asking for more memory than the file can fill.
void check_sizes(const Lines& lines, const Header& header, const Matrix& matrix, std::int64_t entries) {
  if (header.symmetric && matrix.rows != matrix.columns) lines.fail("a symmetric matrix is square");
  const std::int64_t shortest = !header.coordinate ? 2 : header.field == Field::Pattern ? 4 : 6;  // characters a line
  if (entries > (static_cast<std::int64_t>(lines.characters_left()) + 1) / shortest) {
    lines.fail("the file is too short for " + std::to_string(entries) + " entries");
  }
  const std::int64_t plausible = 1'000'000 + 100 * entries;
  if (header.coordinate && std::max(matrix.rows, matrix.columns) > plausible) {
    lines.fail("more than " + std::to_string(plausible) + " rows or columns for " + std::to_string(entries) + " entries");
  }
}

/// The shortest text that reads back as the same number.
template <typename Number>
void append(std::string& text, Number number, char after) {
  char buffer[32];
  const auto [end, error] = std::to_chars(buffer, buffer + sizeof buffer, number);
  text.append(buffer, end);
  text.push_back(after);
}

}  // namespace

Matrix parse_matrix(const std::string& text, const std::string& source) {
  Lines lines(text, source);
  const Header header = read_header(lines);
  Matrix matrix;
  matrix.source = source;
  matrix.symmetric = header.symmetric;
  if (!lines.next()) lines.fail("the line with the sizes is missing");
  constexpr std::int64_t most = std::numeric_limits<std::int32_t>::max();
  matrix.rows = static_cast<std::int32_t>(lines.integer(0, most, "number of rows"));
  matrix.columns = static_cast<std::int32_t>(lines.integer(0, most, "number of columns"));
  std::int64_t entries = static_cast<std::int64_t>(matrix.rows) * matrix.columns;
  if (header.symmetric) entries = static_cast<std::int64_t>(matrix.rows) * (matrix.rows + std::int64_t{1}) / 2;
  if (header.coordinate) entries = lines.integer(0, most, "number of entries");
  lines.expect_end();
  check_sizes(lines, header, matrix, entries);
  if (header.coordinate) {
    read_coordinates(lines, header, entries, matrix);
  } else {
    read_array(lines, header, entries, matrix);
  }
  if (lines.next()) lines.fail("more entries than the " + std::to_string(entries) + " announced");
  return matrix;
}

Matrix read_matrix(const std::filesystem::path& path) { return parse_matrix(read_text(path), path.string()); }

std::string format_matrix(const Matrix& matrix) {
  std::string text = "%%MatrixMarket matrix coordinate real ";
  text += matrix.symmetric ? "symmetric\n" : "general\n";
  append(text, matrix.rows, ' ');
  append(text, matrix.columns, ' ');
  append(text, matrix.value.size(), '\n');
  for (std::size_t e = 0; e < matrix.value.size(); ++e) {
    append(text, matrix.row[e] + 1, ' ');
    append(text, matrix.column[e] + 1, ' ');
    append(text, matrix.value[e], '\n');
  }
  return text;
}

std::string format_vector(std::span<const double> values) {
  std::string text = "%%MatrixMarket matrix array real general\n";
  append(text, values.size(), ' ');
  append(text, 1, '\n');
  for (const double value : values) append(text, value, '\n');
  return text;
}

std::string format_vector(std::span<const std::uint64_t> values) {
  std::string text = "%%MatrixMarket matrix array integer general\n";
  append(text, values.size(), ' ');
  append(text, 1, '\n');
  for (const std::uint64_t value : values) {
    if (is_negative(value)) text.push_back('-');
    append(text, is_negative(value) ? 0 - value : value, '\n');
  }
  return text;
}

}  // namespace cli
