#include "pipelines/model/why_torsion.h"

#include <algorithm>

namespace nurbeam {

std::string why_torsion(const CaseBeam& beam, bool asked, bool curved,
                        const std::vector<CaseSlidingJoint>& joints) {
  if (asked) return "yes, as the case asks for it";
  if (beam.torsion) return "yes, as it is drawn curved in space and free of stress so";
  if (!beam.torsion_by_drawing) return "no, as the case asks for an element without it";
  if (!curved) return "no, as it is drawn straight and bends alike in all directions";
  const bool carries = std::any_of(joints.begin(), joints.end(),
                                   [&](const CaseSlidingJoint& joint) { return joint.beam == beam.name; });
  return carries ? "no, as a body with a discontinuous slope slides on it" : "no";
}

}  // namespace nurbeam
