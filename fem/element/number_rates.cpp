// How forces change with the numbers of elements, back from their multipliers.
#include "fem/element/batch_kernel.h"

namespace nurbeam {

// The sum phi of the forces of Kernel::add_forces times the multipliers m of their coordinates, by each
// number: rates go back from it, as each product is passed, to what goes into it.
template <int D>
struct ElementBatch<D>::NumberRates {
  const Kernel& kernel;
  const Nodes &e, &e_rate, &m;
  FixedLanes& rates;

  // What is in z = (r_s, r_ss).
  struct Pair {
    LaneVector<D> rs, rss;
  };
  NURBEAM_WITHIN static Pair combination(const Nodes& of, const FixedLanes::Point& p) {
    return {Kernel::combination(of, p.S1), Kernel::combination(of, p.S2)};
  }
  NURBEAM_WITHIN static void add_back(const Pair& by, const Nodes& of, FixedLanes::Point& rate) {
    for (int k = 0; k < 4; ++k) {
      rate.S1[k] += dot<D>(by.rs, of[k]);
      rate.S2[k] += dot<D>(by.rss, of[k]);
    }
  }

  // K_zz x, where `outer` is K_z K_z' + K_zz.
  NURBEAM_WITHIN static Pair bend_product(const PairMatrix<D>& outer, const Curvature<D>& K, const Pair& x,
                                          const Lanes8& along) {
    Pair product;
    for (int a = 0; a < D; ++a) {
      product.rs[a] = -(along * K.by_rs[a]);
      product.rss[a] = -(along * K.by_rss[a]);
      for (int b = 0; b < D; ++b) {
        product.rs[a] += outer[a][b] * x.rs[b] + outer[a][D + b] * x.rss[b];
        product.rss[a] += outer[D + a][b] * x.rs[b] + outer[D + a][D + b] * x.rss[b];
      }
    }
    return product;
  }

  // phi = w (M K_z.d + N r_s.d_s) with z = e S, z_rate = e_rate S and d = m S.
  NURBEAM_WITHIN void add_of_point(const FixedLanes::Point& p, FixedLanes::Point& rate) const {
    const BeamProperties& beam = kernel.beam;
    const double EA = beam.pointwise_axial_stiffness(), EI = beam.axis_bending_stiffness();
    const double c = beam.damping;
    const bool material = beam.curvature == CurvatureMeasure::material;
    const Pair z = combination(e, p), d = combination(m, p);
    const Curvature<D> K(z.rs, z.rss, material);
    const PairMatrix<D> outer = bending_hessian<D>(z.rs, z.rss, material, 1, K.value - 1, Lanes8{} + 1.);
    const Lanes8 bent = K.rate(d.rs, d.rss), stretched = dot<D>(z.rs, d.rs);
    Lanes8 M = EI * (K.value - p.kappa0), N = EA * ((dot<D>(z.rs, z.rs) - 1) / 2 - p.eps0);
    Pair by_z, by_d;
    if (c > 0) {
      const Pair z_rate = combination(e_rate, p);
      const Lanes8 bending = K.rate(z_rate.rs, z_rate.rss);
      M += c * EI * bending;
      N += c * EA * dot<D>(z.rs, z_rate.rs);
      const Lanes8 by_bending = c * EI * (p.weight * bent), by_stretching = c * EA * (p.weight * stretched);
      const Pair bend = bend_product(outer, K, z_rate, bending);
      Pair by_z_rate;
      for (int a = 0; a < D; ++a) {
        by_z.rs[a] = by_bending * bend.rs[a] + by_stretching * z_rate.rs[a];
        by_z.rss[a] = by_bending * bend.rss[a];
        by_z_rate.rs[a] = by_bending * K.by_rs[a] + by_stretching * z.rs[a];
        by_z_rate.rss[a] = by_bending * K.by_rss[a];
      }
      add_back(by_z_rate, e_rate, rate);
    } else {
      by_z.rs = by_z.rss = LaneVector<D>{};
    }
    rate.weight += M * bent + N * stretched;
    rate.kappa0 -= EI * (p.weight * bent);
    rate.eps0 -= EA * (p.weight * stretched);
    M *= p.weight;
    N *= p.weight;
    const Lanes8 by_K = EI * (p.weight * bent), by_strain = EA * (p.weight * stretched);
    const Pair bend = bend_product(outer, K, d, bent);
    for (int a = 0; a < D; ++a) {
      by_z.rs[a] += by_K * K.by_rs[a] + M * bend.rs[a] + by_strain * z.rs[a] + N * d.rs[a];
      by_z.rss[a] += by_K * K.by_rss[a] + M * bend.rss[a];
      by_d.rs[a] = M * K.by_rs[a] + N * z.rs[a];
      by_d.rss[a] = M * K.by_rss[a];
    }
    add_back(by_z, e, rate);
    add_back(by_d, m, rate);
  }

  // phi = EA (x_I, x_A, x_B).Q(l).(y_I, y_A, y_B): Q as in Kernel::axial_stress, x the multipliers of
  // dI/de, deps_A/de and deps_B/de, y strains and what damping makes of their rates.
  NURBEAM_WITHIN void add_of_axial_forces(double free_strain) const {
    const BeamProperties& beam = kernel.beam;
    if (beam.axial_strain != AxialStrain::ends_and_mean) return;
    const double EA = beam.axial_stiffness, c = beam.damping;
    const FixedLanes& numbers = kernel.numbers;
    const auto [I_e, I] = kernel.stretch(e, free_strain);
    const Lanes8 l = numbers.length;
    const Lanes8 x_I = Kernel::sum_of_products(I_e, m), x_A = dot<D>(e[1], m[1]), x_B = dot<D>(e[3], m[3]);
    Lanes8 y_I = I, y_A = (dot<D>(e[1], e[1]) - 1) / 2 - numbers.strain0[1] - free_strain,
           y_B = (dot<D>(e[3], e[3]) - 1) / 2 - numbers.strain0[2] - free_strain;
    if (c > 0) {
      y_I += c * Kernel::sum_of_products(I_e, e_rate);
      y_A += c * dot<D>(e[1], e_rate[1]);
      y_B += c * dot<D>(e[3], e_rate[3]);
    }
    const Lanes8 on_I = EA * (1.2 / l * y_I - 0.1 * (y_A + y_B)),
                 by_I = EA * (1.2 / l * x_I - 0.1 * (x_A + x_B));
    rates.strain0[0] -= by_I;
    rates.strain0[1] -= EA * (l * (2. / 15 * x_A - 1. / 30 * x_B) - 0.1 * x_I);
    rates.strain0[2] -= EA * (l * (2. / 15 * x_B - 1. / 30 * x_A) - 0.1 * x_I);
    rates.length += EA * (x_A * (2. / 15 * y_A - 1. / 30 * y_B) + x_B * (2. / 15 * y_B - 1. / 30 * y_A) -
                          1.2 / (l * l) * x_I * y_I) -
                    (0.5 + free_strain) * by_I;
    Nodes from_start = e;
    for (int d = 0; d < D; ++d) {
      from_start[0][d] = Lanes8{};
      from_start[2][d] -= e[0][d];
    }
    for (int k = 0; k < 4; ++k) {
      LaneVector<D> by;
      for (int d = 0; d < D; ++d) {
        by[d] = on_I * m[k][d] + 0.5 * by_I * from_start[k][d];
        if (c > 0) by[d] += c * by_I * e_rate[k][d];
      }
      for (int i = 1; i < 4; ++i) rates.stretch[i][k] += dot<D>(from_start[i], by);
    }
  }

  NURBEAM_WITHIN void add(const State& state, const Vector& load, double free_strain) const {
    Nodes inertia = kernel.gathered(state.a.data());
    if (const double alpha = kernel.beam.mass_damping; alpha > 0)
      Kernel::add(Lanes8{} + alpha, e_rate, inertia);
    for (int k = 0; k < 4; ++k) {
      for (int i = 0; i < 4; ++i) rates.mass[i][k] += dot<D>(inertia[i], m[k]);
      for (int d = 0; d < D; ++d) rates.load_factor[k] -= load[d] * m[k][d];
    }
    for (int g = 0; g < FixedLanes::points; ++g) add_of_point(kernel.numbers.at[g], rates.at[g]);
    add_of_axial_forces(free_strain);
  }

  NURBEAM_WITHIN static void add(const Kernel& kernel, const State& state, const Vector& load,
                                 double free_strain, const double* multipliers, FixedLanes& rates) {
    Nodes e = kernel.gathered(state.q.data()), e_rate = {};
    for (int d = 0; d < D; ++d) e[3][d] += kernel.batch.slope_offset_[d];
    if (kernel.beam.is_damped()) e_rate = kernel.gathered(state.v.data());
    const Nodes m = kernel.gathered(multipliers);
    NumberRates{kernel, e, e_rate, m, rates}.add(state, load, free_strain);
  }
};

template <>
NURBEAM_FOR_EVERY_PROCESSOR void ElementBatch<2>::add_number_rates(const State& state, const Vector& load,
                                                                   double free_strain,
                                                                   const double* multipliers,
                                                                   FixedLanes& rates) const {
  NumberRates::add({*this, *numbers_, *properties_}, state, load, free_strain, multipliers, rates);
}

template <>
NURBEAM_FOR_EVERY_PROCESSOR void ElementBatch<3>::add_number_rates(const State& state, const Vector& load,
                                                                   double free_strain,
                                                                   const double* multipliers,
                                                                   FixedLanes& rates) const {
  NumberRates::add({*this, *numbers_, *properties_}, state, load, free_strain, multipliers, rates);
}

}  // namespace nurbeam
