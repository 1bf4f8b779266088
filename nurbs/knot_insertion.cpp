#include "nurbs/knot_insertion.h"

#include <stdexcept>
#include <string>

#include "nurbs/number_text.h"

namespace nurbeam {

namespace {

// Q_i = alpha_i P_i + (1 - alpha_i) P_{i-1}, alpha_i = (u - u_i) / (u_{i+p} - u_i) on i = k-p+1, ..., k.
NurbsCurve with_one_knot(const NurbsCurve& curve, double u) {
  const int p = curve.degree(), k = curve.knots().find_span(u);
  const std::vector<double>& knots = curve.knots().knots();
  const Eigen::Matrix4Xd& P = curve.control_points();
  Eigen::Matrix4Xd Q(4, P.cols() + 1);
  for (int i = 0; i < Q.cols(); ++i) {
    if (i <= k - p) {
      Q.col(i) = P.col(i);
    } else if (i > k) {
      Q.col(i) = P.col(i - 1);
    } else {
      const double alpha = (u - knots[i]) / (knots[i + p] - knots[i]);
      Q.col(i) = alpha * P.col(i) + (1 - alpha) * P.col(i - 1);
    }
  }
  std::vector<double> more = knots;
  more.insert(more.begin() + k + 1, u);
  return {KnotVector(p, std::move(more)), Q};
}

}  // namespace

NurbsCurve with_knot(const NurbsCurve& curve, double u, int times) {
  const KnotVector& knots = curve.knots();
  if (!(u > knots.start() && u < knots.end()))
    throw std::invalid_argument("the knot " + text_of(u) + " must lie between " + text_of(knots.start()) +
                                " and " + text_of(knots.end()) + ", the ends of the curve");
  if (times < 1)
    throw std::invalid_argument("the knot " + text_of(u) + " is to be inserted " + std::to_string(times) +
                                " times; must be at least 1");
  const int most = knots.degree() - knots.multiplicity(u);
  if (times > most)
    throw std::invalid_argument("the knot " + text_of(u) + " cannot be inserted " + std::to_string(times) +
                                " times; it stands " + std::to_string(knots.multiplicity(u)) +
                                " times, and a curve of degree " + std::to_string(knots.degree()) +
                                " has no knot more often than that");
  NurbsCurve result = curve;
  for (int i = 0; i < times; ++i) result = with_one_knot(result, u);
  return result;
}

}  // namespace nurbeam
