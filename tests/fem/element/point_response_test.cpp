#include "fem/element/point_response.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <random>

namespace nurbeam {
namespace {

template <int D>
using Vector = Eigen::Matrix<double, D, 1>;
template <int D>
using Pair = Eigen::Matrix<double, 2 * D, 1>;

// Central differences must approach the derivative with the square of their step, or be round-off;
// `size` of what changes along with f.
template <class F>
void expect_rate(const F& f, double derivative, double scale, double size = 1) {
  const auto error = [&](double h) { return std::abs((f(h) - f(-h)) / (2 * h) - derivative); };
  const double coarse = error(4e-3 * size), fine = error(2e-3 * size);
  EXPECT_LT(fine, 1e-4 * scale);
  if (coarse > 1e-7 * scale) EXPECT_NEAR(coarse / fine, 4, 0.6) << coarse << " " << fine;
}

// Gradient and Hessian of a measure along a random direction, by differences of its value and gradient.
template <int D, class Measure>
void check_derivatives(const Measure& measure, const Pair<D>& z, std::mt19937& random) {
  std::uniform_real_distribution<double> unit(-1, 1);
  Pair<D> direction, other;
  for (int i = 0; i < 2 * D; ++i) {
    direction[i] = unit(random);
    other[i] = unit(random);
  }
  const auto at = [&](double h) { return measure(Pair<D>(z + h * direction)); };
  const StrainMeasure<D> here = at(0);
  const double scale = 1 + std::abs(here.value) + here.gradient.norm() + here.hessian.norm();
  const double size = std::min(1.0, z.template tail<D>().norm());
  expect_rate([&](double h) { return at(h).value; }, here.gradient.dot(direction), scale, size);
  expect_rate([&](double h) { return at(h).gradient.dot(other); }, other.dot(here.hessian * direction), scale,
              size);
  EXPECT_LT((here.hessian - here.hessian.transpose()).norm(), 1e-12 * scale);
}

// Strongly stretched, hardly bent and sharply bent.
template <int D>
std::vector<Pair<D>> samples(std::mt19937& random) {
  std::uniform_real_distribution<double> unit(-1, 1);
  std::vector<Pair<D>> all;
  for (const double stretch : {0.5, 1.0, 3.0})
    for (const double bend : {1e-3, 0.3, 20.0}) {
      Pair<D> z;
      for (int i = 0; i < 2 * D; ++i) z[i] = unit(random);
      z.template head<D>() *= stretch / z.template head<D>().norm();
      z.template tail<D>() *= bend;
      all.push_back(z);
    }
  return all;
}

template <int D>
void check_measures() {
  std::mt19937 random(D);
  for (const Pair<D>& z : samples<D>(random)) {
    check_derivatives<D>([](const Pair<D>& x) { return axial_strain<D>(Vector<D>(x.template head<D>())); }, z,
                         random);
    for (const CurvatureMeasure kind : {CurvatureMeasure::material, CurvatureMeasure::spatial})
      check_derivatives<D>(
          [kind](const Pair<D>& x) {
            return curvature(Vector<D>(x.template head<D>()), Vector<D>(x.template tail<D>()), kind);
          },
          z, random);
  }
}

TEST(Strain, AndCurvatureHaveTheirDerivativesInThePlane) { check_measures<2>(); }
TEST(Strain, AndCurvatureHaveTheirDerivativesInSpace) { check_measures<3>(); }

TEST(Curvature, OfACircleIsOneOverItsRadius) {
  const double R = 0.4, stretch = 1.3;
  const Eigen::Vector2d t(0.6, 0.8), n(-0.8, 0.6);
  const Eigen::Vector2d rs = stretch * t,
                        rss = stretch * stretch / R * n + 0.7 * t;  // the part along t has no say
  EXPECT_NEAR(curvature(rs, rss, CurvatureMeasure::spatial).value, 1 / R, 1e-15);
  EXPECT_NEAR(curvature(rs, rss, CurvatureMeasure::material).value, stretch / R, 1e-14);
  EXPECT_NEAR(curvature(rs, Eigen::Vector2d(-rss), CurvatureMeasure::spatial).value, -1 / R, 1e-15);
}

TEST(Curvature, InSpaceIsRoundedWhereItVanishes) {
  const Eigen::Vector3d rs(1, 0, 0), straight(0.3, 0, 0);
  const StrainMeasure<3> K = curvature(rs, straight, CurvatureMeasure::material);
  EXPECT_NEAR(K.value, curvature_rounding, 1e-18);
  EXPECT_EQ(K.gradient.norm(), 0);
  EXPECT_TRUE(K.hessian.allFinite());
}

template <int D>
void check_objectivity() {
  std::mt19937 random(7 + D);
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(1.1, D == 2 ? Eigen::Vector3d(0, 0, 1) : Eigen::Vector3d(1, 2, 2) / 3)
          .toRotationMatrix();
  const Eigen::Matrix<double, D, D> Q = turn.topLeftCorner<D, D>();
  for (const Pair<D>& z : samples<D>(random)) {
    const Vector<D> rs = z.template head<D>(), rss = z.template tail<D>();
    const double K = curvature(rs, rss, CurvatureMeasure::material).value;
    EXPECT_NEAR(curvature(Vector<D>(Q * rs), Vector<D>(Q * rss), CurvatureMeasure::material).value, K,
                1e-12 * (1 + std::abs(K)));
    EXPECT_NEAR(axial_strain<D>(Vector<D>(Q * rs)).value, axial_strain<D>(rs).value,
                1e-14 * rs.squaredNorm());
  }
}
TEST(Strain, DoesNotFeelARotation) {
  check_objectivity<2>();
  check_objectivity<3>();
}

// Energy, its gradient, Hessian and moment belong together, and the moment's derivatives too.
template <int D>
void check_elastic() {
  std::mt19937 random(20 + D);
  std::uniform_real_distribution<double> unit(-1, 1);
  const BeamProperties beam{300, 2, 0.7, 0.3};
  for (const Pair<D>& z : samples<D>(random)) {
    Pair<D> direction, other;
    for (int i = 0; i < 2 * D; ++i) {
      direction[i] = unit(random);
      other[i] = unit(random);
    }
    const double kappa0 = 0.8;
    const auto at = [&](double h, double k) {
      const Pair<D> x = z + h * direction;
      return elastic_response<D>(beam, x.template head<D>(), x.template tail<D>(), k, 0.01);
    };
    const ElasticResponse<D> here = at(0, kappa0);
    const double scale = 1 + here.energy.total() + here.gradient.norm() + here.hessian.norm();
    const double size = std::min(1.0, z.template tail<D>().norm());
    expect_rate([&](double h) { return at(h, kappa0).energy.total(); }, here.gradient.dot(direction), scale,
                size);
    expect_rate([&](double h) { return at(h, kappa0).gradient.dot(other); },
                other.dot(here.hessian * direction), scale, size);
    expect_rate([&](double h) { return at(0, kappa0 + h).energy.total(); }, -here.moment, scale);
    expect_rate([&](double h) { return at(h, kappa0).moment; }, here.moment_gradient.dot(direction), scale,
                size);
    expect_rate([&](double h) { return at(0, kappa0 + h).moment; }, -here.moment_slope, scale);
  }
}
TEST(Elastic, ForcesAreTheDerivativesOfTheEnergy) {
  check_elastic<2>();
  check_elastic<3>();
}

// Stress y(z, z') and its derivatives; the power is y . z' and never negative.
template <int D>
void check_damping() {
  std::mt19937 random(30 + D);
  std::uniform_real_distribution<double> unit(-1, 1);
  const BeamProperties beam{300, 2, 0.7, 0.3};
  for (const Pair<D>& z : samples<D>(random)) {
    Pair<D> rate, direction, other;
    for (int i = 0; i < 2 * D; ++i) {
      rate[i] = unit(random);
      direction[i] = unit(random);
      other[i] = unit(random);
    }
    const auto at = [&](double h, double k) {
      const Pair<D> x = z + h * direction;
      return damping_response<D>(beam, x.template head<D>(), x.template tail<D>(), rate + k * direction);
    };
    const DampingResponse<D> here = at(0, 0);
    const double scale = 1 + here.stress.norm() + here.by_z.norm() + here.by_rate.norm();
    const double size = std::min(1.0, z.template tail<D>().norm());
    expect_rate([&](double h) { return at(h, 0).stress.dot(other); }, other.dot(here.by_z * direction), scale,
                size);
    expect_rate([&](double h) { return at(0, h).stress.dot(other); }, other.dot(here.by_rate * direction),
                scale, size);
    EXPECT_NEAR(here.power, here.stress.dot(rate), 1e-12 * scale);
    EXPECT_GE(here.power, 0);
  }
}
TEST(Elastic, ASectionThatIsCompressedToNothingCarriesNoForce) {
  BeamProperties beam;
  beam.axial_stiffness = 1e6;
  // d/dl of EA/2 eps^2 with eps = (l^2 - 1)/2.
  const double l = 0.3, eps = (l * l - 1) / 2;
  EXPECT_NEAR(section_forces(beam, eps, 0, 0).axial_force, 1e6 * eps * l, 1e-6);
  EXPECT_EQ(section_forces(beam, -0.5, 0, 0).axial_force, 0);
  EXPECT_EQ(section_forces(beam, -0.7, 0, 0).axial_force, 0);
}

TEST(Damping, StressHasItsDerivativesAndTakesEnergyAway) {
  check_damping<2>();
  check_damping<3>();
}

TEST(Section, OfADiskAndAPipeHasTheirMoments) {
  const double pi = std::numbers::pi;
  const Section disk = Section::round(0.02), pipe = Section::round(0.02, 0.015);
  EXPECT_NEAR(disk.area, pi * 4e-4, 1e-18);
  EXPECT_NEAR(disk.second_moment, pi / 4 * std::pow(0.02, 4), 1e-22);
  EXPECT_NEAR(pipe.area, pi * (4e-4 - 2.25e-4), 1e-18);
  EXPECT_NEAR(pipe.second_moment, pi / 4 * (std::pow(0.02, 4) - std::pow(0.015, 4)), 1e-21);
  EXPECT_NEAR(*pipe.torsion_constant, 2 * pipe.second_moment, 1e-22);
  EXPECT_THROW(Section::round(0.01, 0.01), std::invalid_argument);
  EXPECT_THROW(Section::round(0.01, -1e-3), std::invalid_argument);
}

}  // namespace
}  // namespace nurbeam
