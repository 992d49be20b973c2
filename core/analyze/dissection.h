#pragma once
#include "analyze/quotient_graph.h"
#include "analyze/separator.h"
#include "threads/poll.h"

namespace mlcp {

/// Nested dissection of slender graphs (chains, ropes, trees of links), so that elimination paths are of logarithmic length,
/// where a minimum degree order may walk along the whole chain: a piece is cut when the middle level of a breadth-first search is thin. After
/// George (1973). Large bulky pieces are cut where a Separator is to be had; the rest is left to minimum degree.
/// The levels of a piece are levels of its halves too: these are cut without another search until no level of them is thin.
/// cost: O(variables · log variables) and the entries of separators where it cuts so, two searches of each piece where it does not.
struct Dissection {
  Array<std::int32_t> home;     ///< variable → node of the separator tree
  Array<std::int32_t> parent;   ///< tree node → tree node above, −1
  Array<std::int32_t> below;    ///< tree node → number of variables in the subtrees under it; they all come first

  explicit Dissection(const Memory& m)
      : home(m), parent(m), below(m), piece_(m), sequence_(m), front_(m), apart_(m), level_(m), visited_(m), stack_(m), level_start_(m), separator_(m) {}
  /// throws: Stopped
  void cut(const QuotientGraph& graph, Poll poll = {});

 private:
  struct Piece {
    std::int32_t first, last, parent;
    bool levelled = false;  // its variables stand by ascending level_, and none has neighbours in the piece but in its own level and those beside it
    bool searched = false;  // one search from the first of them has visited all: it is connected
  };
  std::int32_t search(const QuotientGraph& graph, std::int32_t root, std::int32_t label);
  bool touches_next_level(const QuotientGraph& graph, std::int32_t x, std::int32_t label) const;
  bool split(const QuotientGraph& graph, Piece piece);
  void split_apart(const QuotientGraph& graph, Piece piece, std::int32_t label);
  void find_levels(Piece piece);
  bool split_at_level(const QuotientGraph& graph, Piece piece, std::int32_t label, std::int32_t part);
  bool split_bulky(const QuotientGraph& graph, Piece piece);
  void leaf(Piece piece);

  Array<std::int32_t> piece_;     // variable → label of the piece it is in
  Array<std::int32_t> sequence_;  // variables, pieces contiguous
  Array<std::int32_t> front_;     // in order of visiting
  Array<std::int32_t> apart_;     // variables of a piece, by connected part
  Array<std::int32_t> level_, visited_;
  Array<Piece> stack_;
  Array<std::int32_t> level_start_;
  Separator separator_;
  std::int32_t label_ = 0, search_ = 0, reached_ = 0;
};

}  // namespace mlcp
