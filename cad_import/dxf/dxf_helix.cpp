#include "cad_import/dxf/dxf_helix.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "cad_import/dxf/own_axes.h"
#include "nurbs/number_text.h"

namespace nurbeam {
namespace {

using std::numbers::pi;

struct Helix {
  Eigen::Vector3d foot;  ///< on the axis, beside the start
  Eigen::Matrix3d axes;  ///< towards the start, the way it turns there, along the axis
  double start_radius, end_radius, sweep, height;

  double radius(double angle) const { return start_radius + (end_radius - start_radius) * angle / sweep; }
  Eigen::Vector3d point(double angle) const {
    const double r = radius(angle);
    return foot + axes * Eigen::Vector3d(r * std::cos(angle), r * std::sin(angle), height * angle / sweep);
  }
  /// By the angle.
  Eigen::Vector3d slope(double angle) const {
    const double r = radius(angle), widening = (end_radius - start_radius) / sweep;
    const double c = std::cos(angle), s = std::sin(angle);
    return axes * Eigen::Vector3d(widening * c - r * s, widening * s + r * c, height / sweep);
  }
};

double needed(const DxfEntity& entity, int code, const char* what) {
  if (entity.numbers_of(code).empty())
    throw std::runtime_error("it has neither a spline nor " + std::string(what) + " (group " +
                             std::to_string(code) + ")");
  return entity.number_of(code, 0);
}

void check(const Helix& helix, double turns) {
  constexpr double most_turns = 10'000;
  if (!(turns > 0 && turns <= most_turns))
    throw std::runtime_error("it has " + text_of(turns) + " turns (group 41); they must be from 0 to " +
                             text_of(most_turns));
  if (!(helix.start_radius >= 0 && helix.end_radius >= 0 && helix.start_radius + helix.end_radius > 0))
    throw std::runtime_error("its radius is " + text_of(helix.end_radius) +
                             " (group 40); it must be positive, or that of its start (group 11)");
}

Helix helix_of(const DxfEntity& entity) {
  const Eigen::Vector3d base = point_at(entity, 10), start = point_at(entity, 11);
  const double turns = needed(entity, 41, "a number of turns");
  const Eigen::Vector3d axis = entity.numbers_of(12).empty() && entity.numbers_of(32).empty()
                                   ? Eigen::Vector3d::UnitZ()
                                   : point_at(entity, 12);
  if (!(axis.norm() > 0)) throw std::runtime_error("its axis (group 12) has no direction");
  const Eigen::Vector3d up = axis.normalized();
  const double along = up.dot(start - base);
  const Eigen::Vector3d foot = base + along * up, out = start - foot;
  const bool turns_right = entity.whole_number_of(290, 1) != 0;
  Helix helix{foot,           {},
              out.norm(),     needed(entity, 40, "a radius"),
              2 * pi * turns, turns * needed(entity, 42, "a height of its turns")};
  check(helix, turns);
  const Eigen::Vector3d x = helix.start_radius > 0 ? out.normalized() : up.unitOrthogonal();
  helix.axes << x, (turns_right ? 1 : -1) * up.cross(x), up;
  return helix;
}

/// Cubics over equal angles, each with the handles that let one over a plane arc touch the circle thrice.
NurbsCurve cubics(const Helix& helix, int count) {
  const double step = helix.sweep / count, handle = 4.0 / 3 * std::tan(step / 4);
  std::vector<double> knots(4, 0);
  Eigen::Matrix4Xd points(4, 2 * count + 2);
  points.row(3).setOnes();
  for (int i = 0; i <= count; ++i) {
    const Eigen::Vector3d place = helix.point(i * step), third = handle * helix.slope(i * step);
    points.col(2 * i).head<3>() = i == 0 ? place : Eigen::Vector3d(place - third);
    points.col(2 * i + 1).head<3>() = i == count ? place : Eigen::Vector3d(place + third);
    knots.insert(knots.end(), i == 0 ? 0 : i == count ? 4 : 2, i);
  }
  return {KnotVector(3, std::move(knots)), std::move(points)};
}

/// The largest distance from the places of the helix in the same half planes about its axis, on the first and
/// the last of the cubics: those between are alike, or have a radius between theirs.
double deviation_of(const NurbsCurve& curve, const Helix& helix, int count) {
  constexpr int samples = 16;
  const double step = helix.sweep / count;
  double deviation = 0;
  for (const int piece : {0, count - 1})
    for (int k = 1; k < samples; ++k) {
      const double u = piece + k / double{samples};
      const Eigen::Vector3d place = curve.point(u), own = helix.axes.transpose() * (place - helix.foot);
      const double angle = u * step + std::remainder(std::atan2(own.y(), own.x()) - u * step, 2 * pi);
      deviation = std::max(deviation, (place - helix.point(angle)).norm());
    }
  return deviation;
}

}  // namespace

bool has_spline(const DxfEntity& helix) {
  const DxfEntity spline = helix.part_of_class("AcDbSpline");
  const bool has_class = spline.pairs.size() < helix.pairs.size();
  return spline.numbers_of(10).size() > 1 || (has_class && spline.numbers_of(11).size() > 1);
}

DrawnCurve helix_curve(const DxfEntity& entity) {
  const Helix helix = helix_of(entity.part_of_class("AcDbHelix"));
  constexpr double tolerance = 1e-7;
  constexpr int most_per_turn = 1024;
  const double turns = helix.sweep / (2 * pi);
  const double turn =
      std::hypot(2 * pi * std::max(helix.start_radius, helix.end_radius), helix.height / turns);
  for (int per_turn = 16;; per_turn *= 2) {
    const int count = std::max(1, static_cast<int>(std::ceil(per_turn * turns)));
    NurbsCurve curve = cubics(helix, count);
    const double deviation = deviation_of(curve, helix, count);
    if (deviation <= tolerance * turn || per_turn == most_per_turn)
      return {"helix", std::move(curve),
              "a helix without a spline is made of cubics that lie within 1e-7 of the length of a turn",
              deviation};
  }
}

}  // namespace nurbeam
