#include "cad_import/ifc/plan_curve.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "cad_import/ifc/conic_curve.h"

namespace nurbeam {
namespace {

double heading_at(const PlanElement& element, double s) { return element.heading + element.turning.angle(s); }

Eigen::Vector2d direction(double heading) { return {std::cos(heading), std::sin(heading)}; }

/// The integral of the tangent from one place to another, by Gauss' rule of five points on short pieces.
Eigen::Vector2d run(const PlanElement& element, double from, double to) {
  constexpr std::array<double, 3> nodes{0, 0.5384693101056831, 0.9061798459386640};
  constexpr std::array<double, 3> weights{0.5688888888888889, 0.4786286704993665, 0.2369268850561891};
  constexpr double turn_of_piece = 0.1;  // [rad]
  constexpr double fewest = 2, most = 100'000;
  const int pieces = static_cast<int>(
      std::clamp(std::ceil(element.turning.sharpest * std::abs(to - from) / turn_of_piece), fewest, most));
  const double half = (to - from) / (2 * pieces);
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (int piece = 0; piece < pieces; ++piece) {
    const double middle = from + (2 * piece + 1) * half;
    for (std::size_t i = 0; i < nodes.size(); ++i)
      for (const double side : {1.0, -1.0})
        if (i > 0 || side > 0)
          sum += weights[i] * half * direction(heading_at(element, middle + side * nodes[i] * half));
  }
  return sum;
}

const GradeElement* grade_at(const std::vector<GradeElement>& grade, double distance) {
  const GradeElement* found = grade.empty() ? nullptr : &grade.front();
  for (const GradeElement& element : grade)
    if (element.start <= distance) found = &element;
  return found;
}

double height_at(const GradeElement* grade, double distance) {
  if (grade == nullptr) return 0;
  const double x = distance - grade->start;
  if (grade->radius == 0) return grade->height + x * (grade->slope + grade->bend * x);
  const double sine = grade->slope / std::hypot(1, grade->slope), there = sine + x / grade->radius;
  if (!(std::abs(there) < 1))
    throw std::runtime_error("an arc of its profile ends before the next element begins");
  return grade->height + grade->radius * (std::sqrt(1 - sine * sine) - std::sqrt(1 - there * there));
}

double slope_at(const GradeElement* grade, double distance) {
  if (grade == nullptr) return 0;
  const double x = distance - grade->start;
  if (grade->radius == 0) return grade->slope + 2 * grade->bend * x;
  const double sine = grade->slope / std::hypot(1, grade->slope) + x / grade->radius;
  return sine / std::sqrt(std::max(1 - sine * sine, 1e-12));
}

/// A part of an element of the plan under one element of the profile.
struct Part {
  const PlanElement* plan;
  const GradeElement* grade;
  double first, last;  // on the element
  double before;       // the distance along the plan where the element begins

  Eigen::Vector3d place(double s) const {
    Eigen::Vector3d result;
    result << plan->place(s), height_at(grade, before + s);
    return result;
  }
  Eigen::Vector3d tangent(double s) const {
    Eigen::Vector3d result;
    result << direction(heading_at(*plan, s)), slope_at(grade, before + s);
    return result;
  }
  bool is_straight() const { return plan->turning.even == 0.0 && is_even(); }
  bool is_level_arc() const { return plan->turning.even && is_even() && slope_at(grade, before) == 0; }
  bool is_even() const { return grade == nullptr || (grade->bend == 0 && grade->radius == 0); }
};

NurbsCurve line(const Part& part) {
  Eigen::Matrix3Xd ends(3, 2);
  ends << part.place(part.first), part.place(part.last);
  return make_nurbs_curve(KnotVector(1, {part.first, part.first, part.last, part.last}), ends,
                          Eigen::VectorXd::Ones(2));
}

NurbsCurve arc(const Part& part) {
  const double curvature = *part.plan->turning.even, heading = heading_at(*part.plan, part.first);
  const Eigen::Vector3d start = part.place(part.first), left(-std::sin(heading), std::cos(heading), 0);
  Eigen::Affine3d place = Eigen::Affine3d::Identity();
  place.translation() = start + left / curvature;
  const Eigen::Vector3d x = -left * (curvature > 0 ? 1 : -1);
  const Eigen::Vector3d z = Eigen::Vector3d::UnitZ() * (curvature > 0 ? 1 : -1);
  place.linear() << x, z.cross(x), z;
  const double radius = 1 / std::abs(curvature);
  return conic_curve({radius, radius}, 0, (part.last - part.first) / radius, place);
}

constexpr int samples = 8;  // of a cubic

/// The places at the ends of so many equal steps along a part, each reached from the one before it.
Eigen::Matrix3Xd places_of(const Part& part, int steps) {
  Eigen::Matrix3Xd places(3, steps + 1);
  places.col(0) = part.place(part.first);
  const double step = (part.last - part.first) / steps;
  for (int i = 1; i <= steps; ++i) {
    const double before = part.first + (i - 1) * step, here = part.first + i * step;
    places.col(i) << places.col(i - 1).head<2>() + run(*part.plan, before, here),
        height_at(part.grade, part.before + here);
  }
  return places;
}

/// The cubics through places and tangents at equal distances.
NurbsCurve cubics(const Part& part, const Eigen::Matrix3Xd& places) {
  const int count = static_cast<int>(places.cols() - 1) / samples;
  std::vector<double> knots(4, part.first);
  Eigen::Matrix3Xd points(3, 2 * count + 2);
  const double step = (part.last - part.first) / count;
  for (int i = 0; i <= count; ++i) {
    const double s = part.first + step * i;
    const Eigen::Vector3d place = places.col(samples * i), third = part.tangent(s) * step / 3;
    points.col(2 * i) = i == 0 ? place : Eigen::Vector3d(place - third);
    points.col(2 * i + 1) = i == count ? place : Eigen::Vector3d(place + third);
    if (i > 0 && i < count) knots.insert(knots.end(), 2, s);
  }
  knots.insert(knots.end(), 4, part.last);
  return make_nurbs_curve(KnotVector(3, knots), points, Eigen::VectorXd::Ones(points.cols()));
}

double deviation_of(const NurbsCurve& curve, const Part& part, const Eigen::Matrix3Xd& places) {
  double deviation = 0;
  for (Eigen::Index i = 1; i < places.cols(); i += 2) {
    const double s = part.first + (part.last - part.first) * static_cast<double>(i) /
                                      static_cast<double>(places.cols() - 1);
    deviation = std::max(deviation, (curve.point(s) - places.col(i)).norm());
  }
  return deviation;
}

AlignmentCurve curve_of(const Part& part, double tolerance) {
  if (part.is_straight()) return {line(part)};
  if (part.is_level_arc()) return {arc(part)};
  constexpr int most = 1024;
  const double digits = 1e-15 * part.plan->start.cwiseAbs().maxCoeff();  // of places far away
  for (int count = 2;; count *= 2) {
    const Eigen::Matrix3Xd places = places_of(part, samples * count);
    NurbsCurve curve = cubics(part, places);
    const double deviation = deviation_of(curve, part, places);
    if (deviation <= std::max(tolerance, digits) || count >= most) return {std::move(curve), deviation};
  }
}

/// Where other elements of the profile begin on an element of the plan.
std::vector<double> breaks_of(const PlanElement& element, const std::vector<GradeElement>& grade,
                              double before) {
  constexpr double least = 1e-9;  // of the length
  std::vector<double> breaks{0};
  for (const GradeElement& other : grade)
    if (const double s = other.start - before; s > least * element.length && s < (1 - least) * element.length)
      breaks.push_back(s);
  std::sort(breaks.begin(), breaks.end());
  breaks.push_back(element.length);
  return breaks;
}

}  // namespace

Eigen::Vector2d PlanElement::place(double s) const { return start + run(*this, 0, s); }

std::vector<AlignmentCurve> alignment_curves(const std::vector<PlanElement>& plan,
                                             const std::vector<GradeElement>& grade, double begin,
                                             double tolerance) {
  std::vector<AlignmentCurve> curves;
  double before = begin;
  for (const PlanElement& element : plan) {
    if (!(element.length >= 0 && std::isfinite(element.length)))
      throw std::runtime_error("the length of an element is none");
    constexpr double most_turn = 100;  // [rad]
    if (!(element.turning.sharpest * element.length <= most_turn))
      throw std::runtime_error("an element of it turns by more than 100 rad");
    if (element.length == 0) continue;  // the last of an alignment, which only tells its end
    const std::vector<double> breaks = breaks_of(element, grade, before);
    for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
      const GradeElement* under = grade_at(grade, before + (breaks[i] + breaks[i + 1]) / 2);
      curves.push_back(curve_of({&element, under, breaks[i], breaks[i + 1], before}, tolerance));
    }
    before += element.length;
  }
  return curves;
}

}  // namespace nurbeam
