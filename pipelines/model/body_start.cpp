#include "pipelines/model/body_start.h"

#include <Eigen/Geometry>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "fem/mesh/drawn_coordinates.h"
#include "nurbs/number_text.h"
#include "pipelines/diagnostics/closest_name.h"
#include "pipelines/model/prescribed_angle.h"

namespace nurbeam {

namespace {

// The velocity of a place: what is known of it, and the rigid body whose motion may be unknown.
struct PlaceVelocity {
  int body = -1;
  Eigen::Vector3d arm = Eigen::Vector3d::Zero();    // from the centre of the body to the place [m]
  Eigen::Vector3d known = Eigen::Vector3d::Zero();  // of the place, by the velocity and the spin so far [m/s]
};

// Equations for velocities, and where these are not enough for spins, of bodies whose are not given.
class Velocities {
 public:
  Velocities(const ResolvedCase& resolved, const BeamModel& model) : model_(model) {
    for (std::size_t i = 0; i < model.bodies.size(); ++i) {
      const bool rigid = i < resolved.bodies.size() && model.bodies[i].rigid;
      velocities_.push_back(rigid && !resolved.bodies[i].velocity ? count_++ : -1);
      spins_.push_back(rigid && !resolved.bodies[i].angular_velocity ? spin_count_++ : -1);
    }
  }
  bool empty() const { return count_ + spin_count_ == 0; }

  PlaceVelocity of(int body) const {
    const std::optional<BodyPoint>& point = model_.bodies[body].point_of;
    return point ? of(point->body, point->arm) : of(body, Eigen::Vector3d::Zero());
  }
  PlaceVelocity of(const Grip& grip, const Eigen::Vector3d& arm) const {
    if (grip.body < 0) return {};
    return model_.bodies[grip.body].point_of ? of(grip.body) : of(grip.body, arm);
  }
  // Both have one velocity along a direction.
  void equal(const PlaceVelocity& a, const PlaceVelocity& b, const Eigen::Vector3d& along) {
    const int n = 3 * count_;
    Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(n + 3 * spin_count_);
    const auto add = [&](const PlaceVelocity& of, double sign) {
      if (of.body < 0) return;
      if (const int v = velocities_[of.body]; v >= 0) row.segment<3>(3 * v) += sign * along.transpose();
      if (const int w = spins_[of.body]; w >= 0)
        row.segment<3>(n + 3 * w) += sign * of.arm.cross(along).transpose();
    };
    add(a, 1);
    add(b, -1);
    rows_.push_back(row);
    right_.push_back(along.dot(b.known - a.known));
  }
  // The first turns about an axis against the second, a rigid body or -1 for what stands, at a rate.
  void turn(int a, int b, const Eigen::Vector3d& axis, double rate) {
    Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(3 * (count_ + spin_count_));
    double known = 0;
    for (const auto& [body, sign] : {std::pair{a, 1.0}, {b, -1.0}}) {
      if (body < 0) continue;
      if (const int w = spins_[body]; w >= 0) row.segment<3>(3 * (count_ + w)) += sign * axis.transpose();
      known += sign * axis.dot(model_.bodies[body].rigid->spin);
    }
    rows_.push_back(row);
    right_.push_back(rate - known);
  }
  // Gives the bodies the least motions that satisfy the equations as well as they can be: velocities alone
  // where that is enough.
  void give(std::vector<Body>& bodies) const {
    const auto n = static_cast<Eigen::Index>(rows_.size());
    if (n == 0) return;
    Eigen::MatrixXd A(n, 3 * (count_ + spin_count_));
    for (Eigen::Index i = 0; i < n; ++i) A.row(i) = rows_[static_cast<std::size_t>(i)];
    const Eigen::Map<const Eigen::VectorXd> right(right_.data(), n);
    Eigen::VectorXd found = Eigen::VectorXd::Zero(A.cols());
    const Eigen::MatrixXd of_velocities = A.leftCols(3 * count_);
    found.head(3 * count_) = least(of_velocities, right);
    constexpr double enough = 1e-9;
    if ((A * found - right).norm() > enough * right.norm()) found = least(A, right);
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      if (const int v = velocities_[i]; v >= 0) bodies[i].velocity += found.segment<3>(3 * v);
      if (const int w = spins_[i]; w >= 0) bodies[i].rigid->spin += found.segment<3>(3 * (count_ + w));
    }
  }

 private:
  PlaceVelocity of(int body, const Eigen::Vector3d& drawn_arm) const {
    const Body& at = model_.bodies[body];
    if (!at.rigid) return {.body = body, .known = at.velocity};
    const Eigen::Vector3d arm = at.rigid->attitude * drawn_arm;
    return {body, arm, at.velocity + at.rigid->spin.cross(arm)};
  }
  static Eigen::VectorXd least(const Eigen::MatrixXd& A, const Eigen::VectorXd& right) {
    if (A.cols() == 0) return {};
    return Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd>(A).solve(right);
  }

  const BeamModel& model_;
  std::vector<int> velocities_, spins_;  // per body: which unknown, -1 for none
  int count_ = 0, spin_count_ = 0;
  std::vector<Eigen::RowVectorXd> rows_;
  std::vector<double> right_;
};

// Two directions across one.
std::array<Eigen::Vector3d, 2> across(const Eigen::Vector3d& t) {
  const Eigen::Vector3d u = t.normalized(), v = u.unitOrthogonal();
  return {v, u.cross(v)};
}

// Where a rigid body holds the point as the bodies start: on a line that is where the point is.
Eigen::Vector3d arm_now(const BodyJoint& joint, const BeamModel& model) {
  if (!joint.slide || joint.to.body < 0 || !model.bodies[joint.to.body].rigid) return joint.arm;
  const Eigen::Vector3d away = drawn_place(model, Grip::on_body(joint.point)) - drawn_place(model, joint.to);
  return model.bodies[joint.to.body].rigid->attitude.conjugate() * away;
}

// What turns a joint gives a spin, and in space the place a velocity.
void add_turn(const BodyJoint& joint, const BeamModel& model, Velocities& velocities, PlaceVelocity& there) {
  const AngleMotion::Moment now = joint.turn->angle.at(0);
  if (joint.to.is_point()) there.known += joint.turn->at(0, 1).first * (joint.to.point - joint.turn->about);
  const bool on_rigid = joint.to.body >= 0 && model.bodies[joint.to.body].rigid;
  const Eigen::Vector3d axis =
      on_rigid ? Eigen::Vector3d(model.bodies[joint.to.body].rigid->attitude * joint.turn->axis)
               : joint.turn->axis;
  if (joint.pairs.size() == 3)
    velocities.turn(joint.turning_body(model), on_rigid ? joint.to.body : -1, axis, now.rate);
}

void add_joint(const BodyJoint& joint, const BeamModel& model, Velocities& velocities) {
  if (joint.to.beam >= 0) return;  // a beam gives way
  const PlaceVelocity point = velocities.of(joint.point);
  PlaceVelocity there = velocities.of(joint.to, arm_now(joint, model));
  if (joint.motion) there.known += joint.motion->at(0).rate;
  if (joint.turn) add_turn(joint, model, velocities, there);
  if (!joint.slide) {
    for (int k = 0; k < 3; ++k) velocities.equal(point, there, Eigen::Vector3d::Unit(k));
    return;
  }
  const auto* rigid =
      joint.to.body >= 0 && model.bodies[joint.to.body].rigid ? &*model.bodies[joint.to.body].rigid : nullptr;
  const Eigen::Vector3d along = rigid ? Eigen::Vector3d(rigid->attitude * *joint.slide) : *joint.slide;
  for (const Eigen::Vector3d& v : across(along)) velocities.equal(point, there, v);
}

bool is_of_rigid(int body, const BeamModel& model) {
  return body >= 0 && (model.bodies[body].rigid || model.bodies[body].point_of);
}

// The spin of a body that follows a section, at a speed: what follows of that of the section.
void add_following(const Rider& rider, double speed, const BeamModel& model, Velocities& velocities) {
  const ReferenceCurve& curve = model.beam_of(rider).curve;
  if (rider.follows == Follows::nothing || !curve.has_sections()) return;
  const DrawnSection section = curve.section(rider.s);
  const Eigen::Vector3d spin = speed * (section.curvature + section.twist * section.t);
  std::vector<Eigen::Vector3d> axes;
  if (rider.follows == Follows::section)
    axes = {section.d1, section.d2, section.t};
  else
    for (const Eigen::Vector3d& v : across(rider.follows == Follows::axis ? rider.follow_axis : section.t))
      axes.push_back(v);
  for (const Eigen::Vector3d& axis : axes)
    velocities.turn(model.turning_body(rider), -1, axis, spin.dot(axis));
}

// What a rider says of the velocity of its point: all of it where it has a speed.
void add_rider(const Rider& rider, bool says_speed, const BeamModel& model, Velocities& velocities) {
  const Eigen::Vector3d t = model.beam_of(rider).curve.tangent(rider.s);
  const PlaceVelocity body = velocities.of(rider.body);
  const double speed = rider.motion ? rider.motion->at(0).speed : rider.speed;
  const PlaceVelocity along{.known = says_speed ? Eigen::Vector3d(speed * t) : Eigen::Vector3d::Zero()};
  for (const Eigen::Vector3d& v : across(t)) velocities.equal(body, along, v);
  if (!says_speed) return;
  velocities.equal(body, along, t.normalized());
  add_following(rider, speed, model, velocities);
}

void add_rod(const Connector& rod, const BeamModel& model, Velocities& velocities) {
  const auto& [a, b] = rod.ends;
  if (!is_of_rigid(a.body, model) && !is_of_rigid(b.body, model)) return;
  const Eigen::Vector3d d = drawn_place(model, b) - drawn_place(model, a);
  const Eigen::Vector3d none = Eigen::Vector3d::Zero();
  velocities.equal(velocities.of(a, none), velocities.of(b, none), rod.direction.value_or(d.normalized()));
}

// Axes that a joint keeps square are square where the bodies start. `R`: of what turns the joint, then.
void check_axes(const BodyJoint& joint, const std::string& path, const Eigen::Matrix3d& R,
                const BeamModel& model, Findings& findings) {
  const auto attitude = [&](int body) {
    const auto& rigid = model.bodies[body].rigid;
    return rigid ? rigid->attitude : Eigen::Quaterniond::Identity();
  };
  const Eigen::Quaterniond own = attitude(joint.turning_body(model)),
                           other =
                               joint.to.body >= 0 ? attitude(joint.to.body) : Eigen::Quaterniond::Identity();
  double open = 0;
  for (const auto& [a, b] : joint.pairs) open = std::max(open, std::abs((own * a).dot(other * (R * b))));
  constexpr double near = 1e-6;
  if (open <= near) return;
  const std::string degrees = text_of(std::asin(std::min(open, 1.0)) * 180 / M_PI, 4) + " degrees";
  if (joint.turn)
    findings.error(
        path, "turns body " + in_quotes(model.bodies[joint.turning_body(model)].name) + " to " +
                  text_of(joint.turn->angle.at(0).angle * 180 / M_PI, 6) + " degrees at time 0, " + degrees +
                  " away from where the body starts; let its \"table\" begin at the angle by which "
                  "the body is \"turned\", 0 without that, or start with \"initial\": "
                  "\"equilibrium\"");
  else
    findings.error(path, "holds the attitude of body " +
                             in_quotes(model.bodies[joint.turning_body(model)].name) +
                             ", which \"turned\" takes " + degrees +
                             " away from it; turn it about what the joint leaves free, or turn what it is "
                             "joined to as well");
}

// The place of a joint where the bodies start.
void check_place(const BodyJoint& joint, const std::string& path, const Eigen::Matrix3d& R,
                 const BeamModel& model, Findings& findings) {
  const Eigen::Vector3d here = drawn_place(model, Grip::on_body(joint.point));
  Eigen::Vector3d there = joint.to.is_point() ? joint.to.point : drawn_place(model, joint.to), along(0, 0, 0);
  if (joint.slide) along = *joint.slide;
  if (joint.to.body >= 0)
    if (const auto& rigid = model.bodies[joint.to.body].rigid) {
      there += rigid->attitude * joint.arm;
      along = rigid->attitude * along;
    }
  if (joint.turn && joint.to.is_point()) there = joint.turn->about + R * (there - joint.turn->about);
  Eigen::Vector3d apart = here - there;
  apart -= apart.dot(along) * along;
  constexpr double near = 1e-6;  // [m]
  if (apart.norm() > near)
    findings.error(path,
                   "joins two places that are " + text_of(apart.norm(), 4) +
                       " m apart where the bodies start; let \"turned\" be \"about\" a place that the joint "
                       "leaves where it is, or turn what it is joined to as well");
}

// The velocity with which a point starts.
Eigen::Vector3d start_of(int body, const BeamModel& model) {
  const Body& at = model.bodies[body];
  if (!at.point_of) return at.velocity;
  const Body& carrier = model.bodies[at.point_of->body];
  return carrier.velocity + carrier.rigid->spin.cross(carrier.rigid->attitude * at.point_of->arm);
}

}  // namespace

void start_bodies(const ResolvedCase& resolved, BeamModel& model, Findings& findings) {
  std::size_t number = 0;
  for (const Constraint& constraint : model.constraints)
    if (const auto* joint = std::get_if<BodyJoint>(&constraint)) {
      const std::string& path = resolved.body_joints[number++].path;
      const Eigen::Matrix3d R = joint->turn && starts_as_drawn(resolved.analysis)
                                    ? joint->turn->at(0, 1).R
                                    : Eigen::Matrix3d(Eigen::Matrix3d::Identity());
      check_axes(*joint, path, R, model, findings);
      check_place(*joint, path, R, model, findings);
    }
  Velocities velocities(resolved, model);
  if (velocities.empty() || resolved.analysis.type != CaseAnalysis::Type::dynamic) return;
  for (const Constraint& constraint : model.constraints)
    if (const auto* joint = std::get_if<BodyJoint>(&constraint)) add_joint(*joint, model, velocities);
  for (std::size_t j = 0; j < resolved.sliding_joints.size(); ++j)
    if (is_of_rigid(model.riders[j].body, model))
      add_rider(model.riders[j], resolved.sliding_joints[j].says_speed(), model, velocities);
  for (const Connector& connector : model.connectors)
    if (connector.type == ConnectorType::rod) add_rod(connector, model, velocities);
  velocities.give(model.bodies);
  for (std::size_t j = 0; j < resolved.sliding_joints.size(); ++j) {
    Rider& rider = model.riders[j];
    if (!is_of_rigid(rider.body, model) || resolved.sliding_joints[j].says_speed()) continue;
    const Eigen::Vector3d t = model.beam_of(rider).curve.tangent(rider.s);
    rider.speed = start_of(rider.body, model).dot(t) / t.squaredNorm();
  }
}

}  // namespace nurbeam
