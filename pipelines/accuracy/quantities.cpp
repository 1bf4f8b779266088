#include "pipelines/accuracy/quantities.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace nurbeam {

namespace {

// What stands before the axis in names of components.
constexpr std::array<std::string_view, 6> vectors = {"", "v", "u", "joint_force.", "f", "m"};
// What a run stores with the sign of its larger side.
constexpr std::array<std::string_view, 6> of_larger_side = {"moment.max", "shear_force.max", "stress.max",
                                                            "torque.max", "twist.max",       "von_mises.max"};

std::string without_axis(const std::string& quantity) {
  if (quantity.empty() || quantity.back() < 'x' || quantity.back() > 'z') return quantity;
  const std::string before = quantity.substr(0, quantity.size() - 1);
  return std::ranges::find(vectors, before) != vectors.end() ? before : quantity;
}

std::string kind_of(const HistoryColumn& column, const std::string& quantity) {
  const std::string unit = " [" + column.unit + "]";
  if (column.unit == "m/s") return "speeds" + unit;
  if (column.unit == "m" && quantity.empty()) return "positions" + unit;
  if (column.unit == "m" && (quantity == "u" || quantity == "displacement.max"))
    return "displacements" + unit;
  if (column.unit == "m") return quantity + unit;
  return (column.of == "probe" || column.of == "beam" ? "sections" : column.of) + unit;
}

}  // namespace

std::vector<HistoryQuantity> history_quantities(const std::vector<HistoryColumn>& columns) {
  std::vector<HistoryQuantity> found;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const HistoryColumn& column = columns[i];
    const std::string quantity = without_axis(column.quantity);
    const auto same = std::ranges::find_if(found, [&](const HistoryQuantity& each) {
      return each.of == column.of && each.name == column.name && each.quantity == quantity &&
             quantity != column.quantity;
    });
    if (same != found.end())
      same->columns.push_back(i);
    else
      found.push_back(
          {column.of,
           column.name,
           quantity,
           column.unit,
           kind_of(column, quantity),
           {i},
           std::ranges::find(of_larger_side, std::string_view(column.quantity)) != of_larger_side.end()});
  }
  return found;
}

std::optional<std::size_t> quantity_of_extreme(const std::vector<HistoryQuantity>& quantities,
                                               const std::string& extreme) {
  const auto find = [&](const std::string& ending,
                        const std::string& quantity) -> std::optional<std::size_t> {
    for (std::size_t i = 0; i < quantities.size(); ++i)
      if (quantities[i].quantity == quantity && quantities[i].name + ending == extreme) return i;
    return std::nullopt;
  };
  for (std::size_t i = 0; i < quantities.size(); ++i)
    if (quantities[i].name + "." + quantities[i].quantity == extreme) return i;
  for (const auto& [ending, quantity] :
       {std::pair{".joint_force", "joint_force."}, {".force", "f"}, {".couple", "m"}})
    if (const auto found = find(ending, quantity)) return found;
  return std::nullopt;
}

}  // namespace nurbeam
