#pragma once
#include <array>
#include <memory>

#include "fem/element/beam_element.h"
#include "solver/system/state.h"

namespace nurbeam {

/// Up to eight elements of one beam whose ends are fixed, each on one part of the drawing, and their forces
/// and tangents all at once: those of BeamElement, added up in another order. Compiled for several
/// processors, of which the present one is found when the program starts; the bits are the same on all of
/// them.
template <int D>
class ElementBatch {
 public:
  using Vector = Eigen::Matrix<double, D, 1>;
  static constexpr int lanes = FixedLanes::lanes, nodal = ElementLayout<D>::nodal;

  /// Whether it can take an element: one with fixed ends, on one part.
  static bool takes(const BeamElement<D>& element) { return element.is_one_part(); }

  /// Without elements; `properties` must outlive it.
  explicit ElementBatch(const BeamProperties& properties);
  bool is_full() const { return count_ == lanes; }
  int count() const { return count_; }
  /// Adds an element of the same properties; `dofs`: its global coordinates; `slope_offset`: of the slope at
  /// its end B from what stands there; `side`: its place in State::sides; `forces_at`: where its forces
  /// begin, of those that are added to. Precondition: takes(element), !is_full().
  void add(const BeamElement<D>& element, const std::array<int, element_size<D>>& dofs,
           const Vector& slope_offset, int side, std::ptrdiff_t forces_at = 0);

  /// Adds the forces of the elements to those of all coordinates, which are `stride` apart. `load`: as
  /// BeamElement::force has it; `free_strain`: as ElementState has it. Takes least where a full batch is of
  /// elements with the same coordinates, whose forces begin one beside the other.
  void add_forces(const State& state, const Vector& load, double free_strain, double* forces,
                  std::ptrdiff_t stride = 1) const;

  /// Their energies, of the first count(); `load`: the dead load of which they have the potential [N/m].
  std::array<ElementEnergy, lanes> energies(const State& state, const Vector& load, double free_strain) const;

  /// Their deformed lengths, of the first count() [m].
  std::array<double, lanes> lengths(const State& state) const;

  /// Whether add_number_rates can take elements of these properties.
  static bool has_number_rates(const BeamProperties& properties) { return !(properties.tension_damping > 0); }
  /// How sums of the forces, each times a multiplier of its coordinate, change with the numbers of the
  /// elements, added to `rates`. `multipliers`: of all coordinates. Precondition: has_number_rates of the
  /// properties.
  void add_number_rates(const State& state, const Vector& load, double free_strain, const double* multipliers,
                        FixedLanes& rates) const;
  /// The numbers of an element, in all lanes. Precondition: takes(element).
  static FixedLanes numbers(const BeamElement<D>& element);

  /// Tangents in the coordinates of the nodes, by column and row.
  using Tangents = std::array<std::array<ElementLanes, nodal>, nodal>;
  /// Those of BeamElement::tangent.
  void tangents(const State& state, double free_strain, const TangentWeights& w, Tangents& K) const;

 private:
  /// Numbers of the nodes, by column of ElementNodes and direction.
  using Nodes = std::array<std::array<ElementLanes, D>, 4>;
  struct Kernel;
  struct NumberRates;

  void take_numbers(const BeamElement<D>& element);

  const BeamProperties* properties_;
  std::shared_ptr<FixedLanes> numbers_;  ///< of the elements, where these have them, or put together
  int count_ = 0;
  std::array<std::array<int, lanes>, nodal> dofs_ = {};
  std::array<int, lanes> sides_ = {};
  std::array<std::ptrdiff_t, lanes> forces_at_ = {};
  bool same_dofs_ = true;             ///< in all elements
  bool forces_stand_beside_ = false;  ///< of a full batch with the same dofs
  std::array<ElementLanes, D> slope_offset_ = {};
};

}  // namespace nurbeam
