#pragma once
#include <vector>

#include "fem/structure/beam.h"
#include "pipelines/case/case_file.h"
#include "pipelines/diagnostics/findings.h"
#include "pipelines/model/model_frame.h"

namespace nurbeam {

/// A bend of a pipe and how it departs from a beam, as its section ovalises. With h = t R/r^2 (t wall, R
/// radius of the bend, r mean radius of the pipe):
///   flexibility k = 1.65/h, which divides EI in both planes, at least 1;
///   stress factor i = 0.9/h^(2/3) on the stress of bending, at least 1.
/// Th. von Karman, Z. VDI 55 (1911), found the effect; both formulas are those of ASME B31 and EN 13480-3,
/// for bends without flanges. Torsion stays as it is.
struct Elbow {
  int segment;
  double radius, s;              ///< of the bend; where it is tightest [m]
  double characteristic;         ///< h [-]
  double flexibility() const;    ///< k [-]
  double stress_factor() const;  ///< i [-]
};

/// The elbows of a beam's axis, where its section is a pipe that is curved when it is free: the segments
/// whose flexibility is above 1.
std::vector<Elbow> elbows(const Section& section, const ReferenceCurve& curve);

/// The bends of a beam whose section says "bends": "flexible"; without that none, but a warning where the
/// tightest of them has h < 1. Reports a section that is no pipe.
std::vector<PipeBend> pipe_bends(const CaseBeam& from, const Beam& beam, const ModelFrame& frame,
                                 Findings& findings);

}  // namespace nurbeam
