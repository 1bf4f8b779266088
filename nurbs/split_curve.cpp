#include "nurbs/split_curve.h"

#include <algorithm>
#include <utility>

#include "nurbs/knot_insertion.h"

namespace nurbeam {
namespace {

/// Both sides of a parameter strictly inside the curve.
std::pair<NurbsCurve, NurbsCurve> cut(const NurbsCurve& whole, double u) {
  const int p = whole.degree(), missing = p - whole.knots().multiplicity(u);
  const NurbsCurve curve = missing > 0 ? with_knot(whole, u, missing) : whole;
  const std::vector<double>& knots = curve.knots().knots();
  const auto first = std::lower_bound(knots.begin(), knots.end(), u);  // of p
  const auto k = static_cast<int>(first - knots.begin());
  std::vector<double> before(knots.begin(), first + p), after(first, knots.end());
  before.push_back(u);
  after.insert(after.begin(), u);
  const Eigen::Matrix4Xd& points = curve.control_points();
  return {NurbsCurve(KnotVector(p, std::move(before)), points.leftCols(k)),
          NurbsCurve(KnotVector(p, std::move(after)), points.rightCols(points.cols() - k + 1))};
}

}  // namespace

std::vector<NurbsCurve> split_at(const NurbsCurve& curve, std::vector<double> parameters) {
  std::sort(parameters.begin(), parameters.end());
  std::vector<NurbsCurve> pieces{curve};
  for (const double u : parameters) {
    const KnotVector& knots = pieces.back().knots();
    if (!(u > knots.start() && u < knots.end())) continue;
    auto [before, after] = cut(pieces.back(), u);
    pieces.back() = std::move(before);
    pieces.push_back(std::move(after));
  }
  return pieces;
}

}  // namespace nurbeam
