#include "fem/structure/displacement_table.h"

namespace nurbeam {

DisplacementTable::DisplacementTable(const std::vector<Row>& rows, RowJoin join) {
  for (int d = 0; d < 3; ++d) {
    std::vector<RowCurve::Row> component;
    for (const auto& [t, displacement] : rows) component.emplace_back(t, displacement[d]);
    components_.emplace_back(std::move(component), join);
  }
}

DisplacementTable::Motion DisplacementTable::at(double t) const {
  if (law_) return law_(t);
  Motion motion;
  for (int d = 0; d < 3; ++d) {
    const RowCurve::Point now = components_[d].at(t);
    motion.value[d] = now.value;
    motion.rate[d] = now.slope;
    motion.acceleration[d] = now.second;
  }
  return motion;
}

}  // namespace nurbeam
