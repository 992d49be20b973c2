#include "friction/slip.h"

#include <algorithm>
#include <cmath>

#include "measure/cones.h"

namespace mlcp {
namespace {

bool coulomb(const Contact& contact) { return contact.model == MLCP_FRICTION_COULOMB; }

/// The support of the slip is all that matters where directions are finitely many; else both components of the slip are unknown.
bool scalar(const Cone& cone) { return cone.planar || cone.pyramid(); }

/// −1, 0 or 1 along each axis for tangent rows that a mask has at their bounds.
Tangent pushed(const Contact& contact, const Mask& mask) {
  const auto sign = [&](std::int32_t t) {
    if (t >= contact.dimension) return 0.0;
    const mlcp_row_state s = mask.state[contact.row + t];
    return s == MLCP_ROW_AT_UPPER ? 1.0 : s == MLCP_ROW_AT_LOWER ? -1.0 : 0.0;
  };
  return {sign(1), sign(2)};
}

/// How a contact starts.
struct Start {
  bool closed = false;
  Tangent slip;      ///< u
  Tangent impulse;   ///< γ_T/(µ γ_n), at most 1 long
};

Start start_of(const Contact& contact, const Mask* mask) {
  Start s;
  if (!mask) return s;
  s.closed = mask->state[contact.row] == MLCP_ROW_ACTIVE;
  if (!mask->slip.empty()) {
    const Tangent t = contact_vector(contact, mask->slip.data()).t;
    const bool slips = mask->slip[contact.row] > 0;
    if (slips || t.x != 0 || t.y != 0) {
      const double size = length(t);
      (slips ? s.slip : s.impulse) = t;
      if (slips) s.impulse = {-t.x / size, -t.y / size};
      return s;
    }
  }
  s.impulse = pushed(contact, *mask);
  const double size = length(s.impulse);
  if (size > 1) s.impulse = {s.impulse.x / size, s.impulse.y / size};
  return s;
}

/// The generators that carry an impulse at p in the unit disc: the one next to it alone where p is (nearly) there, else that one and the
/// two around the opposite direction, so that p lies between the three.
void activate(Tangent p, std::span<const Tangent> direction, mlcp_row_state* state) {
  constexpr double on_the_edge = 1e-9;
  const auto count = static_cast<std::int32_t>(direction.size());
  std::int32_t near = 0;
  for (std::int32_t k = 1; k < count; ++k)
    if (dot(direction[k], p) > dot(direction[near], p)) near = k;
  state[near] = MLCP_ROW_ACTIVE;
  if (dot(direction[near], p) >= 1 - on_the_edge) return;
  std::int32_t left = -1, right = -1;  // on either side of −d
  const Tangent d = direction[near];
  for (std::int32_t k = 0; k < count; ++k) {
    const double side = d.x * direction[k].y - d.y * direction[k].x;
    std::int32_t& best = side >= 0 ? left : right;
    if (k != near && (best < 0 || dot(direction[k], d) < dot(direction[best], d))) best = k;
  }
  if (left >= 0) state[left] = MLCP_ROW_ACTIVE;
  if (right >= 0) state[right] = MLCP_ROW_ACTIVE;
}

}  // namespace

void Slip::start(const Problem& problem, const Mask* mask, Generators& generators, ConeRows& rows) {
  const Array<std::int32_t>& inner_of = rows.inner_of;
  rows.start.state.resize(rows.row_of.size());
  for (std::size_t row = 0; row < rows.row_of.size(); ++row)
    rows.start.state[row] = rows.cone_of_row[row] < 0 && mask ? mask->state[rows.row_of[row]] : static_cast<mlcp_row_state>(MLCP_ROW_AT_LOWER);
  if (!mask)
    for (std::size_t row = 0; row < rows.row_of.size(); ++row)
      if (rows.inner.lo[row] < 0 && rows.inner.hi[row] > 0) rows.start.state[row] = MLCP_ROW_ACTIVE;
  item_.clear();
  x_.clear();
  aimed_ = false;
  for (std::int32_t c = 0; c < generators.cones(); ++c) {
    const Contact& contact = problem.contacts[generators.contact[c]];
    const Start s = start_of(contact, mask);
    const Cone cone = generators.cone(problem, c);
    mlcp_row_state* state = rows.start.state.data() + inner_of[contact.row];
    item_.push_back({c, -1, 0, static_cast<std::int32_t>(x_.size())});
    x_.push_back(scalar(cone) ? cone.support(s.slip) : s.slip.x);
    if (!scalar(cone)) x_.push_back(s.slip.y);
    if (s.impulse.x != 0 || s.impulse.y != 0)
      aimed_ |= generators.aim(problem, c, cone.against({-s.impulse.x, -s.impulse.y}), true, nullptr, nullptr) >= 0;
    const std::int32_t first = generators.first[c];
    if (s.closed) activate(s.impulse, generators.direction.span().subspan(first, generators.first[c + 1] - first), state);
    rows.write_rows(problem, generators, c);
    rows.write_shift(problem, generators, c, coulomb(contact) ? contact.mu * cone.support(s.slip) : 0);
  }
  if (aimed_) rows.write_compliance(problem, generators);
  aimed_ = false;
  for (std::size_t i = 0; i < problem.couplings.size(); ++i) {
    item_.push_back({-1, static_cast<std::int32_t>(i), 0, static_cast<std::int32_t>(x_.size())});
    const Coupling& coupling = problem.couplings[i];
    const std::int32_t row = inner_of[coupling.row];
    x_.push_back(mask && !mask->slip.empty() ? mask->slip[coupling.row] : 0);
    const RowBounds bounds = coupled_bounds(problem, coupling, x_.back());
    rows.inner.lo[row] = bounds.lo;
    rows.inner.hi[row] = bounds.hi;
    if (bounds.lo == bounds.hi) rows.start.state[row] = MLCP_ROW_AT_LOWER;
  }
}

void Slip::group(const Problem& problem, const Generators& generators, const ConeRows& rows, std::span<const std::int32_t> inner_island) {
  for (Item& item : item_) {
    const std::int32_t row = item.cone >= 0 ? problem.contacts[generators.contact[item.cone]].row : problem.couplings[item.coupling].row;
    item.island = inner_island[rows.inner_of[row]];
  }
  std::stable_sort(item_.begin(), item_.end(), [](const Item& a, const Item& b) { return a.island < b.island; });
  f_.assign(x_.span());
  bounds_.clear();
  std::int32_t next = 0;
  for (std::size_t i = 0; i < item_.size(); ++i) {
    if (i == 0 || item_[i].island != item_[i - 1].island) bounds_.push_back(next);
    const std::int32_t old = item_[i].first;
    const bool two = item_[i].cone >= 0 && !scalar(generators.cone(problem, item_[i].cone));
    item_[i].first = next;
    x_[next++] = f_[old];
    if (two) x_[next++] = f_[old + 1];
  }
  bounds_.push_back(next);
  anderson_.start(bounds_.span());
  weighted_ = false;
}

double Slip::item_error(const Problem& problem, const Item& item, const Found& found, const Generators& generators) const {
  return item.cone >= 0 ? found.contact_error[generators.contact[item.cone]] : found.row_error[problem.couplings[item.coupling].row];
}

/// Residuals count relative to the scale in which the error is measured.
void Slip::weigh(const Problem& problem, const Item& item, const Found& found, const Generators& generators) {
  if (item.coupling >= 0) return;
  const Contact& contact = problem.contacts[generators.contact[item.cone]];
  double scale = 0;
  for (std::int32_t t = 0; t < contact.dimension; ++t) scale = std::max(scale, found.scale[contact.row + t]);
  const double weight = scale > 0 ? 1 / scale : 1;
  anderson_.weight[item.first] = weight;
  if (!scalar(generators.cone(problem, item.cone))) anderson_.weight[item.first + 1] = weight;
}

/// A generator of the cone at d. Where it replaces the neighbour that carried the impulse, it carries it.
void Slip::aim(const Problem& problem, std::int32_t cone, Tangent d, const Found& found, Generators& generators, ConeRows& rows) {
  const std::int32_t row = rows.inner_of[problem.contacts[generators.contact[cone]].row];
  const mlcp_row_state* now = found.inner_state.data() + row;
  const bool move = !generators.cone(problem, cone).pyramid() &&
                    std::count(now, now + generators.first[cone + 1] - generators.first[cone], MLCP_ROW_ACTIVE) <= 1;
  const std::int32_t k = generators.aim(problem, cone, d, move, found.inner_state.data() + row, found.inner_w.data() + row);
  if (k < 0) return;
  aimed_ = true;
  rows.write_rows(problem, generators, cone);
  mlcp_row_state* state = rows.start.state.data() + row;
  const std::int32_t count = generators.first[cone + 1] - generators.first[cone];
  const bool carries = std::any_of(state, state + count, [](mlcp_row_state s) { return s == MLCP_ROW_ACTIVE; });
  if (!move) state[k - generators.first[cone]] = MLCP_ROW_AT_LOWER;
  if (!move || !carries) return;
  std::fill_n(state, count, static_cast<mlcp_row_state>(MLCP_ROW_AT_LOWER));
  state[k - generators.first[cone]] = MLCP_ROW_ACTIVE;
}

void Slip::write(const Problem& problem, const Item& item, const Found& found, Generators& generators, ConeRows& rows) {
  if (item.coupling >= 0) {
    const Coupling& coupling = problem.couplings[item.coupling];
    const RowBounds bounds = coupled_bounds(problem, coupling, x_[item.first]);
    rows.inner.lo[rows.inner_of[coupling.row]] = bounds.lo;
    rows.inner.hi[rows.inner_of[coupling.row]] = bounds.hi;
    return;
  }
  const Contact& contact = problem.contacts[generators.contact[item.cone]];
  const Cone cone = generators.cone(problem, item.cone);
  double* x = x_.data() + item.first;
  if (scalar(cone)) x[0] = std::max(x[0], 0.0);
  const Tangent wt = contact_vector(contact, found.w.data()).t, u = scalar(cone) ? wt : Tangent{x[0], x[1]};
  if (u.x != 0 || u.y != 0) aim(problem, item.cone, cone.against(u), found, generators, rows);
  rows.write_shift(problem, generators, item.cone, coulomb(contact) ? contact.mu * (scalar(cone) ? x[0] : cone.support(u)) : 0);
}

/// f = G(x) − x.
void Slip::find_residual(const Problem& problem, const Item& item, const Found& found, const Generators& generators) {
  const double* x = x_.data() + item.first;
  double* f = f_.data() + item.first;
  if (item.coupling >= 0) {
    f[0] = found.gamma[problem.couplings[item.coupling].normal] - x[0];
    return;
  }
  const Cone cone = generators.cone(problem, item.cone);
  const Tangent w = contact_vector(problem.contacts[generators.contact[item.cone]], found.w.data()).t;
  if (scalar(cone)) {
    f[0] = cone.support(w) - x[0];
  } else {
    f[0] = w.x - x[0];
    f[1] = w.y - x[1];
  }
}

double Slip::worst(const Problem& problem, std::size_t group, std::size_t begin, const Found& found, const Generators& generators,
                   std::size_t& end) const {
  double most = 0;
  for (end = begin; end < item_.size() && item_[end].first < bounds_[group + 1]; ++end) {
    const Item& item = item_[end];
    if (found.hopeless[item.cone >= 0 ? problem.contacts[generators.contact[item.cone]].row : problem.couplings[item.coupling].row]) continue;
    const double e = item_error(problem, item, found, generators);
    most = e <= most ? most : e;
  }
  return most;
}

void Slip::keep(const Problem& problem, const Generators& generators, std::span<double> slip) const {
  for (const Item& item : item_) {
    if (item.cone < 0) continue;
    const Contact& contact = problem.contacts[generators.contact[item.cone]];
    const double* x = x_.data() + item.first;
    if (!(slip[contact.row] > 0)) continue;
    const Cone cone = generators.cone(problem, item.cone);
    if (!scalar(cone)) {
      slip[contact.row + 1] = x[0];
      slip[contact.row + 2] = x[1];
    } else if (const double support = cone.support(contact_vector(contact, slip.data()).t); support > 0 && x[0] > 0) {
      for (std::int32_t t = 1; t < contact.dimension; ++t) slip[contact.row + t] *= x[0] / support;
    }
  }
}

std::int32_t Slip::fall_back(const Problem& problem, const Mask* enabled, std::span<const std::int32_t> row_island, const Found& found,
                             double tolerance, std::int32_t facets, Generators& generators, ConeRows& rows) {
  std::int32_t islands = 0;
  aimed_ = false;
  for (std::size_t g = 0, begin = 0, end = 0; g + 1 < bounds_.size(); ++g, begin = end) {
    if (worst(problem, g, begin, found, generators, end) <= tolerance) continue;
    const auto contact = [&](std::size_t i) { return generators.contact[item_[i].cone]; };
    std::size_t first = begin;
    while (first < end && item_[first].cone < 0) ++first;
    // islands are the same ones in every solve, their numbers are not
    if (first == end) continue;
    const std::int32_t island = row_island[problem.contacts[contact(first)].row];
    if (island < 0 || !lemke_.solve(problem, enabled, row_island, island, facets)) continue;  // −1: nothing there can move
    ++islands;
    for (std::size_t i = first; i < end; ++i) {
      const Item& item = item_[i];
      if (item.cone < 0) continue;
      const Cone cone = generators.cone(problem, item.cone);
      const Tangent u = lemke_.slip(problem, contact(i));
      double* x = x_.data() + item.first;
      x[0] = scalar(cone) ? cone.support(u) : u.x;
      if (!scalar(cone)) x[1] = u.y;
      write(problem, item, found, generators, rows);
    }
    anderson_.restart(g);
  }
  if (aimed_) rows.write_compliance(problem, generators);
  return islands;
}

bool Slip::advance(const Problem& problem, const Found& found, double tolerance, Generators& generators, ConeRows& rows) {
  std::copy(found.inner_state.begin(), found.inner_state.end(), rows.start.state.begin());
  bool changed = false;
  aimed_ = false;
  for (std::size_t g = 0, begin = 0, end = 0; g + 1 < bounds_.size(); ++g, begin = end) {
    const double error = worst(problem, g, begin, found, generators, end);
    for (std::size_t i = begin; i < end; ++i) {
      find_residual(problem, item_[i], found, generators);
      if (!weighted_) weigh(problem, item_[i], found, generators);
    }
    if (error <= tolerance) continue;
    changed = true;
    anderson_.step(g, x_.data() + bounds_[g], f_.data() + bounds_[g]);
    for (std::size_t i = begin; i < end; ++i) write(problem, item_[i], found, generators, rows);
  }
  weighted_ = true;
  if (aimed_) rows.write_compliance(problem, generators);
  return changed;
}

}  // namespace mlcp
