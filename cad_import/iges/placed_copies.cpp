#include "cad_import/iges/placed_copies.h"

#include <Eigen/Geometry>
#include <IGESDraw_CircArraySubfigure.hxx>
#include <IGESDraw_RectArraySubfigure.hxx>
#include <cmath>
#include <gp_Pnt.hxx>
#include <set>
#include <stdexcept>
#include <string>

namespace nurbeam {
namespace {

constexpr long most_positions = 100'000;

void check_count(long count) {
  if (count < 1 || count > most_positions)
    throw std::runtime_error("it has " + std::to_string(count) + " positions; there may be 1 to " +
                             std::to_string(most_positions));
}

/// The numbers of the positions, from 1, that are to be filled: those of the list, or all but those.
template <typename Array>
std::vector<int> filled(const Array& array, int count) {
  std::set<int> listed;
  for (int i = 1; i <= array.ListCount(); ++i) listed.insert(array.ListPosition(i));
  const bool only_listed = !array.DoDontFlag();
  std::vector<int> numbers;
  for (int number = 1; number <= count; ++number)
    if (listed.empty() || listed.contains(number) == only_listed) numbers.push_back(number);
  return numbers;
}

Eigen::Vector3d vector_of(const gp_Pnt& point) { return {point.X(), point.Y(), point.Z()}; }

PlacedCopies of_rectangle(const IGESDraw_RectArraySubfigure& array) {
  const int rows = array.NbRows();
  check_count(rows < 1 || array.NbColumns() < 1 ? 0 : static_cast<long>(rows) * array.NbColumns());
  PlacedCopies copies{array.BaseEntity(), array.ScaleFactor() == 0 ? 1 : array.ScaleFactor(), {}};
  const Eigen::AngleAxisd turn(array.RotationAngle(), Eigen::Vector3d::UnitZ());
  for (const int number : filled(array, rows * array.NbColumns())) {  // up the first column, then the second
    const int column = (number - 1) / rows, row = (number - 1) % rows;
    copies.places.push_back(
        vector_of(array.LowerLeftCorner()) +
        turn * Eigen::Vector3d(column * array.ColumnSeparation(), row * array.RowSeparation(), 0));
  }
  return copies;
}

PlacedCopies of_circle(const IGESDraw_CircArraySubfigure& array) {
  check_count(array.NbLocations());
  PlacedCopies copies{array.BaseEntity(), 1, {}};
  for (const int number : filled(array, array.NbLocations())) {
    const double angle = array.StartAngle() + (number - 1) * array.DeltaAngle();
    copies.places.push_back(vector_of(array.CenterPoint()) +
                            array.CircleRadius() * Eigen::Vector3d(std::cos(angle), std::sin(angle), 0));
  }
  return copies;
}

}  // namespace

std::optional<PlacedCopies> placed_copies(const IGESData_IGESEntity& entity) {
  PlacedCopies copies;
  if (const auto* rectangle = dynamic_cast<const IGESDraw_RectArraySubfigure*>(&entity))
    copies = of_rectangle(*rectangle);
  else if (const auto* circle = dynamic_cast<const IGESDraw_CircArraySubfigure*>(&entity))
    copies = of_circle(*circle);
  else
    return std::nullopt;
  if (copies.base.IsNull()) throw std::runtime_error("what it repeats is not in the file");
  return copies;
}

}  // namespace nurbeam
