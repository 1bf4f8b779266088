#include "cad_import/iges/location.h"

#include <Eigen/LU>
#include <IGESData_IGESEntity.hxx>
#include <IGESData_TransfEntity.hxx>
#include <IGESGeom_TransformationMatrix.hxx>
#include <TColStd_HArray2OfReal.hxx>
#include <gp_GTrsf.hxx>
#include <set>
#include <stdexcept>

#include "cad_import/occt/placed_curve.h"
#include "nurbs/number_text.h"

namespace nurbeam {
namespace {

Handle(TColStd_HArray2OfReal) rows_of(const Eigen::Affine3d& location) {
  const Handle(TColStd_HArray2OfReal) rows = new TColStd_HArray2OfReal(1, 3, 1, 4);
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 4; ++column) rows->SetValue(row + 1, column + 1, location(row, column));
  return rows;
}

}  // namespace

Eigen::Affine3d location_of(const IGESData_IGESEntity& entity) {
  return entity.Transf().IsNull() ? Eigen::Affine3d::Identity() : in_metres(entity.Location(), 1);
}

Eigen::Affine3d rigid_location(const IGESData_IGESEntity& entity) {
  const Eigen::Affine3d location = location_of(entity);
  const Eigen::Matrix3d gram = location.linear().transpose() * location.linear();
  constexpr double digits = 1e-3;  // as files round the matrix
  if (const double off = (gram - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff(); !(off <= digits))
    throw std::runtime_error("its transformation matrix (124) stretches or shears, by " + text_of(off) +
                             "; it may only turn, mirror and move: draw the curve in its true size");
  return location;
}

Eigen::Affine3d chained_location(const IGESData_TransfEntity& matrix) {
  constexpr std::size_t most = 100;
  Eigen::Affine3d location = in_metres(matrix.Value(), 1);
  std::set<const IGESData_TransfEntity*> passed{&matrix};
  for (const IGESData_TransfEntity* last = matrix.Transf().get(); last; last = last->Transf().get()) {
    if (!passed.insert(last).second)
      throw std::runtime_error(
          "the matrices (124) that its directory entry goes on to lead in a circle; the last "
          "one must name no other in field 7");
    if (passed.size() > most)
      throw std::runtime_error("its directory entry goes on to more than " + std::to_string(most) +
                               " matrices (124); write their product as one");
    location = in_metres(last->Value(), 1) * location;
  }
  return location;
}

void set_matrix(IGESData_TransfEntity& matrix, const Eigen::Affine3d& location) {
  if (auto* known = dynamic_cast<IGESGeom_TransformationMatrix*>(&matrix)) known->Init(rows_of(location));
  matrix.InitTransf(nullptr);
}

void set_location(IGESData_IGESEntity& entity, const Eigen::Affine3d& location) {
  const Handle(IGESGeom_TransformationMatrix) matrix = new IGESGeom_TransformationMatrix;
  matrix->Init(rows_of(location));
  entity.InitTransf(matrix);
}

}  // namespace nurbeam
