// Elements with torsion whose ends move over the material.
#include "tests/fem/element/twist_states.h"

namespace nurbeam {
namespace {

using Vector3d = Eigen::Vector3d;
using Matrix3d = Eigen::Matrix3d;
using Layout = TwistLayout;
using Coordinates = TwistElement::Coordinates;

Coordinates with_places(std::mt19937& random, double amount) {
  std::uniform_real_distribution<double> unit(-amount, amount);
  return Coordinates::NullaryExpr([&] { return unit(random); });
}

/// Two curves of CAD segments that meet with unlike curvature and twist.
ReferenceCurve chain() {
  const std::array<Vector3d, 4> P{Vector3d(0.6, 1.5, 1.4), {0, 1, 1.4}, {0.2, 0.4, 1.7}, {0.9, 0.3, 1.9}};
  // The first leaves along P1 - P0 of this one.
  const RationalCubic second = cubic(P, {1, 1.1, 0.9, 1});
  const RationalCubic first =
      cubic({Vector3d(1.9, 2.2, 0.6), {1.7, 2.4, 1.1}, {0.9, 1.75, 1.4}, {0.6, 1.5, 1.4}}, {1, 0.9, 1.2, 1});
  return ReferenceCurve({first, second}, 3)
      .oriented({Orientation::Rule::up, {0.3, -0.2, 1}, {{0, 0}, {3, 2}}});
}

/// An element of which both ends move, in one CAD segment or over the break of a chain.
struct Sliding {
  ReferenceCurve curve;
  BeamProperties beam;
  double s_a, s_b;
  Chart chart;
  TwistElement element;
  TwistState x;

  explicit Sliding(int seed, bool over_break = false, double damping = 0)
      : curve(over_break ? chain() : bent_curve()),
        beam(properties(damping)),
        s_a(over_break ? curve.breaks()[1] - 0.25 : 0.4),
        s_b(over_break ? curve.breaks()[1] + 0.4 : 1.3),
        chart{.segment = over_break ? -1 : 0, .constant_weights = {}},
        element(curve, beam, chart, s_a, s_b, Ends::moving) {
    std::mt19937 random(seed);
    x.q = drawn_state(curve, s_a, s_b) + random_coordinates(random, 0.2);
    x.v = with_places(random, 1);
    x.a = with_places(random, 1);
  }
  Sliding(const Sliding&) = delete;
  Sliding& operator=(const Sliding&) = delete;

  TwistState moved(const Coordinates& q, const Coordinates& v, const Coordinates& a, double h) const {
    return {x.q + h * q, x.v + h * v, x.a + h * a};
  }
  TwistState at_rest() const { return {x.q, Coordinates::Zero(), Coordinates::Zero()}; }
};

TEST(MovingTwist, IsTheFixedElementWhereItsPlacesStandStill) {
  for (const double damping : {0.0, 0.3}) {
    const Deformed fixed(21, damping);
    const TwistElement moving(fixed.curve, fixed.beam, Chart{.segment = 0, .constant_weights = {}}, fixed.s_a,
                              fixed.s_b, Ends::moving);
    const Coordinates f = fixed.element.force(fixed.x), g = moving.force(fixed.x);
    for (int i = 0; i < Layout::size; ++i) {
      if (i == Layout::place(0) || i == Layout::place(1)) continue;
      EXPECT_NEAR(g[i], f[i], 1e-12 * f.norm()) << i;
    }
    const TwistEnergy a = fixed.element.energy(fixed.x), b = moving.energy(fixed.x);
    EXPECT_NEAR(b.kinetic, a.kinetic, 1e-13 * a.kinetic);
    EXPECT_NEAR(b.bending, a.bending, 1e-13 * a.bending);
    EXPECT_NEAR(b.torsion, a.torsion, 1e-13 * a.torsion);
    EXPECT_NEAR(b.dissipation, a.dissipation, 1e-12 * a.dissipation);
  }
}

TEST(MovingTwist, HasTheGradientOfItsStrainEnergyAsForce) {
  for (const bool over_break : {false, true})
    for (int seed = 1; seed <= 3; ++seed) {
      const Sliding d(seed, over_break);
      const Coordinates F = d.element.force(d.at_rest());
      std::mt19937 random(seed + 10);
      Coordinates places = Coordinates::Zero();
      places[Layout::place(seed % 2)] = 1;
      for (const Coordinates& direction : {with_places(random, 1), places})
        expect_derivative(
            [&](double h) {
              return Scalar(
                  strain_energy(d.element, d.moved(direction, Coordinates::Zero(), Coordinates::Zero(), h)));
            },
            Scalar(F.dot(direction)), 5e-4);
    }
}

TEST(MovingTwist, HasTheDerivativeOfItsForceAsTangent) {
  for (const bool over_break : {false, true})
    for (const double damping : {0.0, 0.3}) {
      const Sliding d(5, over_break, damping);
      std::mt19937 random(6);
      const Coordinates q = with_places(random, 1), v = with_places(random, 1), a = with_places(random, 1);
      const Coordinates derivative = d.element.tangent(d.x, {.stiffness = 1}) * q +
                                     d.element.tangent(d.x, {.damping = 1}) * v +
                                     d.element.tangent(d.x, {.mass = 1}) * a;
      expect_derivative([&](double h) { return d.element.force(d.moved(q, v, a, h)); }, derivative, 2e-4);
      const TwistLayout::Matrix sum = 0.7 * d.element.tangent(d.x, {.mass = 1}) +
                                      1.3 * d.element.tangent(d.x, {.damping = 1}) +
                                      2.1 * d.element.tangent(d.x, {.stiffness = 1});
      const TangentWeights w{.mass = 0.7, .damping = 1.3, .stiffness = 2.1};
      EXPECT_LT((d.element.tangent(d.x, w) - sum).norm(), 1e-13 * sum.norm());
    }
}

TEST(MovingTwist, HasASymmetricStiffnessAndMass) {
  for (const bool over_break : {false, true}) {
    const Sliding d(7, over_break);
    const TwistLayout::Matrix K = d.element.tangent(d.at_rest(), {.stiffness = 1});
    EXPECT_LT((K - K.transpose()).norm(), 1e-13 * K.norm());
    const TwistLayout::Matrix M = d.element.tangent(d.x, {.mass = 1});
    EXPECT_LT((M - M.transpose()).norm(), 1e-15 * M.norm());
    EXPECT_NEAR(d.element.energy(d.x).kinetic, d.x.v.dot(M * d.x.v) / 2, 1e-14);
    EXPECT_GT(d.element.energy(d.x).kinetic, 1e-3);
  }
}

TEST(MovingTwist, HasTheEulerLagrangeExpressionOfItsSpinAsInertia) {
  for (const bool over_break : {false, true}) {
    const Sliding d(8, over_break);
    const Coordinates inertia = d.element.force(d.x) - d.element.force(d.at_rest());
    const auto kinetic = [&](const Coordinates& q, const Coordinates& v) {
      return d.element.energy({q, v, Coordinates::Zero()}).kinetic;
    };
    for (int i = 0; i < Layout::size; ++i) {
      const Coordinates direction = Coordinates::Unit(i);
      const auto momentum = [&](double t) {
        const Coordinates q = d.x.q + t * d.x.v + t * t / 2 * d.x.a, v = d.x.v + t * d.x.a;
        return (kinetic(q, v + direction) - kinetic(q, v - direction)) / 2;
      };
      const auto action = [&](double h) { return momentum(h) - kinetic(d.x.q + h * direction, d.x.v); };
      const double h = 1e-4;
      EXPECT_NEAR((8 * (action(h) - action(-h)) - (action(2 * h) - action(-2 * h))) / (12 * h), inertia[i],
                  1e-9 * inertia.norm())
          << i;
    }
  }
}

TEST(MovingTwist, DissipatesWhatItsDampingTakes) {
  for (const bool over_break : {false, true}) {
    const Sliding damped(11, over_break, 0.3), elastic(11, over_break);
    const Coordinates viscous = damped.element.force(damped.x) - elastic.element.force(elastic.x);
    const double dissipation = damped.element.energy(damped.x).dissipation;
    EXPECT_GT(dissipation, 0.1);
    EXPECT_NEAR(viscous.dot(damped.x.v), dissipation, 1e-12 * dissipation);
    std::mt19937 random(12);
    const Coordinates direction = with_places(random, 1);
    const auto rayleigh = [&](double sign) {
      return damped.element.energy({damped.x.q, damped.x.v + sign * direction, damped.x.a}).dissipation / 2;
    };
    EXPECT_NEAR((rayleigh(1) - rayleigh(-1)) / 2, viscous.dot(direction), 1e-12 * dissipation);
  }
}

/// The drawn element between places that move.
TwistState over_rod_at_rest(const ReferenceCurve& curve, const std::array<double, 2>& s,
                            const std::array<double, 2>& rate, const TwistElement& element) {
  TwistState x{drawn_state(curve, s[0], s[1]), Coordinates::Zero(), Coordinates::Zero()};
  for (const int end : {0, 1}) {
    const DrawnSection section = curve.section(s[end], end == 1);
    x.v.segment<3>(Layout::r(end)) = rate[end] * section.t;
    x.v.segment<3>(Layout::slope(end)) = rate[end] * section.curvature.cross(section.t);
    x.v[Layout::place(end)] = rate[end];
    x.v[Layout::angle(end)] =
        rate[end] * section.twist -
        spin_row<double>(element.chart(end), section.t).dot(Vector3d(x.v.segment<3>(Layout::slope(end))));
  }
  return x;
}

// K13.
TEST(MovingTwist, MovesNothingWhereItsNodesSlideOverARodAtRest) {
  const ReferenceCurve curve = bent_curve();
  const BeamProperties beam = properties(0.2);
  for (const auto& rate : {std::array{3.0, 0.0}, std::array{-1.0, 2.0}}) {
    const TwistElement element(curve, beam, Chart{.segment = 0, .constant_weights = {}}, 0.4, 1.3,
                               Ends::moving);
    const TwistState x = over_rod_at_rest(curve, {0.4, 1.3}, rate, element);
    const TwistEnergy energy = element.energy(x);
    EXPECT_LT(energy.kinetic, 1e-28);
    EXPECT_LT(energy.bending + energy.torsion, 1e-25);
    EXPECT_LT(energy.dissipation, 1e-22);
    // Nothing changes while they slide.
    TwistState later = over_rod_at_rest(curve, {0.4 + 0.05 * rate[0], 1.3 + 0.05 * rate[1]}, rate, element);
    const auto section_angle = [&](int end) {
      const double s = later.q[Layout::place(end)];
      const Vector3d rs = later.q.segment<3>(Layout::slope(end));
      const SectionTriad<double> zero = section_at_node<double>(element.chart(end), rs, 0.0);
      const Vector3d d1 = curve.section(s).d1;
      return std::atan2(d1.dot(zero.d2), d1.dot(zero.d1));
    };
    for (const int end : {0, 1}) later.q[Layout::angle(end)] = section_angle(end);
    EXPECT_LT(strain_energy(element, later), 1e-25);
    EXPECT_LT(element.energy(later).kinetic, 1e-28);
    EXPECT_LT(element.force({later.q, Coordinates::Zero(), Coordinates::Zero()}).norm(), 1e-11);
  }
}

TEST(MovingTwist, DoesNotKnowItsCharts) {
  const Sliding d(14, false, 0.2);
  std::array<Matrix3d, 2> charts;
  TwistState x = d.x;
  for (const int end : {0, 1}) {
    charts[end] = d.element.end_section(d.x.q, end).matrix();
    x.q[Layout::angle(end)] = 0;
    x.v[Layout::angle(end)] = d.element.spin(d.x, end);
  }
  const TwistElement other(d.curve, d.beam, d.chart, d.s_a, d.s_b, Ends::moving, charts,
                           d.element.turn(d.x.q));
  const TwistEnergy energy = d.element.energy(d.x), same = other.energy(x);
  EXPECT_NEAR(same.kinetic, energy.kinetic, 1e-13 * energy.kinetic);
  EXPECT_NEAR(same.bending, energy.bending, 1e-12 * energy.bending);
  EXPECT_NEAR(same.torsion, energy.torsion, 1e-12 * energy.torsion);
  EXPECT_NEAR(same.dissipation, energy.dissipation, 1e-12 * energy.dissipation);
  const Coordinates f = d.element.force(d.at_rest()),
                    g = other.force({x.q, Coordinates::Zero(), Coordinates::Zero()});
  for (const int end : {0, 1}) EXPECT_NEAR(f[Layout::place(end)], g[Layout::place(end)], 1e-12 * f.norm());
  EXPECT_NEAR(d.element.material_spin(d.x, 0.77), other.material_spin(x, 0.77), 1e-13);
}

TEST(MovingTwist, LetsAMomentWorkOnTheSpinOfItsSection) {
  for (const bool over_break : {false, true}) {
    const Sliding d(18, over_break);
    const Vector3d moment(0.3, -0.5, 0.8);
    for (const double share : {0.3, 0.7}) {
      const double s = d.s_a + share * (d.s_b - d.s_a);
      const auto triad = [&](double t) { return d.element.section(d.x.q + t * d.x.v, s).triad.matrix(); };
      const auto power = [&](double h) {
        const Matrix3d W = (triad(h) - triad(-h)) / (2 * h) * triad(0).transpose();
        const Vector3d spin = Vector3d(W(2, 1) - W(1, 2), W(0, 2) - W(2, 0), W(1, 0) - W(0, 1)) / 2;
        return Scalar(spin.dot(moment));
      };
      const Scalar exact(d.element.moment_force(d.x.q, s, {moment, false, {}}).dot(d.x.v));
      const double coarse = std::abs(power(1e-3)[0] - exact[0]), fine = std::abs(power(5e-4)[0] - exact[0]);
      EXPECT_LT(coarse, 1e-2);
      EXPECT_NEAR(coarse / fine, 4, 0.25);
      for (const bool follower : {false, true})
        expect_derivative(
            [&](double h) {
              return d.element.moment_force(d.x.q + h * d.x.v, s, {moment, follower, {}});
            },
            Coordinates(d.element.moment_gradient(d.x.q, s, {moment, follower, {}}) * d.x.v), 5e-4);
      expect_derivative([&](double h) { return d.element.turned(d.x.q + h * d.x.v, s, moment).value; },
                        Vector3d(d.element.turned(d.x.q, s, moment).gradient * d.x.v), 5e-4);
    }
  }
}

// The spin of the material is what counts as kinetic energy.
TEST(MovingTwist, TellsTheSpinOfTheMaterial) {
  const Sliding d(20);
  double sum = 0;
  for (int g = 0; g < GaussRule::size; ++g) {
    const double h = d.s_b - d.s_a, s = d.s_a + h * GaussRule::points[g];
    sum += 0.04 / 2 * h * GaussRule::weights[g] * std::pow(d.element.material_spin(d.x, s), 2);
  }
  const double kinetic = d.element.energy(d.x).kinetic;
  EXPECT_NEAR(sum, kinetic, 1e-13 * kinetic);
}

}  // namespace
}  // namespace nurbeam
