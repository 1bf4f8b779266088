#include "nurbs/smooth/rejoin.h"

#include <Eigen/LU>
#include <algorithm>

namespace nurbeam::smooth {

namespace {

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
std::optional<std::vector<MoebiusChange>> centred_changes(const Pieces& pieces, int first, int last) {
  const int middle = (first + last) / 2;
  const MoebiusChange start{balance(pieces[middle].points), 1};
  Pieces before(pieces.begin() + first, pieces.begin() + middle + 1);
  std::reverse(before.begin(), before.end());
  for (Piece& piece : before) piece.points.rowwise().reverseInPlace();
  const auto backward = changes_of_run(before, 0, middle - first, {1 / start.c, 1}, CurveParameter::free);
  const auto forward = changes_of_run(pieces, middle, last, start, CurveParameter::free);
  if (!backward || !forward) return std::nullopt;
  std::vector<MoebiusChange> charts(backward->rbegin(), backward->rend());
  for (MoebiusChange& chart : charts) chart.c = 1 / chart.c;
  charts.insert(charts.end(), forward->begin() + 1, forward->end());
  return charts;
}

/// The one Bezier curve that the pieces first..last are, if they are one.
std::optional<Piece> rejoined(const Pieces& pieces, int first, int last, CurveParameter parameter,
                              double tolerance) {
  const auto charts = parameter == CurveParameter::free
                          ? centred_changes(pieces, first, last)
                          : changes_of_run(pieces, first, last, {1, pieces[first].length}, parameter);
  if (!charts) return std::nullopt;
  Pieces all = changed(pieces, first, *charts);
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

}  // namespace

Points balanced(Points points) {
  const double c = balance(points);
  double factor = 1;
  for (Eigen::Index i = 0; i < points.cols(); ++i, factor *= c) points.col(i) *= factor;
  return points;
}

Pieces rejoined(const Pieces& pieces, Eigen::Index degree, CurveParameter parameter, double widest,
                double tolerance) {
  const int count = static_cast<int>(pieces.size());
  std::vector<bool> one(pieces.size());  // with the piece after it
  for (int j = 0; j + 1 < count; ++j) one[j] = rejoined(pieces, j, j + 1, parameter, tolerance).has_value();
  const auto cost = [&](int first, int last) {
    if (!std::all_of(one.begin() + first, one.begin() + last, [](bool joins) { return joins; })) return never;
    const auto piece = rejoined(pieces, first, last, parameter, tolerance);
    return piece ? spread(elevated(balanced(piece->points), degree).row(3)) : never;
  };
  const std::vector<int> starts = fewest_runs(count, cost, widest);
  Pieces result;
  for (std::size_t i = 0; i + 1 < starts.size(); ++i) {
    const int first = starts[i], last = starts[i + 1] - 1;
    result.push_back(first == last ? pieces[first] : *rejoined(pieces, first, last, parameter, tolerance));
  }
  return result;
}

}  // namespace nurbeam::smooth
