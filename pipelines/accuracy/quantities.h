#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "pipelines/results/history_columns.h"

namespace nurbeam {

/// A quantity of histories with its components: x, y and z of one place are one quantity.
struct HistoryQuantity {
  std::string of;              ///< probe, body, beam, ... (HistoryColumn)
  std::string name, quantity;  ///< "trolley", and without its axis "joint_force."
  std::string unit;
  std::string kind;  ///< of those that err alike: "positions [m]", "sections [N]", ...
  std::vector<std::size_t> columns;
  bool has_larger_sign = false;  ///< of its larger side: compared by magnitude
};

/// The quantities of columns, in the order of their first ones.
std::vector<HistoryQuantity> history_quantities(const std::vector<HistoryColumn>& columns);

/// Which quantity has an extreme of a run by the name that this has in run.json ("trolley.joint_force").
std::optional<std::size_t> quantity_of_extreme(const std::vector<HistoryQuantity>& quantities,
                                               const std::string& extreme);

/// Whether its numbers are positions in space, or displacements.
inline bool is_position(const HistoryQuantity& of) {
  return of.kind == "positions [m]" || of.kind == "displacements [m]";
}

}  // namespace nurbeam
