#pragma once
#include <string>
#include <vector>

#include "nurbs/curve_chain.h"
#include "pipelines/case/case_file.h"
#include "pipelines/diagnostics/findings.h"
#include "pipelines/model/cad_files.h"

namespace nurbeam {

/// What a model is made of: a case in which each beam has one chain of curves, and whatever is said of a beam
/// is said of one of these.
struct ResolvedCase {
  Eigen::Vector3d gravity;
  Air air = {};
  std::optional<MassField> field = {};
  std::vector<CaseBeam> beams = {};
  std::vector<Chain> chains = {};  ///< per beam: indices into the curves of its file; empty for other axes
  std::vector<CaseBody> bodies;
  std::vector<CaseLoad> loads;
  std::vector<CaseSupport> supports;
  std::vector<CaseSlidingJoint> sliding_joints;
  std::vector<CaseEyelet> eyelets = {};
  std::vector<CaseReel> reels = {};
  std::vector<CaseStop> stops;
  std::vector<CaseBeamJoint> joints;
  std::vector<CaseBodyJoint> body_joints = {};
  std::vector<CaseBodyLoad> body_loads = {};
  std::vector<CaseConnector> connectors;  ///< along a line
  std::vector<CaseConnector> rotational_connectors = {};
  std::vector<CaseCollector> collectors = {};
  std::vector<CaseProbe> probes;
  std::vector<CaseClearance> clearances;
  std::vector<CaseLaw> laws = {};
  bool accelerations = false;  ///< whether they are told
  CaseAnalysis analysis;

  /// The number of the beam of that name, which the case has.
  int beam_index(const std::string& name) const;
  int body_index(const std::string& name) const;
  /// How many bodies and eyelets slide on the beam of that name.
  int sliding_bodies(const std::string& name) const;
};

/// Chooses the curves of the axes that are in files. A beam of several chains becomes one beam for each,
/// named "name 1", "name 2", ...; what was said of the beam is said of each of them. A section "from" a CAD
/// file becomes that of the pipe. With errors among the findings the result cannot be used.
ResolvedCase resolve_case(const CaseFile& case_file, CadFiles& files, Findings& findings);

}  // namespace nurbeam
