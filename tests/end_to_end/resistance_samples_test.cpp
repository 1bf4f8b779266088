#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "cad_import/import_curves.h"
#include "tests/end_to_end/case_run.h"

namespace nurbeam::test {
namespace {

constexpr double gravity_of_samples = 9.81;

double speed_at(const CaseRun& run, std::size_t row, const std::string& body) {
  return run.value(row, body + ".speed [m/s]");
}

// What the rider has when the brake closes is what the way down gives, less what the air and the trolley's
// rolling take of it, both integrated from the histories, and what the cable has more than at the start: m
// v^2/2 = m g h - int (k v^3 + F v) dt - (E_cable - E_cable,0).
TEST(ResistanceSamples, TheRiderIsAsFastAsTheAirAndTheTrolleyLet) {
  const CaseRun run = run_file(sample("zip_ride/zip_ride.json"));
  ASSERT_EQ(run.code, 0) << run.messages;
  const double m = 90, k = 1.225 * 0.8 / 2, limit = 18.422098;  // of the straight slope of 12 degrees
  double taken = 0, fastest = 0;
  std::size_t last = 0;
  for (std::size_t i = 1; run.value(i, "time [s]") < 17; last = i++) {
    const double h = run.value(i, "time [s]") - run.value(i - 1, "time [s]");
    const auto power = [&](std::size_t row) {
      const double v = speed_at(run, row, "rider");
      return k * v * v * v + std::abs(run.value(row, "rider.friction_force [N]")) * v;
    };
    taken += h * (power(i) + power(i - 1)) / 2;
    fastest = std::max(fastest, speed_at(run, i, "rider"));
  }
  const double fallen = run.value(0, "rider.z [m]") - run.value(last, "rider.z [m]");
  const auto of_cable = [&](std::size_t row) {
    const double v = speed_at(run, row, "rider"), z = run.value(row, "rider.z [m]");
    return run.value(row, "energy.kinetic [J]") - m * v * v / 2 + run.value(row, "energy.axial [J]") +
           run.value(row, "energy.bending [J]") + run.value(row, "energy.gravity [J]") -
           m * gravity_of_samples * z;
  };
  const double v = std::sqrt(2 * (gravity_of_samples * fallen - (taken + of_cable(last) - of_cable(0)) / m));
  EXPECT_NEAR(speed_at(run, last, "rider"), v, 2e-3 * v);
  EXPECT_GT(std::abs(of_cable(last) - of_cable(0)), 0.01 * m * v * v / 2);
  EXPECT_NEAR(fastest, limit, 0.15 * limit);
  EXPECT_LT(run.last("rider.s [m]"), 291);
  EXPECT_LT(speed_at(run, run.rows.size() - 1, "rider"), 0.3);
}

// A body on a curve with friction, by Runge-Kutta in the curve's own parameter: no arc length, beam or guide.
struct OnCurve {
  const NurbsCurve& curve;
  double mu, u, v;  // v is positive where u grows

  struct Rates {
    double u, v;
  };
  Rates rates(double at, double speed) const {
    const KnotVector& knots = curve.knots();
    const double first = knots.knots().front(), period = knots.knots().back() - first;
    at = first + std::fmod(std::fmod(at - first, period) + period, period);
    const Eigen::Matrix3Xd d = curve.derivatives(at, 2);
    const double length = d.col(1).norm();
    const Eigen::Vector3d t = d.col(1) / length, g(0, 0, -gravity_of_samples);
    const Eigen::Vector3d bend = (d.col(2) - t * t.dot(d.col(2))) / (length * length);
    const Eigen::Vector3d across = g - t * t.dot(g) - speed * speed * bend;
    return {speed / length, t.dot(g) - (speed > 0 ? mu : -mu) * across.norm()};
  }
  OnCurve after(double h) const {
    const Rates a = rates(u, v), b = rates(u + h / 2 * a.u, v + h / 2 * a.v),
                c = rates(u + h / 2 * b.u, v + h / 2 * b.v), d = rates(u + h * c.u, v + h * c.v);
    OnCurve next = *this;
    next.u += h / 6 * (a.u + 2 * b.u + 2 * c.u + d.u);
    next.v += h / 6 * (a.v + 2 * b.v + 2 * c.v + d.v);
    return next;
  }
  // To where it turns round.
  void run_to_rest() {
    for (double h = 1e-3; h > 1e-9;) {
      const OnCurve next = after(h);
      if (next.v * v <= 0)
        h /= 2;
      else {
        u = next.u;
        v = next.v;
      }
    }
  }
};

TEST(ResistanceSamples, TheCarOnTheRailTurnsAndStaysWhereFrictionLets) {
  const CaseRun run = run_file(sample("rail_friction/rail_friction.json"));
  ASSERT_EQ(run.code, 0) << run.messages;
  const ImportReport file = import_curves(sample("roller_coaster/rail.step"));
  const auto rail = std::find_if(file.curves.begin(), file.curves.end(),
                                 [](const ImportedCurve& curve) { return curve.name == "Rail"; });
  ASSERT_NE(rail, file.curves.end());
  const NurbsCurve& curve = rail->curve;
  const double first = curve.knots().knots().front(), period = curve.knots().knots().back() - first;
  // From 3 % of the length on.
  const int parts = 20000;
  std::vector<double> length{0};
  const auto speed = [&](double u) { return curve.derivatives(u, 1).col(1).norm(); };
  for (int i = 0; i < parts; ++i)
    length.push_back(length.back() + period / parts * speed(first + (i + 0.5) * period / parts));
  const double start = 0.03 * length.back();
  const int i = static_cast<int>(std::upper_bound(length.begin(), length.end(), start) - length.begin()) - 1;
  OnCurve car{curve, 0.08, first + period / parts * (i + (start - length[i]) / (length[i + 1] - length[i])),
              1};
  EXPECT_NEAR((curve.point(car.u) - Eigen::Vector3d(run.value(0, "car.x [m]"), run.value(0, "car.y [m]"),
                                                    run.value(0, "car.z [m]")))
                  .norm(),
              0, 1e-4);
  const auto place = [&](std::size_t row) {
    return Eigen::Vector3d(run.value(row, "car.x [m]"), run.value(row, "car.y [m]"),
                           run.value(row, "car.z [m]"));
  };
  car.run_to_rest();
  std::size_t farthest = 0;
  for (std::size_t k = 0; k < run.rows.size(); ++k)
    if (run.value(k, "car.s [m]") > run.value(farthest, "car.s [m]")) farthest = k;
  EXPECT_LT((curve.point(car.u) - place(farthest)).norm(), 5e-3);
  car.v = -1e-9;
  car.run_to_rest();
  EXPECT_LT((curve.point(car.u) - place(run.rows.size() - 1)).norm(), 1e-2);
  EXPECT_EQ(run.last("car.stuck [1]"), 1);
}

}  // namespace
}  // namespace nurbeam::test
