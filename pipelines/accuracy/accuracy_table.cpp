#include "pipelines/accuracy/accuracy_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string_view>

#include "nurbs/number_text.h"
#include "pipelines/accuracy/event_order.h"
#include "pipelines/diagnostics/simulation_text.h"

namespace nurbeam {

namespace {

constexpr double most_of_scale = 0.25;    // above which an error is no bound
constexpr double most_of_forces = 0.125;  // likewise in motion: waves that no step resolves overshoot alike
constexpr double least_of_scale = 0.01;   // below which it does not matter that it does not shrink
constexpr double least_ratio = 1.5;       // of the steps of two runs
constexpr int digits = 3;

constexpr std::array<std::string_view, 8> usual_of_points = {"",      "u", "v", "s",
                                                             "speed", "f", "m", "displacement.max"};
constexpr std::array<std::string_view, 2> usual_of_beams = {"axial_force.max", "moment.max"};

bool is_usual(const HistoryQuantity& of) {
  const auto is_in = [&](const auto& list) { return std::ranges::find(list, of.quantity) != list.end(); };
  if (of.of == "connector") return of.quantity == "force";
  return of.of != "energy" && (is_in(usual_of_points) || (of.of == "beam" && is_in(usual_of_beams)));
}

std::string column_name(const HistoryColumn& column) { return column.name + "." + column.quantity; }

bool is_force(const std::string& unit) { return unit == "N" || unit == "N m" || unit == "Pa"; }
bool bends(const std::string& unit) { return unit == "N m" || unit == "Pa"; }

double largest_in(const std::vector<double>& values) {
  double largest = 0;
  for (const double value : values) largest = std::max(largest, std::abs(value));
  return largest;
}

// The frame in which a column is greatest or least; nothing where it has no values.
std::optional<std::size_t> frame_of_peak(const LevelNumbers& run, std::size_t column, bool greatest) {
  std::optional<std::size_t> found;
  for (std::size_t i = 0; i < run.rows.size(); ++i) {
    const double value = run.rows[i][column];
    if (std::isnan(value)) continue;
    const double kept = found ? run.rows[*found][column] : value;
    if (!found || (greatest ? value > kept : value < kept)) found = i;
  }
  return found;
}

// Names of extremes that are not those of columns.
std::vector<std::string> names_of_extremes(const std::vector<HistoryQuantity>& quantities) {
  std::vector<std::string> names;
  for (const HistoryQuantity& of : quantities)
    for (const auto& [quantity, ending] :
         {std::pair{"joint_force.", ".joint_force"}, {"f", ".force"}, {"m", ".couple"}})
      if (of.quantity == quantity) names.push_back(of.name + ending);
  return names;
}

bool is_event(const std::string& name, const std::vector<std::string>& bodies) {
  const std::string plain = name.ends_with(")") ? name.substr(0, name.rfind(" (")) : name;
  for (int kind = 0; kind <= static_cast<int>(EventKind::leaves_stop); ++kind)
    for (const std::string& body : bodies)
      if (is_booked(static_cast<EventKind>(kind)) &&
          plain == body + " " + name_of(static_cast<EventKind>(kind)))
        return true;
  return false;
}

}  // namespace

std::vector<std::string> names_of_numbers(const AccuracyQuestion& question, bool modes) {
  std::vector<std::string> names;
  if (modes) return {"mode 1", "mode 2"};
  for (const HistoryColumn& column : question.columns) names.push_back(column_name(column));
  for (std::string& name : names_of_extremes(question.model.quantities)) names.push_back(std::move(name));
  return names;
}

std::vector<std::string> unknown_numbers(const AccuracyQuestion& question, bool modes) {
  const std::vector<std::string> names = names_of_numbers(question, modes);
  std::vector<std::string> unknown;
  for (const std::string& asked : question.of) {
    const bool is_peak =
        asked.size() > 5 && asked.ends_with(")") && (asked.starts_with("max(") || asked.starts_with("min("));
    const std::string name = is_peak ? asked.substr(4, asked.size() - 5) : asked;
    const bool is_known =
        modes ? asked.starts_with("mode ")
              : std::ranges::find(names, name) != names.end() || is_event(asked, question.bodies);
    if (!is_known) unknown.push_back(asked);
  }
  return unknown;
}

AccuracyTable::AccuracyTable(const AccuracyQuestion& question, const RunsOfErrors& runs,
                             const LevelNumbers& own)
    : question_(question),
      bars_(question.model, runs, own),
      own_(own),
      shown_(runs.fine->level > 0 && question.target ? *runs.fine : own),
      refined_(&shown_ != &own),
      quantity_of_column_(question.columns.size()),
      events_differ_(time_of_other_events(*runs.fine, *runs.coarse)) {
  const std::vector<HistoryQuantity>& quantities = question.model.quantities;
  for (std::size_t q = 0; q < quantities.size(); ++q)
    for (const std::size_t i : quantities[q].columns) quantity_of_column_[i] = q;
  accuracy_.moves = question.model.moves;
  accuracy_.target = question.target;
  for (const LevelNumbers* run : {runs.fine, runs.coarse, runs.coarser})
    if (run) accuracy_.runs.push_back({run->level, run->elements, run->steps, run->step, run->seconds});
  if (question.model.moves) find_parting();
  if (own.modes.empty()) {
    add_ends();
    add_extremes();
    add_asked_peaks();
    add_events();
  } else {
    add_modes();
  }
}

double AccuracyTable::own_error(std::size_t column, double time) const {
  return bars_.own(quantity_of_column_[column], time);
}

std::vector<double> AccuracyTable::values_of(const std::function<double(const LevelNumbers&)>& value) const {
  std::vector<double> values;
  for (const LevelNumbers* run : {bars_.runs().fine, bars_.runs().coarse, bars_.runs().coarser})
    if (run) values.push_back(value(*run));
  return values;
}

void AccuracyTable::add_ends() {
  if (shown_.rows.empty()) return;
  for (std::size_t i = 0; i < question_.columns.size(); ++i) {
    const std::size_t q = quantity_of_column_[i];
    const double value = shown_.rows.back()[i], time = shown_.times.back();
    if (std::isnan(value)) continue;
    const double error = refined_ ? bars_.fine(q, time) : bars_.own(q, time), scale = bars_.scale(q);
    const std::string name = column_name(question_.columns[i]);
    add({.quantity = name,
         .unit = question_.columns[i].unit,
         .value = value,
         .error = error,
         .time = time,
         .not_converged = doubt(q, time, scale > 0 ? error / scale : 0),
         .is_asked = is_asked(name, is_usual(question_.model.quantities[q])),
         .is_end = true},
        scale, !bars_.does_not_shrink(q));
  }
}

void AccuracyTable::add_extremes() {
  for (std::size_t i = 0; i < own_.extremes.size(); ++i) {
    const RunExtreme& own = own_.extremes[i];
    const RunExtreme& shown = i < shown_.extremes.size() ? shown_.extremes[i] : own;
    const std::vector<double> values = values_of([&](const LevelNumbers& run) {
      return i < run.extremes.size() ? std::abs(run.extremes[i].value) : std::nan("");
    });
    const auto q = quantity_of_extreme(question_.model.quantities, own.quantity);
    const bool jumps = q && question_.model.has_jumps[*q], is_nought = largest_in(values) == 0;
    const double noise = is_nought ? 0 : q ? bars_.noise(*q) : bars_.noise(own.unit);
    const auto larger = [&](double of_history, double of_values) {
      return std::isnan(of_values) ? of_history : std::max(of_history, of_values + noise);
    };
    const double fine = larger(q ? bars_.fine(*q, shown.time) : 0, bars_.fine_of(values, jumps)),
                 of_own = larger(q ? bars_.own(*q, own.time) : 0,
                                 bars_.own_of(std::abs(own.value), values, jumps));
    accuracy_.extremes.push_back(of_own);
    const bool is_column = !question_.model.moves && shown_.rows.size() == 1 && q &&
                           question_.model.quantities[*q].columns.size() == 1;
    if (std::isnan(shown.value) || is_column) continue;  // of one state the histories say it already
    const double error = refined_ ? fine : of_own, scale = q ? bars_.scale(*q) : std::abs(shown.value);
    const bool usual = q && is_usual(question_.model.quantities[*q]);
    add({.quantity = own.quantity,
         .unit = own.unit,
         .value = shown.value,
         .error = error,
         .s = shown.s,
         .time = shown.time,
         .not_converged = q ? doubt(*q, shown.time, scale > 0 ? error / scale : 0) : why_all(shown.time),
         .is_asked = is_asked(own.quantity, usual) || is_asked("max(" + own.quantity + ")", false)},
        scale, !q || !bars_.does_not_shrink(*q));
  }
}

// What is asked for by name and is no extreme of runs.
void AccuracyTable::add_asked_peaks() {
  for (std::size_t i = 0; i < question_.columns.size(); ++i)
    for (const bool greatest : {true, false}) {
      const std::string column = column_name(question_.columns[i]),
                        name = (greatest ? "max(" : "min(") + column + ")";
      const bool is_extreme = greatest && std::ranges::any_of(own_.extremes, [&](const RunExtreme& each) {
                                return each.quantity == column;
                              });
      if (is_extreme || std::ranges::find(question_.of, name) == question_.of.end()) continue;
      const auto frame = frame_of_peak(shown_, i, greatest);
      if (!frame) continue;
      const std::size_t q = quantity_of_column_[i];
      const double time = shown_.times[*frame], scale = bars_.scale(q);
      const auto value_in = [&](const LevelNumbers& run) {
        const auto at = frame_of_peak(run, i, greatest);
        return at ? run.rows[*at][i] : std::nan("");
      };
      const std::vector<double> values = values_of(value_in);
      const bool jumps = question_.model.has_jumps[q];
      const double value = shown_.rows[*frame][i],
                   error = refined_ ? std::max(bars_.fine(q, time), bars_.fine_of(values, jumps))
                                    : std::max(bars_.own(q, time), bars_.own_of(value, values, jumps));
      add({.quantity = name,
           .unit = question_.columns[i].unit,
           .value = value,
           .error = error,
           .time = time,
           .not_converged = doubt(q, time, scale > 0 ? error / scale : 0),
           .is_asked = true},
          scale, !bars_.does_not_shrink(q));
    }
}

void AccuracyTable::add_events() {
  constexpr double of_time = 2, noise = 1e-7;
  const LevelNumbers &fine = *bars_.runs().fine, &coarse = *bars_.runs().coarse;
  const std::size_t common = common_events(fine, coarse), with_own = common_events(fine, own_);
  const double least = noise * fine.end;
  const auto fine_error = [&](std::size_t i) {
    return of_time * std::abs(fine.events[i].time - coarse.events[i].time) + least;
  };
  const auto own_error = [&](std::size_t i) {
    const bool is_pair = bars_.is_own() || coarse.level == 0;
    return is_pair ? fine_error(i) : fine_error(i) + std::abs(fine.events[i].time - own_.events[i].time);
  };
  const auto infinite = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < own_.events.size(); ++i)
    accuracy_.events.push_back(i < std::min(common, with_own) ? own_error(i) : infinite);
  const std::vector<std::string> names = names_of_events(shown_.events, question_.bodies);
  for (std::size_t i = 0; i < shown_.events.size(); ++i) {
    const bool is_common = i < common && (refined_ || i < with_own);
    const double time = shown_.events[i].time;
    add({.quantity = names[i],
         .unit = "s",
         .value = time,
         .error = is_common ? (refined_ ? fine_error(i) : own_error(i)) : infinite,
         .s = shown_.events[i].s,
         .time = time,
         .not_converged = is_common ? "" : why_all(time),
         .is_asked = is_asked(names[i], false)},
        shown_.end, true);
  }
}

// Errors grow from mode to mode: each has at least that of those below it.
void AccuracyTable::add_modes() {
  const bool jumps = std::ranges::find(question_.model.has_jumps, true) != question_.model.has_jumps.end();
  const std::string unit = question_.buckling ? "1" : "Hz";
  const double noise = 1e-7 * largest_in(bars_.runs().fine->modes);
  double first = 0, second = 0, from_own = 0;
  for (std::size_t i = 0; i < own_.modes.size(); ++i) {
    const std::vector<double> values = values_of(
        [&](const LevelNumbers& run) { return i < run.modes.size() ? run.modes[i] : std::nan(""); });
    if (values.size() < 2 || std::ranges::any_of(values, [](double value) { return std::isnan(value); })) {
      accuracy_.modes.push_back(std::numeric_limits<double>::infinity());
      continue;
    }
    first = std::max(first, std::abs(values[0] - values[1]));
    if (values.size() > 2) second = std::max(second, std::abs(values[1] - values[2]));
    from_own = std::max(from_own, std::abs(values[0] - own_.modes[i]));
    const bool is_nought = largest_in(values) == 0;
    const double fine =
        is_nought ? 0
                  : noise + bounded_order_error(
                                first, values.size() > 2 ? std::optional(second) : std::nullopt, jumps);
    accuracy_.modes.push_back(fine + from_own);
    const double value = shown_.modes[i], error = refined_ ? fine : fine + from_own;
    const double relative = value != 0 ? error / std::abs(value) : 0;
    const bool is_large = relative > most_of_scale,
               shrinks = !(values.size() > 2 && first > 0.71 * second && relative > least_of_scale);
    add({.quantity = "mode " + std::to_string(i + 1),
         .unit = unit,
         .value = value,
         .error = error,
         .not_converged = is_large   ? "more elements have another mode of this number"
                          : !shrinks ? "does not shrink: more elements have another mode of this number"
                                     : "",
         .is_asked = is_asked("mode " + std::to_string(i + 1), true)},
        std::abs(value), shrinks);
  }
}

void AccuracyTable::add(NumberWithError number, double scale, bool shrinks) {
  number.relative = scale > 0 ? number.error / scale : 0;
  const double target = question_.target.value_or(least_of_scale);
  if (number.is_asked) {
    worst_ = std::max(worst_, number.relative);
    const bool misses = number.relative > target || !number.not_converged.empty();
    if (misses && shrinks) is_stuck_ = false;
    if (question_.target && misses) accuracy_.reached = false;
  }
  accuracy_.numbers.push_back(std::move(number));
}

bool AccuracyTable::is_asked(const std::string& name, bool usual) const {
  return question_.of.empty() ? usual : std::ranges::find(question_.of, name) != question_.of.end();
}

// Why nothing at that time is converged; empty where nothing is known against it.
std::string AccuracyTable::why_all(double time) const {
  const auto& [fine, coarse, coarser] = bars_.runs();
  for (const LevelNumbers* run : {fine, coarse, coarser})
    if (run && !run->done && (!question_.model.moves || time > run->end))
      return "a run with other elements ended before";
  if (events_differ_ && time >= *events_differ_)
    return "from t = " + text_of(*events_differ_, digits) + " s on the runs have other events";
  const bool fewer = static_cast<double>(fine->steps) < least_ratio * static_cast<double>(coarse->steps);
  if (question_.model.moves && fewer) return "the runs differ in elements, hardly in steps";
  return {};
}

std::string AccuracyTable::doubt(std::size_t quantity, double time, double relative) const {
  const HistoryQuantity& of = question_.model.quantities[quantity];
  if (bars_.is_nought(quantity)) return {};
  const auto& probes = question_.probes_at_jumps;
  if (of.of == "probe" && is_force(of.unit) && std::ranges::find(probes, of.name) != probes.end())
    return "it jumps at the force there: put probes beside it, left and right";
  if (std::string why = why_all(time); !why.empty()) return why;
  const bool is_force_in_motion = question_.model.moves && is_force(of.unit);
  if (relative > (is_force_in_motion ? most_of_forces : most_of_scale)) return why_large(quantity, time);
  const double least = question_.target.value_or(least_of_scale);
  if (bars_.does_not_shrink(quantity) && relative > least)
    return "does not shrink: " + why_large(quantity, time);
  return {};
}

std::string AccuracyTable::why_large(std::size_t quantity, double time) const {
  const HistoryQuantity& of = question_.model.quantities[quantity];
  if (accuracy_.parted && time >= *accuracy_.parted)
    return "the runs part from t = " + text_of(*accuracy_.parted, digits) +
           " s on; averages may still be right";
  if (bends(of.unit))
    for (const auto& [beam, reach] : question_.short_bends)
      if (of.name == beam || of.of != "beam")
        return "it bends within " + text_of(reach, 2) + " m, less than an element";
  if (!question_.model.moves)
    return is_position(of) ? "with half the elements another equilibrium is found"
                           : "the elements are too coarse for it";
  if (is_force(of.unit)) return "forces of waves; damping, or a load over a few milliseconds";
  return "elements and steps are too coarse for it";
}

// When positions first are uncertain by a quarter of their size.
void AccuracyTable::find_parting() {
  for (const double time : shown_.times)
    for (std::size_t q = 0; q < question_.model.quantities.size(); ++q) {
      const HistoryQuantity& of = question_.model.quantities[q];
      if (!is_position(of) || bars_.is_nought(q)) continue;
      const double error = refined_ ? bars_.fine(q, time) : bars_.own(q, time);
      if (error > most_of_scale * bars_.scale(q)) {
        accuracy_.parted = time;
        return;
      }
    }
}

}  // namespace nurbeam
