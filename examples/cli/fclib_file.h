#pragma once
#include "problem_file.h"

/// FCLIB's HDF5 files, in which the codes that compute with Siconos and LMGC90 exchange frictional contact problems:
///
///     global   M v = H r + G λ + f,  Gᵀv + b = 0,  u = Hᵀv + w
///     local    Vᵀr + R λ + s = 0,  u = W r + V λ + q
///
/// In the library's terms the rows of λ come first and are bilateral, those of r follow, contact by contact, the normal first.
/// Without the build option MLCP_WITH_FCLIB all of these but is_fclib throw.
namespace cli {

/// Whether the file is HDF5, by its first bytes.
bool is_fclib(const std::filesystem::path& path);

/// Throws std::runtime_error naming the file.
ProblemFile read_fclib(const std::filesystem::path& path, const Friction& friction);
/// Throws std::runtime_error for what the form cannot hold: rows that are neither bilateral nor those of a contact, and see form_of.
void write_fclib(const std::filesystem::path& path, const handles::Problem& problem);

}  // namespace cli
