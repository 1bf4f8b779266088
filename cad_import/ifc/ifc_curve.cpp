#include "cad_import/ifc/ifc_curve.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <utility>

#include "cad_import/ifc/conic_curve.h"
#include "cad_import/ifc/ifc_alignment.h"
#include "nurbs/full_knots.h"

namespace nurbeam {
namespace {

using std::numbers::pi;
using Curves = std::vector<ImportedCurve>;

constexpr std::size_t deepest = 50;

ImportedCurve named(std::string kind, NurbsCurve curve) {
  return {.entity = std::move(kind), .curve = std::move(curve)};
}

NurbsCurve polyline(const std::vector<Eigen::Vector3d>& points) {
  if (points.size() < 2) throw std::runtime_error("it has fewer than two points");
  std::vector<double> knots{0};
  Eigen::Matrix3Xd columns(3, points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    columns.col(static_cast<Eigen::Index>(i)) = points[i];
    knots.push_back(static_cast<double>(i));
  }
  knots.push_back(knots.back());
  return make_nurbs_curve(KnotVector(1, std::move(knots)), columns, Eigen::VectorXd::Ones(columns.cols()));
}

/// From the first through the second to the third point; a line where they are on one.
NurbsCurve arc_through(const std::array<Eigen::Vector3d, 3>& p) {
  const Eigen::Vector3d a = p[1] - p[0], b = p[2] - p[0], normal = a.cross(b);
  constexpr double straight = 1e-12;
  if (!(normal.norm() > straight * a.norm() * b.norm())) return polyline({p[0], p[2]});
  const Eigen::Vector3d to_centre =
      (b.squaredNorm() * normal.cross(a) + a.squaredNorm() * b.cross(normal)) / (2 * normal.squaredNorm());
  Eigen::Affine3d place = Eigen::Affine3d::Identity();
  const Eigen::Vector3d x = -to_centre.normalized(), z = normal.normalized();
  place.linear() << x, z.cross(x), z;
  place.translation() = p[0] + to_centre;
  const Eigen::Vector3d end = place.inverse() * p[2];
  double angle = std::atan2(end.y(), end.x());
  if (angle <= 0) angle += 2 * pi;
  return conic_curve(Eigen::Vector2d::Constant(to_centre.norm()), 0, angle, place);
}

/// The same curve, its parameters from 0 to `span`.
NurbsCurve with_span(const NurbsCurve& curve, double span) {
  const double first = curve.knots().start(), last = curve.knots().end();
  std::vector<double> knots = curve.knots().knots();
  for (double& knot : knots) knot = knot == last ? span : (knot - first) / (last - first) * span;
  return {KnotVector(curve.degree(), std::move(knots)), curve.control_points()};
}

/// One of the two ends of a trimmed curve.
struct Trim {
  std::optional<double> parameter;
  std::optional<Eigen::Vector3d> point;
};

class Reader {
 public:
  Reader(const IfcModel& model, double tolerance) : model_(model), tolerance_(tolerance) {}

  Curves curves(int instance) const {
    constexpr int most_visited = 100'000;
    const bool is_within_itself = std::find(within_.begin(), within_.end(), instance) != within_.end();
    if (is_within_itself || within_.size() > deepest || ++visited_ > most_visited)
      throw std::runtime_error("it is nested too deeply, or made of itself: a circle of references");
    within_.push_back(instance);
    Curves found = curves_of(model_.instance(instance));
    within_.pop_back();
    return found;
  }
  Curves of_alignment(const Alignment& alignment) const {
    Curves curves;
    for (AlignmentCurve& part :
         alignment_curves(alignment.plan, alignment.grade, alignment.begin, tolerance_)) {
      const char* const kind = part.curve.degree() == 1   ? "line"
                               : part.curve.is_rational() ? "circle"
                                                          : "other";
      ImportedCurve curve = named(kind, std::move(part.curve));
      curve.deviation = part.deviation;
      curve.exact = curve.entity != "other";
      curves.push_back(std::move(curve));
    }
    return curves;
  }

 private:
  Curves curves_of(const IfcValue& given) const {
    const std::string& kind = given.text;
    if (kind == "IFCPOLYLINE") return {named("bspline", polyline(points_of(given.at(0))))};
    if (kind == "IFCINDEXEDPOLYCURVE") return indexed(given);
    if (kind == "IFCTRIMMEDCURVE") return {trimmed(given)};
    if (kind == "IFCCIRCLE" || kind == "IFCELLIPSE") return {conic(given, 0, 2 * pi)};
    if (kind.starts_with("IFCBSPLINECURVE") || kind.starts_with("IFCRATIONALBSPLINECURVE"))
      return spline(given);
    if (kind == "IFCALIGNMENTCURVE") return of_alignment(alignment_of_curve(model_, given));
    if (kind == "IFCGRADIENTCURVE" || kind == "IFCSEGMENTEDREFERENCECURVE")
      return of_alignment(alignment_of_composite(model_, given));
    if (kind == "IFCCOMPOSITECURVE" || kind == "IFCCOMPOSITECURVEONSURFACE" || kind == "IFC2DCOMPOSITECURVE")
      return composite(given);
    throw std::runtime_error(kind + " is not read");
  }

  std::vector<Eigen::Vector3d> points_of(const IfcValue& list) const {
    std::vector<Eigen::Vector3d> points;
    for (const IfcValue& point : list.items) points.push_back(ifc_point(model_, point));
    return points;
  }

  Curves indexed(const IfcValue& given) const {
    std::vector<Eigen::Vector3d> points;
    for (const IfcValue& coordinates : model_.at(given.at(0)).at(0).items)
      points.push_back(ifc_vector(coordinates));
    if (given.at(1).kind == IfcValue::Kind::none) return {named("bspline", polyline(points))};
    Curves curves;
    for (const IfcValue& segment : given.at(1).items) {
      std::vector<Eigen::Vector3d> chosen;
      for (const IfcValue& index : segment.at(0).items) {
        const double number = index.as_number();
        if (!(number >= 1 && number <= static_cast<double>(points.size())))
          throw std::runtime_error("it names a point that is not in its list");
        chosen.push_back(points[static_cast<std::size_t>(number) - 1]);
      }
      if (segment.text == "IFCARCINDEX" && chosen.size() == 3)
        curves.push_back(named("circle", with_span(arc_through({chosen[0], chosen[1], chosen[2]}), 1)));
      else
        curves.push_back(named(chosen.size() == 2 ? "line" : "bspline", polyline(chosen)));
    }
    return curves;
  }

  Eigen::Vector2d radii_of(const IfcValue& conic) const {
    const double x = conic.at(1).as_number(), y = conic.text == "IFCELLIPSE" ? conic.at(2).as_number() : x;
    if (!(x > 0 && y > 0)) throw std::runtime_error("its radius is not positive");
    return {x, y};
  }

  ImportedCurve conic(const IfcValue& given, double first, double last) const {
    return named(given.text == "IFCELLIPSE" ? "ellipse" : "circle",
                 with_span(conic_curve(radii_of(given), first, last, ifc_placement(model_, given.at(0))),
                           (last - first) / model_.angle_unit()));
  }

  Trim trim_of(const IfcValue& selection) const {
    Trim trim;
    for (const IfcValue& item : selection.items)
      if (item.is_reference())
        trim.point = ifc_point(model_, item);
      else
        trim.parameter = item.as_number();
    return trim;
  }

  ImportedCurve trimmed(const IfcValue& given) const {
    const IfcValue basis = model_.at(given.at(0));
    const bool by_points = given.at(4).text == "CARTESIAN", forward = given.at(3).text != "F";
    const Trim first = trim_of(given.at(1)), last = trim_of(given.at(2));
    ImportedCurve curve = basis.text == "IFCLINE" ? named("line", line_between(basis, first, last, by_points))
                                                  : arc_between(basis, first, last, by_points, forward);
    return curve;
  }

  NurbsCurve line_between(const IfcValue& line, const Trim& first, const Trim& last, bool by_points) const {
    const IfcValue vector = model_.at(line.at(1));
    const Eigen::Vector3d along =
        ifc_vector(model_.at(vector.at(0)).at(0)).normalized() * vector.at(1).as_number();
    const auto place = [&](const Trim& trim) -> Eigen::Vector3d {
      if (trim.point && (by_points || !trim.parameter)) return *trim.point;
      if (!trim.parameter) throw std::runtime_error("it is trimmed by nothing");
      return ifc_point(model_, line.at(0)) + *trim.parameter * along;
    };
    const Eigen::Vector3d begin = place(first), end = place(last);
    const double span = (end - begin).norm() / along.norm();
    return span > 0 ? with_span(polyline({begin, end}), span) : polyline({begin, end});
  }

  /// Against the sense of the conic it runs from the first to the last clockwise.
  ImportedCurve arc_between(const IfcValue& basis, const Trim& first, const Trim& last, bool by_points,
                            bool forward) const {
    if (basis.text != "IFCCIRCLE" && basis.text != "IFCELLIPSE")
      throw std::runtime_error("it is a piece of " + basis.text + ", which is not read");
    const Eigen::Vector2d radii = radii_of(basis);
    const Eigen::Affine3d to_own = ifc_placement(model_, basis.at(0)).inverse();
    const auto angle = [&](const Trim& trim) {
      if (trim.parameter && (!by_points || !trim.point)) return *trim.parameter * model_.angle_unit();
      if (!trim.point) throw std::runtime_error("it is trimmed by nothing");
      const Eigen::Vector3d own = to_own * *trim.point;
      return std::atan2(own.y() / radii.y(), own.x() / radii.x());
    };
    const double begin = forward ? angle(first) : angle(last);
    double end = forward ? angle(last) : angle(first);
    constexpr double one_place = 1e-12;
    if (!(end > begin + one_place && end <= begin + 2 * pi + one_place)) {
      const double turn = std::fmod(end - begin, 2 * pi);
      end = begin + (turn > one_place ? turn : turn + 2 * pi);
    }
    ImportedCurve curve = conic(basis, begin, end);
    if (!forward) curve.curve = curve.curve.reversed();
    return curve;
  }

  Curves spline(const IfcValue& given) const {
    const int degree = static_cast<int>(given.at(0).as_number());
    const std::vector<Eigen::Vector3d> places = points_of(given.at(1));
    const std::size_t count = places.size();
    if (degree < 1 || count < static_cast<std::size_t>(degree) + 1)
      throw std::runtime_error("it has too few control points for its degree");
    if (given.at(6).kind == IfcValue::Kind::none)
      throw std::runtime_error(given.text + " without knots is not read");
    std::vector<double> knots;
    for (std::size_t i = 0; i < given.at(5).items.size(); ++i) {
      const double times = given.at(5).at(i).as_number();
      if (!(times >= 1 && times <= degree + 1))
        throw std::runtime_error("a multiplicity of its knots is not allowed");
      knots.insert(knots.end(), static_cast<std::size_t>(times), given.at(6).at(i).as_number());
    }
    const std::vector<IfcValue>& weights = given.at(8).items;
    Eigen::Matrix4Xd points(4, count);
    for (std::size_t i = 0; i < count; ++i) {
      const double weight = weights.empty() ? 1 : given.at(8).at(i).as_number();
      points.col(static_cast<Eigen::Index>(i)) << weight * places[i], weight;
    }
    Curves curves;
    for (NurbsCurve& curve : split_at_full_knots(degree, knots, points))
      curves.push_back(named("bspline", std::move(curve)));
    return curves;
  }

  Curves composite(const IfcValue& given) const {
    const IfcValue& segments = given.at(0);
    if (!segments.items.empty() && model_.at(segments.items[0]).text == "IFCCURVESEGMENT")
      return of_alignment(alignment_of_composite(model_, given));
    Curves all;
    for (const IfcValue& reference : segments.items) {
      const IfcValue segment = model_.at(reference);
      if (!segment.at(2).is_reference()) throw std::runtime_error(segment.text + " is not read");
      Curves own = curves(segment.at(2).reference);
      if (segment.at(1).text == "F") {
        std::reverse(own.begin(), own.end());
        for (ImportedCurve& curve : own) curve.curve = curve.curve.reversed();
      }
      std::move(own.begin(), own.end(), std::back_inserter(all));
    }
    return all;
  }

  const IfcModel& model_;
  double tolerance_;
  mutable int visited_ = 0;
  mutable std::vector<int> within_;  // the curve that is read, and those that are made of it
};

}  // namespace

std::vector<ImportedCurve> ifc_curves(const IfcModel& model, int instance, double tolerance) {
  return Reader(model, tolerance).curves(instance);
}

std::vector<ImportedCurve> ifc_alignment(const IfcModel& model, int alignment, double tolerance) {
  return Reader(model, tolerance).of_alignment(alignment_of_segments(model, alignment));
}

bool is_ifc_curve(std::string_view keyword) {
  for (const std::string_view part :
       {"CURVE", "POLYLINE", "IFCLINE", "IFCCIRCLE", "IFCELLIPSE", "CLOTHOID", "SPIRAL"})
    if (keyword.find(part) != std::string_view::npos)
      return keyword.find("STYLE") == std::string_view::npos &&
             (keyword.find("SEGMENT") == std::string_view::npos || keyword.starts_with("IFCSEGMENTED")) &&
             keyword.find("SET") == std::string_view::npos && !keyword.ends_with("PROFILEDEF") &&
             !keyword.starts_with("IFCREL") && keyword.find("HOLLOW") == std::string_view::npos &&
             keyword.find("BOUNDED") == std::string_view::npos;
  return false;
}

}  // namespace nurbeam
