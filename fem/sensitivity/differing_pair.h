#pragma once
#include <array>
#include <optional>
#include <vector>

#include "fem/sensitivity/residual_differences.h"
#include "fem/system/assembly.h"

namespace nurbeam {

/// Two neighbouring systems of one mesh, and what differs in them.
template <int D>
struct DifferingPair {
  /// An element that differs: its index in the two systems, and in the present mesh, which may be another
  /// one.
  struct Different {
    int index, now;
    std::array<int, element_size<D>> dofs = {};  ///< there
  };
  /// One that is in no batch: its index in the two systems, and where its ends were last, if they move.
  struct Apart {
    int index;
    std::array<std::optional<typename BeamElement<D>::Points>, 2> points = {};
  };

  const Assembly<D>*more = nullptr, *less = nullptr;
  double step = 0;
  double work = 0;
  std::vector<Different> batched = {};  ///< in batches
  std::vector<Apart> apart = {};        ///< the others
  std::vector<int> loads = {};          ///< of those in batches
  std::vector<int> coordinates = {};    ///< of the elements in batches
  bool outlasts = false;                ///< the last change of the mesh
  bool carries_point = false;           ///< a body moves over an element that differs
  bool was_whole = true;                ///< the last columns that were found may not be zero elsewhere
  bool is_in_sums = false;
  /// Whether no more differs than these: at the same coordinates, and at shifted ones.
  std::array<std::optional<bool>, 2> is_local = {};

  /// `unlike`: of all elements whether they are.
  static DifferingPair of(const ResidualDifferences::Pair& pair, const std::vector<bool>& unlike,
                          const State& near);
  /// The pair behind a change that it outlasts, of elements with these indices.
  DifferingPair behind(const std::vector<int>& elements) const;
  /// Of each element behind a change, of which there are so many, whether it is unlike: what it has been
  /// before, if it was there.
  std::vector<std::optional<bool>> known_unlike(const std::vector<int>& elements, std::size_t count) const;
  /// Whether free strains are the same at all times.
  bool has_same_free_strains() const;
  /// Whether nothing differs from `system` in elements that differ but numbers, nor in loads along beams.
  bool has_other_numbers_alone(const Assembly<D>& system) const;
};

}  // namespace nurbeam
