#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "nurbs/curve_chain.h"
#include "pipelines/case/case_file.h"
#include "pipelines/diagnostics/findings.h"
#include "pipelines/model/cad_files.h"

namespace nurbeam {

/// What a beam's axis may measure [m].
constexpr double shortest_beam = 1e-6, longest_beam = 1e7;

/// The curves of a CAD file that an axis was made of.
struct AxisSource {
  std::filesystem::path file;
  std::vector<int> curves;  ///< their numbers in the file, from 0, in running order
  NurbsCurve first;         ///< the first of them as imported
  bool reversed;            ///< whether the axis runs against that one
};

/// The axis of one beam in the coordinates of the case.
struct BeamAxis {
  std::string curve_name;               ///< in its file, or else the beam's name
  std::vector<RationalCubic> segments;  ///< smooth where they meet, but for the corners [m]
  std::vector<int> corners = {};        ///< the breaks between segments that stay corners, ascending
  std::optional<AxisSource> source = {};
};

/// How far the cubics of a beam's axis may lie from its curves of this length: as the case says, else 1e-6 m,
/// and of the length at most [m].
double approximation_tolerance(const CaseBeam& beam, double length);
/// The same for the curves of a chain.
double approximation_tolerance(const CaseBeam& beam, const std::vector<NurbsCurve>& curves,
                               const Chain& chain);

/// The axis that the case describes, of a beam whose curves are the chain (empty for an axis that is in no
/// file) and on which so many bodies slide: its corners smoothed, its ends closed where it is a ring. With
/// errors among the findings the result cannot be used.
BeamAxis beam_axis(const CaseBeam& beam, const Chain& chain, int sliding_bodies, CadFiles& files,
                   Findings& findings);

}  // namespace nurbeam
