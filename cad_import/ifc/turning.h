#pragma once
#include <functional>
#include <optional>
#include <vector>

namespace nurbeam {

/// How far the tangent of an element of an alignment in plan has turned [rad], to the left, at a distance
/// from the start of the element.
struct Turning {
  std::function<double(double)> angle;
  double sharpest = 0;              ///< the largest curvature, either way
  std::optional<double> even = {};  ///< the curvature, where that is the same everywhere
};

Turning even_turning(double curvature);

/// A curve whose curvature is a sum of powers, a cosine and a sine of its arc length s: c_0 + c_1 s + ... +
/// cosine cos(pi s / period) + sine sin(2 pi s / period).
struct Spiral {
  std::vector<double> powers = {};
  double cosine = 0, sine = 0;
  double period = 1;

  /// The angle of its tangent, from that at s = 0 [rad].
  double angle(double s) const;
};

/// Of the piece of a spiral that begins at `from` and has this length; with a negative one it runs backwards.
Turning turning_of(const Spiral& spiral, double from, double length);

/// A curve x(u), y(u) of powers of u.
struct PolynomialCurve {
  std::vector<double> x, y;

  double heading(double u) const;
  /// The parameter that lies an arc length s behind the parameter `from`. Throws std::runtime_error where the
  /// curve stands still.
  double parameter(double from, double s) const;
};

/// Of its piece from this parameter on; with a negative length it runs backwards.
Turning turning_of(const PolynomialCurve& curve, double from, double length);

}  // namespace nurbeam
