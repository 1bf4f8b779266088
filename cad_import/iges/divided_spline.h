#pragma once
#include <string>
#include <vector>

namespace nurbeam {

/// A B-spline of IGES (126) that a knot inside divides.
struct DividedSpline {
  double knot;                                   ///< the first that does
  double widest;                                 ///< the gap between two of its pieces [unit of the file]
  std::vector<std::vector<std::string>> pieces;  ///< the values of each
};

/// The pieces that a spline with these values and knots falls into where a knot inside stands more often than
/// its degree and its ends are apart there; no pieces where it is one curve, or none at all. All values up to
/// V(1) must be there.
DividedSpline divided_spline(const std::vector<std::string>& values, const std::vector<double>& knots);

/// A number with all its digits, as IGES writes reals.
std::string iges_real(double value);

}  // namespace nurbeam
