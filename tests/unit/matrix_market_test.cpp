#include "cli/matrix_market.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <clocale>
#include <filesystem>
#include <limits>

#include "cli/text_file.h"
#include "support/scratch_folder.h"

namespace cli {
namespace {

/// The message of the error that parsing ends in.
std::string error_of(const std::string& text) {
  try {
    parse_matrix(text, "M.mtx");
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

const std::string coordinate = "%%MatrixMarket matrix coordinate real general\n";

TEST(MatrixMarket, reads_coordinates_with_comments_blank_lines_and_windows_ends) {
  const Matrix matrix = parse_matrix(coordinate + "% words\r\n\r\n2 3 2\r\n1 1 +1.5\r\n\t2  3 -2e-3\r\n", "M.mtx");
  EXPECT_EQ(matrix.rows, 2);
  EXPECT_EQ(matrix.columns, 3);
  EXPECT_EQ(matrix.row, (std::vector<std::int32_t>{0, 1}));
  EXPECT_EQ(matrix.column, (std::vector<std::int32_t>{0, 2}));
  EXPECT_EQ(matrix.value, (std::vector<double>{1.5, -2e-3}));
}

TEST(MatrixMarket, reads_arrays_by_columns) {
  const Matrix matrix = parse_matrix("%%MatrixMarket matrix array real general\n2 2\n1\n2\n3\n4\n", "M.mtx");
  const Compressed columns = compress_columns(matrix);
  EXPECT_EQ(columns.values, (std::vector<double>{1, 2, 3, 4}));
  EXPECT_EQ(columns.indices, (std::vector<std::int32_t>{0, 1, 0, 1}));
}

TEST(MatrixMarket, symmetric_entries_end_in_the_lower_triangle) {
  const Matrix matrix = parse_matrix("%%MatrixMarket matrix coordinate real symmetric\n2 2 2\n1 2 5\n2 2 7\n", "M.mtx");
  const Compressed columns = compress_columns(matrix);
  EXPECT_EQ(columns.pointers, (std::vector<std::int32_t>{0, 1, 2}));
  EXPECT_EQ(columns.indices, (std::vector<std::int32_t>{1, 1}));
  EXPECT_EQ(expand(matrix).value, (std::vector<double>{5, 7, 5}));
}

TEST(MatrixMarket, symmetric_array_has_the_lower_triangle_by_columns) {
  const Matrix matrix = parse_matrix("%%MatrixMarket matrix array real symmetric\n2 2\n1\n2\n3\n", "M.mtx");
  EXPECT_EQ(matrix.row, (std::vector<std::int32_t>{0, 1, 1}));
  EXPECT_EQ(matrix.column, (std::vector<std::int32_t>{0, 0, 1}));
}

TEST(MatrixMarket, pattern_entries_are_ones) {
  EXPECT_EQ(parse_matrix("%%MatrixMarket matrix coordinate pattern general\n1 1 1\n1 1\n", "M.mtx").value.front(), 1);
}

TEST(MatrixMarket, integers_are_exact_beyond_53_bits) {
  const Matrix matrix = parse_matrix("%%MatrixMarket matrix array integer general\n2 1\n18446744073709551614\n-1\n", "key.mtx");
  EXPECT_EQ(matrix.whole, (std::vector<std::uint64_t>{18446744073709551614u, 18446744073709551615u}));
  EXPECT_EQ(matrix.value.back(), -1);
}

TEST(MatrixMarket, numbers_do_not_depend_on_the_locale) {
  const std::string before = std::setlocale(LC_NUMERIC, nullptr);
  for (const char* name : {"de_DE.UTF-8", "it_IT.UTF-8", "fr_FR.UTF-8"}) std::setlocale(LC_NUMERIC, name);
  const Matrix matrix = parse_matrix(coordinate + "1 1 1\n1 1 1.5\n", "M.mtx");
  const std::string text = format_matrix(matrix);
  std::setlocale(LC_NUMERIC, before.c_str());
  EXPECT_EQ(matrix.value.front(), 1.5);
  EXPECT_NE(text.find("1 1 1.5"), std::string::npos);
}

TEST(MatrixMarket, errors_name_file_and_line) {
  EXPECT_EQ(error_of(coordinate + "2 2 1\n3 1 1\n"), "M.mtx:3: row 3 is not in 1..2");
  EXPECT_EQ(error_of(coordinate + "2 2 1\n1 0 1\n"), "M.mtx:3: column 0 is not in 1..2");
  EXPECT_EQ(error_of(coordinate + "2 2 1\n1 1 % \n"), "M.mtx:3: \"%\" is no number");
  EXPECT_EQ(error_of(coordinate + "2 2 1\n1 1       \n"), "M.mtx:3: a value is missing");
  EXPECT_EQ(error_of(coordinate + "2 2 1\n1 1 1 1\n"), "M.mtx:3: unexpected \"1\"");
  EXPECT_EQ(error_of(coordinate + "2 2 1\n1 1 one\n"), "M.mtx:3: \"one\" is no number");
  EXPECT_EQ(error_of(coordinate + "2 2 1\n1 1 nan\n"), "M.mtx:3: \"nan\" is not finite");
  EXPECT_EQ(error_of(coordinate + "2 2 1\n1 1 -inf\n"), "M.mtx:3: \"-inf\" is not finite");
  EXPECT_EQ(error_of(coordinate + "2 2 1\n1 1 1e999\n"), "M.mtx:3: \"1e999\" is not finite");
  EXPECT_EQ(error_of(coordinate + "2 2 1\n1 1 1\n2 2 1\n"), "M.mtx:4: more entries than the 1 announced");
  EXPECT_EQ(error_of(coordinate + "2 2 2\n1 1 1.0000000\n"), "M.mtx:3: ends after 1 of 2 entries");
  EXPECT_EQ(error_of(coordinate), "M.mtx:1: the line with the sizes is missing");
  EXPECT_EQ(error_of(""), "M.mtx:0: does not begin with \"%%MatrixMarket matrix\"");
}

TEST(MatrixMarket, other_kinds_are_refused_by_name) {
  EXPECT_NE(error_of("%%MatrixMarket matrix coordinate complex general\n").find("\"complex\""), std::string::npos);
  EXPECT_NE(error_of("%%MatrixMarket matrix coordinate real hermitian\n").find("\"hermitian\""), std::string::npos);
  EXPECT_NE(error_of("%%MatrixMarket matrix sparse real general\n").find("\"sparse\""), std::string::npos);
}

TEST(MatrixMarket, sizes_are_limited_by_what_the_file_holds) {
  EXPECT_NE(error_of(coordinate + "9 9 2000000000\n1 1 1\n").find("too short"), std::string::npos);
  const std::string array = "%%MatrixMarket matrix array real general\n";
  EXPECT_NE(error_of(array + "2000000000 2000000000\n1\n").find("too short"), std::string::npos);
  EXPECT_NE(error_of(coordinate + "2000000000 1 1\n1 1 1\n").find("more than"), std::string::npos);
  EXPECT_NE(error_of(coordinate + "99999999999999999999 1 1\n1 1 1\n").find("not in"), std::string::npos);
  EXPECT_NE(error_of(coordinate + "-1 1 1\n1 1 1\n").find("not in"), std::string::npos);
}

TEST(MatrixMarket, numbers_too_small_for_a_double_are_zero) {
  EXPECT_EQ(parse_matrix(coordinate + "1 1 1\n1 1 1e-999\n", "M.mtx").value.front(), 0);
  EXPECT_EQ(parse_matrix(coordinate + "1 1 1\n1 1 5e-324\n", "M.mtx").value.front(), 5e-324);
}

TEST(MatrixMarket, an_entry_that_comes_twice_is_an_error) {
  EXPECT_THROW(compress_rows(parse_matrix(coordinate + "2 2 2\n1 2 1\n1 2 1\n", "M.mtx")), std::runtime_error);
  const Matrix both = parse_matrix("%%MatrixMarket matrix coordinate real symmetric\n2 2 2\n1 2 1\n2 1 1\n", "M.mtx");
  EXPECT_THROW(compress_columns(both), std::runtime_error);
}

TEST(MatrixMarket, every_double_survives_writing_and_reading) {
  const std::vector<double> values = {0.1, 1.0 / 3, 5e-324, -0.0, std::numeric_limits<double>::max(), 123456789.123456789};
  EXPECT_EQ(parse_matrix(format_vector(values), "v.mtx").value, values);
  const std::vector<std::uint64_t> keys = {0, 1, std::uint64_t{1} << 63, ~std::uint64_t{0}};
  EXPECT_EQ(parse_matrix(format_vector(keys), "key.mtx").whole, keys);
}

TEST(MatrixMarket, reads_compressed_files_and_notices_truncated_ones) {
  const auto path = support::scratch_folder() / "mlcp_matrix_market_test.mtx.gz";
  std::string text = coordinate + "100 1 100\n";
  for (int i = 1; i <= 100; ++i) text += std::to_string(i) + " 1 " + std::to_string(i * i * 0.37) + "\n";
  const gzFile file = gzopen(path.c_str(), "wb");
  gzwrite(file, text.data(), static_cast<unsigned>(text.size()));
  gzclose(file);
  EXPECT_EQ(read_matrix(path).value.size(), 100u);
  std::filesystem::resize_file(path, std::filesystem::file_size(path) / 2);
  EXPECT_THROW(read_matrix(path), std::runtime_error);
  std::filesystem::remove(path);
  EXPECT_THROW(read_matrix(path), std::runtime_error);
}

}  // namespace
}  // namespace cli
