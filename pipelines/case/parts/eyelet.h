#pragma once
#include "fem/structure/structure.h"
#include "pipelines/case/parts/friction.h"

namespace nurbeam {

/// A ring in space through which a beam runs.
struct CaseEyelet {
  std::string path;
  std::string name, beam;
  Place at;
  std::optional<Eigen::Vector3d> position = {};  ///< [m]; else where the beam is drawn
  bool continuous_slope = false;
  StaticPlace rest = StaticPlace::free;
  bool leave_at_end = true;  ///< false: stop
  std::optional<Friction> friction = {};
};

inline Fields<CaseEyelet> eyelet_fields() {
  using namespace shapes;
  using E = CaseEyelet;
  return {{
      field(&E::name, "name", name(), "heads the columns of its force and of the place that is in it")
          .needed(),
      field(&E::beam, "beam", name(), "the beam that runs through it").needed(),
      field(&E::at, "at", place(), "which place of the beam is in it at the start").needed(),
      field(&E::position, "position", point(),
            "where it stands, a ring without mass; where the beam is drawn there when omitted"),
      choice_field(&E::continuous_slope, "slope", {{"continuous", true}, {"discontinuous", false}},
                   "whether the beam may have a kink in it")
          .otherwise("discontinuous"),
      choice_field(&E::rest, "equilibrium", {{"held", StaticPlace::held}, {"free", StaticPlace::free}},
                   "where statics find the beam: with the place `at` in it, or free to run through it")
          .otherwise("free"),
      field_by<E>("friction", friction_fields().shape(),
                  "what resists the beam that runs through it; nothing when omitted; `law` is capstan when "
                  "omitted, and `stick_stiffness` EA over the length of an element",
                  [](const Json& json, const std::string& path, E& eyelet, Findings& findings) {
                    eyelet.friction = Friction{.law = Friction::Law::capstan};
                    friction_fields().read(json, path, *eyelet.friction, findings);
                  }),
      choice_field(&E::leave_at_end, "at_beam_end", {{"leave", true}, {"stop", false}},
                   "what happens when the beam's end comes to it")
          .otherwise("leave"),
  }};
}

}  // namespace nurbeam
