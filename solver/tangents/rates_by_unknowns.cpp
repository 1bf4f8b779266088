#include "solver/tangents/rates_by_unknowns.h"

#include <algorithm>
#include <cmath>

namespace nurbeam {

Eigen::MatrixXd rates_by_unknowns(const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& quantities,
                                  const Eigen::VectorXd& x, const Eigen::VectorXd& steps) {
  using Vector = Eigen::VectorXd;
  const Vector present = quantities(x);
  Eigen::MatrixXd by = Eigen::MatrixXd::Zero(x.size(), present.size());
  const auto where_one_changes = [&](Eigen::Index i, double part) {
    Vector other = x;
    other[i] += part * steps[i];
    return quantities(other);
  };
  // The unknowns change by uneven numbers of steps, so that no effects cancel.
  const auto change_something = [&](Eigen::Index first, Eigen::Index end) {
    Vector other = x;
    for (Eigen::Index i = first; i < end; ++i) other[i] += (1 + static_cast<double>(i % 7) / 8) * steps[i];
    return quantities(other) != present;
  };
  // The largest relative change of a quantity.
  const auto change = [&](const Vector& found) {
    double most = 0;
    for (Eigen::Index j = 0; j < found.size(); ++j)
      if (present[j] != 0) most = std::fmax(most, std::abs((found[j] - present[j]) / present[j]));
    return most;
  };
  const auto rates = [&](Eigen::Index i) -> Vector {
    constexpr double little = 1e-3, least = 1e-3;
    double part = 1;
    Vector more = where_one_changes(i, part);
    for (double most = change(more); most > little && part > least; most = change(more)) {
      part = std::max(least, std::min(0.5, little / most) * part);
      more = where_one_changes(i, part);
    }
    return (8 * (more - where_one_changes(i, -part)) -
            (where_one_changes(i, 2 * part) - where_one_changes(i, -2 * part))) /
           (12 * part * steps[i]);
  };
  const std::function<void(Eigen::Index, Eigen::Index)> find = [&](Eigen::Index first, Eigen::Index end) {
    if (!change_something(first, end)) return;
    constexpr Eigen::Index few = 4;
    if (end - first > few) {
      find(first, (first + end) / 2);
      return find((first + end) / 2, end);
    }
    for (Eigen::Index i = first; i < end; ++i) by.row(i) = rates(i);
  };
  if (x.size() > 0) find(0, x.size());
  return by;
}

}  // namespace nurbeam
