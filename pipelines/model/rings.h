#pragma once
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "fem/model/beam_model.h"
#include "pipelines/diagnostics/findings.h"
#include "pipelines/model/model_frame.h"
#include "pipelines/model/resolved_case.h"

namespace nurbeam {

/// Rings: bodies without mass at places of beams, in space, on a path or on a body. Eyelets and mouths of
/// reels are rings.
class Rings {
 public:
  /// All must outlive this.
  Rings(const ResolvedCase& resolved, const ModelFrame& frame, BeamModel& model)
      : resolved_(resolved), frame_(frame), model_(model) {}

  /// What a case says of where a ring is.
  struct Said {
    const std::string& on;                    ///< the body that carries it; empty: none
    std::optional<Eigen::Vector3d> position;  ///< [m]; else where the beam is drawn, or the path begins
    const std::vector<DisplacementTable::Row>& path;  ///< places over time [m]; empty: it stands
  };
  /// Where a ring is, in the model's own axes.
  struct Place {
    Eigen::Vector3d position;                 ///< at the start [m]
    std::optional<DisplacementTable> motion;  ///< from there on
    int carrier = -1;                         ///< the body that carries it
  };

  /// `drawn`: where the beam is drawn there [m]. A body that carries rings, slides nowhere and has no
  /// position is put where the first of them is drawn.
  Place place_of(const Said& said, const Eigen::Vector3d& drawn);

  /// Adds the ring, whose body is the last of the model then.
  void add(const std::string& name, const Eigen::Vector3d& drawn, Place place);

 private:
  void put_carrier(int carrier, const Eigen::Vector3d& drawn);

  const ResolvedCase& resolved_;
  const ModelFrame& frame_;
  BeamModel& model_;
  std::set<int> put_;  // carriers
};

/// The friction at a ring of a beam; none where modes and buckling are asked for. A stick is as stiff as an
/// element: what has no mass has no frequency to give it.
std::optional<Friction> ring_friction(std::optional<Friction> said, const CaseAnalysis& analysis,
                                      const Beam& beam);

/// The direction of a sleeve in the model's own axes; an error where it has no length or is more than 60
/// degrees from the drawing.
std::optional<Eigen::Vector3d> sleeve_direction(const std::optional<Eigen::Vector3d>& said,
                                                const std::string& path, const ReferenceCurve& curve,
                                                double s, const ModelFrame& frame, Findings& findings);

}  // namespace nurbeam
