#include "pipelines/section/section_profile.h"

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <iomanip>
#include <numbers>
#include <ostream>

#include "nurbs/area_moments.h"
#include "nurbs/curve_chain.h"
#include "nurbs/number_text.h"
#include "pipelines/section/cgal_geometry.h"
#include "pipelines/section/profile_polygon.h"
#include "pipelines/section/torsion_constant.h"

namespace nurbeam {

namespace {

// Ends nearer than this part of the profile's size meet, and points nearer to the plane lie in it.
constexpr double relative_gap = 1e-6;

/// A profile cannot be made of the curves: why.
struct Refusal {
  std::string message;
};

std::string named(const std::vector<ImportedCurve>& curves, int i) {
  return "curve " + std::to_string(i + 1) + (curves[i].name.empty() ? "" : " \"" + curves[i].name + "\"");
}

/// Why a chain is not closed: at its last end.
[[noreturn]] void refuse_open(const std::vector<ImportedCurve>& curves, const Chain& chain, double gap) {
  const int last = chain.curves.back();
  const bool at_start = chain.reversed.back();
  const auto end_point = [&](int i, bool start) {
    const NurbsCurve& curve = curves[i].curve;
    return curve.point(start ? curve.knots().start() : curve.knots().end());
  };
  const Eigen::Vector3d end = end_point(last, at_start);
  double nearest = INFINITY;
  Eigen::Vector3d nearest_point = end;
  for (int i = 0; i < static_cast<int>(curves.size()); ++i)
    for (const bool start : {true, false}) {
      if (i == last && start == at_start) continue;
      const Eigen::Vector3d point = end_point(i, start);
      if ((point - end).norm() >= nearest) continue;
      nearest = (point - end).norm();
      nearest_point = point;
    }
  const std::string place = named(curves, last) + " ends at " + text_of(end);
  if (nearest <= gap)
    throw Refusal{place +
                  ", where more than two ends meet; a profile is made of closed outlines that do not "
                  "touch: remove the curves that do not belong to it"};
  throw Refusal{place + ", " + text_of(nearest) + " m from the nearest other end, " + text_of(nearest_point) +
                "; a profile is closed (gaps up to " + text_of(gap) + " m are)"};
}

std::vector<Loop> closed_paths(const std::vector<ImportedCurve>& imported) {
  std::vector<NurbsCurve> curves;
  double size = 0;
  for (const ImportedCurve& curve : imported) {
    curves.push_back(curve.curve);
    size = std::max(size, length(curve.curve));
  }
  if (curves.empty()) throw Refusal{"has no curves; a profile is made of closed outlines"};
  const double gap = relative_gap * size;
  std::vector<Loop> paths;
  for (const Chain& chain : find_chains(curves, gap)) {
    const bool one_closed = chain.curves.size() == 1 && is_closed(curves[chain.curves[0]], gap);
    if (!chain.closed && !one_closed) refuse_open(imported, chain, gap);
    paths.push_back(join(curves, chain, 1e-9 * size).segments);
  }
  return paths;
}

/// Coordinates of a profile's plane: point = origin + x x_axis + y y_axis.
struct Plane {
  Eigen::Vector3d origin, x_axis, y_axis;

  Eigen::Vector3d to_file(const Eigen::Vector2d& p) const { return origin + p.x() * x_axis + p.y() * y_axis; }
};

Plane plane_of(const std::vector<Loop>& paths) {
  std::vector<Eigen::Vector3d> points;
  for (const Loop& path : paths)
    for (const RationalCubic& cubic : path)
      for (int i = 0; i < 4; ++i) points.push_back(cubic.control_point(i));
  Eigen::Vector3d low = points[0], high = points[0], sum = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& p : points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
    sum += p;
  }
  Plane plane;
  plane.origin = sum / static_cast<double>(points.size());
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3d& p : points) spread += (p - plane.origin) * (p - plane.origin).transpose();
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(spread, Eigen::ComputeFullU);
  Eigen::Vector3d normal = svd.matrixU().col(2);
  for (int i = 0; i < 3; ++i)
    if (std::abs(normal[i]) < 1e-9) normal[i] = 0;  // round-off in a plane of two axes
  normal.normalize();
  for (const Eigen::Vector3d& p : points)
    if (const double off = std::abs((p - plane.origin).dot(normal)); off > relative_gap * (high - low).norm())
      throw Refusal{"is not planar: " + text_of(p) + " is " + text_of(off) +
                    " m from the plane of the other points; draw the profile in one plane, or export the "
                    "one face of it"};
  const Eigen::Vector3d up =
      normal.cwiseAbs().head<2>().maxCoeff() == 0 ? Eigen::Vector3d::UnitY() : Eigen::Vector3d::UnitZ();
  plane.y_axis = (up - up.dot(normal) * normal).normalized();
  plane.x_axis = plane.y_axis.cross(normal);
  int largest;
  plane.x_axis.cwiseAbs().maxCoeff(&largest);
  if (plane.x_axis[largest] < 0) plane.x_axis = -plane.x_axis;
  return plane;
}

Loop in_plane(const Loop& path, const Plane& plane) {
  Loop flat;
  for (const RationalCubic& cubic : path) {
    Eigen::Matrix4d points;
    for (int i = 0; i < 4; ++i) {
      const Eigen::Vector3d offset = cubic.control_point(i) - plane.origin;
      points.col(i) << cubic.weight(i) * offset.dot(plane.x_axis), cubic.weight(i) * offset.dot(plane.y_axis),
          0, cubic.weight(i);
    }
    flat.emplace_back(points);
  }
  return flat;
}

Loop reversed(const Loop& path) {
  Loop backwards;
  for (auto segment = path.rbegin(); segment != path.rend(); ++segment)
    backwards.push_back(segment->reversed());
  return backwards;
}

/// The outline first, anticlockwise; then the holes, clockwise.
std::vector<Loop> ordered(std::vector<Loop> paths, const Plane& plane) {
  const std::vector<ProfilePolygon> polygons = polygons_without_crossing(paths);
  if (polygons.empty()) {
    const auto where = crossing(profile_polygons(paths, 0.01));
    throw Refusal{"crosses or touches itself" +
                  (where ? " near " + text_of(plane.to_file(*where)) : std::string()) +
                  "; outlines must lie apart and run through no place twice"};
  }
  std::vector<Loop> outlines, holes;
  for (std::size_t i = 0; i < paths.size(); ++i) {
    int around = 0;
    for (std::size_t j = 0; j < paths.size(); ++j)
      around += j != i && polygons[j].contains(polygons[i].corners[0]) ? 1 : 0;
    const bool outline = around % 2 == 0, anticlockwise = polygons[i].area() > 0;
    (outline ? outlines : holes).push_back(outline == anticlockwise ? paths[i] : reversed(paths[i]));
  }
  if (outlines.size() > 1)
    throw Refusal{"has " + std::to_string(outlines.size()) +
                  " outlines beside or inside each other; a section is one piece: an outline with holes"};
  outlines.insert(outlines.end(), holes.begin(), holes.end());
  return outlines;
}

SectionProfile profile_of(const std::vector<ImportedCurve>& curves) {
  std::vector<Loop> paths = closed_paths(curves);
  Plane plane = plane_of(paths);
  for (Loop& path : paths) path = in_plane(path, plane);
  SectionProfile profile;
  profile.loops = ordered(paths, plane);
  AreaMoments moments;
  // About the middle first, then about the centroid, where the second moments keep their digits.
  for (const Loop& loop : profile.loops) moments += area_moments(loop);
  const Eigen::Vector2d centroid = moments.first / moments.area;
  const Plane centred{{centroid.x(), centroid.y(), 0}, Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY()};
  moments = {};
  for (Loop& loop : profile.loops) {
    loop = in_plane(loop, centred);
    moments += area_moments(loop);
  }
  profile.centroid = plane.to_file(centroid);
  profile.x_axis = plane.x_axis;
  profile.y_axis = plane.y_axis;
  profile.area = moments.area;
  profile.second_x = moments.second(1, 1);
  profile.second_y = moments.second(0, 0);
  const double round_off = 1e-15 * moments.second.trace();
  profile.product = std::abs(moments.second(0, 1)) > round_off ? moments.second(0, 1) : 0;
  return profile;
}

double half_spread(const SectionProfile& p) { return std::hypot((p.second_x - p.second_y) / 2, p.product); }

}  // namespace

double SectionProfile::principal_1() const { return (second_x + second_y) / 2 + half_spread(*this); }
double SectionProfile::principal_2() const { return (second_x + second_y) / 2 - half_spread(*this); }
double SectionProfile::principal_angle() const {
  if (half_spread(*this) <= 1e-9 * principal_1()) return 0;
  // About an axis at angle a: I_x cos^2 a + I_y sin^2 a - I_xy sin 2a.
  return std::atan2(-2 * product, second_x - second_y) / 2;
}

ProfileReport section_profile(const std::vector<ImportedCurve>& curves, const std::string& where) {
  try {
    return {profile_of(curves), {}};
  } catch (const Refusal& refusal) {
    return {{}, {{Severity::error, where, refusal.message}}};
  } catch (const std::invalid_argument& problem) {
    return {{}, {{Severity::error, where, problem.what()}}};
  }
}

void print_profile(std::ostream& out, const SectionProfile& profile) {
  const auto shown = [](double value, double size) { return std::abs(value) < 1e-12 * size ? 0 : value; };
  const double size = std::sqrt(profile.area), angle = profile.principal_angle() * 180 / std::numbers::pi;
  const auto rounded = [&](const Eigen::Vector3d& v, double beside) -> Eigen::Vector3d {
    return v.unaryExpr([&](double each) { return shown(each, beside); });
  };
  const auto direction = [&](const Eigen::Vector3d& v) {
    const Eigen::Vector3d r = rounded(v, 1);
    return "(" + text_of(r.x()) + ", " + text_of(r.y()) + ", " + text_of(r.z()) + ")";
  };
  out << "  area              " << text_of(profile.area) << " m^2, outline and " << profile.loops.size() - 1
      << " hole(s)\n"
      << "  centroid          " << text_of(rounded(profile.centroid, std::max(size, profile.centroid.norm())))
      << "; x axis " << direction(profile.x_axis) << ", y axis " << direction(profile.y_axis) << '\n'
      << "  second moments    I_x " << text_of(profile.second_x) << ", I_y " << text_of(profile.second_y)
      << ", I_xy " << text_of(shown(profile.product, profile.principal_1())) << " m^4\n"
      << "  principal         I_1 " << text_of(profile.principal_1()) << ", I_2 "
      << text_of(profile.principal_2()) << " m^4, axis 1 at " << text_of(shown(angle, 1))
      << " degrees from x\n"
      << "  torsion constant  ";
  const TorsionReport torsion = torsion_constant(profile.loops);
  if (torsion.status == TorsionStatus::no_mesh)
    out << (has_cgal() ? "not computed: the profile is too thin or too finely curved for a mesh of "
                         "triangles\n"
                       : "not computed: this build is without CGAL (-DNURBEAM_WITH_CGAL=ON)\n");
  else
    out << text_of(torsion.value) << " m^4, within " << std::setprecision(2) << torsion.error << " m^4\n";
}

}  // namespace nurbeam
