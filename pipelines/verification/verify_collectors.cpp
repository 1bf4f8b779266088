// Collectors that press on a wavy guide, against the equations of their masses.

#include <Eigen/Dense>
#include <cmath>
#include <complex>
#include <numbers>
#include <string>

#include "nurbs/number_text.h"
#include "pipelines/verification/rope_cases.h"
#include "pipelines/verification/verify.h"

namespace nurbeam {

namespace {

using namespace verification;
using std::numbers::pi;

constexpr double frame = 15, head = 7.2, base_stiffness = 50, base_damping = 90, head_stiffness = 4200,
                 head_damping = 10, contact = 50e3, lift = 120;

/// Of the contact force, where the wire goes up and down with an amplitude and an angular frequency.
double force_amplitude(double amplitude, double omega) {
  using Complex = std::complex<double>;
  const Complex i(0, 1), k1 = base_stiffness + i * omega * base_damping,
                         k2 = head_stiffness + i * omega * head_damping, a = k1 + k2 - frame * omega * omega,
                         d = k2 + contact - head * omega * omega;
  return std::abs(contact * (contact * amplitude * a / (a * d - k2 * k2) - amplitude));
}

/// A guide z = A sin(2 pi x/l), and the collector of EN 50318 below it for 15 s, after which its start has
/// died away.
std::string wavy_case(double amplitude, double length, double speed, double end) {
  const int periods = static_cast<int>(std::ceil(speed * end / length)) + 1, points = 40;
  std::string axis;
  for (int i = 0; i <= periods * points; ++i) {
    const double x = length * i / points;
    axis += (i ? ", [" : "[") + text_of(x, 16) + ", 0, " +
            text_of(amplitude * std::sin(2 * pi * x / length), 16) + "]";
  }
  return R"({ "nurbeam": 1, "beams": [{ "name": "wire", "rigid": true, "axis": { "through": [)" + axis +
         R"(] } }], "collectors": [{ "name": "pan", "beam": "wire", "at": "start", "travel": [1, 0, 0],
         "motion": { "speed": )" +
         text_of(speed, 16) + R"( }, "masses": [15, 7.2], "stiffness": [50, 4200], "damping": [90, 10],
         "force": 120, "contact": { "stiffness": 50000 } }], "analysis": { "initial": "equilibrium", "end_time": )" +
         text_of(end) + R"(, "step": 1e-3 }, "output": { "every": 0.01 } })";
}

/// Mean and amplitude of the contact force over the last 2 s.
VerifyResult wavy_guide() {
  VerifyResult result;
  const double mean = lift / (1 + base_stiffness * (1 / head_stiffness + 1 / contact));
  struct Wave {
    double length, amplitude, speed;
  };
  for (const Wave& wave : {Wave{50, 0.01, 50}, Wave{10, 0.003, 50}, Wave{6.5, 0.001, 250 / 3.6}}) {
    const double omega = 2 * pi * wave.speed / wave.length, end = 15;
    const RunRecord run = run_text(wavy_case(wave.amplitude, wave.length, wave.speed, end));
    // Least squares for mean, cosine and sine.
    Eigen::Matrix3d products = Eigen::Matrix3d::Zero();
    Eigen::Vector3d sums = Eigen::Vector3d::Zero();
    for (const Snapshot& moment : run.frames) {
      if (moment.time < end - 2) continue;
      const Eigen::Vector3d shape(1, std::cos(omega * moment.time), std::sin(omega * moment.time));
      products += shape * shape.transpose();
      sums -= moment.connectors.back().force * shape;
    }
    const Eigen::Vector3d wave_of_force = products.ldlt().solve(sums);
    const std::string where =
        " on waves of " + text_of(wave.length) + " m at " + text_of(wave.speed, 4) + " m/s [N]";
    result.add("mean contact force" + where, mean, "springs in a row", wave_of_force[0], 1e-4 * mean);
    const double amplitude = force_amplitude(wave.amplitude, omega);
    result.add("amplitude of the contact force" + where, amplitude, "equations of two masses",
               wave_of_force.tail<2>().norm(), 5e-3 * amplitude);
  }
  return result;
}

}  // namespace

std::vector<VerifyProblem> collector_problems() { return {{"collector-waves", "rigid guide", wavy_guide}}; }

}  // namespace nurbeam
