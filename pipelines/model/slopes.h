#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "fem/model/beam_model.h"
#include "pipelines/diagnostics/findings.h"
#include "pipelines/model/divide_beam.h"
#include "pipelines/model/join_beams.h"
#include "pipelines/model/resolved_case.h"

namespace nurbeam {

/// What was decided about the slope of a beam where something holds or loads it.
struct SlopeDecision {
  std::string path;  ///< JSON path of what is there
  int beam;
  double s;  ///< [m]
  SlopeRule asked = SlopeRule::automatic;
  std::optional<int> rider = {};  ///< of a sliding joint
  bool runs = false;              ///< a rider's place, in a motion
  bool is_clamp = false;
  bool is_load = false;  ///< which has a node only where the slope is discontinuous

  bool discontinuous = false;
  bool sharp = false;  ///< continuous, though elements beside it are parts of a string
  std::string why;
  /// Where these decided [N], [m]; the length is that of the shorter element beside it.
  std::optional<double> tension = {}, reach = {}, element = {};
};

/// Decides whether the slope of a beam is continuous where a force, a connector, a mass, a support, a hinged
/// joint or a sliding body is, and gives the model its kinks. `model` has its elements, and marks of what
/// holds its nodes.
///
/// `automatic` is discontinuous where bending reaches over a small part of the shorter element beside it:
/// sqrt(EI/T) < l/16, where both ways sag as wrongly, and l/2 under a body that slides in a motion, where
/// both have forces as wrong: a smooth node stiffens the element that it enters, and rings. T is the tension
/// that the beam is given, or else that of the equilibrium in which the analysis starts, with sliding bodies
/// held and all slopes continuous: one search, and none where no load can make the beam taut enough. It is
/// decided once, and stays. `like`: decisions of a neighbouring case, which are taken over. `held`: per beam,
/// the places that have a node already, in reference arc length [m].
std::vector<SlopeDecision> decide_slopes(const ResolvedCase& resolved, const std::vector<DrawnBeam>& beams,
                                         const std::vector<std::vector<double>>& held,
                                         const JoinedBeams& joined, const ModelFrame& frame,
                                         const std::function<bool()>& interrupted,
                                         const std::vector<SlopeDecision>* like, BeamModel& model,
                                         Findings& findings);

/// Makes slopes continuous again where elements have become so short that they bend. Returns whether
/// there were any.
bool smooth_fine_kinks(BeamModel& model, std::vector<SlopeDecision>& slopes);

}  // namespace nurbeam
