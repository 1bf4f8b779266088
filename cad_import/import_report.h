#pragma once
#include <string>
#include <vector>

#include "nurbs/nurbs_curve.h"

namespace nurbeam {

enum class Severity { note, warning, error };

/// Something a user must know about a file: data, not an exception.
struct Diagnostic {
  Severity severity;
  std::string where;    ///< file, entity or JSON path
  std::string message;  ///< what was found, the rule, and the nearest valid alternative
};

/// One curve of a CAD file, in metres, in world coordinates (locations and transforms applied).
struct ImportedCurve {
  std::string name;      ///< as in the file; "" if it has none there
  std::string entity;    ///< kind in the file's terms: "line", "circle", "ellipse", "parabola", "hyperbola",
                         ///< "bspline", "bezier", "offset", "other"
  bool free = true;      ///< no face uses it
  bool exact = true;     ///< whether `curve` is the entity exactly
  double deviation = 0;  ///< measured distance from the entity when not exact [m]
  NurbsCurve curve;
};

/// The curves found in a file, and a Diagnostic for every entity skipped or altered.
struct ImportReport {
  std::string file;
  std::string unit;  ///< the file's length unit as declared: "mm", "m", "inch", ...
  double unit_in_metres = 0;
  std::vector<ImportedCurve> curves;
  std::vector<Diagnostic> diagnostics;
  bool ok() const;  ///< no diagnostic is an error
};

}  // namespace nurbeam
