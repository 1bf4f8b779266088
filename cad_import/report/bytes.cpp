#include "cad_import/report/bytes.h"

namespace nurbeam {

void write(ByteWriter& out, const NurbsCurve& curve) {
  out.number(curve.degree());
  out.count(curve.knots().knots().size());
  for (double knot : curve.knots().knots()) out.number(knot);
  out.count(static_cast<std::size_t>(curve.control_points().size()));
  for (double value : curve.control_points().reshaped()) out.number(value);
}

NurbsCurve read_nurbs_curve(ByteReader& in) {
  const int degree = in.number<int>();
  std::vector<double> knots(in.count(sizeof(double)));
  for (double& knot : knots) knot = in.number<double>();
  const std::size_t size = in.count(sizeof(double));
  if (size % 4 != 0) ByteReader::fail();
  Eigen::Matrix4Xd points(4, static_cast<Eigen::Index>(size / 4));
  for (double& value : points.reshaped()) value = in.number<double>();
  return NurbsCurve(KnotVector(degree, std::move(knots)), std::move(points));
}

}  // namespace nurbeam
