#include "nurbs/smooth/moebius_change.h"

#include <algorithm>

#include "nurbs/golden_section.h"

namespace nurbeam::smooth {

namespace {

/// What the joint of two pieces asks of their charts: c_{j+1} = mu / (gamma - c_j). Theory, back to CAD, with
/// the lengths l measured by the speeds.
struct Joint {
  double mu, gamma;

  Joint(const Piece& left, const Piece& right) {
    const Eigen::Index p = left.degree();
    const double alpha = start_ratio(right), beta = end_ratio(left);
    mu = beta * leg(left, p - 1).norm() / (alpha * leg(right, 0).norm());
    gamma = beta + mu * alpha;
  }

  /// The c of the piece after it; nothing where no positive one does.
  std::optional<double> next(double c) const {
    constexpr double same = 1e-11;
    const double rest = gamma - c;
    if (!(rest > 0) || !std::isfinite(mu)) return std::nullopt;
    return c == 1 && std::abs(mu / rest - 1) < same ? 1 : mu / rest;
  }
};

/// The chart of `right` that makes it continue `left` in C1, in homogeneous coordinates if `right` has the
/// sense of it (they share their tangent); nothing where there is none. Delta_{j+1} = Delta_j c_j c_{j+1} /
/// mu.
std::optional<MoebiusChange> next_change(const Piece& left, const MoebiusChange& chart, const Piece& right) {
  const Joint joint(left, right);
  const std::optional<double> c = joint.next(chart.c);
  if (!c) return std::nullopt;
  return MoebiusChange{*c, chart.length * chart.c * *c / joint.mu};
}

/// The weights of pieces and the joints between them: what the charts of a run are chosen by, again and
/// again.
class Weights {
 public:
  Weights(const Pieces& pieces, int first, int last)
      : weights_(pieces[first].points.cols(), last - first + 1) {
    for (int j = first; j <= last; ++j) weights_.col(j - first) = pieces[j].points.row(3).transpose();
    for (int j = first; j < last; ++j) joints_.emplace_back(pieces[j], pieces[j + 1]);
  }

  /// The logarithm of the ratio of all weights of the pieces first..last in the charts that begin with c;
  /// nothing where there are none.
  std::optional<double> spread(int first, int last, double c) const {
    double low = never, high = -never, end = 0;
    for (int j = first; j <= last; ++j) {
      double factor = j == first ? 1 : end / weights_(0, j);
      for (Eigen::Index i = 0; i < weights_.rows(); ++i, factor *= c) {
        end = weights_(i, j) * factor;
        low = std::min(low, end);
        high = std::max(high, end);
      }
      if (j == last) break;
      const std::optional<double> next = joints_[j].next(c);
      if (!next) return std::nullopt;
      c = *next;
    }
    return std::log(high / low);
  }

  /// The c of the first piece with the least spread, and that spread, never where there is none.
  std::pair<double, double> mildest(int first, int last) const {
    constexpr int steps = 60;
    const auto spread_at = [&](double log_c) {
      return spread(first, last, std::exp(log_c)).value_or(1e3 + log_c);  // c was too large
    };
    const Eigen::RowVectorXd own = weights_.col(first).transpose();
    const double reach = widest_spread + smooth::spread(own);
    double log_c = minimum_place(spread_at, -reach, reach, steps);
    if (spread_at(0) <= spread_at(log_c) + 1e-9) log_c = 0;
    const double c = std::exp(log_c);
    return {c, spread(first, last, c).value_or(never)};
  }

 private:
  Eigen::MatrixXd weights_;  // a column for each piece
  std::vector<Joint> joints_;
};

/// The charts of the pieces first..last that begin with c, which has them.
std::vector<MoebiusChange> charts_from(const Pieces& pieces, int first, int last, double c) {
  return changes_of_run(pieces, first, last, {c, 1}, CurveParameter::free)
      .value_or(std::vector<MoebiusChange>{});
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
  const auto [c, spread] = Weights(pieces, first, last).mildest(0, last - first);
  if (!(spread <= widest_spread)) return std::nullopt;
  return charts_from(pieces, first, last, c);
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
  const Weights weights(pieces, 0, count - 1);
  std::vector<bool> smooth(pieces.size());  // with the piece after it
  for (int j = 0; j + 1 < count; ++j) smooth[j] = share_tangent(pieces[j], pieces[j + 1], tolerance);
  const auto cost = [&](int first, int last) {
    if (!std::all_of(smooth.begin() + first, smooth.begin() + last, [](bool joins) { return joins; }))
      return never;
    return weights.mildest(first, last).second;
  };
  const std::vector<int> starts = fewest_runs(count, cost, widest_spread);
  std::vector<MoebiusChange> charts;
  for (std::size_t i = 0; i + 1 < starts.size(); ++i) {
    const int first = starts[i];
    const int last = starts[i + 1] - 1;
    const std::vector<MoebiusChange> run =
        charts_from(pieces, first, last, weights.mildest(first, last).first);
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
