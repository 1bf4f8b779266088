#pragma once
#include "fem/element/element_batch.h"
#include "fem/element/lane_curvature.h"

namespace nurbeam {

// What batches do, to be compiled for each processor. The formulas are those of fixed_forces.cpp.
template <int D>
struct ElementBatch<D>::Kernel {
  const ElementBatch& batch;
  const FixedLanes& numbers;
  const BeamProperties& beam;

  // sum_k e_k S_k.
  NURBEAM_WITHIN static LaneVector<D> combination(const Nodes& e, const std::array<Lanes8, 4>& S) {
    LaneVector<D> sum;
    for (int d = 0; d < D; ++d) sum[d] = e[0][d] * S[0] + e[1][d] * S[1] + e[2][d] * S[2] + e[3][d] * S[3];
    return sum;
  }

  // sum_l e_l M_lk for the columns of a symmetric M.
  NURBEAM_WITHIN static Nodes product(const Nodes& e, const std::array<std::array<Lanes8, 4>, 4>& M) {
    Nodes product;
    for (int k = 0; k < 4; ++k) product[k] = combination(e, M[k]);
    return product;
  }

  NURBEAM_WITHIN static Lanes8 sum_of_products(const Nodes& a, const Nodes& b) {
    Lanes8 sum = dot<D>(a[0], b[0]);
    for (int k = 1; k < 4; ++k) sum += dot<D>(a[k], b[k]);
    return sum;
  }

  NURBEAM_WITHIN static void add(const Lanes8& factor, const Nodes& term, Nodes& sum) {
    for (int k = 0; k < 4; ++k)
      for (int d = 0; d < D; ++d) sum[k][d] += factor * term[k][d];
  }

  NURBEAM_WITHIN void add_point_forces(const Nodes& e, const Nodes& e_rate, Nodes& force) const {
    const double EA = beam.pointwise_axial_stiffness(), EI = beam.axis_bending_stiffness();
    const double c = beam.damping;
    const bool material = beam.curvature == CurvatureMeasure::material;
    for (const FixedLanes::Point& p : numbers.at) {
      const LaneVector<D> rs = combination(e, p.S1), rss = combination(e, p.S2);
      const Curvature<D> K(rs, rss, material);
      Lanes8 moment = EI * (K.value - p.kappa0), stretching = {};
      if (EA > 0) stretching = EA * ((dot<D>(rs, rs) - 1) / 2 - p.eps0);
      if (c > 0) {
        const LaneVector<D> rs_rate = combination(e_rate, p.S1);
        moment += c * EI * K.rate(rs_rate, combination(e_rate, p.S2));
        if (EA > 0) stretching += c * EA * dot<D>(rs, rs_rate);
      }
      moment *= p.weight;
      stretching *= p.weight;
      for (int d = 0; d < D; ++d) {
        const Lanes8 on_rs = moment * K.by_rs[d] + stretching * rs[d], on_rss = moment * K.by_rss[d];
        for (int k = 0; k < 4; ++k) force[k][d] += on_rs * p.S1[k] + on_rss * p.S2[k];
      }
    }
  }

  struct Stretch {
    Nodes by_e;       // dI/de
    Lanes8 integral;  // I, without the strain that carries no force
  };
  NURBEAM_WITHIN Stretch stretch(const Nodes& e, double free_strain) const {
    Nodes from_start = e;
    for (int d = 0; d < D; ++d) {
      from_start[0][d] = Lanes8{};
      from_start[2][d] -= e[0][d];
    }
    Stretch stretch{product(from_start, numbers.stretch), {}};
    for (int k = 1; k < 4; ++k) stretch.integral += dot<D>(from_start[k], stretch.by_e[k]);
    const Lanes8 l = numbers.length;
    stretch.integral = (stretch.integral - l) / 2 - numbers.strain0[0] - free_strain * l;
    return stretch;
  }

  // AssumedStrain.
  struct Assumed {
    Lanes8 c0, c1, c2;
  };
  NURBEAM_WITHIN Assumed assumed_strain(const Nodes& e, const Lanes8& I, double free_strain) const {
    const Lanes8 at_a = (dot<D>(e[1], e[1]) - 1) / 2 - numbers.strain0[1] - free_strain;
    const Lanes8 at_b = (dot<D>(e[3], e[3]) - 1) / 2 - numbers.strain0[2] - free_strain;
    const Lanes8 c0 = I / numbers.length;
    return {c0, (at_b - at_a) / 2, (at_a + at_b) / 2 - c0};
  }

  // The gradient of AssumedAxialEnergy in I, eps_A and eps_B.
  struct AxialStress {
    Lanes8 on_I, on_a, on_b;
  };
  NURBEAM_WITHIN AxialStress axial_stress(const Nodes& e, const Lanes8& I, double EA,
                                          double free_strain) const {
    const Lanes8 l = numbers.length;
    const auto [c0, c1, c2] = assumed_strain(e, I, free_strain);
    return {EA * (c0 - c2 / 5), EA * l * (c2 / 10 - c1 / 6), EA * l * (c2 / 10 + c1 / 6)};
  }

  // AssumedAxialDamping, and the rates that it is for.
  struct AxialDamping {
    Lanes8 on_I, on_a, on_b, I_rate, a_rate, b_rate;
  };
  NURBEAM_WITHIN AxialDamping axial_damping(const Nodes& e, const Nodes& e_rate, const Nodes& I_e,
                                            double viscosity) const {
    const Lanes8 l = numbers.length, I = sum_of_products(I_e, e_rate);
    const Lanes8 a = dot<D>(e[1], e_rate[1]), b = dot<D>(e[3], e_rate[3]);
    return {viscosity * (1.2 / l * I - 0.1 * (a + b)),
            viscosity * (l * (2. / 15 * a - b / 30) - 0.1 * I),
            viscosity * (l * (2. / 15 * b - a / 30) - 0.1 * I),
            I,
            a,
            b};
  }

  // I where it is tension, or held to be; else 0.
  NURBEAM_WITHIN Lanes8 tension(const Lanes8& I, const Eigen::VectorXd& sides) const {
    if (sides.size() == 0) return positive(I);
    return gathered(sides.data(), batch.sides_) * I;
  }

  // The assumed axial strain, its damping and that of the tension (TautViscosity).
  NURBEAM_WITHIN void add_axial_forces(const Nodes& e, const Nodes& e_rate, const Eigen::VectorXd& sides,
                                       double free_strain, Nodes& force) const {
    const bool assumed = beam.axial_strain == AxialStrain::ends_and_mean;
    if (!assumed && !(beam.tension_damping > 0)) return;
    const auto [I_e, I] = stretch(e, free_strain);
    const Lanes8 l = numbers.length;
    if (beam.tension_damping > 0) {
      const double factor = beam.tension_damping * beam.axial_stiffness;
      const Lanes8 eta = factor / l * tension(I, sides);
      add(eta, product(e_rate, numbers.stretch), force);
    }
    if (!assumed) return;
    const double EA = beam.axial_stiffness, viscosity = beam.damping * EA;
    auto [on_I, on_a, on_b] = axial_stress(e, I, EA, free_strain);
    if (viscosity > 0) {
      const AxialDamping damping = axial_damping(e, e_rate, I_e, viscosity);
      on_I += damping.on_I;
      on_a += damping.on_a;
      on_b += damping.on_b;
    }
    add(on_I, I_e, force);
    for (int d = 0; d < D; ++d) {
      force[1][d] += on_a * e[1][d];
      force[3][d] += on_b * e[3][d];
    }
  }

  NURBEAM_WITHIN static Lanes8 gathered(const double* values, const std::array<int, lanes>& at) {
    return Lanes8{{{values[at[0]], values[at[1]], values[at[2]], values[at[3]]},
                   {values[at[4]], values[at[5]], values[at[6]], values[at[7]]}}};
  }
  NURBEAM_WITHIN Nodes gathered(const double* values) const {
    Nodes nodes;
    for (int k = 0; k < nodal; ++k) {
      const std::array<int, lanes>& at = batch.dofs_[k];
      if (batch.same_dofs_) {
        nodes[k / D][k % D] = Lanes8{} + values[at[0]];
        continue;
      }
      nodes[k / D][k % D] = gathered(values, at);
    }
    return nodes;
  }

  NURBEAM_WITHIN void add_forces(const State& state, const Vector& load, double free_strain, double* forces,
                                 std::ptrdiff_t stride) const {
    Nodes e = gathered(state.q.data()), e_rate;  // which nobody asks for without damping
    for (int d = 0; d < D; ++d) e[3][d] += batch.slope_offset_[d];
    if (beam.is_damped()) e_rate = gathered(state.v.data());
    Nodes force = product(gathered(state.a.data()), numbers.mass);
    if (beam.mass_damping > 0) {
      const Nodes momentum = product(e_rate, numbers.mass);
      for (int k = 0; k < 4; ++k)
        for (int d = 0; d < D; ++d) force[k][d] += beam.mass_damping * momentum[k][d];
    }
    for (int k = 0; k < 4; ++k)
      for (int d = 0; d < D; ++d) force[k][d] -= load[d] * numbers.load_factor[k];
    add_point_forces(e, e_rate, force);
    add_axial_forces(e, e_rate, state.sides, free_strain, force);
    scatter(force, forces, stride);
  }

  NURBEAM_WITHIN void scatter(const Nodes& force, double* forces, std::ptrdiff_t stride) const {
    using Half = double __attribute__((vector_size(4 * sizeof(double)), aligned(sizeof(double)), may_alias));
    if (batch.forces_stand_beside_) {
      for (int k = 0; k < nodal; ++k) {
        auto* sum = reinterpret_cast<Half*>(forces + batch.forces_at_[0] + batch.dofs_[k][0] * stride);
        for (int i = 0; i < 2; ++i) sum[i] += force[k / D][k % D].half[i];
      }
      return;
    }
    for (int i = 0; i < batch.count_; ++i)
      for (int k = 0; k < nodal; ++k)
        forces[batch.forces_at_[i] + batch.dofs_[k][i] * stride] += force[k / D][k % D].of(i);
  }

  struct Energies {
    Lanes8 kinetic = {}, axial = {}, bending = {}, external = {}, dissipation = {};
  };
  NURBEAM_WITHIN void add_point_energies(const Nodes& e, const Nodes& e_rate, Energies& sum) const {
    const double EA = beam.pointwise_axial_stiffness(), EI = beam.axis_bending_stiffness();
    const double c = beam.damping;
    const bool material = beam.curvature == CurvatureMeasure::material;
    for (const FixedLanes::Point& p : numbers.at) {
      const LaneVector<D> rs = combination(e, p.S1), rss = combination(e, p.S2);
      const Curvature<D> K(rs, rss, material);
      const Lanes8 bent = K.value - p.kappa0, stretched = (dot<D>(rs, rs) - 1) / 2 - p.eps0;
      Lanes8 bend = bent * bent;
      if constexpr (D == 3) bend -= curvature_rounding * curvature_rounding * is_zero(p.kappa0);
      sum.axial += EA / 2 * (p.weight * stretched * stretched);
      sum.bending += EI / 2 * (p.weight * bend);
      if (!(c > 0)) continue;
      const LaneVector<D> rs_rate = combination(e_rate, p.S1);
      const Lanes8 bending = K.rate(rs_rate, combination(e_rate, p.S2)), stretching = dot<D>(rs, rs_rate);
      sum.dissipation += c * (p.weight * (EI * (bending * bending) + EA * (stretching * stretching)));
    }
  }

  // As add_axial_forces.
  NURBEAM_WITHIN void add_axial_energies(const Nodes& e, const Nodes& e_rate, const Eigen::VectorXd& sides,
                                         double free_strain, Energies& sum) const {
    const bool assumed = beam.axial_strain == AxialStrain::ends_and_mean;
    if (!assumed && !(beam.tension_damping > 0)) return;
    const auto [I_e, I] = stretch(e, free_strain);
    const Lanes8 l = numbers.length;
    if (beam.tension_damping > 0) {
      const double factor = beam.tension_damping * beam.axial_stiffness;
      const Lanes8 eta = factor / l * tension(I, sides);
      sum.dissipation += eta * sum_of_products(e_rate, product(e_rate, numbers.stretch));
    }
    if (!assumed) return;
    const double EA = beam.axial_stiffness, viscosity = beam.damping * EA;
    const auto [c0, c1, c2] = assumed_strain(e, I, free_strain);
    sum.axial += EA / 2 * (l * (c0 * c0 + c1 * c1 / 3 + c2 * c2 / 5));
    if (!(viscosity > 0)) return;
    const auto [on_I, on_a, on_b, I_rate, a_rate, b_rate] = axial_damping(e, e_rate, I_e, viscosity);
    sum.dissipation += on_I * I_rate + on_a * a_rate + on_b * b_rate;
  }

  NURBEAM_WITHIN std::array<ElementEnergy, lanes> energies(const State& state, const Vector& load,
                                                           double free_strain) const {
    Nodes e = gathered(state.q.data());
    const Nodes e_rate = gathered(state.v.data());
    for (int d = 0; d < D; ++d) e[3][d] += batch.slope_offset_[d];
    Energies sum;
    for (int k = 0; k < 4; ++k)
      for (int d = 0; d < D; ++d) sum.external -= load[d] * (e[k][d] * numbers.load_factor[k]);
    sum.kinetic = sum_of_products(e_rate, product(e_rate, numbers.mass)) / 2;
    sum.dissipation = 2 * beam.mass_damping * sum.kinetic;
    add_point_energies(e, e_rate, sum);
    add_axial_energies(e, e_rate, state.sides, free_strain, sum);
    std::array<ElementEnergy, lanes> each;
    for (int i = 0; i < batch.count_; ++i) {
      each[i].kinetic = sum.kinetic.of(i);
      each[i].axial = sum.axial.of(i);
      each[i].bending = sum.bending.of(i);
      each[i].external = sum.external.of(i);
      each[i].dissipation = sum.dissipation.of(i);
    }
    return each;
  }

  NURBEAM_WITHIN std::array<double, lanes> lengths(const State& state) const {
    Nodes e = gathered(state.q.data());
    for (int d = 0; d < D; ++d) e[3][d] += batch.slope_offset_[d];
    Lanes8 sum = {};
    for (const FixedLanes::Point& p : numbers.at) {
      const LaneVector<D> rs = combination(e, p.S1);
      sum += p.weight * square_root(dot<D>(rs, rs));
    }
    std::array<double, lanes> each;
    for (int i = 0; i < lanes; ++i) each[i] = sum.of(i);
    return each;
  }

  // The tangent of add_point_forces; the blocks above the diagonal alone.
  NURBEAM_WITHIN void add_point_tangents(const Nodes& e, double stiffness, Tangents& K) const {
    const double EA = stiffness * beam.pointwise_axial_stiffness(),
                 EI = stiffness * beam.axis_bending_stiffness();
    const bool material = beam.curvature == CurvatureMeasure::material;
    for (const FixedLanes::Point& p : numbers.at) {
      const LaneVector<D> rs = combination(e, p.S1), rss = combination(e, p.S2);
      PairMatrix<D> H = bending_hessian<D>(rs, rss, material, EI, p.kappa0, p.weight);
      if (EA > 0) {
        const Lanes8 axial = EA * p.weight, stretching = axial * ((dot<D>(rs, rs) - 1) / 2 - p.eps0);
        for (int a = 0; a < D; ++a) {
          H[a][a] += stretching;
          for (int b = 0; b < D; ++b) H[a][b] += axial * rs[a] * rs[b];
        }
      }
      for (int k = 0; k < 4; ++k)
        for (int b = 0; b < D; ++b) {
          std::array<Lanes8, 2 * D> by;
          for (int a = 0; a < 2 * D; ++a) by[a] = p.S1[k] * H[a][b] + p.S2[k] * H[a][D + b];
          for (int l = 0; l <= k; ++l)
            for (int a = 0; a < D; ++a) K[k * D + b][l * D + a] += p.S1[l] * by[a] + p.S2[l] * by[D + a];
        }
    }
  }

  // The tangent of the assumed axial strain: as add_point_tangents.
  NURBEAM_WITHIN void add_axial_tangents(const Nodes& e, double free_strain, double stiffness,
                                         Tangents& K) const {
    const auto [I_e, I] = stretch(e, free_strain);
    const Lanes8 l = numbers.length;
    const double EA = stiffness * beam.axial_stiffness;
    const auto [on_I, on_a, on_b] = axial_stress(e, I, EA, free_strain);
    for (int k = 0; k < 4; ++k)
      for (int m = 0; m <= k; ++m)
        for (int d = 0; d < D; ++d) K[k * D + d][m * D + d] += on_I * numbers.stretch[k][m];
    for (int d = 0; d < D; ++d) {
      K[D + d][D + d] += on_a;
      K[3 * D + d][3 * D + d] += on_b;
    }
    // By I, eps_A and eps_B: H x_q, then x_q' H x_q.
    const Lanes8 on_ends = 2. / 15 * EA * l, across = -1. / 30 * EA * l, mean = 1.2 * EA / l;
    for (int k = 0; k < 4; ++k)
      for (int b = 0; b < D; ++b) {
        const Lanes8 &by_I = I_e[k][b], by_a = k == 1 ? e[1][b] : Lanes8{},
                     by_b = k == 3 ? e[3][b] : Lanes8{};
        const Lanes8 I_k = mean * by_I - 0.1 * EA * (by_a + by_b);
        const Lanes8 a_k = -0.1 * EA * by_I + on_ends * by_a + across * by_b;
        const Lanes8 b_k = -0.1 * EA * by_I + on_ends * by_b + across * by_a;
        for (int m = 0; m <= k; ++m)
          for (int a = 0; a < D; ++a) {
            Lanes8& entry = K[k * D + b][m * D + a];
            entry += I_e[m][a] * I_k;
            if (m == 1) entry += e[1][a] * a_k;
            if (m == 3) entry += e[3][a] * b_k;
          }
      }
  }

  NURBEAM_WITHIN void tangents(const State& state, double free_strain, const TangentWeights& w,
                               Tangents& K) const {
    Nodes e = gathered(state.q.data());
    for (int d = 0; d < D; ++d) e[3][d] += batch.slope_offset_[d];
    for (int k = 0; k < 4; ++k)
      for (int m = 0; m <= k; ++m)
        for (int b = 0; b < D; ++b)
          for (int a = 0; a < D; ++a)
            K[k * D + b][m * D + a] = a == b ? w.mass * numbers.mass[k][m] : Lanes8{};
    if (w.stiffness != 0) {
      add_point_tangents(e, w.stiffness, K);
      if (beam.axial_strain == AxialStrain::ends_and_mean) add_axial_tangents(e, free_strain, w.stiffness, K);
    }
    for (int j = 0; j < nodal; ++j)
      for (int i = 0; i < j; ++i) K[i][j] = K[j][i];
  }
};

}  // namespace nurbeam
