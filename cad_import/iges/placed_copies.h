#pragma once
#include <Eigen/Core>
#include <IGESData_IGESEntity.hxx>
#include <optional>
#include <vector>

namespace nurbeam {

/// What an IGES array puts at other places: its base entity, scaled and not turned, with its origin at each.
struct PlacedCopies {
  opencascade::handle<IGESData_IGESEntity> base;
  double scale = 1;
  std::vector<Eigen::Vector3d> places;  ///< in the unit of the file, before the array's own transformation
};

/// Of a rectangular (412) or circular (414) array of subfigures, without the positions that its list leaves
/// out (IGES 5.3, 4.136 and 4.137); nothing of any other entity. Throws std::runtime_error where the array
/// has no base, no position or more than 100,000.
std::optional<PlacedCopies> placed_copies(const IGESData_IGESEntity& entity);

}  // namespace nurbeam
