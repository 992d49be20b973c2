#pragma once
#include "problem_file.h"

/// A problem as a folder of Matrix Market files (`name.mtx` or `name.mtx.gz`) with a meta.json:
///
///     form "global"    M v = k + Cᵀλ + Dᵀz,  C v + c = 0,  w = D v + d,  0 ≤ z ⊥ w ≥ 0      M, C, D, k, c, d
///     form "reduced"   w = A z + b, the first nC rows free                                  A, b
///
/// in the library's terms J = [C; D], r = −[c; d], γ = [λ; z]; or n = 0, Σ = A, r = −b, γ = z. A vector without a file is 0. With
/// `dim` > 1 the first contacts·dim rows after C come in groups of `dim`, the normal first, and `mu` has a friction coefficient
/// for each group. `key` gives every row an identity over time, −1: none.
namespace cli {

/// Reads contacts with the friction asked for; without any their tangent rows are left out. Rolling rows, `dim` > 3, always are.
ProblemFile read_folder(const std::filesystem::path& folder, const Friction& friction = {});

/// Writes a problem as a folder, which must not be there yet or be empty. Bilateral rows come first, for that is where the form
/// has them; apart from that the order stays. Prescribed bodies go: their velocities move into c and d. Throws
/// std::runtime_error for what the form cannot hold, see form_of.
void write_folder(const std::filesystem::path& folder, const handles::Problem& problem);

}  // namespace cli
