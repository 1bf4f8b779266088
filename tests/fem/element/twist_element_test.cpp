#include "fem/element/twist_element.h"

#include "tests/fem/element/twist_states.h"

namespace nurbeam {
namespace {

using Matrix3d = Eigen::Matrix3d;
using Vector3d = Eigen::Vector3d;
using Layout = TwistLayout;
using Coordinates = TwistElement::Coordinates;

TEST(TwistElement, HasTheGradientOfItsStrainEnergyAsForce) {
  for (int seed = 1; seed <= 4; ++seed) {
    const Deformed d(seed);
    TwistState at_rest = d.x;
    at_rest.v.setZero();
    at_rest.a.setZero();
    const Coordinates F = d.element.force(at_rest);
    std::mt19937 random(seed + 10);
    const Coordinates direction = random_coordinates(random, 1);
    expect_derivative(
        [&](double h) {
          return Scalar(
              strain_energy(d.element, d.moved(direction, Coordinates::Zero(), Coordinates::Zero(), h)));
        },
        Scalar(F.dot(direction)), 1e-3);
  }
}

TEST(TwistElement, HasTheDerivativeOfItsForceAsTangent) {
  for (const double damping : {0.0, 0.3}) {
    const Deformed d(5, damping);
    std::mt19937 random(6);
    const Coordinates q = random_coordinates(random, 1), v = random_coordinates(random, 1),
                      a = random_coordinates(random, 1);
    const TangentWeights w{.mass = 0.7, .damping = 1.3, .stiffness = 2.1};
    const Coordinates derivative = d.element.tangent(d.x, {.stiffness = 1}) * q +
                                   d.element.tangent(d.x, {.damping = 1}) * v +
                                   d.element.tangent(d.x, {.mass = 1}) * a;
    expect_derivative([&](double h) { return d.element.force(d.moved(q, v, a, h)); }, derivative, 5e-4);
    const TwistLayout::Matrix sum = 0.7 * d.element.tangent(d.x, {.mass = 1}) +
                                    1.3 * d.element.tangent(d.x, {.damping = 1}) +
                                    2.1 * d.element.tangent(d.x, {.stiffness = 1});
    EXPECT_LT((d.element.tangent(d.x, w) - sum).norm(), 1e-13 * sum.norm());
  }
}

TEST(TwistElement, HasASymmetricStiffnessAndMass) {
  const Deformed d(7);
  TwistState at_rest = d.x;
  at_rest.v.setZero();
  at_rest.a.setZero();
  const TwistLayout::Matrix K = d.element.tangent(at_rest, {.stiffness = 1});
  EXPECT_LT((K - K.transpose()).norm(), 1e-14 * K.norm());
  const TwistLayout::Matrix M = d.element.tangent(d.x, {.mass = 1});
  EXPECT_LT((M - M.transpose()).norm(), 1e-15 * M.norm());
  // Kinetic energy is its quadratic form.
  EXPECT_NEAR(d.element.energy(d.x).kinetic, d.x.v.dot(M * d.x.v) / 2, 1e-15);
  EXPECT_GT(d.element.energy(d.x).kinetic, 1e-3);
}

TEST(TwistElement, HasTheEulerLagrangeExpressionOfItsSpinAsInertia) {
  const Deformed d(8);
  TwistState at_rest = d.x;
  at_rest.v.setZero();
  at_rest.a.setZero();
  const Coordinates inertia = d.element.force(d.x) - d.element.force(at_rest);
  std::mt19937 random(9);
  const Coordinates direction = random_coordinates(random, 1);
  // T is quadratic in v: dT/dv by differences is exact. d/dt(dT/dv . direction) along the motion, less dT/dq.
  const auto kinetic = [&](const Coordinates& q, const Coordinates& v) {
    return d.element.energy({q, v, Coordinates::Zero()}).kinetic;
  };
  const auto momentum = [&](double t) {
    const Coordinates q = d.x.q + t * d.x.v + t * t / 2 * d.x.a, v = d.x.v + t * d.x.a;
    return (kinetic(q, v + direction) - kinetic(q, v - direction)) / 2;
  };
  expect_derivative([&](double h) { return Scalar(momentum(h) - kinetic(d.x.q + h * direction, d.x.v)); },
                    Scalar(inertia.dot(direction)), 1e-3);
}

TEST(TwistElement, DissipatesWhatItsDampingTakes) {
  const Deformed damped(11, 0.3), elastic(11);
  const Coordinates viscous = damped.element.force(damped.x) - elastic.element.force(elastic.x);
  const double dissipation = damped.element.energy(damped.x).dissipation;
  EXPECT_GT(dissipation, 0.1);
  EXPECT_NEAR(viscous.dot(damped.x.v), dissipation, 1e-13 * dissipation);
  // Half of it is Rayleigh's function, quadratic in v: its gradient is the force.
  std::mt19937 random(12);
  const Coordinates direction = random_coordinates(random, 1);
  const auto rayleigh = [&](double sign) {
    return damped.element.energy({damped.x.q, damped.x.v + sign * direction, damped.x.a}).dissipation / 2;
  };
  EXPECT_NEAR((rayleigh(1) - rayleigh(-1)) / 2, viscous.dot(direction), 1e-12 * dissipation);
}

/// The coordinates of the whole turned by R, sections and all.
Coordinates turned(const TwistElement& element, const Coordinates& q, const Matrix3d& R) {
  Coordinates y = q;
  for (const int end : {0, 1}) {
    y.segment<3>(Layout::r(end)) = R * q.segment<3>(Layout::r(end)) + Vector3d(3, -2, 5);
    y.segment<3>(Layout::slope(end)) = R * q.segment<3>(Layout::slope(end));
    // The angle of the turned section in the chart, which stays.
    const SectionTriad<double> section =
        section_at_node<double>(element.chart(end), q.segment<3>(Layout::slope(end)), q[Layout::angle(end)]);
    const SectionTriad<double> at_zero =
        section_at_node<double>(element.chart(end), y.segment<3>(Layout::slope(end)), 0.0);
    const Vector3d d1 = R * section.d1;
    y[Layout::angle(end)] = std::atan2(d1.dot(at_zero.d2), d1.dot(at_zero.d1));
  }
  return y;
}

// K10: the drawing turned by any angle, in one element that turns by 108 degrees and in parts of it.
TEST(TwistElement, IsFreeOfForceInTheDrawnShapeHoweverItIsTurned) {
  const ReferenceCurve curve = bent_curve();
  const BeamProperties beam = properties();
  const double L = curve.length();
  for (const double degrees : {0, 30, 90, 170, 180, 720})
    for (const int parts : {1, 2, 8})
      for (int i = 0; i < parts; ++i) {
        const TwistElement element(curve, beam, Chart{.segment = 0, .constant_weights = {}}, L * i / parts,
                                   L * (i + 1) / parts);
        // The axis of the rotation is near no tangent's opposite.
        const Matrix3d R =
            Eigen::AngleAxisd(degrees * M_PI / 180, Vector3d(0.6, 0.5, 0.62).normalized()).toRotationMatrix();
        TwistState x{turned(element, drawn_state(curve, L * i / parts, L * (i + 1) / parts), R),
                     Coordinates::Zero(), Coordinates::Zero()};
        EXPECT_LT(element.force(x).norm(), 1e-11) << degrees << " degrees, part " << i << " of " << parts;
        EXPECT_LT(strain_energy(element, x), 1e-26);
      }
}

TEST(TwistElement, TurnsItsForcesWithARigidMotion) {
  const Deformed d(13);
  const Matrix3d R = Eigen::AngleAxisd(1.9, Vector3d(1, 2, -2) / 3).toRotationMatrix();
  TwistState x{d.x.q, Coordinates::Zero(), Coordinates::Zero()}, y = x;
  y.q = turned(d.element, d.x.q, R);
  EXPECT_NEAR(strain_energy(d.element, y), strain_energy(d.element, x), 1e-13 * strain_energy(d.element, x));
  const Coordinates f = d.element.force(x), g = d.element.force(y);
  for (const int end : {0, 1}) {
    EXPECT_LT((g.segment<3>(Layout::r(end)) - R * f.segment<3>(Layout::r(end))).norm(), 1e-12 * f.norm());
    EXPECT_NEAR(g[Layout::angle(end)], f[Layout::angle(end)], 1e-12 * f.norm());
  }
}

TEST(TwistElement, DoesNotKnowItsCharts) {
  const Deformed d(14, 0.2);
  // The same state in the charts of the present sections.
  std::array<Matrix3d, 2> charts;
  TwistState x = d.x;
  for (const int end : {0, 1}) {
    const Vector3d rs = d.x.q.segment<3>(Layout::slope(end));
    charts[end] = section_at_node<double>(d.element.chart(end), rs, d.x.q[Layout::angle(end)]).matrix();
    x.q[Layout::angle(end)] = 0;
    x.v[Layout::angle(end)] = d.element.spin(d.x, end);
  }
  const TwistElement other(d.curve, d.beam, Chart{.segment = 0, .constant_weights = {}}, d.s_a, d.s_b,
                           Ends::fixed, charts, d.element.turn(d.x.q));
  const TwistEnergy energy = d.element.energy(d.x), same = other.energy(x);
  EXPECT_NEAR(same.kinetic, energy.kinetic, 1e-14 * energy.kinetic);
  EXPECT_NEAR(same.bending, energy.bending, 1e-13 * energy.bending);
  EXPECT_NEAR(same.torsion, energy.torsion, 1e-13 * energy.torsion);
  EXPECT_NEAR(same.dissipation, energy.dissipation, 1e-13 * energy.dissipation);
  const SectionPoint here = d.element.section(d.x.q, 0.9), there = other.section(x.q, 0.9);
  EXPECT_LT((here.triad.d1 - there.triad.d1).norm(), 1e-14);
  EXPECT_NEAR(here.moments.torque, there.moments.torque, 1e-13);
  // Forces on positions are the same; on angles they are the torques about the tangents, in any chart.
  TwistState at_rest{d.x.q, Coordinates::Zero(), Coordinates::Zero()};
  TwistState same_rest{x.q, Coordinates::Zero(), Coordinates::Zero()};
  const Coordinates f = d.element.force(at_rest), g = other.force(same_rest);
  for (const int i : {Layout::r(0), Layout::r(1)}) EXPECT_LT((f - g).segment<3>(i).norm(), 1e-12 * f.norm());
  EXPECT_LT((f - g).tail<3>().norm(), 1e-12 * f.norm());
}

TEST(TwistElement, IsTheSameInOtherChartsAsOneThatIsMadeInThem) {
  const Deformed d(14);
  std::array<TwistElement::SectionChart, 2> charts;
  for (const int end : {0, 1}) charts[end] = d.element.end_section(d.x.q, end).matrix();
  const double turn = d.element.turn(d.x.q);
  const TwistElement moved = d.element.in_charts(charts, turn);
  const TwistElement made(d.curve, d.beam, Chart{.segment = 0, .constant_weights = {}}, d.s_a, d.s_b,
                          Ends::fixed, charts, turn);
  TwistState x = d.x;
  for (const int end : {0, 1}) x.q[Layout::angle(end)] = 0;  // as it is seen there
  const Coordinates force = made.force(x);
  EXPECT_EQ(moved.force(x), force);
  EXPECT_EQ(moved.tangent(x, {.mass = 1, .damping = 1, .stiffness = 1}),
            made.tangent(x, {.mass = 1, .damping = 1, .stiffness = 1}));
  EXPECT_EQ(moved.turn(x.q), made.turn(x.q));
  EXPECT_GT((d.element.force(x) - force).norm(), 0.01 * force.norm());
}

TEST(TwistElement, TellsTheSpinOfItsEnds) {
  const Deformed d(15);
  for (const int end : {0, 1}) {
    const auto triad = [&](double h) {
      const Coordinates q = d.x.q + h * d.x.v;
      return section_at_node<double>(d.element.chart(end), q.segment<3>(Layout::slope(end)),
                                     q[Layout::angle(end)]);
    };
    expect_derivative([&](double h) { return Scalar(triad(h).d1.dot(triad(0).d2)); },
                      Scalar(d.element.spin(d.x, end)), 1e-3);
  }
}

TEST(TwistElement, HasTheSectionsOfItsNodesAtItsEnds) {
  const Deformed d(16);
  for (const int end : {0, 1}) {
    const SectionTriad<double> node = section_at_node<double>(
        d.element.chart(end), d.x.q.segment<3>(Layout::slope(end)), d.x.q[Layout::angle(end)]);
    const SectionPoint point = d.element.section(d.x.q, end == 0 ? d.s_a : d.s_b);
    EXPECT_LT((point.triad.d1 - node.d1).norm(), 1e-13);
    EXPECT_LT((point.triad.d2 - node.d2).norm(), 1e-13);
    EXPECT_LT((point.triad.t - node.t).norm(), 1e-13);
  }
}

// Curvatures and twist of the sections along the element, from their triads by differences.
TEST(TwistElement, StrainsByTheRatesAtWhichItsSectionsTurn) {
  const ReferenceCurve curve = bent_curve();
  const BeamProperties beam = properties();
  // Short: inside the element transport is a quadrature.
  const TwistElement element(curve, beam, Chart{.segment = 0, .constant_weights = {}}, 0.8, 1);
  std::mt19937 random(17);
  Coordinates q = drawn_state(curve, 0.8, 1) + random_coordinates(random, 0.01);
  const double s = 0.87;
  const SectionPoint here = element.section(q, s);
  const DrawnSection drawn = curve.section(s);
  const auto triad = [&](double h) { return element.section(q, s + h).triad; };
  const auto rate = [&](const auto& part) { return (part(triad(1e-4)) - part(triad(-1e-4))) / 2e-4; };
  const double k1 = -rate([&](const auto& x) { return x.t.dot(here.triad.d2); });
  const double k2 = rate([&](const auto& x) { return x.t.dot(here.triad.d1); });
  const double twist = rate([&](const auto& x) { return x.d1.dot(here.triad.d2); });
  EXPECT_NEAR(here.strain.bend_1, k1 - drawn.curvature.dot(drawn.d1), 1e-6);
  EXPECT_NEAR(here.strain.bend_2, k2 - drawn.curvature.dot(drawn.d2), 1e-6);
  EXPECT_NEAR(here.strain.twist, twist - drawn.twist, 1e-5);
  EXPECT_GT(std::abs(here.strain.twist), 1e-3);
}

// The spin of a section is that of its triad as the element moves.
Vector3d spin_of(const Deformed& d, double s, double h) {
  const auto triad = [&](double t) { return d.element.section(d.x.q + t * d.x.v, s).triad.matrix(); };
  const Matrix3d W = (triad(h) - triad(-h)) / (2 * h) * triad(0).transpose();
  return Vector3d(W(2, 1) - W(1, 2), W(0, 2) - W(2, 0), W(1, 0) - W(0, 1)) / 2;
}

TEST(TwistElement, LetsAMomentWorkOnTheSpinOfItsSection) {
  const Deformed d(18);
  const Vector3d moment(0.3, -0.5, 0.8);
  for (const double s : {d.s_a, 0.77, d.s_b}) {
    const double power = d.element.moment_force(d.x.q, s, {moment, false, {}}).dot(d.x.v);
    const auto error = [&](double h) { return std::abs(spin_of(d, s, h).dot(moment) - power); };
    EXPECT_LT(error(1e-3), 1e-3);
    EXPECT_NEAR(error(1e-3) / error(5e-4), 4, 0.2);
    // A follower has the same components along the section's axes as in the drawing.
    const SectionTriad<double> now = d.element.section(d.x.q, s).triad;
    const DrawnSection drawn = d.curve.section(s, s == d.s_b);
    const Vector3d turned_moment =
        now.d1 * drawn.d1.dot(moment) + now.d2 * drawn.d2.dot(moment) + now.t * drawn.t.dot(moment);
    EXPECT_LT((d.element.moment_force(d.x.q, s, {moment, true, {}}) -
               d.element.moment_force(d.x.q, s, {turned_moment, false, {}}))
                  .norm(),
              1e-14);
    EXPECT_LT((d.element.turned(d.x.q, s, moment).value - turned_moment).norm(), 1e-14);
  }
}

TEST(TwistElement, KnowsTheDerivativesOfMomentsAndTurnedVectors) {
  const Deformed d(19);
  const Vector3d moment(0.3, -0.5, 0.8);
  const Coordinates direction = d.x.v;
  for (const double s : {d.s_a, 0.77, d.s_b}) {
    for (const bool follower : {false, true})
      expect_derivative(
          [&](double h) {
            return d.element.moment_force(d.x.q + h * direction, s, {moment, follower, {}});
          },
          Coordinates(d.element.moment_gradient(d.x.q, s, {moment, follower, {}}) * direction), 1e-3);
    expect_derivative([&](double h) { return d.element.turned(d.x.q + h * direction, s, moment).value; },
                      Vector3d(d.element.turned(d.x.q, s, moment).gradient * direction), 1e-3);
  }
}

TEST(TwistElement, TwistsAStraightRodByItsTorqueOverItsStiffness) {
  const ReferenceCurve curve = ReferenceCurve({line_cubic({0, 0, 0}, {2, 0, 0})}, 3).oriented({});
  const BeamProperties beam = properties();
  const TwistElement element(curve, beam, Chart{.segment = 0, .constant_weights = {}}, 0, 2);
  TwistState x{drawn_state(curve, 0, 2), Coordinates::Zero(), Coordinates::Zero()};
  x.q[Layout::angle(1)] = 1.4;
  const Coordinates f = element.force(x);
  EXPECT_NEAR(f[Layout::angle(1)], 0.7 * 1.4 / 2, 1e-15);
  EXPECT_NEAR(f[Layout::angle(0)], -0.7 * 1.4 / 2, 1e-15);
  EXPECT_NEAR(element.energy(x).torsion, 0.7 * 1.4 * 1.4 / 4, 1e-15);
  EXPECT_NEAR(element.section(x.q, 1.1).moments.torque, 0.49, 1e-15);
  EXPECT_NEAR(f.head<Layout::first>().norm(), 0, 1e-14);
}

TEST(TwistElement, IsInadmissibleNearWhatItCannotTell) {
  const ReferenceCurve curve = ReferenceCurve({line_cubic({0, 0, 0}, {2, 0, 0})}, 3).oriented({});
  const BeamProperties beam = properties();
  const TwistElement element(curve, beam, Chart{.segment = 0, .constant_weights = {}}, 0, 2);
  const Coordinates drawn = drawn_state(curve, 0, 2);
  EXPECT_TRUE(element.admissible(drawn));
  Coordinates twisted = drawn;
  twisted[Layout::angle(1)] = 2.9;
  EXPECT_TRUE(element.admissible(twisted));
  twisted[Layout::angle(1)] = 3.1;
  EXPECT_FALSE(element.admissible(twisted));
  Coordinates reversed = drawn;
  reversed.segment<3>(Layout::slope(1)) = Vector3d(-0.7, 0.5, 0);
  EXPECT_FALSE(element.admissible(reversed));
}

TEST(TwistElement, RefusesSectionsWithoutStiffnessOrOrientation) {
  const ReferenceCurve curve = bent_curve();
  BeamProperties beam = properties();
  const auto make = [&] { TwistElement(curve, beam, Chart{.segment = 0, .constant_weights = {}}, 0, 1); };
  EXPECT_NO_THROW(make());
  beam.sections->bending_product = 2;  // more than sqrt(3)
  EXPECT_THROW(make(), std::invalid_argument);
  beam = properties();
  beam.sections->torsion = 0;
  EXPECT_THROW(make(), std::invalid_argument);
  beam = properties();
  beam.curvature = CurvatureMeasure::spatial;
  EXPECT_THROW(make(), std::invalid_argument);
  beam.sections.reset();
  EXPECT_THROW(make(), std::invalid_argument);
  const ReferenceCurve bare({line_cubic({0, 0, 0}, {2, 0, 0})}, 3);
  beam = properties();
  EXPECT_THROW(TwistElement(bare, beam, Chart{.segment = 0, .constant_weights = {}}, 0, 1),
               std::invalid_argument);
}

}  // namespace
}  // namespace nurbeam
