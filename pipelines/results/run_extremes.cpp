#include "pipelines/results/run_extremes.h"

#include <cmath>

#include "pipelines/results/frame_layout.h"

namespace nurbeam {

// Every frame offers the same quantities in the same order; NaN where there is no value.
void RunExtremes::keep(const RunExtreme& candidate, bool least) {
  if (next_ == list_.size()) {
    list_.push_back(candidate);
    const auto optional = [](double number) {
      return std::isnan(number) ? std::nullopt : std::optional(number);
    };
    if (const std::size_t i = 4 * next_; i + 3 < before_.size()) {
      list_.back().value = before_[i];
      list_.back().s = optional(before_[i + 1]);
      list_.back().time = before_[i + 2];
      list_.back().layer = optional(before_[i + 3]);
    }
  }
  RunExtreme& kept = list_[next_++];
  const bool more = least ? candidate.value < kept.value : std::abs(candidate.value) > std::abs(kept.value);
  if (more || std::isnan(kept.value)) kept = candidate;
}

void RunExtremes::look_at(const Snapshot& frame, const SnapshotNames& names) {
  next_ = 0;
  const auto extremes = with_own_axes(beam_extremes, own_axes_extremes, names.sections);
  for (std::size_t i = 0; i < frame.beams.size(); ++i)
    for (const BeamExtreme& of : extremes) {
      const Extreme& extreme = frame.beams[i].*of.value;
      keep(
          {names.beams.at(i) + "." + of.column, of.unit, extreme.value, extreme.s, frame.time, extreme.layer},
          of.least);
    }
  for (std::size_t i = 0; i < frame.bodies.size(); ++i) {
    const BodyRecord& body = frame.bodies[i];
    const std::string& name = names.bodies.at(i);
    const double counts = body.adrift ? std::nan("") : 1;
    keep({name + ".speed", "m/s", counts * body.point.velocity.norm(), body.s, frame.time}, false);
    keep({name + ".joint_force", "N", counts * body.joint_force.norm(), body.s, frame.time}, false);
  }
  const auto keep_felt = [&](const std::string& name, const FeltRecord& felt, double counts,
                             std::optional<double> s) {
    keep({name + ".acceleration", "m/s^2", counts * felt.acceleration.norm(), s, frame.time}, false);
    for (int k = 0; k < 3; ++k)
      keep({name + ".g_" + "xyz"[k], "1", counts * felt.load_factor[k], s, frame.time}, false);
  };
  for (std::size_t i = 0; i < frame.bodies.size(); ++i)
    if (const BodyRecord& body = frame.bodies[i]; body.felt)
      keep_felt(names.bodies.at(i), *body.felt, body.adrift ? std::nan("") : 1, body.s);
  for (std::size_t i = 0; i < frame.probes.size(); ++i)
    if (const ProbeRecord& probe = frame.probes[i]; probe.felt)
      keep_felt(names.probes.at(i), *probe.felt, 1, std::nullopt);
  for (std::size_t i = 0; i < frame.reactions.size(); ++i) {
    const ReactionRecord& reaction = frame.reactions[i];
    const std::string& name = names.reactions.at(i);
    keep({name + ".force", "N", reaction.force.norm(), std::nullopt, frame.time}, false);
    keep({name + ".couple", "N m", reaction.couple.norm(), std::nullopt, frame.time}, false);
  }
  for (std::size_t i = 0; i < frame.connectors.size(); ++i)
    keep({names.connectors.at(i) + ".force", "N", frame.connectors[i].force, std::nullopt, frame.time},
         false);
  for (std::size_t i = 0; i < frame.measures.size(); ++i) {
    const std::string quantity = parts_of_measure(names.measures.at(i)).second;
    keep({names.measures[i], unit_of_measure(quantity), frame.measures[i].value, frame.measures[i].s,
          frame.time},
         quantity == "clearance");
  }
  for (const auto& [name, energy] : {std::pair{"kinetic", frame.energy.kinetic - frame.energy.adrift},
                                     {"axial", frame.energy.axial},
                                     {"bending", frame.energy.bending}})
    keep({std::string("energy.") + name, "J", energy, std::nullopt, frame.time}, false);
}

std::vector<double> RunExtremes::numbers() const {
  std::vector<double> numbers;
  for (const RunExtreme& each : list_)
    numbers.insert(numbers.end(),
                   {each.value, each.s.value_or(std::nan("")), each.time, each.layer.value_or(std::nan(""))});
  return numbers;
}

}  // namespace nurbeam
