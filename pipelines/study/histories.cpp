#include "pipelines/study/histories.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <stdexcept>

#include "pipelines/diagnostics/closest_name.h"
#include "pipelines/diagnostics/simulation_text.h"
#include "pipelines/model/model_snapshot.h"

namespace nurbeam {

namespace {

/// The kinds of events by the words of run.json, and shorter ones.
std::optional<EventKind> event_kind(const std::string& name) {
  static const std::map<std::string, EventKind> kinds = [] {
    std::map<std::string, EventKind> all = {{"leaves", EventKind::left_beam},
                                            {"stops", EventKind::stopped_at_end},
                                            {"hits", EventKind::hits_stop},
                                            {"rests", EventKind::rests_at_stop}};
    for (const EventKind kind :
         {EventKind::split, EventKind::merge, EventKind::becomes_point, EventKind::becomes_node,
          EventKind::left_beam, EventKind::stopped_at_end, EventKind::released, EventKind::sticks,
          EventKind::slides, EventKind::hits_stop, EventKind::rests_at_stop, EventKind::leaves_stop})
      all.emplace(name_of(kind), kind);
    return all;
  }();
  const auto found = kinds.find(name);
  return found == kinds.end() ? std::nullopt : std::optional(found->second);
}

std::optional<double> value_of(const StudyFile& study, const std::vector<double>& values,
                               const std::string& name) {
  for (std::size_t i = 0; i < study.variables.size(); ++i)
    if (study.variables[i].name == name) return values[i];
  return {};
}

}  // namespace

std::string column_name(const HistoryColumn& column) { return column.name + "." + column.quantity; }

Histories::Histories(const StudyFile& study, const BuiltModel& built) : frame_(&built.frame) {
  std::vector<HistoryColumn> columns;
  std::vector<std::string> wanted;
  for (const StudyQuantity& quantity : study.quantities)
    for (const std::string& name : quantity.value.names()) wanted.push_back(name);
  for (HistoryColumn& column : history_columns(snapshot_names(built)))
    if (std::find(wanted.begin(), wanted.end(), column_name(column)) != wanted.end())
      columns.push_back(std::move(column));
  values_.resize(columns.size());
  columns_ = std::make_shared<const std::vector<HistoryColumn>>(std::move(columns));
}

Histories Histories::of_neighbour(const BuiltModel& built) const {
  Histories empty = *this;
  empty.frame_ = &built.frame;
  empty.times_.clear();
  for (std::vector<double>& column : empty.values_) column.clear();
  return empty;
}

void Histories::add(const Snapshot& local) {
  const Snapshot snapshot = to_world(*frame_, local);
  times_.push_back(snapshot.time);
  for (std::size_t i = 0; i < columns_->size(); ++i) values_[i].push_back((*columns_)[i].value(snapshot));
}

void Histories::begin_as(const Histories& other) {
  times_ = other.times_;
  values_ = other.values_;
}

void Histories::shift(std::size_t time, const Histories& from, const Histories& to, double part) {
  for (std::size_t i = 0; i < columns_->size(); ++i)
    values_[i][time] += part * (to.values_[i][time] - from.values_[i][time]);
}

void Histories::replace(std::size_t time, const Snapshot& local) {
  const Snapshot snapshot = to_world(*frame_, local);
  for (std::size_t i = 0; i < columns_->size(); ++i) values_[i][time] = (*columns_)[i].value(snapshot);
}

void Histories::replace(std::size_t time, const Histories& other) {
  for (std::size_t i = 0; i < columns_->size(); ++i) values_[i][time] = other.values_[i][time];
}

Histories Histories::moved(const Histories& other, double part) const {
  constexpr double window = 0.05;
  Histories result = *this;
  if (times_.empty()) return result;
  const double beyond = window * (times_.back() - times_.front());
  const std::size_t common = std::min(times_.size(), other.times_.size());
  for (std::size_t column = 0; column < values_.size(); ++column) {
    double largest = 0;
    std::size_t next = 0;
    for (std::size_t i = 0; i < times_.size(); ++i) {
      for (; next < common && times_[next] <= times_[i] + beyond; ++next)
        largest = std::fmax(largest, std::abs(values_[column][next] - other.values_[column][next]));
      result.values_[column][i] += part * largest;
    }
  }
  return result;
}

SnapshotContents Histories::contents() const {
  SnapshotContents all{.beams = false,
                       .probes = false,
                       .sections = false,
                       .reactions = false,
                       .energy = false,
                       .measures = false};
  for (const HistoryColumn& column : *columns_) {
    all.beams |= column.contents.beams;
    all.probes |= column.contents.probes;
    all.sections |= column.contents.sections;
    all.reactions |= column.contents.reactions;
    all.energy |= column.contents.energy;
    all.measures |= column.contents.measures;
  }
  return all;
}

std::vector<BeamPart> Histories::parts_of_beams() const {
  std::vector<BeamPart> parts;
  for (const HistoryColumn& column : *columns_)
    if (column.contents.beams) parts.push_back({static_cast<int>(column.index), column.extreme});
  return parts;
}

void Histories::nudge(std::size_t time, double part) {
  constexpr double golden = 0.6180339887498949;
  double own = 0;  // by which columns differ, so that their ratios and differences change too
  for (std::vector<double>& column : values_) {
    double largest = 0;
    for (const double value : column) largest = std::fmax(largest, std::abs(value));
    column[time] += part * (1 + own) * (largest > 0 ? largest : 1);
    own = std::fmod(own + golden, 1);
  }
}

const std::vector<double>* Histories::find(const std::string& name) const {
  for (std::size_t i = 0; i < columns_->size(); ++i)
    if (column_name((*columns_)[i]) == name) return &values_[i];
  return nullptr;
}

std::size_t first_event(const std::vector<RunEvent>& events, const BeamModel& model, const std::string& kind,
                        const std::string& of) {
  const std::optional<EventKind> wanted = event_kind(kind);
  if (!wanted)
    throw std::invalid_argument("there is no event " + in_quotes(kind) +
                                "; leaves, stops, hits, rests, sticks, slides, released, split, merge are");
  std::size_t i = 0;
  for (; i < events.size(); ++i) {
    const RunEvent& event = events[i];
    const bool body = event.body >= 0 && model.bodies[static_cast<std::size_t>(event.body)].name == of;
    const bool beam = event.beam >= 0 && model.beams[static_cast<std::size_t>(event.beam)].name == of;
    if (event.kind == *wanted && (body || beam)) break;
  }
  return i;
}

ExpressionScope scope_of_variables(const StudyFile& study, const std::vector<double>& values) {
  return {.value = [&](const std::string& name) -> ExpressionValue {
    if (const auto value = value_of(study, values, name)) return *value;
    throw std::invalid_argument("there is no variable " + in_quotes(name));
  }};
}

ExpressionScope scope_of_run(const StudyFile& study, const std::vector<double>& values,
                             const Histories& histories, const BeamModel& model,
                             const std::vector<RunEvent>& events) {
  return {.value = [&](const std::string& name) -> ExpressionValue {
            if (const auto value = value_of(study, values, name)) return *value;
            if (const auto* history = histories.find(name)) return *history;
            throw std::invalid_argument("there is no column " + in_quotes(name));
          },
          .event_time =
              [&](const std::string& kind, const std::string& of) {
                const std::size_t i = first_event(events, model, kind, of);
                return i < events.size() ? events[i].time : std::numeric_limits<double>::quiet_NaN();
              },
          .times = histories.times()};
}

}  // namespace nurbeam
