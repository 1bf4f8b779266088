#include "cad_import/occt/pipe_wall.h"

#include <BRepTools.hxx>
#include <BRep_Tool.hxx>
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
#include <TColgp_Array1OfPnt.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Wire.hxx>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "cad_import/occt/edge_curve.h"
#include "nurbs/bezier_path.h"

namespace nurbeam {
namespace {

constexpr int sections = 24, points_of_section = 16;
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

}  // namespace

Bounds bounds_of(const TopoDS_Face& face) {
  Bounds b{};
  BRepTools::UVBounds(face, b.u0, b.u1, b.v0, b.v1);
  return b;
}

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
  wall->in_solid = in_a_solid;
  wall->is_bore = in_a_solid && looks_inwards(face, *surface, b, *wall);
  return wall;
}

}  // namespace nurbeam
