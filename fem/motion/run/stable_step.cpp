#include "fem/motion/run/stable_step.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "solver/algebra/eigenpairs.h"
#include "solver/system/tangent_matrix.h"

namespace nurbeam {

double longest_explicit_step(const BeamSystem& system, const State& state) {
  const int n = system.coordinate_count();
  const auto tangent = [&](const TangentWeights& weights) { return tangent_matrix(system, state, weights); };
  const Eigen::SparseMatrix<double> K = tangent({.stiffness = 1}).topLeftCorner(n, n);
  const std::optional<Eigenpairs> fastest = largest_eigenpairs(K, tangent({.mass = 1}), 1);
  constexpr double never = std::numeric_limits<double>::infinity();
  if (!fastest || fastest->values.size() == 0 || !(fastest->values[0] > 0)) return never;
  // The root of larger magnitude of lambda^2 + d lambda + omega^2 = 0; x'M x = 1.
  const double omega = std::sqrt(fastest->values[0]);
  const Eigen::VectorXd x = fastest->vectors.col(0);
  const Eigen::SparseMatrix<double> D = tangent({.damping = 1}).topLeftCorner(n, n);
  const double half = std::max(0.0, x.dot(D * x) / 2);
  const double magnitude = half > omega ? half + std::sqrt(half * half - omega * omega) : omega;
  constexpr double reach =
      2.78;  // reach of the region of stability: 2.785 along the real axis, 2.828 along the imaginary one
  return reach / magnitude;
}

double first_step(const BeamModel& model, double end_time) {
  double quickest = std::numeric_limits<double>::infinity();
  for (const Beam& beam : model.beams) {
    const double length = beam.curve.length();
    if (!beam.rigid)
      quickest = std::min(quickest, std::sqrt(beam.properties.mass_per_length * length /
                                              beam.properties.stiffness_of_length(length)));
  }
  return std::isinf(quickest) ? end_time / 1e5 : std::min(quickest / 2000, end_time / 100);
}

}  // namespace nurbeam
