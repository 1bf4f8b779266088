#include "fem/comparison/printed_element.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/support/curves.h"

namespace nurbeam {
namespace {

constexpr double E = 2e6, area = 1e-3, inertia = 1e-7, density = 6000;

BeamProperties bar() {
  BeamProperties beam{E * area, E * inertia, density * area};
  beam.axial_strain = AxialStrain::pointwise;
  return beam;
}

/// r = (x, a x^2/2) over 0 <= x <= l with weights 1: r_x = (1, a x), r_xx = (0, a).
RancfElement parabola(double a, double l) {
  RancfElement element;
  element.e << 0, 1, l, 1,         //
      0, 0, a * l * l / 2, a * l,  //
      0, 0, 0, 0;
  element.weights.setOnes();
  element.l = l;
  return element;
}

PrintedElement::Nodes in_plane(const RancfElement& element) { return element.e.topRows<2>(); }

RancfElement uneven_arc() {
  RancfElement element;
  element.e << 0, 0.667185831, 0.5 * std::sin(std::numbers::pi / 3), 0.68333751,  //
      0, 0, 0.25, 1.18361,                                                        //
      0, 0, 0, 0;
  element.weights << 1, 1.08621103, 0.98905339, 1;
  element.l = std::numbers::pi / 6;
  return element;
}

TEST(PrintedElement, HasTheEnergiesOfAParabolaInClosedForm) {
  constexpr double a = 0.7, l = 0.9;
  const RancfElement drawn = parabola(a, l);
  const PrintedElement second(drawn, bar(), PrintedCurvature::second_derivative, PrintedStart::straight);
  const PrintedElement::Energy energy = second.elastic_energy(in_plane(drawn));
  EXPECT_NEAR(energy.bending, E * inertia * a * a * l / 2, 1e-15);
  EXPECT_NEAR(energy.axial, E * area * std::pow(a, 4) * std::pow(l, 5) / 40, 1e-12);
  // int a^2/(1 + a^2 x^2)^3 dx = a [t/(4 (1 + t^2)^2) + 3 t/(8 (1 + t^2)) + 3 atan(t)/8], t = a l.
  const PrintedElement spatial(drawn, bar(), PrintedCurvature::spatial, PrintedStart::straight, 8);
  const double t = a * l, q = 1 + t * t;
  EXPECT_NEAR(spatial.elastic_energy(in_plane(drawn)).bending,
              E * inertia * a / 2 * (t / (4 * q * q) + 3 * t / (8 * q) + 3 * std::atan(t) / 8), 1e-13);
}

TEST(PrintedElement, HasTheMassOfItsLabelAndTheMomentOfGravity) {
  const RancfElement drawn = uneven_arc();
  const PrintedElement element(drawn, bar(), PrintedCurvature::spatial);
  const Eigen::Vector4d still(1, 0, 1, 0);
  EXPECT_NEAR(still.dot(element.mass() * still), density * area * drawn.l, 1e-12);
  EXPECT_NEAR(still.dot(element.load_factors()), density * area * drawn.l, 1e-12);
  EXPECT_LT((element.mass() * still - element.load_factors()).norm(), 1e-14);
}

// Eq. 23 sees no sign: a bow the other way costs nothing.
TEST(PrintedElement, TakesAMirroredArcForTheDrawnOneByTheSecondDerivativeAlone) {
  const RancfElement drawn = parabola(0.7, 0.9), mirrored = parabola(-0.7, 0.9);
  const auto bent = [&](PrintedCurvature curvature) {
    return PrintedElement(drawn, bar(), curvature).elastic_energy(in_plane(mirrored)).bending;
  };
  EXPECT_NEAR(bent(PrintedCurvature::second_derivative), 0, 1e-15);
  EXPECT_GT(bent(PrintedCurvature::spatial), 0.05);
}

TEST(PrintedElement, IsFreeOfStressAsDrawn) {
  const RancfElement drawn = uneven_arc();
  for (const auto curvature : {PrintedCurvature::second_derivative, PrintedCurvature::spatial}) {
    const PrintedElement element(drawn, bar(), curvature);
    EXPECT_EQ(element.elastic_energy(in_plane(drawn)).total(), 0);
    EXPECT_LT(element.elastic_force(in_plane(drawn)).norm(), 1e-12);
  }
}

TEST(PrintedElement, ItsForceIsTheGradientOfItsEnergy) {
  Generator generator(7);
  const RancfElement drawn = uneven_arc();
  for (const auto curvature : {PrintedCurvature::second_derivative, PrintedCurvature::spatial})
    for (int trial = 0; trial < 20; ++trial) {
      const PrintedElement element(drawn, bar(), curvature, PrintedStart::as_drawn, 1 + trial % 2);
      PrintedElement::Nodes e = in_plane(drawn);
      for (double& x : e.reshaped()) x += uniform(generator, -0.05, 0.05);
      const PrintedElement::Nodes force = element.elastic_force(e);
      constexpr double h = 1e-6;
      for (int i = 0; i < 8; ++i) {
        PrintedElement::Nodes up = e, down = e;
        up.reshaped()[i] += h;
        down.reshaped()[i] -= h;
        const double slope =
            (element.elastic_energy(up).total() - element.elastic_energy(down).total()) / (2 * h);
        EXPECT_NEAR(force.reshaped()[i], slope, 1e-6 * (1 + force.norm()));
      }
    }
}

}  // namespace
}  // namespace nurbeam
