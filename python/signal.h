#pragma once
#include <Eigen/Core>
#include <limits>
#include <mutex>

namespace nurbeam::python {

/// A number or a vector in time that the forces, the drives and the wind of a run read, and that is set
/// between its steps: a straight line in time from one moment to another, then constant. Setting it is no
/// change of the model. Any thread may read it.
class Signal {
 public:
  struct State {
    int size = 1;                                     ///< 1 or 3 numbers
    Eigen::Vector3d value = Eigen::Vector3d::Zero();  ///< at `since`; as the others, the first `size` count
    Eigen::Vector3d slope = Eigen::Vector3d::Zero();  ///< [1/s]
    Eigen::Vector3d integral = Eigen::Vector3d::Zero();      ///< over the time until `since`
    double since = 0;                                        ///< [s]
    double until = std::numeric_limits<double>::infinity();  ///< constant from then on [s]
    bool drives = false;  ///< a joint or a support has it as its speed, which cannot jump
  };
  struct Moment {
    Eigen::Vector3d value, slope, integral;
  };

  explicit Signal(State state) : state_(std::move(state)) {}
  Signal(const Signal&) = delete;
  Signal& operator=(const Signal&) = delete;

  int size() const { return state().size; }
  Moment at(double t) const;
  State state() const;
  void restore(const State& state);
  /// Marks it as a speed.
  void set_drives();
  /// From `t` on `value` with a slope, until a time. Throws std::invalid_argument where the numbers are not
  /// finite, and where the speed of a drive would jump.
  void set(double t, const Eigen::Vector3d& value, const Eigen::Vector3d& slope, double until);

 private:
  mutable std::mutex mutex_;
  State state_;
};

}  // namespace nurbeam::python
