#include "cad_import/iges/location.h"

#include <Eigen/LU>
#include <IGESData_IGESEntity.hxx>
#include <IGESGeom_TransformationMatrix.hxx>
#include <TColStd_HArray2OfReal.hxx>
#include <gp_GTrsf.hxx>
#include <stdexcept>

#include "cad_import/occt/placed_curve.h"
#include "nurbs/number_text.h"

namespace nurbeam {

Eigen::Affine3d rigid_location(const IGESData_IGESEntity& entity) {
  if (!entity.HasTransf()) return Eigen::Affine3d::Identity();
  const Eigen::Affine3d location = in_metres(entity.Location(), 1);
  const Eigen::Matrix3d gram = location.linear().transpose() * location.linear();
  constexpr double digits = 1e-3;  // as files round the matrix
  if (const double off = (gram - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff(); !(off <= digits))
    throw std::runtime_error("its transformation matrix (124) stretches or shears, by " + text_of(off) +
                             "; it may only turn, mirror and move: draw the curve in its true size");
  return location;
}

void set_location(IGESData_IGESEntity& entity, const Eigen::Affine3d& location) {
  const Handle(TColStd_HArray2OfReal) rows = new TColStd_HArray2OfReal(1, 3, 1, 4);
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 4; ++column) rows->SetValue(row + 1, column + 1, location(row, column));
  const Handle(IGESGeom_TransformationMatrix) matrix = new IGESGeom_TransformationMatrix;
  matrix->Init(rows);
  entity.InitTransf(matrix);
}

}  // namespace nurbeam
