#pragma once
#include <optional>

#include "fem/motion/events/crossing.h"
#include "fem/motion/events/step_events.h"
#include "fem/motion/run/run.h"

/// What happens to a run at the events that its steps have landed at. What they take from the energy is lost,
/// or is the work of drives.
namespace nurbeam {

/// What the event that a step has ended at, or would begin with, does.
[[nodiscard]] bool pass_event(Run& run, const StepEvent& event, Arrival arrival);
/// As the run begins: the impacts of bodies that are at a hard stop and move on into it.
[[nodiscard]] bool pass_first_impacts(Run& run);
/// Whether the event has closed a hard stop.
bool rests_by(const Run& run, const StepEvent& event);
/// Goes on beyond a place that a rider has landed at: a point in the next element.
[[nodiscard]] bool step_over(Run& run, const Crossing& crossing);
/// The body leaves its beam at the end that it has come to, or stops there.
[[nodiscard]] bool end_sliding(Run& run, const Crossing& ending);
/// At a moment where the speeds of prescribed motions jump: bodies that have come to a free end and are to
/// leave it do; the others take their new speeds, as in an impact, whose work is that of the drives.
[[nodiscard]] bool pass_kink(Run& run);
/// Those that are held until now.
[[nodiscard]] bool release_bodies(Run& run);
/// Of bodies that stick or slide though their step did not end there.
void note_friction(Run& run, const State& before, const std::optional<StepEvent>& located);

}  // namespace nurbeam
