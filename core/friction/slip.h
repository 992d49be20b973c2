#pragma once
#include "friction/anderson.h"
#include "friction/cone_rows.h"
#include "friction/stewart_trinkle.h"

namespace mlcp {

/// The fixed point around the solves. Unknown, per cone: how it slips, u, from which come the shift s = µ maxⱼ(−dⱼ·u) (COULOMB) and the
/// direction −u/|u| of a generator; per coupled row: the impulse of its normal, from which come its bounds. A solve maps u to w_T: where
/// both agree, Coulomb's law holds. Nothing but right-hand sides and directions change, so that the active set carries over.
class Slip {
 public:
  explicit Slip(const Memory& m)
      : anderson_(m), lemke_(m), item_(m), bounds_(m), x_(m), f_(m) {}

  /// Takes u and the states of generators from the mask of an earlier solve (NULL: no slip, nothing active). Writes them into `rows`.
  void start(const Problem& problem, const Mask* mask, Generators& generators, ConeRows& rows);
  /// Groups the unknowns by islands of the inner rows. To be called once, after the first solve.
  void group(const Problem& problem, const Generators& generators, const ConeRows& rows, std::span<const std::int32_t> inner_island);

  /// What a solve found.
  struct Found {
    std::span<const double> w, gamma, scale;          ///< by caller's row
    std::span<const double> contact_error, row_error;
    std::span<const mlcp_row_state> inner_state;
    std::span<const double> inner_w;
    std::span<const std::uint8_t> hopeless;           ///< by caller's row: no u solves its island
  };
  /// The next u, and `rows` for it. Islands whose errors are all within the tolerance, and hopeless ones, stay as they are.
  /// false: there is nothing to change.
  bool advance(const Problem& problem, const Found& found, double tolerance, Generators& generators, ConeRows& rows);
  /// Writes u into `slip`, as a mask keeps it, for the contacts that slip there: the same start is then within the tolerance at once, where w_T
  /// would be one plain step further.
  void keep(const Problem& problem, const Generators& generators, std::span<double> slip) const;

  /// Puts u of every island that is not within the tolerance where Lemke's method has it, if the island is small. row_island: by caller's
  /// row. Returns the number of islands.
  std::int32_t fall_back(const Problem& problem, const Mask* enabled, std::span<const std::int32_t> row_island, const Found& found,
                         double tolerance, std::int32_t facets, Generators& generators, ConeRows& rows);

 private:
  /// A cone or a coupled row, with its variables from `first` on.
  struct Item {
    std::int32_t cone, coupling;  ///< one of them is −1
    std::int32_t island, first;
  };
  void aim(const Problem& problem, std::int32_t cone, Tangent d, const Found& found, Generators& generators, ConeRows& rows);
  /// The largest error of a group, 0 where it is hopeless; `end`: behind its last item.
  double worst(const Problem& problem, std::size_t group, std::size_t begin, const Found& found, const Generators& generators,
               std::size_t& end) const;
  void write(const Problem& problem, const Item& item, const Found& found, Generators& generators, ConeRows& rows);
  void find_residual(const Problem& problem, const Item& item, const Found& found, const Generators& generators);
  void weigh(const Problem& problem, const Item& item, const Found& found, const Generators& generators);
  double item_error(const Problem& problem, const Item& item, const Found& found, const Generators& generators) const;

  Anderson anderson_;
  StewartTrinkle lemke_;
  Array<Item> item_;                     // by group
  Array<std::int32_t> bounds_;
  Array<double> x_, f_;
  bool aimed_ = false, weighted_ = false;
};

}  // namespace mlcp
