#include "python/live_run.h"

#include <stdexcept>
#include <string>
#include <variant>

#include "pipelines/run/simulation_plan.h"
#include "python/laws.h"

namespace nurbeam::python {

namespace py = pybind11;

namespace {

std::shared_ptr<Recording> recording_for(const BuiltCase& c) {
  auto recording = std::make_shared<Recording>();
  recording->title = c.case_file.name;
  recording->names = snapshot_names(c.built());
  return recording;
}

// Ctrl-C ends a search for rest. A motion is asked between two steps by the run itself, and so stays where it
// can go on.
SimulationObserver observer_of(const BuiltCase& c, Recording& recording, Interrupts& interrupts,
                               const bool& begun) {
  SimulationObserver observer;
  observer.snapshot = [&](const Snapshot& local) {
    recording.frames.push_back(to_world(c.built().frame, local));
  };
  const bool statics = c.case_file.analysis.type == CaseAnalysis::Type::statics;
  observer.interrupted = [statics, &begun, &interrupts] {
    return (statics || !begun) && interrupts.pending();
  };
  return observer;
}

}  // namespace

// While it lives no other thread advances the run, and Python goes on.
class LiveRun::Turn {
 public:
  explicit Turn(LiveRun& run) : run_(run) {
    if (run_.busy_.test_and_set())
      throw std::runtime_error(
          "the simulation is being advanced already, by another thread or by the law that calls");
    released_.emplace();
  }
  ~Turn() {
    released_.reset();
    run_.busy_.clear();
  }
  Turn(const Turn&) = delete;
  Turn& operator=(const Turn&) = delete;

 private:
  LiveRun& run_;
  std::optional<py::gil_scoped_release> released_;
};

LiveRun::LiveRun(std::shared_ptr<BuiltCase> of, const Functions& functions, const Checkpoint* start)
    : of_(std::move(of)),
      recording_(recording_for(*of_)),
      simulation_(
          std::make_shared<const BeamModel>(with_laws(of_->built(), functions, of_->case_file.analysis)),
          probe_places(of_->built()), simulation_options(of_->case_file),
          observer_of(*of_, *recording_, interrupts_, begun_), start) {}

bool LiveRun::advance() {
  if (ended_ || interrupts_.pending()) return false;
  ended_ = !simulation_.advance();
  begun_ = true;
  return !ended_;
}

bool LiveRun::step() {
  {
    const Turn turn(*this);
    advance();
  }
  interrupts_.rethrow();
  return !ended_;
}

std::optional<Frame> LiveRun::next() {
  {
    const Turn turn(*this);
    while (given_ == recording_->frames.size() && advance()) {
    }
  }
  interrupts_.rethrow();
  if (given_ == recording_->frames.size()) return {};
  return Frame{recording_, &recording_->frames[given_++]};
}

Frame LiveRun::now() const {
  auto alone = std::make_shared<Recording>();
  alone->title = recording_->title;
  alone->names = recording_->names;
  alone->frames.push_back(to_world(of_->built().frame, simulation_.present()));
  return {alone, &alone->frames.front()};
}

void LiveRun::change_load(std::size_t number, const Eigen::Vector3d& value) {
  const ModelFrame& frame = of_->built().frame;
  if (number >= of_->case_file.loads.size())
    throw std::invalid_argument("there is no load " + std::to_string(number) + "; the model has " +
                                std::to_string(of_->case_file.loads.size()) + ", counted from 0");
  if (!value.allFinite()) throw std::invalid_argument("the value of a load must be finite");
  const bool is_moment = of_->case_file.loads[number].kind == CaseLoad::Kind::moment;
  const Eigen::Vector3d kept = frame.rotation.transpose() *
                               (is_moment ? frame.moment_to_local(value) : frame.direction_to_local(value));
  if ((kept - value).norm() > 1e-9 * value.norm())
    throw std::invalid_argument(
        "the value of load " + std::to_string(number) +
        " does not lie in the plane of the model, as the loads that it began with do");
  const Turn turn(*this);
  const bool goes_on = simulation_.change_forces([&](std::vector<Force>& forces) {
    std::visit(
        [&](auto& load) {
          if constexpr (std::is_same_v<decltype(load), PointLoad&>)
            load.value = frame.direction_to_local(value);
          else if constexpr (std::is_same_v<decltype(load), Moment&>)
            load.value = frame.moment_to_local(value);
          else if constexpr (std::is_same_v<decltype(load), LineLoad&>)
            load.value = frame.direction_to_local(value);
          else
            throw std::invalid_argument(
                "load " + std::to_string(number) +
                " has no vector; only a force, a moment or a force per length can be changed");
        },
        forces.at(number));
  });
  if (!goes_on) ended_ = true;
}

}  // namespace nurbeam::python
