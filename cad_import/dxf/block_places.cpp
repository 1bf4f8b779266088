#include "cad_import/dxf/block_places.h"

#include <algorithm>
#include <numbers>
#include <stdexcept>
#include <string>

#include "cad_import/dxf/own_axes.h"

namespace nurbeam {

std::vector<Eigen::Affine3d> places_of(const DxfEntity& insert, const DxfBlock& block) {
  constexpr double most = 1e5;
  const double columns = std::max(1.0, insert.number_of(70, 1)),
               rows = std::max(1.0, insert.number_of(71, 1));
  if (columns * rows > most) throw std::runtime_error("it has more than 100000 rows and columns");
  const Eigen::Vector3d scale(insert.number_of(41, 1), insert.number_of(42, 1), insert.number_of(43, 1));
  const Eigen::Affine3d turned =
      Eigen::Affine3d(own_axes(insert)) * Eigen::Translation3d(point_at(insert, 10)) *
      Eigen::AngleAxisd(insert.number_of(50, 0) * std::numbers::pi / 180, Eigen::Vector3d::UnitZ());
  const Eigen::Affine3d scaled = Eigen::Scaling(scale) * Eigen::Translation3d(-point_at(block.head, 10));
  std::vector<Eigen::Affine3d> places;
  for (int row = 0; row < static_cast<int>(rows); ++row)
    for (int column = 0; column < static_cast<int>(columns); ++column)
      places.push_back(
          turned * Eigen::Translation3d(column * insert.number_of(44, 0), row * insert.number_of(45, 0), 0) *
          scaled);
  return places;
}

}  // namespace nurbeam
