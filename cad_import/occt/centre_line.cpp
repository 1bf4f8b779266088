#include "cad_import/occt/centre_line.h"

#include <BRepBuilderAPI_MakeEdge.hxx>
#include <Standard_Failure.hxx>
#include <TopExp.hxx>
#include <TopTools_IndexedDataMapOfShapeListOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Face.hxx>
#include <algorithm>
#include <cmath>
#include <new>
#include <numbers>
#include <optional>
#include <stdexcept>

#include "cad_import/occt/edge_curve.h"
#include "cad_import/occt/pipe_wall.h"
#include "cad_import/report/length_unit.h"
#include "nurbs/curve_chain.h"
#include "nurbs/number_text.h"

namespace nurbeam {
namespace {

using std::numbers::pi;

// Two radii, and two centre lines, are the same within this part of the radius (or the deviation of either).
constexpr double same_within = 1e-6;

bool near(const gp_Pnt& a, const gp_Pnt& b, double tolerance) { return a.Distance(b) <= tolerance; }

double tolerance_of(const Wall& a, const Wall& b) {
  return same_within * std::max(a.radius, b.radius) + 2 * std::max(a.deviation, b.deviation);
}

bool have_one_centre_line(const Wall& a, const Wall& b) {
  const double tolerance = tolerance_of(a, b);
  const bool same_ends = (near(a.start(), b.start(), tolerance) && near(a.end(), b.end(), tolerance)) ||
                         (near(a.start(), b.end(), tolerance) && near(a.end(), b.start(), tolerance));
  return same_ends && near(a.middle(), b.middle(), std::max(tolerance, 1e-3 * a.radius));
}

bool are_of_one_pipe(const Wall& a, const Wall& b) {
  return a.is_bore == b.is_bore && std::abs(a.radius - b.radius) <= tolerance_of(a, b) &&
         have_one_centre_line(a, b);
}

// Walls that turn all the way round, put together from the faces' own.
std::vector<Wall> whole_walls(const std::vector<Wall>& walls) {
  std::vector<Wall> joined;
  for (const Wall& wall : walls) {
    const auto same = std::find_if(joined.begin(), joined.end(),
                                   [&](const Wall& other) { return are_of_one_pipe(wall, other); });
    if (same == joined.end()) {
      joined.push_back(wall);
    } else {
      same->turn += wall.turn;
      same->deviation = std::max(same->deviation, wall.deviation);
    }
  }
  constexpr double missing = 1e-3;  // [rad]
  std::erase_if(joined, [](const Wall& wall) { return wall.turn < 2 * pi - missing; });
  return joined;
}

// Faces of no solid, as IGES has them, do not say on which side the material is: of those around one centre
// line every second one, from the outside, is a bore.
void find_bores_of_shells(std::vector<Wall>& walls) {
  const auto encloses = [](const Wall& a, const Wall& b) {
    return !a.in_solid && a.radius - b.radius > tolerance_of(a, b) && have_one_centre_line(a, b);
  };
  for (Wall& wall : walls)
    if (!wall.in_solid)
      wall.is_bore = std::count_if(walls.begin(), walls.end(),
                                   [&](const Wall& other) { return encloses(other, wall); }) %
                         2 ==
                     1;
}

CentreLine centre_line(const Wall& wall, const std::vector<Wall>& walls, double tolerance) {
  BRepBuilderAPI_MakeEdge edge(wall.centre, wall.first, wall.last);
  if (!edge.IsDone()) throw std::runtime_error("its centre line is no valid curve");
  ImportedCurve curve = imported_curve(edge.Edge(), tolerance);
  constexpr double round_off = 1e-9;  // of the radius
  curve.entity = "centre line";
  curve.free = false;
  curve.exact = wall.deviation <= round_off * wall.radius;
  curve.deviation = curve.exact ? 0 : wall.deviation / millimetres_per_metre;
  curve.pipe_radius = wall.radius / millimetres_per_metre;
  for (const Wall& bore : walls)
    if (bore.is_bore && bore.radius < wall.radius && have_one_centre_line(wall, bore))
      curve.bore_radius = std::max(curve.bore_radius, bore.radius / millimetres_per_metre);
  return {std::move(curve), wall.face};
}

// Those that meet end to end one after another, each running on from the one before it.
std::vector<CentreLine> in_running_order(const std::vector<CentreLine>& lines) {
  std::vector<NurbsCurve> curves;
  double largest = 0;
  for (const CentreLine& line : lines) {
    curves.push_back(line.curve.curve);
    largest = std::max(largest, line.curve.pipe_radius);
  }
  std::vector<CentreLine> ordered;
  for (const Chain& chain : find_chains(curves, worst_deviation * largest))
    for (std::size_t i = 0; i < chain.curves.size(); ++i) {
      ordered.push_back(lines[chain.curves[i]]);
      if (chain.reversed[i]) ordered.back().curve.curve = ordered.back().curve.curve.reversed();
    }
  return ordered;
}

std::string refusal(int face, const Wall& wall) {
  return "face " + std::to_string(face) + " has a circular section of radius " + text_of(wall.radius) +
         " mm but is not cut at right angles to its axis: it gives no centre line; name an edge or a free "
         "curve as the axis";
}

}  // namespace

CentreLines centre_lines(const TopoDS_Shape& shape, double tolerance) {
  TopTools_IndexedDataMapOfShapeListOfShape solids_of_faces;
  TopExp::MapShapesAndAncestors(shape, TopAbs_FACE, TopAbs_SOLID, solids_of_faces);
  CentreLines found;
  std::vector<Wall> walls;
  for (int i = 1; i <= solids_of_faces.Extent(); ++i) {
    try {
      OCC_CATCH_SIGNALS
      const TopoDS_Face& face = TopoDS::Face(solids_of_faces.FindKey(i));
      std::optional<Wall> wall =
          wall_of(face, !solids_of_faces(i).IsEmpty(), tolerance * millimetres_per_metre);
      if (!wall) continue;
      wall->face = i;
      if (is_rectangular(face, bounds_of(face)))
        walls.push_back(*wall);
      else if (!wall->is_bore && wall->turn > 2 * pi - 1e-3)
        found.remarks.push_back(refusal(i, *wall));
    } catch (const Standard_Failure&) {
      continue;  // a face that OpenCASCADE cannot evaluate has no section; its edges are reported
    }
  }
  walls = whole_walls(walls);
  find_bores_of_shells(walls);
  for (const Wall& wall : walls) {
    if (wall.is_bore) continue;
    try {
      OCC_CATCH_SIGNALS
      found.lines.push_back(centre_line(wall, walls, tolerance));
    } catch (const std::bad_alloc&) {
      throw;
    } catch (const std::exception& e) {
      found.remarks.push_back("face " + std::to_string(wall.face) + ": " + e.what());
    }
  }
  found.lines = in_running_order(found.lines);
  return found;
}

}  // namespace nurbeam
