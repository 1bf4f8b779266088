#include "fem/system/stress_resultants.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "fem/forces/moment.h"
#include "fem/mesh/point_on_beam.h"
#include "fem/mesh/widened.h"
#include "fem/system/with_assembly.h"

namespace nurbeam {

namespace {

// Contribution of an action to inertia less forces of its element, in the element's coordinates.
template <int D>
ElementVector<D> on_element(const MeshElement<D>& e, const Eigen::VectorXd& q, const PointAction& action) {
  const PointShape<D> shape = point_shape<D>(e, q, action.s);
  const PointField<D> r = shape.position(), rs = shape.slope();
  const TurnedVector couple{action.couple, Eigen::Matrix3d::Zero()};
  const Eigen::Vector3d on_slope = moment_on_slope(couple, widened<D>(rs.value)).value;
  return -r.gradient.transpose() * action.force.head<D>() - rs.gradient.transpose() * on_slope.head<D>();
}

// Momentum that flows into the element over an end that moves over the material [N]. The inertia of form V
// includes it; the force on the end does not.
template <int D>
Eigen::Matrix<double, D, 1> flux(const Assembly<D>& a, const MeshElement<D>& e, const State& state,
                                 const ElementState<D>& x, int end) {
  using Layout = ElementLayout<D>;
  if (e.element.fixed() || a.is_form_p(e)) return Eigen::Matrix<double, D, 1>::Zero();
  const double rate = x.v[Layout::place(end)], rho = e.element.properties().mass_per_length;
  return (end == 0 ? 1 : -1) * rho * rate *
         material_point<D>(e, state.q, state.v, x.q[Layout::place(end)]).velocity;
}

// The forces on an element: on its axis, and on the angles of its ends.
template <int D>
struct OnElement {
  ElementVector<D> axis;
  Eigen::Vector2d angles = Eigen::Vector2d::Zero();  // on a beam with torsion

  void add(const TwistLayout::Coordinates& with_sections) {
    axis += with_sections.head<element_size<D>>();
    angles += with_sections.segment<2>(TwistLayout::angle(0));
  }
};

// Adds the contribution of an action inside an element to its inertia less forces.
template <int D>
void add_action(const MeshElement<D>& e, const Eigen::VectorXd& q, const PointAction& action,
                OnElement<D>& on) {
  if constexpr (D == 3)
    if (e.twist) {
      const PointAction force{.element = action.element, .s = action.s, .force = action.force};
      on.axis += on_element<D>(e, q, force);
      on.add(-e.twist->element.moment_force(gather_twist(e, q), action.s, {action.couple}));
      return;
    }
  on.axis += on_element<D>(e, q, action);
}

template <int D>
Eigen::Vector3d end_couple(const MeshElement<D>& e, const Eigen::VectorXd& q, const OnElement<D>& on, int end,
                           const Eigen::Vector3d& slope) {
  const Eigen::Vector3d on_slope =
      widened<D>(Eigen::Matrix<double, D, 1>(on.axis.template segment<D>(ElementLayout<D>::slope(end))));
  if constexpr (D == 3)
    if (e.twist) return e.twist->element.end_moment(gather_twist(e, q), end, on_slope, on.angles[end]);
  return slope.cross(on_slope);
}

template <int D>
SpanResultants of_span(const Assembly<D>& a, const MeshElement<D>& e, const State& state,
                       const ElementVector<D>& axis_force, const std::vector<PointAction>& inside) {
  using Layout = ElementLayout<D>;
  const ElementState<D> x = gather<D>(e, state);
  OnElement<D> on{axis_force};
  double torque = 0;  // per unit length
  if constexpr (D == 3)
    if (e.twist) {
      on.add(e.twist->element.force(gather_twist(e, state)));
      for (const BoundForce<3>& force : a.forces())
        std::visit(
            [&](const auto& f) {
              if constexpr (offers_of<decltype(f)>.on_element)
                if (f.beam == e.span->beam) {
                  on.add(-f.on_element(e, state));
                  torque += f.per_length(state);
                }
            },
            force);
    }
  std::vector<SpanResultants::Inside> placed;
  for (const PointAction& action : inside) {
    add_action<D>(e, state.q, action, on);
    placed.push_back({action, widened<D>(point_shape<D>(e, state.q, action.s).position().value)});
  }
  std::array<SpanResultants::End, 2> ends;
  std::array<Eigen::Vector3d, 2> places;
  for (int i = 0; i < 2; ++i) {
    const Eigen::Matrix<double, D, 1> on_end =
        on.axis.template segment<D>(Layout::r(i)) + flux<D>(a, e, state, x, i);
    const Eigen::Matrix<double, D, 1> slope = x.q.template segment<D>(Layout::slope(i));
    const double sign = i == 0 ? -1 : 1;
    ends[i].s = x.q[Layout::place(i)];
    ends[i].slope = widened<D>(slope);
    ends[i].torque_per_length = torque * ends[i].slope.normalized();
    ends[i].carried.force = sign * widened<D>(on_end);
    ends[i].carried.couple = sign * end_couple<D>(e, state.q, on, i, ends[i].slope);
    places[i] = widened<D>(Eigen::Matrix<double, D, 1>(x.q.template segment<D>(Layout::r(i))));
  }
  return {ends, places, std::move(placed)};
}

// Whether an action on an element lies inside it and not at a node.
template <int D>
bool is_inside(const MeshElement<D>& e, const State& state, const PointAction& action) {
  constexpr double at_node = 1e-9;  // part of the element's length
  const double s_a = e.span->start(state.q), s_b = e.span->end(state.q);
  return std::min(action.s - s_a, s_b - action.s) > at_node * (s_b - s_a);
}

template <int D>
std::vector<PointAction> actions_inside(const Assembly<D>& a, const State& state) {
  std::vector<PointAction> inside;
  for (const PointAction& action : a.actions(state))
    if (is_inside(a.elements()[action.element], state, action)) inside.push_back(action);
  std::stable_sort(inside.begin(), inside.end(),
                   [](const PointAction& x, const PointAction& y) { return x.element < y.element; });
  return inside;
}

template <int D>
std::vector<Eigen::Vector3d> line_loads(const Assembly<D>& a, const State& state) {
  std::vector<Eigen::Vector3d> loads;
  for (int beam = 0; beam < static_cast<int>(a.model()->beams.size()); ++beam)
    loads.push_back(widened<D>(a.line_load(beam, state)));
  return loads;
}

}  // namespace

SpanResultants::SpanResultants(const std::array<End, 2>& ends,
                               const std::array<Eigen::Vector3d, 2>& end_places, std::vector<Inside> inside)
    : inside_(std::move(inside)) {
  for (int i = 0; i < 2; ++i) {
    Eigen::Vector3d force = ends[i].carried.force;
    s_[i] = ends[i].s;
    couple_[i] = ends[i].carried.couple;
    for (const Inside& x : inside_)
      if (s_[i] < x.action.s) {
        force -= x.action.force;
        couple_[i] -= (x.place - end_places[i]).cross(x.action.force) + x.action.couple;
      }
    couple_s_[i] = -ends[i].slope.cross(force) - ends[i].torque_per_length;
  }
}

StressResultants SpanResultants::at(double s, const Eigen::Vector3d& r, const Eigen::Vector3d& slope) const {
  const double h = s_[1] - s_[0], x = (s - s_[0]) / h, y = 1 - x;
  StressResultants carried;
  carried.couple = y * y * (1 + 2 * x) * couple_[0] + x * x * (1 + 2 * y) * couple_[1] +
                   h * x * y * (y * couple_s_[0] - x * couple_s_[1]);
  Eigen::Vector3d couple_s = 6 * x * y / h * (couple_[1] - couple_[0]) + y * (1 - 3 * x) * couple_s_[0] +
                             x * (1 - 3 * y) * couple_s_[1];
  for (const Inside& point : inside_)
    if (s < point.action.s) {
      carried.couple += (point.place - r).cross(point.action.force) + point.action.couple;
      couple_s -= slope.cross(point.action.force);
    }
  carried.force = slope.cross(couple_s) / slope.squaredNorm();
  return carried;
}

namespace {

// The deflection at x of a beam of length h with clamped ends and EI = 1 under a unit force at a, and its
// derivative by a.
std::pair<double, double> clamped_deflection(double x, double a, double h) {
  const bool beyond = x > a;
  if (beyond) {
    x = h - x;
    a = h - a;
  }
  const double b = h - a, span = 3 * a * h - x * (3 * a + b), scale = x * x / (6 * h * h * h);
  const double by_a = scale * (b * b * (3 * h - 2 * x) - 2 * b * span);
  return {scale * b * b * span, beyond ? -by_a : by_a};
}

}  // namespace

Eigen::Vector3d SpanResultants::couple_integral(double s, const Eigen::Vector3d& slope) const {
  const double h = length(), x = (s - s_[0]) / h, y = 1 - x;
  Eigen::Vector3d sum = (couple_s_[1] - couple_s_[0]) * (h * h * h * x * x * y * y / 24);
  for (const Inside& point : inside_) {
    const auto [force, couple] = clamped_deflection(s - s_[0], point.action.s - s_[0], h);
    sum += force * slope.cross(point.action.force) + couple * point.action.couple;
  }
  return sum;
}

CarriedBySpans::CarriedBySpans(const BeamSystem& system, const State& state)
    : system_(system),
      state_(state),
      inside_(with_assembly(system, [&](const auto& a) { return actions_inside(a, state); })),
      loads_(with_assembly(system, [&](const auto& a) { return line_loads(a, state); })) {}

bool CarriedBySpans::has_actions(int span) const {
  return std::binary_search(
      inside_.begin(), inside_.end(), PointAction{.element = span, .s = 0},
      [](const PointAction& x, const PointAction& y) { return x.element < y.element; });
}

SpanResultants CarriedBySpans::operator[](int span) const {
  const auto comes_before = [](const auto& action, int of) { return action.element < of; };
  const auto first = std::lower_bound(inside_.begin(), inside_.end(), span, comes_before),
             end = std::lower_bound(first, inside_.end(), span + 1, comes_before);
  return with_assembly(system_, [&]<int D>(const Assembly<D>& a) {
    const MeshElement<D>& e = a.elements()[span];
    return of_span<D>(a, e, state_, a.element_force(e, state_, loads_[e.span->beam].template head<D>()),
                      {first, end});
  });
}

}  // namespace nurbeam
