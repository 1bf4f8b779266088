#pragma once
#include <optional>
#include <string>
#include <vector>

#include "fem/element/reference_curve.h"
#include "nurbs/bezier_path.h"
#include "pipelines/case/case_file.h"
#include "pipelines/diagnostics/findings.h"
#include "pipelines/model/beam_axis.h"
#include "pipelines/model/model_frame.h"

namespace nurbeam {

/// The shortest segment or element, and the distance within which places are the same: parts of the beam's
/// length.
constexpr double shortest_segment = 1e-6, same_place = 1e-9;
/// In space an angle has no derivative where it is 0 or pi: no smaller sine can be held.
constexpr double least_sine = 0.02;

/// A beam's axis in the coordinates of the case and in those of the model.
struct DrawnBeam {
  std::string name;
  std::vector<RationalCubic> axis;  ///< as the case has it
  std::vector<int> corners;         ///< the breaks that stay corners
  std::vector<Corner> led_corners;  ///< those of BeamAxis
  ReferenceCurve measured;          ///< in reference arc length, which the case's places are given in
  ReferenceCurve curve;             ///< the model's: the same, but for a beam without a metric

  /// The model's material coordinate of a place in reference arc length.
  double material_coordinate(double s) const;
};

/// The beam along an axis; nothing, with an error among the findings, where no beam can follow it. `like`:
/// that of a neighbouring case, which may be null.
std::optional<DrawnBeam> drawn_beam(const CaseBeam& beam, const BeamAxis& axis, const ModelFrame& frame,
                                    const ReferenceCurve* like, Findings& findings);

/// The reference arc length at a place of the case [m]: exactly 0 or the length at the ends, 0 at the seam of
/// a ring. `where` is the JSON path of what is there, for the error when it is not on the beam.
double place_on(const DrawnBeam& beam, const Place& place, const std::string& where, Findings& findings);

}  // namespace nurbeam
