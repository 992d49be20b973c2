#pragma once
#include <span>

#include "analyze/mass_parts.h"
#include "analyze/symbolic.h"
#include "factorize/kkt_values.h"

namespace mlcp {

/// M⁻¹Jᵀ and the diagonal of A = J M⁻¹Jᵀ + Σ, from dense L D Lᵀ factors of the connected parts of M; J and M⁻¹Jᵀ by fours of velocities. A is
/// never formed.
class MassResponse {
 public:
  explicit MassResponse(const Memory& m) : diagonal(m), inverse(m), velocity(m), direction(m), jacobian_(m), entries_(m), lower_(m), dense_(m) {}

  Array<double> diagonal, inverse;     ///< ordinals: A_ii, 1 / A_ii
  Array<double> velocity, direction;   ///< velocities by fours, for whoever works on an island

  /// allocates; forgets all numbers.
  void prepare(const MassParts& parts, const KktPattern& pattern);
  /// false: a row touches a large part, or a part is not positive definite.
  /// cost: Σ d³ over the parts, Σ d² over the rows.
  bool compute(const Island& island, const KktValues& values, std::int64_t& work);
  const MassParts& parts() const { return *parts_; }

  /// velocity := M⁻¹ x on an island.
  void solve(const Island& island, const double* x);
  /// x := velocity
  void give(const Island& island, double* x) const;
  /// direction := 0 on an island.
  void clear_direction(const Island& island);
  /// velocity += t · direction on an island.
  void advance(const Island& island, double t);

  /// What loops over rows need, as a copy of pointers that stays in registers.
  class Rows {
   public:
    explicit Rows(const MassResponse& r)
        : pointers_(r.parts_->four_pointers.data()), fours_(r.parts_->fours.data()), jacobian_(r.jacobian_.data()), entries_(r.entries_.data()) {}

    /// u += M⁻¹Jᵀ e_o · t, with `velocity` or `direction` as u
    void add(std::int32_t o, double t, double* u) const {
      for (std::int64_t s = pointers_[o], last = pointers_[o + 1]; s < last; ++s) {
        double* four = u + 4 * static_cast<std::int64_t>(fours_[s]);
        const double* e = entries_ + 4 * s;
        store(four, load(four) + load(e) * t);
        store(four + 2, load(four + 2) + load(e + 2) * t);
      }
    }
    /// J(o,:) u
    double product(std::int32_t o, const double* u) const {
      Pair even{0, 0}, odd{0, 0};
      for (std::int64_t s = pointers_[o], last = pointers_[o + 1]; s < last; ++s) {
        const double *four = u + 4 * static_cast<std::int64_t>(fours_[s]), *j = jacobian_ + 4 * s;
        even += load(j) * load(four);
        odd += load(j + 2) * load(four + 2);
      }
      even += odd;
      return even[0] + even[1];
    }

   private:
    using Pair [[gnu::vector_size(16), gnu::aligned(8), gnu::may_alias]] = double;  // two lanes: what every x86-64 has
    static Pair load(const double* x) { return *reinterpret_cast<const Pair*>(x); }
    static void store(double* x, Pair value) { *reinterpret_cast<Pair*>(x) = value; }
    const std::int64_t* pointers_;
    const std::int32_t* fours_;
    const double *jacobian_, *entries_;
  };
  Rows rows() const { return Rows(*this); }

 private:
  /// Where the fours of a part begin in `velocity`.
  std::int64_t place(std::int32_t part) const { return 4 * static_cast<std::int64_t>(parts_->first_four[part]); }
  std::int32_t first_part(const Island& island) const { return parts_->before[island.first]; }
  std::int32_t last_part(const Island& island) const { return parts_->before[island.last]; }
  auto of(Array<double>& u, const Island& island) const {
    return std::span(u.data() + place(first_part(island)), u.data() + place(last_part(island)));
  }
  bool decompose_part(std::int32_t part, const KktValues& values, std::int64_t& work);
  const MassParts* parts_ = nullptr;
  const KktPattern* pattern_ = nullptr;
  Array<double> jacobian_, entries_;  // MassParts::fours, four numbers each
  Array<double> lower_;               // MassParts::block
  Array<double> dense_;               // by position
};

}  // namespace mlcp
