#include "fem/forces/turned_ends.h"

#include <cmath>
#include <stdexcept>
#include <type_traits>

#include "fem/mesh/attitude.h"
#include "fem/mesh/grip_position.h"

namespace nurbeam {

namespace {

// theta/sin(theta) and its derivative by the cosine; regular at 1, infinite at -1.
std::array<double, 2> angle_over_sine(double cosine) {
  const double e = 1 - cosine;
  if (e < 1e-3)
    return {1 + e * (1. / 3 + e * (2. / 15 + e * (2. / 35 + e * (8. / 315 + e * 8. / 693)))),
            -(1. / 3 + e * (4. / 15 + e * (6. / 35 + e * (32. / 315 + e * 40. / 693))))};
  const double square = (1 - cosine) * (1 + cosine), ratio = std::acos(cosine) / std::sqrt(square);
  return {ratio, (cosine * ratio - 1) / square};
}
template <class T>
T angle_over_sine(const T& cosine) {
  const auto [ratio, slope] = angle_over_sine(plain(cosine));
  if constexpr (std::is_same_v<T, double>)
    return ratio;
  else
    return compose({ratio, slope, 0, 0}, cosine);
}

// First coordinate of the slope at a place of a beam, as NodeSection::at sees it.
template <int D>
int slope_at(const MeshedBeams<D>& at, const Eigen::VectorXd& drawn, const Grip& end) {
  const MeshSpan& span = *at.element_at(drawn, end.beam, end.s).span;
  const double place = at.structure.beams[end.beam].curve.unrolled(end.s, (span.s_a + span.s_b) / 2);
  return std::abs(place - span.s_a) <= std::abs(place - span.s_b) ? at.mesh.node_a(span).slope_right
                                                                  : at.mesh.node_b(span).slope_left;
}

}  // namespace

template <int D>
TurnedEnds<D>::TurnedEnds(const RotationalConnector& connector, const MeshedBeams<D>& at,
                          const Eigen::VectorXd& drawn)
    : counts_(connector.counts(D)), dofs_(size, -1) {
  const std::string what = "rotational connector \"" + connector.name + "\"";
  const Eigen::Vector3d u = connector.axis.value_or(Eigen::Vector3d::UnitZ()),
                        v = D == 2 ? Eigen::Vector3d::UnitX() : u.unitOrthogonal(), w = u.cross(v);
  for (const int i : {0, 1}) {
    const Grip& end = connector.ends[i];
    across_[i] << v, w;
    drawn_[i].setZero();
    if (end.is_point()) continue;
    if (end.body >= 0) {
      take_body(i, at, end.body, what);
      continue;
    }
    grip_position(at.structure, at.mesh, end, what);
    const Beam& beam = at.structure.beams[end.beam];
    if constexpr (D == 3)
      if (beam.has_torsion()) {
        of_sections_ = true;
        const NodeSection& section = sections_[i].emplace(NodeSection::at(at, drawn, end.beam, end.s));
        across_[i] = section.drawn.transpose() * across_[i];
        std::copy(section.dofs.begin(), section.dofs.end(), dofs_.begin() + i * size_of_end);
        continue;
      }
    const int slope = slope_at<D>(at, drawn, end);
    for (int d = 0; d < D; ++d) dofs_[i * size_of_end + d] = slope + d;
    const bool is_last = !beam.is_ring() && end.s >= beam.curve.end();
    drawn_[i] = across_[i].transpose() * beam.curve.tangent(end.s, is_last);
  }
  for (const int i : {0, 1})
    if (connector.ends[i].beam >= 0 && of_sections_ != sections_[i].has_value())
      throw std::invalid_argument(what + " joins a beam without torsion to what has three axes");
  if (!of_sections_ && !counts_)
    throw std::invalid_argument(what + " needs an axis between beams without torsion");
}

// An end that is a rigid body or a place of one.
template <int D>
void TurnedEnds<D>::take_body(int end, const MeshedBeams<D>& at, int body, const std::string& what) {
  const Body& of = at.structure.bodies[body];
  const int first = at.mesh.attitudes[of.point_of ? of.point_of->body : body];
  if (D == 2 || first < 0)
    throw std::invalid_argument(what + " takes hold of \"" + of.name +
                                "\", a point mass, which does not turn");
  of_sections_ = bodies_[end] = true;
  for (int k = 0; k < size_of_end; ++k) dofs_[end * size_of_end + k] = first + k;
}

template <int D>
typename TurnedEnds<D>::Vector TurnedEnds<D>::gathered(const Eigen::VectorXd& all) const {
  Vector x = Vector::Zero();
  for (int i = 0; i < size; ++i)
    if (dofs_[i] >= 0) x[i] = all[dofs_[i]];
  return x;
}

template <int D>
EndAngle<D> TurnedEnds<D>::angle(const Vector& x, bool with_hessian) const {
  if constexpr (D == 3)
    if (of_sections_) return angle_of_sections(x, with_hessian);
  return angle_of_directions(x, with_hessian);
}

// With the components p = (X, Y) of r_s along v and w: the angle of p against the drawn one.
template <int D>
EndAngle<D> TurnedEnds<D>::angle_of_directions(const Vector& x, bool with_hessian) const {
  EndAngle<D> angle{0, 1, Vector::Zero(), Matrix::Zero()};
  for (const int i : {0, 1}) {
    const int first = i * size_of_end;
    if (dofs_[first] < 0) continue;
    const double sign = i == 0 ? -1 : 1;
    const Eigen::Matrix<double, D, 2> across = across_[i].template topRows<D>();
    const Eigen::Vector2d p = across.transpose() * x.template segment<D>(first);
    const double square = p.squaredNorm(), X = p.x(), Y = p.y();
    const double S = sign * (drawn_[i].x() * Y - drawn_[i].y() * X), C = drawn_[i].dot(p);
    const double sine = angle.sine * C + angle.cosine * S, cosine = angle.cosine * C - angle.sine * S;
    const double norm = std::hypot(sine, cosine);
    angle.sine = sine / norm;
    angle.cosine = cosine / norm;
    angle.gradient.template segment<D>(first) = sign / square * (across * Eigen::Vector2d(-Y, X));
    if (!with_hessian) continue;
    Eigen::Matrix2d H;
    H << 2 * X * Y, Y * Y - X * X, Y * Y - X * X, -2 * X * Y;
    angle.hessian.template block<D, D>(first, first) =
        sign / (square * square) * (across * H * across.transpose());
  }
  return angle;
}

template <int D>
template <class T>
Eigen::Matrix<T, 3, 3> TurnedEnds<D>::axes(int end, const Eigen::Matrix<T, size, 1>& x) const {
  if constexpr (D == 3) {
    if (sections_[end]) return sections_[end]->template triad<T>(x.template segment<4>(4 * end)).matrix();
    if (bodies_[end]) return attitude::rotation<T>(x.template segment<4>(4 * end));
  }
  return Eigen::Matrix3d::Identity().cast<T>();
}

template <int D>
template <class T>
void TurnedEnds<D>::add_moment(int end, const Eigen::Matrix<T, size, 1>& x, const Vector3<T>& moment,
                               Eigen::Matrix<T, size, 1>& forces) const {
  if constexpr (D == 3) {
    if (sections_[end])
      forces.template segment<4>(4 * end) +=
          sections_[end]->template force<T>(x.template segment<4>(4 * end), moment);
    if (bodies_[end])
      forces.template segment<4>(4 * end) +=
          attitude::moment_force<T>(x.template segment<4>(4 * end), moment);
  }
}

// S = w_a . v_b - v_a . w_b and C = v_a . v_b + w_a . w_b, as SectionTurn.
template <int D>
template <class T>
typename TurnedEnds<D>::template Turning<T> TurnedEnds<D>::turning(const Eigen::Matrix<T, size, 1>& x) const {
  const Eigen::Matrix<T, 3, 2> a = axes<T>(0, x) * across_[0].template cast<T>(),
                               b = axes<T>(1, x) * across_[1].template cast<T>();
  const Vector3<T> v_a = a.col(0), w_a = a.col(1), v_b = b.col(0), w_b = b.col(1);
  const T S = w_a.dot(v_b) - v_a.dot(w_b), C = v_a.dot(v_b) + w_a.dot(w_b), square = S * S + C * C;
  const Vector3<T> of_S = v_b.cross(w_a) - w_b.cross(v_a), of_C = v_b.cross(v_a) + w_b.cross(w_a);
  return {S, C, Vector3<T>((of_S * C - of_C * S) / square)};
}

template <int D>
template <class T>
auto TurnedEnds<D>::gradient(const Eigen::Matrix<T, size, 1>& x) const -> Eigen::Matrix<T, size, 1> {
  const Vector3<T> on_b = turning<T>(x).on_b;
  Eigen::Matrix<T, size, 1> g = Eigen::Matrix<T, size, 1>::Zero();
  add_moment<T>(1, x, on_b, g);
  add_moment<T>(0, x, Vector3<T>(-on_b), g);
  return g;
}

template <int D>
EndAngle<D> TurnedEnds<D>::angle_of_sections(const Vector& x, bool with_hessian) const {
  const Turning<double> now = turning<double>(x);
  EndAngle<D> angle{now.S, now.C, gradient<double>(x), Matrix::Zero()};
  if (!with_hessian) return angle;
  using T = Dual<size>;
  const Eigen::Matrix<T, size, 1> g = gradient<T>(twist::variables<size, double>(x));
  for (int i = 0; i < size; ++i)
    for (int j = 0; j < size; ++j) angle.hessian(i, j) = g[i].d[j];
  return angle;
}

// With the ends' rotations since the drawing, of columns a_i and b_i: sum_i a_i x b_i/2 = u sin(theta) and
// (sum_i a_i . b_i - 1)/2 = cos(theta).
template <int D>
template <class T>
auto TurnedEnds<D>::ball_forces(const Eigen::Matrix<T, size, 1>& x, const Eigen::Matrix<T, size, 1>& v,
                                double stiffness, double damping) const -> Eigen::Matrix<T, size, 1> {
  std::array<Eigen::Matrix<T, 3, 3>, 2> turned;
  std::array<Vector3<T>, 2> spins;
  for (const int i : {0, 1}) {
    turned[i] = axes<T>(i, x);
    if (sections_[i]) turned[i] = turned[i] * sections_[i]->drawn.transpose().template cast<T>();
    for (int d = 0; d < 3; ++d) {
      Eigen::Matrix<T, size, 1> row = Eigen::Matrix<T, size, 1>::Zero();
      add_moment<T>(i, x, Vector3<T>(Eigen::Vector3d::Unit(d).cast<T>()), row);
      spins[i][d] = row.dot(v);
    }
  }
  Vector3<T> sine = Vector3<T>::Zero();
  T trace = 0.0;
  for (int i = 0; i < 3; ++i) {
    const Vector3<T> a = turned[0].col(i), b = turned[1].col(i);
    sine += a.cross(b) / 2.0;
    trace += a.dot(b);
  }
  const T ratio = angle_over_sine<T>((trace - 1.0) / 2.0);
  const Vector3<T> moment = stiffness * (sine * ratio) + damping * (spins[1] - spins[0]);
  Eigen::Matrix<T, size, 1> forces = Eigen::Matrix<T, size, 1>::Zero();
  add_moment<T>(1, x, moment, forces);
  add_moment<T>(0, x, Vector3<T>(-moment), forces);
  return forces;
}

template <int D>
typename TurnedEnds<D>::Ball TurnedEnds<D>::ball(const Vector& x, const Vector& v, double stiffness,
                                                 double damping) const {
  std::array<Eigen::Matrix3d, 2> turned;
  for (const int i : {0, 1}) {
    turned[i] = axes<double>(i, x);
    if (sections_[i]) turned[i] = turned[i] * sections_[i]->drawn.transpose();
  }
  Eigen::Vector3d sine = Eigen::Vector3d::Zero();
  for (int i = 0; i < 3; ++i) sine += turned[0].col(i).cross(turned[1].col(i)) / 2;
  const double cosine = ((turned[0].transpose() * turned[1]).trace() - 1) / 2;
  return {cosine, std::atan2(sine.norm(), cosine), ball_forces<double>(x, v, stiffness, 0),
          ball_forces<double>(x, v, stiffness, damping)};
}

template <int D>
typename TurnedEnds<D>::Matrix TurnedEnds<D>::ball_tangent(const Vector& x, const Vector& v, double stiffness,
                                                           double damping, double by_x, double by_v) const {
  using T = Dual<size>;
  const Eigen::Matrix<T, size, 1> f = ball_forces<T>(
      twist::variables<size, double>(x, by_x), twist::variables<size, double>(v, by_v), stiffness, damping);
  Matrix K;
  for (int i = 0; i < size; ++i)
    for (int j = 0; j < size; ++j) K(i, j) = f[i].d[j];
  return K;
}

template class TurnedEnds<2>;
template class TurnedEnds<3>;

}  // namespace nurbeam
