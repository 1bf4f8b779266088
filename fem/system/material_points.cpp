#include "fem/system/material_points.h"

#include <Eigen/Geometry>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "fem/element/inertia.h"
#include "fem/element/quadrature.h"
#include "fem/material/bending_layer.h"
#include "fem/mesh/point_on_beam.h"
#include "fem/mesh/widened.h"
#include "fem/system/with_assembly.h"

namespace nurbeam {

namespace {

template <int D>
MaterialPoint<3> widened_point(const MaterialPoint<D>& p) {
  return {widened<D>(p.r),        widened<D>(p.rs),         widened<D>(p.rss),
          widened<D>(p.velocity), widened<D>(p.velocity_s), p.kappa0};
}

// Of nodes with slopes by reference arc length.
Eigen::Matrix4d control_points(const ElementBasis<double>& basis, NodalCoordinates nodal) {
  const auto [J_a, J_b] = basis.stretches();
  const std::array<double, 4> weights = basis.weights();
  nodal.col(1) *= J_a;
  nodal.col(3) *= J_b;
  return to_bezier(nodal, Eigen::Map<const Eigen::Vector4d>(weights.data()), basis.length()).points();
}

template <int D>
Eigen::Matrix4d control_points(const ElementBasis<double>& basis, const ElementVector<D>& q) {
  NodalCoordinates nodal = NodalCoordinates::Zero();
  nodal.topRows<D>() = ElementLayout<D>::nodes(q);
  return control_points(basis, nodal);
}

// The control points of an element where its curve is drawn.
Eigen::Matrix<double, 3, 4> drawn_points(const ElementBasis<double>& basis, const ReferenceCurve& curve,
                                         double s_a, double s_b) {
  NodalCoordinates nodal;
  nodal << curve.position(s_a), curve.tangent(s_a), curve.position(s_b), curve.tangent(s_b, true);
  return control_points(basis, nodal).colwise().hnormalized();
}

// Measured: cantilevers of unevenly drawn lines have errors of up to 1.1 times the sum of turns.
constexpr double misfit_to_turn = 2;

// The part of the energy of a uniform bending by which an element is too stiff: the part of a curvature of 1
// that second derivatives of its shape functions by s do not reach. It is 0 where the drawing is even, as its
// shapes are then the cubics in s.
template <int D>
double bending_misfit(const MeshElement<D>& e, const ElementVector<D>& q) {
  const double s_a = q[ElementLayout<D>::place(0)], length = q[ElementLayout<D>::place(1)] - s_a;
  Eigen::Matrix<double, GaussRule::size, 4> shapes;
  Eigen::Matrix<double, GaussRule::size, 1> one;
  for (int g = 0; g < GaussRule::size; ++g) {
    one[g] = std::sqrt(GaussRule::weights[g]);
    const std::array<double, 4> d2 = e.element.shape(q, e.local(q, s_a + length * GaussRule::points[g])).d2;
    shapes.row(g) = one[g] * Eigen::Map<const Eigen::RowVector4d>(d2.data());
  }
  for (auto column : shapes.colwise())
    if (const double size = column.norm(); size > 0) column /= size;
  Eigen::ColPivHouseholderQR<Eigen::Matrix<double, GaussRule::size, 4>> fit;
  fit.setThreshold(1e-10);
  fit.compute(shapes);
  return (one - shapes * fit.solve(one)).squaredNorm();
}

// Root of the mean square of the curvature since the stress-free shape [1/m].
template <int D>
double elastic_curvature(const MeshElement<D>& e, const State& state, double length) {
  const BeamProperties& beam = e.element.properties();
  double energy = e.element.energy(gather<D>(e, state), Eigen::Matrix<double, D, 1>::Zero()).bending;
  if constexpr (D == 3)
    if (e.twist && beam.sections) energy += e.twist->element.energy(gather_twist(e, state)).bending;
  return beam.mean_bend(energy / length);
}

// The couple as one number: in the plane about its normal. In space a beam without torsion carries no couple
// along itself; the number is positive where the beam bends more than the stress-free shape.
template <int D>
double bending_moment(const Eigen::Vector3d& couple, const MaterialPoint<3>& p) {
  if constexpr (D == 2) return couple.z();
  const Eigen::Vector3d t = p.rs.normalized(), across = couple - couple.dot(t) * t;
  const bool less = p.kappa0 > 0 && across.dot(p.rs.cross(p.rss)) < 0;
  return less ? -across.norm() : across.norm();
}

template <int D>
double shear_force(const Eigen::Vector3d& force, const Eigen::Vector3d& rs) {
  if constexpr (D == 2) return force.dot(Eigen::Vector3d::UnitZ().cross(rs.normalized()));
  return force.norm();
}

SectionPoint section_of(const MeshElement<3>& e, const State& state, double s) {
  return e.twist->element.section(gather_twist(e, state.q), s);
}

/// A place of an element, before its forces are known.
template <int D>
struct PlaceInElement {
  double s;
  MaterialPoint<D> point;
  std::optional<SectionPoint> section;  ///< on a beam with torsion

  PlaceInElement(const MeshElement<D>& e, const State& state, double place)
      : PlaceInElement(e, state, place, material_point<D>(e, state.q, state.v, place)) {}
  PlaceInElement(const MeshElement<D>& e, const State& state, double place, MaterialPoint<D> there)
      : s(place), point(std::move(there)) {
    if constexpr (D == 3)
      if (e.twist) section = section_of(e, state, place);
  }
};

// The twist of a section since the drawing, against the start of the element [rad]: the strain of twist is
// linear in s.
double twist_since_start(const MeshElement<3>& e, const State& state, double s) {
  const double s_a = e.span->start(state.q);
  return s == s_a ? 0 : (s - s_a) * section_of(e, state, (s_a + s) / 2).strain.twist;
}

// The couple on a section of a beam with torsion; of a string that of its own bending.
Eigen::Vector3d couple_of(const PlaceInElement<3>& at, const Eigen::Vector3d& carried, bool taut) {
  if (!taut) return carried;
  const SectionTriad<double>& triad = at.section->triad;
  const SectionMoments<double>& own = at.section->moments;
  return own.bending_1 * triad.d1 + own.bending_2 * triad.d2 + carried.dot(triad.t) * triad.t;
}

// The factor on the stress of bending, of an element in a bend of a pipe.
template <int D>
double stress_factor(const Beam& beam, const MeshElement<D>& e) {
  const PipeBend* bend = beam.bend_at((e.span->s_a + e.span->s_b) / 2);
  return bend ? bend->stress_factor : 1;
}

// Adds the values that only a beam with torsion has to the record of its section.
void add_own_axes(const Beam& beam, const MeshElement<3>& e, const State& state,
                  const Eigen::Vector3d& couple, const PlaceInElement<3>& at, SectionRecord& record) {
  const SectionTriad<double>& triad = at.section->triad;
  record.torque = couple.dot(triad.t);
  record.moment_1 = couple.dot(triad.d1);
  record.moment_2 = couple.dot(triad.d2);
  // Bending about two axes has no common sign: a sign for more or less bending would jump where the axes
  // change roles.
  record.bending_moment = std::hypot(record.moment_1, record.moment_2);
  record.twist = twist_since_start(e, state, at.s);
  record.stress = record.von_mises = SectionRecord::no_number;
  if (!beam.stresses) return;
  const double factor = stress_factor(beam, e);
  const auto [normal, von_mises] = beam.stresses->largest(
      {record.axial_force, factor * record.moment_1, factor * record.moment_2, record.torque});
  record.stress = normal;
  record.von_mises = von_mises;
}

// The curvature vector by which a couple bends a beam [1/m].
template <int D>
Eigen::Vector3d bent_by(const BeamProperties& beam, const Eigen::Vector3d& couple,
                        const PlaceInElement<D>& at) {
  const Eigen::Vector3d t = widened<D>(at.point.rs).normalized();
  if (at.section && beam.sections) {
    const Eigen::Vector3d d1 = at.section->triad.d1, d2 = at.section->triad.d2;
    return beam.sections->curvature_1(couple.dot(d1)) * d1.cross(t) +
           beam.sections->curvature_2(couple.dot(d2)) * d2.cross(t);
  }
  return beam.curvature_of(1) * couple.cross(t);
}

template <int D>
bool is_at_rest(const MeshElement<D>& e, const State& state) {
  return std::all_of(
      e.dofs.begin(), e.dofs.end(), [&](int k) { return k < 0 || (state.v[k] == 0 && state.a[k] == 0); });
}

// The distance by which loads between its ends deflect a beam at rest from the cubic of its element [m]. A
// tension T holds it to the cubic, by the energies of a deflection x^2 (1 - x)^2: 1/(1 + T h^2/(42 EI)). In
// motion an element follows its loads with the inertia of what it does not show.
template <int D>
Eigen::Vector3d deflection_from_cubic(const MeshElement<D>& e, const State& state,
                                      const SpanResultants& carried, double tension,
                                      const PlaceInElement<D>& at) {
  const BeamProperties& beam = e.element.properties();
  if (!beam.resists_bending() || !is_at_rest(e, state)) return Eigen::Vector3d::Zero();
  const double held = 1 + beam.tension_number(std::max(tension, 0.0), carried.length()) / 42;
  return bent_by<D>(beam, carried.couple_integral(at.s, widened<D>(at.point.rs)), at) / held;
}

template <int D>
SectionRecord section_of(const Assembly<D>& a, const MeshElement<D>& e, const State& state,
                         const SpanResultants& carried, const ElementVector<D>& q,
                         const std::optional<AssumedStrain>& assumed, const PlaceInElement<D>& at) {
  using Layout = ElementLayout<D>;
  const double s = at.s, s_a = q[Layout::place(0)], s_b = q[Layout::place(1)];
  const MaterialPoint<D>& p = at.point;
  const MaterialPoint<3> point = widened_point<D>(p);
  const double drawn = e.element.curve().strain(s);
  const double strain =
      assumed ? drawn + assumed->carried((s - s_a) / (s_b - s_a)) : axial_strain<D>(p.rs).value;
  const SectionForces elastic = section_forces(e.element.properties(), strain, drawn, free_strain(e, state),
                                               e.element.axial_rule().buckling_strain);
  const StressResultants resultants = carried.at(s, point.r, point.rs);
  SectionRecord record;
  record.displacement = (point.r + deflection_from_cubic<D>(e, state, carried, elastic.axial_force, at) -
                         e.element.curve().position(s))
                            .norm();
  record.strain = elastic.strain;
  record.curvature = curvature<D, Derivatives::one>(p.rs, p.rss, e.element.properties().curvature).value;
  record.axial_force = elastic.axial_force;
  const Beam& beam = a.model()->beams[e.span->beam];
  const bool taut = beam.rope && is_string(e.element.properties(), s_b - s_a, record.axial_force);
  record.bending_moment = taut ? elastic_moment(e.element.properties(), record.curvature - point.kappa0)
                               : bending_moment<D>(resultants.couple, point);
  record.shear_force = shear_force<D>(resultants.force, point.rs);
  record.stress =
      beam.section.fibre_stress(record.axial_force, stress_factor(beam, e) * record.bending_moment)
          .value_or(SectionRecord::no_number);
  if constexpr (D == 3)
    if (e.twist) add_own_axes(beam, e, state, couple_of(at, resultants.couple, taut), at, record);
  return record;
}

template <int D>
ElementRecord element_of(const Assembly<D>& a, const MeshElement<D>& e, const State& state,
                         const SpanResultants& carried) {
  using Layout = ElementLayout<D>;
  const ElementState<D> x = gather<D>(e, state);
  const ElementVector<D>& q = x.q;
  const ElementBasis<double> basis = e.element.basis(q);
  ElementRecord record;
  record.control_points = control_points<D>(basis, q);
  record.s_start = q[Layout::place(0)];
  record.s_end = q[Layout::place(1)];
  record.drawn_points = drawn_points(basis, e.element.curve(), record.s_start, record.s_end);
  record.axial_mismatch = e.element.axial_mismatch(q);
  const std::optional<AssumedStrain> assumed = e.element.assumed_strain(q);
  for (int i = 0; i < 4; ++i) {
    const double s = e.element.place(q, i / 3.0);
    const PlaceInElement<D> at(
        e, state, s,
        e.element.fixed() ? material_point<D>(x, basis.at(s)) : material_point<D>(e, state.q, state.v, s));
    const SectionRecord section = section_of<D>(a, e, state, carried, q, assumed, at);
    record.strain[i] = section.strain;
    record.curvature[i] = section.curvature;
    record.axial_force[i] = section.axial_force;
    record.bending_moment[i] = section.bending_moment;
    record.torque[i] = section.torque;
    record.shear_force[i] = section.shear_force;
    record.stress[i] = section.stress;
    record.displacement[i] = section.displacement;
    record.velocity.col(i) = widened<D>(at.point.velocity);
    record.moment_1[i] = section.moment_1;
    record.moment_2[i] = section.moment_2;
    record.twist[i] = section.twist;
    record.von_mises[i] = section.von_mises;
    if (at.section) {
      record.d1.col(i) = at.section->triad.d1;
      record.d2.col(i) = at.section->triad.d2;
    }
  }
  record.folded = e.element.strain_residue(q) / (1 + 2 * std::max(0.0, record.strain.maxCoeff()));
  return record;
}

}  // namespace

MaterialPoint<3> material_point_in(const BeamSystem& system, const State& state, int span, double s) {
  return with_assembly(
      system,
      [&]<int D>(const Assembly<D>& a) {
        return widened_point<D>(material_point<D>(a.elements()[span], state.q, state.v, s));
      });
}

MaterialPoint<3> material_point(const BeamSystem& system, const State& state, int beam, double s) {
  const Beam& of = system.model().beams[beam];
  if (of.rigid) {
    const CurvePoint p = of.curve.point_in(of.curve.segment_at(s), s);
    const Eigen::Vector3d none = Eigen::Vector3d::Zero();
    return {p.position, p.tangent, p.curvature, none, none, 0};
  }
  return material_point_in(system, state, find_span(system.model(), system.mesh(), state.q, beam, s), s);
}

namespace {

// d2/dt2 of the position at a fixed s in an element whose ends may move.
template <int D>
Eigen::Vector3d acceleration_in(const MeshElement<D>& e, const State& state, double s) {
  using Layout = ElementLayout<D>;
  const ElementState<D> x = gather(e, state.q, state.v, state.a);
  const auto ends = [](const ElementVector<D>& of) {
    return std::array<double, 2>{of[Layout::place(0)], of[Layout::place(1)]};
  };
  const CurvedPointShape<D> shape = point_shape<D>(e, state.q, s);
  return widened<D>(SecondRate<D>(shape.value, shape.position(), shape.nodes, Layout::nodes(x.v),
                                  Layout::nodes(x.a), ends(x.v), ends(x.a))
                        .value);
}

}  // namespace

Eigen::Vector3d material_acceleration(const BeamSystem& system, const State& state, int beam, double s) {
  if (system.model().beams[beam].rigid) return Eigen::Vector3d::Zero();
  return with_assembly(system, [&](const auto& assembly) {
    const int span = find_span(system.model(), system.mesh(), state.q, beam, s);
    return acceleration_in(assembly.elements()[static_cast<std::size_t>(span)], state, s);
  });
}

SectionPoint section_point(const BeamSystem& system, const State& state, int beam, double s) {
  const Beam& of = system.model().beams.at(beam);
  if (!of.has_torsion()) throw std::invalid_argument("beam \"" + of.name + "\" has no torsion");
  const MeshElement<3>& e =
      system.assembly<3>()->elements()[find_span(system.model(), system.mesh(), state.q, beam, s)];
  return section_of(e, state, e.local(gather<3>(e, state.q), s));
}

double material_spin(const BeamSystem& system, const State& state, int beam, double s) {
  if (!system.model().beams.at(beam).has_torsion()) return 0;
  const MeshElement<3>& e =
      system.assembly<3>()->elements()[find_span(system.model(), system.mesh(), state.q, beam, s)];
  return e.twist->element.material_spin(gather_twist(e, state), e.local(gather<3>(e, state.q), s));
}

double section_twist(const BeamSystem& system, const State& state, int beam, double s) {
  const Beam& of = system.model().beams.at(beam);
  if (!of.has_torsion()) return 0;
  return of.curve.section(s).twist + section_point(system, state, beam, s).strain.twist;
}

SectionRecord section_at(const BeamSystem& system, const State& state, int span,
                         const SpanResultants& carried, double s) {
  return with_assembly(
      system,
      [&]<int D>(const Assembly<D>& a) {
        const MeshElement<D>& e = a.elements()[span];
        const ElementVector<D> q = gather<D>(e, state.q);
        return section_of<D>(a, e, state, carried, q, e.element.assumed_strain(q),
                             PlaceInElement<D>(e, state, e.local(q, s)));
      });
}

ElementRecord record_element(const BeamSystem& system, const State& state, int span,
                             const SpanResultants& carried) {
  return with_assembly(
      system,
      [&]<int D>(const Assembly<D>& a) { return element_of<D>(a, a.elements()[span], state, carried); });
}

Eigen::Matrix4d span_control_points(const BeamSystem& system, const State& state, int span) {
  return with_assembly(
      system,
      [&]<int D>(const Assembly<D>& a) -> Eigen::Matrix4d {
        const MeshElement<D>& e = a.elements()[span];
        const ElementVector<D> q = gather<D>(e, state.q);
        return control_points<D>(e.element.basis(q), q);
      });
}

double span_twist(const BeamSystem& system, const State& state, int span) {
  if (!system.model().beams[system.mesh().spans[span].beam].has_torsion()) return SectionRecord::no_number;
  const MeshElement<3>& e = system.assembly<3>()->elements()[span];
  return twist_since_start(e, state, e.element.place(gather<3>(e, state.q), 1));
}

double position_error(const BeamSystem& system, const State& state, int span) {
  return with_assembly(
      system,
      [&]<int D>(const Assembly<D>& a) {
        const MeshElement<D>& e = a.elements()[span];
        const ElementVector<D> q = gather<D>(e, state.q);
        const double length = q[ElementLayout<D>::place(1)] - q[ElementLayout<D>::place(0)];
        const double of_shape =
            quartic_strain_to_error * std::abs(e.element.strain_coefficients(q)[4]) * length;
        const double turned =
            misfit_to_turn * elastic_curvature<D>(e, state, length) * length * bending_misfit<D>(e, q);
        return of_shape + turned * e.element.curve().length();
      });
}

std::optional<AssumedStrain> assumed_strain(const BeamSystem& system, const State& state, int span) {
  return with_assembly(
      system,
      [&]<int D>(const Assembly<D>& a) {
        return a.elements()[span].element.assumed_strain(gather<D>(a.elements()[span], state.q));
      });
}

OwnSlopes own_slopes(const BeamSystem& system, int span) {
  return with_assembly(
      system, [&]<int D>(const Assembly<D>& a) { return a.elements()[span].element.own_slopes(); });
}

SpanStrain::SpanStrain(const BeamSystem& system, const State& state, int span, int k)
    : system_(system), span_(span) {
  with_assembly(
      system,
      [&]<int D>(const Assembly<D>& a) {
        const MeshElement<D>& e = a.elements()[span];
        const ElementVector<D> q = gather<D>(e, state.q);
        const double length = q[ElementLayout<D>::place(1)] - q[ElementLayout<D>::place(0)];
        stretch_ = k == 0 ? e.element.stretch(q) : length * e.element.stretch_coefficient(q, k);
        of_axis_ = k == 0 ? e.element.strain_of_axis(q) : 0;
      });
}

StrainIntegral SpanStrain::at(const State& state) const {
  return with_assembly(
      system_,
      [&]<int D>(const Assembly<D>& a) {
        ElementNodes<D> e = ElementLayout<D>::nodes(gather<D>(a.elements()[span_], state.q));
        // Positions count from the start of the span, so that strains far from the origin are not lost in
        // round-off.
        e.col(2) -= e.col(0);
        e.col(0).setZero();
        const ElementNodes<D> gradient = e * stretch_;
        const auto by = [&](int node) { return widened<D>(Eigen::Matrix<double, D, 1>(gradient.col(node))); };
        return StrainIntegral{gradient.cwiseProduct(e).sum() / 2 - of_axis_, {by(0), by(2)}, {by(1), by(3)}};
      });
}

Eigen::Vector4d element_weights(const BeamSystem& system, const State& state, int span) {
  return with_assembly(
      system,
      [&]<int D>(const Assembly<D>& a) {
        const MeshElement<D>& e = a.elements()[span];
        return e.element.bezier_weights(gather<D>(e, state.q));
      });
}

}  // namespace nurbeam
