#include "python/live_run.h"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>
#include <variant>

#include "pipelines/diagnostics/closest_name.h"
#include "pipelines/run/model_digest.h"
#include "pipelines/run/simulation_plan.h"
#include "python/interpreter_lock.h"
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
SimulationObserver observer_of(const BuiltCase& c, Recording& recording, FrameChecks& checks,
                               RunExtremes& extremes, Interrupts& interrupts,
                               const std::atomic<bool>& begun) {
  SimulationObserver observer;
  observer.snapshot = [&](const Snapshot& local) {
    Snapshot frame = to_world(c.built().frame, local);
    checks.look_at(frame);
    extremes.look_at(frame, recording.names);
    const WithLock lock;
    recording.frames.push_back(std::move(frame));
  };
  observer.peak = [&](Snapshot local) {
    extremes.look_at(to_world(c.built().frame, std::move(local)), recording.names);
  };
  const bool statics = c.case_file.analysis.type == CaseAnalysis::Type::statics;
  observer.interrupted = [statics, &begun, &interrupts] {
    return (statics || !begun) && interrupts.pending();
  };
  return observer;
}

// `value` in the model's coordinates, `number` that of its load.
void set_value(Force& force, std::size_t number, const Eigen::Vector3d& value) {
  std::visit(
      [&](auto& load) {
        using Load = std::remove_reference_t<decltype(load)>;
        if constexpr (std::is_same_v<Load, PointLoad> || std::is_same_v<Load, Moment> ||
                      std::is_same_v<Load, LineLoad>)
          load.value = value;
        else
          throw std::invalid_argument(
              "load " + std::to_string(number) +
              " has no vector; only a force, a moment or a force per length can be changed");
      },
      force);
}

bool has_value(const Force& force, const Eigen::Vector3d& value) {
  return std::visit(
      [&](const auto& load) {
        if constexpr (
            requires { load.value == value; })
          return load.value == value;
        else
          return false;
      },
      force);
}

// Whether a load of the case has this value, on every beam that it is on.
bool has_value(const BuiltModel& built, std::size_t number, const Eigen::Vector3d& value,
               const std::vector<Force>& forces) {
  return std::ranges::all_of(
      built.loads.at(number), [&](int i) { return has_value(forces.at(i), value); });
}

// Gives a load of the case another value, on every beam that it is on.
void set_load(const BuiltModel& built, std::size_t number, const Eigen::Vector3d& value,
              std::vector<Force>& forces) {
  for (const int i : built.loads.at(number)) set_value(forces.at(i), number, value);
}

void check_model(const BuiltCase& c, const Checkpoint& start) {
  const std::vector<std::string> parts = differing_parts(start.model, model_digest(c.case_file, c.built()));
  if (parts.empty()) return;
  std::string names;
  for (std::size_t i = 0; i < parts.size(); ++i)
    names += (i == 0 ? "" : i + 1 < parts.size() ? ", " : " and ") + in_quotes(parts[i]);
  throw std::invalid_argument("start: the checkpoint is of another model, which differs in " + names +
                              "; go on with the model of which it was taken");
}

// The model, with the loads as a checkpoint has them.
std::shared_ptr<const BeamModel> model_of(const BuiltCase& c, const Functions& functions,
                                          const Checkpoint* start) {
  if (start) check_model(c, *start);
  BeamModel model = with_laws(c.built(), functions, c.case_file.analysis);
  if (start)
    for (const ChangedLoad& load : start->changed_loads)
      set_load(c.built(), static_cast<std::size_t>(load.number), load.value, model.forces);
  return std::make_shared<const BeamModel>(std::move(model));
}

}  // namespace

namespace {

[[noreturn]] void fail_as_busy() {
  throw std::runtime_error(
      "the simulation is being advanced already, by another thread or by the law that calls");
}

}  // namespace

class LiveRun::Advance {
 public:
  explicit Advance(LiveRun& run) : run_(run) {
    if (run_.busy_.test_and_set()) fail_as_busy();
  }
  ~Advance() { run_.busy_.clear(); }
  Advance(const Advance&) = delete;
  Advance& operator=(const Advance&) = delete;

 private:
  LiveRun& run_;
};

LiveRun::Moment::Moment(const LiveRun& run) : turns_(*run.turns_) {
  if (turns_.is_mine()) fail_as_busy();
  std::optional<WithoutLock> others_go_on;
  if (PyGILState_Check() != 0) others_go_on.emplace();
  turns_.begin();
}

LiveRun::Moment::~Moment() { turns_.end(); }

LiveRun::LiveRun(std::shared_ptr<BuiltCase> of, const Functions& functions, const Checkpoint* start)
    : of_(std::move(of)),
      recording_(recording_for(*of_)),
      checks_(of_->built().model),
      extremes_(start ? start->extremes : std::vector<double>{}),
      rows_(of_->case_file.output),
      contacts_(of_->built()),
      simulation_(model_of(*of_, functions, start), probe_places(of_->built()),
                  simulation_options(of_->case_file),
                  observer_of(*of_, *recording_, checks_, extremes_, interrupts_, begun_), start),
      time_(simulation_.state().t),
      columns_(history_columns(recording_->names)) {
  if (start) changed_loads_ = start->changed_loads;
}

Checkpoint LiveRun::checkpoint() const {
  const Moment moment(*this);
  Checkpoint point = simulation_.checkpoint();
  point.model = model_digest(of_->case_file, of_->built());
  point.changed_loads = changed_loads_;
  point.extremes = extremes_.numbers();
  return point;
}

std::pair<SimulationReport, std::vector<Diagnostic>> LiveRun::report() const {
  const Moment moment(*this);
  SimulationReport report = simulation_.report();
  std::vector<Diagnostic> warnings = run_warnings(of_->case_file, of_->built(), report, checks_);
  return {std::move(report), std::move(warnings)};
}

std::vector<RunExtreme> LiveRun::extremes() const {
  const Moment moment(*this);
  RunExtremes extremes = extremes_;
  for (Snapshot& local : simulation_.peaks())
    extremes.look_at(to_world(of_->built().frame, std::move(local)), recording_->names);
  return extremes.list();
}

bool LiveRun::advance() {
  if (ended_ || interrupts_.pending()) return false;
  const Moment moment(*this);
  const double before = time_;
  ended_ = !simulation_.advance();
  begun_ = true;
  time_ = simulation_.state().t;
  keep_row(before);
  return !ended_;
}

// Rows of histories, where the case asks for more than those of frames.
void LiveRun::keep_row(double before) {
  if (!rows_.any() || of_->case_file.analysis.type != CaseAnalysis::Type::dynamic) return;
  Recording& recording = *recording_;
  const bool is_frame = !recording.frames.empty() && recording.frames.back().time == time_;
  if (!recording.row_times.empty() && recording.row_times.back() == time_) return;
  if (!is_frame && !rows_.due(before, time_)) return;
  std::optional<Snapshot> between;
  if (!is_frame) between = to_world(of_->built().frame, simulation_.present(contents_between_frames));
  const Snapshot& moment = between ? *between : recording.frames.back();
  contacts_.look_at(moment);
  const WithLock lock;
  recording.row_times.push_back(time_);
  for (const HistoryColumn& column : columns_)
    recording.row_values.push_back(is_frame || is_known_between_frames(column)
                                       ? column.value(moment)
                                       : std::numeric_limits<double>::quiet_NaN());
}

std::string LiveRun::collectors() const {
  const Moment moment(*this);
  return collectors_as_json(contacts_.outcomes());
}

bool LiveRun::step() {
  const Advance alone(*this);
  {
    const WithoutLock others_go_on;
    advance();
  }
  interrupts_.rethrow();
  return !ended_;
}

std::optional<Frame> LiveRun::next() {
  const Advance alone(*this);
  {
    const WithoutLock others_go_on;
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
  alone->frames.push_back(between_steps(
      [this](const Simulation& simulation) { return to_world(of_->built().frame, simulation.present()); }));
  return {alone, &alone->frames.front()};
}

std::vector<double> LiveRun::values(const std::vector<std::string>& names) const {
  SnapshotContents contents{
      .beams = false, .probes = false, .sections = false, .reactions = false, .energy = false};
  std::vector<const HistoryColumn*> wanted;
  for (const std::string& name : names) {
    const auto found = std::ranges::find_if(
        columns_, [&](const HistoryColumn& column) { return column.name + "." + column.quantity == name; });
    if (found == columns_.end()) {
      std::vector<std::string> known;
      for (const HistoryColumn& column : columns_) known.push_back(column.name + "." + column.quantity);
      throw std::invalid_argument("there is no history " + in_quotes(name) + known_names(name, known));
    }
    wanted.push_back(&*found);
    contents.beams |= found->contents.beams;
    contents.probes |= found->contents.probes;
    contents.sections |= found->contents.sections;
    contents.reactions |= found->contents.reactions;
    contents.energy |= found->contents.energy;
  }
  const Snapshot now = between_steps([&](const Simulation& simulation) {
    return to_world(of_->built().frame, simulation.present(contents));
  });
  std::vector<double> values;
  for (const HistoryColumn* column : wanted) values.push_back(column->value(now));
  return values;
}

void LiveRun::set_signal(Signal& signal, const Eigen::Vector3d& value, const Eigen::Vector3d& slope,
                         double until) {
  const Advance alone(*this);
  const Moment moment(*this);
  signal.set(time_, value, slope, until);
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
  const Advance alone(*this);
  const WithoutLock others_go_on;
  const Moment moment(*this);
  const Eigen::Vector3d local = is_moment ? frame.moment_to_local(value) : frame.direction_to_local(value);
  // A restart for nothing would change the motion by its round-off, and take its time.
  if (has_value(of_->built(), number, local, simulation_.system().model().forces)) return;
  const bool goes_on = simulation_.change_forces(
      [&](std::vector<Force>& forces) { set_load(of_->built(), number, local, forces); });
  std::erase_if(changed_loads_,
                [&](const ChangedLoad& load) { return load.number == static_cast<int>(number); });
  changed_loads_.push_back({static_cast<int>(number), local});
  if (!goes_on) ended_ = true;
}

}  // namespace nurbeam::python
