#pragma once
#include "analyze/crowding.h"

namespace mlcp {

/// The graph that is ordered. Its variables are the rows and the velocities of large bodies; the velocities of a small body, or of
/// a small connected part of M, are eliminated before any row that touches them, so that they appear only as the clique of their
/// rows, an element in the sense of Amestoy, Davis & Duff (1996). A need not be formed. In crowded islands every velocity is a variable; there a row
/// that touches one velocity alone comes right before that, and rows in sequence that touch the same velocities are one variable.
///
/// lists of variable i: elements[..] then neighbours[..]; lists of element e: its variables.
struct QuotientGraph {
  std::int32_t variables = 0, elements = 0;
  Array<std::int32_t> node;             ///< variable → node
  Array<std::int32_t> element_of;       ///< velocity → element, −1 for variables and what is left out
  Array<std::int32_t> variable_of;      ///< node → variable, −1
  Array<std::int32_t> element_pointers, element_variables;    ///< element → its variables
  Array<std::int32_t> variable_pointers, variable_elements;   ///< variable → its elements
  Array<std::int32_t> neighbour_pointers, neighbours;         ///< variable → adjacent variables
  /// Velocities of a row that are variables themselves: a row that waits comes after all of them.
  Array<std::int32_t> own_pointers, own_rows;  ///< variable that is a velocity → rows (variables) that touch it
  Array<std::uint8_t> waits;  ///< by variable
  Array<std::int32_t> component, scratch, count;
  Array<std::int32_t> weight;           ///< variable → how many nodes it stands for
  Array<std::int32_t> leader;           ///< row → the variable that it comes right before, −1

  explicit QuotientGraph(const Memory& m)
      : node(m), element_of(m), variable_of(m), element_pointers(m), element_variables(m), variable_pointers(m),
        variable_elements(m), neighbour_pointers(m), neighbours(m), own_pointers(m), own_rows(m), waits(m), component(m), scratch(m),
        count(m), weight(m), leader(m) {}

  /// cost: O(entries of M, J and Σ).
  void build(const Problem& problem, const Selection& selection, const Crowding& crowding);

 private:
  void number(const Problem& problem, const Selection& selection, const Crowding& crowding);
  void join_elements(const Problem& problem);
  void join_variables(const Problem& problem);
  std::int32_t leader_of(const Problem& problem, std::int32_t row) const;
  std::int32_t velocities_ = 0;  // the first variables
};

}  // namespace mlcp
