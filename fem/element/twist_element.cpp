#include "fem/element/twist_element.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "fem/element/twist_rows.h"
#include "nurbs/number_text.h"

namespace nurbeam {

namespace {

/// Cosine of the angle of a tangent with its chart's, and with the tangent at A.
constexpr double smallest_cosine = -0.5;
constexpr double largest_turn = 3;  ///< difference of the turn from its reference [rad]

SectionTriad<double> triad(const DrawnSection& section) { return {section.d1, section.d2, section.t}; }

const BeamProperties& checked(const ReferenceCurve& curve, const BeamProperties& properties) {
  if (!curve.has_sections() || !properties.sections)
    throw std::invalid_argument(
        "a beam with torsion needs the orientation and the stiffness of its sections");
  const SectionStiffness& k = *properties.sections;
  if (!(k.bending_1 > 0 && k.bending_1 * k.bending_2 > k.bending_product * k.bending_product &&
        k.torsion > 0 && k.spin_inertia > 0))
    throw std::invalid_argument(
        "the sections of a beam with torsion need positive inertia and stiffness, got EI1 = " +
        text_of(k.bending_1) + ", EI2 = " + text_of(k.bending_2) + ", EI12 = " + text_of(k.bending_product) +
        ", GJ = " + text_of(k.torsion) + " N m^2 and " + text_of(k.spin_inertia) + " kg m");
  if (properties.curvature != CurvatureMeasure::material)
    throw std::invalid_argument("a beam with torsion has the material curvature");
  return properties;
}

std::array<Eigen::Matrix3d, 2> drawn_charts(const ReferenceCurve& curve, const BeamProperties& properties,
                                            double s_a, double s_b) {
  checked(curve, properties);
  return {triad(curve.section(s_a)).matrix(), triad(curve.section(s_b, true)).matrix()};
}

}  // namespace

TwistElement::TwistElement(const ReferenceCurve& curve, const BeamProperties& properties, const Chart& chart,
                           double s_a, double s_b, Ends ends)
    : TwistElement(curve, properties, chart, s_a, s_b, ends, drawn_charts(curve, properties, s_a, s_b),
                   std::nullopt) {}

TwistElement::TwistElement(const ReferenceCurve& curve, const BeamProperties& properties, const Chart& chart,
                           double s_a, double s_b, Ends ends, const std::array<SectionChart, 2>& charts,
                           std::optional<double> turn)
    : curve_(&curve),
      properties_(&checked(curve, properties)),
      chart_(chart),
      ends_(ends),
      s_a_(s_a),
      s_b_(s_b),
      charts_(charts),
      turn_(turn.value_or(0)) {
  if (turn && !fixed()) return;
  const twist::DrawnElement<Dual<2>> drawn(curve, chart, s_a, s_b);
  if (!turn) turn_ = drawn.turn();
  if (fixed()) set_fixed(drawn);
}

// Sets the drawing of an element with fixed ends, which has one part.
void TwistElement::set_fixed(const twist::DrawnElement<Dual<2>>& drawn) {
  if (drawn.drawing().points.size() != points)
    throw std::invalid_argument("an element with torsion whose ends are fixed spans no break of the drawing");
  const twist::AnyDrawing<double> all = at_places(drawn.drawing(), s_a_, s_b_);
  drawing_.h = all.h;
  drawing_.weights = all.weights;
  drawing_.end_angle = all.end_angle;
  spin_mass_.setZero();
  for (int g = 0; g < points; ++g) {
    drawing_.points[g] = fixed_point(all.points[g]);
    drawn_rates_[g] = drawn.rate(g);
    const double xi = drawing_.points[g].xi;
    const Eigen::Vector3d N(1 - xi, xi, twist::bubble_shape(xi));
    spin_mass_ += properties_->sections->spin_inertia * drawing_.weights[g] * N * N.transpose();
  }
}

// The element in other charts with another turn; its numbers of the drawing depend on neither.
TwistElement TwistElement::in_charts(const std::array<SectionChart, 2>& charts, double turn) const {
  TwistElement element = *this;
  element.charts_ = charts;
  element.turn_ = turn;
  return element;
}

TwistElement::FixedPoint TwistElement::fixed_point(const twist::AnyPoint<double>& p) {
  return {p.xi, p.S1, p.S2, p.transport, p.angle, p.k1, p.k2};
}

// DrawnElement::point where no place varies, as loads ask for it at every evaluation.
TwistElement::FixedPoint TwistElement::fixed_point(double s) const {
  const ShapeFunctions<double> shape = ElementBasis<double>(*curve_, chart_, s_a_, s_b_).at(s);
  const DrawnSection at_a = curve_->section(s_a_), here = curve_->section(s, s > (s_a_ + s_b_) / 2);
  FixedPoint p;
  p.xi = (s - s_a_) / drawing_.h;
  p.S1 << shape.d1[2], shape.d1[1], shape.d1[3];
  p.S2 << shape.d2[2], shape.d2[1], shape.d2[3];
  for (int j = 0; j < points; ++j) p.transport[j] = drawing_.h * twist::integrated_lagrange(j, p.xi);
  const double transported = p.transport.dot(drawn_rates_),
               near = curve_->section_turn(s_a_, s) + transported;
  p.angle = SectionTurn<double>(triad(at_a), triad(here), near).angle - transported;
  const Eigen::Vector3d K = curve_->straight() ? Eigen::Vector3d::Zero() : here.curvature;
  p.k1 = K.dot(here.d1);
  p.k2 = K.dot(here.d2);
  return p;
}

TwistElement::Coordinates TwistElement::force(const TwistState& x) const {
  return fixed() ? fixed_force(x) : moving_force(x);
}

TwistElement::Matrix TwistElement::tangent(const TwistState& x, const TangentWeights& w) const {
  return fixed() ? fixed_tangent(x, w) : moving_tangent(x, w);
}

TwistEnergy TwistElement::energy(const TwistState& x) const {
  return fixed() ? fixed_energy(x) : moving_energy(x);
}

double TwistElement::spin(const TwistState& x, int end) const {
  const Eigen::Vector3d rs = x.q.segment<3>(TwistLayout::slope(end));
  return x.v[TwistLayout::angle(end)] +
         spin_row<double>(charts_[end], rs).dot(x.v.segment<3>(TwistLayout::slope(end)));
}

SectionTriad<double> TwistElement::end_section(const Coordinates& q, int end) const {
  return section_at_node<double>(charts_[end], q.segment<3>(TwistLayout::slope(end)),
                                 q[TwistLayout::angle(end)]);
}

// The inverse of node_force: on_slope = (mu x r_s)/|r_s|^2 + (mu . t) c, on_angle = mu . t.
Eigen::Vector3d TwistElement::end_moment(const Coordinates& q, int end, const Eigen::Vector3d& on_slope,
                                         double on_angle) const {
  const Eigen::Vector3d rs = q.segment<3>(TwistLayout::slope(end));
  return rs.cross(on_slope - on_angle * spin_row<double>(charts_[end], rs)) + on_angle * rs.normalized();
}

double TwistElement::turn(const Coordinates& q) const {
  return SectionTurn<double>(end_section(q, 0), end_section(q, 1), turn_).angle;
}

// Whether the tangents are within this cosine of their charts', and the turn is within reach of its
// reference.
bool TwistElement::near_charts(const Coordinates& q, double cosine, double turn_reach) const {
  for (const int end : {0, 1})
    if (!(end_section(q, end).t.dot(charts_[end].col(2)) > cosine)) return false;
  return std::abs(turn(q) - turn_) < turn_reach;
}

bool TwistElement::should_recentre(const Coordinates& q) const { return !near_charts(q, 0.5, 2); }

bool TwistElement::admissible(const Coordinates& q) const {
  if (!near_charts(q, smallest_cosine, largest_turn)) return false;
  const Reduced<double> x = twist::reduced_of<fixed_rows>(q);
  const Eigen::Vector3d t_a = end_section(q, 0).t;
  if (!(t_a.dot(end_section(q, 1).t) > smallest_cosine)) return false;
  const auto opens = [&](const Eigen::Vector3d& S1) {
    const Eigen::Vector3d rs = x.segment<3>(twist::chord) * S1[0] + x.segment<3>(twist::slope_a) * S1[1] +
                               x.segment<3>(twist::slope_b) * S1[2];
    return rs.dot(t_a) > smallest_cosine * rs.norm();
  };
  if (fixed())
    return std::all_of(drawing_.points.begin(), drawing_.points.end(),
                       [&](const FixedPoint& p) { return opens(p.S1); });
  const twist::QuadraturePlaces<double> places(*curve_, chart_, q[TwistLayout::place(0)],
                                               q[TwistLayout::place(1)]);
  for (std::size_t g = 0; g < places.size(); ++g) {
    const ShapeFunctions<double> shape = places.basis.at(places.place(g));
    if (!opens({shape.d1[2], shape.d1[1], shape.d1[3]})) return false;
  }
  return true;
}

}  // namespace nurbeam
