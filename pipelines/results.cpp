#include "pipelines/results.h"

#include <netcdf.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace nurbeam {

namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& file, const std::string& reason) {
  throw std::runtime_error(file.string() + ": " + reason);
}

fs::path temporary_name(const fs::path& file) { return file.string() + ".part"; }

void rename_to(const fs::path& file) {
  std::error_code error;
  fs::rename(temporary_name(file), file, error);
  if (error) {
    fail(file, "cannot be renamed from its temporary name: " + error.message());
  }
}

// ---- histories.csv ----

/// histories.csv under its temporary name: a header, then one row per frame.
class HistoryTable {
 public:
  HistoryTable(const fs::path& file, const FrameNames& names) : file_(file), stream_(temporary_name(file)) {
    row_ = "time [s]";
    for (const std::string& name : names.probes) {
      add_point_columns(name);
    }
    for (const std::string& name : names.bodies) {
      add_point_columns(name);
      row_ += "," + name + ".s [m]";
    }
    for (const std::string& name : names.beams) {
      row_ += "," + name + ".length [m]";
    }
    for (const char* part : {"kinetic", "gravity", "axial", "bending", "dissipated", "total"}) {
      row_ += std::string(",energy.") + part + " [J]";
    }
    write_row();
  }

  void write(const Frame& frame) {
    add_number(frame.time);
    for (const PointRecord& probe : frame.probes) {
      add_point(probe);
    }
    for (const BodyRecord& body : frame.bodies) {
      add_point(body.point);
      row_ += ',';
      if (body.s) {
        add_number(*body.s);
      }
    }
    for (const BeamRecord& beam : frame.beams) {
      row_ += ',';
      add_number(beam.length);
    }
    const EnergyRecord& e = frame.energy;
    for (const double value : {e.kinetic, e.gravity, e.axial, e.bending, e.dissipated, e.total}) {
      row_ += ',';
      add_number(value);
    }
    write_row();
  }

  void close() {
    stream_.close();
    check_stream();
  }

 private:
  void add_point_columns(const std::string& name) {
    for (const char* column : {".x [m]", ".y [m]", ".z [m]", ".vx [m/s]", ".vy [m/s]", ".vz [m/s]"}) {
      row_ += "," + name + column;
    }
  }

  void add_point(const PointRecord& point) {
    for (const Eigen::Vector3d& vector : {point.position, point.velocity}) {
      for (const double value : vector) {
        row_ += ',';
        add_number(value);
      }
    }
  }

  /// Appends a number with the 17 digits that give it back exactly, with a decimal point in every locale.
  void add_number(double value) {
    char digits[32];
    const auto end = std::to_chars(digits, digits + sizeof digits, value, std::chars_format::general, 17).ptr;
    row_.append(digits, end);
  }

  void write_row() {
    stream_ << row_ << '\n' << std::flush;
    row_.clear();
    check_stream();
  }

  void check_stream() {
    if (!stream_) {
      fail(file_, std::string("cannot be written: ") + std::strerror(errno));
    }
  }

  fs::path file_;
  std::ofstream stream_;
  std::string row_;
};

// ---- netCDF ----

/// An open netCDF file; every call that fails throws std::runtime_error with the file and the reason.
class NetcdfFile {
 public:
  using Sizes = std::vector<std::size_t>;

  static NetcdfFile create(const fs::path& file) {
    int id = -1;
    const int status = nc_create(file.c_str(), NC_NETCDF4 | NC_CLOBBER, &id);
    return {file, id, status};
  }
  static NetcdfFile open(const fs::path& file) {
    int id = -1;
    const int status = nc_open(file.c_str(), NC_NOWRITE, &id);
    return {file, id, status};
  }
  NetcdfFile(NetcdfFile&& other) noexcept
      : file_(std::move(other.file_)), id_(std::exchange(other.id_, -1)) {}
  NetcdfFile& operator=(NetcdfFile&&) = delete;
  ~NetcdfFile() {
    if (id_ >= 0) {
      nc_close(id_);
    }
  }

  void define_dimension(const std::string& name, std::size_t size) {
    int dimension;
    check(nc_def_dim(id_, name.c_str(), size, &dimension), name);
  }

  /// A compressed variable; `chunk` rows of its first dimension lie together in the file.
  void define(const std::string& name, nc_type type, const std::vector<std::string>& dimensions,
              const std::string& unit, const std::string& long_name, std::size_t chunk) {
    const int variable = define_variable(name, type, dimensions);
    Sizes chunks(dimensions.size());
    for (std::size_t i = 0; i < dimensions.size(); ++i) {
      chunks[i] = i == 0 ? chunk : size(dimensions[i]);
    }
    check(nc_def_var_chunking(id_, variable, NC_CHUNKED, chunks.data()), name);
    constexpr int shuffle = 1, deflate = 1, level = 4;
    check(nc_def_var_deflate(id_, variable, shuffle, deflate, level), name);
    put_attribute(name, "units", unit);
    put_attribute(name, "long_name", long_name);
  }

  void define_texts(const std::string& name, const std::string& dimension,
                    const std::vector<std::string>& texts) {
    const int variable = define_variable(name, NC_STRING, {dimension});
    std::vector<const char*> pointers;
    for (const std::string& text : texts) {
      pointers.push_back(text.c_str());
    }
    check(nc_put_var_string(id_, variable, pointers.data()), name);
  }

  /// An attribute of a variable; of the file for "".
  void put_attribute(const std::string& variable, const std::string& name, const std::string& text) {
    const int owner = variable.empty() ? NC_GLOBAL : this->variable(variable);
    check(nc_put_att_text(id_, owner, name.c_str(), text.size(), text.c_str()), name);
  }

  void put(const std::string& name, const Sizes& start, const Sizes& count, const double* values) {
    check(nc_put_vara_double(id_, variable(name), start.data(), count.data(), values), name);
  }
  void put(const std::string& name, const Sizes& start, const Sizes& count, const int* values) {
    check(nc_put_vara_int(id_, variable(name), start.data(), count.data(), values), name);
  }
  std::vector<double> doubles(const std::string& name, const Sizes& start, const Sizes& count) const {
    std::vector<double> values(product(count));
    check(nc_get_vara_double(id_, variable(name), start.data(), count.data(), values.data()), name);
    return values;
  }
  std::vector<int> integers(const std::string& name, const Sizes& start, const Sizes& count) const {
    std::vector<int> values(product(count));
    check(nc_get_vara_int(id_, variable(name), start.data(), count.data(), values.data()), name);
    return values;
  }
  std::string text(const std::string& name, std::size_t index) const {
    char* text = nullptr;
    check(nc_get_var1_string(id_, variable(name), &index, &text), name);
    const std::string copy = text;
    nc_free_string(1, &text);
    return copy;
  }
  std::size_t size(const std::string& dimension) const {
    std::size_t size = 0;
    check(nc_inq_dimlen(id_, this->dimension(dimension), &size), dimension);
    return size;
  }

  void sync() { check(nc_sync(id_), "sync"); }
  void close() { check(nc_close(std::exchange(id_, -1)), "close"); }

 private:
  NetcdfFile(fs::path file, int id, int status) : file_(std::move(file)), id_(id) {
    if (status != NC_NOERR) {
      id_ = -1;
      fail(file_, reason_of(status));
    }
  }

  /// netCDF hides a full disk behind codes of its own.
  static std::string reason_of(int status) {
    const bool is_full = errno == ENOSPC || errno == EDQUOT || errno == EFBIG;
    return is_full ? std::strerror(errno) : nc_strerror(status);
  }

  void check(int status, const std::string& what) const {
    if (status != NC_NOERR) {
      fail(file_, what + ": " + reason_of(status));
    }
  }
  int dimension(const std::string& name) const {
    int dimension = -1;
    check(nc_inq_dimid(id_, name.c_str(), &dimension), name);
    return dimension;
  }
  int variable(const std::string& name) const {
    int variable = -1;
    check(nc_inq_varid(id_, name.c_str(), &variable), name);
    return variable;
  }
  int define_variable(const std::string& name, nc_type type, const std::vector<std::string>& dimensions) {
    std::vector<int> ids;
    for (const std::string& each : dimensions) {
      ids.push_back(dimension(each));
    }
    int variable = -1;
    check(nc_def_var(id_, name.c_str(), type, static_cast<int>(ids.size()), ids.data(), &variable), name);
    return variable;
  }
  static std::size_t product(const Sizes& count) {
    std::size_t product = 1;
    for (const std::size_t n : count) {
      product *= n;
    }
    return product;
  }

  fs::path file_;
  int id_;
};

// ---- results.nc ----

constexpr std::size_t time_chunk = 128, element_chunk = 256;

/// results.nc under its temporary name; the layout stands in results.h.
class FrameStore {
 public:
  FrameStore(const fs::path& file, const FrameNames& names, const std::string& title)
      : file_(NetcdfFile::create(temporary_name(file))) {
    file_.put_attribute("", "Conventions", "CF-1.8");
    file_.put_attribute("", "title", title);
    file_.put_attribute("", "source", "nurbeam " NURBEAM_VERSION);
    file_.define_dimension("time", NC_UNLIMITED);
    file_.define_dimension("xyz", 3);
    define_scalars();
    define_points("probe", names.probes);
    define_points("body", names.bodies);
    if (!names.bodies.empty()) {
      define_of_time("body_joint_force", {"body", "xyz"}, "N", "force of the beam on the body");
      define_of_time("body_s", {"body"}, "m", "reference arc length of the body from the start of its beam");
    }
    define_beams(names.beams);
    file_.sync();
  }

  void write(const Frame& frame) {
    const auto put_scalar = [&](const char* name, auto value) { file_.put(name, {frames_}, {1}, &value); };
    put_scalar("time", frame.time);
    put_scalar("step", frame.step);
    put_scalar("newton_iterations", frame.newton_iterations);
    put_scalar("energy_kinetic", frame.energy.kinetic);
    put_scalar("energy_gravity", frame.energy.gravity);
    put_scalar("energy_axial", frame.energy.axial);
    put_scalar("energy_bending", frame.energy.bending);
    put_scalar("energy_dissipated", frame.energy.dissipated);
    put_scalar("energy_total", frame.energy.total);
    for (std::size_t i = 0; i < frame.probes.size(); ++i) {
      put_point("probe", i, frame.probes[i]);
    }
    for (std::size_t i = 0; i < frame.bodies.size(); ++i) {
      put_body(i, frame.bodies[i]);
    }
    for (std::size_t i = 0; i < frame.beams.size(); ++i) {
      put_beam(i, frame.beams[i]);
    }
    ++frames_;
    file_.sync();
  }

  void close() { file_.close(); }

 private:
  void define_of_time(const std::string& name, std::vector<std::string> dimensions, const std::string& unit,
                      const std::string& long_name, nc_type type = NC_DOUBLE) {
    dimensions.insert(dimensions.begin(), "time");
    file_.define(name, type, dimensions, unit, long_name, time_chunk);
  }

  void define_scalars() {
    define_of_time("time", {}, "s", "time");
    file_.put_attribute("time", "axis", "T");
    define_of_time("step", {}, "s", "last step size");
    define_of_time("newton_iterations", {}, "1", "Newton iterations since the previous frame", NC_INT);
    for (const std::string part : {"kinetic", "gravity", "axial", "bending", "dissipated", "total"}) {
      define_of_time("energy_" + part, {}, "J", part + " energy");
    }
  }

  void define_points(const std::string& kind, const std::vector<std::string>& names) {
    if (names.empty()) {
      return;
    }
    file_.define_dimension(kind, names.size());
    file_.define_texts(kind + "_name", kind, names);
    define_of_time(kind + "_position", {kind, "xyz"}, "m", "position of the " + kind);
    define_of_time(kind + "_velocity", {kind, "xyz"}, "m s-1", "velocity of the " + kind);
  }

  void define_beams(const std::vector<std::string>& names) {
    if (names.empty()) {
      return;
    }
    file_.define_dimension("beam", names.size());
    file_.define_dimension("element", NC_UNLIMITED);
    file_.define_dimension("node", NC_UNLIMITED);
    file_.define_dimension("control_point", 4);
    file_.define_dimension("homogeneous", 4);
    file_.define_texts("beam_name", "beam", names);
    define_of_time("beam_length", {"beam"}, "m", "deformed length of the beam");
    define_of_time("element_count", {"beam"}, "1", "number of elements of the beam", NC_INT);
    define_of_time("node_count", {"beam"}, "1", "number of nodes of the beam", NC_INT);
    file_.put_attribute("element_count", "sample_dimension", "element");
    file_.put_attribute("node_count", "sample_dimension", "node");
    const auto define = [&](const char* name, const std::vector<std::string>& dimensions, const char* unit,
                            const char* long_name) {
      file_.define(name, NC_DOUBLE, dimensions, unit, long_name, element_chunk);
    };
    define("control_points", {"element", "control_point", "homogeneous"}, "m",
           "deformed rational cubic as (w x, w y, w z, w); the weight w has no unit");
    define("element_s_start", {"element"}, "m", "reference arc length at the element's start");
    define("element_s_end", {"element"}, "m", "reference arc length at the element's end");
    define("node_position", {"node", "xyz"}, "m", "position of the node");
    define("node_slope", {"node", "xyz"}, "1",
           "derivative of position by reference arc length, left at a kink");
    define("node_s", {"node"}, "m", "reference arc length of the node");
  }

  void put_point(const std::string& kind, std::size_t index, const PointRecord& point) {
    file_.put(kind + "_position", {frames_, index, 0}, {1, 1, 3}, point.position.data());
    file_.put(kind + "_velocity", {frames_, index, 0}, {1, 1, 3}, point.velocity.data());
  }

  void put_body(std::size_t index, const BodyRecord& body) {
    put_point("body", index, body.point);
    file_.put("body_joint_force", {frames_, index, 0}, {1, 1, 3}, body.joint_force.data());
    const double s = body.s.value_or(NC_FILL_DOUBLE);
    file_.put("body_s", {frames_, index}, {1, 1}, &s);
  }

  void put_beam(std::size_t index, const BeamRecord& beam) {
    file_.put("beam_length", {frames_, index}, {1, 1}, &beam.length);
    const int element_count = static_cast<int>(beam.elements.size());
    const int node_count = static_cast<int>(beam.node_s.size());
    file_.put("element_count", {frames_, index}, {1, 1}, &element_count);
    file_.put("node_count", {frames_, index}, {1, 1}, &node_count);
    for (const ElementRecord& element : beam.elements) {
      // Columns are control points and Eigen stores by columns: the order (control_point, homogeneous).
      file_.put("control_points", {elements_, 0, 0}, {1, 4, 4}, element.control_points.data());
      file_.put("element_s_start", {elements_}, {1}, &element.s_start);
      file_.put("element_s_end", {elements_}, {1}, &element.s_end);
      ++elements_;
    }
    for (std::size_t i = 0; i < beam.node_s.size(); ++i, ++nodes_) {
      file_.put("node_position", {nodes_, 0}, {1, 3}, beam.node_positions[i].data());
      file_.put("node_slope", {nodes_, 0}, {1, 3}, beam.node_slopes[i].data());
      file_.put("node_s", {nodes_}, {1}, &beam.node_s[i]);
    }
  }

  NetcdfFile file_;
  std::size_t frames_ = 0, elements_ = 0, nodes_ = 0;
};

void check_count(const char* what, std::size_t found, std::size_t expected) {
  if (found != expected) {
    throw std::invalid_argument(std::string("a frame with ") + std::to_string(found) + " " + what +
                                "; expected " + std::to_string(expected));
  }
}

fs::path created(const fs::path& directory) {
  std::error_code error;
  fs::create_directories(directory, error);
  if (error || !fs::is_directory(directory)) {
    fail(directory, "cannot be made a directory" + (error ? ": " + error.message() : std::string()));
  }
  return directory;
}

/// Index of the stored time nearest to `time`; throws unless it lies in the stored range.
std::size_t nearest_frame(const fs::path& file, const std::vector<double>& times, double time) {
  if (times.empty()) {
    fail(file, "holds no frame");
  }
  const double slack = 1e-9 * std::max(std::abs(times.front()), std::abs(times.back()));
  if (!(time >= times.front() - slack && time <= times.back() + slack)) {
    std::ostringstream reason;
    reason << "time " << time << " s is not stored; expected one from " << times.front() << " s to "
           << times.back() << " s";
    fail(file, reason.str());
  }
  const auto nearest = std::min_element(times.begin(), times.end(), [&](double a, double b) {
    return std::abs(a - time) < std::abs(b - time);
  });
  return nearest - times.begin();
}

std::vector<ElementRecord> read_elements(const NetcdfFile& file, std::size_t first, std::size_t count) {
  const std::vector<double> points = file.doubles("control_points", {first, 0, 0}, {count, 4, 4});
  const std::vector<double> s_start = file.doubles("element_s_start", {first}, {count});
  const std::vector<double> s_end = file.doubles("element_s_end", {first}, {count});
  std::vector<ElementRecord> elements(count);
  for (std::size_t i = 0; i < count; ++i) {
    elements[i] = {Eigen::Map<const Eigen::Matrix4d>(points.data() + 16 * i), s_start[i], s_end[i]};
  }
  return elements;
}

}  // namespace

struct ResultsWriter::Implementation {
  fs::path histories_file, store_file;
  FrameNames names;
  std::optional<HistoryTable> histories;
  std::optional<FrameStore> store;

  /// Removes the files if writing fails: what could not be written to its end is of no use.
  template <class Write>
  void write_or_remove(Write write) const {
    try {
      write();
    } catch (const std::runtime_error&) {
      std::error_code ignored;
      fs::remove(temporary_name(histories_file), ignored);
      fs::remove(temporary_name(store_file), ignored);
      throw;
    }
  }
};

ResultsWriter::ResultsWriter(fs::path directory, FrameNames names, std::string title)
    : implementation_(std::make_unique<Implementation>()) {
  Implementation& files = *implementation_;
  files.histories_file = created(directory) / "histories.csv";
  files.store_file = directory / "results.nc";
  files.names = std::move(names);
  files.write_or_remove([&] {
    files.histories.emplace(files.histories_file, files.names);
    files.store.emplace(files.store_file, files.names, title);
  });
}

ResultsWriter::~ResultsWriter() = default;

void ResultsWriter::write(const Frame& frame) {
  Implementation& files = *implementation_;
  check_count("probes", frame.probes.size(), files.names.probes.size());
  check_count("bodies", frame.bodies.size(), files.names.bodies.size());
  check_count("beams", frame.beams.size(), files.names.beams.size());
  files.write_or_remove([&] {
    files.histories->write(frame);
    files.store->write(frame);
  });
}

void ResultsWriter::finish() {
  Implementation& files = *implementation_;
  files.write_or_remove([&] {
    files.histories->close();
    files.store->close();
  });
  rename_to(files.histories_file);
  rename_to(files.store_file);
}

std::pair<double, std::vector<StoredBeam>> read_stored_beams(const fs::path& directory, double time) {
  const fs::path path = directory / "results.nc";
  if (!fs::exists(path) && fs::exists(temporary_name(path))) {
    fail(path,
         "does not exist: the run was not finished; its frames are in " + temporary_name(path).string());
  }
  const NetcdfFile file = NetcdfFile::open(path);
  const std::size_t frames = file.size("time"), beam_count = file.size("beam");
  const std::vector<double> times = file.doubles("time", {0}, {frames});
  const std::size_t frame = nearest_frame(path, times, time);
  const std::vector<int> counts = file.integers("element_count", {0, 0}, {frame + 1, beam_count});
  std::size_t first = 0;  // the ragged rows before this frame
  for (std::size_t i = 0; i < frame * beam_count; ++i) {
    first += counts[i];
  }
  std::vector<StoredBeam> beams;
  for (std::size_t beam = 0; beam < beam_count; ++beam) {
    const std::size_t count = counts[frame * beam_count + beam];
    beams.push_back({file.text("beam_name", beam), read_elements(file, first, count)});
    first += count;
  }
  return {times[frame], beams};
}

}  // namespace nurbeam
