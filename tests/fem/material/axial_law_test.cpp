#include "fem/material/axial_law.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "fem/element/lane_arithmetic.h"
#include "fem/element/point_pack.h"
#include "nurbs/gauss_panels.h"

namespace nurbeam {
namespace {

double green(double stretch) { return (stretch * stretch - 1) / 2; }

std::vector<AxialLaw> laws() {
  return {GreenLaw(), HookeLaw(), ForceOverStretch({{-0.8, -40}, {0, 0}, {0.05, 30}, {0.5, 60}, {1.5, 400}})};
}

// The axial force d(psi)/d|r_s|, at a stretch of a beam whose free stretch is 1.
double force(const AxialLaw& law, double EA, double stretch) {
  return axial_point(law, EA, green(stretch), 0).force * stretch;
}

TEST(HookeLaw, IsProportionalToTheEngineeringStrain) {
  for (const double stretch : {0.2, 0.9, 1.0, 1.05, 1.5, 4.0}) {
    EXPECT_NEAR(force(HookeLaw(), 500, stretch), 500 * (stretch - 1), 1e-12);
    EXPECT_NEAR(axial_point(HookeLaw(), 500.0, green(stretch), 0).energy, 250 * (stretch - 1) * (stretch - 1),
                1e-12);
  }
}

TEST(HookeLaw, OfALongerFreeBeamIsThatOfItsOwnLength) {
  const double natural = 1.3, EA = 500, K = EA / std::pow(natural, 3), free = green(natural);
  for (const double stretch : {1.0, 1.3, 1.4, 2.0}) {
    const AxialPoint<double> point = axial_point(HookeLaw(), K, green(stretch) - free, free);
    EXPECT_NEAR(point.force * stretch, EA * (stretch / natural - 1), 1e-12);
    EXPECT_NEAR(point.energy, natural * EA / 2 * std::pow(stretch / natural - 1, 2), 1e-12);
  }
}

TEST(GreenLaw, GivesThePublishedForceOfABar) {
  EXPECT_NEAR(force(GreenLaw(), 1, 1.2), 1.2 * (1.2 * 1.2 - 1) / 2, 1e-15);
}

TEST(ForceOverStretch, GoesThroughItsRowsAndGrowsBetweenThem) {
  const std::vector<std::pair<double, double>> rows{{-0.8, -40}, {0, 0}, {0.05, 30}, {0.5, 60}, {1.5, 400}};
  const ForceOverStretch law(rows);
  for (const auto& [e, F] : rows) EXPECT_NEAR(force(law, 0, 1 + e), F, 1e-12);
  double before = law.rows().at(-0.9).force;
  for (double e = -0.89; e < 2; e += 0.01) {
    EXPECT_GT(law.rows().at(e).force, before) << e;
    before = law.rows().at(e).force;
  }
}

TEST(ForceOverStretch, HasTheEnergyOfItsForce) {
  const ForceRows law({{-0.8, -40}, {0.02, 3}, {0.05, 30}, {0.5, 60}, {1.5, 400}});
  EXPECT_EQ(law.at(0).energy, 0);
  const std::vector<double> ends{-0.95, -0.8, 0, 0.02, 0.05, 0.5, 1.5, 1.8};
  for (std::size_t i = 1; i < ends.size(); ++i)
    EXPECT_NEAR(law.at(ends[i]).energy - law.at(ends[i - 1]).energy,
                gauss([&](double e) { return law.at(e).force; }, ends[i - 1], ends[i]), 1e-11);
}

TEST(ForceRows, KnowTheStretchUnderAForce) {
  const ForceRows law({{-0.8, -40}, {0, 0}, {0.05, 30}, {0.5, 60}, {1.5, 400}});
  for (const double F : {-70.0, -40.0, -1.0, 0.0, 12.0, 30.0, 59.0, 300.0, 900.0})
    EXPECT_NEAR(law.at(law.stretch(F)).force, F, 1e-11 * (1 + std::abs(F))) << F;
}

TEST(ForceOverStretch, OfAStraightLineIsHookesLaw) {
  const ForceOverStretch law({{-0.5, -250}, {2, 1000}});
  for (const double stretch : {0.3, 0.8, 1.0, 1.7, 4.0}) {
    const AxialPoint<double> table = axial_point(law, 0.0, green(stretch), 0),
                             hooke = axial_point(HookeLaw(), 500.0, green(stretch), 0);
    EXPECT_NEAR(table.force, hooke.force, 1e-11);
    EXPECT_NEAR(table.stiffness, hooke.stiffness, 1e-10);
    EXPECT_NEAR(table.energy, hooke.energy, 1e-11);
  }
}

TEST(ForceOverStretch, RefusesRowsThatDoNotGrow) {
  EXPECT_THROW(ForceOverStretch({{0, 0}}), std::invalid_argument);
  EXPECT_THROW(ForceOverStretch({{0, 0}, {0, 1}}), std::invalid_argument);
  EXPECT_THROW(ForceOverStretch({{0, 1}, {0.1, 1}}), std::invalid_argument);
  EXPECT_THROW(ForceOverStretch({{-1, -1}, {0.1, 1}}), std::invalid_argument);
}

// Force and stiffness are derivatives, whose differences are wrong by the square of the step; also where a
// section is compressed to nothing.
TEST(AxialLaw, HasForceAndStiffnessByItsEnergy) {
  for (const AxialLaw& law : laws())
    for (const double free : {0.0, 0.15})
      for (const double strain : {-0.7, -0.3, 0.01, 0.3, 1.7}) {
        const auto at = [&](double e) { return axial_point(law, 70.0, e, free); };
        double errors[2][2];
        for (const int k : {0, 1}) {
          const double h = k == 0 ? 2e-3 : 1e-3;
          errors[0][k] =
              std::abs((at(strain + h).energy - at(strain - h).energy) / (2 * h) - at(strain).force);
          errors[1][k] =
              std::abs((at(strain + h).force - at(strain - h).force) / (2 * h) - at(strain).stiffness);
        }
        for (const auto& error : errors) {
          EXPECT_LT(error[1], 2e-2 * (1 + std::abs(at(strain).stiffness)));
          if (error[0] > 1e-6)
            EXPECT_NEAR(error[0] / error[1], 4, 0.7) << law.index() << " " << strain << " " << free;
        }
      }
}

TEST(AxialLaw, IsTheSameForNumbersSideBySide) {
  for (const AxialLaw& law : laws()) {
    Lanes few;
    Lanes8 many;
    const auto strain = [](int i) { return -0.6 + 0.25 * i; };
    for (int i = 0; i < Lanes::SizeAtCompileTime; ++i) few[i] = strain(i);
    for (int i = 0; i < FixedLanes::lanes; ++i) many.set(i, strain(i));
    const AxialPoint<Lanes> of_few = axial_point(law, 70.0, few, 0.1);
    const AxialPoint<Lanes8> of_many = axial_point(law, 70.0, many, 0.1);
    for (int i = 0; i < FixedLanes::lanes; ++i) {
      const AxialPoint<double> one = axial_point(law, 70.0, strain(i), 0.1);
      EXPECT_NEAR(of_many.energy.of(i), one.energy, 1e-13 * (1 + std::abs(one.energy)));
      EXPECT_NEAR(of_many.force.of(i), one.force, 1e-13 * (1 + std::abs(one.force)));
      EXPECT_NEAR(of_many.stiffness.of(i), one.stiffness, 1e-13 * (1 + std::abs(one.stiffness)));
      if (i < Lanes::SizeAtCompileTime) {
        EXPECT_NEAR(of_few.energy[i], one.energy, 1e-13 * (1 + std::abs(one.energy)));
        EXPECT_NEAR(of_few.force[i], one.force, 1e-13 * (1 + std::abs(one.force)));
        EXPECT_NEAR(of_few.stiffness[i], one.stiffness, 1e-13 * (1 + std::abs(one.stiffness)));
      }
    }
  }
}

}  // namespace
}  // namespace nurbeam
