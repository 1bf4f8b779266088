#pragma once
#include "pipelines/case/case_axis.h"

namespace nurbeam {

/// How high a beam is over a profile of the ground.
struct CaseClearance {
  std::string path;
  std::string name, beam;
  CaseAxis profile;
};

/// CAD files are relative to `directory`.
inline Fields<CaseClearance> clearance_fields(const std::filesystem::path& directory = {}) {
  using namespace shapes;
  using C = CaseClearance;
  return {{
      field(&C::name, "name", name(), "heads the column of the clearance").needed(),
      field(&C::beam, "beam", name(), "the beam above").needed(),
      field_by<C>(
          "profile", axis_shape(),
          "the ground: points or a curve, given as an axis of a beam; a point of the beam is over its "
          "nearest point in plan",
          [directory](const Json& json, const std::string& path, C& clearance, Findings& findings) {
            clearance.profile = read_beam_axis(json, path, directory, findings);
          })
          .needed(),
  }};
}

}  // namespace nurbeam
