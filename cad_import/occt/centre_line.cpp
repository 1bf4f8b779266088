#include "cad_import/occt/centre_line.h"

#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepTools.hxx>
#include <BRep_Tool.hxx>
#include <ElCLib.hxx>
#include <Geom2d_Curve.hxx>
#include <GeomAPI_PointsToBSpline.hxx>
#include <GeomAPI_ProjectPointOnCurve.hxx>
#include <GeomConvert.hxx>
#include <Geom_BSplineCurve.hxx>
#include <Geom_BSplineSurface.hxx>
#include <Geom_BezierSurface.hxx>
#include <Geom_Circle.hxx>
#include <Geom_CylindricalSurface.hxx>
#include <Geom_Line.hxx>
#include <Geom_RectangularTrimmedSurface.hxx>
#include <Geom_SurfaceOfLinearExtrusion.hxx>
#include <Geom_SurfaceOfRevolution.hxx>
#include <Geom_ToroidalSurface.hxx>
#include <Standard_ErrorHandler.hxx>
#include <Standard_Failure.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColgp_Array1OfPnt.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedDataMapOfShapeListOfShape.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Wire.hxx>
#include <algorithm>
#include <array>
#include <cmath>
#include <new>
#include <numbers>
#include <optional>
#include <stdexcept>

#include "cad_import/occt/edge_curve.h"
#include "nurbs/bezier_path.h"

namespace nurbeam {
namespace {

using std::numbers::pi;

constexpr double millimetres_per_metre = 1000;
constexpr int sections = 24, points_of_section = 16;
// A section is no circle, or none at right angles, when it differs by more than this part of the radius.
constexpr double worst_deviation = 1e-3;
// Two radii, and two centre lines, are the same within this part of the radius (or the deviation of either).
constexpr double same_within = 1e-6;

/// A piece of a pipe's wall: one face, [mm].
struct Wall {
  Handle(Geom_Curve) centre;
  double first = 0, last = 0;
  double radius = 0;
  double turn = 0;       // angle about the centre line [rad]
  double deviation = 0;  // of the wall from the pipe of this centre line and radius
  bool is_bore = false;
  int face = 0;

  gp_Pnt start() const { return centre->Value(first); }
  gp_Pnt middle() const { return centre->Value((first + last) / 2); }
  gp_Pnt end() const { return centre->Value(last); }
};

/// The rectangle of the parameters of a face.
struct Bounds {
  double u0, u1, v0, v1;
};

Bounds bounds_of(const TopoDS_Face& face) {
  Bounds b{};
  BRepTools::UVBounds(face, b.u0, b.u1, b.v0, b.v1);
  return b;
}

// Whether the outline runs along lines of constant parameters only.
bool is_rectangular(const TopoDS_Face& face, const Bounds& bounds) {
  constexpr double straight_within = 1e-4;  // of the face's own extent
  constexpr int samples = 5;
  for (TopExp_Explorer edges(BRepTools::OuterWire(face), TopAbs_EDGE); edges.More(); edges.Next()) {
    double first = 0, last = 0;
    const Handle(Geom2d_Curve) curve =
        BRep_Tool::CurveOnSurface(TopoDS::Edge(edges.Current()), face, first, last);
    if (curve.IsNull()) return false;
    double u_low = 1e300, u_high = -1e300, v_low = 1e300, v_high = -1e300;
    for (int i = 0; i < samples; ++i) {
      const gp_Pnt2d p = curve->Value(first + (last - first) * i / (samples - 1));
      u_low = std::min(u_low, p.X());
      u_high = std::max(u_high, p.X());
      v_low = std::min(v_low, p.Y());
      v_high = std::max(v_high, p.Y());
    }
    const bool along_v = u_high - u_low <= straight_within * (bounds.u1 - bounds.u0);
    const bool along_u = v_high - v_low <= straight_within * (bounds.v1 - bounds.v0);
    if (!along_u && !along_v) return false;
  }
  return true;
}

Wall cylinder_wall(const Geom_CylindricalSurface& surface, const Bounds& b) {
  return {.centre = new Geom_Line(surface.Axis()),
          .first = b.v0,
          .last = b.v1,
          .radius = surface.Radius(),
          .turn = b.u1 - b.u0};
}

Wall torus_wall(const Geom_ToroidalSurface& surface, const Bounds& b) {
  return {.centre = new Geom_Circle(gp_Ax2(surface.Position().Ax2()), surface.MajorRadius()),
          .first = b.u0,
          .last = b.u1,
          .radius = surface.MinorRadius(),
          .turn = b.v1 - b.v0};
}

// -------------------------------------------------------------------------------------------------------
// B-spline surfaces, with sections along u

double between(double a, double b, int i, int count) { return a + (b - a) * i / count; }

/// A circle through three points, its centre as their affine combination.
struct Circle {
  gp_Pnt centre;
  double radius;
  std::array<double, 3> parts;
};

std::optional<Circle> circle_through(const std::array<gp_Pnt, 3>& p) {
  // Barycentric coordinates of the circumcentre: a² (b² + c² - a²), ... with the sides' squares.
  const double a = p[1].SquareDistance(p[2]), b = p[2].SquareDistance(p[0]), c = p[0].SquareDistance(p[1]);
  std::array<double, 3> parts{a * (b + c - a), b * (c + a - b), c * (a + b - c)};
  const double sum = parts[0] + parts[1] + parts[2];  // 16 times the square of the area
  const double longest = std::max({a, b, c});
  if (!(sum > 1e-6 * longest * longest)) return {};
  gp_XYZ centre(0, 0, 0);
  for (int i = 0; i < 3; ++i) {
    parts[i] /= sum;
    centre += parts[i] * p[i].XYZ();
  }
  return Circle{gp_Pnt(centre), gp_Pnt(centre).Distance(p[0]), parts};
}

std::array<double, 3> thirds(const Geom_BSplineSurface& surface, double& u0, double& u1, double& v0,
                             double& v1) {
  surface.Bounds(u0, u1, v0, v1);
  return {u0, between(u0, u1, 1, 3), between(u0, u1, 2, 3)};
}

std::optional<Circle> section_at(const Geom_BSplineSurface& surface, double v) {
  double u0, u1, v0, v1;
  std::array<gp_Pnt, 3> points;
  const std::array<double, 3> u = thirds(surface, u0, u1, v0, v1);
  for (int i = 0; i < 3; ++i) points[i] = surface.Value(u[i], v);
  return circle_through(points);
}

// The affine combination of three isoparametric curves; nothing where their weights are not proportional.
Handle(Geom_BSplineCurve)
    combination(const Geom_BSplineSurface& surface, const std::array<double, 3>& parts) {
  double u0, u1, v0, v1;
  const std::array<double, 3> u = thirds(surface, u0, u1, v0, v1);
  std::array<Handle(Geom_BSplineCurve), 3> curves;
  for (int i = 0; i < 3; ++i) curves[i] = Handle(Geom_BSplineCurve)::DownCast(surface.UIso(u[i]));
  const Handle(Geom_BSplineCurve) centre = Handle(Geom_BSplineCurve)::DownCast(curves[0]->Copy());
  for (int k = 1; k <= centre->NbPoles(); ++k) {
    gp_XYZ pole(0, 0, 0);
    for (int i = 0; i < 3; ++i) {
      pole += parts[i] * curves[i]->Pole(k).XYZ();
      const double ratio = curves[i]->Weight(k) / curves[i]->Weight(1);
      if (std::abs(ratio - curves[0]->Weight(k) / curves[0]->Weight(1)) > 1e-9 * ratio) return {};
    }
    centre->SetPole(k, gp_Pnt(pole));
  }
  return centre;
}

// A cubic through the centres of the sections.
Handle(Geom_BSplineCurve) fitted(const Geom_BSplineSurface& surface, double tolerance) {
  double u0, u1, v0, v1;
  surface.Bounds(u0, u1, v0, v1);
  constexpr int count = 200;
  TColgp_Array1OfPnt centres(0, count);
  for (int i = 0; i <= count; ++i) {
    const std::optional<Circle> section = section_at(surface, between(v0, v1, i, count));
    if (!section) return {};
    centres(i) = section->centre;
  }
  const GeomAPI_PointsToBSpline fit(centres, 3, 3, GeomAbs_C2, tolerance);
  return fit.IsDone() ? fit.Curve() : Handle(Geom_BSplineCurve)();
}

// The largest difference of the distances between the surface and the curve from the radius; the curve is
// either at the same parameter or wherever it is nearest.
double deviation_from_pipe(const Geom_BSplineSurface& surface, const Handle(Geom_BSplineCurve) & centre,
                           double radius, bool same_parameter) {
  double u0, u1, v0, v1;
  surface.Bounds(u0, u1, v0, v1);
  double deviation = 0;
  for (int j = 0; j <= sections; ++j)
    for (int i = 0; i < points_of_section; ++i) {
      const double v = between(v0, v1, j, sections);
      const gp_Pnt p = surface.Value(between(u0, u1, i, points_of_section), v);
      double distance = 0, off_plane = 0;
      if (same_parameter) {
        gp_Pnt c;
        gp_Vec tangent;
        centre->D1(v, c, tangent);
        distance = p.Distance(c);
        off_plane = tangent.Magnitude() > 0 ? gp_Vec(c, p).Dot(tangent.Normalized()) : radius;
      } else {
        // From the end sections there need not be a perpendicular.
        distance = std::min(p.Distance(centre->StartPoint()), p.Distance(centre->EndPoint()));
        const GeomAPI_ProjectPointOnCurve nearest(p, centre);
        if (nearest.NbPoints() > 0) distance = std::min(distance, nearest.LowerDistance());
      }
      deviation = std::max({deviation, std::abs(distance - radius), std::abs(off_plane)});
    }
  return deviation;
}

double turn_about(const Geom_BSplineSurface& surface, const gp_Pnt& centre, double v) {
  double u0, u1, v0, v1;
  surface.Bounds(u0, u1, v0, v1);
  constexpr int steps = 64;
  double turn = 0;
  for (int i = 0; i < steps; ++i) {
    const gp_Vec a(centre, surface.Value(between(u0, u1, i, steps), v));
    const gp_Vec b(centre, surface.Value(between(u0, u1, i + 1, steps), v));
    turn += a.Angle(b);
  }
  return turn;
}

std::optional<Wall> spline_wall(const Geom_BSplineSurface& surface, double tolerance) {
  double u0, u1, v0, v1;
  surface.Bounds(u0, u1, v0, v1);
  const double middle = (v0 + v1) / 2;
  const std::optional<Circle> section = section_at(surface, middle);
  if (!section) return {};
  const double radius = section->radius;
  Handle(Geom_BSplineCurve) centre = combination(surface, section->parts);
  double deviation =
      centre.IsNull() ? radius : deviation_from_pipe(surface, centre, radius, /*same_parameter=*/true);
  if (deviation > worst_deviation * radius) {
    centre = fitted(surface, tolerance);
    if (centre.IsNull()) return {};
    deviation = deviation_from_pipe(surface, centre, radius, /*same_parameter=*/false);
  }
  if (deviation > worst_deviation * radius) return {};
  return Wall{.centre = centre,
              .first = centre->FirstParameter(),
              .last = centre->LastParameter(),
              .radius = radius,
              .turn = turn_about(surface, section->centre, middle),
              .deviation = deviation};
}

bool is_sweep(const Handle(Geom_Surface) & surface) {
  return surface->IsKind(STANDARD_TYPE(Geom_BSplineSurface)) ||
         surface->IsKind(STANDARD_TYPE(Geom_BezierSurface)) ||
         surface->IsKind(STANDARD_TYPE(Geom_SurfaceOfLinearExtrusion)) ||
         surface->IsKind(STANDARD_TYPE(Geom_SurfaceOfRevolution));
}

std::optional<Wall> sweep_wall(const Handle(Geom_Surface) & surface, const Bounds& b, double tolerance) {
  const Handle(Geom_Surface) trimmed = new Geom_RectangularTrimmedSurface(surface, b.u0, b.u1, b.v0, b.v1);
  const Handle(Geom_BSplineSurface) spline = GeomConvert::SurfaceToBSplineSurface(trimmed);
  if (spline.IsNull()) return {};
  if (const auto wall = spline_wall(*spline, tolerance)) return wall;
  spline->ExchangeUV();
  return spline_wall(*spline, tolerance);
}

// -------------------------------------------------------------------------------------------------------
// faces

Handle(Geom_Surface) surface_of(const TopoDS_Face& face) {
  Handle(Geom_Surface) surface = BRep_Tool::Surface(face);
  while (const auto trimmed = Handle(Geom_RectangularTrimmedSurface)::DownCast(surface))
    surface = trimmed->BasisSurface();
  return surface;
}

// Whether the outer side of the face looks towards the centre line.
bool looks_inwards(const TopoDS_Face& face, const Geom_Surface& surface, const Bounds& b, const Wall& wall) {
  gp_Pnt point;
  gp_Vec along_u, along_v;
  surface.D1((b.u0 + b.u1) / 2, (b.v0 + b.v1) / 2, point, along_u, along_v);
  gp_Vec normal = along_u.Crossed(along_v);
  if (face.Orientation() == TopAbs_REVERSED) normal.Reverse();
  const GeomAPI_ProjectPointOnCurve nearest(point, wall.centre);
  return nearest.NbPoints() > 0 && normal.Dot(gp_Vec(nearest.NearestPoint(), point)) < 0;
}

/// The wall that a face is; no radius where it is none.
std::optional<Wall> wall_of(const TopoDS_Face& face, bool in_a_solid, double tolerance) {
  const Handle(Geom_Surface) surface = surface_of(face);
  if (surface.IsNull()) return {};
  const Bounds b = bounds_of(face);
  std::optional<Wall> wall;
  if (const auto cylinder = Handle(Geom_CylindricalSurface)::DownCast(surface))
    wall = cylinder_wall(*cylinder, b);
  if (const auto torus = Handle(Geom_ToroidalSurface)::DownCast(surface)) wall = torus_wall(*torus, b);
  if (is_sweep(surface)) wall = sweep_wall(surface, b, tolerance);
  if (!wall || !(wall->last > wall->first)) return {};
  wall->is_bore = in_a_solid && looks_inwards(face, *surface, b, *wall);
  return wall;
}

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
      curve.bore_radius = bore.radius / millimetres_per_metre;
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
  return "face " + std::to_string(face) + " has a circular section of radius " + std::to_string(wall.radius) +
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
