#include <pybind11/eigen.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <array>
#include <sstream>

#include "fem/motion/remesh/meshed_state.h"
#include "pipelines/model/model_snapshot.h"
#include "pipelines/report/report.h"
#include "pipelines/results/checked_json.h"
#include "pipelines/results/export_results.h"
#include "pipelines/results/frame_layout.h"
#include "pipelines/results/history_columns.h"
#include "pipelines/results/history_table.h"
#include "pipelines/results/results.h"
#include "pipelines/run/simulation_plan.h"
#include "python/bindings.h"
#include "python/built_case.h"
#include "python/interpreter_lock.h"
#include "python/pickles.h"
#include "python/recording.h"
#include "python/recording_bytes.h"

namespace nurbeam::python {

namespace {

namespace py = pybind11;

using SharedRecording = std::shared_ptr<Recording>;
using Table = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using VectorRows = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;
constexpr std::size_t frames_at_once = 64;

void take_rows(const std::filesystem::path& file, Recording& recording);

SharedRecording read_results_directory(const std::filesystem::path& directory) {
  const WithoutLock others_go_on;
  const StoredFrames stored(directory);
  auto recording = std::make_shared<Recording>();
  recording->title = stored.title();
  recording->names = stored.names();
  const std::size_t count = stored.times().size();
  for (std::size_t first = 0; first < count; first += frames_at_once)
    for (Snapshot& frame : stored.read(first, std::min(frames_at_once, count - first)))
      recording->frames.push_back(std::move(frame));
  take_rows(directory / "histories.csv", *recording);
  return recording;
}

PlainFindings said_of_checksum(const std::filesystem::path& directory) {
  const auto note = missing_checksum(directory);
  return note ? plain({*note}) : PlainFindings{};
}

// (name, quantity, unit) of every column but the time.
std::vector<std::tuple<std::string, std::string, std::string>> column_names(const Recording& recording) {
  std::vector<std::tuple<std::string, std::string, std::string>> names;
  for (const HistoryColumn& column : history_columns(recording.names))
    names.emplace_back(column.name, column.quantity, column.unit);
  return names;
}

// (times x columns).
Table history_values(const Recording& recording) {
  const std::vector<HistoryColumn> columns = history_columns(recording.names);
  if (!recording.row_times.empty())
    return Eigen::Map<const Table>(recording.row_values.data(),
                                   static_cast<Eigen::Index>(recording.row_times.size()),
                                   static_cast<Eigen::Index>(columns.size()));
  Table values(recording.frames.size(), columns.size());
  for (Eigen::Index i = 0; i < values.rows(); ++i)
    for (Eigen::Index j = 0; j < values.cols(); ++j) values(i, j) = columns[j].value(recording.frames[i]);
  return values;
}

Eigen::VectorXd times(const Recording& recording) {
  Eigen::VectorXd t(recording.frames.size());
  for (Eigen::Index i = 0; i < t.size(); ++i) t[i] = recording.frames[i].time;
  return t;
}

// Of the rows of histories.
Eigen::VectorXd history_times(const Recording& recording) {
  if (recording.row_times.empty()) return times(recording);
  return Eigen::Map<const Eigen::VectorXd>(recording.row_times.data(),
                                           static_cast<Eigen::Index>(recording.row_times.size()));
}

std::size_t history_count(const Recording& recording) {
  return recording.row_times.empty() ? recording.frames.size() : recording.row_times.size();
}

// The rows of histories.csv, where they are more than the frames.
void take_rows(const std::filesystem::path& file, Recording& recording) {
  if (!std::filesystem::exists(file)) return;
  StoredHistories rows = read_histories(file);
  if (rows.times.size() <= recording.frames.size() ||
      rows.headings.size() != history_columns(recording.names).size())
    return;
  recording.row_times = std::move(rows.times);
  recording.row_values = std::move(rows.values);
}

// The steps of the whole run: (time, size, Newton iterations, rejected) each.
Table steps(const Recording& recording) {
  std::vector<StepRecord> all;
  for (const Snapshot& frame : recording.frames)
    all.insert(all.end(), frame.steps.begin(), frame.steps.end());
  Table rows(all.size(), 4);
  for (Eigen::Index i = 0; i < rows.rows(); ++i)
    rows.row(i) << all[i].time, all[i].size, all[i].newton_iterations, all[i].rejected;
  return rows;
}

// (angular frequency, factor, participation, whirl) of the modes.
py::object mode_rows(const Recording& recording) {
  if (!recording.modes) return py::none();
  py::list rows;
  for (const ModeRow& row : recording.modes->rows)
    rows.append(py::make_tuple(row.omega, row.factor, Eigen::Vector3d(row.participation), row.whirl));
  return py::make_tuple(recording.modes->buckling, recording.modes->mass, rows);
}

// The modes that rows and the like were made of.
std::optional<ModeTable> mode_table(const py::object& table) {
  if (table.is_none()) return std::nullopt;
  const auto [buckling, mass, rows] =
      table.cast<std::tuple<bool, double, std::vector<std::tuple<double, double, Eigen::Vector3d, int>>>>();
  ModeTable modes{.buckling = buckling, .mass = mass, .rows = {}};
  for (const auto& [omega, factor, participation, whirl] : rows)
    modes.rows.push_back({.omega = omega, .factor = factor, .participation = participation, .whirl = whirl});
  return modes;
}

// Frames are appended with the interpreter's lock: it is held while they are copied.
py::bytes bytes_of_frames(const Recording& recording, const std::vector<Snapshot>& frames) {
  std::string bytes;
  {
    const WithoutLock others_go_on;
    bytes = bytes_of(recording.title, recording.names, frames);
  }
  return {bytes};
}

SharedRecording shared_from(const py::bytes& bytes) {
  const std::string text = bytes;
  const WithoutLock others_go_on;
  return std::make_shared<Recording>(recording_from(text));
}

py::tuple recording_parts(const Recording& recording) {
  return py::make_tuple(bytes_of_frames(recording, {recording.frames.begin(), recording.frames.end()}),
                        mode_rows(recording));
}

SharedRecording recording_of(const py::bytes& pickled) {
  const py::tuple parts = parts_of(pickled, "the pickled recording");
  SharedRecording recording = shared_from(parts[0].cast<py::bytes>());
  recording->modes = mode_table(parts[1]);
  return recording;
}

// A snapshot goes by itself, without the others of its recording.
Frame frame_of(const py::bytes& pickled) {
  const SharedRecording recording = shared_from(parts_of(pickled, "the pickled snapshot"));
  return {recording, &recording->frames.at(0)};
}

const BeamRecord& beam_of(const Frame& frame, std::size_t beam) { return frame.snapshot->beams.at(beam); }

// What the samples of the elements of a beam hold, by name: (elements x 4), vectors (elements x 4 x 3).
py::dict sampled(const Frame& frame, std::size_t beam) {
  const std::vector<ElementRecord>& elements = beam_of(frame, beam).elements;
  const auto n = static_cast<Eigen::Index>(elements.size());
  py::dict fields;
  for (const SampledField& field : with_own_axes(sampled_fields, own_axes_fields, frame.of->names.sections)) {
    Table values(n, 4);
    for (Eigen::Index i = 0; i < n; ++i) values.row(i) = elements[i].*field.values;
    fields[field.name] = values;
  }
  const auto add_vectors = [&](const char* name, auto values_of) {
    py::array_t<double> values({n, Eigen::Index{4}, Eigen::Index{3}});
    auto v = values.mutable_unchecked<3>();
    for (Eigen::Index i = 0; i < n; ++i)
      for (Eigen::Index j = 0; j < 4; ++j)
        for (Eigen::Index k = 0; k < 3; ++k) v(i, j, k) = values_of(elements[i])(k, j);
    fields[name] = values;
  };
  add_vectors("velocity", [](const ElementRecord& e) { return e.velocity; });
  if (frame.of->names.sections)
    for (const SampledVector& axis : section_axes)
      add_vectors(axis.name, [&axis](const ElementRecord& e) { return e.*axis.values; });
  return fields;
}

// Homogeneous control points (w x, w y, w z, w) of the elements: (elements x 4 x 4).
// Displacements from the drawing are those of the run times `exaggerate`.
py::array_t<double> control_points(const Frame& frame, std::size_t beam, double exaggerate) {
  const std::vector<ElementRecord> elements = exaggerated(beam_of(frame, beam).elements, exaggerate);
  const auto n = static_cast<Eigen::Index>(elements.size());
  py::array_t<double> points({n, Eigen::Index{4}, Eigen::Index{4}});
  auto p = points.mutable_unchecked<3>();
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < 4; ++j)
      for (Eigen::Index k = 0; k < 4; ++k) p(i, j, k) = elements[i].control_points(k, j);
  return points;
}

// Reference arc length at the start and the end of each element.
Table element_ends(const Frame& frame, std::size_t beam) {
  const std::vector<ElementRecord>& elements = beam_of(frame, beam).elements;
  Table s(elements.size(), 2);
  for (Eigen::Index i = 0; i < s.rows(); ++i) s.row(i) << elements[i].s_start, elements[i].s_end;
  return s;
}

VectorRows rows_of(const std::vector<Eigen::Vector3d>& vectors) {
  VectorRows rows(vectors.size(), 3);
  for (Eigen::Index i = 0; i < rows.rows(); ++i) rows.row(i) = vectors[i];
  return rows;
}

// (s, positions, slopes).
py::tuple nodes(const Frame& frame, std::size_t beam) {
  const BeamRecord& b = beam_of(frame, beam);
  const Eigen::VectorXd s =
      Eigen::Map<const Eigen::VectorXd>(b.node_s.data(), static_cast<Eigen::Index>(b.node_s.size()));
  return py::make_tuple(s, rows_of(b.node_positions), rows_of(b.node_slopes));
}

NurbsCurve curve(const Frame& frame, std::size_t beam, bool by_material, double exaggerate) {
  const WithoutLock others_go_on;
  return deformed_curve(exaggerated(beam_of(frame, beam).elements, exaggerate),
                        by_material ? CurveParameter::material : CurveParameter::free);
}

// By name: (position, velocity).
py::dict points(const std::vector<std::string>& names, std::size_t count, auto point_of) {
  py::dict found;
  for (std::size_t i = 0; i < count; ++i) {
    const PointRecord& point = point_of(i);
    found[py::str(names[i])] = py::make_tuple(point.position, point.velocity);
  }
  return found;
}

// By name: (positions of the ends, length, force).
py::dict connectors(const Frame& frame) {
  py::dict found;
  for (std::size_t i = 0; i < frame.snapshot->connectors.size(); ++i) {
    const ConnectorRecord& connector = frame.snapshot->connectors[i];
    found[py::str(frame.of->names.connectors[i])] =
        py::make_tuple(rows_of({connector.from, connector.to}), connector.length, connector.force);
  }
  return found;
}

std::vector<double> column_values(const Frame& frame) {
  std::vector<double> values;
  for (const HistoryColumn& column : history_columns(frame.of->names))
    values.push_back(column.value(*frame.snapshot));
  return values;
}

// The page of a run that is in memory.
std::string report_page(const Recording& recording, const std::string& run_json) {
  const WithoutLock others_go_on;
  std::vector<double> times;
  for (const Snapshot& frame : recording.frames) times.push_back(frame.time);
  std::ostringstream page;
  write_report_page(page,
                    {recording.title, recording.names, std::move(times),
                     [&](std::size_t first, std::size_t count) {
                       const auto begin = recording.frames.begin() + static_cast<std::ptrdiff_t>(first);
                       return std::vector<Snapshot>(begin, begin + static_cast<std::ptrdiff_t>(count));
                     }},
                    run_json);
  return page.str();
}

// A model as drawn: one snapshot of nothing that moves.
std::shared_ptr<Recording> drawn(const BuiltCase& c) {
  const WithoutLock others_go_on;
  auto recording = std::make_shared<Recording>();
  recording->title = c.case_file.name;
  recording->names = snapshot_names(c.built());
  const MeshedState drawn = MeshedState::drawn(std::make_shared<const BeamModel>(c.built().model));
  recording->frames.push_back(
      to_world(c.built().frame, record_snapshot(*drawn.system, drawn.state, probe_places(c.built()))));
  return recording;
}

}  // namespace

void bind_recordings(py::module_& module) {
  module.def("report_page", &report_page, py::arg("recording"), py::arg("run_json"));
  module.def("drawn", &drawn, py::arg("case"));
  module.def("read_results", &read_results_directory, py::arg("directory"));
  module.def("missing_checksum", &said_of_checksum, py::arg("directory"));
  module.def("checked_json", &checked_json, py::arg("file"));
  module.def("recording_of", &recording_of, py::arg("pickled"));
  module.def("frame_of", &frame_of, py::arg("pickled"));
  py::class_<Recording, SharedRecording>(module, "Recording", "The snapshots of a run.")
      .def_readonly("title", &Recording::title)
      .def_property_readonly(
          "beams", [](const Recording& r) { return r.names.beams; })
      .def_property_readonly(
          "bodies", [](const Recording& r) { return r.names.bodies; })
      .def_property_readonly(
          "probes", [](const Recording& r) { return r.names.probes; })
      .def_property_readonly(
          "reactions", [](const Recording& r) { return r.names.reactions; })
      .def(
          "__len__", [](const Recording& r) { return r.frames.size(); })
      .def("columns", &column_names)
      .def("histories", &history_values)
      .def("history_times", &history_times)
      .def("history_count", &history_count)
      .def("times", &times)
      .def("steps", &steps)
      .def("modes", &mode_rows)
      .def(
          "__reduce__", [](const Recording& r) { return reduce("recording_of", recording_parts(r)); })
      .def(
          "frame",
          [](const SharedRecording& r, std::size_t i) {
            return Frame{r, &r->frames.at(i)};
          },
          py::arg("i"));
  py::class_<Frame>(module, "Frame", "One of the snapshots.")
      .def_property_readonly("time", [](const Frame& f) { return f.snapshot->time; })
      .def_property_readonly("recording",
                             [](const Frame& f) { return std::const_pointer_cast<Recording>(f.of); })
      .def("__reduce__",
           [](const Frame& f) { return reduce("frame_of", bytes_of_frames(*f.of, {*f.snapshot})); })
      .def("bodies",
           [](const Frame& f) {
             return points(f.of->names.bodies, f.snapshot->bodies.size(),
                           [&](std::size_t i) { return f.snapshot->bodies[i].point; });
           })
      .def("probes",
           [](const Frame& f) {
             return points(f.of->names.probes, f.snapshot->probes.size(),
                           [&](std::size_t i) -> const PointRecord& { return f.snapshot->probes[i]; });
           })
      .def("connectors", &connectors)
      .def("values", &column_values)
      .def("sampled", &sampled, py::arg("beam"))
      .def("control_points", &control_points, py::arg("beam"), py::arg("exaggerate"))
      .def("element_ends", &element_ends, py::arg("beam"))
      .def("nodes", &nodes, py::arg("beam"))
      .def(
          "length", [](const Frame& f, std::size_t beam) { return beam_of(f, beam).length; }, py::arg("beam"))
      .def("curve", &curve, py::arg("beam"), py::arg("by_material"), py::arg("exaggerate"));
}

}  // namespace nurbeam::python
