#pragma once
#include <cmath>
#include <vector>

#include "cad_import/report/import_report.h"
#include "tests/support/curves.h"

namespace nurbeam {

/// Closed outlines as the curves a CAD file would hold, [m].
using Outline = std::vector<NurbsCurve>;

inline Outline polygon(const std::vector<Eigen::Vector2d>& corners) {
  Outline outline;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Eigen::Vector2d a = corners[i], b = corners[(i + 1) % corners.size()];
    outline.push_back(line({a.x(), a.y(), 0}, {b.x(), b.y(), 0}));
  }
  return outline;
}

inline Outline rectangle(double width, double height, const Eigen::Vector2d& centre = {0, 0}) {
  const Eigen::Vector2d x(width / 2, 0), y(0, height / 2);
  return polygon({centre - x - y, centre + x - y, centre + x + y, centre - x + y});
}

/// The unit circle scaled along x and y and moved.
inline Outline ellipse(double a, double b, const Eigen::Vector2d& centre = {0, 0}) {
  Eigen::Matrix4Xd points = unit_circle().control_points();
  points.row(0) = a * points.row(0) + centre.x() * points.row(3);
  points.row(1) = b * points.row(1) + centre.y() * points.row(3);
  return {NurbsCurve(unit_circle().knots(), points)};
}

/// An I-section with a fillet of radius r between web and flanges, its web along y.
inline Outline i_section(double height, double width, double web, double flange, double r) {
  const double x = width / 2, y = height / 2, w = web / 2, inner = y - flange;
  Outline outline;
  // A quarter of a circle that touches both lines through its corner.
  const auto fillet = [&](Eigen::Vector2d from, Eigen::Vector2d corner, Eigen::Vector2d end) {
    Eigen::Matrix3Xd points = Eigen::Matrix3Xd::Zero(3, 3);
    points.topRows<2>() << from, corner, end;
    outline.push_back(
        make_nurbs_curve(KnotVector(2, {0, 0, 0, 1, 1, 1}), points, Eigen::Vector3d(1, std::sqrt(0.5), 1)));
  };
  const auto side = [&](Eigen::Vector2d a, Eigen::Vector2d b) {
    outline.push_back(line({a.x(), a.y(), 0}, {b.x(), b.y(), 0}));
  };
  side({-x, -y}, {x, -y});
  side({x, -y}, {x, -inner});
  side({x, -inner}, {w + r, -inner});
  fillet({w + r, -inner}, {w, -inner}, {w, -inner + r});
  side({w, -inner + r}, {w, inner - r});
  fillet({w, inner - r}, {w, inner}, {w + r, inner});
  side({w + r, inner}, {x, inner});
  side({x, inner}, {x, y});
  side({x, y}, {-x, y});
  side({-x, y}, {-x, inner});
  side({-x, inner}, {-w - r, inner});
  fillet({-w - r, inner}, {-w, inner}, {-w, inner - r});
  side({-w, inner - r}, {-w, -inner + r});
  fillet({-w, -inner + r}, {-w, -inner}, {-w - r, -inner});
  side({-w - r, -inner}, {-x, -inner});
  side({-x, -inner}, {-x, -y});
  return outline;
}

/// The curves of outlines as an import gives them, turned and moved.
inline std::vector<ImportedCurve> imported(const std::vector<Outline>& outlines,
                                           const Eigen::Matrix3d& rotation = Eigen::Matrix3d::Identity(),
                                           const Eigen::Vector3d& origin = Eigen::Vector3d::Zero()) {
  std::vector<ImportedCurve> curves;
  for (const Outline& outline : outlines)
    for (const NurbsCurve& curve : outline) {
      Eigen::Matrix4Xd points = curve.control_points();
      points.topRows<3>() = rotation * points.topRows<3>() + origin * points.row(3);
      curves.push_back({.entity = "bspline", .curve = NurbsCurve(curve.knots(), points)});
    }
  return curves;
}

}  // namespace nurbeam
