#include "nurbs/smooth/smooth_nurbs.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <utility>

#include "nurbs/bezier.h"
#include "nurbs/golden_section.h"

namespace nurbeam {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();
/// Largest ratio of the weights of pieces that are joined: more would cost digits.
const double widest_spread = std::log(100.0);

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

/// How a piece is run through: w_i -> c^i w_i on an interval of this length (theory.md section 9: c_j and
/// Delta_j).
struct Chart {
  double c;
  double length;
};

/// The curve of degree - 1 nearest to this one (the one it is, if there is one).
Points reduced(const Points& points) {
  if (points.cols() == 3) return (Points(4, 2) << points.col(0), points.col(2)).finished();
  const Eigen::Vector4d middle = 0.25 * (3 * (points.col(1) + points.col(2)) - points.col(0) - points.col(3));
  return (Points(4, 3) << points.col(0), middle, points.col(3)).finished();
}

Eigen::Vector3d leg(const Piece& piece, Eigen::Index i) {
  return piece.points.col(i + 1).hnormalized() - piece.points.col(i).hnormalized();
}

/// The chart of `right` that makes it continue `left` in C1, in homogeneous coordinates if `right` has the
/// sense of it (they share their tangent); nothing where no positive c does. Theory section 9 with the
/// lengths l measured by the speeds: c_{j+1} = mu / (gamma - c_j), Delta_{j+1} = Delta_j c_j c_{j+1} / mu.
std::optional<Chart> next_chart(const Piece& left, const Chart& chart, const Piece& right) {
  constexpr double same = 1e-11;
  const Eigen::Index p = left.degree();
  const double alpha = right.weight(1) / right.weight(0), beta = left.weight(p - 1) / left.weight(p);
  const double mu = beta * leg(left, p - 1).norm() / (alpha * leg(right, 0).norm());
  const double rest = beta + mu * alpha - chart.c;
  if (!(rest > 0) || !std::isfinite(mu)) return std::nullopt;
  const bool keeps = chart.c == 1 && std::abs(mu / rest - 1) < same;
  const double c = keeps ? 1 : mu / rest;
  return Chart{c, chart.length * chart.c * c / mu};
}

/// The charts of the pieces first..last in a run that begins with `start`.
std::optional<std::vector<Chart>> run_charts(const Pieces& pieces, int first, int last, const Chart& start,
                                             CurveParameter parameter) {
  std::vector<Chart> charts{start};
  for (int j = first; j < last; ++j) {
    const auto next = parameter == CurveParameter::material
                          ? std::optional(Chart{1, pieces[j + 1].length})
                          : next_chart(pieces[j], charts.back(), pieces[j + 1]);
    if (!next) return std::nullopt;
    charts.push_back(*next);
  }
  return charts;
}

/// The pieces first.. in their charts, each scaled so that its first weight is the last one before it.
Pieces charted(const Pieces& pieces, int first, const std::vector<Chart>& charts) {
  Pieces result(pieces.begin() + first, pieces.begin() + first + int(charts.size()));
  for (std::size_t j = 0; j < result.size(); ++j) {
    Points& points = result[j].points;
    double factor = j == 0 ? 1 : result[j - 1].points(3, points.cols() - 1) / points(3, 0);
    for (Eigen::Index i = 0; i < points.cols(); ++i, factor *= charts[j].c) points.col(i) *= factor;
    result[j].length = charts[j].length;
  }
  return result;
}

double spread(const Eigen::RowVectorXd& weights) {
  return weights.minCoeff() > 0 ? std::log(weights.maxCoeff() / weights.minCoeff()) : never;
}

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

// ---------------------------------------------------------------------------------------------- degree

/// The pieces written with the lowest degree that they all have.
Pieces of_lowest_degree(Pieces pieces, double tolerance) {
  while (pieces.front().degree() > 1) {
    Pieces lower = pieces;
    for (Piece& piece : lower) {
      const Points points = reduced(piece.points);
      piece.deviation += distance_bound(piece.points, elevated(points, piece.degree()));
      if (!(piece.deviation <= tolerance)) return pieces;
      piece.points = points;
    }
    pieces = std::move(lower);
  }
  return pieces;
}

// ---------------------------------------------------------------------------------------------- rejoining

/// The Bezier curve with the ends of the pieces in their charts, its inner points from the end derivatives
/// (for a quadratic the mean of both).
Piece spanning(const Pieces& all) {
  Piece one{Points(4, all[0].points.cols()), 0};
  for (const Piece& piece : all) one.length += piece.length;
  const Eigen::Index p = one.degree();
  const Points &front = all.front().points, &back = all.back().points;
  const double to_front = one.length / all.front().length, to_back = one.length / all.back().length;
  const Eigen::Vector4d second = front.col(0) + to_front * (front.col(1) - front.col(0));
  const Eigen::Vector4d last_but_one = back.col(p) - to_back * (back.col(p) - back.col(p - 1));
  if (p == 1)
    one.points << front.col(0), back.col(1);
  else if (p == 2)
    one.points << front.col(0), 0.5 * (second + last_but_one), back.col(2);
  else
    one.points << front.col(0), second, last_but_one, back.col(3);
  return one;
}

/// Corrects the inner points of the curve by least squares over the Bezier points of all pieces.
void fit_inner_points(const Pieces& all, Piece& one) {
  const Eigen::Index p = one.degree();
  if (p < 2) return;
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(p - 1, p - 1);
  Eigen::MatrixXd residual = Eigen::MatrixXd::Zero(4, p - 1);
  double begin = 0;
  for (const Piece& piece : all) {
    const double end = begin + piece.length;
    // Column i holds what each point of the whole contributes to point i of the part.
    const Points shares = part(Points::Identity(4, p + 1), begin / one.length, end / one.length);
    const auto inner = shares.middleRows(1, p - 1);
    normal += inner * inner.transpose();
    residual += (piece.points - one.points * shares.topRows(p + 1)) * inner.transpose();
    begin = end;
  }
  one.points.middleCols(1, p - 1) += residual * normal.inverse();
}

/// Moves the joints of the pieces to where on the curve they lie: lengths from leg to leg add up their
/// round-off.
void fit_joints(const Piece& one, Pieces& all) {
  const Eigen::Index p = one.degree();
  double sum = 0, moved_before = 0;
  for (std::size_t j = 0; j + 1 < all.size(); ++j) {
    sum += all[j].length;
    const Points around = part(one.points, sum / one.length, 1);
    const Eigen::Vector4d slope = double(p) * (around.col(1) - around.col(0)) / (one.length - sum);
    const double moved = slope.dot(all[j].points.col(p) - around.col(0)) / slope.squaredNorm();
    all[j].length += moved - moved_before;
    moved_before = moved;
  }
  all.back().length -= moved_before;
}

/// Gives the pieces the weights that the curve has at their ends: products of charts add up their round-off.
void fit_weights(const Piece& one, Pieces& all) {
  const Eigen::Index p = one.degree();
  double begin = 0;
  for (Piece& piece : all) {
    const double end = begin + piece.length;
    const Points there = part(one.points, begin / one.length, end / one.length);
    double factor = there(3, 0) / piece.weight(0);
    const double c = std::pow(there(3, p) / piece.weight(p) / factor, 1.0 / double(p));
    for (Eigen::Index i = 0; i <= p; ++i, factor *= c) piece.points.col(i) *= factor;
    begin = end;
  }
}

/// The change w_i -> c^i w_i that makes the weights at both ends equal.
double balance(const Points& points) {
  const Eigen::Index p = points.cols() - 1;
  return std::pow(points(3, 0) / points(3, p), 1.0 / double(p));
}

/// The charts of the pieces first..last from that of the one in the middle on, its weights balanced: of an
/// arc they hold for half a turn to either side.
std::optional<std::vector<Chart>> centred_charts(const Pieces& pieces, int first, int last) {
  const int middle = (first + last) / 2;
  const Chart start{balance(pieces[middle].points), 1};
  Pieces before(pieces.begin() + first, pieces.begin() + middle + 1);
  std::reverse(before.begin(), before.end());
  for (Piece& piece : before) piece.points.rowwise().reverseInPlace();
  const auto backward = run_charts(before, 0, middle - first, {1 / start.c, 1}, CurveParameter::free);
  const auto forward = run_charts(pieces, middle, last, start, CurveParameter::free);
  if (!backward || !forward) return std::nullopt;
  std::vector<Chart> charts(backward->rbegin(), backward->rend());
  for (Chart& chart : charts) chart.c = 1 / chart.c;
  charts.insert(charts.end(), forward->begin() + 1, forward->end());
  return charts;
}

/// The one Bezier curve that the pieces first..last are, if they are one.
std::optional<Piece> rejoined(const Pieces& pieces, int first, int last, CurveParameter parameter,
                              double tolerance) {
  const auto charts = parameter == CurveParameter::free
                          ? centred_charts(pieces, first, last)
                          : run_charts(pieces, first, last, {1, pieces[first].length}, parameter);
  if (!charts) return std::nullopt;
  Pieces all = charted(pieces, first, *charts);
  Piece one = spanning(all);
  fit_inner_points(all, one);
  if (parameter == CurveParameter::free) {
    fit_joints(one, all);
    fit_weights(one, all);
    fit_inner_points(all, one);
  }
  double begin = 0;
  for (const Piece& piece : all) {
    if (!(piece.length > 0)) return std::nullopt;
    const double end = begin + piece.length;
    const double far = piece.deviation +
                       distance_bound(piece.points, part(one.points, begin / one.length, end / one.length));
    if (!(far <= tolerance)) return std::nullopt;
    one.deviation = std::max(one.deviation, far);
    begin = end;
  }
  return one;
}

Points balanced(Points points) {
  const double c = balance(points);
  double factor = 1;
  for (Eigen::Index i = 0; i < points.cols(); ++i, factor *= c) points.col(i) *= factor;
  return points;
}

/// The pieces with those of one Bezier curve made one again, as far as the weights stay mild when it is
/// written with this degree.
Pieces rejoined(const Pieces& pieces, Eigen::Index degree, CurveParameter parameter, double tolerance) {
  const int count = static_cast<int>(pieces.size());
  std::vector<bool> one(pieces.size());  // with the piece after it
  for (int j = 0; j + 1 < count; ++j) one[j] = rejoined(pieces, j, j + 1, parameter, tolerance).has_value();
  const auto cost = [&](int first, int last) {
    if (!std::all_of(one.begin() + first, one.begin() + last, [](bool joins) { return joins; })) return never;
    const auto piece = rejoined(pieces, first, last, parameter, tolerance);
    return piece ? spread(elevated(balanced(piece->points), degree).row(3)) : never;
  };
  const std::vector<int> starts = fewest_runs(count, cost, widest_spread);
  Pieces result;
  for (std::size_t i = 0; i + 1 < starts.size(); ++i) {
    const int first = starts[i], last = starts[i + 1] - 1;
    result.push_back(first == last ? pieces[first] : *rejoined(pieces, first, last, parameter, tolerance));
  }
  return result;
}

// ---------------------------------------------------------------------------------------------- charts

/// Whether two pieces share their tangent so well that a double knot moves nothing by more than tolerance.
bool share_tangent(const Piece& left, const Piece& right, double tolerance) {
  const Eigen::Vector3d a = leg(left, left.degree() - 1), b = leg(right, 0);
  const double shorter = std::min(a.norm(), b.norm());
  return shorter > 0 && (a.normalized() - b.normalized()).norm() * shorter <= tolerance;
}

/// Charts of the pieces first..last, C1 in homogeneous coordinates, with the least ratio of weights; and the
/// logarithm of that ratio.
std::pair<double, std::vector<Chart>> mildest_charts(const Pieces& pieces, int first, int last) {
  constexpr int steps = 60;
  const auto spread_at = [&](double log_c) {
    const auto charts = run_charts(pieces, first, last, {std::exp(log_c), 1}, CurveParameter::free);
    if (!charts) return 1e3 + log_c;  // c was too large
    double low = never, high = -never;
    for (const Piece& piece : charted(pieces, first, *charts)) {
      low = std::min(low, piece.points.row(3).minCoeff());
      high = std::max(high, piece.points.row(3).maxCoeff());
    }
    return std::log(high / low);
  };
  const double reach = widest_spread + spread(pieces[first].points.row(3));
  double log_c = minimum_place(spread_at, -reach, reach, steps);
  if (spread_at(0) <= spread_at(log_c) + 1e-9) log_c = 0;
  const auto charts = run_charts(pieces, first, last, {std::exp(log_c), 1}, CurveParameter::free);
  return {charts ? spread_at(log_c) : never, charts.value_or(std::vector<Chart>{})};
}

/// Charts of all pieces: homogeneous C1 as far as the tangents and mild weights allow, C1 of the speed where
/// only the weights forbid more.
std::vector<Chart> free_charts(const Pieces& pieces, double tolerance) {
  const int count = static_cast<int>(pieces.size());
  std::vector<bool> smooth(pieces.size());  // with the piece after it
  for (int j = 0; j + 1 < count; ++j) smooth[j] = share_tangent(pieces[j], pieces[j + 1], tolerance);
  const auto cost = [&](int first, int last) {
    if (!std::all_of(smooth.begin() + first, smooth.begin() + last, [](bool joins) { return joins; }))
      return never;
    return mildest_charts(pieces, first, last).first;
  };
  const std::vector<int> starts = fewest_runs(count, cost, widest_spread);
  std::vector<Chart> charts;
  for (std::size_t i = 0; i + 1 < starts.size(); ++i) {
    const int first = starts[i];
    std::vector<Chart> run = mildest_charts(pieces, first, starts[i + 1] - 1).second;
    double scale = 1;
    if (first > 0) {
      // r' of the piece before at its end is p beta leg / (c Delta), that of this one at its start
      // p alpha c leg / Delta.
      const Piece &left = pieces[first - 1], &right = pieces[first];
      const Eigen::Index p = left.degree();
      const double before = left.weight(p - 1) / left.weight(p) * leg(left, p - 1).norm() /
                            (charts.back().c * charts.back().length);
      const double after =
          right.weight(1) / right.weight(0) * leg(right, 0).norm() * run[0].c / run[0].length;
      scale = after / before;
      if (!(scale > 1e-6 && scale < 1e6)) scale = 1;
    }
    for (const Chart& chart : run) charts.push_back({chart.c, chart.length * scale});
  }
  return charts;
}

// ---------------------------------------------------------------------------------------------- assembly

/// Distance in space of two homogeneous points of nearly the same weight, with what their weights differ by.
double mismatch(const Eigen::Vector4d& a, const Eigen::Vector4d& b, double size) {
  return (a.hnormalized() - b.hnormalized()).norm() + size * std::abs(a(3) - b(3)) / std::abs(a(3));
}

/// The largest k < degree for which two pieces in their charts join in C^k, in homogeneous coordinates.
int continuity(const Piece& left, const Piece& right, double tolerance) {
  const Eigen::Index p = left.degree();
  const double size = leg(left, p - 1).norm() + leg(right, 0).norm();
  const double share = left.length / (left.length + right.length);
  // The joint lies on the line between its neighbours.
  const Eigen::Vector4d between = (1 - share) * left.points.col(p - 1) + share * right.points.col(1);
  if (p < 2 || !(mismatch(left.points.col(p), between, size) <= tolerance)) return 0;
  if (p < 3) return 1;
  // f(t_j, t_{j-1}, t_{j+1}) from both sides.
  const Eigen::Vector4d from_left = left.points.col(1) + (left.points.col(2) - left.points.col(1)) / share;
  const Eigen::Vector4d from_right =
      right.points.col(2) + (right.points.col(1) - right.points.col(2)) / (1 - share);
  return mismatch(from_left, from_right, size) <= tolerance ? 2 : 1;
}

/// The knots of pieces that begin at `start`, each joint with the multiplicity that its continuity needs.
std::vector<double> knots_of(const Pieces& pieces, const std::vector<int>& orders, double start) {
  const int p = static_cast<int>(pieces[0].degree());
  std::vector<double> knots(p + 1, start);
  for (std::size_t j = 0; j < pieces.size(); ++j) {
    start += pieces[j].length;
    knots.insert(knots.end(), j < orders.size() ? p - orders[j] : p + 1, start);
  }
  return knots;
}

/// The B-spline of the pieces: control point i is f(t_{i+1}, ..., t_{i+p}), the mean of the values from all
/// pieces that lie among these knots.
NurbsCurve assembled(const Pieces& pieces, const std::vector<int>& orders, double start) {
  const int p = static_cast<int>(pieces[0].degree());
  KnotVector knots(p, knots_of(pieces, orders, start));
  const std::vector<double>& t = knots.knots();
  const std::vector<double> breaks = knots.breaks();
  Points points(4, knots.control_point_count());
  for (int i = 0; i < points.cols(); ++i) {
    const double low = t[i + 1], high = t[i + p];
    const auto at = std::lower_bound(breaks.begin(), breaks.end(), low) - breaks.begin();
    int j = std::min<int>(int(at), int(pieces.size()) - 1), count = 0;
    Eigen::Vector4d sum = Eigen::Vector4d::Zero();
    do {
      std::vector<double> arguments(t.begin() + i + 1, t.begin() + i + p + 1);
      const double a = breaks[j], b = breaks[j + 1];
      for (double& u : arguments) u = u == b ? 1 : (u - a) / (b - a);
      sum += blossom(pieces[j].points, arguments);
      ++count;
      ++j;
    } while (j < int(pieces.size()) && breaks[j] < high);
    points.col(i) = sum / count;
  }
  constexpr double round_off = 1e-13;
  if (spread(points.row(3)) < round_off) {
    for (int i = 0; i < 3; ++i) points.row(i).array() /= points.row(3).array();
    points.row(3).setOnes();
  }
  return {std::move(knots), std::move(points)};
}

/// Bounds on the distances between the pieces and the curve made of them.
std::vector<double> deviations(const NurbsCurve& curve, const Pieces& pieces) {
  const std::vector<double> breaks = curve.knots().breaks();
  std::vector<double> bounds;
  for (std::size_t j = 0; j < pieces.size(); ++j)
    bounds.push_back(
        pieces[j].deviation +
        distance_bound(pieces[j].points, curve.bezier_points(curve.knots().find_span(breaks[j]))));
  return bounds;
}

/// The curve of the pieces with the fewest knots that keep it within the tolerance.
SmoothNurbs with_fewest_knots(const Pieces& pieces, double start, double tolerance) {
  std::vector<int> orders;
  for (std::size_t j = 0; j + 1 < pieces.size(); ++j)
    orders.push_back(continuity(pieces[j], pieces[j + 1], tolerance));
  while (true) {
    NurbsCurve curve = assembled(pieces, orders, start);
    const std::vector<double> bounds = deviations(curve, pieces);
    bool lowered = false;
    for (std::size_t j = 0; j < pieces.size(); ++j) {
      if (bounds[j] <= tolerance) continue;
      for (const std::size_t joint : {j - 1, j})
        if (joint < orders.size() && orders[joint] > 0) {
          --orders[joint];
          lowered = true;
        }
    }
    if (!lowered) return {std::move(curve), *std::max_element(bounds.begin(), bounds.end())};
  }
}

/// The curve of the pieces, written with this degree, that begins at the parameter `start`.
SmoothNurbs joined(Pieces pieces, Eigen::Index degree, double start, CurveParameter parameter,
                   double tolerance) {
  const auto sum = [](double all, const auto& part) { return all + part.length; };
  const double length = std::accumulate(pieces.begin(), pieces.end(), 0.0, sum);
  pieces = rejoined(pieces, degree, parameter, 0.5 * tolerance);
  for (Piece& piece : pieces)
    if (piece.degree() < degree) piece.points = elevated(balanced(piece.points), degree);
  if (parameter == CurveParameter::free) {
    std::vector<Chart> charts = free_charts(pieces, tolerance);
    const double scale = length / std::accumulate(charts.begin(), charts.end(), 0.0, sum);
    for (Chart& chart : charts) chart.length *= scale;
    pieces = charted(pieces, 0, charts);
  } else {
    pieces =
        charted(pieces, 0, *run_charts(pieces, 0, int(pieces.size()) - 1, {1, pieces[0].length}, parameter));
  }
  return with_fewest_knots(pieces, start, tolerance);
}

/// The number of interior knots where the curve is only C0 in homogeneous coordinates.
int full_knots(const NurbsCurve& curve) {
  const std::vector<double> breaks = curve.knots().breaks();
  return static_cast<int>(std::count_if(breaks.begin() + 1, breaks.end() - 1, [&](double u) {
    return curve.knots().multiplicity(u) >= curve.degree();
  }));
}

NurbsCurve shifted(const NurbsCurve& curve, const Eigen::Vector3d& by) {
  Points points = curve.control_points();
  points.topRows<3>() += by * curve.control_points().row(3);
  return {curve.knots(), std::move(points)};
}

}  // namespace

SmoothNurbs smooth_nurbs(const BezierPath& path, CurveParameter parameter, double tolerance) {
  if (path.segments.empty())
    throw std::invalid_argument("a path without segments is no curve; give at least one segment");
  // Measured from the start, so that a curve far from the origin keeps its digits.
  const Eigen::Vector3d origin = path.segments.front().control_point(0);
  Pieces pieces;
  for (std::size_t j = 0; j < path.segments.size(); ++j) {
    Points points = path.segments[j].points() / path.segments[j].weight(0);
    points.topRows<3>() -= (origin * points.row(3)).eval();
    pieces.push_back({std::move(points), path.breaks[j + 1] - path.breaks[j]});
  }
  const Pieces lowest = of_lowest_degree(std::move(pieces), 0.25 * tolerance);
  const double start = path.breaks.front();
  SmoothNurbs smooth = joined(lowest, lowest[0].degree(), start, parameter, tolerance);
  // A whole circle of degree 2 is not C1 throughout; of degree 3 it can be, with no more control points.
  if (parameter == CurveParameter::free && lowest[0].degree() == 2 && full_knots(smooth.curve) > 0) {
    SmoothNurbs cubic = joined(lowest, 3, start, parameter, tolerance);
    if (full_knots(cubic.curve) < full_knots(smooth.curve) &&
        cubic.curve.control_points().cols() <= smooth.curve.control_points().cols())
      smooth = std::move(cubic);
  }
  smooth.curve = shifted(smooth.curve, origin);
  return smooth;
}

}  // namespace nurbeam
