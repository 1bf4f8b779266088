#pragma once
#include <Eigen/Core>

namespace nurbeam {

/// The axial strain of one element, assumed as the quadratic that has the end values and the mean of the
/// pointwise strain eps: with l = s_B - s_A, xi = (s - s_A)/l and I = int eps ds,
///
///   eps_hat = c0 + c1 (2 xi - 1) + c2 (6 xi^2 - 6 xi + 1),   c0 = I/l,  c1 = (eps_B - eps_A)/2,
///   c2 = (eps_A + eps_B)/2 - c0.
///
/// Two conditions an element, on four (in space six) new unknowns: it can bend without stretching, where the
/// pointwise strain, a quartic, leaves nothing for bending as EA L^2/EI grows.
struct AssumedStrain {
  double c0 = 0, c1 = 0, c2 = 0;

  AssumedStrain(double integral, double at_a, double at_b, double length)
      : c0(integral / length), c1((at_b - at_a) / 2), c2((at_a + at_b) / 2 - c0) {}

  double at(double xi) const { return c0 + c1 * (2 * xi - 1) + c2 * (6 * xi * (xi - 1) + 1); }
  /// What a section carries: without c2, which is the residue of bending and no force.
  double carried(double xi) const { return c0 + c1 * (2 * xi - 1); }
  /// int eps_hat ds over [xi_1, xi_2] divided by l.
  double mean_part(double xi_1, double xi_2) const {
    const auto antiderivative = [this](double x) {
      return x * (c0 + c1 * (x - 1) + c2 * (2 * x * x - 3 * x + 1));
    };
    return antiderivative(xi_2) - antiderivative(xi_1);
  }
};

/// The axial energy of an element, U = EA l/2 (c0^2 + c1^2/3 + c2^2/5) [J], as a function of
/// y = (I, eps_A, eps_B, l), with its gradient and Hessian.
class AssumedAxialEnergy {
 public:
  double value;
  Eigen::Vector4d gradient;  ///< the first: the axial force (mean, less the residue of bending) [N]

  AssumedAxialEnergy(double EA, const Eigen::Vector4d& y) : EA_(EA), l_(y[3]), c_(y[0], y[1], y[2], y[3]) {
    const double m = c_.c0, odd = c_.c1 * c_.c1 / 3, even = c_.c2 * c_.c2 / 5;
    value = EA * l_ / 2 * (m * m + odd + even);
    gradient << m - c_.c2 / 5, l_ * (c_.c2 / 10 - c_.c1 / 6), l_ * (c_.c2 / 10 + c_.c1 / 6),
        (odd + even - m * m) / 2 + c_.c2 * m / 5;
    gradient *= EA;
  }

  Eigen::Matrix4d hessian() const {
    const double l = l_, m = c_.c0;
    const double by_a = c_.c2 / 10 - c_.c1 / 6 + m / 10, by_b = c_.c2 / 10 + c_.c1 / 6 + m / 10;
    Eigen::Matrix4d H;
    H << 1.2 / l, -0.1, -0.1, -1.2 * m / l,  //
        -0.1, l * 2 / 15, -l / 30, by_a,     //
        -0.1, -l / 30, l * 2 / 15, by_b,     //
        -1.2 * m / l, by_a, by_b, 1.2 * m * m / l;
    return EA_ * H;
  }

 private:
  double EA_, l_;
  AssumedStrain c_;
};

/// Kelvin-Voigt damping of the assumed strain with viscosity c EA: the generalised stress c H x' of
/// x = (I, eps_A, eps_B), H the Hessian above, and its derivatives. Dissipated: x' . stress [W] >= 0.
struct AssumedAxialDamping {
  Eigen::Vector3d stress;
  Eigen::Matrix3d by_rate;
  Eigen::Vector3d by_length;

  AssumedAxialDamping(double viscosity, double l, const Eigen::Vector3d& rate) {
    by_rate << 1.2 / l, -0.1, -0.1, -0.1, l * 2 / 15, -l / 30, -0.1, -l / 30, l * 2 / 15;
    by_rate *= viscosity;
    stress = by_rate * rate;
    by_length = viscosity * Eigen::Vector3d(-1.2 / (l * l) * rate[0], rate[1] * 2 / 15 - rate[2] / 30,
                                            rate[2] * 2 / 15 - rate[1] / 30);
  }
};

}  // namespace nurbeam
