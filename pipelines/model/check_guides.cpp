#include "pipelines/model/check_guides.h"

#include <algorithm>
#include <string>

#include "pipelines/diagnostics/closest_name.h"

namespace nurbeam {

void check_guides(const ResolvedCase& resolved, Findings& findings) {
  const auto refuse = [&](const std::string& beam, const std::string& path, const std::string& why) {
    const auto index = static_cast<std::size_t>(resolved.beam_index(beam));
    if (index < resolved.beams.size() && resolved.beams[index].rigid)
      findings.error(path, "names " + in_quotes(beam) + ", which is a rigid guide: " + why);
  };
  for (const CaseSupport& support : resolved.supports)
    refuse(support.beam, support.path + ".beam", "it stands where it is drawn; leave the support out");
  for (const CaseLoad& load : resolved.loads)
    refuse(load.beam, load.path + ".beam", "nothing moves it; leave the load out");
  for (const CaseBeamJoint& joint : resolved.joints)
    for (const std::string& beam : joint.beams)
      refuse(beam, joint.path + ".beams", "a beam that it is to hold there takes a support instead");
  for (const CaseBody& body : resolved.bodies)
    if (!body.fixed_to.empty())
      refuse(body.fixed_to, body.path + ".fixed_to.beam",
             "it stands where it is drawn; hold the body by a \"clamped\" support");
  for (const CaseSlidingJoint& joint : resolved.sliding_joints) {
    if (joint.slope == SlopeRule::discontinuous)
      refuse(joint.beam, joint.path + ".slope", "it has no kink at a body; use \"continuous\"");
    const bool of_point_mass = resolved.bodies[resolved.body_index(joint.body)].point_of.empty() &&
                               !resolved.bodies[resolved.body_index(joint.body)].inertia;
    if (joint.follows_section && of_point_mass)
      refuse(joint.beam, joint.path + ".follows_section", "it has no sections; leave this out");
  }
  const bool only_guides = std::all_of(
      resolved.beams.begin(), resolved.beams.end(), [](const CaseBeam& beam) { return beam.rigid; });
  const bool has_rigid_bodies =
      std::ranges::any_of(resolved.bodies, [](const CaseBody& body) { return body.inertia.has_value(); });
  if (only_guides && !has_rigid_bodies && resolved.analysis.has_modes())
    findings.error("analysis.type", "is for beams that deform, but all beams are rigid guides");
}

}  // namespace nurbeam
