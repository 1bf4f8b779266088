#include "solver/rates_by_unknowns.h"

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
  // By unevenly many steps each, so that nothing cancels.
  const auto change_something = [&](Eigen::Index first, Eigen::Index end) {
    Vector other = x;
    for (Eigen::Index i = first; i < end; ++i) other[i] += (1 + static_cast<double>(i % 7) / 8) * steps[i];
    return quantities(other) != present;
  };
  const std::function<void(Eigen::Index, Eigen::Index)> find = [&](Eigen::Index first, Eigen::Index end) {
    if (!change_something(first, end)) return;
    constexpr Eigen::Index few = 4;
    if (end - first > few) {
      find(first, (first + end) / 2);
      return find((first + end) / 2, end);
    }
    for (Eigen::Index i = first; i < end; ++i)
      by.row(i) = (8 * (where_one_changes(i, 1) - where_one_changes(i, -1)) -
                   (where_one_changes(i, 2) - where_one_changes(i, -2))) /
                  (12 * steps[i]);
  };
  if (x.size() > 0) find(0, x.size());
  return by;
}

}  // namespace nurbeam
