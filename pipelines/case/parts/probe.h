#pragma once
#include "fem/motion/record/snapshot.h"
#include "pipelines/case/parts/grip.h"

namespace nurbeam {

struct CaseProbe {
  std::string name, beam, body;  ///< of a beam or of a rigid body
  std::string path;
  Place at;                                        ///< on the beam
  std::string body_point;                          ///< the name of a point of the body; empty: none
  std::optional<Eigen::Vector3d> body_place = {};  ///< of the body, as drawn [m]
  ProbePlace::Side side = ProbePlace::Side::after;
};

inline Fields<CaseProbe> probe_fields() {
  using namespace shapes;
  using P = CaseProbe;
  return {{
              field(&P::name, "name", name(), "heads the columns of the probe").needed(),
              field(&P::beam, "beam", name(), "the probed beam"),
              field(&P::body, "body", name(), "the probed rigid body"),
              field_by<P>("at", place_of_grip(), place_of_grip_help,
                          [](const Json& json, const std::string& path, P& probe, Findings& findings) {
                            CaseGrip grip{.body = probe.body, .beam = probe.beam};
                            take_place(json, path, grip, findings);
                            probe.at = grip.at;
                            probe.body_point = grip.body_point;
                            probe.body_place = grip.body_place;
                          }),
              choice_field(&P::side, "side",
                           {{"before", ProbePlace::Side::before}, {"after", ProbePlace::Side::after}},
                           "where forces jump at the position: the side of smaller or of larger s")
                  .otherwise("after"),
          },
          {{{"beam", "body"}, required}}};
}

}  // namespace nurbeam
