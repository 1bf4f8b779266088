#include "pipelines/results/frame_reader.h"

#include <algorithm>
#include <stdexcept>

#include "pipelines/results/checksum.h"
#include "pipelines/results/file_error.h"
#include "pipelines/results/frame_layout.h"

namespace nurbeam {

namespace {

NetcdfFile opened(const std::filesystem::path& file) {
  check_file(file);
  return NetcdfFile::open(file);
}

}  // namespace

FrameReader::FrameReader(const std::filesystem::path& file)
    : file_(opened(file)), title_(file_.attribute("", "title")) {
  if (file_.has_dimension("probe")) names_.probes = file_.texts("probe_name");
  if (file_.has_dimension("body")) names_.bodies = file_.texts("body_name");
  if (file_.has_dimension("reaction")) names_.reactions = file_.texts("reaction_name");
  if (file_.has_dimension("connector")) names_.connectors = file_.texts("connector_name");
  if (file_.has_dimension("measure")) names_.measures = file_.texts("measure_name");
  if (file_.has_dimension("beam")) names_.beams = file_.texts("beam_name");
  names_.friction = file_.has_variable(std::string("body_") + friction_parts[0].name);
  names_.springs = file_.has_variable("energy_spring");
  names_.sections = file_.has_variable(section_axes[0].name);
  const std::size_t n = file_.size("time"), beams = names_.beams.size();
  if (n == 0) return;
  times_ = file_.doubles("time", {0}, {n});
  if (beams > 0) {
    element_counts_ = file_.integers("element_count", {0, 0}, {n, beams});
    node_counts_ = file_.integers("node_count", {0, 0}, {n, beams});
  }
  step_counts_ = file_.integers("solver_step_count", {0}, {n});
  // Of what a variable has numbers in the first frame.
  const auto known = [&](const char* name, std::size_t size, std::vector<bool>& of) {
    if (!file_.has_variable(name)) return;
    const Doubles values = file_.doubles(name, {0, 0, 0}, {1, names_.bodies.size(), size});
    for (std::size_t i = 0; i < names_.bodies.size(); ++i) of.push_back(values[size * i] != NetcdfFile::fill);
  };
  known("body_quaternion", 4, names_.rigid);
  known("body_acceleration", 3, names_.felt);
  names_.felt_at_probes = file_.has_variable("probe_acceleration");
  check_counts(file);
}

// What a file without a checksum says of its rows need not be so.
void FrameReader::check_counts(const std::filesystem::path& file) const {
  const auto check = [&](const Integers& counts, const char* dimension) {
    std::size_t sum = 0;
    for (const int count : counts) sum += static_cast<std::size_t>(std::max(count, 0));
    const bool positive = std::all_of(counts.begin(), counts.end(), [](int count) { return count >= 0; });
    if (!positive || (sum > 0 && sum != file_.size(dimension)))
      fail(file, std::string("is damaged: its counts do not fit its rows of ") + dimension);
  };
  check(element_counts_, "element");
  check(node_counts_, "node");
  check(step_counts_, "solver_step");
}

StoredRows FrameReader::rows() const {
  const auto total = [](const Integers& counts) { return sum(counts.begin(), counts.end()); };
  return {times_.size(), total(element_counts_), total(node_counts_), total(step_counts_)};
}

std::vector<Snapshot> FrameReader::read(std::size_t first, std::size_t count) const {
  if (first + count > times_.size()) throw std::out_of_range("FrameReader::read: no such frame");
  std::vector<Snapshot> frames(count);
  if (count == 0) return frames;
  for (Snapshot& frame : frames) {
    frame.probes.resize(names_.probes.size());
    frame.bodies.resize(names_.bodies.size());
    frame.beams.resize(names_.beams.size());
    frame.reactions.resize(names_.reactions.size());
    frame.connectors.resize(names_.connectors.size());
    frame.measures.resize(names_.measures.size());
  }
  read_scalars(first, frames);
  read_points(first, frames);
  read_forces(first, frames);
  read_turns(first, frames);
  read_elements(first, frames);
  read_nodes(first, frames);
  read_steps(first, frames);
  return frames;
}

void FrameReader::read_scalars(std::size_t first, std::vector<Snapshot>& frames) const {
  const std::size_t n = frames.size();
  const Doubles step = file_.doubles("step", {first}, {n});
  const Integers iterations = file_.integers("newton_iterations", {first}, {n});
  for (std::size_t i = 0; i < n; ++i) {
    frames[i].time = times_[first + i];
    frames[i].step = step[i];
    frames[i].newton_iterations = iterations[i];
  }
  for (const EnergyPart& part : energy_parts) {
    const Doubles values = file_.doubles(std::string("energy_") + part.name, {first}, {n});
    for (std::size_t i = 0; i < n; ++i) frames[i].energy.*part.value = values[i];
  }
  if (names_.springs) {
    const Doubles spring = file_.doubles("energy_spring", {first}, {n});
    for (std::size_t i = 0; i < n; ++i) frames[i].energy.spring = spring[i];
  }
  const std::size_t beams = names_.beams.size();
  if (beams == 0) return;
  const Doubles length = file_.doubles("beam_length", {first, 0}, {n, beams});
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t b = 0; b < beams; ++b) frames[i].beams[b].length = length[i * beams + b];
}

void FrameReader::read_points(std::size_t first, std::vector<Snapshot>& frames) const {
  const std::size_t n = frames.size();
  const auto vectors = [&](const std::string& name, std::size_t points, auto target) {
    if (points == 0) return;
    const Doubles values = file_.doubles(name, {first, 0, 0}, {n, points, 3});
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < points; ++j)
        target(frames[i], j) = Eigen::Vector3d(values.data() + 3 * (i * points + j));
  };
  const std::size_t probes = names_.probes.size(), bodies = names_.bodies.size();
  vectors(
      "probe_position", probes, [](Snapshot & f, std::size_t j) -> auto& { return f.probes[j].position; });
  vectors(
      "probe_velocity", probes, [](Snapshot & f, std::size_t j) -> auto& { return f.probes[j].velocity; });
  vectors(
      "body_position", bodies,
      [](Snapshot & f, std::size_t j) -> auto& { return f.bodies[j].point.position; });
  vectors(
      "body_velocity", bodies,
      [](Snapshot & f, std::size_t j) -> auto& { return f.bodies[j].point.velocity; });
  vectors(
      "body_joint_force", bodies,
      [](Snapshot & f, std::size_t j) -> auto& { return f.bodies[j].joint_force; });
  if (bodies == 0) return;
  const Doubles s = file_.doubles("body_s", {first, 0}, {n, bodies});
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < bodies; ++j)
      if (s[i * bodies + j] != NetcdfFile::fill) frames[i].bodies[j].s = s[i * bodies + j];
}

// What only rigid bodies have, and what is felt.
void FrameReader::read_turns(std::size_t first, std::vector<Snapshot>& frames) const {
  const std::size_t n = frames.size();
  const auto values = [&](const char* name, std::size_t count, std::size_t size) {
    return file_.doubles(name, {first, 0, 0}, {n, count, size});
  };
  const auto vector = [](const Doubles& of, std::size_t at) {
    return Eigen::Vector3d(Eigen::Map<const Eigen::Vector3d>(of.data() + 3 * at).unaryExpr(&unfilled));
  };
  if (const std::size_t bodies = names_.rigid.size(); bodies > 0) {
    const Doubles turns = values("body_quaternion", bodies, 4),
                  spins = values("body_angular_velocity", bodies, 3);
    for (std::size_t at = 0; at < n * bodies; ++at)
      if (names_.rigid[at % bodies])
        frames[at / bodies].bodies[at % bodies].turn =
            TurnRecord{Eigen::Vector4d(turns.data() + 4 * at), vector(spins, at)};
  }
  const auto read_felt = [&](const std::string& kind, std::size_t count, auto&& put) {
    if (count == 0) return;
    const Doubles accelerations = values((kind + "_acceleration").c_str(), count, 3),
                  factors = values((kind + "_load_factor").c_str(), count, 3);
    for (std::size_t at = 0; at < n * count; ++at)
      put(frames[at / count], at % count, FeltRecord{vector(accelerations, at), vector(factors, at)});
  };
  read_felt(
      "body", names_.felt.size(),
      [&](Snapshot& f, std::size_t j, const FeltRecord& felt) {
        if (names_.felt[j]) f.bodies[j].felt = felt;
      });
  read_felt("probe", names_.felt_at_probes ? names_.probes.size() : 0,
            [](Snapshot& f, std::size_t j, const FeltRecord& felt) { f.probes[j].felt = felt; });
}

// Results of earlier versions have fewer of these.
void FrameReader::read_forces(std::size_t first, std::vector<Snapshot>& frames) const {
  const std::size_t n = frames.size();
  const auto numbers = [&](const std::string& name, std::size_t count, auto target) {
    if (count == 0 || !file_.has_variable(name)) return;
    const Doubles values = file_.doubles(name, {first, 0}, {n, count});
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < count; ++j) target(frames[i], j) = unfilled(values[i * count + j]);
  };
  const auto vectors = [&](const std::string& name, std::size_t count, auto target) {
    if (count == 0 || !file_.has_variable(name)) return;
    const Doubles values = file_.doubles(name, {first, 0, 0}, {n, count, 3});
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < count; ++j)
        target(frames[i], j) =
            Eigen::Map<const Eigen::Vector3d>(values.data() + 3 * (i * count + j)).unaryExpr(&unfilled);
  };
  const std::size_t probes = names_.probes.size(), reactions = names_.reactions.size();
  vectors(
      "probe_displacement", probes,
      [](Snapshot & f, std::size_t j) -> auto& { return f.probes[j].displacement; });
  for (const SectionPart& part : with_own_axes(section_parts, own_axes_parts, names_.sections))
    numbers(
        std::string("probe_") + part.name,
        probes, [&](Snapshot & f, std::size_t j) -> auto& { return f.probes[j].section.*part.value; });
  numbers(
      "body_holding_force", names_.bodies.size(),
      [](Snapshot & f, std::size_t j) -> auto& { return f.bodies[j].holding_force; });
  for (const BodyPart& part : known_body_parts(names_))
    numbers(
        std::string("body_") + part.name,
        names_.bodies.size(), [&](Snapshot & f, std::size_t j) -> auto& { return f.bodies[j].*part.value; });
  numbers(
      "beam_sag", names_.beams.size(), [](Snapshot & f, std::size_t j) -> auto& { return f.beams[j].sag; });
  for (const BeamExtreme& extreme : with_own_axes(beam_extremes, own_axes_extremes, names_.sections)) {
    const std::string variable = std::string("beam_") + extreme.name;
    numbers(
        variable, names_.beams.size(),
        [&](Snapshot & f, std::size_t j) -> auto& { return (f.beams[j].*extreme.value).value; });
    numbers(
        variable + "_s", names_.beams.size(), [&](Snapshot & f, std::size_t j) -> auto& {
          return (f.beams[j].*extreme.value).s;
        });
  }
  for (const ConnectorPart& part : connector_parts)
    numbers(
        std::string("connector_") + part.name,
        names_.connectors.size(), [&](Snapshot & f, std::size_t j) -> auto& {
          return f.connectors[j].*part.value;
        });
  for (const ConnectorPlace& place : connector_places)
    vectors(
        std::string("connector_") + place.name,
        names_.connectors.size(), [&](Snapshot & f, std::size_t j) -> auto& {
          return f.connectors[j].*place.value;
        });
  for (const auto& [name, part] : {std::pair{"measure", &Extreme::value}, {"measure_s", &Extreme::s}})
    numbers(
        name, names_.measures.size(),
        [part = part](Snapshot & f, std::size_t j) -> auto& { return f.measures[j].*part; });
  vectors(
      "reaction_position", reactions,
      [](Snapshot & f, std::size_t j) -> auto& { return f.reactions[j].position; });
  vectors(
      "reaction_force", reactions, [](Snapshot & f, std::size_t j) -> auto& { return f.reactions[j].force; });
  vectors(
      "reaction_couple", reactions,
      [](Snapshot & f, std::size_t j) -> auto& { return f.reactions[j].couple; });
}

void FrameReader::read_elements(std::size_t first, std::vector<Snapshot>& frames) const {
  if (names_.beams.empty()) return;
  const std::size_t beams = names_.beams.size();
  const auto counts = element_counts_.begin() + static_cast<std::ptrdiff_t>(first * beams);
  const std::size_t start = sum(element_counts_.begin(), counts);
  const std::size_t count = sum(counts, counts + static_cast<std::ptrdiff_t>(frames.size() * beams));
  for (std::size_t i = 0; i < frames.size(); ++i)
    for (std::size_t b = 0; b < beams; ++b)
      frames[i].beams[b].elements.resize(counts[static_cast<std::ptrdiff_t>(i * beams + b)]);
  if (count == 0) return;
  const Doubles points = file_.doubles("control_points", {start, 0, 0}, {count, 4, 4});
  const Doubles drawn = file_.has_variable("drawn_control_points")  // earlier versions have none
                            ? file_.doubles("drawn_control_points", {start, 0, 0}, {count, 4, 3})
                            : Doubles(12 * count, NetcdfFile::fill);
  const Doubles velocity = file_.doubles("velocity", {start, 0, 0}, {count, sample_count, 3});
  const auto sampled = with_own_axes(sampled_fields, own_axes_fields, names_.sections);
  std::vector<Doubles> scalars, fields, axes;
  for (const ElementField& field : element_fields)  // results of earlier versions have fewer
    scalars.push_back(file_.has_variable(field.name) ? file_.doubles(field.name, {start}, {count})
                                                     : Doubles(count, 0));
  for (const SampledField& field : sampled)
    fields.push_back(file_.has_variable(field.name)
                         ? file_.doubles(field.name, {start, 0}, {count, sample_count})
                         : Doubles(count * sample_count, NetcdfFile::fill));
  if (names_.sections)
    for (const SampledVector& axis : section_axes)
      axes.push_back(file_.doubles(axis.name, {start, 0, 0}, {count, sample_count, 3}));
  std::size_t i = 0;
  for_each_element(frames, [&](ElementRecord& e) {
    e.control_points = Eigen::Map<const Eigen::Matrix4d>(points.data() + 16 * i);
    e.drawn_points =
        Eigen::Map<const Eigen::Matrix<double, 3, 4>>(drawn.data() + 12 * i).unaryExpr(&unfilled);
    for (std::size_t k = 0; k < scalars.size(); ++k) e.*element_fields[k].value = scalars[k][i];
    e.velocity = Eigen::Map<const Eigen::Matrix<double, 3, 4>>(velocity.data() + 12 * i);
    for (std::size_t k = 0; k < fields.size(); ++k)
      e.*sampled[k].values = Eigen::Map<const Eigen::Vector4d>(fields[k].data() + 4 * i).unaryExpr(&unfilled);
    for (std::size_t k = 0; k < axes.size(); ++k)
      e.*section_axes[k].values =
          Eigen::Map<const Eigen::Matrix<double, 3, 4>>(axes[k].data() + 12 * i).unaryExpr(&unfilled);
    ++i;
  });
}

void FrameReader::read_nodes(std::size_t first, std::vector<Snapshot>& frames) const {
  if (names_.beams.empty()) return;
  const std::size_t beams = names_.beams.size();
  const auto counts = node_counts_.begin() + static_cast<std::ptrdiff_t>(first * beams);
  const std::size_t start = sum(node_counts_.begin(), counts);
  const std::size_t count = sum(counts, counts + static_cast<std::ptrdiff_t>(frames.size() * beams));
  if (count == 0) return;
  const Doubles position = file_.doubles("node_position", {start, 0}, {count, 3});
  const Doubles slope = file_.doubles("node_slope", {start, 0}, {count, 3});
  const Doubles s = file_.doubles("node_s", {start}, {count});
  std::size_t i = 0;
  for (std::size_t k = 0; k < frames.size() * beams; ++k) {
    BeamRecord& beam = frames[k / beams].beams[k % beams];
    for (int node = 0; node < counts[static_cast<std::ptrdiff_t>(k)]; ++node, ++i) {
      beam.node_positions.emplace_back(position.data() + 3 * i);
      beam.node_slopes.emplace_back(slope.data() + 3 * i);
      beam.node_s.push_back(s[i]);
    }
  }
}

void FrameReader::read_steps(std::size_t first, std::vector<Snapshot>& frames) const {
  const auto counts = step_counts_.begin() + static_cast<std::ptrdiff_t>(first);
  const std::size_t start = sum(step_counts_.begin(), counts);
  const std::size_t count = sum(counts, counts + static_cast<std::ptrdiff_t>(frames.size()));
  if (count == 0) return;
  const Doubles time = file_.doubles("solver_step_time", {start}, {count});
  const Doubles size = file_.doubles("solver_step_size", {start}, {count});
  const Integers iterations = file_.integers("solver_step_newton_iterations", {start}, {count});
  const Integers rejected = file_.integers("solver_step_rejected", {start}, {count});
  std::size_t i = 0;
  for (std::size_t k = 0; k < frames.size(); ++k)
    for (int step = 0; step < counts[static_cast<std::ptrdiff_t>(k)]; ++step, ++i)
      frames[k].steps.push_back({time[i], size[i], iterations[i], rejected[i]});
}

}  // namespace nurbeam
