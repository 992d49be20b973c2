#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "plain_rows.h"
#include "scenes/handles.h"

namespace bench {

/// The numbers of a problem in arrays, as an engine holds them: what the bulk calls of mlcp.h take. Prescribed bodies are folded into the rows.
class Assembly {
 public:
  Assembly() = default;
  /// facets: see PlainRows.
  explicit Assembly(const mlcp_problem* problem, std::int32_t facets = 0);

  /// Puts another problem beside this one, without a row between the two. which: tells its keys from those of the others.
  void append(const Assembly& other, std::uint64_t which);

  /// Gives all of them the pattern of M that they have together: files leave out what happens to be 0 in a step. fails: std::runtime_error,
  /// the bodies have other dimensions.
  static void share_mass_pattern(std::span<Assembly> steps);

  handles::Problem build(const mlcp_allocator* allocator = nullptr) const;
  /// Writes every value of M, J, k, r and Σ into a problem that build() made. The pattern stays.
  void refresh(const handles::Problem& problem) const;
  /// The next step of a scene in a problem of the same bodies: masses and momenta, the rows cleared and added anew.
  void step(const handles::Problem& problem) const;

 private:
  /// returns the problem's velocities among those of the bodies that it takes in.
  std::vector<Velocity> take_bodies(const mlcp_problem* problem);
  void take_compliance(const mlcp_problem* problem);
  void spread_mass(const Assembly& pattern);
  void add_rows(const handles::Problem& problem) const;
  void set_masses(const handles::Problem& problem) const;
  void set_sigma(const handles::Problem& problem) const;

  struct Body {
    std::int32_t dimension;
    bool dense;
    std::size_t first;                           // in mass_
    std::vector<std::int32_t> pointers, indices; // compressed columns of a sparse body
    std::size_t entries() const {
      const auto d = static_cast<std::size_t>(dimension);
      return dense ? d * d : indices.size();
    }
  };

  std::vector<Body> bodies_;
  std::vector<double> mass_;
  std::vector<double> k_;
  PlainRows rows_;
  std::vector<std::int32_t> sigma_pointers_, sigma_indices_;  // empty: Σ is diagonal
  std::vector<double> sigma_;
};

}  // namespace bench
