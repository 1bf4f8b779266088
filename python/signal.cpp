#include "python/signal.h"

#include <algorithm>
#include <stdexcept>

#include "nurbs/number_text.h"

namespace nurbeam::python {

namespace {

Signal::Moment moment_of(const Signal::State& s, double t) {
  const double on_line = std::min(t, s.until) - s.since, after = std::max(t - s.until, 0.0);
  const Eigen::Vector3d value = s.value + on_line * s.slope;
  return {value, t < s.until ? s.slope : Eigen::Vector3d::Zero().eval(),
          s.integral + on_line * (s.value + value) / 2 + after * value};
}

}  // namespace

Signal::Moment Signal::at(double t) const { return moment_of(state(), t); }

Signal::State Signal::state() const {
  const std::lock_guard lock(mutex_);
  return state_;
}

void Signal::restore(const State& state) {
  const std::lock_guard lock(mutex_);
  state_ = state;
}

void Signal::set_drives() {
  const std::lock_guard lock(mutex_);
  state_.drives = true;
}

void Signal::set(double t, const Eigen::Vector3d& value, const Eigen::Vector3d& slope, double until) {
  if (!value.allFinite() || !slope.allFinite())
    throw std::invalid_argument("the value and the slope of a signal must be finite");
  if (!(until > t))
    throw std::invalid_argument("the signal is to arrive at " + text_of(until) + " s, but the run is at " +
                                text_of(t) + " s; give a later time");
  const std::lock_guard lock(mutex_);
  const Moment now = moment_of(state_, t);
  if (state_.drives && (value - now.value).norm() > 1e-9 * (value.norm() + now.value.norm()))
    throw std::invalid_argument("the signal is the speed of a joint or a support, which cannot jump from " +
                                text_of(now.value.norm()) + " to " + text_of(value.norm()) +
                                " m/s; let it go there in some time with ramp(signal, value, by=time)");
  state_.value = value;
  state_.slope = slope;
  state_.integral = now.integral;
  state_.since = t;
  state_.until = until;
}

}  // namespace nurbeam::python
