#pragma once
#include <Eigen/Core>

namespace nurbeam {

/// The attitude of a rigid body: a quaternion p = (e0, e), whose length a constraint keeps at 1. All that is
/// here is polynomial in p, and exact for p of any length.
namespace attitude {

template <class T>
using Quaternion = Eigen::Matrix<T, 4, 1>;
template <class T>
using Vector = Eigen::Matrix<T, 3, 1>;

/// A(p) y = (e0^2 - e.e) y + 2 e e.y + 2 e0 e x y: from own axes to those of the model.
template <class T>
Vector<T> turned(const Quaternion<T>& p, const Vector<T>& y) {
  const T e0 = p[0];
  const Vector<T> e = p.template tail<3>();
  return (e0 * e0 - e.dot(e)) * y + 2.0 * e.dot(y) * e + 2.0 * e0 * e.cross(y);
}
/// A(p)' y: from the axes of the model to own ones.
template <class T>
Vector<T> turned_back(const Quaternion<T>& p, const Vector<T>& y) {
  return turned<T>({p[0], -p[1], -p[2], -p[3]}, y);
}

/// G(p) x, G = [-e, e0 1 - e~] (3 x 4). The spin in own axes is 2 G(p) dp/dt; G(p) p = 0.
template <class T>
Vector<T> half_spin(const Quaternion<T>& p, const Quaternion<T>& x) {
  const Vector<T> e = p.template tail<3>(), of_x = x.template tail<3>();
  return p[0] * of_x - x[0] * e - e.cross(of_x);
}
/// G(p)' m.
template <class T>
Quaternion<T> from_moment(const Quaternion<T>& p, const Vector<T>& m) {
  const Vector<T> e = p.template tail<3>();
  Quaternion<T> x;
  x[0] = -e.dot(m);
  x.template tail<3>() = p[0] * m + e.cross(m);
  return x;
}

/// H with y . A(p) a = p'H p: 2 H p is the gradient of y . A(p) a, and 2 H its Hessian.
inline Eigen::Matrix4d form(const Eigen::Vector3d& y, const Eigen::Vector3d& a) {
  Eigen::Matrix4d H;
  H(0, 0) = y.dot(a);
  H.block<1, 3>(0, 1) = a.cross(y).transpose();
  H.block<3, 1>(1, 0) = a.cross(y);
  H.block<3, 3>(1, 1) = y * a.transpose() + a * y.transpose() - y.dot(a) * Eigen::Matrix3d::Identity();
  return H;
}

/// (3 x 4) Derivative of A(p) a by p.
inline Eigen::Matrix<double, 3, 4> gradient(const Eigen::Vector4d& p, const Eigen::Vector3d& a) {
  Eigen::Matrix<double, 3, 4> J;
  for (int k = 0; k < 3; ++k) J.row(k) = 2 * (form(Eigen::Vector3d::Unit(k), a) * p).transpose();
  return J;
}

/// A(p)/|p|^2, the rotation of p of any length.
template <class T>
Eigen::Matrix<T, 3, 3> rotation(const Quaternion<T>& p) {
  const T square = p.dot(p);
  Eigen::Matrix<T, 3, 3> R;
  for (int k = 0; k < 3; ++k) R.col(k) = turned<T>(p, Vector<T>(Eigen::Vector3d::Unit(k).cast<T>())) / square;
  return R;
}
/// Forces on p from a moment along the axes of the model: its work is that over the rotation of p.
template <class T>
Quaternion<T> moment_force(const Quaternion<T>& p, const Vector<T>& moment) {
  const T square = p.dot(p);
  return from_moment<T>(p, turned_back<T>(p, moment)) * (2.0 / (square * square));
}

/// The rate of p for a spin along the axes of the model.
inline Eigen::Vector4d rate(const Eigen::Vector4d& p, const Eigen::Vector3d& spin) {
  return from_moment<double>(p, turned_back<double>(p, spin)) / 2;
}
/// The spin along the axes of the model for a rate of p of length 1.
inline Eigen::Vector3d spin(const Eigen::Vector4d& p, const Eigen::Vector4d& rate) {
  return turned<double>(p, 2 * half_spin<double>(p, rate));
}

}  // namespace attitude

}  // namespace nurbeam
