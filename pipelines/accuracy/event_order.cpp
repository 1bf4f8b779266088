#include "pipelines/accuracy/event_order.h"

#include <algorithm>
#include <map>

#include "pipelines/diagnostics/simulation_text.h"

namespace nurbeam {

std::size_t common_events(const LevelNumbers& one, const LevelNumbers& other) {
  const std::size_t most = std::min(one.events.size(), other.events.size());
  for (std::size_t i = 0; i < most; ++i) {
    const RunEvent &a = one.events[i], &b = other.events[i];
    if (a.kind != b.kind || a.body != b.body || a.beam != b.beam) return i;
  }
  return most;
}

std::optional<double> time_of_other_events(const LevelNumbers& one, const LevelNumbers& other) {
  const std::size_t common = common_events(one, other);
  std::optional<double> first;
  for (const LevelNumbers* run : {&one, &other})
    if (common < run->events.size())
      first = std::min(first.value_or(run->events[common].time), run->events[common].time);
  return first;
}

std::vector<std::string> names_of_events(const std::vector<RunEvent>& events,
                                         const std::vector<std::string>& bodies) {
  std::vector<std::string> names;
  std::map<std::string, int> count;
  for (const RunEvent& event : events) {
    std::string name =
        event.body < 0 ? name_of(event.kind) : bodies.at(event.body) + " " + name_of(event.kind);
    const int number = ++count[name];
    names.push_back(number == 1 ? name : name + " (" + std::to_string(number) + ")");
  }
  return names;
}

}  // namespace nurbeam
