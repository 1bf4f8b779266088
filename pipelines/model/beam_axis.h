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
  /// The breaks at which a beam that is straight when it is free is drawn with a corner; an eyelet leads it
  /// round each of them (add_eyelets).
  std::vector<Corner> led_corners = {};
  std::optional<AxisSource> source = {};
};

/// How far the cubics of a beam's axis may lie from its curves of this length: as the case says, else 1e-6 m,
/// and of the length at most [m].
double approximation_tolerance(const CaseBeam& beam, double length);
/// The same for the curves of a chain.
double approximation_tolerance(const CaseBeam& beam, const std::vector<NurbsCurve>& curves,
                               const Chain& chain);

/// The axis of a beam as it is drawn, in the coordinates of the case. Throws std::invalid_argument where a
/// curve cannot be an axis.
BeamAxis drawn_axis(const CaseBeam& beam, const Chain& chain, CadFiles& files, Findings& findings);

/// What slides on a beam.
struct Sliders {
  int bodies = 0;  ///< eyelets besides
  bool eyelets = false;
};

/// The axis that the case describes, of a beam whose curves are the chain (empty for an axis that is in no
/// file) and on which these slide: its corners smoothed, its ends closed where it is a ring. With
/// errors among the findings the result cannot be used.
BeamAxis beam_axis(const CaseBeam& beam, const Chain& chain, const Sliders& sliders, CadFiles& files,
                   Findings& findings);

}  // namespace nurbeam
