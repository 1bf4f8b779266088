#pragma once
#include <optional>
#include <string>

#include "fem/element/reference_curve.h"
#include "fem/structure/place_motion.h"
#include "pipelines/case/parts/analysis.h"
#include "pipelines/case/parts/place_motion.h"
#include "pipelines/diagnostics/findings.h"

namespace nurbeam {

/// What moves along a beam, and what its rows count.
struct MovedPlace {
  std::string path;  ///< JSON path of what has the motion
  std::string beam;  ///< name
  const ReferenceCurve* curve;
  double s;                 ///< where it is at the start [m]
  bool from_start = false;  ///< the rows count from there on; else they are reference arc lengths
  double sense = 1;         ///< -1: rows and speed count towards the beam's start
  /// Where it can be, of an open curve [m].
  double low = curve->start(), high = curve->end();
};

/// The prescribed motion of a place in reference arc length; none where none is given. An error where it does
/// not begin at the place, leaves the beam, or jumps; a note where the speed of one in an analysis of motion
/// does.
std::optional<PlaceMotion> place_motion_of(const CasePlaceMotion& motion, const MovedPlace& place,
                                           const CaseAnalysis& analysis, Findings& findings);

}  // namespace nurbeam
