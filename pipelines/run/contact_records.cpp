#include "pipelines/run/contact_records.h"

#include <algorithm>
#include <cmath>

#include "nurbs/number_text.h"
#include "pipelines/diagnostics/closest_name.h"
#include "pipelines/model/model_snapshot.h"

namespace nurbeam {

namespace {

std::size_t column_of(const std::vector<HistoryColumn>& columns, const std::string& name,
                      const std::string& quantity) {
  const auto found = std::ranges::find_if(columns, [&](const HistoryColumn& column) {
    return column.name == name && column.quantity == quantity;
  });
  return static_cast<std::size_t>(found - columns.begin());
}

}  // namespace

ContactRecords::ContactRecords(const BuiltModel& built) {
  if (built.collectors.empty()) return;
  columns_ = history_columns(snapshot_names(built));
  for (const Collector& collector : built.collectors) {
    Of of{.collector = collector,
          .place = {},
          .force = column_of(columns_, collector.name, "force"),
          .series = {},
          .uplift = {}};
    const std::string head = built.model.bodies[collector.head].name;
    for (const char* quantity : {"x", "y", "z"}) of.place.push_back(column_of(columns_, head, quantity));
    for (const std::string& probe : collector.uplift) {
      Lifted lifted;
      lifted.found.probe = probe;
      for (const char* quantity : {"ux", "uy", "uz"})
        lifted.columns.push_back(column_of(columns_, probe, quantity));
      of.uplift.push_back(std::move(lifted));
    }
    of_.push_back(std::move(of));
  }
}

template <class Value>
void ContactRecords::add(double time, Value value) {
  for (Of& of : of_) {
    if (!of.series.empty() && time <= of.series.back().time) continue;
    const bool is_first = of.series.empty();
    const auto vector = [&](const std::vector<std::size_t>& columns) {
      return Eigen::Vector3d(value(columns[0]), value(columns[1]), value(columns[2]));
    };
    of.series.push_back({time, of.collector.travel.dot(vector(of.place)), value(of.force)});
    for (Lifted& lifted : of.uplift) {
      const Eigen::Vector3d now = vector(lifted.columns);
      if (is_first) lifted.first = now;
      const double up = of.collector.up.dot(now - lifted.first);
      if (up > lifted.found.value) lifted.found = {lifted.found.probe, up, time};
    }
  }
}

void ContactRecords::look_at(const Snapshot& moment) {
  add(
      moment.time, [&](std::size_t column) { return columns_[column].value(moment); });
}

void ContactRecords::take_over(const StoredHistories& rows) {
  for (std::size_t i = 0; i < rows.times.size(); ++i)
    add(
        rows.times[i], [&](std::size_t column) { return rows.values[i * rows.headings.size() + column]; });
}

std::vector<CollectorOutcome> ContactRecords::outcomes() const {
  std::vector<CollectorOutcome> outcomes;
  for (const Of& of : of_) {
    const Collector& collector = of.collector;
    CollectorOutcome& outcome = outcomes.emplace_back(CollectorOutcome{
        .name = collector.name, .from = collector.from, .to = collector.to, .contact = {}, .uplift = {}});
    outcome.contact = contact_statistics(
        of.series,
        {.from = collector.from, .to = collector.to, .filter = collector.filter, .bands = collector.bands});
    for (const Lifted& lifted : of.uplift) outcome.uplift.push_back(lifted.found);
  }
  return outcomes;
}

std::vector<Diagnostic> contact_warnings(const std::filesystem::path& file,
                                         const std::vector<CollectorOutcome>& outcomes) {
  std::vector<Diagnostic> warnings;
  for (const CollectorOutcome& outcome : outcomes) {
    const std::string where = file.string() + ": collector " + in_quotes(outcome.name);
    const ContactStatistics& found = outcome.contact;
    if (!std::isfinite(outcome.from)) continue;
    if (found.samples == 0)
      warnings.push_back({Severity::warning, where,
                          "has not been between " + text_of(outcome.from) + " and " + text_of(outcome.to) +
                              " m, its \"evaluate\": there are no statistics"});
    else if (const double missing = std::max(found.missing_before, found.missing_after); missing > 0)
      warnings.push_back(
          {Severity::warning, where,
           (found.missing_before > 0 ? "starts " : "ends ") + text_of(missing, 3) +
               " s too near to its \"evaluate\" for the filters, which need the period of their "
               "lowest frequency before and after it: begin earlier, end later, or take a smaller "
               "window"});
  }
  return warnings;
}

}  // namespace nurbeam
