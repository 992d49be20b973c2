#pragma once
#include "analyze/dissection.h"
#include "analyze/quotient_graph.h"
#include "threads/poll.h"

namespace mlcp {

/// Approximate minimum degree (Amestoy, Davis & Duff 1996) with precedence: a row waits for its own velocities, a separator for
/// the pieces that it separates. A variable enters the degree lists when nothing is left that it waits for.
class MinimumDegree {
 public:
  explicit MinimumDegree(const Memory& m)
      : order(m), kind_(m), start_(m), length_(m), element_count_(m), weight_(m), degree_(m), stamp_(m), pending_(m), head_(m),
        next_(m), previous_(m), member_(m), tail_(m), bucket_(m), hash_(m), gone_(m), iw_(m), tree_(m), tree_pointers_(m), tree_variables_(m) {}

  /// after: order holds the variables in elimination order.  throws: Stopped.
  void run(const QuotientGraph& graph, const Dissection& dissection, Poll poll = {});

  Array<std::int32_t> order;

 private:
  enum Kind : std::uint8_t { variable, element, absorbed };
  void load(const QuotientGraph& graph, const Dissection& dissection);
  void enlist(std::int32_t i);
  void delist(std::int32_t i);
  std::int32_t smallest();
  void compress();
  void make_element(std::int32_t pivot);
  void measure_overlaps(std::int32_t pivot);
  void update_degrees(std::int32_t pivot);
  void merge_indistinguishable(std::int32_t pivot);
  void finish_element(std::int32_t pivot);
  void eliminate(std::int32_t i, const QuotientGraph& graph, const Dissection& dissection);
  void release(std::int32_t i);
  bool same_lists(std::int32_t i, std::int32_t j) const;

  Array<std::uint8_t> kind_;
  Array<std::int32_t> start_, length_, element_count_;  // lists in iw_; a variable's elements first
  Array<std::int32_t> weight_;                          // nodes that a supervariable stands for; negative: in the new element; 0: gone
  Array<std::int32_t> degree_;
  Array<std::int64_t> stamp_;                           // element: stamp + weight of its part outside the new element
  Array<std::int32_t> pending_;                         // what a variable still waits for
  Array<std::int32_t> head_, next_, previous_;          // degree lists
  Array<std::int32_t> member_, tail_;                   // variables merged into one, in order
  Array<std::int32_t> bucket_;                          // hash → supervariable
  Array<std::int32_t> hash_;                            // of a supervariable's lists
  Array<std::int32_t> gone_;                            // eliminated together with the pivot
  Array<std::int32_t> iw_;
  Array<std::int32_t> tree_;                            // separator → variables still below
  Array<std::int32_t> tree_pointers_, tree_variables_;
  std::int32_t variables_ = 0, lowest_ = 0, left_ = 0, size_ = 0;
  std::size_t free_ = 0;
  std::int64_t mark_ = 1;
};

}  // namespace mlcp
