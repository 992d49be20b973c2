#pragma once
#include "analyze/kkt_pattern.h"

namespace mlcp {

/// Row o goes to state `to` (ActiveSet::State).
struct Flip {
  std::int32_t o;
  std::uint8_t to;
};

/// Scratch of the methods. Islands use disjoint ranges, so that any number of them can be solved at the same time and no method allocates.
/// Holds nothing between two solves.
struct Workspace {
  // by position
  Array<double> step;               ///< direction, −γ on rows
  Array<double> rhs, rhs_size;
  Array<double> point;
  Array<double> center;             ///< what the proximal method stays close to, as x: v and −γ
  Array<long double> residual;
  // by ordinal
  Array<double> slack, slope;       ///< w and its change along `step`
  Array<double> image;              ///< A times a direction
  Array<std::int32_t> free;         ///< ordinals of rows between their bounds, from the island's first on
  Array<std::int32_t> certificate_row;  ///< the caller's rows that an infeasible island's proof names, from its first ordinal on
  Array<double> certificate_y;
  Array<std::int32_t> entered;      ///< how often a row has entered
  Array<std::uint8_t> state;        ///< an active set to go back to
  Array<Flip> flips;

  explicit Workspace(const Memory& m)
      : step(m), rhs(m), rhs_size(m), point(m), center(m), residual(m), slack(m), slope(m), image(m), free(m), certificate_row(m), certificate_y(m), entered(m), state(m), flips(m) {}

  void prepare(const KktPattern& pattern) {
    for (auto* a : {&step, &rhs, &rhs_size, &point, &center}) a->resize(pattern.size());
    residual.resize(pattern.size());
    for (auto* a : {&slack, &slope, &image, &certificate_y}) a->resize(pattern.rows());
    entered.resize(pattern.rows());
    free.resize(pattern.rows());
    certificate_row.resize(pattern.rows());
    state.resize(pattern.rows());
    flips.resize(pattern.rows());
  }
};

}  // namespace mlcp
