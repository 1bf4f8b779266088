#include "fem/structure/beam_joint.h"

#include "fem/structure/structure.h"

namespace nurbeam {

std::string BeamJoint::reaction_name(const Structure& structure) const {
  if (!name.empty()) return name;
  return "joint." + structure.beams[beam_a].name + "." + structure.beams[beam_b].name;
}

}  // namespace nurbeam
