#pragma once
#include "assemble/mask.h"
#include "assemble/pattern_copy.h"
#include "assemble/velocity_runs.h"

namespace mlcp {

/// Connected parts of a problem, from its pattern alone: dynamic velocities and enabled rows that nothing couples to others. What elimination trees
/// tell of large islands, without an order.
class Components {
 public:
  explicit Components(const Memory& m)
      : velocity_pointers(m), velocities(m), row_pointers(m), rows(m), free_velocities(m), of_row(m), parent_(m), index_(m), joined_(m), last_pointers_(m), last_velocities_(m), coupled_(m), touched_(m), fixed_(m),
        enabled_(m), pattern_(m) {}

  Array<std::int32_t> velocity_pointers, velocities;  ///< component → velocities, ascending
  Array<std::int32_t> row_pointers, rows;             ///< component → rows, ascending
  VelocityRuns free_velocities;                       ///< a diagonal mass that no row touches: in no component
  Array<std::int32_t> of_row;                         ///< m: component, −1 for disabled rows

  std::int32_t count() const { return static_cast<std::int32_t>(velocity_pointers.size()) - 1; }
  std::int32_t velocity_count(std::int32_t c) const { return velocity_pointers[c + 1] - velocity_pointers[c]; }
  std::int32_t row_count(std::int32_t c) const { return row_pointers[c + 1] - row_pointers[c]; }

  std::span<const std::int32_t> velocities_of(std::int32_t c) const { return velocities.span().subspan(velocity_pointers[c], velocity_count(c)); }
  std::span<const std::int32_t> rows_of(std::int32_t c) const { return rows.span().subspan(row_pointers[c], row_count(c)); }

  /// Finds them, unless those that are there are the problem's.  returns whether it had to.
  /// cost: nearly O(entries of M, J and Σ); a comparison of them where the pattern is known.
  bool update(const Problem& problem, const Mask* enabled);
  void forget() { known_ = false; }
  /// Another one whenever an update has found another pattern of M or other velocities in some component: until then what depends on these alone stands.
  std::int64_t mass_version() const { return mass_version_; }

 private:
  bool covers(const Problem& problem, const Mask* enabled) const;
  void set_free_apart(const Problem& problem);
  void split(std::int32_t first, std::int32_t last);
  bool masses_stay(const Problem& problem) const;
  bool prescribes_the_same(const Problem& problem) const;
  void join_masses(const Problem& problem);
  void join_rows(const Problem& problem);
  void sort(const Problem& problem);

  bool known_ = false;
  std::int64_t mass_version_ = 0;
  Array<std::int32_t> parent_, index_;
  Array<std::int32_t> joined_;   // n: parent_ of velocities before any row has joined them
  Array<std::int32_t> last_pointers_, last_velocities_;  // at the update before
  Array<std::int32_t> coupled_;  // dynamic velocities that are not free, ascending
  Array<std::uint8_t> touched_;  // n: by enabled rows
  Array<std::uint8_t> fixed_;    // n: 1 on prescribed velocities
  Array<std::uint8_t> enabled_;  // m
  PatternCopy pattern_;          // at the last update
};

}  // namespace mlcp
