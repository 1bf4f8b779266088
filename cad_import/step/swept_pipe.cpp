#include "cad_import/step/swept_pipe.h"

#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeSolid.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepCheck_Analyzer.hxx>
#include <BRepGProp.hxx>
#include <BRepOffsetAPI_MakePipe.hxx>
#include <BRep_Tool.hxx>
#include <Eigen/Geometry>
#include <GProp_GProps.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Shell.hxx>
#include <TopoDS_Solid.hxx>
#include <TopoDS_Wire.hxx>
#include <cmath>
#include <gp_Ax2.hxx>
#include <gp_Circ.hxx>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string>

#include "cad_import/report/length_unit.h"
#include "cad_import/step/spine.h"
#include "nurbs/number_text.h"

namespace nurbeam {
namespace {

gp_Vec vector(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

// OpenCASCADE does not always say that a sweep went wrong.
void check_pipe(const TopoDS_Shape& solid, const NamedPipe& pipe) {
  const std::optional<std::string> corner = corner_of(pipe.axis.curve);
  const double allowed = corner ? 1e-3 : 1e-5;
  GProp_GProps properties;
  if (corner)  // the plain integration does not see it in the one face
    BRepGProp::VolumeProperties(solid, properties, 0.01 * allowed);
  else
    BRepGProp::VolumeProperties(solid, properties);
  const double area = std::numbers::pi * (pipe.radius * pipe.radius - pipe.bore * pipe.bore);
  // Pappus: a section whose centroid is on the curve sweeps its area times the length.
  const double expected = area * length(pipe.axis.curve) * std::pow(millimetres_per_metre, 3);
  if (solid.ShapeType() != TopAbs_SOLID || !BRepCheck_Analyzer(solid).IsValid() ||
      std::abs(properties.Mass() - expected) > allowed * expected)
    throw std::runtime_error("OpenCASCADE sweeps no valid solid of radius " + text_of(pipe.radius) +
                             " m along the curve '" + pipe.axis.name + "'; it " +
                             (corner ? "has " + *corner : "may run into itself, or be a ring in space"));
}

// Largest curvature |r' x r''| / |r'|^3 at 33 places of each span [1/m].
double largest_curvature(const NurbsCurve& curve) {
  constexpr int count = 32;
  const std::vector<double> breaks = curve.knots().breaks();
  double largest = 0;
  for (std::size_t j = 0; j + 1 < breaks.size(); ++j)
    for (int i = 0; i <= count; ++i) {
      const double u = breaks[j] + (breaks[j + 1] - breaks[j]) * i / count;
      const Eigen::Matrix3Xd d = curve.derivatives(u, 2);
      const Eigen::Vector3d first = d.col(1), second = d.col(2);
      largest = std::max(largest, first.cross(second).norm() / std::pow(first.norm(), 3));
    }
  return largest;
}

}  // namespace

TopoDS_Shape swept_pipe(const NamedPipe& pipe) {
  const NurbsCurve& curve = pipe.axis.curve;
  if (const double curvature = largest_curvature(curve); curvature * pipe.radius >= 1)
    throw std::runtime_error("the curve '" + pipe.axis.name + "' bends to a radius of " +
                             text_of(1 / curvature) + " m, too sharply for a section of radius " +
                             text_of(pipe.radius) + " m");
  const Eigen::Matrix3Xd start = curve.derivatives(curve.knots().start(), 1);
  const gp_Pnt centre(vector(millimetres_per_metre * start.col(0)).XYZ());
  const gp_Ax2 square(centre, gp_Dir(vector(start.col(1))));
  const auto rim = [&](double radius) {
    const gp_Circ circle(square, radius * millimetres_per_metre);
    return BRepBuilderAPI_MakeWire(BRepBuilderAPI_MakeEdge(circle).Edge()).Wire();
  };
  const TopoDS_Wire along = spine(pipe.axis.curve);
  BRepBuilderAPI_MakeFace section(rim(pipe.radius));
  const bool hollow = pipe.bore > 0, ring = BRep_Tool::IsClosed(along);
  if (hollow && !ring) section.Add(TopoDS::Wire(rim(pipe.bore).Reversed()));
  TopoDS_Shape solid = BRepOffsetAPI_MakePipe(along, section.Face()).Shape();
  if (hollow && ring) {  // without ends inner and outer faces are no one shell
    const TopoDS_Face bore = BRepBuilderAPI_MakeFace(rim(pipe.bore)).Face();
    const TopExp_Explorer core(BRepOffsetAPI_MakePipe(along, bore).Shape(), TopAbs_SHELL);
    BRepBuilderAPI_MakeSolid with_core(TopoDS::Solid(solid));
    with_core.Add(TopoDS::Shell(core.Current().Reversed()));
    solid = with_core.Solid();
  }
  check_pipe(solid, pipe);
  return solid;
}

}  // namespace nurbeam
