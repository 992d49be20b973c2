#include "analyze/dissection.h"

#include <algorithm>

namespace mlcp {
namespace {

constexpr std::int32_t leaf_size = 12;
/// Smaller pieces are not worth a search for a separator: minimum degree finds as little fill.
constexpr std::int32_t bulky_size = 4000;
/// A separator is thin when it has at most 2 and one in so many of the piece's variables,
constexpr std::int32_t thin = 16;
/// and much thinner than those of another search can hardly be.
constexpr std::int32_t thinner = 64;

template <class Visit>
void for_each_neighbour(const QuotientGraph& g, std::int32_t x, Visit visit) {
  for (std::int32_t t = g.variable_pointers[x]; t < g.variable_pointers[x + 1]; ++t) {
    const std::int32_t e = g.variable_elements[t];
    for (std::int32_t s = g.element_pointers[e]; s < g.element_pointers[e + 1]; ++s) visit(g.element_variables[s]);
  }
  for (std::int32_t t = g.neighbour_pointers[x]; t < g.neighbour_pointers[x + 1]; ++t) visit(g.neighbours[t]);
}

}  // namespace

/// Breadth-first levels from root within one piece. after: the order of visiting is in front_, level starts in
/// level_start_, reached_ variables were found. returns: a variable of the last level.
std::int32_t Dissection::search(const QuotientGraph& g, std::int32_t root, std::int32_t label) {
  Array<std::int32_t>& front = front_;
  front.clear();
  level_start_.clear();
  ++search_;
  front.push_back(root);
  level_[root] = 0;
  piece_[root] = -label;  // negative: visited
  std::size_t done = 0;
  for (std::int32_t level = 0; done < front.size(); ++level) {
    level_start_.push_back(static_cast<std::int32_t>(done));
    for (const std::size_t end = front.size(); done < end; ++done) {
      const std::int32_t x = front[done];
      const auto visit = [&](std::int32_t y) {
        if (piece_[y] != label) return;
        piece_[y] = -label;
        level_[y] = level + 1;
        front.push_back(y);
      };
      for (std::int32_t t = g.variable_pointers[x]; t < g.variable_pointers[x + 1]; ++t) {
        const std::int32_t e = g.variable_elements[t];
        if (visited_[e] == search_) continue;  // its variables are all visited: each element is opened once a search
        visited_[e] = search_;
        for (std::int32_t s = g.element_pointers[e]; s < g.element_pointers[e + 1]; ++s) visit(g.element_variables[s]);
      }
      for (std::int32_t t = g.neighbour_pointers[x]; t < g.neighbour_pointers[x + 1]; ++t) visit(g.neighbours[t]);
    }
  }
  reached_ = static_cast<std::int32_t>(front.size());
  level_start_.push_back(reached_);
  for (const std::int32_t x : front) piece_[x] = label;
  return front[front.size() - 1];
}

bool Dissection::touches_next_level(const QuotientGraph& g, std::int32_t x, std::int32_t label) const {
  bool found = false;
  for_each_neighbour(g, x, [&](std::int32_t y) { found |= piece_[y] == label && level_[y] == level_[x] + 1; });
  return found;
}

void Dissection::leaf(Piece piece) {
  const auto t = static_cast<std::int32_t>(parent.size());
  parent.push_back(piece.parent);
  for (std::int32_t s = piece.first; s < piece.last; ++s) home[sequence_[s]] = t;
}

/// A piece that the search of its first variable has not reached all of becomes its connected parts.     cost: O(entries), however many there are.
void Dissection::split_apart(const QuotientGraph& g, Piece piece, std::int32_t label) {
  apart_.clear();
  for (std::int32_t s = piece.first; s < piece.last; ++s) {
    const std::int32_t root = sequence_[s];
    if (piece_[root] != label) continue;
    if (s > piece.first) search(g, root, label);
    const std::int32_t first = piece.first + static_cast<std::int32_t>(apart_.size());
    for (const std::int32_t x : front_) {
      piece_[x] = 0;
      apart_.push_back(x);
    }
    stack_.push_back({first, first + reached_, piece.parent, false, true});
  }
  std::copy(apart_.begin(), apart_.end(), sequence_.begin() + piece.first);
}

/// Splits a piece into its connected parts, or into two halves and a thin separator; false: neither is to be had.
bool Dissection::split(const QuotientGraph& g, Piece piece) {
  const std::int32_t size = piece.last - piece.first, label = ++label_;
  for (std::int32_t s = piece.first; s < piece.last; ++s) piece_[sequence_[s]] = label;
  if (piece.levelled) {
    find_levels(piece);
    if (split_at_level(g, piece, label, thinner)) return true;
  }
  std::int32_t far = sequence_[piece.last - 1];
  if (!piece.searched) {
    far = search(g, sequence_[piece.first], label);
    if (reached_ < size) {
      split_apart(g, piece, label);
      return true;
    }
  }
  // velocities come first among the variables; a part that has some is no chain of bodies, and minimum degree serves it better
  const auto velocities = static_cast<std::int32_t>(g.own_pointers.size()) - 1;
  for (std::int32_t s = piece.first; s < piece.last; ++s)
    if (sequence_[s] < velocities) return false;
  search(g, far, label);
  piece.searched = true;
  return split_at_level(g, piece, label, thin) || (Separator::available() && size >= bulky_size && split_bulky(g, piece));
}

/// As search() leaves them, of a piece that is levelled.
void Dissection::find_levels(Piece piece) {
  front_.clear();
  level_start_.clear();
  for (std::int32_t s = piece.first; s < piece.last; ++s) {
    const std::int32_t x = sequence_[s];
    if (s == piece.first || level_[x] != level_[sequence_[s - 1]]) level_start_.push_back(s - piece.first);
    front_.push_back(x);
  }
  level_start_.push_back(piece.last - piece.first);
}

/// before: front_ holds the whole piece by levels, from search() or find_levels(). part: how thin the separator is to be.
bool Dissection::split_at_level(const QuotientGraph& g, Piece piece, std::int32_t label, std::int32_t part) {
  const std::int32_t size = piece.last - piece.first;
  Array<std::int32_t>& front = front_;
  const auto levels = static_cast<std::int32_t>(level_start_.size()) - 1;
  std::int32_t middle = -1;
  for (std::int32_t l = 1; l + 1 < levels; ++l) {
    if (level_start_[l] < size * 3 / 10 || level_start_[l + 1] > size - size * 3 / 10) continue;
    const auto width = [&](std::int32_t k) { return level_start_[k + 1] - level_start_[k]; };
    const auto off = [&](std::int32_t k) { return std::abs(2 * level_start_[k] - size); };
    if (middle < 0 || width(l) < width(middle) || (width(l) == width(middle) && off(l) < off(middle))) middle = l;
  }
  const std::int32_t most = 2 + size / part;
  if (middle < 0 || (level_start_[middle + 1] - level_start_[middle]) / 4 > most) return false;

  // variables of the middle level without a neighbour behind it belong to the near side
  const auto first = front.begin() + level_start_[middle], last = front.begin() + level_start_[middle + 1];
  const auto separator = std::stable_partition(first, last, [&](std::int32_t x) { return !touches_next_level(g, x, label); });
  const auto width = static_cast<std::int32_t>(last - separator);
  if (width > most) return false;
  const auto t = static_cast<std::int32_t>(parent.size());
  parent.push_back(piece.parent);
  for (auto x = separator; x < last; ++x) home[*x] = t;
  const auto near = static_cast<std::int32_t>(separator - front.begin()), until = static_cast<std::int32_t>(last - front.begin());
  std::copy(front.begin(), front.end(), sequence_.begin() + piece.first);
  if (near) stack_.push_back({piece.first, piece.first + near, t, true, piece.searched});  // all of it was reached through itself
  if (until < size) stack_.push_back({piece.first + until, piece.last, t, true});
  return true;
}

bool Dissection::split_bulky(const QuotientGraph& g, Piece piece) {
  if (!separator_.find(g, sequence_.span().subspan(piece.first, piece.last - piece.first))) return false;
  const auto t = static_cast<std::int32_t>(parent.size());
  parent.push_back(piece.parent);
  front_.clear();
  std::int32_t ends[2];
  for (const std::int32_t side : {0, 1}) {
    for (std::int32_t s = piece.first; s < piece.last; ++s)
      if (separator_.part[s - piece.first] == side) front_.push_back(sequence_[s]);
    ends[side] = piece.first + static_cast<std::int32_t>(front_.size());
  }
  for (std::int32_t s = piece.first; s < piece.last; ++s)
    if (separator_.part[s - piece.first] == 2) home[sequence_[s]] = t;
  std::copy(front_.begin(), front_.end(), sequence_.begin() + piece.first);
  for (const Piece half : {Piece{piece.first, ends[0], t}, Piece{ends[0], ends[1], t}})
    if (half.first < half.last) stack_.push_back(half);
  return true;
}

void Dissection::cut(const QuotientGraph& g, Poll poll) {
  home.assign(g.variables, -1);
  parent.clear();
  piece_.assign(g.variables, 0);
  level_.resize(g.variables);
  visited_.assign(g.elements, 0);
  label_ = search_ = 0;
  sequence_.resize(g.variables);
  for (std::int32_t x = 0; x < g.variables; ++x) sequence_[x] = x;
  stack_.clear();
  if (g.variables) stack_.push_back({0, g.variables, -1});
  while (!stack_.empty()) {
    const Piece piece = stack_.back();
    stack_.pop_back();
    poll.spend(16 * (piece.last - piece.first));
    if (piece.last - piece.first <= leaf_size || !split(g, piece)) leaf(piece);
  }
  below.assign(parent.size(), 0);
  for (const std::int32_t t : home)
    for (std::int32_t a = parent[t]; a >= 0; a = parent[a]) ++below[a];
}

}  // namespace mlcp
