#pragma once
#include <array>
#include <type_traits>

#include "fem/element/fixed_lanes.h"
#include "fem/element/point_strain.h"
#include "fem/element/strain_function.h"
#include "fem/material/assumed_axial.h"
#include "fem/material/fold_resistance.h"
#include "fem/material/point_law.h"
#include "solver/system/second_order_system.h"

namespace nurbeam {

/// A number of points as one number of the element: the sum of those side by side, or the number itself.
template <int n>
double total(const SideBySide<n>& numbers) {
  return numbers.sum();
}
template <class T>
requires(!requires { T::SizeAtCompileTime; }) NURBEAM_WITHIN const T& total(const T& number) {
  return number;
}

/// Force, energies, length and tangent of an element with fixed ends, written once. For an element by itself
/// P are numbers at the Gauss points side by side and E is double. For eight elements side by side P and E
/// are their numbers. See docs/theory.md, form V with places at rest.
///
/// Nodes hold r_A, r_sA, r_B, r_sB by node and direction; `e`, `e_rate`: nodal values of q and v. `side`: 1
/// where the law of tension_damping is held on the side of tension, else 0; null where the strain decides.
template <int D, class P, class E>
struct FixedKernel {
  static constexpr int nodal = 4 * D;
  using Nodes = NodeNumbers<D, E>;
  using Function = StrainFunction<D, E>;
  using Tangents = std::array<std::array<E, nodal>, nodal>;  ///< by column and row
  using Load = std::array<double, D>;

  struct Energies {
    E kinetic, axial, bending, external, dissipation;
  };

  const BeamProperties& beam;
  const ElementSums<E>& sums;
  const PointNumbers<P>* points;
  int count;
  double free_strain;
  const E* side;
  int own_slopes;        ///< the largest OwnSlopes::count() of the elements
  double stabilisation;  ///< of the state: factor on FoldResistance
  PointLaw law{beam};
  bool material = beam.curvature == CurvatureMeasure::material;
  bool assumed = beam.axial_strain == AxialStrain::ends_and_mean;
  /// Whether strains of the axis give forces at the points: not where sections bend and the axial strain is
  /// assumed.
  bool at_points = !beam.sections || !assumed;

  NURBEAM_WITHIN Nodes force(const Nodes& e, const Nodes& e_rate, const Nodes& acceleration,
                             const Load& load) const {
    Nodes force = product(acceleration, sums.mass);
    if (beam.mass_damping > 0) add(beam.mass_damping, product(e_rate, sums.mass), force);
    for (int k = 0; k < 4; ++k)
      for (int d = 0; d < D; ++d) force[k][d] -= load[d] * sums.load_factor[k];
    const Residue residue = at_points ? add_point_forces(e, e_rate, force) : point_residue(e);
    add_axial_forces(e, e_rate, force);
    if (folds(residue)) add_fold_forces(e, e_rate, force);
    return force;
  }

  NURBEAM_WITHIN Energies energies(const Nodes& e, const Nodes& e_rate, const Load& load) const {
    Energies sum{zero<E>(), zero<E>(), zero<E>(), zero<E>(), zero<E>()};
    for (int k = 0; k < 4; ++k)
      for (int d = 0; d < D; ++d) sum.external -= load[d] * (e[k][d] * sums.load_factor[k]);
    sum.kinetic = sum_of_products(e_rate, product(e_rate, sums.mass)) / 2.;
    sum.dissipation = 2 * beam.mass_damping * sum.kinetic;
    const Residue residue = at_points ? add_point_energies(e, e_rate, sum) : point_residue(e);
    add_axial_energies(e, e_rate, sum);
    if (folds(residue)) add_fold_energies(e, e_rate, sum);
    return sum;
  }

  /// Deformed length [m].
  NURBEAM_WITHIN E length(const Nodes& e) const {
    E sum = zero<E>();
    for (int i = 0; i < count; ++i) {
      const Components<D, P> rs = combination(e, points[i].S1);
      sum += total(P(points[i].weight * square_root(dot(rs, rs))));
    }
    return sum;
  }

  NURBEAM_WITHIN void tangents(const Nodes& e, const Nodes& e_rate, const TangentWeights& w,
                               Tangents& K) const {
    const bool damped = beam.is_damped() && (w.damping != 0 || w.stiffness != 0);
    const bool full = damped && w.stiffness != 0;  // damping has no symmetric stiffness
    set_nodal(w.mass + (damped ? w.damping * beam.mass_damping : 0), full, K);
    if (w.stiffness != 0 || damped) {
      const Residue residue = at_points ? add_point_tangents(e, e_rate, w, full, K) : point_residue(e);
      if (assumed || damped) add_axial_tangents(e, e_rate, w, full, K);
      if (folds(residue)) add_fold_tangents(e, e_rate, w, full, K);
    }
    if (full) return;
    for (int j = 0; j < nodal; ++j)
      for (int i = 0; i < j; ++i) K[i][j] = K[j][i];
  }

  /// Whether FoldResistance acts in one of the elements.
  NURBEAM_WITHIN bool folds(const Nodes& e) const { return folds(point_residue(e)); }
  /// FoldResistance at e_3 and e_4.
  NURBEAM_WITHIN FoldStresses<E> fold_stresses(const Function& third, const Function& fourth) const {
    return {beam, stabilisation * sums.fold_resistance, {third.value, fourth.value}};
  }

  /// sum_k e_k S_k of nodal values.
  template <class N>
  NURBEAM_WITHIN static Components<D, N> combination(const Nodes& e, const std::array<N, 4>& S) {
    Components<D, N> sum;
    for (int d = 0; d < D; ++d) sum[d] = e[0][d] * S[0] + e[1][d] * S[1] + e[2][d] * S[2] + e[3][d] * S[3];
    return sum;
  }

  /// sum_l e_l M_lk for the columns of a symmetric M.
  NURBEAM_WITHIN static Nodes product(const Nodes& e, const std::array<std::array<E, 4>, 4>& M) {
    Nodes product;
    for (int k = 0; k < 4; ++k) product[k] = combination(e, M[k]);
    return product;
  }

  NURBEAM_WITHIN static E sum_of_products(const Nodes& a, const Nodes& b) {
    E sum = dot(a[0], b[0]);
    for (int k = 1; k < 4; ++k) sum += dot(a[k], b[k]);
    return sum;
  }

  template <class Factor>
  NURBEAM_WITHIN static void add(const Factor& factor, const Nodes& term, Nodes& sum) {
    for (int k = 0; k < 4; ++k)
      for (int d = 0; d < D; ++d) sum[k][d] += factor * term[k][d];
  }

  /// The integral I = (tr(e G e') - l)/2 - int eps_0 ds, less that of the free strain, and dI/de = e G.
  /// Positions count from the start of the element: G does not see the start, and far from the origin
  /// round-off would remain.
  struct Stretch {
    Nodes by_e;
    E integral;
  };
  NURBEAM_WITHIN static Nodes from_start(const Nodes& e) {
    Nodes from_start = e;
    for (int d = 0; d < D; ++d) {
      from_start[0][d] = zero<E>();
      from_start[2][d] -= e[0][d];
    }
    return from_start;
  }
  NURBEAM_WITHIN Stretch stretch(const Nodes& e) const {
    const Nodes from = from_start(e);
    Stretch stretch{product(from, sums.stretch), zero<E>()};
    for (int k = 1; k < 4; ++k) stretch.integral += dot(from[k], stretch.by_e[k]);
    stretch.integral = (stretch.integral - sums.length) / 2. - sums.strain0[0] - free_strain * sums.length;
    return stretch;
  }
  /// The strain at the nodal slope of an end, 1 or 3, less the free strain.
  NURBEAM_WITHIN E end_strain(const Nodes& e, int slope) const {
    return green_strain<D>(e[slope]) - sums.strain0[(slope + 1) / 2] - free_strain;
  }
  /// The Legendre coefficient e_k of the strain, k = 1..4; no free strain is in it.
  NURBEAM_WITHIN Function coefficient(const Nodes& e, int k) const {
    Function c;
    c.value = zero<E>();
    for (auto& row : c.by_ee) row.fill(zero<E>());
    for (int i = 0; i < count; ++i) {
      const PointNumbers<P>& p = points[i];
      const P& weight = p.in_strain[k - 1];
      c.value -= total(P(weight * p.eps0));
      for (int l = 0; l < 4; ++l)
        for (int m = 0; m <= l; ++m) c.by_ee[l][m] += total(P(weight * p.S1[l] * p.S1[m]));
    }
    for (int l = 0; l < 4; ++l)
      for (int m = 0; m < l; ++m) c.by_ee[m][l] = c.by_ee[l][m];
    const Nodes from = from_start(e);
    c.by_e = product(from, c.by_ee);
    c.value += sum_of_products(from, c.by_e) / 2.;
    return c;
  }
  /// e_1 and e_2, as far as own slopes need them.
  using Moments = std::array<Function, 2>;
  NURBEAM_WITHIN Moments moments(const Nodes& e) const {
    Moments moments;
    for (int k = 0; k < 2; ++k)
      if (k < own_slopes) moments[k] = coefficient(e, k + 1);
    return moments;
  }
  /// (I, a, b) from I, eps_A, eps_B, e_1 and e_2, or from their rates; a, b: the end values of the assumed
  /// strain.
  NURBEAM_WITHIN std::array<E, 3> axial_values(const E& I, const E& at_a, const E& at_b, const E& first,
                                               const E& second) const {
    if (own_slopes == 0) return {I, at_a, at_b};
    const std::array<E, 5> of{at_a, at_b, I / sums.length, first, second};
    return {I, dot(sums.ends.a, of), dot(sums.ends.b, of)};
  }
  NURBEAM_WITHIN AssumedStrainOf<E> assumed_strain(const Nodes& e, const E& I, const Moments& moments) const {
    const std::array<E, 3> x =
        axial_values(I, end_strain(e, 1), end_strain(e, 3), own_slopes > 0 ? moments[0].value : zero<E>(),
                     own_slopes > 1 ? moments[1].value : zero<E>());
    return {x[0], x[1], x[2], sums.length};
  }

  NURBEAM_WITHIN AxialMeans<E> axial_means(const Nodes& e, const E& I, const Moments& moments) const {
    return nurbeam::axial_means<GaussRule>(beam, assumed_strain(e, I, moments), free_strain,
                                           sums.buckling_strain);
  }
  /// Rates of (I, a, b).
  NURBEAM_WITHIN std::array<E, 3> axial_rates(const Nodes& e, const Nodes& e_rate, const Nodes& I_e,
                                              const Moments& moments) const {
    std::array<E, 2> moment_rates{zero<E>(), zero<E>()};
    for (int k = 0; k < own_slopes; ++k) moment_rates[k] = sum_of_products(moments[k].by_e, e_rate);
    return axial_values(sum_of_products(I_e, e_rate), dot(e[1], e_rate[1]), dot(e[3], e_rate[3]),
                        moment_rates[0], moment_rates[1]);
  }
  NURBEAM_WITHIN AxialMeans<E> axial_damping(const std::array<E, 3>& rates) const {
    return viscous_axial_means(beam, AssumedStrainOf<E>(rates[0], rates[1], rates[2], sums.length));
  }

 private:
  /// The sums over the points for e_3 and e_4, of |r_s|^2 in place of the strain.
  using Residue = std::array<P, 2>;
  NURBEAM_WITHIN void add_residue(const PointNumbers<P>& p, const Components<D, P>& rs,
                                  Residue& residue) const {
    if (!assumed) return;
    const P square = dot(rs, rs);
    residue[0] += p.in_strain[2] * square;
    residue[1] += p.in_strain[3] * square;
  }
  NURBEAM_WITHIN Residue point_residue(const Nodes& e) const {
    Residue residue{zero<P>(), zero<P>()};
    for (int i = 0; i < count && assumed; ++i) add_residue(points[i], combination(e, points[i].S1), residue);
    return residue;
  }
  NURBEAM_WITHIN bool folds(const Residue& residue) const {
    const E e_3 = total(residue[0]) / 2. - sums.strain0[3], e_4 = total(residue[1]) / 2. - sums.strain0[4];
    return assumed && stabilisation > 0 &&
           largest(sums.fold_resistance * squared_residue(e_3, e_4)) >
               FoldResistance::r_0 * FoldResistance::r_0;
  }

  NURBEAM_WITHIN void add_fold_forces(const Nodes& e, const Nodes& e_rate, Nodes& force) const {
    const Function third = coefficient(e, 3), fourth = coefficient(e, 4);
    const FoldStresses<E> fold = fold_stresses(third, fourth);
    std::array<E, 2> on = fold.force;
    if (law.is_damped()) {
      const std::array<E, 2> viscous =
          fold.viscous_force({sum_of_products(third.by_e, e_rate), sum_of_products(fourth.by_e, e_rate)});
      for (int i = 0; i < 2; ++i) on[i] += viscous[i];
    }
    add(sums.length * on[0], third.by_e, force);
    add(sums.length * on[1], fourth.by_e, force);
  }

  NURBEAM_WITHIN void add_fold_energies(const Nodes& e, const Nodes& e_rate, Energies& sum) const {
    const Function third = coefficient(e, 3), fourth = coefficient(e, 4);
    const FoldStresses<E> fold = fold_stresses(third, fourth);
    sum.axial += sums.length * fold.energy;
    if (!law.is_damped()) return;
    const std::array<E, 2> rate{sum_of_products(third.by_e, e_rate), sum_of_products(fourth.by_e, e_rate)};
    sum.dissipation += sums.length * dot(fold.viscous_force(rate), rate);
  }

  NURBEAM_WITHIN void add_fold_tangents(const Nodes& e, const Nodes& e_rate, const TangentWeights& w,
                                        bool full, Tangents& K) const {
    const std::array<Function, 2> x{coefficient(e, 3), coefficient(e, 4)};
    const FoldStresses<E> fold = fold_stresses(x[0], x[1]);
    std::array<E, 2> force = fold.force;
    typename FoldStresses<E>::Matrix by_e = fold.stiffness, by_rate = fold.viscosity();
    const bool damped = law.is_damped();
    if (damped) {
      const std::array<E, 2> rate{sum_of_products(x[0].by_e, e_rate), sum_of_products(x[1].by_e, e_rate)};
      const std::array<E, 2> viscous = fold.viscous_force(rate);
      const auto viscous_by_e = fold.viscous_force_by_e(rate);
      for (int i = 0; i < 2; ++i) {
        force[i] += viscous[i];
        for (int j = 0; j < 2; ++j) by_e[i][j] += viscous_by_e[i][j];
      }
    }
    StrainStresses<2, E> stresses;
    for (int i = 0; i < 2; ++i) {
      stresses.on[i] = w.stiffness * (sums.length * force[i]);
      for (int j = 0; j < 2; ++j) {
        stresses.by_x[i][j] = sums.length * (w.stiffness * by_e[i][j] + w.damping * by_rate[i][j]);
        stresses.by_rate[i][j] = w.stiffness * (sums.length * by_rate[i][j]);
      }
    }
    add_stress_tangents<D>(x, damped ? &e_rate : nullptr, stresses, full, K);
  }

  NURBEAM_WITHIN Residue add_point_forces(const Nodes& e, const Nodes& e_rate, Nodes& force) const {
    Residue residue{zero<P>(), zero<P>()};
    for (int i = 0; i < count; ++i) {
      const PointNumbers<P>& p = points[i];
      const Components<D, P> rs = combination(e, p.S1), rss = combination(e, p.S2);
      const Curvature<D, P> K(rs, rss, material);
      P moment = law.moment(P(K.value - p.kappa0)), stretching = zero<P>();
      if (law.stretches()) stretching = law.axial(P(green_strain<D>(rs) - p.eps0)).force;
      if (law.is_damped()) {
        const Components<D, P> rs_rate = combination(e_rate, p.S1);
        moment += law.viscous_moment(K.rate(rs_rate, combination(e_rate, p.S2)));
        if (law.stretches()) stretching += law.viscous_force(dot(rs, rs_rate));
      }
      moment *= p.weight;
      stretching *= p.weight;
      for (int d = 0; d < D; ++d) {
        const P on_rs = moment * K.by_rs[d] + stretching * rs[d], on_rss = moment * K.by_rss[d];
        for (int k = 0; k < 4; ++k) force[k][d] += total(P(on_rs * p.S1[k] + on_rss * p.S2[k]));
      }
      add_residue(p, rs, residue);
    }
    return residue;
  }

  /// Adds the forces of the assumed axial strain, of its damping and of the damping of tension.
  NURBEAM_WITHIN void add_axial_forces(const Nodes& e, const Nodes& e_rate, Nodes& force) const {
    if (!assumed && !(beam.tension_damping > 0)) return;
    const auto [I_e, I] = stretch(e);
    if (beam.tension_damping > 0) add(tension_damping(I).value, product(e_rate, sums.stretch), force);
    if (!assumed) return;
    const Moments moments = this->moments(e);
    const AxialMeans<E> means = axial_means(e, I, moments);
    E on_I = means.by_0, on_a = sums.length * means.by_a, on_b = sums.length * means.by_b;
    if (law.is_damped()) {
      const AxialMeans<E> damping = axial_damping(axial_rates(e, e_rate, I_e, moments));
      on_I += damping.by_0;
      on_a += sums.length * damping.by_a;
      on_b += sums.length * damping.by_b;
    }
    if (own_slopes > 0) {
      std::array<E, 5> on;
      for (int i = 0; i < 5; ++i) on[i] = on_a * sums.ends.a[i] + on_b * sums.ends.b[i];
      on_a = on[0];
      on_b = on[1];
      on_I += on[2] / sums.length;
      for (int k = 0; k < own_slopes; ++k) add(on[3 + k], moments[k].by_e, force);
    }
    add(on_I, I_e, force);
    for (int d = 0; d < D; ++d) {
      force[1][d] += on_a * e[1][d];
      force[3][d] += on_b * e[3][d];
    }
  }

  NURBEAM_WITHIN Residue add_point_energies(const Nodes& e, const Nodes& e_rate, Energies& sum) const {
    Residue residue{zero<P>(), zero<P>()};
    for (int i = 0; i < count; ++i) {
      const PointNumbers<P>& p = points[i];
      const Components<D, P> rs = combination(e, p.S1), rss = combination(e, p.S2);
      const Curvature<D, P> K(rs, rss, material);
      add_residue(p, rs, residue);
      const P bent = K.value - p.kappa0;
      P square = bent * bent;
      if constexpr (D == 3) square -= curvature_rounding * curvature_rounding * is_zero(p.kappa0);
      sum.bending += total(P(law.bending_energy(P(p.weight * square))));
      if (law.stretches())
        sum.axial += total(P(p.weight * law.axial(P(green_strain<D>(rs) - p.eps0)).energy));
      if (!law.is_damped()) continue;
      const Components<D, P> rs_rate = combination(e_rate, p.S1);
      const P bending = K.rate(rs_rate, combination(e_rate, p.S2)), stretching = dot(rs, rs_rate);
      P power = law.viscous_moment(bending) * bending;
      if (law.stretches()) power += law.viscous_force(stretching) * stretching;
      sum.dissipation += total(P(p.weight * power));
    }
    return residue;
  }

  NURBEAM_WITHIN void add_axial_energies(const Nodes& e, const Nodes& e_rate, Energies& sum) const {
    if (!assumed && !(beam.tension_damping > 0)) return;
    const auto [I_e, I] = stretch(e);
    if (beam.tension_damping > 0)
      sum.dissipation += tension_damping(I).value * sum_of_products(e_rate, product(e_rate, sums.stretch));
    if (!assumed) return;
    const Moments moments = this->moments(e);
    sum.axial += sums.length * axial_means(e, I, moments).energy;
    if (!law.is_damped()) return;
    const std::array<E, 3> rates = axial_rates(e, e_rate, I_e, moments);
    const AxialMeans<E> damping = axial_damping(rates);
    sum.dissipation +=
        damping.by_0 * rates[0] + sums.length * (damping.by_a * rates[1] + damping.by_b * rates[2]);
  }
  NURBEAM_WITHIN TensionDamping<E> tension_damping(const E& I) const {
    const E strain = I / sums.length;
    return {beam, strain, free_strain, side ? *side : E(1. - is_zero(positive(strain)))};
  }

  NURBEAM_WITHIN void set_nodal(double factor, bool full, Tangents& K) const {
    for (int k = 0; k < 4; ++k)
      for (int m = 0; m <= (full ? 3 : k); ++m)
        for (int b = 0; b < D; ++b)
          for (int a = 0; a < D; ++a)
            K[k * D + b][m * D + a] = a == b ? E(factor * sums.mass[k][m]) : zero<E>();
  }

  /// The tangent in z = (r_s, r_ss) at a point: w.stiffness d(stress)/dz + w.damping d(stress)/dz'.
  NURBEAM_WITHIN PairMatrix<D, P> point_tangent(const Components<D, P>& rs, const Components<D, P>& rss,
                                                const Nodes& e_rate, const PointNumbers<P>& p,
                                                const TangentWeights& w) const {
    const CurvatureDerivatives<D, P> K(rs, rss, material);
    const bool damped = law.is_damped();
    P unit = (w.stiffness * law.bending_stiffness() + (damped ? w.damping * law.viscous_moment(1.) : 0.)) *
             p.weight;
    P moment = w.stiffness * law.moment(P(K.value - p.kappa0));
    std::array<P, 2 * D> z_rate;
    if (damped) {
      const Components<D, P> rs_rate = combination(e_rate, p.S1), rss_rate = combination(e_rate, p.S2);
      for (int d = 0; d < D; ++d) {
        z_rate[d] = rs_rate[d];
        z_rate[D + d] = rss_rate[d];
      }
      moment += w.stiffness * law.viscous_moment(P(dot(K.gradient, z_rate)));
    }
    moment *= p.weight;
    PairMatrix<D, P> H;
    for (int a = 0; a < 2 * D; ++a)
      for (int b = 0; b < 2 * D; ++b)
        H[a][b] = unit * K.gradient[a] * K.gradient[b] + moment * K.hessian[a][b];
    if (damped) {
      const P viscosity = w.stiffness * law.viscous_moment(1.) * p.weight;
      const std::array<P, 2 * D> by_z = K.product(z_rate);
      for (int a = 0; a < 2 * D; ++a)
        for (int b = 0; b < 2 * D; ++b) H[a][b] += viscosity * K.gradient[a] * by_z[b];
    }
    if (law.stretches()) add_pointwise_axial(rs, z_rate, p, w, H);
    return H;
  }

  NURBEAM_WITHIN void add_pointwise_axial(const Components<D, P>& rs, const std::array<P, 2 * D>& z_rate,
                                          const PointNumbers<P>& p, const TangentWeights& w,
                                          PairMatrix<D, P>& H) const {
    const AxialPoint<P> point = law.axial(P(green_strain<D>(rs) - p.eps0));
    P force = w.stiffness * point.force, stiffness = w.stiffness * point.stiffness;
    if (law.is_damped()) {
      P rate = rs[0] * z_rate[0];
      for (int d = 1; d < D; ++d) rate += rs[d] * z_rate[d];
      force += w.stiffness * law.viscous_force(rate);
      stiffness = stiffness + w.damping * law.viscous_force(1.);
      for (int a = 0; a < D; ++a)
        for (int b = 0; b < D; ++b)
          H[a][b] += w.stiffness * law.viscous_force(1.) * (p.weight * rs[a] * z_rate[b]);
    }
    force *= p.weight;
    stiffness *= p.weight;
    for (int a = 0; a < D; ++a) {
      H[a][a] += force;
      for (int b = 0; b < D; ++b) H[a][b] += stiffness * rs[a] * rs[b];
    }
  }

  /// Adds the tangents of the points: only the blocks above the diagonal, unless `full`.
  NURBEAM_WITHIN Residue add_point_tangents(const Nodes& e, const Nodes& e_rate, const TangentWeights& w,
                                            bool full, Tangents& K) const {
    Residue residue{zero<P>(), zero<P>()};
    for (int i = 0; i < count; ++i) {
      const PointNumbers<P>& p = points[i];
      const Components<D, P> rs = combination(e, p.S1);
      const PairMatrix<D, P> H = point_tangent(rs, combination(e, p.S2), e_rate, p, w);
      add_residue(p, rs, residue);
      for (int k = 0; k < 4; ++k)
        for (int b = 0; b < D; ++b) {
          std::array<P, 2 * D> by;
          for (int a = 0; a < 2 * D; ++a) by[a] = p.S1[k] * H[a][b] + p.S2[k] * H[a][D + b];
          for (int l = 0; l <= (full ? 3 : k); ++l)
            for (int a = 0; a < D; ++a)
              K[k * D + b][l * D + a] += total(P(p.S1[l] * by[a] + p.S2[l] * by[D + a]));
        }
    }
    return residue;
  }

  /// Stresses on x = (I, a, b) and their weighted derivatives by x; by the rates only with damping.
  struct AxialTangent {
    E on_I, on_a, on_b;
    E II, Ia, Ib, aa, ab, bb;

    NURBEAM_WITHIN std::array<E, 3> product(const E& I, const E& a, const E& b) const {
      return {II * I + Ia * a + Ib * b, Ia * I + aa * a + ab * b, Ib * I + ab * a + bb * b};
    }
    NURBEAM_WITHIN std::array<std::array<E, 3>, 3> matrix() const {
      return {{{II, Ia, Ib}, {Ia, aa, ab}, {Ib, ab, bb}}};
    }
  };
  NURBEAM_WITHIN static AxialTangent of_means(const AxialMeans<E>& m, const E& l, double stress,
                                              double slope) {
    return {stress * m.by_0, stress * l * m.by_a, stress * l * m.by_b, slope * m.m00 / l, slope * m.m0a,
            slope * m.m0b,   slope * l * m.maa,   slope * l * m.mab,   slope * l * m.mbb};
  }

  /// Adds the tangents of the axial stresses. With x = (I, eps_A, eps_B) and its rate x' = x_q v, x_qq and
  /// d(x')/dq are G and ones. The end values of own slopes have more.
  NURBEAM_WITHIN void add_axial_tangents(const Nodes& e, const Nodes& e_rate, const TangentWeights& w,
                                         bool full, Tangents& K) const {
    const auto [I_e, I] = stretch(e);
    if (beam.tension_damping > 0) add_tension_tangents(e_rate, I_e, tension_damping(I), w, full, K);
    if (!assumed) return;
    const E& l = sums.length;
    const Moments moments = this->moments(e);
    AxialTangent by_x = of_means(axial_means(e, I, moments), l, w.stiffness, w.stiffness);
    if (!law.is_damped())
      return add_axial_stress_tangents(e, I_e, I, moments, by_x, nullptr, nullptr, full, K);
    const AxialMeans<E> damping = axial_damping(axial_rates(e, e_rate, I_e, moments));
    const AxialTangent rated = of_means(damping, l, w.stiffness, w.damping),
                       by_rate = of_means(damping, l, w.stiffness, w.stiffness);
    by_x.on_I += rated.on_I;
    by_x.on_a += rated.on_a;
    by_x.on_b += rated.on_b;
    by_x.II += rated.II;
    by_x.Ia += rated.Ia;
    by_x.Ib += rated.Ib;
    by_x.aa += rated.aa;
    by_x.ab += rated.ab;
    by_x.bb += rated.bb;
    add_axial_stress_tangents(e, I_e, I, moments, by_x, &e_rate, &by_rate, full, K);
  }
  NURBEAM_WITHIN void add_axial_stress_tangents(const Nodes& e, const Nodes& I_e, const E& I,
                                                const Moments& moments, const AxialTangent& by_x,
                                                const Nodes* e_rate, const AxialTangent* by_rate, bool full,
                                                Tangents& K) const {
    if (own_slopes == 0) return add_axial_products(e, I_e, by_x, e_rate, by_rate, full, K);
    StrainStresses<3, E> stresses{{by_x.on_I, by_x.on_a, by_x.on_b}, by_x.matrix(), {}};
    if (by_rate) stresses.by_rate = by_rate->matrix();
    add_stress_tangents<D>(axial_functions(e, I_e, I, moments), e_rate, stresses, full, K);
  }

  /// (I, a, b) of elements with own slopes.
  NURBEAM_WITHIN std::array<Function, 3> axial_functions(const Nodes& e, const Nodes& I_e, const E& I,
                                                         const Moments& moments) const {
    std::array<Function, 3> x;
    x[0] = {I, I_e, sums.stretch};
    for (const int end : {0, 1}) {
      const std::array<E, 5>& of = end == 0 ? sums.ends.a : sums.ends.b;
      Function& value = x[1 + end];
      const E of_I = of[2] / sums.length;
      for (int k = 0; k < 4; ++k) {
        for (int d = 0; d < D; ++d) value.by_e[k][d] = of_I * I_e[k][d];
        for (int m = 0; m < 4; ++m) value.by_ee[k][m] = of_I * sums.stretch[k][m];
      }
      for (int i = 0; i < own_slopes; ++i) {
        add(of[3 + i], moments[i].by_e, value.by_e);
        for (int k = 0; k < 4; ++k)
          for (int m = 0; m < 4; ++m) value.by_ee[k][m] += of[3 + i] * moments[i].by_ee[k][m];
      }
      for (const int slope : {1, 3}) {
        const E& factor = of[slope / 2];
        for (int d = 0; d < D; ++d) value.by_e[slope][d] += factor * e[slope][d];
        value.by_ee[slope][slope] += factor;
      }
    }
    return x;
  }

  /// Component b of nodal value k if k is `of`, the index of a slope; else 0.
  NURBEAM_WITHIN static E slope(const Nodes& nodes, int k, int of, int b) {
    return k == of ? nodes[of][b] : zero<E>();
  }

  NURBEAM_WITHIN void add_axial_products(const Nodes& e, const Nodes& I_e, const AxialTangent& by_x,
                                         const Nodes* e_rate, const AxialTangent* by_rate, bool full,
                                         Tangents& K) const {
    for (int k = 0; k < 4; ++k)
      for (int m = 0; m <= (full ? 3 : k); ++m)
        for (int d = 0; d < D; ++d) K[k * D + d][m * D + d] += by_x.on_I * sums.stretch[k][m];
    for (int d = 0; d < D; ++d) {
      K[D + d][D + d] += by_x.on_a;
      K[3 * D + d][3 * D + d] += by_x.on_b;
    }
    Nodes I_rate;
    if (e_rate) I_rate = product(*e_rate, sums.stretch);
    for (int k = 0; k < 4; ++k)
      for (int b = 0; b < D; ++b) {
        std::array<E, 3> stress = by_x.product(I_e[k][b], slope(e, k, 1, b), slope(e, k, 3, b));
        if (e_rate) {
          const std::array<E, 3> more =
              by_rate->product(I_rate[k][b], slope(*e_rate, k, 1, b), slope(*e_rate, k, 3, b));
          for (int i = 0; i < 3; ++i) stress[i] += more[i];
        }
        for (int m = 0; m <= (full ? 3 : k); ++m)
          for (int a = 0; a < D; ++a) {
            E& entry = K[k * D + b][m * D + a];
            entry += I_e[m][a] * stress[0];
            if (m == 1) entry += e[1][a] * stress[1];
            if (m == 3) entry += e[3][a] * stress[2];
          }
      }
  }

  NURBEAM_WITHIN void add_tension_tangents(const Nodes& e_rate, const Nodes& I_e,
                                           const TensionDamping<E>& eta, const TangentWeights& w, bool full,
                                           Tangents& K) const {
    for (int k = 0; k < 4; ++k)
      for (int m = 0; m <= (full ? 3 : k); ++m)
        for (int d = 0; d < D; ++d) K[k * D + d][m * D + d] += w.damping * eta.value * sums.stretch[k][m];
    if (!full) return;
    const Nodes force = product(e_rate, sums.stretch);
    const E by_strain = w.stiffness * eta.by_strain / sums.length;
    for (int k = 0; k < 4; ++k)
      for (int b = 0; b < D; ++b)
        for (int m = 0; m < 4; ++m)
          for (int a = 0; a < D; ++a) K[k * D + b][m * D + a] += by_strain * I_e[k][b] * force[m][a];
  }
};

}  // namespace nurbeam
