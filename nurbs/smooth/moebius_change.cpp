#include "nurbs/smooth/moebius_change.h"

#include <algorithm>

#include "nurbs/golden_section.h"

namespace nurbeam::smooth {

namespace {

/// The chart of `right` that makes it continue `left` in C1, in homogeneous coordinates if `right` has the
/// sense of it (they share their tangent); nothing where no positive c does. Theory, back to CAD, with the
/// lengths l measured by the speeds: c_{j+1} = mu / (gamma - c_j), Delta_{j+1} = Delta_j c_j c_{j+1} / mu.
std::optional<MoebiusChange> next_change(const Piece& left, const MoebiusChange& chart, const Piece& right) {
  constexpr double same = 1e-11;
  const Eigen::Index p = left.degree();
  const double alpha = right.weight(1) / right.weight(0), beta = left.weight(p - 1) / left.weight(p);
  const double mu = beta * leg(left, p - 1).norm() / (alpha * leg(right, 0).norm());
  const double rest = beta + mu * alpha - chart.c;
  if (!(rest > 0) || !std::isfinite(mu)) return std::nullopt;
  const bool keeps = chart.c == 1 && std::abs(mu / rest - 1) < same;
  const double c = keeps ? 1 : mu / rest;
  return MoebiusChange{c, chart.length * chart.c * c / mu};
}

/// Charts of the pieces first..last, C1 in homogeneous coordinates, with the least ratio of weights; and the
/// logarithm of that ratio.
std::pair<double, std::vector<MoebiusChange>> mildest_changes(const Pieces& pieces, int first, int last) {
  constexpr int steps = 60;
  const auto spread_at = [&](double log_c) {
    const auto charts = changes_of_run(pieces, first, last, {std::exp(log_c), 1}, CurveParameter::free);
    if (!charts) return 1e3 + log_c;  // c was too large
    double low = never, high = -never;
    for (const Piece& piece : changed(pieces, first, *charts)) {
      low = std::min(low, piece.points.row(3).minCoeff());
      high = std::max(high, piece.points.row(3).maxCoeff());
    }
    return std::log(high / low);
  };
  const double reach = widest_spread + spread(pieces[first].points.row(3));
  double log_c = minimum_place(spread_at, -reach, reach, steps);
  if (spread_at(0) <= spread_at(log_c) + 1e-9) log_c = 0;
  const auto charts = changes_of_run(pieces, first, last, {std::exp(log_c), 1}, CurveParameter::free);
  return {charts ? spread_at(log_c) : never, charts.value_or(std::vector<MoebiusChange>{})};
}

}  // namespace

Eigen::Vector3d leg(const Piece& piece, Eigen::Index i) {
  return piece.points.col(i + 1).hnormalized() - piece.points.col(i).hnormalized();
}

std::optional<std::vector<MoebiusChange>> changes_of_run(const Pieces& pieces, int first, int last,
                                                         const MoebiusChange& start,
                                                         CurveParameter parameter) {
  std::vector<MoebiusChange> charts{start};
  for (int j = first; j < last; ++j) {
    const auto next = parameter == CurveParameter::material
                          ? std::optional(MoebiusChange{1, pieces[j + 1].length})
                          : next_change(pieces[j], charts.back(), pieces[j + 1]);
    if (!next) return std::nullopt;
    charts.push_back(*next);
  }
  return charts;
}

bool share_tangent(const Piece& left, const Piece& right, double tolerance) {
  const Eigen::Vector3d a = leg(left, left.degree() - 1), b = leg(right, 0);
  const double shorter = std::min(a.norm(), b.norm());
  return shorter > 0 && (a.normalized() - b.normalized()).norm() * shorter <= tolerance;
}

std::optional<std::vector<MoebiusChange>> mild_changes(const Pieces& pieces, int first, int last) {
  auto [spread, changes] = mildest_changes(pieces, first, last);
  if (!(spread <= widest_spread)) return std::nullopt;
  return std::move(changes);
}

Pieces changed(const Pieces& pieces, int first, const std::vector<MoebiusChange>& charts) {
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

std::vector<MoebiusChange> free_changes(const Pieces& pieces, double tolerance) {
  const int count = static_cast<int>(pieces.size());
  std::vector<bool> smooth(pieces.size());  // with the piece after it
  for (int j = 0; j + 1 < count; ++j) smooth[j] = share_tangent(pieces[j], pieces[j + 1], tolerance);
  const auto cost = [&](int first, int last) {
    if (!std::all_of(smooth.begin() + first, smooth.begin() + last, [](bool joins) { return joins; }))
      return never;
    return mildest_changes(pieces, first, last).first;
  };
  const std::vector<int> starts = fewest_runs(count, cost, widest_spread);
  std::vector<MoebiusChange> charts;
  for (std::size_t i = 0; i + 1 < starts.size(); ++i) {
    const int first = starts[i];
    std::vector<MoebiusChange> run = mildest_changes(pieces, first, starts[i + 1] - 1).second;
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
    for (const MoebiusChange& chart : run) charts.push_back({chart.c, chart.length * scale});
  }
  return charts;
}

}  // namespace nurbeam::smooth
