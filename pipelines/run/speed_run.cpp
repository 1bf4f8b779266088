#include "pipelines/run/speed_run.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <utility>

#include "fem/motion/rest/modes.h"
#include "nurbs/number_text.h"
#include "pipelines/run/mode_run.h"

namespace nurbeam {

namespace {

// Frequencies by whirl and number.
using Found = std::map<std::pair<int, int>, double>;

struct Stopped {
  std::optional<Failure> failure;
};

class SpeedRun {
 public:
  SpeedRun(const CaseFile& c, const BuiltModel& built, const std::function<bool()>& interrupted)
      : case_(c), built_(built), interrupted_(interrupted) {
    for (const CaseBody& body : c.bodies)
      if (body.rotor.inertia > 0) has_rotors_ = true;
  }

  bool has_rotors() const { return has_rotors_; }

  /// The modes at a speed. Throws Stopped.
  std::vector<Mode> at(double speed) const {
    ModesReport found = find_modes(std::make_shared<const BeamModel>(turned_at(speed)),
                                   modes_options(case_.analysis), interrupted_);
    if (found.rest.failure || found.rest.interrupted) throw Stopped{found.rest.failure};
    return std::move(found.modes);
  }

  static Found by_whirl(const std::vector<Mode>& modes) {
    std::map<int, int> count;
    Found found;
    for (const Mode& mode : modes) found[{mode.whirl, ++count[mode.whirl]}] = mode.omega;
    return found;
  }

 private:
  BeamModel turned_at(double speed) const {
    BeamModel model = built_.model;
    if (!has_rotors_) {
      model.field->rate *= speed / model.field->rate.norm();
      return model;
    }
    double first = 0;
    for (const CaseBody& from : case_.bodies) {
      if (from.rotor.inertia <= 0) continue;
      if (first == 0) first = from.rotor.speed;
      const double ratio = first == 0 ? 1 : from.rotor.speed / first;
      const auto body = std::ranges::find(model.bodies, from.name, &Body::name);
      body->rigid->rotor =
          from.rotor.inertia * ratio * speed * built_.frame.direction_to_local(from.rotor.axis).normalized();
    }
    return model;
  }

  const CaseFile& case_;
  const BuiltModel& built_;
  const std::function<bool()>& interrupted_;
  bool has_rotors_ = false;
};

// At speed 0 nothing whirls: modes are those of the next speed, in their order.
Found named_as(const Found& next, const std::vector<Mode>& next_modes, const std::vector<Mode>& still) {
  std::map<int, int> count;
  Found found;
  for (std::size_t i = 0; i < std::min(still.size(), next_modes.size()); ++i)
    found[{next_modes[i].whirl, ++count[next_modes[i].whirl]}] = still[i].omega;
  for (auto entry = found.begin(); entry != found.end();)
    entry = next.contains(entry->first) ? std::next(entry) : found.erase(entry);
  return found;
}

// Where a line meets the speed between two speeds at which it is above and below it: by the secant, held in
// brackets (Illinois). Nothing where the line jumps over it, as where its modes get another whirl.
std::optional<double> meeting(const SpeedRun& run, const std::pair<int, int>& line,
                              std::array<double, 2> speed, std::array<double, 2> excess) {
  constexpr int most = 60;
  constexpr double close = 1e-10;
  int kept_before = -1;
  for (int i = 0; i < most; ++i) {
    const double guess = (speed[0] * excess[1] - speed[1] * excess[0]) / (excess[1] - excess[0]);
    const Found found = SpeedRun::by_whirl(run.at(guess));
    const auto there = found.find(line);
    if (there == found.end()) return std::nullopt;
    const double value = there->second - guess;
    if (std::abs(value) < close * guess) return guess;
    const int kept = (value > 0) == (excess[0] > 0) ? 1 : 0;
    speed[1 - kept] = guess;
    excess[1 - kept] = value;
    if (kept == kept_before) excess[kept] /= 2;
    kept_before = kept;
  }
  return std::nullopt;
}

void add_critical(const SpeedRun& run, SpeedTable& table, Findings& findings) {
  constexpr int digits = 7;
  for (const SpeedLine& line : table.lines)
    for (std::size_t i = 0; i + 1 < table.speeds.size(); ++i) {
      const double from = line.omega[i] - table.speeds[i], to = line.omega[i + 1] - table.speeds[i + 1];
      if (!(from * to < 0)) continue;  // nor where one is not a number
      const std::array<double, 2> ends{table.speeds[i], table.speeds[i + 1]};
      if (const auto speed = meeting(run, {line.whirl, line.number}, ends, {from, to}))
        table.critical.push_back({*speed, line.name()});
      else
        findings.warn("analysis.modes.speeds", "line " + line.name() + " jumps over the speed between " +
                                                   text_of(ends[0], digits) + " and " +
                                                   text_of(ends[1], digits) +
                                                   " rad/s, so that no critical speed is told there; give "
                                                   "speeds between them, or a larger \"count\"");
    }
  std::ranges::sort(table.critical, {}, &CriticalSpeed::speed);
}

SpeedTable table_of(const SpeedRun& run, const std::vector<double>& speeds) {
  std::vector<std::vector<Mode>> modes;
  std::vector<Found> found;
  for (const double speed : speeds) {
    modes.push_back(run.at(speed));
    found.push_back(SpeedRun::by_whirl(modes.back()));
  }
  if (speeds.size() > 1 && speeds.front() == 0) found[0] = named_as(found[1], modes[1], modes[0]);
  Found names;
  for (const Found& each : found) names.insert(each.begin(), each.end());
  SpeedTable table{.speeds = speeds, .lines = {}};
  for (const auto& [key, first] : names) {
    SpeedLine line{.whirl = key.first, .number = key.second, .omega = {}};
    for (const Found& each : found)
      line.omega.push_back(each.contains(key) ? each.at(key) : std::numeric_limits<double>::quiet_NaN());
    table.lines.push_back(std::move(line));
  }
  return table;
}

}  // namespace

std::optional<SpeedTable> modes_over_speed(const CaseFile& c, const BuiltModel& built,
                                           const std::function<bool()>& interrupted, SimulationReport& report,
                                           Findings& findings) {
  const SpeedRun run(c, built, interrupted);
  try {
    SpeedTable table = table_of(run, c.analysis.modes.speeds);
    if (run.has_rotors()) add_critical(run, table, findings);
    return table;
  } catch (const Stopped& stopped) {
    if (stopped.failure)
      report.fail(*stopped.failure);
    else
      report.status = SimulationStatus::interrupted;
    return std::nullopt;
  }
}

}  // namespace nurbeam
