#pragma once
#include <Eigen/Core>
#include <array>
#include <variant>

#include "fem/material/section.h"

namespace nurbeam {

/// The axial strain of one element, assumed as the quadratic that has the end values and the mean of the
/// pointwise strain eps: with l = s_B - s_A, xi = (s - s_A)/l and I = int eps ds,
///
///   eps_hat = c0 + c1 (2 xi - 1) + c2 (6 xi^2 - 6 xi + 1),   c0 = I/l,  c1 = (eps_B - eps_A)/2,
///   c2 = (eps_A + eps_B)/2 - c0.
///
/// Two conditions an element, on four (in space six) new unknowns: it can bend without stretching, where the
/// pointwise strain, a quartic, leaves nothing for bending as EA L^2/EI grows. The end values are those of
/// AssumedEnds where a slope belongs to the element alone.
template <class T>
struct AssumedStrainOf {
  T c0, c1, c2;

  NURBEAM_WITHIN AssumedStrainOf(const T& integral, const T& at_a, const T& at_b, const T& length)
      : c0(integral / length), c1((at_b - at_a) / 2.), c2((at_a + at_b) / 2. - c0) {}

  NURBEAM_WITHIN T at(double xi) const { return c0 + (2 * xi - 1) * c1 + (6 * xi * (xi - 1) + 1) * c2; }
  /// The strain that gives the axial force of a section: without c2, which is a residue of bending and no
  /// force.
  double carried(double xi) const { return c0 + c1 * (2 * xi - 1); }
  /// int eps_hat ds over [xi_1, xi_2] divided by l.
  double mean_part(double xi_1, double xi_2) const {
    const auto antiderivative = [this](double x) {
      return x * (c0 + c1 * (x - 1) + c2 * (2 * x * x - 3 * x + 1));
    };
    return antiderivative(xi_2) - antiderivative(xi_1);
  }
};
using AssumedStrain = AssumedStrainOf<double>;

/// The ends of an element whose slope belongs to no other element: a free end.
struct OwnSlopes {
  bool at_a = false, at_b = false;

  int count() const { return static_cast<int>(at_a) + static_cast<int>(at_b); }
  bool operator==(const OwnSlopes&) const = default;
};

/// The Legendre coefficients of the pointwise strain over an element, e_k = (2k + 1)/l int eps P_k(2 xi - 1)
/// ds.
template <class T>
using StrainCoefficients = std::array<T, 5>;

/// The weights in e_0..e_4 of the strain at a point s of an element that begins at s_a and is l long;
/// `weight` is that of the point in an integral over the element [m].
template <class T>
StrainCoefficients<T> strain_weights(const T& s, const T& weight, const T& s_a, const T& l) {
  const T x = 2. * ((s - s_a) / l) - 1., square = x * x, part = weight / l;
  return {part, 3. * (part * x), 2.5 * (part * (3. * square - 1.)), 3.5 * (part * (x * (5. * square - 3.))),
          1.125 * (part * (square * (35. * square - 30.) + 3.))};
}

/// The end values of the assumed strain as sums over (eps_A, eps_B, e_0, e_1, e_2). Where an element shares
/// its slope the value is that of eps. The stress that goes with it, on the slope alone, is balanced by the
/// next element. On a slope of the element's own nothing would balance it: where the axial force falls along
/// the element it pushes, and a rope that hangs freely would curl up. There the first moment of eps takes the
/// place of the end value,
///
///   c1 = e_1,  c2 = eps_A - c0 + c1 (own slope at B),  c2 = eps_B - c0 - c1 (at A),  c2 = e_2 (at both).
template <class T>
struct AssumedEnds {
  std::array<T, 5> a, b;
};
inline AssumedEnds<double> assumed_ends(const OwnSlopes& own) {
  if (own.at_a && own.at_b) return {{0, 0, 1, -1, 1}, {0, 0, 1, 1, 1}};
  if (own.at_a) return {{0, 1, 0, -2, 0}, {0, 1, 0, 0, 0}};
  if (own.at_b) return {{1, 0, 0, 0, 0}, {1, 0, 0, 2, 0}};
  return {{1, 0, 0, 0, 0}, {0, 1, 0, 0, 0}};
}

/// Means over an element of psi and its derivatives at eps_hat, times the functions phi in
/// eps_hat = phi_0 I/l + phi_A eps_A + phi_B eps_B: phi_0 = 6 xi (1 - xi), phi_A = (1 - xi)(1 - 3 xi),
/// phi_B = xi (3 xi - 2).
template <class T>
struct AxialMeans {
  T energy;                        ///< mean of psi [J/m]
  T by_0, by_a, by_b;              ///< means of psi' phi [N]
  T m00, m0a, m0b, maa, mab, mbb;  ///< means of psi'' phi phi [N]
};

/// The means of a linear law in closed form, with stress = `stiffness` times strain.
template <class T>
NURBEAM_WITHIN AxialMeans<T> linear_axial_means(double stiffness, const AssumedStrainOf<T>& strain) {
  const auto& [c0, c1, c2] = strain;
  const T on_end = filled<T>(stiffness * 2 / 15), on_both = filled<T>(-0.1 * stiffness);
  return {stiffness / 2 * (c0 * c0 + c1 * c1 / 3. + c2 * c2 / 5.),
          stiffness * (c0 - c2 / 5.),
          stiffness * (c2 / 10. - c1 / 6.),
          stiffness * (c2 / 10. + c1 / 6.),
          filled<T>(1.2 * stiffness),
          on_both,
          on_both,
          on_end,
          filled<T>(-stiffness / 30),
          on_end};
}

/// The means of the beam's law at a strain less the free strain, by the quadrature `Rule` where the law is
/// not linear. `buckling`: the compressive strain at which an element buckles, if its beam does.
template <class Rule, class T>
NURBEAM_WITHIN AxialMeans<T> axial_means(const BeamProperties& beam, const AssumedStrainOf<T>& strain,
                                         double free, const T& buckling) {
  const bool buckles = beam.compression == Compression::buckles;
  if (std::holds_alternative<GreenLaw>(beam.law) && !buckles)
    return linear_axial_means(beam.axial_stiffness, strain);
  AxialMeans<T> sum{zero<T>(), zero<T>(), zero<T>(), zero<T>(), zero<T>(),
                    zero<T>(), zero<T>(), zero<T>(), zero<T>(), zero<T>()};
  for (int g = 0; g < Rule::size; ++g) {
    const double xi = Rule::points[g], w = Rule::weights[g];
    const double of_0 = 6 * xi * (1 - xi), of_a = (1 - xi) * (1 - 3 * xi), of_b = xi * (3 * xi - 2);
    const AxialPoint<T> point =
        buckles ? buckling_point<T>(beam.law, beam.axial_stiffness, strain.at(xi), free, buckling)
                : axial_point<T>(beam.law, beam.axial_stiffness, strain.at(xi), free);
    sum.energy += w * point.energy;
    sum.by_0 += w * of_0 * point.force;
    sum.by_a += w * of_a * point.force;
    sum.by_b += w * of_b * point.force;
    sum.m00 += w * of_0 * of_0 * point.stiffness;
    sum.m0a += w * of_0 * of_a * point.stiffness;
    sum.m0b += w * of_0 * of_b * point.stiffness;
    sum.maa += w * of_a * of_a * point.stiffness;
    sum.mab += w * of_a * of_b * point.stiffness;
    sum.mbb += w * of_b * of_b * point.stiffness;
  }
  return sum;
}

/// The means of the damping stress at these strain rates; all laws are damped as Green's law is.
template <class T>
NURBEAM_WITHIN AxialMeans<T> viscous_axial_means(const BeamProperties& beam, const AssumedStrainOf<T>& rate) {
  return linear_axial_means(beam.damping * beam.axial_stiffness, rate);
}

/// The axial energy of an element, U = l times the mean of psi(eps_hat) [J], as a function of
/// y = (I, eps_A, eps_B, l), with its gradient and Hessian. Of Green's law: EA l/2 (c0^2 + c1^2/3 + c2^2/5).
class AssumedAxialEnergy {
 public:
  double value;
  Eigen::Vector4d gradient;  ///< entry 0: the axial force (mean, less the residue of bending) [N]

  AssumedAxialEnergy(const AxialMeans<double>& means, const Eigen::Vector4d& y) : means_(means), y_(y) {
    const double mean = y[0] / y[3];
    value = y[3] * means.energy;
    gradient << means.by_0, y[3] * means.by_a, y[3] * means.by_b, means.energy - mean * means.by_0;
  }

  Eigen::Matrix4d hessian() const {
    const double l = y_[3], mean = y_[0] / l;
    const auto& m = means_;
    const double by_I = -mean * m.m00 / l, by_a = m.by_a - mean * m.m0a, by_b = m.by_b - mean * m.m0b;
    Eigen::Matrix4d H;
    H << m.m00 / l, m.m0a, m.m0b, by_I,     //
        m.m0a, l * m.maa, l * m.mab, by_a,  //
        m.m0b, l * m.mab, l * m.mbb, by_b,  //
        by_I, by_a, by_b, mean * mean * m.m00 / l;
    return H;
  }

 private:
  AxialMeans<double> means_;
  Eigen::Vector4d y_;
};

/// The axial energy of an element by its beam's law.
template <class Rule>
AssumedAxialEnergy assumed_axial_energy(const BeamProperties& beam, const Eigen::Vector4d& y, double free,
                                        double buckling = 0) {
  return {axial_means<Rule>(beam, AssumedStrain(y[0], y[1], y[2], y[3]), free, buckling), y};
}

/// Kelvin-Voigt damping of the assumed strain with viscosity c EA: the generalised stress c H x' of
/// x = (I, eps_A, eps_B), H the Hessian of Green's law, and its derivatives. Dissipated: x' . stress [W] >=
/// 0.
struct AssumedAxialDamping {
  Eigen::Vector3d stress;
  Eigen::Matrix3d by_rate;
  Eigen::Vector3d by_length;

  AssumedAxialDamping(const BeamProperties& beam, double l, const Eigen::Vector3d& rate) {
    const AssumedAxialEnergy linear(viscous_axial_means(beam, AssumedStrain(rate[0], rate[1], rate[2], l)),
                                    {rate[0], rate[1], rate[2], l});
    const Eigen::Matrix4d H = linear.hessian();
    stress = linear.gradient.head<3>();
    by_rate = H.topLeftCorner<3, 3>();
    by_length = H.topRightCorner<3, 1>();
  }
};

}  // namespace nurbeam
