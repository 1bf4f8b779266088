// Long because its tests share what they build.
#include "fem/element/beam_element.h"

#include <gtest/gtest.h>

#include <random>

#include "fem/comparison/virtual_work.h"
#include "tests/support/dual.h"

namespace nurbeam {
namespace {

using testing::lifted;
using testing::real;

RationalCubic random_cubic(std::mt19937& random, int dimension, double bend = 0.4) {
  std::uniform_real_distribution<double> unit(-1, 1);
  Eigen::Matrix4d points;
  for (int i = 0; i < 4; ++i) {
    const double w = std::exp(0.3 * unit(random));
    points.col(i) << w * (i + 0.3 * unit(random)), w * bend * unit(random),
        dimension == 3 ? w * bend * unit(random) : 0.0, w;
  }
  return RationalCubic(points);
}

// Everything below computes the Lagrangian from its definition, with dual numbers and Bernstein polynomials,
// and shares no formula with the element but the places of the Gauss points.
template <class T>
T bernstein(const std::array<T, 4>& c, const T& u) {
  const T v = T(1.0) - u;
  return c[0] * v * v * v + T(3.0) * c[1] * u * v * v + T(3.0) * c[2] * u * u * v + c[3] * u * u * u;
}

template <class T>
T weight_at(const RationalCubic& cubic, const T& u) {
  return bernstein<T>({T(cubic.weight(0)), T(cubic.weight(1)), T(cubic.weight(2)), T(cubic.weight(3))}, u);
}

template <int D, class T>
std::array<T, D> drawn_point(const RationalCubic& cubic, const T& u) {
  std::array<T, D> r;
  const T W = weight_at(cubic, u);
  for (int d = 0; d < D; ++d)
    r[d] = bernstein<T>({T(cubic.points()(d, 0)), T(cubic.points()(d, 1)), T(cubic.points()(d, 2)),
                         T(cubic.points()(d, 3))},
                        u) /
           W;
  return r;
}

template <int D, class T>
T norm(const std::array<T, D>& v) {
  T sum(0.0);
  for (const T& x : v) sum = sum + x * x;
  return sqrt(sum);
}

template <int D, class T>
T stretch(const RationalCubic& cubic, const T& u) {
  const auto r = drawn_point<D, testing::Dual<T>>(cubic, testing::Dual<T>{u, T(1.0)});
  std::array<T, D> ru;
  for (int d = 0; d < D; ++d) ru[d] = r[d].d;
  return norm<D, T>(ru);
}

// u(s): Newton from the real solution; the rest is nilpotent, so four Gauss points integrate J exactly.
template <int D, class T>
T parameter(const RationalCubic& cubic, const ArcLengthMap& map, const T& s) {
  constexpr double x[4] = {0.069431844202973712388, 0.33000947820757186760, 0.66999052179242813240,
                           0.93056815579702628761};
  constexpr double w[4] = {0.17392742256872692869, 0.32607257743127307131, 0.32607257743127307131,
                           0.17392742256872692869};
  const double u0 = map.parameter(real(s));
  T u(u0);
  for (int iteration = 0; iteration < 4; ++iteration) {
    const T delta = u - T(u0);
    T length(0.0);
    for (int i = 0; i < 4; ++i) length = length + T(w[i]) * stretch<D, T>(cubic, T(u0) + delta * T(x[i]));
    const T error = T(real(s)) + delta * length - s;
    u = u - error / stretch<D, T>(cubic, u);
  }
  return u;
}

template <int D>
struct Witness {
  RationalCubic cubic;
  ArcLengthMap map{cubic};
  Chart chart;
  BeamProperties properties;
  bool straight;
  Eigen::Matrix<double, D, 1> load;
  OwnSlopes own = {};
  static constexpr int n = element_size<D>;

  // Field r(s; q) from the Bezier points of Eq. 6 in homogeneous form.
  template <class T>
  std::array<T, D> field(const std::array<T, n>& q, const T& s) const {
    const bool arc = chart.segment < 0;
    const auto u_of = [&](const T& place) { return arc ? place : parameter<D, T>(cubic, map, place); };
    const T ua = u_of(q[4 * D]), ub = u_of(q[4 * D + 1]), l = ub - ua, xi = (u_of(s) - ua) / l;
    const T Ja = arc ? T(1.0) : stretch<D, T>(cubic, ua), Jb = arc ? T(1.0) : stretch<D, T>(cubic, ub);
    std::array<T, 4> w{T(1.0), T(1.0), T(1.0), T(1.0)};
    if (chart.constant_weights) {
      for (int i = 0; i < 4; ++i) w[i] = T((*chart.constant_weights)[i]);
    } else if (!arc) {
      const testing::Dual<T> Wa = weight_at(cubic, testing::Dual<T>{ua, T(1.0)}),
                             Wb = weight_at(cubic, testing::Dual<T>{ub, T(1.0)});
      w = {Wa.x, Wa.x + l * Wa.d / T(3.0), Wb.x - l * Wb.d / T(3.0), Wb.x};
    }
    const T W = bernstein<T>(w, xi);
    std::array<T, D> r;
    for (int d = 0; d < D; ++d) {
      const T rua = l * Ja * q[D + d], rub = l * Jb * q[3 * D + d];
      r[d] = bernstein<T>({w[0] * q[d], w[1] * q[d] + w[0] * rua / T(3.0),
                           w[2] * q[2 * D + d] - w[3] * rub / T(3.0), w[3] * q[2 * D + d]},
                          xi) /
             W;
    }
    return r;
  }

  // Field, its first and second s-derivative at material point s.
  template <class T>
  std::array<std::array<T, D>, 3> jets(const std::array<T, n>& q, const T& s) const {
    using S = testing::Dual<testing::Dual<T>>;
    std::array<S, n> lifted_q;
    for (int i = 0; i < n; ++i) lifted_q[i] = lifted(lifted(q[i]));
    const S place{testing::Dual<T>{s, T(1.0)}, testing::Dual<T>{T(1.0), T(0.0)}};
    const auto r = field<S>(lifted_q, place);
    std::array<std::array<T, D>, 3> out;
    for (int d = 0; d < D; ++d) {
      out[0][d] = r[d].x.x;
      out[1][d] = r[d].x.d;
      out[2][d] = r[d].d.d;
    }
    return out;
  }

  template <class T>
  T curvature(const std::array<T, D>& rs, const std::array<T, D>& rss) const {
    T A(0.0), F(0.0), G(0.0);
    for (int d = 0; d < D; ++d) {
      A = A + rs[d] * rs[d];
      F = F + rs[d] * rss[d];
      G = G + rss[d] * rss[d];
    }
    const bool material = properties.curvature == CurvatureMeasure::material;
    if constexpr (D == 2) {
      const T c = rs[0] * rss[1] - rs[1] * rss[0];
      return material ? c / A : c / (A * sqrt(A));
    } else {
      const T square = (A * G - F * F) / (material ? A * A : A * A * A);
      return sqrt(square + T(curvature_rounding * curvature_rounding));
    }
  }

  template <class T>
  T drawn_curvature(const T& s) const {
    if (straight) return T(0.0);
    using S = testing::Dual<testing::Dual<T>>;
    const S place{testing::Dual<T>{s, T(1.0)}, testing::Dual<T>{T(1.0), T(0.0)}};
    const auto r = drawn_point<D, S>(cubic, parameter<D, S>(cubic, map, place));
    std::array<T, D> rs, rss;
    for (int d = 0; d < D; ++d) {
      rs[d] = r[d].x.d;
      rss[d] = r[d].d.d;
    }
    if constexpr (D == 2) return rs[0] * rss[1] - rs[1] * rss[0];
    return norm<D, T>(rss);
  }

  template <class T, class Visit>
  void visit_points(const std::array<T, n>& q, Visit&& visit) const {
    const T length = q[4 * D + 1] - q[4 * D];
    for (int g = 0; g < GaussRule::size; ++g)
      visit(q[4 * D] + length * T(GaussRule::points[g]), length * T(GaussRule::weights[g]));
  }

  // Strain energy less the work of the dead load, per reference length.
  template <class T>
  T potential(const std::array<T, n>& q, const T& s) const {
    const auto r = jets<T>(q, s);
    T rs2(0.0), load_r(0.0);
    for (int d = 0; d < D; ++d) {
      rs2 = rs2 + r[1][d] * r[1][d];
      load_r = load_r + T(load[d]) * r[0][d];
    }
    const T eps = (rs2 - T(1.0)) / T(2.0), bend = curvature<T>(r[1], r[2]) - drawn_curvature<T>(s);
    T bending = T(properties.bending_stiffness / 2) * bend * bend;
    if (D == 3 && straight)
      bending = bending - T(properties.bending_stiffness * curvature_rounding * curvature_rounding / 2);
    return T(pointwise() ? properties.axial_stiffness / 2 : 0) * eps * eps + bending - load_r;
  }

  bool pointwise() const { return properties.axial_strain == AxialStrain::pointwise; }

  // int x^2 ds of the quadratic x = a + b xi + c xi^2 with these end values and this mean, over a length.
  template <class T>
  static T integral_of_square(const T& at_a, const T& at_b, const T& mean, const T& length) {
    const T c = T(3.0) * (at_a + at_b) - T(6.0) * mean, b = at_b - at_a - c;
    T sum(0.0);
    for (int g = 0; g < GaussRule::size; ++g) {
      const double xi = GaussRule::points[g];
      const T x = at_a + b * T(xi) + c * T(xi * xi);
      sum = sum + T(GaussRule::weights[g]) * x * x;
    }
    return length * sum;
  }

  template <class T>
  T strain(const std::array<T, n>& q, const T& s) const {
    const auto r = jets<T>(q, s);
    T rs2(0.0);
    for (int d = 0; d < D; ++d) rs2 = rs2 + r[1][d] * r[1][d];
    return (rs2 - T(1.0)) / T(2.0);
  }

  // int x^2 ds of the quadratic that a field is assumed as. At an end with a slope of its own the first
  // moment of the field takes the place of the value there.
  template <class T, class Field>
  T square_of_assumed(const std::array<T, n>& q, const Field& field) const {
    const T s_a = q[4 * D], length = q[4 * D + 1] - s_a;
    T mean(0.0), first(0.0), second(0.0);
    visit_points<T>(q, [&](const T& s, const T& weight) {
      const T x = T(2.0) * (s - s_a) / length - T(1.0), part = weight / length * field(s);
      mean = mean + part;
      first = first + T(3.0) * part * x;
      second = second + T(2.5) * part * (T(3.0) * x * x - T(1.0));
    });
    if (own.count() == 0) return integral_of_square<T>(field(s_a), field(q[4 * D + 1]), mean, length);
    if (!own.at_b) second = field(q[4 * D + 1]) - mean - first;
    if (!own.at_a) second = field(s_a) - mean + first;
    return length * (mean * mean + first * first / T(3.0) + second * second / T(5.0));
  }

  // Energy of the assumed axial strain.
  template <class T>
  T axial_energy(const std::array<T, n>& q) const {
    if (pointwise()) return T(0.0);
    const auto field = [&](const T& s) { return strain<T>(q, s); };
    const T length = q[4 * D + 1] - q[4 * D], excess = residue<T>(q) - T(0.04);
    T fold(0.0);
    if (real(excess) > 0) fold = T(0.5) * length * excess * excess;
    return T(properties.axial_stiffness / 2) * (square_of_assumed<T>(q, field) + fold);
  }

  // The coefficients of P_3 and P_4 in a field.
  template <class T, class Field>
  std::array<T, 2> residual_part(const std::array<T, n>& q, const Field& field) const {
    const T s_a = q[4 * D], length = q[4 * D + 1] - s_a;
    T third(0.0), fourth(0.0);
    visit_points<T>(q, [&](const T& s, const T& weight) {
      const T x = T(2.0) * (s - s_a) / length - T(1.0), part = weight / length * field(s);
      third = third + T(3.5) * part * (T(5.0) * x * x - T(3.0)) * x;
      fourth = fourth + T(1.125) * part * (T(35.0) * x * x * x * x - T(30.0) * x * x + T(3.0));
    });
    return {third, fourth};
  }
  template <class T>
  T residue(const std::array<T, n>& q) const {
    const auto [third, fourth] = residual_part<T>(q, [&](const T& s) { return strain<T>(q, s); });
    return sqrt(T(10. / 21) * third * third + T(14. / 45) * fourth * fourth);
  }

  template <class T>
  T lagrangian(const std::array<T, n>& q, const std::array<T, n>& v) const {
    T sum(0.0);
    visit_points<T>(q, [&](const T& s, const T& weight) {
      std::array<testing::Dual<T>, n> moving;
      for (int i = 0; i < n; ++i) moving[i] = {q[i], v[i]};
      const auto velocity = field<testing::Dual<T>>(moving, lifted(s));
      T speed2(0.0);
      for (int d = 0; d < D; ++d) speed2 = speed2 + velocity[d].d * velocity[d].d;
      sum = sum + weight * (T(properties.mass_per_length / 2) * speed2 - potential<T>(q, s));
    });
    return sum - axial_energy<T>(q);
  }

  // Rayleigh's dissipation function: half the power lost.
  template <class T>
  T dissipation(const std::array<T, n>& q, const std::array<T, n>& v) const {
    T sum(0.0);
    if (properties.damping == 0) return sum;
    std::array<testing::Dual<T>, n> moving;
    for (int i = 0; i < n; ++i) moving[i] = {q[i], v[i]};
    if (!pointwise()) {
      const auto rate = [&](const T& s) { return strain<testing::Dual<T>>(moving, lifted(s)).d; };
      sum = T(properties.damping / 2 * properties.axial_stiffness) * square_of_assumed<T>(q, rate);
      const T part = T(1.0) - T(0.04) / residue<T>(q);
      const auto [third, fourth] = residual_part<T>(q, rate);
      if (real(part) > 0)
        sum = sum + T(properties.damping / 4 * properties.axial_stiffness) * (q[4 * D + 1] - q[4 * D]) *
                        part * (T(10. / 21) * third * third + T(14. / 45) * fourth * fourth);
    }
    visit_points<T>(q, [&](const T& s, const T& weight) {
      const auto r = jets<testing::Dual<T>>(moving, lifted(s));
      testing::Dual<T> rs2(0.0);
      for (int d = 0; d < D; ++d) rs2 = rs2 + r[1][d] * r[1][d];
      const T eps_rate = rs2.d / T(2.0), K_rate = curvature<testing::Dual<T>>(r[1], r[2]).d;
      sum = sum + weight * T(properties.damping / 2) *
                      (T(pointwise() ? properties.axial_stiffness : 0) * eps_rate * eps_rate +
                       T(properties.bending_stiffness) * K_rate * K_rate);
    });
    return sum;
  }

  // Virtual work at fixed material points, and its derivative along a direction (dq, dv, da).
  std::pair<Eigen::VectorXd, Eigen::VectorXd> virtual_work(const ElementState<D>& x,
                                                           const ElementState<D>& direction) const {
    using A = testing::Dual<double>;  // along the direction
    using B = testing::Dual<A>;       // along coordinate i, or time
    std::array<A, n> q, v, work;
    std::array<testing::Dual<B>, n> motion;
    for (int k = 0; k < n; ++k) {
      q[k] = {x.q[k], direction.q[k]};
      v[k] = {x.v[k], direction.v[k]};
      motion[k] = {B{q[k], v[k]}, B{v[k], A{x.a[k], direction.a[k]}}};
      work[k] = A(0.0);
    }
    for (int i = 0; i < n; ++i) {
      std::array<B, n> varied, rates, still;
      for (int k = 0; k < n; ++k) {
        const A here(k == i ? 1.0 : 0.0);
        varied[k] = {q[k], here};
        rates[k] = {v[k], here};
        still[k] = {q[k], A(0.0)};
      }
      visit_points<A>(q, [&](const A& s, const A& weight) {
        const auto r = field<testing::Dual<B>>(motion, lifted(lifted(s)));
        const auto variation = field<B>(varied, lifted(s));
        A density = potential<B>(varied, lifted(s)).d;
        for (int d = 0; d < D; ++d)
          density = density + A(properties.mass_per_length) * r[d].d.d * variation[d].d;
        work[i] = work[i] + weight * density;
      });
      work[i] = work[i] + dissipation<B>(still, rates).d;
    }
    Eigen::VectorXd value(n), derivative(n);
    for (int i = 0; i < n; ++i) {
      value[i] = work[i].x;
      derivative[i] = work[i].d;
    }
    return {value, derivative};
  }

  // d/dt(dL/dv) - dL/dq + dR/dv, and its derivative along a direction (dq, dv, da).
  std::pair<Eigen::VectorXd, Eigen::VectorXd> force(const ElementState<D>& x,
                                                    const ElementState<D>& direction) const {
    using A = testing::Dual<double>;  // along the direction
    using B = testing::Dual<A>;       // along coordinate i
    using C = testing::Dual<B>;       // along time
    Eigen::VectorXd value(n), derivative(n);
    for (int i = 0; i < n; ++i) {
      std::array<B, n> q, v;
      std::array<C, n> qt, vt;
      for (int k = 0; k < n; ++k) {
        const A qk{x.q[k], direction.q[k]}, vk{x.v[k], direction.v[k]}, ak{x.a[k], direction.a[k]};
        const double here = k == i ? 1 : 0;
        q[k] = {qk, A(here)};
        v[k] = {vk, A(0.0)};
        qt[k] = {B{qk, A(0.0)}, B{vk, A(0.0)}};
        vt[k] = {B{vk, A(here)}, B{ak, A(0.0)}};
      }
      std::array<B, n> q0, v1;
      for (int k = 0; k < n; ++k) {
        q0[k] = {q[k].x, A(0.0)};
        v1[k] = {v[k].x, q[k].d};
      }
      const A f = lagrangian<C>(qt, vt).d.d - lagrangian<B>(q, v).d + dissipation<B>(q0, v1).d;
      value[i] = f.x;
      derivative[i] = f.d;
    }
    return {value, derivative};
  }
};

struct Variant {
  const char* name;
  int segment;
  bool constant_weights, straight;
  double damping;
  CurvatureMeasure curvature;
  AxialStrain axial_strain = AxialStrain::ends_and_mean;
  bool virtual_work = false;
  OwnSlopes own = {};
  bool folded = false;
};

std::string name_of(const ::testing::TestParamInfo<Variant>& info) { return info.param.name; }

class ElementForces : public ::testing::TestWithParam<Variant> {};

template <int D>
void check_against_witness(const Variant& variant, int seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(-1, 1);
  const RationalCubic cubic = random_cubic(random, D);
  Witness<D> witness{cubic, ArcLengthMap(cubic), {}, {}, variant.straight, {}};
  witness.chart.segment = variant.segment;
  if (variant.constant_weights) witness.chart.constant_weights = {1.0, 1.2, 0.9, 1.1};
  witness.properties = {300.0, 2.0, 0.7, variant.damping, variant.curvature};
  witness.properties.axial_strain = variant.axial_strain;
  witness.own = variant.own;
  for (int d = 0; d < D; ++d) witness.load[d] = unit(random);

  const ReferenceCurve drawn({cubic}, D), curve = variant.straight ? drawn.straightened() : drawn;
  const double s_a = 0.2 * curve.length(), s_b = 0.65 * curve.length();
  ElementState<D> x, direction;
  for (int k = 0; k < element_size<D>; ++k) {
    x.v[k] = unit(random);
    x.a[k] = unit(random);
    direction.q[k] = unit(random);
    direction.v[k] = unit(random);
    direction.a[k] = unit(random);
  }
  x.q << curve.position(s_a).head<D>(), curve.tangent(s_a).head<D>(), curve.position(s_b).head<D>(),
      curve.tangent(s_b).head<D>(), s_a, s_b;
  for (int k = 0; k < 4 * D; ++k) x.q[k] += 0.1 * unit(random);
  if (variant.folded)
    for (const int end : {0, 1}) x.q[ElementLayout<D>::slope(end) + 1] += end == 0 ? 1 : 0.6;

  const BeamElement<D> element(curve, witness.properties, witness.chart, s_a, s_b, Ends::moving,
                               {variant.own});
  if (variant.folded) EXPECT_GT(element.strain_residue(x.q), 0.08);
  const auto tangent = [&](const TangentWeights& w) {
    return variant.virtual_work ? virtual_work::tangent<D>(element, x, witness.load, w)
                                : element.tangent(x, witness.load, w);
  };
  const ElementVector<D> force_here = variant.virtual_work ? virtual_work::force<D>(element, x, witness.load)
                                                           : element.force(x, witness.load);
  const ElementVector<D> derivative =
      tangent({0, 0, 1}) * direction.q + tangent({0, 1, 0}) * direction.v + tangent({1, 0, 0}) * direction.a;

  const auto [force, force_derivative] =
      variant.virtual_work ? witness.virtual_work(x, direction) : witness.force(x, direction);
  EXPECT_LT((force_here - force).norm(), 1e-11 * force.norm());
  EXPECT_LT((derivative - force_derivative).norm(), 1e-11 * force_derivative.norm());
  // The mass matrix alone has a path of its own.
  ElementState<D> driven = direction;
  driven.q.setZero();
  driven.v.setZero();
  const ElementVector<D> by_acceleration =
      variant.virtual_work ? witness.virtual_work(x, driven).second : witness.force(x, driven).second;
  EXPECT_LT((tangent({1, 0, 0}) * direction.a - by_acceleration).norm(), 1e-12 * by_acceleration.norm());

  // The same element with its ends held: the precomputed path.
  ElementState<D> held = x;
  held.v.template tail<2>().setZero();
  held.a.template tail<2>().setZero();
  const BeamElement<D> fixed(curve, witness.properties, witness.chart, s_a, s_b, Ends::fixed, {variant.own});
  const TangentWeights all{0.3, 0.7, 1.1};
  const ElementVector<D> moving_force = element.force(held, witness.load);
  const ElementMatrix<D> moving_tangent = element.tangent(held, witness.load, all);
  constexpr int m = ElementLayout<D>::nodal;
  const double force_error = (moving_force - fixed.force(held, witness.load)).template head<m>().norm();
  const double tangent_error =
      (moving_tangent - fixed.tangent(held, witness.load, all)).template topLeftCorner<m, m>().norm();
  EXPECT_LT(force_error, 1e-12 * moving_force.norm());
  EXPECT_LT(tangent_error, 1e-12 * moving_tangent.norm());
}

TEST_P(ElementForces, AndTangentsAreTheEulerLagrangeExpressionsOfThePlanarLagrangian) {
  for (int seed = 1; seed <= 3; ++seed) check_against_witness<2>(GetParam(), seed);
}

TEST_P(ElementForces, AndTangentsAreTheEulerLagrangeExpressionsOfTheSpatialLagrangian) {
  for (int seed = 11; seed <= 12; ++seed) check_against_witness<3>(GetParam(), seed);
}

INSTANTIATE_TEST_SUITE_P(
    Variants, ElementForces,
    ::testing::Values(
        Variant{"MaterialWeights", 0, false, false, 0, CurvatureMeasure::material},
        Variant{"MaterialWeightsSpatialCurvature", 0, false, false, 0, CurvatureMeasure::spatial},
        Variant{"MaterialWeightsStraightDamped", 0, false, true, 0.3, CurvatureMeasure::material},
        Variant{"MaterialWeightsAsDrawnDamped", 0, false, false, 0.2, CurvatureMeasure::spatial},
        Variant{"ConstantWeights", 0, true, false, 0.1, CurvatureMeasure::material},
        Variant{"ArcLengthCubic", -1, false, false, 0.1, CurvatureMeasure::material},
        Variant{"ArcLengthConstantWeights", -1, true, false, 0, CurvatureMeasure::spatial},
        Variant{"PointwiseStrainDamped", 0, false, false, 0.2, CurvatureMeasure::material,
                AxialStrain::pointwise},
        Variant{"PointwiseStrainArcLength", -1, false, false, 0, CurvatureMeasure::spatial,
                AxialStrain::pointwise},
        Variant{"VirtualWork", 0, false, false, 0.2, CurvatureMeasure::material, AxialStrain::pointwise,
                true},
        Variant{"VirtualWorkConstantWeights", 0, true, true, 0, CurvatureMeasure::spatial,
                AxialStrain::pointwise, true},
        Variant{"OwnSlopeAtB",
                0,
                false,
                false,
                0,
                CurvatureMeasure::material,
                AxialStrain::ends_and_mean,
                false,
                {.at_b = true}},
        Variant{"OwnSlopeAtADamped",
                0,
                false,
                false,
                0.2,
                CurvatureMeasure::material,
                AxialStrain::ends_and_mean,
                false,
                {.at_a = true}},
        Variant{"OwnSlopesDamped",
                0,
                false,
                true,
                0.3,
                CurvatureMeasure::material,
                AxialStrain::ends_and_mean,
                false,
                {true, true}},
        Variant{"OwnSlopesArcLength",
                -1,
                false,
                false,
                0.1,
                CurvatureMeasure::material,
                AxialStrain::ends_and_mean,
                false,
                {true, true}}),
    name_of);

}  // namespace
}  // namespace nurbeam
