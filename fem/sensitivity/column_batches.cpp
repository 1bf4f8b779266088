#include "fem/sensitivity/column_batches.h"

#include <algorithm>
#include <tuple>
#include <utility>

namespace nurbeam {

template <int D>
int ColumnBatches<D>::add(const Assembly<D>& of, const MeshElement<D>& element, int now,
                          Eigen::Index column) {
  const int beam = element.span->beam;
  const auto group = std::find_if(groups_.begin(), groups_.end(), [&](const Group& each) {
    return each.load.beam == beam &&
           each.of->model()->beams[beam].properties == of.model()->beams[beam].properties;
  });
  const int index = static_cast<int>(group - groups_.begin());
  if (group == groups_.end()) groups_.push_back({&of, {.beam = beam}});
  added_.push_back({index, now, column, &element});
  return index;
}

// In each group, elements that correspond to one element of the mesh stand beside one another.
template <int D>
void ColumnBatches<D>::close(const Assembly<D>& present) {
  std::vector<Added> all = std::exchange(added_, {});
  std::sort(all.begin(), all.end(), [](const Added& a, const Added& b) {
    return std::tie(a.group, a.now, a.column) < std::tie(b.group, b.now, b.column);
  });
  for (Each each = all.begin(); each != all.end();) {
    const Each end = std::find_if(each, all.cend(), [&](const Added& other) {
      return other.group != each->group || other.now != each->now;
    });
    put(each, end, present.elements()[each->now].dofs);
    each = end;
  }
}

// Puts elements into the batches of their group, into a new batch where they do not fit into the last.
template <int D>
void ColumnBatches<D>::put(Each begin, Each end, const std::array<int, element_size<D>>& dofs) {
  Group& group = groups_[static_cast<std::size_t>(begin->group)];
  std::vector<ElementBatch<D>>& batches = group.batches;
  bool fit = !batches.empty() && end - begin <= ElementBatch<D>::lanes - batches.back().count() &&
             batches.back().has(begin->element->element.properties());
  for (auto each = begin; each != end; ++each) {
    if (!std::exchange(fit, true) || batches.back().is_full())
      batches.emplace_back(each->element->element.properties());
    batches.back().add(each->element->element, dofs, each->element->slope_offset, each->now, each->column);
    group.columns.push_back(each->column);
  }
}

template <int D>
void ColumnBatches<D>::set_loads(const State& at) {
  for (auto& [of, load, batches, columns] : groups_) {
    load.load = of->line_load(load.beam, at);
    load.free_strain = of->free_strain_of(load.beam, at);
  }
}

template <int D>
void ColumnBatches<D>::add_forces(const State& at, Columns& forces) const {
  for (const Group& group : groups_)
    for (const ElementBatch<D>& batch : group.batches)
      batch.add_forces(at, group.load.load, group.load.free_strain, forces.data(), forces.cols());
}

template <int D>
void ColumnBatches<D>::energies(const State& at,
                                const std::function<void(Eigen::Index column, double energy)>& tell) const {
  for (const auto& [of, load, batches, columns] : groups_) {
    const BeamModel& model = *of->model();
    const Vector weight =
        model.beams[load.beam].properties.mass_per_length * model.gravity.template head<D>();
    auto column = columns.begin();
    for (const ElementBatch<D>& batch : batches) {
      const auto each = batch.energies(at, weight, of->free_strain_of(load.beam, at));
      for (int i = 0; i < batch.count(); ++i, ++column) {
        const auto& [kinetic, axial, bending, external, dissipation] = each[i];
        tell(*column, kinetic + axial + bending + external);
      }
    }
  }
}

template class ColumnBatches<2>;
template class ColumnBatches<3>;

}  // namespace nurbeam
