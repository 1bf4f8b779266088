#include "nurbs/full_knots.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <utility>

namespace nurbeam {
namespace {

/// Knots and control points that may not be a curve yet.
struct Run {
  std::vector<double> knots;
  Eigen::Matrix4Xd points;
};

/// The control points `first` to before `last` with their knots.
Run part_of(const Run& spline, int degree, std::ptrdiff_t first, std::ptrdiff_t last) {
  return {{spline.knots.begin() + first, spline.knots.begin() + last + degree + 1},
          spline.points.middleCols(first, last - first)};
}

/// The runs between the knots that stand degree + 1 times or more often; those too short for a curve have no
/// part of it.
std::vector<Run> runs_of(const Run& spline, int degree) {
  const std::vector<double>& knots = spline.knots;
  std::vector<Run> runs;
  std::ptrdiff_t first = 0;  // control point
  for (auto at = knots.begin(); at != knots.end();) {
    const auto after = std::upper_bound(at, knots.end(), *at);
    const std::ptrdiff_t index = at - knots.begin(), times = after - at;
    at = after;
    if (times <= degree) continue;
    if (index - first > degree) runs.push_back(part_of(spline, degree, first, index));
    first = index + times - degree - 1;
  }
  if (spline.points.cols() - first > degree)
    runs.push_back(part_of(spline, degree, first, spline.points.cols()));
  return runs;
}

/// Both as one, the second with the weight of the first where they meet.
Run joined(Run before, const Run& after, int degree) {
  const Eigen::Index n = before.points.cols(), m = after.points.cols();
  before.knots.pop_back();
  before.knots.insert(before.knots.end(), after.knots.begin() + degree + 1, after.knots.end());
  before.points.conservativeResize(4, n + m - 1);
  before.points.rightCols(m - 1) =
      before.points(3, n - 1) / after.points(3, 0) * after.points.rightCols(m - 1);
  return before;
}

void check_counts(int degree, std::size_t knots, Eigen::Index points) {
  if (degree >= 1 && static_cast<Eigen::Index>(knots) == points + degree + 1) return;
  throw std::invalid_argument("there are " + std::to_string(points) + " control points and " +
                              std::to_string(knots) + " knots; a curve of degree " + std::to_string(degree) +
                              " has degree + 1 knots more than control points");
}

}  // namespace

std::vector<NurbsCurve> split_at_full_knots(int degree, const std::vector<double>& knots,
                                            const Eigen::Matrix4Xd& control_points) {
  check_counts(degree, knots.size(), control_points.cols());
  const std::vector<Run> runs = std::is_sorted(knots.begin(), knots.end())
                                    ? runs_of({knots, control_points}, degree)
                                    : std::vector<Run>();
  if (runs.empty()) return {NurbsCurve(KnotVector(degree, knots), control_points)};  // says what is wrong
  const Eigen::Matrix3Xd places = control_points.colwise().hnormalized();
  const double size = (places.colwise() - places.col(0)).cwiseAbs().maxCoeff();
  const auto meet = [&](const Run& before, const Run& after) {
    return (before.points.rightCols<1>().hnormalized() - after.points.col(0).hnormalized()).norm() <=
           1e-9 * size;
  };
  std::vector<Run> chains;
  for (const Run& run : runs)
    if (!chains.empty() && meet(chains.back(), run))
      chains.back() = joined(std::move(chains.back()), run, degree);
    else
      chains.push_back(run);
  std::vector<NurbsCurve> curves;
  for (Run& chain : chains)
    curves.emplace_back(KnotVector(degree, std::move(chain.knots)), std::move(chain.points));
  return curves;
}

}  // namespace nurbeam
