#include "cad_import/occt/placed_curve.h"

namespace nurbeam {

Eigen::Affine3d in_metres(const gp_GTrsf& transformation, double unit) {
  Eigen::Affine3d result;
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 4; ++column)
      result(row, column) = transformation.Value(row + 1, column + 1) * (column == 3 ? unit : 1);
  result.makeAffine();
  return result;
}

NurbsCurve placed(const NurbsCurve& curve, const Eigen::Affine3d& transformation) {
  return {curve.knots(), transformation.matrix() * curve.control_points()};
}

}  // namespace nurbeam
