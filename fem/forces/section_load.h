#pragma once
#include <optional>

#include "fem/forces/load_at_place.h"
#include "fem/mesh/mesh_elements.h"

namespace nurbeam {

/// Kinds of loads at a place of a beam with torsion that work on its section: a moment, dead or follower, or
/// a force that follows the section or acts beside the axis.
enum class OnSection { moment, force };
inline bool works_on_section(const LoadAtPlace& load, OnSection kind, const Structure& structure) {
  return structure.beams[load.beam].has_torsion() &&
         (kind == OnSection::moment || load.follower || load.offset != Eigen::Vector2d::Zero());
}

/// A load on a section in one state.
struct SectionLoad {
  int element;
  TwistLayout::Coordinates force;  ///< generalised force, with the factors of time and of State::load
  TwistLayout::Matrix gradient;    ///< derivative of the force in q; unset without `with_gradient`

  /// The load in a state; nothing where it has left the beam. Precondition: the beam has torsion.
  static std::optional<SectionLoad> of(const LoadAtPlace& load, OnSection kind, const MeshedBeams<3>& at,
                                       const State& state, bool with_gradient);

  void add_force(const MeshedBeams<3>& at, Eigen::Ref<Eigen::VectorXd> dynamics) const;
  /// Power [W].
  double power(const MeshedBeams<3>& at, const Eigen::VectorXd& v) const;
};

/// Work between two states [J]: the mean power over the time.
double section_load_work(const LoadAtPlace& load, OnSection kind, const MeshedBeams<3>& at, const State& from,
                         const State& to);

}  // namespace nurbeam
