#include "nurbs/curve_vertices.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <numeric>

namespace nurbeam {
namespace {

using Cell = std::array<std::int64_t, 3>;

Cell cell_of(const Eigen::Vector3d& point, double size) {
  Cell cell;
  for (int i = 0; i < 3; ++i) cell[i] = std::llround(point[i] / size);
  return cell;
}

/// Groups of points: each point knows one of its group, the first points know themselves.
class Groups {
 public:
  explicit Groups(std::size_t count) : parents_(count) { std::iota(parents_.begin(), parents_.end(), 0); }
  int first_of(int i) {
    while (parents_[i] != i) i = parents_[i] = parents_[parents_[i]];
    return i;
  }
  void unite(int i, int j) {
    i = first_of(i);
    j = first_of(j);
    parents_[std::max(i, j)] = std::min(i, j);
  }

 private:
  std::vector<int> parents_;
};

/// Unites the point with all earlier ones within the tolerance: they lie in its cell of the grid or in one of
/// the 26 neighbours. A point that is there already, to the last bit, is not entered again.
void unite_with_neighbours(int i, const std::vector<Eigen::Vector3d>& points, double tolerance, double size,
                           std::map<Cell, std::vector<int>>& cells, Groups& groups) {
  const Cell home = cell_of(points[i], size);
  bool is_new = true;
  for (int k = 0; k < 27; ++k) {
    const auto found = cells.find({home[0] + k % 3 - 1, home[1] + k / 3 % 3 - 1, home[2] + k / 9 - 1});
    if (found == cells.end()) continue;
    for (int j : found->second) {
      if ((points[j] - points[i]).norm() <= tolerance) groups.unite(i, j);
      is_new = is_new && points[j] != points[i];
    }
  }
  if (is_new) cells[home].push_back(i);
}

}  // namespace

std::vector<Eigen::Vector3d> end_points(const std::vector<NurbsCurve>& curves) {
  std::vector<Eigen::Vector3d> points;
  for (const NurbsCurve& curve : curves) {
    points.push_back(curve.point(curve.knots().start()));
    points.push_back(curve.point(curve.knots().end()));
  }
  return points;
}

std::vector<CurveVertex> vertices_of(const std::vector<NurbsCurve>& curves, double tolerance) {
  const std::vector<Eigen::Vector3d> points = end_points(curves);
  double size = std::numeric_limits<double>::min();
  for (const Eigen::Vector3d& point : points) size = std::max(size, point.cwiseAbs().maxCoeff());
  const double cell_size = std::max(tolerance, 1e-15 * size);  // numbers of cells are exact integers
  std::map<Cell, std::vector<int>> cells;
  Groups groups(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    unite_with_neighbours(static_cast<int>(i), points, tolerance, cell_size, cells, groups);
  std::vector<CurveVertex> vertices;
  std::vector<int> vertex_of_first(points.size(), -1);
  for (std::size_t i = 0; i < points.size(); ++i) {
    int& vertex = vertex_of_first[groups.first_of(static_cast<int>(i))];
    if (vertex < 0) {
      vertex = static_cast<int>(vertices.size());
      vertices.push_back({points[i], {}});
    }
    vertices[vertex].ends.push_back({static_cast<int>(i / 2), i % 2 == 1});
  }
  return vertices;
}

}  // namespace nurbeam
