// Bodies that connectors join, on rigid guides: trains and pendulums.

#include <algorithm>
#include <cmath>
#include <numbers>

#include "pipelines/verification/models.h"
#include "pipelines/verification/verify.h"
#include "pipelines/verification/verify_run.h"

namespace nurbeam {

namespace {

using namespace verification;
using Eigen::Vector3d;
constexpr double weight_per_mass = 9.81;

// A guide of 100 m that goes down by that angle.
int add_slope(ModelBuilder& builder, double angle) {
  return builder.add_guide(
      ReferenceCurve({line_cubic({0, 0, 0}, {100 * std::cos(angle), -100 * std::sin(angle), 0})}, 2));
}

VerifyResult train() {
  VerifyResult result;
  const double a = 30, b = 50, k = 2000, omega = std::sqrt(k * (a + b) / (a * b));
  const double period = 2 * std::numbers::pi / omega, closing = 3, gap = 2;
  const auto swing = [&](double step, const std::vector<double>& times) {
    ModelBuilder builder(2, {0, -weight_per_mass, 0});
    const int guide = add_slope(builder, 0);
    const int behind = builder.add_body("a", a), ahead = builder.add_body("b", b);
    builder.slide(behind, guide, 10, 6);
    builder.slide(ahead, guide, 10 + gap, 6 - closing);
    builder.connect(Grip::on_body(behind), Grip::on_body(ahead), ConnectorType::spring, k);
    return run_model(builder.build(), times, step);
  };
  const std::vector<double> times = even_times(3 * period, 60);
  const auto error = [&](const RunRecord& run) {
    double largest = 0;
    for (std::size_t i = 0; i < times.size(); ++i)
      largest = std::max(largest, std::abs(run.frames[i].connectors[0].length - gap +
                                           closing / omega * std::sin(omega * times[i])));
    return largest;
  };
  const RunRecord run = swing(period / 2000, times);
  result.add("distance of two that a spring joins, largest error [m]", 0,
             "sin(omega t), omega^2 = k (1/a + 1/b)", error(run), 2e-5);
  const auto& end = run.frames.back().bodies;
  result.add("their centre of mass [m]",
             (a * 10 + b * (10 + gap) + (a * 6 + b * (6 - closing)) * times.back()) / (a + b),
             "uniform motion", (a * end[0].point.position.x() + b * end[1].point.position.x()) / (a + b),
             1e-9);
  ConvergenceTable table{"their distance [m], largest", "steps in a period", {}};
  for (const double steps : {100, 200, 400})
    table.rows.emplace_back(steps, error(swing(period / steps, times)));
  result.add(std::move(table), 2, 0.1, "order of the method");
  return result;
}

VerifyResult linked_friction() {
  VerifyResult result;
  const double a = 30, b = 50, mu_a = 0.3, mu_b = 0.1, slope = std::numbers::pi / 6;
  ModelBuilder builder(2, {0, -weight_per_mass, 0});
  const int guide = add_slope(builder, slope);
  const int behind = builder.add_body("a", a), ahead = builder.add_body("b", b);
  builder.slide(behind, guide, 1).friction = Friction{.coefficient = mu_a};
  builder.slide(ahead, guide, 3).friction = Friction{.coefficient = mu_b};
  builder.connect(Grip::on_body(behind), Grip::on_body(ahead), ConnectorType::rod);
  const double along = weight_per_mass * std::sin(slope), press = weight_per_mass * std::cos(slope);
  const double acceleration = along - press * (mu_a * a + mu_b * b) / (a + b);
  const RunRecord run = run_model(builder.build(), {0, 2}, 1e-3);
  result.add("two on a slope, linked: the first [m], t = 2 s", 1 + acceleration / 2 * 4, "Coulomb's friction",
             run.frames.back().bodies[0].s.value(), 1e-4);
  result.add("pull of the link [N]", a * (acceleration - along + mu_a * press), "Coulomb's friction",
             run.frames.back().connectors[0].force, 1e-3);
  return result;
}

// The angle of the rod from the vertical and its rate, by Runge and Kutta: (M + m) X' = -m l (sin angle)',
// with the pendulum's own equation.
struct SwingOnTrolley {
  double angle, rate;
};
SwingOnTrolley swing_rate(const SwingOnTrolley& y, double share, double length) {
  // share = m/(M + m): (1 - share cos^2) angle'' = -g/l sin - share rate^2 sin cos.
  const double s = std::sin(y.angle), c = std::cos(y.angle);
  return {y.rate, (-weight_per_mass / length * s - share * y.rate * y.rate * s * c) / (1 - share * c * c)};
}

VerifyResult pendulum_on_trolley() {
  VerifyResult result;
  const double trolley = 50, load = 80, length = 2, share = load / (trolley + load);
  const double start = std::numbers::pi / 3;
  const std::vector<double> times{0, 0.5, 1, 1.5, 2};
  ModelBuilder builder(2, {0, -weight_per_mass, 0});
  const int guide = add_slope(builder, 0);
  const int above = builder.add_body("trolley", trolley);
  const int below =
      builder.add_body("load", load, {50 + length * std::sin(start), -length * std::cos(start), 0});
  builder.slide(above, guide, 50);
  builder.connect(Grip::on_body(above), Grip::on_body(below), ConnectorType::rod);
  const RunRecord run = run_model(builder.build(), times, 2e-4);
  SwingOnTrolley y{start, 0};
  const double h = 1e-4;
  double t = 0, drift = 0;
  for (std::size_t i = 1; i < times.size(); ++i) {
    for (; t < times[i] - h / 2; t += h) {
      const auto moved = [&](const SwingOnTrolley& by, double part) {
        return SwingOnTrolley{y.angle + part * by.angle, y.rate + part * by.rate};
      };
      const SwingOnTrolley k1 = swing_rate(y, share, length),
                           k2 = swing_rate(moved(k1, h / 2), share, length),
                           k3 = swing_rate(moved(k2, h / 2), share, length),
                           k4 = swing_rate(moved(k3, h), share, length);
      y.angle += h / 6 * (k1.angle + 2 * k2.angle + 2 * k3.angle + k4.angle);
      y.rate += h / 6 * (k1.rate + 2 * k2.rate + 2 * k3.rate + k4.rate);
    }
    const Vector3d& at = run.frames[i].bodies[0].point.position;
    result.add(
        "trolley below which a load swings, x [m], t = " + std::to_string(times[i]).substr(0, 3) + " s",
        50 + share * length * (std::sin(start) - std::sin(y.angle)), "Lagrange's equation, Runge-Kutta",
        at.x(), 2e-5);
    drift = std::max(drift, std::abs(run.frames[i].energy.total - run.frames[0].energy.total));
  }
  result.add("drift of the energy [J]", 0, "no losses", drift, 1e-3);
  return result;
}

VerifyResult hanging_still() {
  VerifyResult result;
  const double slope = 20 * std::numbers::pi / 180, length = 2, load = 80;
  for (const double mu : {0.0, 0.1, 0.2}) {
    const double a = weight_per_mass * (std::sin(slope) - mu * std::cos(slope));
    const Vector3d felt(-a * std::cos(slope), -weight_per_mass + a * std::sin(slope), 0);
    ModelBuilder builder(2, {0, -weight_per_mass, 0});
    const int guide = add_slope(builder, slope);
    const int above = builder.add_body("trolley", 50);
    const Vector3d from(2 * std::cos(slope), -2 * std::sin(slope), 0);
    const int below = builder.add_body("load", load, from + length * felt.normalized());
    Rider& joint = builder.slide(above, guide, 2);
    if (mu > 0) joint.friction = Friction{.coefficient = mu};
    builder.connect(Grip::on_body(above), Grip::on_body(below), ConnectorType::rod);
    const RunRecord run = run_model(builder.build(), {0, 1, 2}, 1e-3);
    const std::string with = ", friction " + std::to_string(mu).substr(0, 3);
    const Vector3d rod =
        run.frames.back().bodies[1].point.position - run.frames.back().bodies[0].point.position;
    result.add("load below a trolley that slides down, angle [rad]" + with, std::atan2(-felt.x(), -felt.y()),
               "equilibrium in the trolley's frame", std::atan2(-rod.x(), -rod.y()), 1e-5);
    result.add("its rod [N]" + with, load * felt.norm(), "equilibrium in the trolley's frame",
               run.frames.back().connectors[0].force, 1e-2);
  }
  return result;
}

}  // namespace

std::vector<VerifyProblem> train_problems() {
  const std::string rigid = "rigid guides";
  return {{"train", rigid, train},
          {"train-friction", rigid, linked_friction},
          {"pendulum-trolley", rigid, pendulum_on_trolley},
          {"pendulum-slope", rigid, hanging_still}};
}

}  // namespace nurbeam
