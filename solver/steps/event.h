#pragma once
#include <functional>

#include "solver/steps/integrator.h"

namespace nurbeam {

/// A step that has gone beyond an event, for land_before().
struct StepTaken {
  const State& before;
  const IntegratorHistory& history;  ///< at `before`
  const State& after;
  double length;               ///< [s]
  long* iterations = nullptr;  ///< counter for Newton iterations of repeated steps, if any
};

/// The state just before an event to which a step of another length from `taken.before` leads: 0 >= g >
/// -`near` there, or as near as steps come that differ by 1e-7. `g` is negative before the event and positive
/// at `taken.after`. If a repeated step fails, as Newton's iteration may at the event, it counts as beyond.
/// The integrator is left at some state of the search. With `leaves` a step may begin at the event, which
/// counts when the state comes back to it.
State land_before(Integrator& integrator, const StepTaken& taken,
                  const std::function<double(const State&)>& g, double near, bool leaves = false);

}  // namespace nurbeam
