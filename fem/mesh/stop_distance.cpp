#include "fem/mesh/stop_distance.h"

#include <array>

namespace nurbeam {

namespace {

using Eigen::Vector3d;

// First position coordinate of the point at which a sliding body meets others: the body's own, or its node's
// where the body hangs beside the beam; -1 where there is no such node.
int meeting_place(const Structure& structure, const Mesh& mesh, int rider) {
  const Rider& of = structure.riders[rider];
  if (!of.is_offset()) return mesh.bodies[of.body];
  const int node = mesh.riders[rider].node;
  return node < 0 ? -1 : mesh.nodes[of.beam][node].r;
}

}  // namespace

// Length of the chord between two places of the drawn beam, with its derivatives by the places.
struct StopDistance::Chord {
  double length;
  std::array<double, 2> d1;
  double d11, d12, d22;
};

StopDistance::StopDistance(const Structure& structure, const Mesh& mesh, const Stop& stop)
    : stop_(&stop),
      curve_(&structure.beam_of(structure.riders[stop.rider]).curve),
      dimension_(structure.dimension),
      dofs_{mesh.riders[stop.rider].place, stop.other < 0 ? -1 : mesh.riders[stop.other].place},
      bodies_{structure.riders[stop.rider].body, stop.other < 0 ? -1 : structure.riders[stop.other].body} {
  if (stop.other < 0 || structure.beam_of(structure.riders[stop.rider]).rigid) return;
  gap_ = stop.place > 0 ? stop.place : stop.place + curve_->length();
  const std::array<int, 2> at{meeting_place(structure, mesh, stop.rider),
                              meeting_place(structure, mesh, stop.other)};
  if (at[0] < 0 || at[1] < 0) return;
  for (const int first : at)
    for (int d = 0; d < dimension_; ++d) dofs_.push_back(first + d);
}

double StopDistance::along_beam(const Eigen::VectorXd& q) const {
  return stop_->weight_of_rider() * q[dofs_[0]] +
         (dofs_[1] >= 0 ? stop_->weight_of_other() * q[dofs_[1]] : 0) + stop_->offset();
}

bool StopDistance::near(const Eigen::VectorXd& q) const { return dofs_.size() > 2 && along_beam(q) < gap_; }

Vector3d StopDistance::line(const Eigen::VectorXd& q) const {
  Vector3d d = Vector3d::Zero();
  d.head(dimension_) = q.segment(dofs_[2 + dimension_], dimension_) - q.segment(dofs_[2], dimension_);
  return d;
}

StopDistance::Chord StopDistance::chord(const Eigen::VectorXd& q) const {
  const auto point = [&](double s) { return curve_->point_in(curve_->segment_at(s), s); };
  const CurvePoint a = point(q[dofs_[0]]), b = point(q[dofs_[1]]);
  const Vector3d d = b.position - a.position;
  const double length = d.norm();
  const Vector3d e = d / length;
  const double by_a = -e.dot(a.tangent), by_b = e.dot(b.tangent);
  return {length,
          {by_a, by_b},
          -e.dot(a.curvature) + (1 - by_a * by_a) / length,
          -(a.tangent.dot(b.tangent) + by_a * by_b) / length,
          e.dot(b.curvature) + (1 - by_b * by_b) / length};
}

double StopDistance::value(const Eigen::VectorXd& q) const {
  return along_beam(q) + (near(q) ? line(q).norm() - chord(q).length : 0);
}

StopDistance::Vector StopDistance::gradient(const Eigen::VectorXd& q) const {
  Vector gradient = Vector::Zero(static_cast<Eigen::Index>(dofs_.size()));
  gradient.head<2>() << stop_->weight_of_rider(), stop_->weight_of_other();
  if (!near(q)) return gradient;
  const Chord drawn = chord(q);
  const Vector3d n = line(q).normalized();
  for (const int i : {0, 1}) gradient[i] -= drawn.d1[i];
  gradient.segment(2, dimension_) = -n.head(dimension_);
  gradient.tail(dimension_) = n.head(dimension_);
  return gradient;
}

StopDistance::Matrix StopDistance::hessian(const Eigen::VectorXd& q) const {
  const auto size = static_cast<Eigen::Index>(dofs_.size());
  Matrix hessian = Matrix::Zero(size, size);
  if (!near(q)) return hessian;
  const Chord drawn = chord(q);
  hessian.topLeftCorner<2, 2>() << -drawn.d11, -drawn.d12, -drawn.d12, -drawn.d22;
  const Vector3d d = line(q), n = d.normalized();
  const Eigen::Matrix3d curved = (Eigen::Matrix3d::Identity() - n * n.transpose()) / d.norm();
  const auto across = curved.topLeftCorner(dimension_, dimension_);
  const int D = dimension_;
  hessian.block(2, 2, D, D) = hessian.block(2 + D, 2 + D, D, D) = across;
  hessian.block(2, 2 + D, D, D) = hessian.block(2 + D, 2, D, D) = -across;
  return hessian;
}

StopDistance::Vector StopDistance::own(const Eigen::VectorXd& x) const {
  Vector own = Vector::Zero(static_cast<Eigen::Index>(dofs_.size()));
  for (Eigen::Index i = 0; i < own.size(); ++i)
    if (dofs_[i] >= 0) own[i] = x[dofs_[i]];
  return own;
}

double StopDistance::rate(const Eigen::VectorXd& q, const Eigen::VectorXd& v) const {
  return gradient(q).dot(own(v));
}

double StopDistance::acceleration(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                                  const Eigen::VectorXd& a) const {
  const Vector rates = own(v);
  return gradient(q).dot(own(a)) + rates.dot(hessian(q) * rates);
}

Vector3d StopDistance::on_body(int body, const Eigen::VectorXd& q, double N) const {
  if ((body != bodies_[0] && body != bodies_[1]) || !near(q)) return Vector3d::Zero();
  return (body == bodies_[1] ? N : -N) * line(q).normalized();
}

}  // namespace nurbeam
