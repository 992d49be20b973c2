#pragma once
#include <cstdint>
#include <limits>
#include <span>

#include "assemble/marker.h"
#include "memory/array.h"
#include "memory/error.h"
#include "mlcp.h"

namespace mlcp {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Compressed columns or rows; `pointers` has one entry more than there are columns (rows).
struct SparseArrays {
  Array<std::int32_t> pointers, indices;
  Array<double> values;
  explicit SparseArrays(const Memory& memory) : pointers(memory), indices(memory), values(memory) { pointers.push_back(0); }
};

/// A sparse matrix that somebody else owns. `outer` is the number of compressed columns (rows).
struct SparseView {
  std::int32_t outer = 0, inner = 0;
  const std::int32_t* pointers = nullptr;
  const std::int32_t* indices = nullptr;
  const double* values = nullptr;
  std::int64_t entries() const { return outer ? pointers[outer] : 0; }
};

/// A block of velocities and its mass. `dimension` 0 marks an id that is free.
struct Body {
  std::int32_t offset = 0;     ///< first velocity
  std::int32_t dimension = 0;
  std::int32_t prescribed = 0; ///< 1: the velocity is given
  std::int32_t sparse = 0;     ///< 0: dense mass; else 1 + the mlcp_triangle that the caller stores
  std::int32_t diagonal = 0;   ///< 1: every column has its diagonal entry, which may be 0, and no other
};

/// Of a pyramid: directions 6 µrad apart at least, whose products with small numbers are in range.
constexpr std::int32_t most_facets = 1 << 20;

/// Rows row (normal) and row + 1 … row + dimension − 1 (tangents). What the model asks of the rows stands with them too: bounds of
/// the tangents for MLCP_FRICTION_BOX, a Coupling each for MLCP_FRICTION_FINDEX.
struct Contact {
  std::int32_t row = 0;
  std::int32_t dimension = 3;  ///< 2 in the plane, 3 in space
  mlcp_friction model = MLCP_FRICTION_NONE;
  std::int32_t facets = 0;     ///< of the pyramid; 0: as the solver's settings say
  double mu = 0;
};

/// A row whose bounds are its lo and hi times the impulse of another one, `normal`.
struct Coupling {
  std::int32_t row, normal;
};

/// What edits write to before they change anything. Holds nothing between two calls, so a copy is empty.
struct EditWorkspace {
  Memory memory;
  Marker marker;
  Array<std::int32_t> index, slot;
  Array<double> value;
  SparseArrays expanded, sorted;
  explicit EditWorkspace(const Memory& m)
      : memory(m), marker(m), index(m), slot(m), value(m), expanded(m), sorted(m) {}
  EditWorkspace(const EditWorkspace& other) : EditWorkspace(other.memory) {}
  EditWorkspace& operator=(const EditWorkspace&) { return *this; }
};

/// M v − Jᵀγ = k, J v + Σγ − r = w with bounds on γ, as the caller sees it. Valid at all times: every edit checks its
/// arguments first, makes room, and only then changes anything.
///
/// mass        n columns, both triangles, in the caller's order within a column; a dense block of d velocities is d columns of
///             d entries, contiguous.
/// jacobian    m rows, columns index velocities.
/// compliance  m columns, both triangles; every column holds its diagonal entry, at diagonal[i].
struct Problem {
  Memory memory;                 ///< for copies and what is made beside the problem; its own arrays may come from elsewhere
  Array<Body> bodies;            ///< indexed by id
  Array<std::int32_t> body_of;   ///< n: velocity → body id
  SparseArrays mass;
  /// For sparse bodies that are not diagonal: the caller's value e of body b stands at mass_slot[s + 2e] and its mirror at mass_slot[s + 2e + 1]
  /// (the same on the diagonal), s = mass_slot_start[b], positions relative to mass.pointers[offset].
  Array<std::int32_t> mass_slot;
  Array<std::int64_t> mass_slot_start;  ///< one more than there are ids
  Array<double> momentum;        ///< n: k
  Array<double> given_velocity;  ///< n: v on prescribed bodies, 0 elsewhere
  SparseArrays jacobian;
  SparseArrays compliance;
  Array<std::int32_t> diagonal;  ///< m: position of Σᵢᵢ in compliance.values
  Array<double> r, lo, hi;       ///< m
  Array<std::uint64_t> key;      ///< m, 0: none
  Array<Contact> contacts;       ///< in order of adding; no row is in two of them
  Array<Coupling> couplings;     ///< ascending rows; no normal is itself coupled
  std::int32_t free_ids = 0;     ///< ids in `bodies` to be given out again; the last id is never free
  EditWorkspace work;

  explicit Problem(const Memory& m) : Problem(m, m) {}
  /// m: for the arrays alone.
  Problem(const Memory& beside, const Memory& m)
      : memory(beside), bodies(m), body_of(m), mass(m), mass_slot(m), mass_slot_start(m), momentum(m), given_velocity(m), jacobian(m),
        compliance(m), diagonal(m), r(m), lo(m), hi(m), key(m), contacts(m), couplings(m), work(m) {
    mass_slot_start.push_back(0);
  }
  Problem(const Problem& other, const Memory& m) : Problem(other.memory, m) { *this = other; }
  Problem(const Problem&) = delete;  // its arrays would share memory that goes with the other one
  Problem(Problem&&) = default;
  Problem& operator=(const Problem&) = default;
  Problem& operator=(Problem&&) = default;

  std::int32_t n() const { return static_cast<std::int32_t>(momentum.size()); }
  std::int32_t m() const { return static_cast<std::int32_t>(r.size()); }
  bool prescribed(std::int32_t velocity) const { return bodies[body_of[velocity]].prescribed != 0; }
  double sigma(std::int32_t row) const { return compliance.values[diagonal[row]]; }
  SparseView mass_view() const { return view(mass, n()); }
  SparseView jacobian_view() const { return view(jacobian, m(), n()); }
  SparseView compliance_view() const { return view(compliance, m()); }

 private:
  static SparseView view(const SparseArrays& a, std::int32_t outer, std::int32_t inner = -1) {
    return {outer, inner < 0 ? outer : inner, a.pointers.data(), a.indices.data(), a.values.data()};
  }
};

}  // namespace mlcp
