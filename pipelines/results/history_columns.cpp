#include "pipelines/results/history_columns.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "pipelines/results/frame_layout.h"

namespace nurbeam {

namespace {

constexpr const char* axes[] = {"x", "y", "z"};

// The columns of one object, one after another.
class Columns {
 public:
  explicit Columns(std::vector<HistoryColumn>& columns) : columns_(columns) {}

  void of(const std::string& kind, std::size_t index, const std::string& name) {
    contents_ = {.beams = kind == "beam",
                 .probes = kind == "probe",
                 .sections = false,
                 .reactions = kind == "reaction",
                 .energy = kind == "energy",
                 .measures = kind == "measure"};
    kind_ = kind;
    index_ = index;
    name_ = name;
  }
  void add(const std::string& quantity, const char* unit, std::function<double(const Snapshot&)> value) {
    columns_.push_back({kind_, index_, name_, quantity, unit, std::move(value), contents_});
  }
  // Of the section of a probe.
  void add_section(const SectionPart& part) {
    contents_.sections = true;
    const std::size_t i = index_;
    add(part.column, part.unit, [i, &part](const Snapshot& f) { return f.probes[i].section.*part.value; });
  }
  // Of a beam.
  void add_extreme(const BeamExtreme& extreme) {
    const std::size_t i = index_;
    add(extreme.column, extreme.unit,
        [i, &extreme](const Snapshot& f) { return (f.beams[i].*extreme.value).value; });
    columns_.back().extreme = extreme.value;
  }
  // before + "x", ...: of a vector that get(frame) gives.
  template <class Get>
  void add_vector(const std::string& before, const char* unit, Get get) {
    for (int k = 0; k < 3; ++k)
      add(
          before + axes[k], unit, [get, k](const Snapshot& frame) { return get(frame)[k]; });
  }
  template <class Get>
  void add_point(Get get) {
    add_vector(
        "", "m", [get](const Snapshot& frame) { return get(frame).position; });
    add_vector("v", "m/s", [get](const Snapshot& frame) { return get(frame).velocity; });
  }

 private:
  std::vector<HistoryColumn>& columns_;
  std::string kind_, name_;
  std::size_t index_ = 0;
  SnapshotContents contents_;
};

void add_motion(const SnapshotNames& names, Columns& columns) {
  for (std::size_t i = 0; i < names.probes.size(); ++i) {
    columns.of("probe", i, names.probes[i]);
    columns.add_point([i](const Snapshot& f) { return static_cast<PointRecord>(f.probes[i]); });
  }
  for (std::size_t i = 0; i < names.bodies.size(); ++i) {
    columns.of("body", i, names.bodies[i]);
    columns.add_point([i](const Snapshot& f) { return f.bodies[i].point; });
    columns.add("s", "m", [i](const Snapshot& f) {
      return f.bodies[i].s.value_or(std::numeric_limits<double>::quiet_NaN());
    });
  }
  for (std::size_t i = 0; i < names.beams.size(); ++i) {
    columns.of("beam", i, names.beams[i]);
    columns.add("length", "m", [i](const Snapshot& f) { return f.beams[i].length; });
  }
  columns.of("energy", 0, "energy");
  for (const EnergyPart& part : energy_parts)
    columns.add(part.name, "J", [&part](const Snapshot& f) { return f.energy.*part.value; });
}

void add_forces(const SnapshotNames& names, Columns& columns) {
  for (std::size_t i = 0; i < names.probes.size(); ++i) {
    columns.of("probe", i, names.probes[i]);
    columns.add_vector("u", "m", [i](const Snapshot& f) { return f.probes[i].displacement; });
    for (const SectionPart& part : section_parts) columns.add_section(part);
  }
  for (std::size_t i = 0; i < names.bodies.size(); ++i) {
    columns.of("body", i, names.bodies[i]);
    columns.add_vector(
        "joint_force.", "N", [i](const Snapshot& f) { return f.bodies[i].joint_force; });
    columns.add("holding_force", "N", [i](const Snapshot& f) { return f.bodies[i].holding_force; });
  }
  for (std::size_t i = 0; i < names.beams.size(); ++i) {
    columns.of("beam", i, names.beams[i]);
    for (const BeamExtreme& extreme : beam_extremes) columns.add_extreme(extreme);
  }
  for (std::size_t i = 0; i < names.reactions.size(); ++i) {
    columns.of("reaction", i, names.reactions[i]);
    columns.add_vector(
        "f", "N", [i](const Snapshot& f) { return f.reactions[i].force; });
    columns.add_vector("m", "N m", [i](const Snapshot& f) { return f.reactions[i].couple; });
  }
}

void add_own_axes(const SnapshotNames& names, Columns& columns) {
  for (std::size_t i = 0; i < names.probes.size(); ++i) {
    columns.of("probe", i, names.probes[i]);
    for (const SectionPart& part : own_axes_parts) columns.add_section(part);
  }
  for (std::size_t i = 0; i < names.beams.size(); ++i) {
    columns.of("beam", i, names.beams[i]);
    for (const BeamExtreme& extreme : own_axes_extremes) columns.add_extreme(extreme);
  }
}

void add_connectors(const SnapshotNames& names, Columns& columns) {
  for (std::size_t i = 0; i < names.connectors.size(); ++i) {
    columns.of("connector", i, names.connectors[i]);
    for (const ConnectorPart& part : connector_parts)
      columns.add(part.name, part.unit,
                  [i, &part](const Snapshot& f) { return f.connectors[i].*part.value; });
  }
}

void add_spring(const SnapshotNames& names, Columns& columns) {
  if (!names.springs) return;
  columns.of("energy", 0, "energy");
  columns.add("spring", "J", [](const Snapshot& f) { return f.energy.spring; });
}

void add_friction(const SnapshotNames& names, Columns& columns) {
  for (std::size_t i = 0; i < names.bodies.size(); ++i) {
    columns.of("body", i, names.bodies[i]);
    for (const BodyPart& part : known_body_parts(names))
      columns.add(part.name, part.unit, [i, &part](const Snapshot& f) { return f.bodies[i].*part.value; });
  }
}

// Angles about z, then about the turned y, then about the twice turned x: yaw, pitch, roll.
Eigen::Vector3d roll_pitch_yaw(const Eigen::Vector4d& q) {
  const double w = q[0], x = q[1], y = q[2], z = q[3];
  return {std::atan2(2 * (w * x + y * z), 1 - 2 * (x * x + y * y)),
          std::asin(std::clamp(2 * (w * y - z * x), -1.0, 1.0)),
          std::atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z))};
}

const TurnRecord& turn_of(const BodyRecord& body) {
  constexpr double none = SectionRecord::no_number;
  static const TurnRecord no_turn{Eigen::Vector4d::Constant(none), Eigen::Vector3d::Constant(none)};
  return body.turn ? *body.turn : no_turn;
}
const FeltRecord& felt_of(const std::optional<FeltRecord>& felt) {
  constexpr double none = SectionRecord::no_number;
  static const FeltRecord nothing{Eigen::Vector3d::Constant(none), Eigen::Vector3d::Constant(none)};
  return felt ? *felt : nothing;
}

void add_turns(const SnapshotNames& names, Columns& columns) {
  for (std::size_t i = 0; i < names.felt.size(); ++i) {
    columns.of("body", i, names.bodies[i]);
    if (i < names.rigid.size() && names.rigid[i]) {
      for (int k = 0; k < 4; ++k)
        columns.add(std::string("q") + "wxyz"[k], "1",
                    [i, k](const Snapshot& f) { return turn_of(f.bodies[i]).attitude[k]; });
      for (int k = 0; k < 3; ++k)
        columns.add(
            std::array{"roll", "pitch", "yaw"}[k], "rad",
            [i, k](const Snapshot& f) { return roll_pitch_yaw(turn_of(f.bodies[i]).attitude)[k]; });
      columns.add_vector("w", "rad/s", [i](const Snapshot& f) { return turn_of(f.bodies[i]).spin; });
    }
    if (!names.felt[i]) continue;
    columns.add_vector(
        "a", "m/s^2", [i](const Snapshot& f) { return felt_of(f.bodies[i].felt).acceleration; });
    columns.add_vector("g_", "1", [i](const Snapshot& f) { return felt_of(f.bodies[i].felt).load_factor; });
  }
}

void add_felt_at_probes(const SnapshotNames& names, Columns& columns) {
  if (!names.felt_at_probes) return;
  for (std::size_t i = 0; i < names.probes.size(); ++i) {
    columns.of("probe", i, names.probes[i]);
    columns.add_vector(
        "a", "m/s^2", [i](const Snapshot& f) { return felt_of(f.probes[i].felt).acceleration; });
    columns.add_vector("g_", "1", [i](const Snapshot& f) { return felt_of(f.probes[i].felt).load_factor; });
  }
}

void add_derived(const SnapshotNames& names, Columns& columns) {
  for (std::size_t i = 0; i < names.probes.size(); ++i) {
    columns.of("probe", i, names.probes[i]);
    columns.add("speed", "m/s", [i](const Snapshot& f) { return f.probes[i].velocity.norm(); });
  }
  for (std::size_t i = 0; i < names.bodies.size(); ++i) {
    columns.of("body", i, names.bodies[i]);
    columns.add("speed", "m/s", [i](const Snapshot& f) { return f.bodies[i].point.velocity.norm(); });
  }
  for (std::size_t i = 0; i < names.beams.size(); ++i) {
    columns.of("beam", i, names.beams[i]);
    columns.add("sag", "m", [i](const Snapshot& f) { return f.beams[i].sag; });
  }
}

void add_measures(const SnapshotNames& names, Columns& columns) {
  for (std::size_t i = 0; i < names.measures.size(); ++i) {
    const auto& [name, quantity] = parts_of_measure(names.measures[i]);
    columns.of("measure", i, name);
    columns.add(quantity, unit_of_measure(quantity), [i](const Snapshot& f) { return f.measures[i].value; });
  }
}

std::size_t index_of(const std::vector<std::string>& names, const std::string& name) {
  return static_cast<std::size_t>(std::ranges::find(names, name) - names.begin());
}

// Numbers of NAME.KIND_1, NAME.KIND_2, ...
std::vector<std::size_t> numbered(const std::vector<std::string>& names, const std::string& before) {
  std::vector<std::size_t> found;
  for (;;) {
    const std::size_t i = index_of(names, before + std::to_string(found.size() + 1));
    if (i == names.size()) return found;
    found.push_back(i);
  }
}

// A collector NAME is made of connectors and bodies: NAME.contact, NAME.spring_1, ..., NAME.mass_1, ...
void add_collectors(const SnapshotNames& names, Columns& columns) {
  const std::string ending = ".contact";
  for (std::size_t contact = 0; contact < names.connectors.size(); ++contact) {
    const std::string& connector = names.connectors[contact];
    if (!connector.ends_with(ending)) continue;
    const std::string name = connector.substr(0, connector.size() - ending.size());
    const std::vector<std::size_t> springs = numbered(names.connectors, name + ".spring_"),
                                   masses = numbered(names.bodies, name + ".mass_");
    if (springs.empty() || masses.size() != springs.size()) continue;
    columns.of("collector", contact, name);
    columns.add("force", "N",
                [contact](const Snapshot& f) { return std::max(0.0, -f.connectors[contact].force); });
    columns.add("height", "m", [springs](const Snapshot& f) {
      double height = 0;
      for (const std::size_t spring : springs) height += f.connectors[spring].length;
      return height;
    });
  }
}

}  // namespace

std::vector<HistoryColumn> history_columns(const SnapshotNames& names) {
  std::vector<HistoryColumn> all;
  Columns columns(all);
  add_motion(names, columns);
  add_forces(names, columns);
  if (names.sections) add_own_axes(names, columns);
  add_derived(names, columns);
  add_spring(names, columns);
  add_friction(names, columns);
  add_connectors(names, columns);
  add_measures(names, columns);
  add_collectors(names, columns);
  add_turns(names, columns);
  add_felt_at_probes(names, columns);
  return all;
}

}  // namespace nurbeam
