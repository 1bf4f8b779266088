#include "fem/constraints/turning_axes.h"

#include <stdexcept>

namespace nurbeam {

namespace {

// Forces on the coordinates of a section by y . R a.
template <class T>
Eigen::Matrix<T, 4, 1> section_gradient(const NodeSection& section, const Eigen::Matrix<T, 4, 1>& x,
                                        const Eigen::Vector3d& own, const Eigen::Vector3d& y) {
  const Vector3<T> turned = section.triad<T>(x).matrix() * own.cast<T>();
  return section.force<T>(x, turned.cross(Vector3<T>(y.cast<T>())));
}

}  // namespace

TurningAxes::TurningAxes(const MeshedBeams<3>& at, const Eigen::VectorXd& drawn, const Grip& of) {
  if (of.is_point()) return;
  if (of.body >= 0) {
    const int p = at.mesh.attitudes[of.body];
    if (p < 0)
      throw std::invalid_argument("body \"" + at.structure.bodies[of.body].name +
                                  "\" is a point mass, which has no axes");
    dofs_ = {p, p + 1, p + 2, p + 3};
    return;
  }
  if (!at.structure.beams[of.beam].has_torsion())
    throw std::invalid_argument("beam \"" + at.structure.beams[of.beam].name +
                                "\" has no torsion, and so no axes across it");
  section_.emplace(NodeSection::at(at, drawn, of.beam, of.s));
  dofs_.assign(section_->dofs.begin(), section_->dofs.end());
}

Eigen::Vector4d TurningAxes::coordinates(const State& state) const {
  return {state.q[dofs_[0]], state.q[dofs_[1]], state.q[dofs_[2]], state.q[dofs_[3]]};
}

Eigen::Vector3d TurningAxes::turned(const State& state, const Eigen::Vector3d& a) const {
  if (dofs_.empty()) return a;
  const Eigen::Vector4d x = coordinates(state);
  if (!section_) return attitude::turned<double>(x, a);
  return section_->triad<double>(x).matrix() * (section_->drawn.transpose() * a);
}

Eigen::Matrix<double, 3, 4> TurningAxes::gradient(const State& state, const Eigen::Vector3d& a) const {
  if (dofs_.empty()) return Eigen::Matrix<double, 3, 4>::Zero();
  const Eigen::Vector4d x = coordinates(state);
  if (!section_) return attitude::gradient(x, a);
  const Eigen::Vector3d own = section_->drawn.transpose() * a;
  Eigen::Matrix<double, 3, 4> J;
  for (int k = 0; k < 3; ++k)
    J.row(k) = section_gradient<double>(*section_, x, own, Eigen::Vector3d::Unit(k)).transpose();
  return J;
}

Eigen::Matrix4d TurningAxes::hessian(const State& state, const Eigen::Vector3d& a,
                                     const Eigen::Vector3d& y) const {
  if (dofs_.empty()) return Eigen::Matrix4d::Zero();
  if (!section_) return 2 * attitude::form(y, a);
  const Eigen::Vector3d own = section_->drawn.transpose() * a;
  const Eigen::Matrix<Dual<4>, 4, 1> g =
      section_gradient<Dual<4>>(*section_, twist::variables<4, double>(coordinates(state)), own, y);
  Eigen::Matrix4d H;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) H(i, j) = g[i].d[j];
  return H;
}

}  // namespace nurbeam
