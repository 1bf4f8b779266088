#include "cad_import/step/swept_pipe.h"

#include <BRepCheck_Analyzer.hxx>
#include <BRepGProp.hxx>
#include <Eigen/Geometry>
#include <GProp_GProps.hxx>
#include <cmath>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string>

#include "cad_import/report/length_unit.h"
#include "cad_import/step/arc_pipe.h"
#include "cad_import/step/spine.h"
#include "cad_import/step/tube.h"
#include "nurbs/number_text.h"

namespace nurbeam {
namespace {

// OpenCASCADE does not always say that a sweep went wrong.
void check_pipe(const TopoDS_Shape& solid, const NamedPipe& pipe) {
  constexpr double allowed = 1e-6;
  GProp_GProps properties;
  BRepGProp::VolumeProperties(solid, properties);
  const double area = std::numbers::pi * (pipe.radius * pipe.radius - pipe.bore * pipe.bore);
  // Pappus: a section whose centroid is on the curve sweeps its area times the length.
  const double expected = area * length(pipe.axis.curve) * std::pow(millimetres_per_metre, 3);
  if (solid.ShapeType() == TopAbs_SOLID && BRepCheck_Analyzer(solid).IsValid() &&
      std::abs(properties.Mass() - expected) <= allowed * expected)
    return;
  const std::optional<std::string> corner = corner_of(pipe.axis.curve);
  throw std::runtime_error("OpenCASCADE sweeps no valid solid of radius " + text_of(pipe.radius) +
                           " m along the curve '" + pipe.axis.name + "'; it may run into itself" +
                           (corner ? ", and has " + *corner : ""));
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
  TopoDS_Shape solid;
  try {
    const Spine along = spine(curve);
    solid = arc_pipe(along, pipe.radius, pipe.bore);
    if (solid.IsNull()) solid = tube(along, pipe.radius, pipe.bore);
  } catch (const std::runtime_error& e) {
    throw std::runtime_error("the curve '" + pipe.axis.name + "': " + e.what());
  }
  check_pipe(solid, pipe);
  return solid;
}

}  // namespace nurbeam
