#pragma once
#include <functional>

/// Closed forms and integrals that know no beam element, to compare with.
namespace nurbeam::verification {

/// The root of an increasing function between lo and hi: regula falsi, Illinois variant.
double root(const std::function<double(double)>& f, double lo, double hi);

struct Tip {
  double x, y;  ///< of a cantilever of unit length that is drawn from (0, 0) to (1, 0)
};

/// Inextensible cantilever rolled up by an end moment, m = M L/EI: an arc of angle m.
Tip roll_up_tip(double m);

/// Inextensible cantilever under a dead tip load across it, downwards, q = P L^2/EI; Mattiasson (1981).
Tip elastica_tip(double q);

/// A cantilever of unit length and bending stiffness that stretches, axial stiffness EA (Green's law: the
/// force is EA lambda (lambda^2 - 1)/2 at the stretch lambda), under a dead tip load q downwards: theta' = M,
/// M' = lambda q cos(theta), r' = lambda (cos, sin)(theta), by shooting and Runge-Kutta. Drawn as an arc that
/// turns upwards where kappa_0 [1/m] is not 0: theta' = kappa_0 + M.
Tip stretching_elastica_tip(double EA, double q, double kappa_0 = 0);

struct StringShape {
  double x = 0, y = 0, axial_energy = 0;
};

/// A string of weight w [N/m] with the Green law T = EA lambda (lambda^2 - 1)/2, hanging from its ends.
struct StringLaw {
  double EA, w;

  double stretch(double T) const;
  /// From a point where the vertical force is V, up along its reference length; H is the horizontal force.
  StringShape shape(double H, double V, double length) const;
};

struct Hanging {
  double H, V;  ///< horizontal force, and vertical force at the start, against the weight [N]
};

/// A string between (0, 0) and (span, rise).
Hanging hang(const StringLaw& law, double length, double span, double rise);

/// Horizontal force of an inextensible string of length S between supports X apart, one d above the other:
/// S^2 - d^2 = (2 a sinh(X/2a))^2, H = a w.
double inextensible_pull(double S, double X, double d, double w);

/// Midspan deflection of a simply supported beam under a force that crosses it in unit time, over the static
/// one P L^3/48EI, while the force is on it; alpha = (v L/pi) sqrt(rho A/EI). Fryba's series.
double midspan_ratio(double alpha, double tau);
/// The largest one.
double largest_midspan_ratio(double alpha);

}  // namespace nurbeam::verification
