#pragma once
#include <Eigen/Core>
#include <vector>

/// A string in a vertical plane as a boundary-value problem of its force, by shooting: an oracle that shares
/// nothing with the elements.
namespace nurbeam::verification {

/// The stretch lambda of a string with T = (tension + stiffness (lambda^2 - 1)/2) lambda.
double string_stretch(double tension, double stiffness, double T);

/// The force on the start of a string that hangs between two points in space under a weight per s along -z:
/// `chord` is the way from its start to its end. That on its end is this one's opposite, and the weight.
Eigen::Vector3d pull_of_string(const Eigen::Vector3d& chord, double length, double tension, double stiffness,
                               double weight);

/// A string on [0, length] of its label s with T = (tension + stiffness (lambda^2 - 1)/2) lambda, lambda the
/// stretch of s, from (0, 0) to (span, 0).
struct HangingString {
  double length, span;        ///< [m]
  double tension, stiffness;  ///< [N]
  double weight;              ///< per s [N/m]

  /// What pulls at a label: a force that stays, and a spring that only pulls, to a point.
  struct Pull {
    double s, force_z = 0;                                ///< [m], [N] upwards
    double stiffness = 0, free_length = 0, x = 0, z = 0;  ///< [N/m], [m]
  };
  std::vector<Pull> pulls = {};  ///< s increasing

  /// At one pull: place, what its spring pulls with and the tensions on both sides; the last is the end.
  struct AtPull {
    double x, z, spring, tension_before, tension_after;
  };
  struct Solution {
    double horizontal, vertical;  ///< of the force at the start [N]
    std::vector<AtPull> pulls;
  };
  Solution solve() const;

 private:
  std::vector<AtPull> shoot(const Eigen::VectorXd& unknowns) const;
  Eigen::VectorXd residual(const Eigen::VectorXd& unknowns) const;
};

}  // namespace nurbeam::verification
