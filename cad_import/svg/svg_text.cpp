#include "cad_import/svg/svg_text.h"

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <algorithm>
#include <array>
#include <stdexcept>

#include "nurbs/bezier.h"
#include "nurbs/number_text.h"

namespace nurbeam {
namespace {

constexpr double relative = 1e-6;  // of the size of all curves

Eigen::Matrix3Xd places_of(const std::vector<NamedCurve>& curves) {
  Eigen::Index count = 0;
  for (const NamedCurve& named : curves) count += named.curve.control_points().cols();
  Eigen::Matrix3Xd places(3, count);
  Eigen::Index at = 0;
  for (const NamedCurve& named : curves) {
    const Eigen::Matrix4Xd& points = named.curve.control_points();
    places.middleCols(at, points.cols()) = points.colwise().hnormalized();
    at += points.cols();
  }
  return places;
}

/// What goes to the right and what goes up.
struct Page {
  Eigen::Vector3d right, up;

  Eigen::Vector2d on(const Eigen::Vector3d& place) const {
    return {right.dot(place) + 0.0, 0.0 - up.dot(place)};
  }
};

Page page_of(const Eigen::Matrix3Xd& places) {
  const Eigen::Vector3d middle = places.rowwise().mean();
  const Eigen::Matrix3Xd offsets = places.colwise() - middle;
  const double size = offsets.colwise().norm().maxCoeff();
  const Page flat{Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY()};
  if (offsets.row(2).cwiseAbs().maxCoeff() <= relative * size) return flat;
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(offsets * offsets.transpose(), Eigen::ComputeFullU);
  const Eigen::Vector3d normal = svd.matrixU().col(2);
  if (const double off = (normal.transpose() * offsets).cwiseAbs().maxCoeff(); off > relative * size)
    throw std::runtime_error("the curves lie in no plane: they are up to " + text_of(off) +
                             " m off the nearest one, and SVG is flat; write them to another format, or "
                             "choose curves of one plane");
  const Eigen::Vector3d up = (Eigen::Vector3d::UnitZ() - normal.z() * normal).normalized();
  return {up.cross(normal), up};
}

/// Cubic Bezier points without weights, in the plane of the page.
using FlatCubic = Eigen::Matrix<double, 2, 4>;

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text)
    if (c == '<')
      result += "&lt;";
    else if (c == '&')
      result += "&amp;";
    else if (c == '"')
      result += "&quot;";
    else
      result += c;
  return result;
}

class SvgPaths {
 public:
  SvgPaths(const Page& page, double per_metre, double tolerance)
      : page_(page), per_metre_(per_metre), tolerance_(tolerance) {}

  void add(const NamedCurve& named) {
    const KnotVector& knots = named.curve.knots();
    const std::vector<double> breaks = knots.breaks();
    path_ = "M" + text(named.curve.point(knots.start()));
    for (std::size_t i = 0; i + 1 < breaks.size(); ++i)
      add_piece(named.curve.bezier_points(knots.find_span(breaks[i])));
    const std::string title = named.name.empty() ? "" : "<title>" + escaped(named.name) + "</title>";
    const std::string stroke = is_colour(named.colour) ? " stroke=\"" + named.colour + "\"" : "";
    text_ += "<path d=\"" + path_ + "\"" + stroke + ">" + title + "</path>\n";
  }
  const std::string& text() const { return text_; }
  const Eigen::AlignedBox2d& box() const { return box_; }

 private:
  std::string text(const Eigen::Vector3d& place) {
    constexpr int digits = 12;
    const Eigen::Vector2d p = per_metre_ * page_.on(place);
    box_.extend(p);
    return text_of(p.x(), digits) + "," + text_of(p.y(), digits);
  }

  void add_piece(const BezierPoints& points) {
    const Eigen::RowVectorXd weights = points.row(3);
    const bool rational = weights.maxCoeff() - weights.minCoeff() > 1e-14 * weights.maxCoeff();
    if (rational || points.cols() > 4) return add_cubics(points, 20);
    constexpr std::array<const char*, 5> commands{"", "", " L", " Q", " C"};
    path_ += commands[static_cast<std::size_t>(points.cols())];
    for (Eigen::Index i = 1; i < points.cols(); ++i)
      path_ += (i > 1 ? " " : "") + text(points.col(i).hnormalized());
  }

  /// In halves until they lie within the tolerance.
  void add_cubics(const BezierPoints& points, int halvings) {
    const Eigen::Matrix4Xd cubic = cubic_of(points);
    if (halvings > 0 && !(farthest(points, cubic) <= tolerance_)) {
      const auto [first, second] = halves(points);
      add_cubics(first, halvings - 1);
      add_cubics(second, halvings - 1);
      return;
    }
    path_ += " C";
    for (Eigen::Index i = 1; i < 4; ++i) path_ += (i > 1 ? " " : "") + text(cubic.col(i).head<3>());
  }

  /// With the ends and the end derivatives of the piece.
  static Eigen::Matrix4Xd cubic_of(const BezierPoints& points) {
    const Eigen::Index p = points.cols() - 1;
    const Eigen::Matrix3Xd places = points.colwise().hnormalized();
    const double third = static_cast<double>(p) / 3;
    Eigen::Matrix4Xd cubic = Eigen::Matrix4Xd::Ones(4, 4);
    cubic.col(0).head<3>() = places.col(0);
    cubic.col(1).head<3>() =
        places.col(0) + third * points(3, 1) / points(3, 0) * (places.col(1) - places.col(0));
    cubic.col(2).head<3>() =
        places.col(p) - third * points(3, p - 1) / points(3, p) * (places.col(p) - places.col(p - 1));
    cubic.col(3).head<3>() = places.col(p);
    return cubic;
  }

  static Eigen::Vector3d point_of(BezierPoints points, double u) {
    for (Eigen::Index last = points.cols() - 1; last > 0; --last)
      for (Eigen::Index i = 0; i < last; ++i) points.col(i) = (1 - u) * points.col(i) + u * points.col(i + 1);
    return points.col(0).hnormalized();
  }

  /// At places where both have one parameter.
  static double farthest(const BezierPoints& points, const Eigen::Matrix4Xd& cubic) {
    constexpr int count = 16;
    double distance = 0;
    for (int i = 1; i < count; ++i) {
      const double u = static_cast<double>(i) / count;
      distance = std::max(distance, (point_of(points, u) - point_of(cubic, u)).norm());
    }
    return distance;
  }

  const Page page_;
  const double per_metre_, tolerance_;
  std::string path_, text_;
  Eigen::AlignedBox2d box_;
};

}  // namespace

bool is_exact_in_svg(const NurbsCurve& curve) { return !curve.is_rational() && curve.degree() <= 3; }

std::string svg_text(const std::vector<NamedCurve>& curves, LengthUnit unit) {
  const Eigen::Matrix3Xd places = places_of(curves);
  const double size = (places.rowwise().maxCoeff() - places.rowwise().minCoeff()).norm();
  const double per_metre = 1 / metres_of(unit);
  const double line_width = 2e-3 * size * per_metre;
  SvgPaths paths(page_of(places), per_metre, relative * size);
  for (const NamedCurve& named : curves) paths.add(named);
  const Eigen::AlignedBox2d& box = paths.box();
  const Eigen::Vector2d low = box.min() - Eigen::Vector2d::Constant(line_width),
                        extent = box.sizes() + Eigen::Vector2d::Constant(2 * line_width);
  // SVG knows no metres.
  const double shown = unit == LengthUnit::metre ? 1000 : 1;
  const std::string suffix = unit == LengthUnit::inch ? "in" : "mm";
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\" version=\"1.1\" "
         "width=\"" +
         text_of(shown * extent.x()) + suffix + "\" height=\"" + text_of(shown * extent.y()) + suffix +
         "\" viewBox=\"" + text_of(low.x()) + " " + text_of(low.y()) + " " + text_of(extent.x()) + " " +
         text_of(extent.y()) + "\">\n<g fill=\"none\" stroke=\"black\" stroke-width=\"" +
         text_of(line_width) + "\">\n" + paths.text() + "</g>\n</svg>\n";
}

}  // namespace nurbeam
