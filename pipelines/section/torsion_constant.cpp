#include "pipelines/section/torsion_constant.h"

#include <Eigen/LU>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "nurbs/area_moments.h"
#include "pipelines/section/torsion_mesh.h"

namespace nurbeam {
namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Slopes = Eigen::Matrix<double, 6, 2>;

struct TrianglePoint {
  double xi, eta, weight;
};

/// Radon's rule of 7 points on the triangle (0,0), (1,0), (0,1): exact up to degree 5.
std::array<TrianglePoint, 7> radon_rule() {
  const double root = std::sqrt(15.0), a = (6 - root) / 21, b = (6 + root) / 21;
  const double at_a = (155 - root) / 2400, at_b = (155 + root) / 2400;
  return {{{1.0 / 3, 1.0 / 3, 9.0 / 80},
           {a, a, at_a},
           {1 - 2 * a, a, at_a},
           {a, 1 - 2 * a, at_a},
           {b, b, at_b},
           {1 - 2 * b, b, at_b},
           {b, 1 - 2 * b, at_b}}};
}

/// Calls use(r, shapes, slopes, area) at the quadrature points of a bent triangle: the place (x, y), the
/// shape functions and their derivatives with respect to x and y, and the area the point stands for.
template <typename Use>
void integrate(const BentTriangle& nodes, const Use& use) {
  static const std::array<TrianglePoint, 7> rule = radon_rule();
  for (const TrianglePoint& point : rule) {
    const Vector6 shapes = quadratic_shapes(point.xi, point.eta);
    const Slopes slopes = quadratic_slopes(point.xi, point.eta);
    const Eigen::Matrix2d jacobian = nodes * slopes;
    use(Eigen::Vector2d(nodes * shapes), shapes, Slopes(slopes * jacobian.inverse()),
        point.weight * jacobian.determinant());
  }
}

/// Unknowns of the two problems at the nodes of a mesh: corners first, then the edges in their order.
class Problem {
 public:
  explicit Problem(const TorsionMesh& mesh) : mesh_(mesh) {
    int count = static_cast<int>(mesh.points().size());
    for (const auto& [edge, sides] : mesh.edges()) edge_node_[edge] = count++;
    hole_areas_.assign(mesh.loops().size(), 0);
    stress_number_.assign(count, on_no_loop);
    for (const auto& [edge, sides] : mesh.edges())
      if (sides.piece) {
        const int loop = sides.piece->loop;
        for (const int node : {edge.first, edge.second, edge_node_.at(edge)})
          stress_number_[node] = -2 - loop;
        hole_areas_[loop] -= swept_area(edge, sides);
      }
    number_unknowns();
    for (int t = 0; t < static_cast<int>(mesh.triangles().size()); ++t) add(t);
    solve();
  }

  /// Bounds of the torsion constant.
  double lower() const { return stress_load_.dot(stress_); }
  double upper() const { return polar_ - warping_load_.dot(warping_); }

  /// The part of upper() - lower() in a triangle.
  double gap(int triangle) const {
    const std::array<int, 6> nodes = nodes_of(triangle);
    double sum = 0;
    integrate(bent_triangle(mesh_, triangle),
              [&](const Eigen::Vector2d& r, const Vector6&, const Slopes& slopes, double area) {
                Eigen::Vector2d difference(-r.y(), r.x());
                for (int i = 0; i < 6; ++i)
                  difference += warping_(nodes[i]) * slopes.row(i).transpose() -
                                stress_at(nodes[i]) * Eigen::Vector2d(slopes(i, 1), -slopes(i, 0));
                sum += area * difference.squaredNorm();
              });
    return sum;
  }

  /// How much the shape of the boundary edges of a triangle can change the constant: the square of the stress
  /// there times the area between the edge and its path.
  double shape_error(int triangle) const {
    const TorsionMesh::Triangle& corners = mesh_.triangles()[triangle];
    double sum = 0;
    for (int i = 0; i < 3; ++i) {
      const TorsionMesh::Edge edge = TorsionMesh::edge(corners[i], corners[(i + 1) % 3]);
      if (mesh_.edges().at(edge).piece) sum += area_between(edge) * stress_squared(triangle, i);
    }
    return sum;
  }

  // Twist about S = (x_s, y_s) warps by psi - y_s x + x_s y: about the shear centre that is orthogonal to x
  // and y (Trefftz).
  void describe_warping(TorsionReport& report) const {
    double area = 0, mean = 0, square = 0;
    Eigen::Vector2d first = Eigen::Vector2d::Zero();
    Eigen::Matrix2d second = Eigen::Matrix2d::Zero();
    for (int t = 0; t < static_cast<int>(mesh_.triangles().size()); ++t) {
      const std::array<int, 6> nodes = nodes_of(t);
      integrate(bent_triangle(mesh_, t),
                [&](const Eigen::Vector2d& r, const Vector6& shapes, const Slopes&, double part) {
                  double psi = 0;
                  for (int i = 0; i < 6; ++i) psi += shapes(i) * warping_(nodes[i]);
                  area += part;
                  mean += part * psi;
                  square += part * psi * psi;
                  first += part * psi * r;
                  second += part * r * r.transpose();
                });
    }
    const Eigen::Vector2d along = second.inverse() * first;
    report.shear_centre = {-along.y(), along.x()};
    report.warping_constant = square - mean * mean / area - along.dot(first);
  }

  std::vector<TorsionReport::AtBoundary> boundary() const {
    std::vector<TorsionReport::AtBoundary> places;
    for (int t = 0; t < static_cast<int>(mesh_.triangles().size()); ++t)
      for (int i = 0; i < 3; ++i) {
        const TorsionMesh::Triangle& corners = mesh_.triangles()[t];
        const auto& piece = mesh_.edges().at(TorsionMesh::edge(corners[i], corners[(i + 1) % 3])).piece;
        if (!piece) continue;
        const double u = middle_of(mesh_.loops()[piece->loop], *piece);
        places.push_back({piece->loop, piece->segment, u, std::sqrt(stress_squared(t, i))});
      }
    return places;
  }

 private:
  static constexpr int on_no_loop = -1;  // and -2 - loop on a loop, until the unknowns are numbered

  /// Twice the area swept about the origin is the integral of x dy - y dx along a quadratic edge.
  double swept_area(const TorsionMesh::Edge& edge, const TorsionMesh::Neighbours& sides) const {
    Eigen::Vector2d a = mesh_.points()[edge.first], b = mesh_.points()[edge.second];
    if (!sides.along) std::swap(a, b);
    const Eigen::Vector2d rise = mesh_.middle(edge) - 0.5 * (a + b);
    return 0.5 * cross(a, b) - 2.0 / 3 * cross(b - a, rise);
  }

  /// The stress function is 0 on the outline (loop 0) and one unknown on each hole.
  void number_unknowns() {
    const int holes = static_cast<int>(mesh_.loops().size()) - 1;
    stress_count_ = holes;
    for (int& number : stress_number_)
      number = number == on_no_loop ? stress_count_++ : number == -2 ? fixed_ : -3 - number;
    const int nodes = static_cast<int>(stress_number_.size());
    stress_load_ = Eigen::VectorXd::Zero(stress_count_);
    for (int hole = 0; hole < holes; ++hole) stress_load_(hole) = 2 * hole_areas_[hole + 1];
    warping_load_ = Eigen::VectorXd::Zero(nodes);
  }

  std::array<int, 6> nodes_of(int triangle) const {
    const TorsionMesh::Triangle& c = mesh_.triangles()[triangle];
    const auto between = [&](int a, int b) { return edge_node_.at(TorsionMesh::edge(a, b)); };
    return {c[0], c[1], c[2], between(c[0], c[1]), between(c[1], c[2]), between(c[2], c[0])};
  }

  void add(int triangle) {
    Matrix6 stiffness = Matrix6::Zero();
    Vector6 stress_load = Vector6::Zero(), warping_load = Vector6::Zero();
    integrate(bent_triangle(mesh_, triangle),
              [&](const Eigen::Vector2d& r, const Vector6& shapes, const Slopes& slopes, double area) {
                stiffness += area * slopes * slopes.transpose();
                stress_load += 2 * area * shapes;
                warping_load += area * slopes * Eigen::Vector2d(r.y(), -r.x());
                polar_ += area * r.squaredNorm();
              });
    const std::array<int, 6> nodes = nodes_of(triangle);
    for (int i = 0; i < 6; ++i) {
      const int row = stress_number_[nodes[i]];
      if (row >= 0) stress_load_(row) += stress_load(i);
      warping_load_(nodes[i]) += warping_load(i);
      for (int j = 0; j < 6; ++j) {
        const int column = stress_number_[nodes[j]];
        if (row >= 0 && column >= 0) stress_entries_.emplace_back(row, column, stiffness(i, j));
        // The warping function is 0 at node 0.
        if (nodes[i] > 0 && nodes[j] > 0)
          warping_entries_.emplace_back(nodes[i] - 1, nodes[j] - 1, stiffness(i, j));
      }
    }
  }

  void solve() {
    const auto solution = [](int count, const std::vector<Eigen::Triplet<double>>& entries,
                             const Eigen::VectorXd& load) -> Eigen::VectorXd {
      Eigen::SparseMatrix<double> matrix(count, count);
      matrix.setFromTriplets(entries.begin(), entries.end());
      return Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>(matrix).solve(load);
    };
    stress_ = solution(stress_count_, stress_entries_, stress_load_);
    const int others = static_cast<int>(warping_load_.size()) - 1;
    warping_ = Eigen::VectorXd::Zero(others + 1);
    warping_.tail(others) = solution(others, warping_entries_, warping_load_.tail(others));
  }

  double stress_at(int node) const { return stress_number_[node] >= 0 ? stress_(stress_number_[node]) : 0; }

  /// Square of the slope of the stress function in the middle of edge i of a triangle.
  double stress_squared(int triangle, int i) const {
    constexpr double xi[] = {0.5, 0.5, 0}, eta[] = {0, 0.5, 0.5};
    const Slopes by_parameters = quadratic_slopes(xi[i], eta[i]);
    const Slopes slopes = by_parameters * (bent_triangle(mesh_, triangle) * by_parameters).inverse();
    const std::array<int, 6> nodes = nodes_of(triangle);
    Eigen::Vector2d slope = Eigen::Vector2d::Zero();
    for (int k = 0; k < 6; ++k) slope += stress_at(nodes[k]) * slopes.row(k).transpose();
    return slope.squaredNorm();
  }

  /// Between a boundary edge and its path, from their distances at a quarter and three quarters.
  double area_between(const TorsionMesh::Edge& edge) const {
    const TorsionMesh::Neighbours& sides = mesh_.edges().at(edge);
    const BoundaryPiece& piece = *sides.piece;
    const RationalCubic& cubic = mesh_.loops()[piece.loop][piece.segment];
    const Eigen::Vector2d a = cubic.point(piece.u0).head<2>(), b = cubic.point(piece.u1).head<2>();
    const Eigen::Vector2d middle = mesh_.middle(edge), chord = b - a;
    double distance = 0;
    for (const double t : {0.25, 0.75}) {
      const Eigen::Vector2d on_edge = a + t * chord + 4 * t * (1 - t) * (middle - 0.5 * (a + b));
      double low = piece.u0, high = piece.u1;
      for (int k = 0; k < 60; ++k) {
        const double u = 0.5 * (low + high);
        ((cubic.point(u).head<2>() - on_edge).dot(chord) < 0 ? low : high) = u;
      }
      distance = std::max(distance, (cubic.point(low).head<2>() - on_edge).norm());
    }
    return distance * chord.norm();
  }

  const TorsionMesh& mesh_;
  std::map<TorsionMesh::Edge, int> edge_node_;
  std::vector<int> stress_number_;  // of a node among the unknowns; fixed_ on the outline
  static constexpr int fixed_ = -1;
  std::vector<double> hole_areas_;
  int stress_count_ = 0;
  double polar_ = 0;
  std::vector<Eigen::Triplet<double>> stress_entries_, warping_entries_;
  Eigen::VectorXd stress_load_, warping_load_, stress_, warping_;
};

/// The triangles with the largest errors, which together make up half of their sum.
std::vector<int> half_of(const std::vector<double>& errors) {
  std::vector<int> order(errors.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int a, int b) { return errors[a] > errors[b]; });
  const double wanted = 0.5 * std::accumulate(errors.begin(), errors.end(), 0.0);
  double sum = 0;
  std::vector<int> marked;
  for (std::size_t i = 0; i < order.size() && sum < wanted; ++i) {
    marked.push_back(order[i]);
    sum += errors[order[i]];
  }
  return marked;
}

}  // namespace

TorsionReport torsion_constant(const std::vector<Loop>& loops, const TorsionOptions& options) {
  std::optional<TorsionMesh> mesh = TorsionMesh::make(loops, options.most_points);
  if (!mesh) return {};
  TorsionReport report;
  while (true) {
    const Problem problem(*mesh);
    std::vector<double> errors;
    double shape = 0;
    for (int t = 0; t < static_cast<int>(mesh->triangles().size()); ++t) {
      const double bent = problem.shape_error(t);
      errors.push_back(problem.gap(t) / 2 + bent);
      shape += bent;
    }
    report.value = 0.5 * (problem.lower() + problem.upper());
    report.error = 0.5 * std::abs(problem.upper() - problem.lower()) + shape;
    report.points = static_cast<int>(mesh->points().size());
    const bool done = report.error <= options.relative_error * report.value;
    report.status = done ? TorsionStatus::done : TorsionStatus::coarse;
    if (done || report.points >= options.most_points) {
      report.boundary = problem.boundary();
      problem.describe_warping(report);
      return report;
    }
    mesh->refine(half_of(errors));
  }
}

}  // namespace nurbeam
