// A uniform strain without force, in the element: its force is the rate of its energy, its tangent that of
// the force.

#include <gtest/gtest.h>

#include <stdexcept>

#include "fem/element/beam_element.h"
#include "nurbs/primitives.h"
#include "tests/fem/axial_laws.h"

namespace nurbeam {
namespace {

template <int D>
ElementState<D> bent_state(double s_a, double s_b) {
  ElementState<D> x;
  x.q.setZero();
  x.v.setZero();
  x.a.setZero();
  const double l = s_b - s_a;
  x.q[0] = 0.1;
  x.q[D] = 0.9;
  x.q[D + 1] = 0.3;
  x.q[2 * D] = 0.1 + 0.95 * l;
  x.q[2 * D + 1] = 0.2 * l;
  x.q[3 * D] = 1.1;
  x.q[3 * D + 1] = -0.2;
  if constexpr (D == 3) {
    x.q[D + 2] = 0.2;
    x.q[3 * D + 2] = 0.1;
  }
  x.q[4 * D] = s_a;
  x.q[4 * D + 1] = s_b;
  x.free_strain = 0.07;
  return x;
}

template <int D>
void check_against_rates(Ends ends, const AxialLaw& law = GreenLaw()) {
  const ReferenceCurve curve({line_cubic({0, 0, 0}, {2, 0, 0})}, D);
  BeamProperties properties = BeamProperties(50, 0.3, 0).with_free_stretch(1.04);
  properties.law = law;
  const BeamElement<D> element(curve, properties, Chart{.segment = 0}, 0.4, 1.5, ends);
  const ElementState<D> x = bent_state<D>(0.4, 1.5);
  const Eigen::Matrix<double, D, 1> no_load = Eigen::Matrix<double, D, 1>::Zero();
  const auto potential = [&](const ElementState<D>& at) {
    const ElementEnergy energy = element.energy(at, no_load);
    return energy.axial + energy.bending;
  };
  const ElementVector<D> force = element.force(x, no_load);
  const ElementMatrix<D> tangent = element.tangent(x, no_load, {.stiffness = 1});
  const double h = 1e-5, size = force.norm();
  for (int i = 0; i < (ends == Ends::moving ? element_size<D> : 4 * D); ++i) {
    ElementState<D> up = x, down = x;
    up.q[i] += h;
    down.q[i] -= h;
    EXPECT_NEAR(force[i], (potential(up) - potential(down)) / (2 * h), 1e-7 * size) << i;
    const ElementVector<D> column = (element.force(up, no_load) - element.force(down, no_load)) / (2 * h);
    for (int k = 0; k < (ends == Ends::moving ? element_size<D> : 4 * D); ++k)
      EXPECT_NEAR(tangent(k, i), column[k], 1e-6 * tangent.norm()) << k << ", " << i;
  }
}

TEST(FreeStrain, ForceAndTangentAreRates) {
  check_against_rates<2>(Ends::fixed);
  check_against_rates<3>(Ends::fixed);
  check_against_rates<2>(Ends::moving);
  check_against_rates<3>(Ends::moving);
}

TEST(FreeStrain, ForceAndTangentAreRatesByOtherLaws) {
  for (const AxialLaw& law : testing::other_laws())
    for (const Ends ends : {Ends::fixed, Ends::moving}) {
      check_against_rates<2>(ends, law);
      check_against_rates<3>(ends, law);
    }
}

// A straight element along x from 0 to 1, stretched.
double end_force(const BeamProperties& properties, double stretch) {
  const ReferenceCurve drawn({line_cubic({0, 0, 0}, {1, 0, 0})}, 2);
  const BeamElement<2> element(drawn, properties, Chart{.segment = 0}, 0, 1, Ends::fixed);
  ElementState<2> x = bent_state<2>(0, 1);
  x.q << 0, 0, stretch, 0, stretch, 0, stretch, 0, 0, 1;
  x.free_strain = properties.free_strain.of_tension + properties.free_strain.at(0);
  return element.force(x, {0, 0})[4];
}

TEST(FreeStrain, GivesADrawnTensionByEveryLaw) {
  const double EA = 400, T = 60;
  for (const double sign : {1.0, -1.0}) {
    BeamProperties hooke(EA, 0.3, 2), green = hooke, table = hooke;
    hooke.law = HookeLaw();
    table.law = ForceOverStretch({{-0.9, -90}, {0, 0}, {0.3, 70}, {1, 400}});
    for (BeamProperties* each : {&hooke, &green, &table}) {
      each->set_drawn_tension(sign * T);
      EXPECT_NEAR(each->drawn_tension(), sign * T, 1e-11);
      EXPECT_NEAR(end_force(*each, 1), sign * T, 1e-11);
    }
    EXPECT_NEAR(hooke.free_axial_stiffness(), EA, 1e-11);
    for (const double stretch : {0.95, 1.2, 1.5}) {
      EXPECT_NEAR(end_force(hooke, stretch), EA * (stretch * (1 + sign * T / EA) - 1), 1e-10);
      EXPECT_NEAR(end_force(green, stretch), stretch * (sign * T + EA * (stretch * stretch - 1) / 2), 1e-10);
    }
  }
}

TEST(FreeStrain, OfAThrustThatLeavesNoLengthIsRefused) {
  BeamProperties hooke(400, 0.3, 2);
  hooke.law = HookeLaw();
  EXPECT_THROW(hooke.set_drawn_tension(-390), std::invalid_argument);
}

// An unstressed beam of 1.1 times the drawn length holds what the same beam, drawn 1.1 times as large, holds.
TEST(FreeStrain, ALongerBeamIsTheOneThatIsDrawnLonger) {
  constexpr double stretch = 1.1;
  for (const AxialLaw& law : {AxialLaw(GreenLaw()), AxialLaw(HookeLaw())}) {
    BeamProperties unstressed(50, 0.3, 2);
    unstressed.law = law;
    const ReferenceCurve drawn({line_cubic({0, 0, 0}, {1, 0, 0})}, 2),
        longer({line_cubic({0, 0, 0}, {stretch, 0, 0})}, 2);
    const BeamProperties scaled = unstressed.with_free_stretch(stretch);
    const BeamElement<2> a(drawn, scaled, Chart{.segment = 0}, 0, 1, Ends::fixed),
        b(longer, unstressed, Chart{.segment = 0}, 0, stretch, Ends::fixed);
    ElementState<2> x = bent_state<2>(0, 1), y = x;
    x.free_strain = scaled.free_strain.at(0);
    x.v << 0.3, -0.2, 0.1, 0.4, -0.5, 0.2, 0.3, 0.1, 0, 0;
    y = x;
    y.free_strain = 0;
    for (const int slope : {2, 6})
      for (int d = 0; d < 2; ++d) {
        y.q[slope + d] /= stretch;
        y.v[slope + d] /= stretch;
      }
    y.q[9] = stretch;
    const ElementEnergy of_a = a.energy(x, {0, 0}), of_b = b.energy(y, {0, 0});
    EXPECT_NEAR(of_a.axial, of_b.axial, 1e-12 * of_b.axial);
    EXPECT_NEAR(of_a.bending, of_b.bending, 1e-12 * of_b.bending);
    EXPECT_NEAR(of_a.kinetic, of_b.kinetic, 1e-12 * of_b.kinetic);
  }
}

}  // namespace
}  // namespace nurbeam
