#pragma once
#include "measure/certificate.h"
#include "solve/basis.h"
#include "solve/input.h"

namespace mlcp {

/// How one island went.
struct IslandEnd {
  mlcp_outcome outcome = MLCP_SOLVED;
  mlcp_method method = MLCP_METHOD_SIMPLEX;  ///< the one that gave the answer
  bool gave_up = false;                      ///< a method was left for another one
  bool crowded = false;                      ///< given up, and the pivoting method needs another analysis
  double epsilon = 0;                        ///< of the factor that is left
  bool semidefinite = false;                 ///< that factor is of M + δ: pivoting cannot take over
  bool kept = false;                         ///< that factor and the basis belong to the answer
  std::int32_t certificate_rows = 0;         ///< in Workspace::certificate_row from the island's first ordinal on
  std::int32_t indefinite = -1;              ///< position of the velocity whose pivot is not positive
  Counts counts;
};

/// Solves one island of a basis whose active set holds a start. Several threads may do so for different islands at the same time.
///
///     simplex   the pivoting method, from any start
///     newton    a guess if there is none, Newton steps; the simplex where these give up
///     pgs       Gauss-Seidel alone; newton where M couples too much
///     auto      newton; the simplex on islands of one or two rows, where a pivot is the whole solve
///
/// warm: the start is the caller's or an earlier step's, and no guess is needed.
IslandEnd solve_island(const SolveInput& input, Basis& basis, CertificateCheck& check, Watch& watch, std::int32_t index, bool warm,
                       Array<mlcp_pivot>* trace);

/// Solves an island again after Basis::reload, from `start`. end: of the last solve; kept: its factor still stands.
void solve_island_again(const SolveInput& input, Basis& basis, CertificateCheck& check, Watch& watch, std::int32_t index, const Mask& start,
                        Array<mlcp_pivot>* trace, IslandEnd& end);

/// After an answer: rows that depend on active ones, and, if the settings ask so, the impulses of least norm.
void finish_island(const SolveInput& input, Basis& basis, Watch& watch, std::int32_t index, std::uint8_t* redundant, IslandEnd& end);

}  // namespace mlcp
