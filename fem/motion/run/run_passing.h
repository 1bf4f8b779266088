#pragma once
#include <optional>

#include "fem/motion/events/crossing.h"
#include "fem/motion/events/step_events.h"
#include "fem/motion/run/run.h"

/// The effects of events that steps have landed at. Energy that they take is lost, or is the work of drives.
namespace nurbeam {

/// Applies the event that a step has ended at, or would begin with.
[[nodiscard]] bool pass_event(Run& run, const StepEvent& event, Arrival arrival);
/// Applies the first impacts of the run: those of bodies that are at a hard stop and move on into it.
[[nodiscard]] bool pass_first_impacts(Run& run);
/// Whether the event has closed a hard stop.
bool rests_by(const Run& run, const StepEvent& event);
/// Goes on beyond a place that a rider has landed at: a point enters the next element.
[[nodiscard]] bool step_over(Run& run, const Crossing& crossing);
/// Ends the sliding of a body at the end of its beam: it leaves the beam, or stops there.
[[nodiscard]] bool end_sliding(Run& run, const Crossing& ending);
/// Passes a moment at which the speeds of prescribed motions jump. Bodies that have come to a free end and
/// are to leave it do; the others take their new speeds, as in an impact, whose work is that of the drives.
[[nodiscard]] bool pass_kink(Run& run);
/// Releases the bodies that are held until now.
[[nodiscard]] bool release_bodies(Run& run);
/// Records events of bodies that stick or slide though their step did not end there.
void note_friction(Run& run, const State& before, const std::optional<StepEvent>& located);

}  // namespace nurbeam
