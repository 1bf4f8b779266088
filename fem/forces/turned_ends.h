#pragma once
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "fem/constraints/node_section.h"
#include "fem/mesh/mesh_elements.h"
#include "fem/structure/rotational_connector.h"

namespace nurbeam {

/// The angle of a rotational connector with its derivatives, in the coordinates of both ends.
template <int D>
struct EndAngle {
  static constexpr int size = D == 2 ? 4 : 8;
  using Vector = Eigen::Matrix<double, size, 1>;
  using Matrix = Eigen::Matrix<double, size, size>;

  double sine, cosine;  ///< of the angle, up to a common factor
  Vector gradient;
  Matrix hessian;  ///< unset unless it was asked for

  /// The angle next to `near`, among those 2 pi apart [rad].
  double next_to(double near) const {
    const double c = std::cos(near), s = std::sin(near);
    return near + std::atan2(sine * c - cosine * s, cosine * c + sine * s);
  }
};

/// The ends of a rotational connector in one mesh: space, rigid bodies and sections of beams with torsion, or
/// directions r_s of beams without it.
template <int D>
class TurnedEnds {
 public:
  static constexpr int size = EndAngle<D>::size;
  static constexpr int size_of_end = size / 2;
  using Vector = typename EndAngle<D>::Vector;
  using Matrix = typename EndAngle<D>::Matrix;

  /// Throws std::invalid_argument where an end is a point mass, or a place of a beam without a node.
  TurnedEnds(const RotationalConnector& connector, const MeshedBeams<D>& at, const Eigen::VectorXd& drawn);

  /// (size) Coordinates of both ends; -1 where there is none.
  const std::vector<int>& dofs() const { return dofs_; }
  /// (size) Values of these from those of the mesh; zero where there is none.
  Vector gathered(const Eigen::VectorXd& all) const;
  bool counts() const { return counts_; }
  EndAngle<D> angle(const Vector& x, bool with_hessian) const;

  /// The spring without an axis, of sections: see RotationalConnector.
  struct Ball {
    double cosine;        ///< of the angle between the ends
    double angle;         ///< [rad]
    Vector elastic, all;  ///< generalised forces that resist: elastic ones, and with those of damping
  };
  Ball ball(const Vector& x, const Vector& v, double stiffness, double damping) const;
  /// Derivatives of Ball::all, those by x and by v with their weights.
  Matrix ball_tangent(const Vector& x, const Vector& v, double stiffness, double damping, double by_x,
                      double by_v) const;

 private:
  void take_body(int end, const MeshedBeams<D>& at, int body, const std::string& what);
  EndAngle<D> angle_of_directions(const Vector& x, bool with_hessian) const;
  EndAngle<D> angle_of_sections(const Vector& x, bool with_hessian) const;
  template <class T>
  Eigen::Matrix<T, 3, 3> axes(int end, const Eigen::Matrix<T, size, 1>& x) const;
  template <class T>
  void add_moment(int end, const Eigen::Matrix<T, size, 1>& x, const Vector3<T>& moment,
                  Eigen::Matrix<T, size, 1>& forces) const;
  template <class T>
  struct Turning {
    T S, C;
    Vector3<T> on_b;  // the moment on the second end of which the angle is the work
  };
  template <class T>
  Turning<T> turning(const Eigen::Matrix<T, size, 1>& x) const;
  template <class T>
  Eigen::Matrix<T, size, 1> gradient(const Eigen::Matrix<T, size, 1>& x) const;
  template <class T>
  Eigen::Matrix<T, size, 1> ball_forces(const Eigen::Matrix<T, size, 1>& x,
                                        const Eigen::Matrix<T, size, 1>& v, double stiffness,
                                        double damping) const;

  bool counts_, of_sections_ = false;  // of sections and bodies, which have three axes
  std::vector<int> dofs_;
  std::array<std::optional<NodeSection>, 2> sections_;  // none in space
  std::array<bool, 2> bodies_ = {false, false};         // their coordinates are attitudes
  // Across the axis, v and w as drawn: of sections in the own axes of each end, of directions in space.
  std::array<Eigen::Matrix<double, 3, 2>, 2> across_;
  std::array<Eigen::Vector2d, 2> drawn_;  // drawn directions in v and w, of unit length
};

extern template class TurnedEnds<2>;
extern template class TurnedEnds<3>;

}  // namespace nurbeam
