#pragma once
#include <functional>
#include <vector>

#include "fem/element/element_batch.h"
#include "fem/sensitivity/residual_differences.h"
#include "fem/system/assembly.h"

namespace nurbeam {

/// Elements with fixed ends of many systems of one mesh, evaluated in batches at one state. The forces of
/// each element go into the column of its system.
template <int D>
class ColumnBatches {
 public:
  using Vector = Eigen::Matrix<double, D, 1>;
  using Columns = ResidualDifferences::Columns;

  /// The load of a group of elements with equal properties: that on the beam in one of the systems.
  struct Load {
    int beam;
    Vector load = Vector::Zero();  ///< from set_loads
    double free_strain = 0;
  };

  /// Adds an element of a system, which corresponds to the element with index `now` of the present mesh.
  /// Returns the index of its load. Precondition: ElementBatch<D>::takes(element.element).
  int add(const Assembly<D>& of, const MeshElement<D>& element, int now, Eigen::Index column);
  /// Puts all added elements into batches, with their coordinates in the present mesh.
  void close(const Assembly<D>& present);

  void set_loads(const State& at);
  const Load& load(int index) const { return groups_[static_cast<std::size_t>(index)].load; }
  /// Adds the forces of the elements under these loads.
  void add_forces(const State& at, Columns& forces) const;
  /// Calls tell(column, energy) with the mechanical energy of each element, including its weight but no other
  /// load.
  void energies(const State& at, const std::function<void(Eigen::Index column, double energy)>& tell) const;

 private:
  struct Group {
    const Assembly<D>* of;
    Load load;
    std::vector<ElementBatch<D>> batches = {};
    std::vector<Eigen::Index> columns = {};  // columns of the elements in batches
  };
  struct Added {
    int group, now;
    Eigen::Index column;
    const MeshElement<D>* element;
  };
  using Each = typename std::vector<Added>::const_iterator;

  void put(Each begin, Each end, const std::array<int, element_size<D>>& dofs);

  std::vector<Added> added_;  // elements that are not in batches yet
  std::vector<Group> groups_;
};

}  // namespace nurbeam
