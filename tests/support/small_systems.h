#pragma once
#include <cmath>
#include <limits>

#include "tests/support/dense_system.h"

namespace nurbeam::testing {

/// A point mass (x, y) on a rigid massless rod about the origin, y up: g = (x^2 + y^2 - length^2) / 2.
///
/// With the angle phi from the downward vertical, phi'' = -(gravity / length) sin(phi) and
/// lambda = mass (phi'^2 + gravity cos(phi) / length).
class CartesianPendulum : public DenseSystem {
 public:
  double point_mass = 2;
  double length = 1.5;
  double gravity = 9.81;
  double viscosity = 0;  ///< force against the velocity [N s/m]
  /// The force is not a number from this time on.
  double failure_time = std::numeric_limits<double>::infinity();
  /// The configuration means nothing from this x on.
  double wall = std::numeric_limits<double>::infinity();
  double longest_step = std::numeric_limits<double>::infinity();

  int coordinate_count() const override { return 2; }
  int constraint_count() const override { return 1; }

  void residual(const State& state, Eigen::Ref<Eigen::VectorXd> dynamics,
                Eigen::Ref<Eigen::VectorXd> constraints) const override {
    const double weight =
        state.t >= failure_time ? std::numeric_limits<double>::quiet_NaN() : point_mass * gravity;
    dynamics = point_mass * state.a + viscosity * state.v + state.q * state.lambda[0];
    dynamics[1] += weight;
    constraints[0] = 0.5 * (state.q.squaredNorm() - length * length);
  }
  Eigen::VectorXd constraint_curvature(const State& state) const override {
    return Eigen::VectorXd::Constant(1, state.v.squaredNorm());
  }
  double step_limit(const State&) const override { return longest_step; }
  bool admissible(const State& state) const override { return state.q[0] < wall; }
  Eigen::VectorXd coordinate_scale() const override { return Eigen::VectorXd::Constant(2, length); }

  /// The state at angle `phi` with angular velocity `omega`, consistent in closed form.
  State at_angle(double t, double phi, double omega) const {
    const Eigen::Vector2d radial(std::sin(phi), -std::cos(phi));
    const Eigen::Vector2d tangential(std::cos(phi), std::sin(phi));
    const double acceleration = -gravity / length * std::sin(phi);
    State state;
    state.t = t;
    state.q = length * radial;
    state.v = length * omega * tangential;
    state.a = length * (acceleration * tangential - omega * omega * radial);
    state.lambda =
        Eigen::VectorXd::Constant(1, point_mass * (omega * omega + gravity * std::cos(phi) / length));
    return state;
  }

  /// The state after `time` from rest at angle `phi`, by classical Runge-Kutta steps of the angle alone.
  State reference(double phi, double time, int steps) const {
    const double h = time / steps;
    const auto rate = [this](const Eigen::Vector2d& y) {
      return Eigen::Vector2d(y[1], -gravity / length * std::sin(y[0]));
    };
    Eigen::Vector2d y(phi, 0);
    for (int i = 0; i < steps; ++i) {
      const Eigen::Vector2d k1 = rate(y);
      const Eigen::Vector2d k2 = rate(y + 0.5 * h * k1);
      const Eigen::Vector2d k3 = rate(y + 0.5 * h * k2);
      const Eigen::Vector2d k4 = rate(y + h * k3);
      y += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    }
    return at_angle(time, y[0], y[1]);
  }

  double energy(const State& state) const {
    return 0.5 * point_mass * state.v.squaredNorm() + point_mass * gravity * state.q[1];
  }

 protected:
  Eigen::MatrixXd mass(const State&) const override { return point_mass * Eigen::Matrix2d::Identity(); }
  Eigen::MatrixXd damping(const State&) const override { return viscosity * Eigen::Matrix2d::Identity(); }
  Eigen::MatrixXd stiffness(const State& state) const override {
    return state.lambda[0] * Eigen::Matrix2d::Identity();
  }
  Eigen::MatrixXd constraint_jacobian(const State& state) const override { return state.q.transpose(); }
};

/// x'' + 2 damping_ratio omega x' + omega^2 x = 0.
class Oscillator : public DenseSystem {
 public:
  double omega = 2;
  double damping_ratio = 0;

  int coordinate_count() const override { return 1; }
  int constraint_count() const override { return 0; }
  void residual(const State& state, Eigen::Ref<Eigen::VectorXd> dynamics,
                Eigen::Ref<Eigen::VectorXd>) const override {
    dynamics = state.a + 2 * damping_ratio * omega * state.v + omega * omega * state.q;
  }

 protected:
  Eigen::MatrixXd mass(const State&) const override { return Eigen::MatrixXd::Identity(1, 1); }
  Eigen::MatrixXd damping(const State&) const override {
    return Eigen::MatrixXd::Constant(1, 1, 2 * damping_ratio * omega);
  }
  Eigen::MatrixXd stiffness(const State&) const override {
    return Eigen::MatrixXd::Constant(1, 1, omega * omega);
  }
};

/// Two masses joined by a spring, the first driven along x_0 = amplitude sin(frequency t) (rheonomic
/// constraint): with natural frequency omega of the second, x_1 = amplitude omega^2 / (omega^2 - frequency^2)
/// sin(frequency t) and lambda = -m_0 x_0'' - stiffness (x_0 - x_1).
class DrivenSlider : public DenseSystem {
 public:
  double first_mass = 3;
  double second_mass = 0.5;
  double spring = 8;
  double amplitude = 0.2;
  double frequency = 2.5;

  int coordinate_count() const override { return 2; }
  int constraint_count() const override { return 1; }
  bool has_constant_constraints() const override { return true; }
  void residual(const State& state, Eigen::Ref<Eigen::VectorXd> dynamics,
                Eigen::Ref<Eigen::VectorXd> constraints) const override {
    dynamics = mass(state) * state.a + stiffness(state) * state.q;
    dynamics[0] += state.lambda[0];
    constraints[0] = state.q[0] - amplitude * std::sin(frequency * state.t);
  }
  Eigen::VectorXd constraint_rate(const State& state) const override {
    return Eigen::VectorXd::Constant(1, -amplitude * frequency * std::cos(frequency * state.t));
  }
  Eigen::VectorXd constraint_curvature(const State& state) const override {
    return Eigen::VectorXd::Constant(1, amplitude * frequency * frequency * std::sin(frequency * state.t));
  }

  State exact(double t) const {
    const double omega2 = spring / second_mass;
    const double gain = omega2 / (omega2 - frequency * frequency);
    const Eigen::Vector2d shape(amplitude, amplitude * gain);
    State state;
    state.t = t;
    state.q = shape * std::sin(frequency * t);
    state.v = shape * frequency * std::cos(frequency * t);
    state.a = -frequency * frequency * state.q;
    state.lambda =
        Eigen::VectorXd::Constant(1, -first_mass * state.a[0] - spring * (state.q[0] - state.q[1]));
    return state;
  }

 protected:
  Eigen::MatrixXd mass(const State&) const override {
    return Eigen::Vector2d(first_mass, second_mass).asDiagonal();
  }
  Eigen::MatrixXd stiffness(const State&) const override {
    return spring * (Eigen::Matrix2d() << 1, -1, -1, 1).finished();
  }
  Eigen::MatrixXd constraint_jacobian(const State&) const override { return Eigen::RowVector2d(1, 0); }
};

/// A unit mass about a unit centre of gravitation, in polar coordinates q = (r, phi): r'' = r phi'^2 - 1 /
/// r^2, r^2 phi'' = -2 r r' phi'. Of half axis 1: every orbit closes after 2 pi, with energy -1/2 and angular
/// momentum sqrt(1 - eccentricity^2).
class KeplerOrbit : public DenseSystem {
 public:
  double eccentricity = 0.3;

  int coordinate_count() const override { return 2; }
  int constraint_count() const override { return 0; }
  void residual(const State& state, Eigen::Ref<Eigen::VectorXd> dynamics,
                Eigen::Ref<Eigen::VectorXd>) const override {
    const double r = state.q[0];
    const Eigen::VectorXd& v = state.v;
    dynamics[0] = state.a[0] - r * v[1] * v[1] + 1 / (r * r);
    dynamics[1] = r * r * state.a[1] + 2 * r * v[0] * v[1];
  }

  State at_nearest_point() const {
    const double r = 1 - eccentricity;
    const double rate = std::sqrt(1 - eccentricity * eccentricity) / (r * r);
    State state;
    state.q = Eigen::Vector2d(r, 0);
    state.v = Eigen::Vector2d(0, rate);
    state.a = Eigen::Vector2d(r * rate * rate - 1 / (r * r), 0);
    return state;
  }

 protected:
  Eigen::MatrixXd mass(const State& state) const override {
    return Eigen::Vector2d(1, state.q[0] * state.q[0]).asDiagonal();
  }
  Eigen::MatrixXd damping(const State& state) const override {
    const double r = state.q[0];
    return (Eigen::Matrix2d() << 0, -2 * r * state.v[1], 2 * r * state.v[1], 2 * r * state.v[0]).finished();
  }
  Eigen::MatrixXd stiffness(const State& state) const override {
    const double r = state.q[0];
    const Eigen::VectorXd& v = state.v;
    return (Eigen::Matrix2d() << -v[1] * v[1] - 2 / (r * r * r), 0, 2 * r * state.a[1] + 2 * v[0] * v[1], 0)
        .finished();
  }
};

}  // namespace nurbeam::testing
