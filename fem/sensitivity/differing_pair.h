#pragma once
#include <array>
#include <optional>
#include <vector>

#include "fem/sensitivity/residual_differences.h"
#include "fem/system/assembly.h"

namespace nurbeam {

/// Two neighbouring systems of one mesh, and the elements in which they differ.
template <int D>
struct DifferingPair {
  /// An element that differs: its index in the two systems, and its index in the present mesh, which may be
  /// another one.
  struct Different {
    int index, now;
    std::array<int, element_size<D>> dofs = {};  ///< coordinates in the present mesh
  };
  /// An element that is in no batch: its index in the two systems, and the data of its points, if its ends
  /// move.
  struct Apart {
    int index;
    std::array<std::optional<typename BeamElement<D>::Points>, 2> points = {};
  };

  const Assembly<D>*more = nullptr, *less = nullptr;
  double step = 0;
  double work = 0;
  std::vector<Different> batched = {};  ///< elements in batches
  std::vector<Apart> apart = {};        ///< elements in no batch
  std::vector<int> loads = {};          ///< loads of the elements in batches
  std::vector<int> coordinates = {};    ///< coordinates of the elements in batches
  bool outlasts = false;                ///< the pair has outlasted the last change of the mesh
  bool carries_point = false;           ///< a body moves over an element that differs
  bool was_whole = true;                ///< the columns found last may be nonzero outside the elements
  bool is_in_sums = false;
  /// Whether only these elements differ: at equal coordinates, and at shifted ones.
  std::array<std::optional<bool>, 2> is_local = {};

  /// `unlike`: for each element, whether it differs.
  static DifferingPair of(const ResidualDifferences::Pair& pair, const std::vector<bool>& unlike,
                          const State& near);
  /// The pair after a change of the mesh that it outlasts; `elements`: new index of each element.
  DifferingPair behind(const std::vector<int>& elements) const;
  /// Per element after a change of the mesh, `count` in all: whether it differs, if this is known from
  /// before.
  std::vector<std::optional<bool>> known_unlike(const std::vector<int>& elements, std::size_t count) const;
  /// Whether free strains are equal in both systems at all times.
  bool has_same_free_strains() const;
  /// Whether differing elements differ from those of `system` in numbers only, and no line load or free
  /// strain differs.
  bool has_other_numbers_alone(const Assembly<D>& system) const;
};

}  // namespace nurbeam
