#pragma once
#include <filesystem>
#include <span>
#include <string>

#include "matrix.h"

/// Matrix Market files.
/// source: Boisvert, Pozo, Remington, "The Matrix Market Exchange Formats: Initial Design", NISTIR 5935 (1996)
namespace cli {

/// Reads a file, plain or gzip: coordinate or array, real, integer or pattern, general or symmetric. Throws std::runtime_error
/// naming file and line for anything else: numbers that are not finite, indices out of range, counts that the file does not
/// bear out. An entry that comes twice is left for compress_rows and compress_columns to find.
Matrix read_matrix(const std::filesystem::path& path);
Matrix parse_matrix(const std::string& text, const std::string& source);

/// The text of a file; every number survives the way back.
std::string format_matrix(const Matrix& matrix);
std::string format_vector(std::span<const double> values);
/// Negative numbers modulo 2⁶⁴, as in Matrix::whole.
std::string format_vector(std::span<const std::uint64_t> values);

}  // namespace cli
