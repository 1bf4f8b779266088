#include "pipelines/section/stress_places.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "pipelines/section/cgal_geometry.h"
#include "tests/support/profiles.h"

namespace nurbeam {
namespace {

using std::numbers::pi;

/// Tests of what only a build with CGAL computes.
class StressPlaces : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!has_cgal()) GTEST_SKIP() << "this build is without CGAL";
  }
  struct Found {
    SectionProfile profile;
    TorsionReport torsion;
    std::vector<StressPlace> places;

    double largest() const {
      return std::max_element(
                 places.begin(), places.end(),
                 [](const StressPlace& a, const StressPlace& b) {
                   return a.shear_per_torque < b.shear_per_torque;
                 })
          ->shear_per_torque;
    }
  };
  static Found found(const std::vector<Outline>& outlines) {
    const SectionProfile profile = section_profile(imported(outlines), "profile").value.value();
    const TorsionReport torsion = torsion_constant(profile.loops);
    return {profile, torsion, stress_places(profile, torsion)};
  }
};

TEST_F(StressPlaces, OfARingHaveTheShearOfTheirRadius) {
  const Found ring = found({ellipse(0.01, 0.01), ellipse(0.006, 0.006)});
  const double J = pi / 2 * (1e-8 - std::pow(0.006, 4));
  for (const StressPlace& at : ring.places)
    EXPECT_NEAR(at.shear_per_torque, at.place.norm() / J, 2e-3 * at.place.norm() / J);
}

// Timoshenko and Goodier, section 109: 0.208 of a square, 0.246 of one twice as high, at the long sides'
// middles.
TEST_F(StressPlaces, OfARectangleAreThoseOfSaintVenantsSeries) {
  for (const double b : {1.0, 0.5}) {
    const Found rectangular = found({rectangle(1, b)});
    double J_sum = 0, shear_sum = 0;
    for (int n = 1; n < 1000; n += 2) {
      J_sum += std::tanh(n * pi / (2 * b)) / std::pow(n, 5);
      shear_sum += 1 / (n * n * std::cosh(n * pi / (2 * b)));
    }
    const double J = b * b * b / 3 * (1 - 192 * b / std::pow(pi, 5) * J_sum);
    EXPECT_NEAR(rectangular.largest(), b * (1 - 8 / (pi * pi) * shear_sum) / J, 3e-3 * b / J);
    for (const StressPlace& at : rectangular.places) {
      const bool corner =
          std::abs(std::abs(at.place.x()) - 0.5) < 1e-9 && std::abs(std::abs(at.place.y()) - b / 2) < 1e-9;
      if (corner) EXPECT_EQ(at.shear_per_torque, 0);
    }
  }
}

TEST_F(StressPlaces, OfAnEquilateralTriangleAreSaintVenants) {
  const Found triangle = found({polygon({{0, 0}, {1, 0}, {0.5, std::sqrt(0.75)}})});
  EXPECT_NEAR(triangle.largest(), 20, 0.06);
}

TEST_F(StressPlaces, ReentrantCornersDoNotRuleTheShear) {
  // An angle of legs 1 and thickness 0.1: J = 1.9 t^3/3 and tau = T t/J away from the corner.
  const Found angle = found({polygon({{0, 0}, {1, 0}, {1, 0.1}, {0.1, 0.1}, {0.1, 1}, {0, 1}})});
  EXPECT_NEAR(angle.largest() * angle.torsion.value / 0.1, 1, 0.3);
}

TEST_F(StressPlaces, WithoutAMeshOfTorsionHaveNoShear) {
  const SectionProfile profile = section_profile(imported({rectangle(1, 2)}), "profile").value.value();
  for (const StressPlace& at : stress_places(profile, {})) EXPECT_TRUE(std::isnan(at.shear_per_torque));
}

TEST_F(StressPlaces, WarpingOfAnEllipseIsSaintVenants) {
  // psi = -(a^2 - b^2)/(a^2 + b^2) x y.
  const double a = 1, b = 0.4, k = (a * a - b * b) / (a * a + b * b);
  const Found drawn = found({ellipse(a, b)});
  EXPECT_NEAR(drawn.torsion.warping_constant, k * k * pi * std::pow(a * b, 3) / 24, 1e-5);
  EXPECT_LT(drawn.torsion.shear_centre.norm(), 1e-5);
}

// Thin-walled: e = 3 b^2/(6 b + h) outwards of the web's middle line.
TEST_F(StressPlaces, TheShearCentreOfAChannelLiesBehindItsWeb) {
  const double b = 0.5, h = 1, t = 0.01;
  const double x = t / 2, y = h / 2;
  const Found channel = found({polygon({{-x, -y - x},
                                        {b, -y - x},
                                        {b, -y + x},
                                        {x, -y + x},
                                        {x, y - x},
                                        {b, y - x},
                                        {b, y + x},
                                        {-x, y + x}})});
  const Eigen::Vector2d centre = channel.torsion.shear_centre + channel.profile.centroid.head<2>();
  EXPECT_NEAR(centre.x(), -3 * b * b / (6 * b + h), 0.02 * b);
  EXPECT_NEAR(centre.y(), 0, 1e-3 * h);
}

}  // namespace
}  // namespace nurbeam
