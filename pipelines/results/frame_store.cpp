#include "pipelines/results/frame_store.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "pipelines/results/checksum.h"
#include "pipelines/results/frame_layout.h"

namespace nurbeam {

FrameStore::FrameStore(const std::filesystem::path& file, const SnapshotNames& names,
                       const std::string& title, bool packed, const StoredRows& expected)
    : path_(file),
      file_(NetcdfFile::create(file, packed)),
      probe_count_(names.probes.size()),
      body_count_(names.bodies.size()),
      beam_count_(names.beams.size()),
      reaction_count_(names.reactions.size()),
      connector_count_(names.connectors.size()),
      measure_count_(names.measures.size()),
      sections_(names.sections),
      springs_(names.springs),
      turns_(!names.rigid.empty()),
      felt_(!names.felt.empty()),
      felt_at_probes_(names.felt_at_probes),
      body_parts_(known_body_parts(names)),
      section_parts_(with_own_axes(section_parts, own_axes_parts, names.sections)),
      beam_extremes_(with_own_axes(beam_extremes, own_axes_extremes, names.sections)),
      sampled_fields_(with_own_axes(sampled_fields, own_axes_fields, names.sections)),
      expected_(expected) {
  file_.put_attribute("", "Conventions", "CF-1.8");
  file_.put_attribute("", "title", title);
  file_.put_attribute("", "source", "nurbeam " NURBEAM_VERSION);
  file_.put_attribute("", "checksum", std::string(checksum_attribute));
  file_.define_dimension("time", NetcdfFile::unlimited);
  file_.define_dimension("xyz", 3);
  define_scalars();
  define_points("probe", names.probes);
  define_points("body", names.bodies);
  if (body_count_ > 0) {
    define_of_time("body_joint_force", {"body", "xyz"}, "N", "force of the beam on the body");
    define_of_time("body_s", {"body"}, "m", "reference arc length of the body from the start of its beam");
    define_of_time("body_holding_force", {"body"}, "N",
                   "force along the beam that keeps the body where it is prescribed or has stopped");
    for (const BodyPart& part : body_parts_)
      define_of_time(std::string("body_") + part.name, {"body"}, part.unit, part.long_name);
    define_turns();
  }
  if (probe_count_ > 0) {
    define_of_time("probe_displacement", {"probe", "xyz"}, "m", "displacement from the drawing");
    for (const SectionPart& part : section_parts_)
      define_of_time(std::string("probe_") + part.name, {"probe"}, part.unit, part.long_name);
    if (felt_at_probes_) define_felt("probe", "of the probe");
  }
  if (beam_count_ > 0) define_beams(names.beams);
  define_reactions(names.reactions);
  define_connectors(names.connectors);
  define_measures(names.measures);
  define_steps();
}

// What only rigid bodies have, and what is felt; missing of the others.
void FrameStore::define_turns() {
  if (turns_) {
    file_.define_dimension("wxyz", 4);
    define_of_time("body_quaternion", {"body", "wxyz"}, "1", "turn of a rigid body from the drawing");
    define_of_time("body_angular_velocity", {"body", "xyz"}, "rad s-1", "of a rigid body");
  }
  if (felt_) define_felt("body", "of a rigid body or a place of one");
}

void FrameStore::define_felt(const std::string& kind, const std::string& whose) {
  define_of_time(kind + "_acceleration", {kind, "xyz"}, "m s-2", whose);
  define_of_time(kind + "_load_factor", {kind, "xyz"}, "1",
                 "acceleration less that of gravity along own axes, over 9.80665 m/s^2");
}

void FrameStore::close() {
  file_.close();
  append_checksum(path_);
}

void FrameStore::define_of_time(const std::string& name, std::vector<std::string> dimensions,
                                const std::string& unit, const std::string& long_name, Type type) {
  dimensions.insert(dimensions.begin(), "time");
  file_.define(name, type, dimensions, unit, long_name, expected_.frames);
}

void FrameStore::define_scalars() {
  define_of_time("time", {}, "s", "time");
  file_.put_attribute("time", "standard_name", "time");
  file_.put_attribute("time", "axis", "T");
  define_of_time("step", {}, "s", "last step size");
  define_of_time("newton_iterations", {}, "1", "Newton iterations since the previous frame", Type::integer);
  for (const EnergyPart& part : energy_parts)
    define_of_time(std::string("energy_") + part.name, {}, "J", std::string(part.name) + " energy");
  if (springs_) define_of_time("energy_spring", {}, "J", "energy of what is elastic beside the beams");
}

void FrameStore::define_points(const std::string& kind, const std::vector<std::string>& names) {
  if (names.empty()) return;
  file_.define_dimension(kind, names.size());
  file_.define_texts(kind + "_name", kind, "name of the " + kind, names);
  define_of_time(kind + "_position", {kind, "xyz"}, "m", "position of the " + kind);
  define_of_time(kind + "_velocity", {kind, "xyz"}, "m s-1", "velocity of the " + kind);
}

void FrameStore::define_beams(const std::vector<std::string>& names) {
  file_.define_dimension("beam", names.size());
  file_.define_dimension("element", NetcdfFile::unlimited);
  file_.define_dimension("node", NetcdfFile::unlimited);
  file_.define_dimension("control_point", 4);
  file_.define_dimension("homogeneous", 4);
  file_.define_dimension("sample", sample_count);
  file_.define_texts("beam_name", "beam", "name of the beam", names);
  define_of_time("beam_length", {"beam"}, "m", "deformed length of the beam");
  define_of_time("beam_sag", {"beam"}, "m", "how far the beam hangs below the line of its ends");
  for (const BeamExtreme& extreme : beam_extremes_) {
    const std::string variable = std::string("beam_") + extreme.name;
    define_of_time(variable, {"beam"}, extreme.unit, extreme.long_name);
    define_of_time(variable + "_s", {"beam"}, "m", "where: reference arc length");
  }
  define_of_time("element_count", {"beam"}, "1", "number of elements of the beam", Type::integer);
  define_of_time("node_count", {"beam"}, "1", "number of nodes of the beam", Type::integer);
  file_.put_attribute("element_count", "sample_dimension", "element");
  file_.put_attribute("node_count", "sample_dimension", "node");
  const auto define = [&](const char* name, const std::vector<std::string>& dimensions, const char* unit,
                          const char* long_name) {
    const bool nodal = dimensions.front() == "node";
    file_.define(name, Type::real, dimensions, unit, long_name, nodal ? expected_.nodes : expected_.elements);
  };
  define("control_points", {"element", "control_point", "homogeneous"}, "m",
         "deformed rational cubic as (w x, w y, w z, w); the weight w has no unit");
  define("drawn_control_points", {"element", "control_point", "xyz"}, "m",
         "the cubic as drawn, with the weights of control_points");
  for (const ElementField& field : element_fields)
    define(field.name, {"element"}, field.unit, field.long_name);
  const std::string samples = "samples at u = 0, 1/3, 2/3, 1 of the element's cubic";
  for (const SampledField& field : sampled_fields_) {
    define(field.name, {"element", "sample"}, field.unit, field.long_name);
    file_.put_attribute(field.name, "comment", samples);
  }
  const auto define_vector = [&](const char* name, const char* unit, const char* long_name) {
    define(name, {"element", "sample", "xyz"}, unit, long_name);
    file_.put_attribute(name, "comment", samples);
  };
  define_vector("velocity", "m s-1", "velocity of the material");
  if (sections_)
    for (const SampledVector& axis : section_axes) define_vector(axis.name, axis.unit, axis.long_name);
  define("node_position", {"node", "xyz"}, "m", "position of the node");
  define("node_slope", {"node", "xyz"}, "1",
         "derivative of position by reference arc length, left at a kink");
  define("node_s", {"node"}, "m", "reference arc length of the node");
}

void FrameStore::define_reactions(const std::vector<std::string>& names) {
  if (names.empty()) return;
  file_.define_dimension("reaction", names.size());
  file_.define_texts("reaction_name", "reaction", "name of the support or joint", names);
  define_of_time("reaction_position", {"reaction", "xyz"}, "m", "where the support or joint is");
  define_of_time("reaction_force", {"reaction", "xyz"}, "N",
                 "force of the support on its beam, of the second of two joined beams on the first");
  define_of_time("reaction_couple", {"reaction", "xyz"}, "N m", "likewise the couple");
}

void FrameStore::define_measures(const std::vector<std::string>& names) {
  if (names.empty()) return;
  file_.define_dimension("measure", names.size());
  file_.define_texts("measure_name", "measure", "beam and quantity, or name of the clearance", names);
  define_of_time(
      "measure", {"measure"}, "SI unit of the quantity",
      "sag of a part of a beam, clearance below it, what it does at an eyelet or a reel, or what turns");
  define_of_time("measure_s", {"measure"}, "m", "where: reference arc length");
}

void FrameStore::define_connectors(const std::vector<std::string>& names) {
  if (names.empty()) return;
  file_.define_dimension("connector", names.size());
  file_.define_texts("connector_name", "connector", "name of the connector", names);
  for (const ConnectorPart& part : connector_parts)
    define_of_time(std::string("connector_") + part.name, {"connector"}, part.unit, part.long_name);
  for (const ConnectorPlace& place : connector_places)
    define_of_time(std::string("connector_") + place.name, {"connector", "xyz"}, "m", place.long_name);
}

void FrameStore::define_steps() {
  file_.define_dimension("solver_step", NetcdfFile::unlimited);
  define_of_time("solver_step_count", {}, "1", "number of steps since the previous frame", Type::integer);
  file_.put_attribute("solver_step_count", "sample_dimension", "solver_step");
  const auto define = [&](const char* name, Type type, const char* unit, const char* long_name) {
    file_.define(name, type, {"solver_step"}, unit, long_name, expected_.steps);
  };
  define("solver_step_time", Type::real, "s", "time at the end of the step");
  define("solver_step_size", Type::real, "s", "length of the step");
  define("solver_step_newton_iterations", Type::integer, "1", "Newton iterations of the step");
  define("solver_step_rejected", Type::integer, "1", "attempts at the step that were thrown away");
}

// What has one value, or one row of values, in every frame.
class FrameStore::PerFrame {
 public:
  PerFrame(NetcdfFile& file, std::size_t first, std::span<const Snapshot> frames)
      : file_(&file), first_(first), frames_(frames) {}

  /// What `value`(frame, values) appends for each frame, as one array of that shape.
  template <class Value>
  void write(const std::string& name, const NetcdfFile::Sizes& shape, Value value) const {
    Doubles values;
    for (const Snapshot& frame : frames_) value(frame, values);
    put(name, shape, values);
  }
  template <class Value>
  void write_integers(const std::string& name, const NetcdfFile::Sizes& shape, Value value) const {
    Integers values;
    for (const Snapshot& frame : frames_) value(frame, values);
    put(name, shape, values);
  }

 private:
  template <class Values>
  void put(const std::string& name, NetcdfFile::Sizes shape, const Values& values) const {
    NetcdfFile::Sizes start(shape.size() + 1, 0);
    start[0] = first_;
    shape.insert(shape.begin(), frames_.size());
    file_->put(name, start, shape, values.data());
  }

  NetcdfFile* file_;
  std::size_t first_;
  std::span<const Snapshot> frames_;
};

void FrameStore::write(std::span<const Snapshot> frames) {
  if (frames.empty()) return;
  const PerFrame each(file_, written_.frames, frames);
  write_scalars(each);
  if (probe_count_ > 0) write_probes(each);
  if (body_count_ > 0) write_bodies(each);
  if (beam_count_ > 0) write_beams(each);
  if (reaction_count_ > 0) write_reactions(each);
  if (connector_count_ > 0) write_connectors(each);
  if (measure_count_ > 0) write_measures(each);
  if (beam_count_ > 0) write_elements(frames);
  if (beam_count_ > 0) write_nodes(frames);
  write_steps(frames);
  for (const Snapshot& frame : frames) written_ += rows_of(frame);
  ahead_ = 0;
}

void FrameStore::copy(const std::filesystem::path& file, const StoredRows& rows) {
  check_file(file);
  file_.append(NetcdfFile::open(file));
  written_ += rows;
}

void FrameStore::write_scalars(const PerFrame& each) {
  each.write(
      "time", {}, [](const Snapshot& f, Doubles& x) { x.push_back(f.time); });
  each.write("step", {}, [](const Snapshot& f, Doubles& x) { x.push_back(f.step); });
  for (const EnergyPart& part : energy_parts)
    each.write(std::string("energy_") + part.name, {},
               [&](const Snapshot& f, Doubles& x) { x.push_back(f.energy.*part.value); });
  if (springs_)
    each.write(
        "energy_spring", {}, [](const Snapshot& f, Doubles& x) { x.push_back(f.energy.spring); });
  each.write_integers("newton_iterations", {},
                      [](const Snapshot& f, Integers& x) { x.push_back(f.newton_iterations); });
}

void FrameStore::write_probes(const PerFrame& each) {
  const auto vectors = [&](const std::string& name, Eigen::Vector3d ProbeRecord::*part) {
    each.write(name, {probe_count_, 3}, [&](const Snapshot& f, Doubles& x) {
      for (const ProbeRecord& probe : f.probes) append(x, probe.*part);
    });
  };
  vectors("probe_position", &ProbeRecord::position);
  vectors("probe_velocity", &ProbeRecord::velocity);
  vectors("probe_displacement", &ProbeRecord::displacement);
  for (const SectionPart& part : section_parts_)
    each.write(std::string("probe_") + part.name, {probe_count_}, [&](const Snapshot& f, Doubles& x) {
      for (const ProbeRecord& probe : f.probes) x.push_back(filled(probe.section.*part.value));
    });
  if (!felt_at_probes_) return;
  for (const auto& [name, part] : {std::pair{"probe_acceleration", &FeltRecord::acceleration},
                                   {"probe_load_factor", &FeltRecord::load_factor}})
    each.write(name, {probe_count_, 3}, [&, part = part](const Snapshot& f, Doubles& x) {
      for (const ProbeRecord& probe : f.probes)
        for (int k = 0; k < 3; ++k)
          x.push_back(probe.felt ? filled((*probe.felt.*part)[k]) : NetcdfFile::fill);
    });
}

void FrameStore::write_bodies(const PerFrame& each) {
  const auto write = [&](const std::string& name, const NetcdfFile::Sizes& shape, auto append_part) {
    each.write(
        name, shape,
        [&](const Snapshot& f, Doubles& x) {
          for (const BodyRecord& body : f.bodies) append_part(x, body);
        });
  };
  write(
      "body_position", {body_count_, 3},
      [](Doubles& x, const BodyRecord& body) { append(x, body.point.position); });
  write(
      "body_velocity", {body_count_, 3},
      [](Doubles& x, const BodyRecord& body) { append(x, body.point.velocity); });
  write(
      "body_joint_force", {body_count_, 3},
      [](Doubles& x, const BodyRecord& body) { append(x, body.joint_force); });
  write(
      "body_s", {body_count_},
      [](Doubles& x, const BodyRecord& body) { x.push_back(body.s.value_or(NetcdfFile::fill)); });
  write("body_holding_force", {body_count_},
        [](Doubles& x, const BodyRecord& body) { x.push_back(body.holding_force); });
  for (const BodyPart& part : body_parts_)
    write(
        std::string("body_") + part.name, {body_count_},
        [&](Doubles& x, const BodyRecord& body) { x.push_back(filled(body.*part.value)); });
  const auto write_if = [&](bool asked, const char* name, std::size_t count, auto is_there, auto get) {
    if (!asked) return;
    write(
        name, {body_count_, count},
        [&](Doubles& x, const BodyRecord& body) {
          for (std::size_t k = 0; k < count; ++k)
            x.push_back(is_there(body) ? filled(get(body)[static_cast<Eigen::Index>(k)]) : NetcdfFile::fill);
        });
  };
  const auto turns = [](const BodyRecord& body) { return body.turn.has_value(); };
  const auto feels = [](const BodyRecord& body) { return body.felt.has_value(); };
  write_if(
      turns_, "body_quaternion", 4, turns, [](const BodyRecord& b) { return b.turn->attitude; });
  write_if(
      turns_, "body_angular_velocity", 3, turns, [](const BodyRecord& b) { return b.turn->spin; });
  write_if(
      felt_, "body_acceleration", 3, feels, [](const BodyRecord& b) { return b.felt->acceleration; });
  write_if(felt_, "body_load_factor", 3, feels, [](const BodyRecord& b) { return b.felt->load_factor; });
}

void FrameStore::write_beams(const PerFrame& each) {
  each.write(
      "beam_length", {beam_count_},
      [](const Snapshot& f, Doubles& x) {
        for (const BeamRecord& beam : f.beams) x.push_back(beam.length);
      });
  each.write("beam_sag", {beam_count_}, [](const Snapshot& f, Doubles& x) {
    for (const BeamRecord& beam : f.beams) x.push_back(filled(beam.sag));
  });
  for (const BeamExtreme& extreme : beam_extremes_) {
    const std::string variable = std::string("beam_") + extreme.name;
    const auto write = [&](const std::string& name, double Extreme::*part) {
      each.write(name, {beam_count_}, [&](const Snapshot& f, Doubles& x) {
        for (const BeamRecord& beam : f.beams) x.push_back(filled(beam.*extreme.value.*part));
      });
    };
    write(variable, &Extreme::value);
    write(variable + "_s", &Extreme::s);
  }
  each.write_integers(
      "element_count", {beam_count_},
      [](const Snapshot& f, Integers& x) {
        for (const BeamRecord& beam : f.beams) x.push_back(static_cast<int>(element_count(beam)));
      });
  each.write_integers("node_count", {beam_count_}, [](const Snapshot& f, Integers& x) {
    for (const BeamRecord& beam : f.beams) x.push_back(static_cast<int>(beam.node_s.size()));
  });
}

void FrameStore::write_reactions(const PerFrame& each) {
  const auto write = [&](const std::string& name, Eigen::Vector3d ReactionRecord::*part) {
    each.write(name, {reaction_count_, 3}, [&](const Snapshot& f, Doubles& x) {
      for (const ReactionRecord& reaction : f.reactions) append(x, reaction.*part);
    });
  };
  write("reaction_position", &ReactionRecord::position);
  write("reaction_force", &ReactionRecord::force);
  write("reaction_couple", &ReactionRecord::couple);
}

void FrameStore::write_measures(const PerFrame& each) {
  const auto write = [&](const char* name, double Extreme::*part) {
    each.write(name, {measure_count_}, [part](const Snapshot& f, Doubles& x) {
      for (const Extreme& measure : f.measures) x.push_back(filled(measure.*part));
    });
  };
  write("measure", &Extreme::value);
  write("measure_s", &Extreme::s);
}

void FrameStore::write_connectors(const PerFrame& each) {
  for (const ConnectorPart& part : connector_parts)
    each.write(std::string("connector_") + part.name, {connector_count_}, [&](const Snapshot& f, Doubles& x) {
      for (const ConnectorRecord& connector : f.connectors) x.push_back(connector.*part.value);
    });
  for (const ConnectorPlace& place : connector_places)
    each.write(std::string("connector_") + place.name, {connector_count_, 3},
               [&](const Snapshot& f, Doubles& x) {
                 for (const ConnectorRecord& connector : f.connectors)
                   for (const double value : connector.*place.value) x.push_back(filled(value));
               });
}

// Elements that are put together: not all of a frame, which may have many.
class FrameStore::ElementBlock {
 public:
  explicit ElementBlock(FrameStore& store)
      : store_(&store),
        scalars_(std::size(element_fields)),
        fields_(store.sampled_fields_.size()),
        axes_(store.sections_ ? std::size(section_axes) : 0),
        first_(store.written_.elements + store.ahead_) {}

  void add(const ElementRecord& e) {
    // Columns are control points and Eigen stores by columns: the order (control_point, homogeneous).
    append(points_, e.control_points);
    for (const double value : e.drawn_points.reshaped()) drawn_.push_back(filled(value));
    for (std::size_t i = 0; i < scalars_.size(); ++i) scalars_[i].push_back(e.*element_fields[i].value);
    for (std::size_t i = 0; i < fields_.size(); ++i)
      for (const double value : e.*store_->sampled_fields_[i].values) fields_[i].push_back(filled(value));
    for (std::size_t i = 0; i < axes_.size(); ++i)
      for (const double value : (e.*section_axes[i].values).reshaped()) axes_[i].push_back(filled(value));
    append(velocity_, e.velocity);
    if (++count_ == most) put();
  }

  void put() {
    if (count_ == 0) return;
    const auto put = [&](const std::string& name, NetcdfFile::Sizes shape, Doubles& values) {
      NetcdfFile::Sizes start(shape.size() + 1, 0);
      start[0] = first_;
      shape.insert(shape.begin(), count_);
      store_->file_.put(name, start, shape, values.data());
      values.clear();
    };
    put("control_points", {4, 4}, points_);
    put("drawn_control_points", {4, 3}, drawn_);
    for (std::size_t i = 0; i < scalars_.size(); ++i) put(element_fields[i].name, {}, scalars_[i]);
    for (std::size_t i = 0; i < fields_.size(); ++i)
      put(store_->sampled_fields_[i].name, {sample_count}, fields_[i]);
    put("velocity", {sample_count, 3}, velocity_);
    for (std::size_t i = 0; i < axes_.size(); ++i) put(section_axes[i].name, {sample_count, 3}, axes_[i]);
    first_ += std::exchange(count_, 0);
  }

 private:
  static constexpr std::size_t most = 4096;

  FrameStore* store_;
  Doubles points_, drawn_, velocity_;
  std::vector<Doubles> scalars_, fields_, axes_;
  std::size_t first_, count_ = 0;
};

void FrameStore::write_elements(std::span<const Snapshot> frames) {
  ElementBlock block(*this);
  for_each_element(frames, [&](const ElementRecord& e) { block.add(e); });
  block.put();
}

void FrameStore::write_ahead(std::span<const ElementRecord> elements) {
  ElementBlock block(*this);
  for (const ElementRecord& e : elements) block.add(e);
  block.put();
  ahead_ += elements.size();
}

void FrameStore::write_nodes(std::span<const Snapshot> frames) {
  std::size_t count = 0;
  for (const Snapshot& frame : frames) count += rows_of(frame).nodes;
  if (count == 0) return;
  const auto put = [&](const char* name, std::vector<Eigen::Vector3d> BeamRecord::*vectors) {
    Doubles values;
    values.reserve(3 * count);
    for (const Snapshot& frame : frames)
      for (const BeamRecord& beam : frame.beams)
        for (const Eigen::Vector3d& vector : beam.*vectors) append(values, vector);
    file_.put(name, {written_.nodes, 0}, {count, 3}, values.data());
  };
  put("node_position", &BeamRecord::node_positions);
  put("node_slope", &BeamRecord::node_slopes);
  Doubles s;
  s.reserve(count);
  for (const Snapshot& frame : frames)
    for (const BeamRecord& beam : frame.beams) s.insert(s.end(), beam.node_s.begin(), beam.node_s.end());
  file_.put("node_s", {written_.nodes}, {count}, s.data());
}

void FrameStore::write_steps(std::span<const Snapshot> frames) {
  Integers counts, iterations, rejected;
  Doubles time, size;
  for (const Snapshot& frame : frames) {
    counts.push_back(static_cast<int>(frame.steps.size()));
    for (const StepRecord& step : frame.steps) {
      time.push_back(step.time);
      size.push_back(step.size);
      iterations.push_back(step.newton_iterations);
      rejected.push_back(step.rejected);
    }
  }
  file_.put("solver_step_count", {written_.frames}, {counts.size()}, counts.data());
  if (time.empty()) return;
  const NetcdfFile::Sizes start{written_.steps}, count{time.size()};
  file_.put("solver_step_time", start, count, time.data());
  file_.put("solver_step_size", start, count, size.data());
  file_.put("solver_step_newton_iterations", start, count, iterations.data());
  file_.put("solver_step_rejected", start, count, rejected.data());
}

}  // namespace nurbeam
