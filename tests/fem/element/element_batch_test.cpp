#include "fem/element/element_batch.h"

#include <gtest/gtest.h>

#include "fem/mesh/mesh_elements.h"
#include "fem/system/assembly.h"
#include "tests/fem/axial_laws.h"
#include "tests/fem/random_models.h"

namespace nurbeam {
namespace {

void expect_same(const ElementEnergy& a, const ElementEnergy& b) {
  constexpr double rounding = 1e-13;
  EXPECT_NEAR(a.kinetic, b.kinetic, rounding * b.kinetic);
  EXPECT_NEAR(a.axial, b.axial, rounding * b.axial);
  EXPECT_NEAR(a.bending, b.bending, rounding * b.bending);
  EXPECT_NEAR(a.external, b.external, 100 * rounding * std::abs(b.external));  // its parts cancel
  EXPECT_NEAR(a.dissipation, b.dissipation, rounding * std::abs(b.dissipation));
  for (const double part : {b.kinetic, b.axial, b.bending, std::abs(b.external)}) EXPECT_GT(part, 1e-3);
}

// Its numbers stand beside those of others: it must be what it is by itself, to the last bit.
template <int D>
void expect_as_by_itself(const MeshElement<D>& e, const State& state,
                         const Eigen::Matrix<double, D, 1>& load) {
  const BeamElement<D> alone(e.element.curve(), e.element.properties(), e.element.chart(), e.span->s_a,
                             e.span->s_b, Ends::fixed, e.element.axial_rule());
  const ElementState<D> x = gather<D>(e, state);
  const TangentWeights w{.mass = 0.3, .damping = 0.2, .stiffness = 0.7};
  EXPECT_EQ(e.element.force(x, load), alone.force(x, load));
  EXPECT_EQ(e.element.tangent(x, load, w), alone.tangent(x, load, w));
  EXPECT_EQ(e.element.energy(x, load).bending, alone.energy(x, load).bending);
  EXPECT_EQ(e.element.stretch(x.q), alone.stretch(x.q));
  EXPECT_EQ(e.element.strain_of_axis(x.q), alone.strain_of_axis(x.q));
  EXPECT_EQ(e.element.axial_mismatch(x.q), alone.axial_mismatch(x.q));
  EXPECT_EQ(e.element.length(x.q), alone.length(x.q));
}

template <int D>
void check_batches(const BeamProperties& properties, int seed, bool held) {
  std::mt19937 random(seed);
  const BeamModel model = testing::one_beam(testing::uneven_axis(random, D), D, properties, 11, {});
  const BeamSystem system(model);
  State state = testing::disturbed_state(system, random);
  state.t = 0.3;
  const Eigen::Matrix<double, D, 1> load = Eigen::Matrix<double, D, 1>::LinSpaced(0.7, -1.3);
  const auto& elements = system.assembly<D>()->elements();
  if (held) {  // each on the other side
    state.sides = system.assembly<D>()->sides(state);
    for (double& side : state.sides) side = 1 - side;
  }
  Eigen::VectorXd one_by_one = Eigen::VectorXd::Zero(system.coordinate_count()), batched = one_by_one;
  ElementEnergy energy, batched_energy;
  std::vector<ElementBatch<D>> batches;
  for (const MeshElement<D>& e : elements) {
    ASSERT_TRUE(ElementBatch<D>::takes(e.element));
    expect_as_by_itself<D>(e, state, load);
    const ElementVector<D> force = e.element.force(gather<D>(e, state), load);
    for (int k = 0; k < ElementLayout<D>::nodal; ++k) one_by_one[e.dofs[k]] += force[k];
    energy += e.element.energy(gather<D>(e, state), load);
    if (batches.empty() || batches.back().is_full()) batches.emplace_back(e.element.properties());
    batches.back().add(e.element, e.dofs, e.slope_offset, e.index);
  }
  EXPECT_EQ(batches.size(), 2u);
  for (const ElementBatch<D>& batch : batches) {
    batch.add_forces(state, load, free_strain(elements[0], state), batched.data());
    const auto energies = batch.energies(state, load, free_strain(elements[0], state));
    for (int i = 0; i < batch.count(); ++i) batched_energy += energies[static_cast<std::size_t>(i)];
  }
  expect_same(batched_energy, energy);
  if (!held) EXPECT_EQ(energy.dissipation > 0, properties.is_damped());
  EXPECT_LT((batched - one_by_one).norm(), 1e-13 * one_by_one.norm());
  EXPECT_GT(one_by_one.norm(), 1);
  if (properties.is_damped()) return;
  constexpr int nodal = ElementLayout<D>::nodal;
  for (const TangentWeights& w : {TangentWeights{.mass = 2}, TangentWeights{.mass = 0.3, .stiffness = 0.7}})
    for (std::size_t k = 0; k < elements.size(); ++k) {
      const ElementMatrix<D> K = elements[k].element.tangent(gather<D>(elements[k], state), load, w);
      typename ElementBatch<D>::Tangents side_by_side;
      batches[k / 8].tangents(state, free_strain(elements[k], state), w, side_by_side);
      double difference = 0;
      for (int j = 0; j < nodal; ++j)
        for (int i = 0; i < nodal; ++i)
          difference = std::max(difference, std::abs(side_by_side[j][i].of(k % 8) - K(i, j)));
      const double size = K.template topLeftCorner<nodal, nodal>().norm();
      EXPECT_LT(difference, 1e-12 * size);
      EXPECT_GT(K.norm(), 0.01);
    }
}

// Elements that are drawn otherwise, all at the coordinates of the first one: each force in a column of its
// own.
template <int D>
void check_at_one_place(const BeamProperties& properties, int seed) {
  std::mt19937 random(seed);
  const BeamModel model = testing::one_beam(testing::uneven_axis(random, D), D, properties, 8, {});
  const BeamSystem system(model);
  const State state = testing::disturbed_state(system, random);
  const Eigen::Matrix<double, D, 1> load = Eigen::Matrix<double, D, 1>::LinSpaced(0.7, -1.3);
  const auto& elements = system.assembly<D>()->elements();
  const MeshElement<D>& place = elements[0];
  for (const int count : {8, 5})
    for (const int apart : {1, 2}) {  // columns beside one another, and with others between
      using Columns = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
      Columns expected = Columns::Constant(system.coordinate_count(), 16, 0.25), found = expected;
      ElementBatch<D> batch(properties);
      for (int i = 0; i < count; ++i) {
        batch.add(elements[i].element, place.dofs, place.slope_offset, place.index, i * apart);
        const ElementVector<D> force = elements[i].element.force(gather<D>(place, state), load);
        for (int k = 0; k < ElementLayout<D>::nodal; ++k) expected(place.dofs[k], i * apart) += force[k];
      }
      batch.add_forces(state, load, free_strain(place, state), found.data(), found.cols());
      EXPECT_LT((found - expected).norm(), 1e-13 * expected.norm()) << count << " " << apart;
      EXPECT_GT((expected.array() - 0.25).matrix().norm(), 1);
    }
}

/// Between two axes: control points and weights `part` of the way to the other.
std::vector<RationalCubic> between(const std::vector<RationalCubic>& one,
                                   const std::vector<RationalCubic>& other, double part) {
  std::vector<RationalCubic> axis;
  for (std::size_t i = 0; i < one.size(); ++i) {
    Eigen::Matrix4d points;
    for (int k = 0; k < 4; ++k) {
      const double w = (1 - part) * one[i].points()(3, k) + part * other[i].points()(3, k);
      points.col(k) << w * ((1 - part) * one[i].control_point(k) + part * other[i].control_point(k)), w;
    }
    axis.emplace_back(points);
  }
  return axis;
}

// Back from multipliers of the forces to the numbers of elements, and along these from one drawing to
// another: what differences of the forces tend to, as the square of their step.
template <int D>
void check_number_rates(const BeamProperties& properties, int seed) {
  std::mt19937 random(seed);
  const auto one = testing::uneven_axis(random, D), other = testing::uneven_axis(random, D);
  constexpr int count = 11;
  const auto system_at = [&](double part) {
    return std::make_unique<BeamSystem>(
        testing::one_beam(between(one, other, part), D, properties, count, {}));
  };
  const auto here = system_at(0);
  const State state = testing::disturbed_state(*here, random);
  const Eigen::Matrix<double, D, 1> load = Eigen::Matrix<double, D, 1>::LinSpaced(0.7, -1.3);
  const Eigen::VectorXd multipliers = Eigen::VectorXd::Random(here->coordinate_count());
  const auto elements = [](const auto& system) -> const auto& {
    return system->template assembly<D>()->elements();
  };
  const double free = free_strain(elements(here)[0], state);
  std::vector<FixedLanes> rates;
  for (int first = 0; first < count; first += FixedLanes::lanes) {
    ElementBatch<D> batch(elements(here)[first].element.properties());
    for (int i = first; i < std::min(count, first + FixedLanes::lanes); ++i)
      batch.add(elements(here)[i].element, elements(here)[i].dofs, elements(here)[i].slope_offset, i);
    batch.add_number_rates(state, load, free, multipliers.data(), rates.emplace_back());
  }
  const auto error_of_differences = [&](double h) {
    const auto more = system_at(h), less = system_at(-h);
    double square = 0, size = 0;
    for (int i = 0; i < count; ++i) {
      const auto power = [&](const MeshElement<D>& e) {
        const ElementVector<D> force = e.element.force(gather<D>(e, state), load);
        double sum = 0;
        for (int k = 0; k < ElementLayout<D>::nodal; ++k) sum += multipliers[e.dofs[k]] * force[k];
        return sum;
      };
      const auto along = [&](const MeshElement<D>& e) {
        return rates[i / FixedLanes::lanes].product(i % FixedLanes::lanes,
                                                    ElementBatch<D>::numbers(e.element), 0);
      };
      const MeshElement<D>&above = elements(more)[i], &below = elements(less)[i];
      EXPECT_LT((above.slope_offset - below.slope_offset).norm(), 1e-12);
      const double rate = (along(above) - along(below)) / (2 * h);
      square += std::pow(rate - (power(above) - power(below)) / (2 * h), 2);
      size += rate * rate;
    }
    return std::sqrt(square / size);
  };
  const double error = error_of_differences(0.002), of_half = error_of_differences(0.001);
  EXPECT_LT(error, 1e-3);
  EXPECT_NEAR(error / of_half, 4, 0.2);
}

template <int D>
void check_all_number_rates() {
  int seed = 70;
  for (const AxialStrain strain : {AxialStrain::pointwise, AxialStrain::ends_and_mean})
    for (const CurvatureMeasure curvature : {CurvatureMeasure::spatial, CurvatureMeasure::material})
      for (const bool damped : {false, true}) {
        BeamProperties properties(300, 2, 0.7, damped ? 0.02 : 0, {});
        properties.curvature = curvature;
        properties.axial_strain = strain;
        if (damped) properties.mass_damping = 0.4;
        if (strain == AxialStrain::ends_and_mean) properties.free_strain.constant = 0.01;
        SCOPED_TRACE(seed);
        check_number_rates<D>(properties, ++seed);
        properties.law = HookeLaw();
        check_number_rates<D>(properties, seed);
      }
}

TEST(ElementBatch, HasTheRatesOfItsForcesByTheNumbersOfItsElementsInThePlane) { check_all_number_rates<2>(); }
TEST(ElementBatch, HasTheRatesOfItsForcesByTheNumbersOfItsElementsInSpace) { check_all_number_rates<3>(); }

template <int D>
void check_all_kinds() {
  int seed = 40;
  for (const AxialStrain strain : {AxialStrain::pointwise, AxialStrain::ends_and_mean})
    for (const CurvatureMeasure curvature : {CurvatureMeasure::spatial, CurvatureMeasure::material})
      for (const bool damped : {false, true}) {
        BeamProperties properties(300, 2, 0.7, damped ? 0.02 : 0, {});
        properties.curvature = curvature;
        properties.axial_strain = strain;
        if (damped) {
          properties.mass_damping = 0.4;
          properties.tension_damping = 0.3;
        }
        if (strain == AxialStrain::ends_and_mean) properties.free_strain.constant = 0.01;
        check_batches<D>(properties, ++seed, false);
        if (damped) check_batches<D>(properties, seed, true);
        check_at_one_place<D>(properties, seed);
        for (const AxialLaw& law : testing::other_laws()) {
          properties.law = law;
          check_batches<D>(properties, seed, false);
        }
      }
}

TEST(ElementBatch, HasTheForcesEnergiesAndTangentsOfItsElementsInThePlane) { check_all_kinds<2>(); }
TEST(ElementBatch, HasTheForcesEnergiesAndTangentsOfItsElementsInSpace) { check_all_kinds<3>(); }

TEST(ElementBatch, TakesNoElementWhoseEndsMove) {
  std::mt19937 random(3);
  BeamModel model = testing::one_beam(testing::uneven_axis(random, 2), 2, {300, 2, 0.7, 0, {}}, 5, {});
  testing::add_slider(model, 1, 0.3 * model.beams[0].curve.length());
  const BeamSystem system(model);
  int moving = 0;
  for (const MeshElement<2>& e : system.assembly<2>()->elements()) {
    moving += !e.element.fixed();
    EXPECT_EQ(ElementBatch<2>::takes(e.element), e.element.fixed());
  }
  EXPECT_EQ(moving, 2);
}

}  // namespace
}  // namespace nurbeam
