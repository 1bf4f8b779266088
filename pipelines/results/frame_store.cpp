#include "pipelines/results/frame_store.h"

#include <algorithm>
#include <stdexcept>

#include "pipelines/results/frame_layout.h"

namespace nurbeam {

FrameStore::FrameStore(const std::filesystem::path& file, const SnapshotNames& names,
                       const std::string& title)
    : file_(NetcdfFile::create(file)),
      probe_count_(names.probes.size()),
      body_count_(names.bodies.size()),
      beam_count_(names.beams.size()),
      reaction_count_(names.reactions.size()),
      sections_(names.sections),
      section_parts_(with_own_axes(section_parts, own_axes_parts, names.sections)),
      beam_extremes_(with_own_axes(beam_extremes, own_axes_extremes, names.sections)),
      sampled_fields_(with_own_axes(sampled_fields, own_axes_fields, names.sections)) {
  file_.put_attribute("", "Conventions", "CF-1.8");
  file_.put_attribute("", "title", title);
  file_.put_attribute("", "source", "nurbeam " NURBEAM_VERSION);
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
  }
  if (probe_count_ > 0) {
    define_of_time("probe_displacement", {"probe", "xyz"}, "m", "displacement from the drawing");
    for (const SectionPart& part : section_parts_)
      define_of_time(std::string("probe_") + part.name, {"probe"}, part.unit, part.long_name);
  }
  define_beams(names.beams);
  define_reactions(names.reactions);
  define_steps();
}

void FrameStore::define_of_time(const std::string& name, std::vector<std::string> dimensions,
                                const std::string& unit, const std::string& long_name, Type type) {
  dimensions.insert(dimensions.begin(), "time");
  file_.define(name, type, dimensions, unit, long_name, time_chunk);
}

void FrameStore::define_scalars() {
  define_of_time("time", {}, "s", "time");
  file_.put_attribute("time", "standard_name", "time");
  file_.put_attribute("time", "axis", "T");
  define_of_time("step", {}, "s", "last step size");
  define_of_time("newton_iterations", {}, "1", "Newton iterations since the previous frame", Type::integer);
  for (const EnergyPart& part : energy_parts)
    define_of_time(std::string("energy_") + part.name, {}, "J", std::string(part.name) + " energy");
}

void FrameStore::define_points(const std::string& kind, const std::vector<std::string>& names) {
  if (names.empty()) return;
  file_.define_dimension(kind, names.size());
  file_.define_texts(kind + "_name", kind, names);
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
  file_.define_texts("beam_name", "beam", names);
  define_of_time("beam_length", {"beam"}, "m", "deformed length of the beam");
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
    file_.define(name, Type::real, dimensions, unit, long_name, row_chunk);
  };
  define("control_points", {"element", "control_point", "homogeneous"}, "m",
         "deformed rational cubic as (w x, w y, w z, w); the weight w has no unit");
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
  file_.define_texts("reaction_name", "reaction", names);
  define_of_time("reaction_position", {"reaction", "xyz"}, "m", "where the support or joint is");
  define_of_time("reaction_force", {"reaction", "xyz"}, "N",
                 "force of the support on its beam, of the second of two joined beams on the first");
  define_of_time("reaction_couple", {"reaction", "xyz"}, "N m", "likewise the couple");
}

void FrameStore::define_steps() {
  file_.define_dimension("solver_step", NetcdfFile::unlimited);
  define_of_time("solver_step_count", {}, "1", "number of steps since the previous frame", Type::integer);
  file_.put_attribute("solver_step_count", "sample_dimension", "solver_step");
  const auto define = [&](const char* name, Type type, const char* unit, const char* long_name) {
    file_.define(name, type, {"solver_step"}, unit, long_name, row_chunk);
  };
  define("solver_step_time", Type::real, "s", "time at the end of the step");
  define("solver_step_size", Type::real, "s", "length of the step");
  define("solver_step_newton_iterations", Type::integer, "1", "Newton iterations of the step");
  define("solver_step_rejected", Type::integer, "1", "attempts at the step that were thrown away");
}

void FrameStore::write(std::span<const Snapshot> frames) {
  const std::size_t n = frames.size();
  if (n == 0) return;
  const auto put = [&](const std::string& name, NetcdfFile::Sizes shape, const auto& values) {
    NetcdfFile::Sizes start(shape.size() + 1, 0);
    start[0] = frames_;
    shape.insert(shape.begin(), n);
    file_.put(name, start, shape, values.data());
  };
  const auto reals = [&](auto value) {
    Doubles values;
    for (const Snapshot& frame : frames) value(frame, values);
    return values;
  };
  put("time", {}, reals([](const Snapshot& f, Doubles& x) { x.push_back(f.time); }));
  put("step", {}, reals([](const Snapshot& f, Doubles& x) { x.push_back(f.step); }));
  for (const EnergyPart& part : energy_parts)
    put(std::string("energy_") + part.name, {},
        reals([&](const Snapshot& f, Doubles& x) { x.push_back(f.energy.*part.value); }));
  Integers iterations;
  for (const Snapshot& frame : frames) iterations.push_back(frame.newton_iterations);
  put("newton_iterations", {}, iterations);
  if (probe_count_ > 0) {
    put("probe_position", {probe_count_, 3}, reals([](const Snapshot& f, Doubles& x) {
          for (const PointRecord& probe : f.probes) append(x, probe.position);
        }));
    put("probe_velocity", {probe_count_, 3}, reals([](const Snapshot& f, Doubles& x) {
          for (const PointRecord& probe : f.probes) append(x, probe.velocity);
        }));
    put("probe_displacement", {probe_count_, 3}, reals([](const Snapshot& f, Doubles& x) {
          for (const ProbeRecord& probe : f.probes) append(x, probe.displacement);
        }));
    for (const SectionPart& part : section_parts_)
      put(std::string("probe_") + part.name, {probe_count_}, reals([&](const Snapshot& f, Doubles& x) {
            for (const ProbeRecord& probe : f.probes) x.push_back(filled(probe.section.*part.value));
          }));
  }
  if (body_count_ > 0) {
    put("body_position", {body_count_, 3}, reals([](const Snapshot& f, Doubles& x) {
          for (const BodyRecord& body : f.bodies) append(x, body.point.position);
        }));
    put("body_velocity", {body_count_, 3}, reals([](const Snapshot& f, Doubles& x) {
          for (const BodyRecord& body : f.bodies) append(x, body.point.velocity);
        }));
    put("body_joint_force", {body_count_, 3}, reals([](const Snapshot& f, Doubles& x) {
          for (const BodyRecord& body : f.bodies) append(x, body.joint_force);
        }));
    put("body_s", {body_count_}, reals([](const Snapshot& f, Doubles& x) {
          for (const BodyRecord& body : f.bodies) x.push_back(body.s.value_or(NetcdfFile::fill));
        }));
    put("body_holding_force", {body_count_}, reals([](const Snapshot& f, Doubles& x) {
          for (const BodyRecord& body : f.bodies) x.push_back(body.holding_force);
        }));
  }
  put("beam_length", {beam_count_}, reals([](const Snapshot& f, Doubles& x) {
        for (const BeamRecord& beam : f.beams) x.push_back(beam.length);
      }));
  for (const BeamExtreme& extreme : beam_extremes_) {
    const std::string variable = std::string("beam_") + extreme.name;
    const auto of_beams = [&](double Extreme::*part) {
      return reals([&](const Snapshot& f, Doubles& x) {
        for (const BeamRecord& beam : f.beams) x.push_back(filled(beam.*extreme.value.*part));
      });
    };
    put(variable, {beam_count_}, of_beams(&Extreme::value));
    put(variable + "_s", {beam_count_}, of_beams(&Extreme::s));
  }
  if (reaction_count_ > 0) {
    const auto of_reactions = [&](Eigen::Vector3d ReactionRecord::*part) {
      return reals([&](const Snapshot& f, Doubles& x) {
        for (const ReactionRecord& reaction : f.reactions) append(x, reaction.*part);
      });
    };
    put("reaction_position", {reaction_count_, 3}, of_reactions(&ReactionRecord::position));
    put("reaction_force", {reaction_count_, 3}, of_reactions(&ReactionRecord::force));
    put("reaction_couple", {reaction_count_, 3}, of_reactions(&ReactionRecord::couple));
  }
  Integers element_counts, node_counts;
  for (const Snapshot& frame : frames)
    for (const BeamRecord& beam : frame.beams) {
      element_counts.push_back(static_cast<int>(beam.elements.size()));
      node_counts.push_back(static_cast<int>(beam.node_s.size()));
    }
  put("element_count", {beam_count_}, element_counts);
  put("node_count", {beam_count_}, node_counts);
  write_elements(frames);
  write_nodes(frames);
  write_steps(frames);
  frames_ += n;
}

void FrameStore::write_elements(std::span<const Snapshot> frames) {
  std::size_t count = 0;
  Doubles points, velocity;
  std::vector<Doubles> scalars(std::size(element_fields)), fields(sampled_fields_.size()),
      axes(sections_ ? std::size(section_axes) : 0);
  for_each_element(frames, [&](const ElementRecord& e) {
    // Columns are control points and Eigen stores by columns: the order (control_point, homogeneous).
    append(points, e.control_points);
    for (std::size_t i = 0; i < scalars.size(); ++i) scalars[i].push_back(e.*element_fields[i].value);
    for (std::size_t i = 0; i < fields.size(); ++i)
      for (const double value : e.*sampled_fields_[i].values) fields[i].push_back(filled(value));
    for (std::size_t i = 0; i < axes.size(); ++i)
      for (const double value : (e.*section_axes[i].values).reshaped()) axes[i].push_back(filled(value));
    append(velocity, e.velocity);
    ++count;
  });
  if (count == 0) return;
  file_.put("control_points", {elements_, 0, 0}, {count, 4, 4}, points.data());
  for (std::size_t i = 0; i < scalars.size(); ++i)
    file_.put(element_fields[i].name, {elements_}, {count}, scalars[i].data());
  for (std::size_t i = 0; i < fields.size(); ++i)
    file_.put(sampled_fields_[i].name, {elements_, 0}, {count, sample_count}, fields[i].data());
  file_.put("velocity", {elements_, 0, 0}, {count, sample_count, 3}, velocity.data());
  for (std::size_t i = 0; i < axes.size(); ++i)
    file_.put(section_axes[i].name, {elements_, 0, 0}, {count, sample_count, 3}, axes[i].data());
  elements_ += count;
}

void FrameStore::write_nodes(std::span<const Snapshot> frames) {
  Doubles position, slope, s;
  for (const Snapshot& frame : frames)
    for (const BeamRecord& beam : frame.beams) {
      for (const Eigen::Vector3d& r : beam.node_positions) append(position, r);
      for (const Eigen::Vector3d& r_s : beam.node_slopes) append(slope, r_s);
      s.insert(s.end(), beam.node_s.begin(), beam.node_s.end());
    }
  if (s.empty()) return;
  file_.put("node_position", {nodes_, 0}, {s.size(), 3}, position.data());
  file_.put("node_slope", {nodes_, 0}, {s.size(), 3}, slope.data());
  file_.put("node_s", {nodes_}, {s.size()}, s.data());
  nodes_ += s.size();
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
  file_.put("solver_step_count", {frames_}, {counts.size()}, counts.data());
  if (time.empty()) return;
  const NetcdfFile::Sizes start{steps_}, count{time.size()};
  file_.put("solver_step_time", start, count, time.data());
  file_.put("solver_step_size", start, count, size.data());
  file_.put("solver_step_newton_iterations", start, count, iterations.data());
  file_.put("solver_step_rejected", start, count, rejected.data());
  steps_ += time.size();
}

}  // namespace nurbeam
