#pragma once
#include <array>
#include <memory>

#include "fem/element/beam_element.h"
#include "solver/system/state.h"

namespace nurbeam {

/// A batch of up to eight elements of one beam with fixed ends, each on one part of the drawing. Forces and
/// tangents are those of BeamElement, added up in another order, for all elements at once. The code is
/// compiled for several processors; the present one is found when the program starts. The bits are equal on
/// all of them.
template <int D>
class ElementBatch {
 public:
  using Vector = Eigen::Matrix<double, D, 1>;
  static constexpr int lanes = FixedLanes::lanes, nodal = ElementLayout<D>::nodal;

  /// Whether a batch can take an element: with fixed ends, on one part.
  static bool takes(const BeamElement<D>& element) { return element.is_one_part(); }

  /// An empty batch; `properties` must outlive it.
  explicit ElementBatch(const BeamProperties& properties);
  bool has(const BeamProperties& properties) const { return *properties_ == properties; }
  bool is_full() const { return count_ == lanes; }
  int count() const { return count_; }
  /// Adds an element with the same properties. `dofs`: its global coordinates; `slope_offset`: offset of the
  /// slope at its end B from that coordinate; `side`: its index in State::sides; `forces_at`: index where its
  /// forces begin in the array of forces. Precondition: takes(element), !is_full().
  void add(const BeamElement<D>& element, const std::array<int, element_size<D>>& dofs,
           const Vector& slope_offset, int side, std::ptrdiff_t forces_at = 0);

  /// Adds the forces of the elements to the forces on all coordinates, which are `stride` apart. `load`: see
  /// BeamElement::force; `free_strain`: see ElementState. A full batch of elements with the same coordinates,
  /// whose forces begin one beside the other, is fastest.
  void add_forces(const State& state, const Vector& load, double free_strain, double* forces,
                  std::ptrdiff_t stride = 1) const;

  /// Energies of the first count() elements; `load`: the dead load whose potential is included [N/m].
  std::array<ElementEnergy, lanes> energies(const State& state, const Vector& load, double free_strain) const;

  /// Deformed lengths of the first count() elements [m].
  std::array<double, lanes> lengths(const State& state) const;

  /// Whether add_number_rates can take elements of these properties.
  static bool has_number_rates(const BeamProperties& properties) {
    return !(properties.tension_damping > 0) && properties.compression == Compression::full &&
           !std::holds_alternative<ForceOverStretch>(properties.law);
  }
  /// Adds to `rates` the derivatives of a sum by the numbers of the elements: the sum of their forces, each
  /// times the multiplier of its coordinate. `multipliers`: of all coordinates. Precondition:
  /// has_number_rates of the properties.
  void add_number_rates(const State& state, const Vector& load, double free_strain, const double* multipliers,
                        FixedLanes& rates) const;
  /// The numbers of an element, in all lanes. Precondition: takes(element).
  static FixedLanes numbers(const BeamElement<D>& element);

  /// Tangents in the coordinates of the nodes, by column and row.
  using Tangents = std::array<std::array<ElementLanes, nodal>, nodal>;
  /// Tangents as of BeamElement::tangent.
  void tangents(const State& state, double free_strain, const TangentWeights& w, Tangents& K) const;

 private:
  /// Numbers of the nodes, by column of ElementNodes and direction.
  using Nodes = std::array<std::array<ElementLanes, D>, 4>;
  struct Kernel;
  struct NumberRates;

  void take_numbers(const BeamElement<D>& element);

  const BeamProperties* properties_;
  std::shared_ptr<FixedLanes> numbers_;  ///< of the elements: shared with them, or put together here
  int count_ = 0, own_slopes_ = 0;       ///< own_slopes_: the largest OwnSlopes::count() of the elements
  std::array<std::array<int, lanes>, nodal> dofs_ = {};
  std::array<int, lanes> sides_ = {};
  std::array<std::ptrdiff_t, lanes> forces_at_ = {};
  bool same_dofs_ = true;             ///< equal in all elements
  bool forces_stand_beside_ = false;  ///< for a full batch with equal dofs
  std::array<ElementLanes, D> slope_offset_ = {};
};

}  // namespace nurbeam
