#pragma once
#include <string>
#include <vector>

#include "cad_import/report/import_report.h"

class TopoDS_Face;
class TopoDS_Shape;

namespace nurbeam {

/// The centre line of a pipe or a hollow bar, and one of the faces it was found from.
struct CentreLine {
  ImportedCurve curve;
  int face;  ///< index into the faces of the shape as TopExp::MapShapes counts them, from 1
};

/// What was found in the faces of a shape.
struct CentreLines {
  std::vector<CentreLine> lines;  ///< those that meet end to end one after another, in running order
  std::vector<std::string>
      remarks;  ///< faces that give no centre line, or one that ends midway of a cut, and why
};

/// The centre lines of the pipes and rods among the faces of a shape [mm in, m out]: where faces that turn
/// all the way round have sections that are circles of one radius at right angles to one curve.
///
/// A cylinder gives a line, a torus an arc, exactly. A B-spline surface (a Bezier surface, one of extrusion
/// or revolution is taken as one) gives the affine combination of three of its isoparametric curves that is
/// the centre of every section, exactly where the surface is a translated or turned circle with the same
/// parameterisation all along; else a cubic through the centres of its sections within `tolerance` [m]. The
/// deviation, of the sections' radii and centres, is measured in both cases. A face that is not cut at right
/// angles to its axis gives none, nor does a hole; a pipe around a coaxial hole gives its bore's radius. Of
/// faces of no solid around one centre line, the second from outside is the bore of the first, and so on. Of
/// solids, the hollow bars with plane sides (hollow_bars.h) too.
CentreLines centre_lines(const TopoDS_Shape& shape, double tolerance);

}  // namespace nurbeam
