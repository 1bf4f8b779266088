#include "pipelines/model/asked_torsion.h"

#include <string>
#include <vector>

namespace nurbeam {

namespace {

// What needs the sections of a beam, and where the case says so.
struct Asking {
  std::string beam, path, what;
};

std::vector<Asking> asking(const ResolvedCase& resolved) {
  std::vector<Asking> all;
  for (const CaseSupport& support : resolved.supports) {
    if (support.type == CaseSupport::Type::fork)
      all.push_back({support.beam, support.path + ".type", "\"fork\" holds the roll of a section"});
    if (support.axis)
      all.push_back({support.beam, support.path + ".axis", "a hinge's axis is held by a section"});
  }
  for (const CaseBeamJoint& joint : resolved.joints)
    for (const std::string& beam : joint.beams)
      if (joint.axis) all.push_back({beam, joint.path + ".axis", "a hinge's axis is held by a section"});
  for (const CaseLoad& load : resolved.loads) {
    if (load.kind == CaseLoad::Kind::torque_per_length)
      all.push_back({load.beam, load.path + ".torque_per_length", "a torque works on sections"});
    if (load.offset) all.push_back({load.beam, load.path + ".offset", "an offset is one in a section"});
  }
  for (const CaseSlidingJoint& joint : resolved.sliding_joints)
    if (joint.follows_section)
      all.push_back({joint.beam, joint.path + ".follows_section", "a body follows the section where it is"});
  for (const CaseSlidingJoint& joint : resolved.sliding_joints)
    if (joint.follows != Follows::nothing)
      all.push_back({joint.beam, joint.path + ".follows", "a body follows the section where it is"});
  for (const CaseBodyJoint& joint : resolved.body_joints)
    if (!joint.between[1].beam.empty() && joint.type != CaseBodyJoint::Type::ball)
      all.push_back({joint.between[1].beam, joint.type_path(), "a body's attitude is held by a section"});
  return all;
}

}  // namespace

void give_asked_torsion(ResolvedCase& resolved, Findings& findings) {
  for (const Asking& ask : asking(resolved)) {
    const std::size_t index = resolved.beam_index(ask.beam);
    if (index >= resolved.beams.size()) continue;  // said elsewhere
    CaseBeam& beam = resolved.beams[index];
    if (beam.rigid) continue;  // its sections are geometry
    if (beam.torsion_by_drawing) beam.torsion = true;
    if (!beam.torsion)
      findings.error(ask.path, ask.what + "; beam \"" + ask.beam +
                                   "\" has no torsion: give it \"torsion\": true, or leave this out");
  }
}

}  // namespace nurbeam
