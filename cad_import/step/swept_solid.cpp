#include "cad_import/step/swept_solid.h"

#include "cad_import/step/local_origin.h"
#include "cad_import/step/swept_pipe.h"
#include "cad_import/step/swept_profile.h"

namespace nurbeam {

namespace {

TopoDS_Shape swept(const NamedSolid& solid) {
  if (const auto* pipe = std::get_if<NamedPipe>(&solid)) return swept_pipe(*pipe);
  return swept_profile(std::get<SweptProfile>(solid));
}

}  // namespace

TopoDS_Shape swept_solid(const NamedSolid& solid) {
  const Eigen::Vector3d origin = local_origin(solid);
  return origin.isZero() ? swept(solid) : moved_back(swept(moved_to_origin(solid, origin)), origin);
}

std::pair<std::string, std::string> names_of(const NamedSolid& solid) {
  if (const auto* pipe = std::get_if<NamedPipe>(&solid)) return {pipe->axis.name, pipe->axis.part};
  const auto& profile = std::get<SweptProfile>(solid);
  return {profile.name, profile.part};
}

}  // namespace nurbeam
