// Derivatives of forces by the numbers of elements, computed backwards from multipliers.
#include "fem/element/batch_kernel.h"

namespace nurbeam {

// Derivatives by each number of the sum phi of the forces of FixedKernel::force times the multipliers m of
// their coordinates. Rates go backwards through each product, from phi to the numbers.
template <int D>
struct ElementBatch<D>::NumberRates {
  using Formulas = typename Kernel::Formulas;
  using Pair = std::array<Lanes8, 2 * D>;  // in z = (r_s, r_ss)

  const Kernel& kernel;
  const Nodes &e, &e_rate, &m;
  FixedLanes& rates;

  NURBEAM_WITHIN static Pair pair(const Components<D, Lanes8>& rs, const Components<D, Lanes8>& rss) {
    Pair z;
    for (int d = 0; d < D; ++d) {
      z[d] = rs[d];
      z[D + d] = rss[d];
    }
    return z;
  }
  NURBEAM_WITHIN static Pair combination(const Nodes& of, const FixedLanes::Point& p) {
    return pair(Formulas::combination(of, p.S1), Formulas::combination(of, p.S2));
  }
  NURBEAM_WITHIN static void add_back(const Pair& by, const Nodes& of, FixedLanes::Point& rate) {
    for (int k = 0; k < 4; ++k)
      for (int d = 0; d < D; ++d) {
        rate.S1[k] += by[d] * of[k][d];
        rate.S2[k] += by[D + d] * of[k][d];
      }
  }
  NURBEAM_WITHIN static void add(const Lanes8& factor, const Pair& term, Pair& sum) {
    for (int a = 0; a < 2 * D; ++a) sum[a] += factor * term[a];
  }

  // phi = w (M K_z.d + N r_s.d_s) with z = e S, z_rate = e_rate S and d = m S.
  NURBEAM_WITHIN void add_of_point(const FixedLanes::Point& p, FixedLanes::Point& rate) const {
    const PointLaw& law = kernel.formulas.law;
    const Pair d = combination(m, p);
    const Components<D, Lanes8> rs = Formulas::combination(e, p.S1), rss = Formulas::combination(e, p.S2);
    const CurvatureDerivatives<D, Lanes8> K(rs, rss, kernel.formulas.material);
    const Pair slope = pair(rs, Components<D, Lanes8>{});  // gradient of the axial strain
    Pair d_s = d;
    for (int a = D; a < 2 * D; ++a) d_s[a] = Lanes8{};
    const Lanes8 bent = dot(K.gradient, d), stretched = dot(slope, d);
    Lanes8 M = law.moment(Lanes8(K.value - p.kappa0));
    const AxialPoint<Lanes8> axial = law.axial(Lanes8(green_strain<D>(rs) - p.eps0));
    Lanes8 N = axial.force;
    Pair by_z = {}, by_d = {};
    if (law.is_damped()) {
      const Pair z_rate = combination(e_rate, p);
      Pair rate_s = z_rate;
      for (int a = D; a < 2 * D; ++a) rate_s[a] = Lanes8{};
      const Lanes8 bending = dot(K.gradient, z_rate);
      M += law.viscous_moment(bending);
      N += law.viscous_force(Lanes8(dot(slope, z_rate)));
      const Lanes8 by_bending = law.viscous_moment(Lanes8(p.weight * bent)),
                   by_stretching = law.viscous_force(Lanes8(p.weight * stretched));
      add(by_bending, K.product(z_rate), by_z);
      add(by_stretching, rate_s, by_z);
      Pair by_z_rate = {};
      add(by_bending, K.gradient, by_z_rate);
      add(by_stretching, slope, by_z_rate);
      add_back(by_z_rate, e_rate, rate);
    }
    const Lanes8 by_K = law.bending_stiffness() * (p.weight * bent),
                 by_strain = axial.stiffness * (p.weight * stretched);
    rate.weight += M * bent + N * stretched;
    rate.kappa0 -= by_K;
    rate.eps0 -= by_strain;
    M *= p.weight;
    N *= p.weight;
    add(by_K, K.gradient, by_z);
    add(M, K.product(d), by_z);
    add(by_strain, slope, by_z);
    add(N, d_s, by_z);
    add(M, K.gradient, by_d);
    add(N, slope, by_d);
    add_back(by_z, e, rate);
    add_back(by_d, m, rate);
  }

  // phi = sigma e_k.x with e_k = sum_g w_g eps_g and x = sum_g w_g r_s.d_s; w: weights in_strain of the
  // points. `on`: sigma; `by`, `by_rate`: derivatives of phi by e_k and by its rate, at fixed x.
  NURBEAM_WITHIN void add_of_coefficient(int k, const Lanes8& on, const Lanes8& by,
                                         const Lanes8& by_rate) const {
    for (int g = 0; g < FixedLanes::points; ++g) {
      const FixedLanes::Point& p = kernel.formulas.points[g];
      const Lanes8& w = p.in_strain[k - 1];
      const Components<D, Lanes8> none{}, rs = Formulas::combination(e, p.S1);
      const Pair slope = pair(rs, none), d_s = pair(Formulas::combination(m, p.S1), none);
      Pair by_z = {}, by_d = {};
      add(w * by, slope, by_z);
      add(w * on, d_s, by_z);
      add(w * on, slope, by_d);
      if (kernel.formulas.law.is_damped()) {
        Pair by_z_rate = {};
        add(w * by_rate, pair(Formulas::combination(e_rate, p.S1), none), by_z);
        add(w * by_rate, slope, by_z_rate);
        add_back(by_z_rate, e_rate, rates.at[g]);
      }
      rates.at[g].eps0 -= w * by;
      add_back(by_z, e, rates.at[g]);
      add_back(by_d, m, rates.at[g]);
    }
  }

  // Derivatives of sigma.x by (mean, a, b), at fixed x.
  NURBEAM_WITHIN std::array<Lanes8, 3> by_strain(const AxialMeans<Lanes8>& of,
                                                 const std::array<Lanes8, 3>& x) const {
    const Lanes8& l = kernel.formulas.sums.length;
    return {of.m00 * x[0] + l * (of.m0a * x[1] + of.m0b * x[2]),
            of.m0a * x[0] + l * (of.maa * x[1] + of.mab * x[2]),
            of.m0b * x[0] + l * (of.mab * x[1] + of.mbb * x[2])};
  }
  // A number on a and one on b as one on part i of both.
  NURBEAM_WITHIN Lanes8 on_part(int i, const Lanes8& on_a, const Lanes8& on_b) const {
    const AssumedEnds<Lanes8>& ends = kernel.formulas.sums.ends;
    return on_a * ends.a[i] + on_b * ends.b[i];
  }

  // The axial forces are stresses on y = (I, a, b): phi = sigma.x. Here sigma comes from the means of the law
  // and of damping, and x are the multipliers of dI/de, da/de and db/de. The end values a, b have parts in
  // eps_A, eps_B, the mean I/l, e_1 and e_2.
  NURBEAM_WITHIN void add_of_axial_forces() const {
    const Formulas& of = kernel.formulas;
    if (!of.assumed) return;
    const BeamProperties& beam = of.beam;
    const Lanes8 l = of.sums.length;
    const auto [I_e, I] = of.stretch(e);
    const typename Formulas::Moments moments = of.moments(e);
    const std::array<Lanes8, 3> x = of.axial_rates(e, m, I_e, moments);
    const AxialMeans<Lanes8> means = of.axial_means(e, I, moments);
    const std::array<Lanes8, 3> by = by_strain(means, x);
    const Lanes8 by_mean = by[0] + on_part(2, by[1], by[2]);
    Lanes8 on_I = means.by_0, on_a = l * means.by_a, on_b = l * means.by_b;
    Lanes8 by_l = means.by_a * x[1] + means.by_b * x[2] - I / (l * l) * by_mean;
    std::array<Lanes8, 3> by_rates = {};
    Lanes8 by_I_rate = {};
    if (beam.damping > 0) {
      const std::array<Lanes8, 3> y_rate = of.axial_rates(e, e_rate, I_e, moments);
      const AxialMeans<Lanes8> damping = of.axial_damping(y_rate);
      by_rates = by_strain(damping, x);
      const Lanes8 rate_by_mean = by_rates[0] + on_part(2, by_rates[1], by_rates[2]);
      on_I += damping.by_0;
      on_a += l * damping.by_a;
      on_b += l * damping.by_b;
      by_l += damping.by_a * x[1] + damping.by_b * x[2] - y_rate[0] / (l * l) * rate_by_mean;
      by_I_rate = rate_by_mean / l;
    }
    const Lanes8 on_mean = on_part(2, on_a, on_b), by_I = by_mean / l;
    on_I += on_mean / l;
    by_l -= on_mean * x[0] / (l * l);
    rates.sum.strain0[0] -= by_I;
    rates.sum.strain0[1] -= on_part(0, by[1], by[2]);
    rates.sum.strain0[2] -= on_part(1, by[1], by[2]);
    rates.sum.length += by_l - (0.5 + of.free_strain) * by_I;
    for (int k = 1; k <= of.own_slopes; ++k)
      add_of_coefficient(k, on_part(2 + k, on_a, on_b), on_part(2 + k, by[1], by[2]),
                         on_part(2 + k, by_rates[1], by_rates[2]));
    const Nodes from_start = Formulas::from_start(e);
    for (int k = 0; k < 4; ++k) {
      Components<D, Lanes8> by_G;
      for (int d = 0; d < D; ++d)
        by_G[d] = on_I * m[k][d] + 0.5 * by_I * from_start[k][d] + by_I_rate * e_rate[k][d];
      for (int i = 1; i < 4; ++i) rates.sum.stretch[i][k] += dot(from_start[i], by_G);
    }
  }

  // FoldResistance: phi = l F.x with the forces F(e_3, e_4) and x the multipliers of de_3/de and de_4/de.
  NURBEAM_WITHIN void add_of_fold() const {
    const Formulas& of = kernel.formulas;
    if (!of.folds(e)) return;
    const Lanes8 l = of.sums.length;
    const typename Formulas::Function third = of.coefficient(e, 3), fourth = of.coefficient(e, 4);
    const FoldStresses<Lanes8> fold = of.fold_stresses(third, fourth);
    const std::array<Lanes8, 2> x{Formulas::sum_of_products(third.by_e, m),
                                  Formulas::sum_of_products(fourth.by_e, m)};
    std::array<Lanes8, 2> on = fold.force;
    std::array<std::array<Lanes8, 2>, 2> by_e = fold.stiffness, by_rate = {};
    if (of.beam.damping > 0) {
      const std::array<Lanes8, 2> rate{Formulas::sum_of_products(third.by_e, e_rate),
                                       Formulas::sum_of_products(fourth.by_e, e_rate)};
      const std::array<Lanes8, 2> viscous = fold.viscous_force(rate);
      const auto viscous_by_e = fold.viscous_force_by_e(rate);
      by_rate = fold.viscosity();
      for (int i = 0; i < 2; ++i) {
        on[i] += viscous[i];
        for (int j = 0; j < 2; ++j) by_e[i][j] += viscous_by_e[i][j];
      }
    }
    rates.sum.length += dot(on, x);
    for (int i = 0; i < 2; ++i)
      add_of_coefficient(3 + i, l * on[i], l * (by_e[0][i] * x[0] + by_e[1][i] * x[1]),
                         l * (by_rate[0][i] * x[0] + by_rate[1][i] * x[1]));
  }

  NURBEAM_WITHIN void add(const State& state, const Vector& load) const {
    Nodes inertia = kernel.gathered(state.a.data());
    if (const double alpha = kernel.formulas.beam.mass_damping; alpha > 0)
      Formulas::add(alpha, e_rate, inertia);
    for (int k = 0; k < 4; ++k) {
      for (int i = 0; i < 4; ++i) rates.sum.mass[i][k] += dot(inertia[i], m[k]);
      for (int d = 0; d < D; ++d) rates.sum.load_factor[k] -= load[d] * m[k][d];
    }
    for (int g = 0; g < FixedLanes::points; ++g) add_of_point(kernel.formulas.points[g], rates.at[g]);
    add_of_axial_forces();
    add_of_fold();
  }

  NURBEAM_WITHIN static void add(const Kernel& kernel, const State& state, const Vector& load,
                                 const double* multipliers, FixedLanes& rates) {
    const Nodes e = kernel.positions(state), m = kernel.gathered(multipliers);
    Nodes e_rate = {};
    if (kernel.formulas.beam.is_damped()) e_rate = kernel.gathered(state.v.data());
    NumberRates{kernel, e, e_rate, m, rates}.add(state, load);
  }
};

template <>
NURBEAM_FOR_EVERY_PROCESSOR void ElementBatch<2>::add_number_rates(const State& state, const Vector& load,
                                                                   double free_strain,
                                                                   const double* multipliers,
                                                                   FixedLanes& rates) const {
  NumberRates::add({*this, free_strain, state}, state, load, multipliers, rates);
}

template <>
NURBEAM_FOR_EVERY_PROCESSOR void ElementBatch<3>::add_number_rates(const State& state, const Vector& load,
                                                                   double free_strain,
                                                                   const double* multipliers,
                                                                   FixedLanes& rates) const {
  NumberRates::add({*this, free_strain, state}, state, load, multipliers, rates);
}

}  // namespace nurbeam
