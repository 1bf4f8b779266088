#include "pipelines/report/report.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <bit>
#include <cerrno>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string_view>

#include "cad_import/files/atomic_file.h"
#include "pipelines/accuracy/error_files.h"
#include "pipelines/report/report_template.h"
#include "pipelines/results/base64.h"
#include "pipelines/results/checked_json.h"
#include "pipelines/results/checksum.h"
#include "pipelines/results/frame_layout.h"
#include "pipelines/results/history_columns.h"
#include "pipelines/results/results.h"

namespace nurbeam {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using Bytes = std::vector<unsigned char>;

static_assert(std::endian::native == std::endian::little, "the page reads little-endian numbers");

template <class Number>
void append(Bytes& bytes, const Number* numbers, std::size_t count) {
  const auto* first = reinterpret_cast<const unsigned char*>(numbers);
  bytes.insert(bytes.end(), first, first + count * sizeof(Number));
}

template <class Number>
std::string base64_of(const std::vector<Number>& numbers) {
  return base64(numbers.data(), numbers.size() * sizeof(Number));
}

// ---- histories ----

/// A history and its values.
struct Column {
  HistoryColumn what;
  std::vector<double> values = {};
};

std::vector<Column> empty_columns(const SnapshotNames& names) {
  std::vector<Column> columns = {
      {{"run", 0, "run", "time", "s", [](const Snapshot& frame) { return frame.time; }}},
      {{"run", 0, "run", "step", "s", [](const Snapshot& frame) { return frame.step; }}}};
  for (HistoryColumn& column : history_columns(names)) columns.push_back({std::move(column)});
  for (std::size_t i = 0; i < names.connectors.size(); ++i)
    for (const ConnectorPlace& place : connector_places)
      for (int k = 0; k < 3; ++k)
        columns.push_back(
            {{"connector", i, names.connectors[i], place.name + (std::string(".") + "xyz"[k]), "m",
              [i, k, part = place.value](const Snapshot& frame) { return (frame.connectors[i].*part)[k]; }}});
  return columns;
}

// ---- shapes ----

/// A quantity that beams can be coloured by, at the four sample parameters of an element.
struct Field {
  const char *name, *unit;
  Eigen::Vector4d (*values)(const ElementRecord& element);
  double min = std::numeric_limits<double>::infinity(), max = -std::numeric_limits<double>::infinity();

  void add(const ElementRecord& element) {
    const Eigen::Vector4d now = values(element);
    for (const double value : now) {
      if (std::isnan(value)) continue;
      min = std::min(min, value);
      max = std::max(max, value);
    }
  }
  /// A value as a byte: 0 is min, 255 is max.
  unsigned char byte_of(double value) const {
    const double part = max > min && !std::isnan(value) ? (value - min) / (max - min) : 0;
    return static_cast<unsigned char>(std::lround(255 * std::clamp(part, 0.0, 1.0)));
  }
};

/// From the drawing, of the control points [m].
Eigen::Matrix<double, 3, 4> displacements_of(const ElementRecord& element) {
  return element.control_points.colwise().hnormalized() - element.drawn_points;
}

/// Displacements from the drawing, at the four sample parameters [m]. A drawn cubic has the weights of the
/// element.
Eigen::Vector4d displacements_at_samples(const ElementRecord& element) {
  Eigen::Vector4d sizes;
  for (int i = 0; i < 4; ++i) {
    const double u = i / 3.0, v = 1 - u;
    const Eigen::Vector4d parts = Eigen::Vector4d(v * v * v, 3 * v * v * u, 3 * v * u * u, u * u * u)
                                      .cwiseProduct(element.control_points.row(3).transpose());
    sizes[i] = (displacements_of(element) * parts).norm() / parts.sum();
  }
  return sizes;
}

std::vector<Field> all_fields() {
  return {
      {"strain", "1", [](const ElementRecord& e) { return e.strain; }},
      {"curvature", "1/m", [](const ElementRecord& e) { return e.curvature; }},
      {"axial force", "N", [](const ElementRecord& e) { return e.axial_force; }},
      {"bending moment", "N m", [](const ElementRecord& e) { return e.bending_moment; }},
      {"moment 1", "N m", [](const ElementRecord& e) { return e.moment_1; }},
      {"moment 2", "N m", [](const ElementRecord& e) { return e.moment_2; }},
      {"torque", "N m", [](const ElementRecord& e) { return e.torque; }},
      {"twist", "rad", [](const ElementRecord& e) { return e.twist; }},
      {"shear force", "N", [](const ElementRecord& e) { return e.shear_force; }},
      {"stress", "Pa", [](const ElementRecord& e) { return e.stress; }},
      {"von Mises stress", "Pa", [](const ElementRecord& e) { return e.von_mises; }},
      {"displacement", "m", displacements_at_samples},
      {"speed", "m/s", [](const ElementRecord& e) -> Eigen::Vector4d { return e.velocity.colwise().norm(); }},
      {"axial mismatch", "1",
       [](const ElementRecord& e) -> Eigen::Vector4d {
         return Eigen::Vector4d::Constant(e.axial_mismatch);
       }}};
}

/// What must be known of all frames before one can be written.
struct Survey {
  std::vector<Field> fields = all_fields();
  Eigen::AlignedBox<double, 3> box;                        ///< of the whole run [m]
  bool rational = false;                                   ///< the weights of some element differ
  bool sections = false;                                   ///< beams have torsion: their sections turn
  bool drawn = true;                                       ///< where the elements are drawn is known
  double displacement = 0;                                 ///< largest of a control point [m]
  std::vector<std::vector<std::uint32_t>> element_counts;  ///< per frame, per beam
  std::vector<Column> columns;

  void add(const Snapshot& frame) {
    for (Column& column : columns) column.values.push_back(column.what.value(frame));
    std::vector<std::uint32_t>& counts = element_counts.emplace_back();
    for (const BeamRecord& beam : frame.beams) {
      counts.push_back(static_cast<std::uint32_t>(beam.elements.size()));
      for (const ElementRecord& element : beam.elements) add(element);
    }
    for (const BodyRecord& body : frame.bodies) box.extend(body.point.position);
    for (const ConnectorRecord& connector : frame.connectors)
      for (const ConnectorPlace& place : connector_places)
        if ((connector.*place.value).allFinite()) box.extend(connector.*place.value);
  }

  Eigen::Vector3d origin() const { return box.center(); }

  std::size_t bytes_of_frame(std::size_t frame) const {
    std::size_t bytes = columns.size() * sizeof(double);
    for (const std::size_t n : element_counts[frame])
      bytes += sizeof(float) * ((drawn ? 2 : 1) * 3 * (3 * n + 1) + (rational ? 4 * n : 0) +
                                (sections ? 12 * n : 0) + n + 1) +
               (2 * sizeof(float) + 4 * n) * fields.size();
    return bytes;
  }

 private:
  void add(const ElementRecord& element) {
    const auto weights = element.control_points.row(3);
    for (int i = 0; i < 4; ++i)
      box.extend(Eigen::Vector3d(element.control_points.col(i).head<3>() / weights[i]));
    rational = rational || weights.minCoeff() != weights.maxCoeff();
    drawn = drawn && element.drawn_points.allFinite();
    if (drawn) displacement = std::max(displacement, displacements_of(element).colwise().norm().maxCoeff());
    for (Field& field : fields) field.add(element);
  }
};

/// The beams of one frame; the layout stands in report/src/data.js.
Bytes shape_bytes(const Snapshot& frame, const Survey& survey) {
  Bytes bytes;
  const auto add_point = [&](const ElementRecord& element, int i) {
    const Eigen::Vector4d p = element.control_points.col(i);
    const Eigen::Vector3f local = (p.head<3>() / p[3] - survey.origin()).cast<float>();
    append(bytes, local.data(), 3);
  };
  for (const BeamRecord& beam : frame.beams) {
    for (const ElementRecord& element : beam.elements)
      for (int i = 0; i < 3; ++i) add_point(element, i);
    add_point(beam.elements.back(), 3);
    if (survey.drawn) {
      Eigen::Matrix<float, 3, 4> d;
      for (const ElementRecord& element : beam.elements) {
        d = displacements_of(element).cast<float>();
        append(bytes, d.data(), 9);
      }
      append(bytes, d.col(3).data(), 3);
    }
    for (const ElementRecord& element : beam.elements) {
      if (survey.rational) {
        const Eigen::Vector4f weights = element.control_points.row(3).transpose().cast<float>();
        append(bytes, weights.data(), 4);
      }
    }
    if (survey.sections)
      for (const ElementRecord& element : beam.elements) {
        const Eigen::Matrix<float, 3, 4> d1 = element.d1.cast<float>();
        append(bytes, d1.data(), 12);
      }
    const auto add_float = [&](double value) {
      const auto number = static_cast<float>(value);
      append(bytes, &number, 1);
    };
    for (const ElementRecord& element : beam.elements) add_float(element.s_start);
    add_float(beam.elements.back().s_end);
    std::vector<Field> here;  // with their ranges in this beam and frame
    for (const Field& field : survey.fields) {
      here.push_back({field.name, field.unit, field.values});
      for (const ElementRecord& element : beam.elements) here.back().add(element);
      add_float(here.back().min);
      add_float(here.back().max);
    }
    for (const Field& field : here) {
      for (const ElementRecord& element : beam.elements)
        for (const double value : field.values(element)) bytes.push_back(field.byte_of(value));
    }
  }
  return bytes;
}

// ---- the page ----

/// Calls `use(frame, index)` for all frames; few of them are in memory at a time.
template <class Use>
void for_each_frame(const ReportFrames& frames, Use use) {
  constexpr std::size_t at_once = 16;
  for (std::size_t first = 0; first < frames.times.size(); first += at_once) {
    const std::size_t count = std::min(at_once, frames.times.size() - first);
    const std::vector<Snapshot> piece = frames.read(first, count);
    for (std::size_t i = 0; i < count; ++i) use(piece[i], first + i);
  }
}

/// The frames of modes with the state at rest, frame 0, for a drawing: displacements are then those of
/// shapes.
ReportFrames from_the_state(const ReportFrames& frames) {
  ReportFrames shapes = frames;
  shapes.read = [read = frames.read, state = frames.read(0, 1)[0]](std::size_t first, std::size_t count) {
    std::vector<Snapshot> piece = read(first, count);
    for (Snapshot& frame : piece)
      for (std::size_t b = 0; b < frame.beams.size(); ++b)
        for (std::size_t e = 0; e < frame.beams[b].elements.size(); ++e)
          frame.beams[b].elements[e].drawn_points =
              state.beams[b].elements[e].control_points.colwise().hnormalized();
    return piece;
  };
  return shapes;
}

/// Which frames the page holds: all, or every second, third, ... and the last.
std::vector<std::size_t> kept_frames(const Survey& survey, std::size_t most_bytes) {
  const std::size_t frames = survey.element_counts.size();
  std::size_t bytes = 0;
  for (std::size_t i = 0; i < frames; ++i) bytes += survey.bytes_of_frame(i);
  const std::size_t every = std::max<std::size_t>((bytes + most_bytes - 1) / most_bytes, 1);
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < frames; i += every) kept.push_back(i);
  if (kept.back() != frames - 1) kept.push_back(frames - 1);
  return kept;
}

Json to_json(const Eigen::Vector3d& v) { return Json::array({v.x(), v.y(), v.z()}); }

Json description(const ReportFrames& frames, const Survey& survey, const std::vector<std::size_t>& kept) {
  Json columns = Json::array(), values = Json::array(), fields = Json::array(), errors = Json::array();
  std::vector<double> kept_values;
  for (const Column& column : survey.columns) {
    kept_values.clear();
    for (const std::size_t i : kept) kept_values.push_back(column.values[i]);
    columns.push_back({{"of", column.what.of},
                       {"index", column.what.index},
                       {"name", column.what.quantity},
                       {"unit", column.what.unit}});
    values.push_back(base64_of(kept_values));
    const auto known = frames.errors.find(column.what.heading());
    kept_values.clear();
    if (known != frames.errors.end())
      for (const std::size_t i : kept) kept_values.push_back(known->second[i]);
    errors.push_back(kept_values.empty() ? Json() : Json(base64_of(kept_values)));
  }
  for (const Field& field : survey.fields)
    fields.push_back({{"name", field.name}, {"unit", field.unit}, {"min", field.min}, {"max", field.max}});
  std::vector<std::uint32_t> counts;
  for (const std::size_t i : kept)
    counts.insert(counts.end(), survey.element_counts[i].begin(), survey.element_counts[i].end());
  Json page = {{"title", frames.title},
               {"names",
                {{"probes", frames.names.probes},
                 {"bodies", frames.names.bodies},
                 {"beams", frames.names.beams},
                 {"reactions", frames.names.reactions},
                 {"connectors", frames.names.connectors}}},
               {"stored_frames", frames.times.size()},
               {"box", {to_json(survey.box.min()), to_json(survey.box.max())}},
               {"columns", columns},
               {"values", values},
               {"shapes",
                {{"rational", survey.rational},
                 {"sections", survey.sections},
                 {"displaced", survey.drawn},
                 {"displacement", survey.drawn ? survey.displacement : 0},
                 {"origin", to_json(survey.origin())},
                 {"fields", fields},
                 {"element_counts", base64_of(counts)}}}};
  if (!frames.errors.empty()) page["errors"] = errors;
  return page;
}

/// JSON text that cannot end the <script> element it stands in. "<" occurs only in JSON's strings.
std::string script_text(const Json& json) {
  const std::string plain = json.dump(-1, ' ', false, Json::error_handler_t::replace);
  std::string text;
  text.reserve(plain.size());
  for (const char c : plain)
    if (c == '<')
      text += "\\u003c";
    else
      text += c;
  return text;
}

std::string html_text(const std::string& plain) {
  std::string text;
  for (const char c : plain) text += c == '<' ? "&lt;" : c == '&' ? "&amp;" : std::string(1, c);
  return text;
}

/// Whether no beam has elements: nothing is carried along them.
bool only_guides(const Json& run) {
  const auto model = run.find("model");
  if (model == run.end() || !model->is_object() || !model->contains("beams")) return false;
  const Json& beams = model->at("beams");
  return std::all_of(beams.begin(), beams.end(),
                     [](const Json& beam) { return beam.is_object() && beam.value("rigid", false); });
}

/// What stands before and after a marker of the template.
std::pair<std::string_view, std::string_view> cut(std::string_view text, std::string_view marker) {
  const std::size_t at = text.find(marker);
  return {text.substr(0, at), text.substr(at + marker.size())};
}

}  // namespace

void write_report_page(std::ostream& stream, const ReportFrames& given, const std::string& run_json,
                       std::size_t most_bytes) {
  const Json run = Json::parse(run_json, nullptr, false);
  if (!run.is_object()) throw std::invalid_argument("run.json: is not a JSON object");
  if (given.times.empty()) throw std::invalid_argument("there is no stored frame to report");
  const bool has_modes = run.contains("modes") || run.contains("buckling");
  const ReportFrames frames = has_modes ? from_the_state(given) : given;
  Survey survey;
  survey.columns = empty_columns(frames.names);
  survey.sections = frames.names.sections;
  for_each_frame(frames, [&](const Snapshot& frame, std::size_t) { survey.add(frame); });
  std::erase_if(survey.fields, [guides = only_guides(run)](const Field& field) {
    const std::string_view name = field.name;
    const bool in_no_frame = field.min > field.max, is_nothing = field.min == 0 && field.max == 0;
    return in_no_frame || (is_nothing && (name == "torque" || (guides && name != "curvature")));
  });
  survey.drawn = survey.drawn && !has_modes;  // of any amplitude
  const std::vector<std::size_t> kept = kept_frames(survey, most_bytes);
  Json data = description(frames, survey, kept);
  data["run"] = run;

  const auto [head, after_title] = cut(report_template, "{{title}}");
  const auto [body, tail] = cut(after_title, "{{data}}");
  stream << head << html_text(frames.title) << body << R"(<script type="application/json" id="data">)"
         << script_text(data) << "</script>\n"
         << R"(<script type="text/plain" id="shapes">)";
  for_each_frame(frames, [&](const Snapshot& frame, std::size_t index) {
    if (std::binary_search(kept.begin(), kept.end(), index)) {
      stream << base64_of(shape_bytes(frame, survey));
    }
  });
  stream << "</script>" << tail;
}

namespace {

std::string summary_in(const fs::path& directory) {
  try {
    return checked_json(directory / "run.json");
  } catch (const DamagedError& error) {
    throw std::invalid_argument(error.what());  // bad input
  }
}

// Of the frames that frames() opens.
template <class Frames>
void write_page(const fs::path& directory, Frames frames) {
  const fs::path file = directory / "report.html";
  const auto discard = [&] {
    std::error_code ignored;
    fs::remove(temporary_name(file), ignored);
  };
  const std::string run_json = summary_in(directory);
  std::ofstream stream;
  try {
    const ReportFrames shown = frames();
    errno = 0;
    stream.open(temporary_name(file), std::ios::binary);
    if (stream) write_report_page(stream, shown, run_json);
  } catch (const std::invalid_argument& error) {
    discard();
    throw std::invalid_argument(directory.string() + ": " + error.what());
  } catch (const std::runtime_error& error) {  // of a file, which it names
    discard();
    throw std::invalid_argument(error.what());
  }
  if (stream) stream.close();
  if (!stream) {
    const std::string reason = std::strerror(errno);
    discard();
    throw std::runtime_error(file.string() + ": cannot be written: " + reason);
  }
  publish(file);
}

}  // namespace

void write_report(const fs::path& directory) {
  std::optional<StoredFrames> stored;
  write_page(directory, [&] {
    stored.emplace(directory);
    return ReportFrames{stored->title(), stored->names(), stored->times(),
                        [&](std::size_t first, std::size_t count) { return stored->read(first, count); },
                        errors_of_frames(directory, stored->times())};
  });
}

void write_report(const fs::path& directory, const StoredResults& results) {
  write_page(
      directory,
      [&] {
        std::vector<double> times;
        for (const Snapshot& frame : results.frames) times.push_back(frame.time);
        auto errors = errors_of_frames(directory, times);
        return ReportFrames{results.title, results.names, std::move(times),
                            [&](std::size_t first, std::size_t count) {
                              const auto begin = results.frames.begin() + static_cast<std::ptrdiff_t>(first);
                              return std::vector<Snapshot>(begin, begin + static_cast<std::ptrdiff_t>(count));
                            },
                            std::move(errors)};
      });
}

}  // namespace nurbeam
