#include "pipelines/papers/printed_pendulum.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "fem/element/rancf_basis.h"
#include "fem/element/subdivision.h"

namespace nurbeam {

namespace {

using Nodes = Eigen::Matrix2Xd;  // r and r_x of each node

constexpr double gravity = 9.81, bound = 10;  // [m/s^2], [m]

RancfElement whole_element(const PendulumArc arc, double l) {
  const RationalCubic axis = pendulum_axis(arc);
  return {to_rancf(axis, l), axis.points().row(3).transpose(), l};
}

std::vector<RancfElement> elements_of(const PrintedPendulum& pendulum) {
  const ArcLengthMap measured(pendulum_axis(pendulum.arc));
  std::vector<RancfElement> parts =
      subdivide(whole_element(pendulum.arc, measured.length()),
                graded_parameters(measured, pendulum.elements, pendulum.grading));
  if (pendulum.ancf)
    for (RancfElement& part : parts) part.weights.setOnes();
  return parts;
}

/// Equal elements of a chain that hangs on its first node, M r'' + Q = F.
class Chain {
 public:
  explicit Chain(const PrintedPendulum& pendulum) {
    const std::vector<RancfElement> parts = elements_of(pendulum);
    const auto count = static_cast<Eigen::Index>(2 * parts.size() + 2);
    drawn_.resize(2, count);
    Eigen::MatrixXd mass = Eigen::MatrixXd::Zero(count, count);
    weight_.setZero(count);
    for (const RancfElement& part : parts) {
      const Eigen::Index at = 2 * static_cast<Eigen::Index>(elements_.size());
      elements_.emplace_back(part, pendulum_section(), pendulum.curvature, PrintedStart::as_drawn,
                             pendulum.panels);
      drawn_.middleCols<4>(at) = part.e.topRows<2>();
      mass.block<4, 4>(at, at) += elements_.back().mass();
      weight_.segment<4>(at) += gravity * elements_.back().load_factors();
    }
    mass_ = mass;
    free_mass_.compute(mass.bottomRightCorner(count - 1, count - 1));
  }

  const Nodes& drawn() const { return drawn_; }

  Nodes acceleration(const Nodes& e) const {
    Nodes force = Nodes::Zero(2, e.cols());
    force.row(1) -= weight_;
    for (std::size_t i = 0; i < elements_.size(); ++i)
      force.middleCols<4>(2 * i) -= elements_[i].elastic_force(e.middleCols<4>(2 * i));
    Nodes acceleration = Nodes::Zero(2, e.cols());
    acceleration.rightCols(e.cols() - 1) =
        free_mass_.solve(force.rightCols(e.cols() - 1).transpose()).transpose();
    return acceleration;
  }

  double energy(const Nodes& e, const Nodes& v) const {
    double energy = (v * mass_ * v.transpose()).trace() / 2 + weight_.dot(e.row(1));
    for (std::size_t i = 0; i < elements_.size(); ++i)
      energy += elements_[i].elastic_energy(e.middleCols<4>(2 * i)).total();
    return energy;
  }

 private:
  std::vector<PrintedElement> elements_;
  Nodes drawn_;
  Eigen::MatrixXd mass_;
  Eigen::RowVectorXd weight_;
  Eigen::LLT<Eigen::MatrixXd> free_mass_;
};

/// A step of the classical method of Runge and Kutta.
void advance(const Chain& chain, double h, Nodes& e, Nodes& v) {
  const Nodes v1 = v, a1 = chain.acceleration(e);
  const Nodes v2 = v + h / 2 * a1, a2 = chain.acceleration(e + h / 2 * v1);
  const Nodes v3 = v + h / 2 * a2, a3 = chain.acceleration(e + h / 2 * v2);
  const Nodes v4 = v + h * a3, a4 = chain.acceleration(e + h * v3);
  e += h / 6 * (v1 + 2 * v2 + 2 * v3 + v4);
  v += h / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
}

}  // namespace

PrintedMotion printed_pendulum_motion(const PrintedPendulum& pendulum) {
  const Chain chain(pendulum);
  Nodes e = chain.drawn(), v = Nodes::Zero(2, e.cols());
  const Eigen::Index B = e.cols() - 2;
  const double start = chain.energy(e, v);
  const long every = std::lround(0.01 / pendulum.step), steps = 100 * every;
  PrintedMotion motion;
  for (long i = 0; i <= steps; ++i) {
    if (i > 0) advance(chain, 0.01 / static_cast<double>(every), e, v);
    if (!(e.cwiseAbs().maxCoeff() < bound)) break;
    motion.energy_departure = std::max(motion.energy_departure, std::abs(chain.energy(e, v) - start));
    if (i % every != 0) continue;
    motion.t.push_back(0.01 * static_cast<double>(i) / static_cast<double>(every));
    motion.AB.push_back(e.col(B).norm());
    motion.fall.push_back(e(1, B) - chain.drawn()(1, B));
  }
  return motion;
}

double largest_difference_in_AB(const std::vector<double>& a, const std::vector<double>& b) {
  double largest = 0;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
    largest = std::max(largest, std::abs(a[i] - b[i]));
  return largest;
}

}  // namespace nurbeam
