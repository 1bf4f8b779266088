#pragma once
#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "nurbs/bezier.h"
#include "nurbs/smooth/smooth_nurbs.h"

/// Pieces of a curve under way to one NURBS, and the Moebius changes of their parameters.
namespace nurbeam::smooth {

constexpr double never = std::numeric_limits<double>::infinity();
/// Largest ratio of the weights of pieces that are joined: more makes the parameter uneven and costs digits.
const double widest_spread = std::log(20.0);

using Points = BezierPoints;

/// Piece of the curve under way.
struct Piece {
  Points points;
  double length;         // of its interval of the parameter
  double deviation = 0;  // bound on the distance from the source [m]

  Eigen::Index degree() const { return points.cols() - 1; }
  double weight(Eigen::Index i) const { return points(3, i); }
};
using Pieces = std::vector<Piece>;

/// w_1 / w_0 and w_{p-1} / w_p.
inline double start_ratio(const Piece& piece) { return piece.weight(1) / piece.weight(0); }
inline double end_ratio(const Piece& piece) {
  return piece.weight(piece.degree() - 1) / piece.weight(piece.degree());
}

/// How a piece is run through: w_i -> c^i w_i on an interval of this length (theory.md, back to CAD: c_j and
/// Delta_j).
struct MoebiusChange {
  double c;
  double length;
};

Eigen::Vector3d leg(const Piece& piece, Eigen::Index i);

/// The charts of the pieces first..last in a run that begins with `start`.
std::optional<std::vector<MoebiusChange>> changes_of_run(const Pieces& pieces, int first, int last,
                                                         const MoebiusChange& start,
                                                         CurveParameter parameter);

/// Whether two pieces share their tangent so well that a double knot moves nothing by more than tolerance.
bool share_tangent(const Piece& left, const Piece& right, double tolerance);

/// The charts of the pieces first..last, which share their tangents, that make them C1 in homogeneous
/// coordinates with the least ratio of weights; nothing where that is not mild.
std::optional<std::vector<MoebiusChange>> mild_changes(const Pieces& pieces, int first, int last);

/// The pieces first.. in their charts, each scaled so that its first weight is the last one before it.
Pieces changed(const Pieces& pieces, int first, const std::vector<MoebiusChange>& charts);

double spread(const Eigen::RowVectorXd& weights);

/// Charts of all pieces: homogeneous C1 as far as the tangents and mild weights allow, C1 of the speed where
/// only the weights forbid more.
std::vector<MoebiusChange> free_changes(const Pieces& pieces, double tolerance);

/// Cuts 0..count-1 into the fewest runs of consecutive ones with cost(first, last) <= bound, and these into
/// runs of the lowest bound that does not need more of them. cost grows with the run; one alone is always a
/// run. Returns the first of each run, and count.
template <typename Cost>
std::vector<int> fewest_runs(int count, const Cost& cost, double bound) {
  const auto greedy = [&](double most) {
    std::vector<int> starts{0};
    while (starts.back() < count) {
      const int first = starts.back();
      int good = first, step = 1;  // first..good is a run
      while (good + step < count && cost(first, good + step) <= most) good += std::exchange(step, 2 * step);
      for (; step > 0; step /= 2)
        if (good + step < count && cost(first, good + step) <= most) good += step;
      starts.push_back(good + 1);
    }
    return starts;
  };
  std::vector<int> best = greedy(bound);
  const bool cut = best.size() > 2 && int(best.size()) < count + 1;
  double low = 0, high = bound;
  for (int i = 0; cut && i < 20; ++i) {
    const double middle = 0.5 * (low + high);
    std::vector<int> runs = greedy(middle);
    const bool enough = runs.size() == best.size();
    (enough ? high : low) = middle;
    if (enough) best = std::move(runs);
  }
  return best;
}

}  // namespace nurbeam::smooth
