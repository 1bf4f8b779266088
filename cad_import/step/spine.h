#pragma once
#include <Geom_BSplineCurve.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Wire.hxx>
#include <optional>
#include <string>
#include <vector>

#include "cad_import/report/named_curve.h"

namespace nurbeam {

/// The curve as OpenCASCADE's [mm].
opencascade::handle<Geom_BSplineCurve> bspline(const NurbsCurve& curve);

/// The curve as one edge [mm]. Throws std::runtime_error when OpenCASCADE makes none of it.
TopoDS_Edge edge(const NamedCurve& named);

/// A smooth piece of a curve, from corner to corner: its spans [m], each on [0, 1], straight ones in a row as
/// one.
struct Run {
  std::vector<NurbsCurve> spans;
  /// The tangent before the corner that it begins with, and after the one that it ends with.
  std::optional<Eigen::Vector3d> before = {}, after = {};

  Eigen::Vector3d start_direction() const { return spans.front().derivatives(0, 1).col(1).normalized(); }
  Eigen::Vector3d end_direction() const { return spans.back().derivatives(1, 1).col(1).normalized(); }
};

/// What a section is swept along; a closed curve that has a corner begins with one.
struct Spine {
  std::vector<Run> runs;
  bool closed;
};
Spine spine(const NurbsCurve& curve);

/// The straight span between two places.
NurbsCurve straight_span(const Eigen::Vector3d& from, const Eigen::Vector3d& to);

/// The run as a wire [mm], closed if it is `closed`, where it is made of lines and arcs of circles; else
/// null.
TopoDS_Wire wire_of_arcs(const Run& run, bool closed);

/// The first corner of the curve in words, "a corner of 12 degrees at (1, 2, 3) m"; nothing of a smooth one.
std::optional<std::string> corner_of(const NurbsCurve& curve);

}  // namespace nurbeam
