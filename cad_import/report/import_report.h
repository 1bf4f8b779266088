#pragma once
#include <optional>
#include <string>
#include <vector>

#include "cad_import/report/diagnostic.h"
#include "cad_import/report/format.h"
#include "nurbs/nurbs_curve.h"

namespace nurbeam {

/// The section of a hollow bar with plane sides, as a rectangular tube.
struct BarSection {
  double width = 0, height = 0;                              ///< along its longest side and across [m]
  double area = 0;                                           ///< of the material [m^2]
  Eigen::Vector2d second_moments = Eigen::Vector2d::Zero();  ///< about the width, and about the height [m^4]
};

/// One curve of a CAD file, in metres, in world coordinates (locations and transforms applied).
struct ImportedCurve {
  std::string name = {};  ///< as in the file, else that of its part; "" for none
  std::string entity =
      {};  ///< kind in the file's terms: "line", "circle", "ellipse", "parabola",
           ///< "hyperbola", "bspline", "bezier", "offset", "other"; "centre line" of a pipe or bar
  std::string layer = {};   ///< STEP, DXF: name of its layer; IGES: number of its level; "" for none
  std::string colour = {};  ///< "#rrggbb"; "" for none
  std::string part = {};    ///< path of the part that holds it, "bridge/cable" (STEP: names of occurrences or
                            ///< products; IGES: of groups; DXF: of blocks); "" for none
  bool free = true;         ///< no face uses it
  bool hidden = false;      ///< not shown: STEP INVISIBILITY, IGES blank status
  bool exact = true;        ///< whether `curve` is the entity exactly
  double deviation = 0;     ///< measured distance from the entity when not exact [m]
  double pipe_radius = 0;   ///< of a centre line: the pipe's outer radius [m]; 0 for a curve of the file
  double bore_radius = 0;   ///< of a centre line: the pipe's inner radius [m]; 0 for a solid rod
  BarSection bar = {};      ///< of the centre line of a hollow bar, whose pipe_radius is 0
  NurbsCurve curve;

  bool is_centre_line() const { return pipe_radius > 0 || bar.area > 0; }
};

/// The curves found in a file, and a Diagnostic for every entity skipped or altered.
struct ImportReport {
  std::string file;
  std::optional<CadFormat> format = {};  ///< unpacked, where it is known
  std::string unit;                      ///< the file's length unit as declared: "mm", "m", "inch", ...
  double unit_in_metres = 0;
  double resolution =
      0;  ///< distance within which points of the file are one, as declared [m]; 0: undeclared
  std::vector<ImportedCurve> curves;
  std::vector<Diagnostic> diagnostics;
  std::size_t peak_memory = 0;  ///< that reading it took [bytes]
  bool ok() const { return !has_errors(diagnostics); }
};

}  // namespace nurbeam
