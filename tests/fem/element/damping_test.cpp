// Damping of mass and of stiffness in the element: its tangent is the rate of its force, and its work what is
// dissipated.

#include <gtest/gtest.h>

#include "fem/element/beam_element.h"
#include "nurbs/primitives.h"
#include "tests/fem/random_models.h"

namespace nurbeam {
namespace {

template <int D>
ElementState<D> moving_state(double s_a, double s_b, bool places_move) {
  ElementState<D> x;
  x.q.setZero();
  const double l = s_b - s_a;
  x.q[D] = 0.9;
  x.q[D + 1] = 0.3;
  x.q[2 * D] = 1.2 * l;
  x.q[2 * D + 1] = 0.2 * l;
  x.q[3 * D] = 1.3;
  x.q[3 * D + 1] = -0.2;
  if constexpr (D == 3) {
    x.q[D + 2] = 0.2;
    x.q[3 * D + 2] = 0.1;
  }
  x.q[4 * D] = s_a;
  x.q[4 * D + 1] = s_b;
  for (int i = 0; i < x.v.size(); ++i) {
    x.v[i] = 0.3 * std::sin(1.0 + 2.3 * i);
    x.a[i] = 0.5 * std::cos(0.7 + 1.9 * i);
  }
  if (!places_move) x.v.template tail<2>().setZero();
  x.free_strain = -0.05;
  return x;
}

struct DampedCase {
  double c, alpha, beta;
  AxialStrain strain;
};

BeamProperties damped(const DampedCase& with) {
  BeamProperties p(50, 0.3, 2, with.c + with.beta);
  p.mass_damping = with.alpha;
  p.tension_damping = with.beta;
  p.axial_strain = with.strain;
  return p;
}

// Of bending at this speed of a beam that is bent by K, as an element in the plane or in space has it.
template <int D>
double dissipation_of_bending(double K, double speed) {
  const double l = 0.5;
  const ReferenceCurve curve({line_cubic({0, 0, 0}, {l, 0, 0})}, D);
  const BeamProperties properties = damped({0.02, 0, 0, AxialStrain::ends_and_mean});
  const BeamElement<D> element(curve, properties, {.segment = 0}, 0, l, Ends::fixed);
  ElementState<D> x;
  x.q.setZero();
  x.v.setZero();
  x.a.setZero();
  x.q[D] = x.q[3 * D] = 1;
  x.q[2 * D] = l;
  x.q[D + 1] = -K * l / 2;
  x.q[3 * D + 1] = K * l / 2;
  x.v[D + 1] = -speed * l / 2;
  x.v[3 * D + 1] = speed * l / 2;
  return element.energy(x, Eigen::Matrix<double, D, 1>::Zero()).dissipation;
}

// It would be a hundredth less with a rounding of the curvature that is a tenth of it.
TEST(Damping, OfSmallBendingIsInSpaceWhatItIsInThePlane) {
  for (const double K : {1e-2, 1e-4, 1e-5}) {
    const double in_plane = dissipation_of_bending<2>(K, 0.1);
    EXPECT_GT(in_plane, 0);
    EXPECT_NEAR(dissipation_of_bending<3>(K, 0.1), in_plane, 0.011 * in_plane) << K;
  }
}

template <int D>
void check_damping(const ReferenceCurve& curve, const Chart& chart, Ends ends, const DampedCase& with) {
  const BeamProperties properties = damped(with), undamped = damped({0, 0, 0, with.strain});
  const double s_a = 0.2 * curve.breaks()[1], s_b = 0.75 * curve.breaks()[1];
  const BeamElement<D> element(curve, properties, chart, s_a, s_b, ends);
  const BeamElement<D> elastic(curve, undamped, chart, s_a, s_b, ends);
  ElementState<D> x = moving_state<D>(s_a, s_b, ends == Ends::moving);
  if (with.strain == AxialStrain::pointwise) x.free_strain = 0;
  const Eigen::Matrix<double, D, 1> load = Eigen::Matrix<double, D, 1>::Constant(0.3);
  const ElementVector<D> force = element.force(x, load), lost = force - elastic.force(x, load);
  const ElementEnergy energy = element.energy(x, load);
  EXPECT_GT(energy.dissipation, 0.01);
  EXPECT_NEAR(lost.dot(x.v), energy.dissipation, 1e-12 * force.norm());
  const ElementMatrix<D> K = element.tangent(x, load, {.stiffness = 1});
  const ElementMatrix<D> C = element.tangent(x, load, {.damping = 1});
  const int n = ends == Ends::moving ? element_size<D> : 4 * D;
  // Central differences with their rate: a hundredth of the error with a tenth of the step.
  double last = 0;
  for (const double h : {1e-3, 1e-4}) {
    double error = 0;
    for (int i = 0; i < n; ++i) {
      ElementState<D> up = x, down = x, faster = x, slower = x;
      up.q[i] += h;
      down.q[i] -= h;
      faster.v[i] += h;
      slower.v[i] -= h;
      const ElementVector<D> by_q = (element.force(up, load) - element.force(down, load)) / (2 * h);
      const ElementVector<D> by_v = (element.force(faster, load) - element.force(slower, load)) / (2 * h);
      error = std::max(error, (by_q - K.col(i)).head(n).template lpNorm<Eigen::Infinity>());
      EXPECT_LT((by_v - C.col(i)).head(n).template lpNorm<Eigen::Infinity>(), 1e-8 * C.norm()) << i;
    }
    if (last > 0) EXPECT_LT(error, 0.012 * last + 1e-8 * K.norm());
    last = error;
  }
}

TEST(Damping, OfMassAndStiffnessHasItsTangentAndItsWork) {
  for (const AxialStrain strain : {AxialStrain::ends_and_mean, AxialStrain::pointwise})
    for (const DampedCase& with :
         {DampedCase{0, 0.7, 0, strain}, DampedCase{0, 0, 0.02, strain}, DampedCase{0.01, 0.4, 0.03, strain}})
      for (const Ends ends : {Ends::fixed, Ends::moving}) {
        const std::vector<RationalCubic> line{line_cubic({0, 0, 0}, {2, 0, 0})};
        check_damping<2>(ReferenceCurve(line, 2), {.segment = 0}, ends, with);
        check_damping<3>(ReferenceCurve(line, 3), {.segment = 0}, ends, with);
      }
}

// Rational, and as plain cubics in arc length.
TEST(Damping, OfACurvedElementHasItsTangentAndItsWork) {
  std::mt19937 random(8);
  const ReferenceCurve plane(testing::uneven_axis(random, 2), 2), space(testing::uneven_axis(random, 3), 3);
  for (const AxialStrain strain : {AxialStrain::ends_and_mean, AxialStrain::pointwise})
    for (const int segment : {0, -1})
      for (const Ends ends : {Ends::fixed, Ends::moving}) {
        check_damping<2>(plane, {.segment = segment}, ends, {0.01, 0.4, 0.03, strain});
        check_damping<3>(space, {.segment = segment}, ends, {0.01, 0.4, 0.03, strain});
      }
}

// beta times the stiffness of a taut string: of a velocity across it, beta S times its gradient.
TEST(Damping, OfATautStringIsRayleighs) {
  const ReferenceCurve curve({line_cubic({0, 0, 0}, {2, 0, 0})}, 2);
  BeamProperties p(50, 0, 2, 0.02);
  p.tension_damping = 0.02;
  const BeamElement<2> element(curve, p, Chart{.segment = 0}, 0, 2, Ends::fixed);
  ElementState<2> x;
  x.q << 0, 0, 1, 0, 2, 0, 1, 0, 0, 2;
  x.a.setZero();
  x.v << 0, 0, 0, 0.3, 0, 0.6, 0, 0.3, 0, 0;  // turns at 0.3 rad/s
  const double S = 7;
  x.free_strain = -S / 50;
  EXPECT_NEAR(element.energy(x, {0, 0}).dissipation, 0.02 * S * 0.09 * 2, 1e-14);
  x.free_strain = S / 50;  // no stiffness where it is pressed
  EXPECT_NEAR(element.energy(x, {0, 0}).dissipation, 0, 1e-14);
}

}  // namespace
}  // namespace nurbeam
