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

  // The axial forces are stresses on y = (I, eps_A, eps_B): phi = sigma.x. Here sigma comes from the means of
  // the law and of damping, and x are the multipliers of dI/de, deps_A/de and deps_B/de.
  NURBEAM_WITHIN void add_of_axial_forces() const {
    const Formulas& of = kernel.formulas;
    if (!of.assumed) return;
    const BeamProperties& beam = of.beam;
    const Lanes8 l = of.sums.length;
    const auto [I_e, I] = of.stretch(e);
    const Lanes8 x_I = Formulas::sum_of_products(I_e, m), x_A = dot(e[1], m[1]), x_B = dot(e[3], m[3]);
    const AxialMeans<Lanes8> means = axial_means<GaussRule>(beam, of.assumed_strain(e, I), of.free_strain);
    // Derivatives of sigma.x by I (and the mean I/l), eps_A and eps_B, at fixed x.
    const Lanes8 by_mean = means.m00 * x_I + l * (means.m0a * x_A + means.m0b * x_B);
    Lanes8 on_I = means.by_0, by_l = means.by_a * x_A + means.by_b * x_B - I / (l * l) * by_mean;
    Lanes8 by_I_rate = {};
    if (beam.damping > 0) {
      const Lanes8 I_rate = Formulas::sum_of_products(I_e, e_rate);
      const AxialMeans<Lanes8> damping = viscous_axial_means(
          beam, AssumedStrainOf<Lanes8>(I_rate, dot(e[1], e_rate[1]), dot(e[3], e_rate[3]), l));
      const Lanes8 rate_by_mean = damping.m00 * x_I + l * (damping.m0a * x_A + damping.m0b * x_B);
      on_I += damping.by_0;
      by_l += damping.by_a * x_A + damping.by_b * x_B - I_rate / (l * l) * rate_by_mean;
      by_I_rate = rate_by_mean / l;
    }
    const Lanes8 by_I = by_mean / l;
    rates.sum.strain0[0] -= by_I;
    rates.sum.strain0[1] -= means.m0a * x_I + l * (means.maa * x_A + means.mab * x_B);
    rates.sum.strain0[2] -= means.m0b * x_I + l * (means.mab * x_A + means.mbb * x_B);
    rates.sum.length += by_l - (0.5 + of.free_strain) * by_I;
    const Nodes from_start = Formulas::from_start(e);
    for (int k = 0; k < 4; ++k) {
      Components<D, Lanes8> by;
      for (int d = 0; d < D; ++d)
        by[d] = on_I * m[k][d] + 0.5 * by_I * from_start[k][d] + by_I_rate * e_rate[k][d];
      for (int i = 1; i < 4; ++i) rates.sum.stretch[i][k] += dot(from_start[i], by);
    }
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
  NumberRates::add({*this, free_strain, state.sides}, state, load, multipliers, rates);
}

template <>
NURBEAM_FOR_EVERY_PROCESSOR void ElementBatch<3>::add_number_rates(const State& state, const Vector& load,
                                                                   double free_strain,
                                                                   const double* multipliers,
                                                                   FixedLanes& rates) const {
  NumberRates::add({*this, free_strain, state.sides}, state, load, multipliers, rates);
}

}  // namespace nurbeam
