#include "cad_import/step/swept_solid.h"

#include <ShapeFix_ShapeTolerance.hxx>

#include "cad_import/report/length_unit.h"
#include "cad_import/step/local_origin.h"
#include "cad_import/step/swept_pipe.h"
#include "cad_import/step/swept_profile.h"

namespace nurbeam {

namespace {

TopoDS_Shape swept(const NamedSolid& solid) {
  if (const auto* pipe = std::get_if<NamedPipe>(&solid)) return swept_pipe(*pipe);
  return swept_profile(std::get<SweptProfile>(solid));
}

/// Made about its own place and put there as a whole.
TopoDS_Shape swept_about(const NamedSolid& solid, const Eigen::Vector3d& origin) {
  return moved_back(swept(moved_to_origin(solid, origin)), origin);
}

/// With tolerances that are above the digits of its coordinates there, by which other programs check it.
TopoDS_Shape swept_far_away(const NamedSolid& solid, const Eigen::Vector3d& origin) {
  constexpr double digits = 2e-14;  // of the coordinates
  const TopoDS_Shape shape = swept_about(solid, origin);
  ShapeFix_ShapeTolerance().LimitTolerance(shape,
                                           digits * origin.cwiseAbs().maxCoeff() * millimetres_per_metre);
  return shape;
}

}  // namespace

TopoDS_Shape swept_solid(const NamedSolid& solid) {
  const Eigen::Vector3d origin = local_origin(solid);
  return origin.isZero() ? swept(solid) : swept_far_away(solid, origin);
}

TopoDS_Shape swept_solid_in_place(const NamedSolid& solid) {
  const Eigen::Vector3d origin = local_origin(solid);
  return origin.isZero() ? swept(solid) : moved_in_itself(swept_about(solid, origin));
}

std::pair<std::string, std::string> names_of(const NamedSolid& solid) {
  if (const auto* pipe = std::get_if<NamedPipe>(&solid)) return {pipe->axis.name, pipe->axis.part};
  const auto& profile = std::get<SweptProfile>(solid);
  return {profile.name, profile.part};
}

}  // namespace nurbeam
