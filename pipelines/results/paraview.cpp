#include "pipelines/results/paraview.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cerrno>
#include <charconv>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <limits>
#include <stdexcept>
#include <string>

#include "cad_import/files/atomic_file.h"
#include "pipelines/results/base64.h"
#include "pipelines/results/frame_layout.h"

namespace nurbeam {

namespace {

namespace fs = std::filesystem;

constexpr int vertex_cell = 1, line_cell = 3, hexahedron_cell = 12, bezier_curve_cell = 75;  // VTK's numbers

// An XML file under its temporary name, and its own name once it is whole.
template <class Write>
void write_xml(const fs::path& file, Write write) {
  std::ofstream stream(temporary_name(file));
  stream << "<?xml version=\"1.0\"?>\n";
  write(stream);
  stream.close();
  if (!stream) {
    const std::string reason = std::strerror(errno);
    std::error_code ignored;
    fs::remove(temporary_name(file), ignored);
    throw std::runtime_error(file.string() + ": cannot be written: " + reason);
  }
  publish(file);
}

std::string number(double value) {
  char digits[32];
  return {digits, std::to_chars(digits, digits + sizeof digits, value).ptr};
}

template <class T>
const char* type_name();
template <>
const char* type_name<double>() {
  return "Float64";
}
template <>
const char* type_name<std::int64_t>() {
  return "Int64";
}
template <>
const char* type_name<std::uint8_t>() {
  return "UInt8";
}

template <class T>
void write_array(std::ostream& out, const std::string& name, int components, const std::vector<T>& values) {
  const std::uint64_t size = values.size() * sizeof(T);
  std::string bytes(reinterpret_cast<const char*>(&size), sizeof size);
  bytes.append(reinterpret_cast<const char*>(values.data()), size);
  out << "<DataArray type=\"" << type_name<T>() << "\" Name=\"" << name << "\" NumberOfComponents=\""
      << components << "\" format=\"binary\">" << base64(bytes.data(), bytes.size()) << "</DataArray>\n";
}

// Points and cells of one file; every cell has points of its own, in order.
struct Grid {
  int cell_type = 0, points_per_cell = 0;
  std::vector<double> points;
  struct Field {
    std::string name;
    int components;
    std::vector<double> values;
  };
  std::vector<Field> point_data, cell_data;
};

void write_grid(const fs::path& file, double time, const Grid& grid) {
  const std::size_t point_count = grid.points.size() / 3, cell_count = point_count / grid.points_per_cell;
  std::vector<std::int64_t> connectivity(point_count), offsets(cell_count);
  for (std::size_t i = 0; i < point_count; ++i) connectivity[i] = static_cast<std::int64_t>(i);
  for (std::size_t i = 0; i < cell_count; ++i)
    offsets[i] = static_cast<std::int64_t>(i + 1) * grid.points_per_cell;
  const bool rational = grid.cell_type == bezier_curve_cell;
  write_xml(file, [&](std::ostream& out) {
    out << "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" "
           "header_type=\"UInt64\">\n<UnstructuredGrid>\n<FieldData>\n"
        << "<DataArray type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\" format=\"ascii\">"
        << number(time) << "</DataArray>\n</FieldData>\n"
        << "<Piece NumberOfPoints=\"" << point_count << "\" NumberOfCells=\"" << cell_count
        << "\">\n<PointData" << (rational ? " RationalWeights=\"RationalWeights\"" : "") << ">\n";
    for (const Grid::Field& field : grid.point_data)
      write_array(out, field.name, field.components, field.values);
    out << "</PointData>\n<CellData>\n";
    for (const Grid::Field& field : grid.cell_data)
      write_array(out, field.name, field.components, field.values);
    out << "</CellData>\n<Points>\n";
    write_array(out, "Points", 3, grid.points);
    out << "</Points>\n<Cells>\n";
    write_array(out, "connectivity", 1, connectivity);
    write_array(out, "offsets", 1, offsets);
    write_array(out, "types", 1,
                std::vector<std::uint8_t>(cell_count, static_cast<std::uint8_t>(grid.cell_type)));
    out << "</Cells>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
  });
}

// VTK's order of the points of a curve: its ends, then what is between them.
constexpr int vtk_order[] = {0, 3, 1, 2};

// The vectors of an element: its velocity, and with torsion its section's axes.
std::vector<SampledVector> sampled_vectors(bool sections) {
  constexpr SampledVector velocity[] = {{"velocity", "m s-1", "velocity", &ElementRecord::velocity}};
  return with_own_axes(velocity, section_axes, sections);
}

Grid beam_grid(const std::vector<BeamRecord>& beams, bool sections) {
  Grid grid{.cell_type = bezier_curve_cell, .points_per_cell = 4};
  grid.point_data = {{"RationalWeights", 1, {}}};
  const auto fields = with_own_axes(sampled_fields, own_axes_fields, sections);
  const auto vectors = sampled_vectors(sections);
  for (const SampledField& field : fields) grid.point_data.push_back({field.name, 1, {}});
  for (const SampledVector& vector : vectors) grid.point_data.push_back({vector.name, 3, {}});
  grid.cell_data = {
      {"beam", 1, {}}, {"element", 1, {}}, {"s_start", 1, {}}, {"s_end", 1, {}}, {"axial_mismatch", 1, {}}};
  for (std::size_t b = 0; b < beams.size(); ++b)
    for (std::size_t i = 0; i < beams[b].elements.size(); ++i) {
      const ElementRecord& e = beams[b].elements[i];
      const Eigen::Vector4d weights = e.control_points.row(3);
      for (const int k : vtk_order) {
        const Eigen::Vector3d p = e.control_points.col(k).head<3>() / weights[k];
        grid.points.insert(grid.points.end(), p.begin(), p.end());
        grid.point_data[0].values.push_back(weights[k]);
      }
      const auto add = [&](Grid::Field& field, const auto& samples) {  // a row each component
        Eigen::Matrix4Xd values(4, samples.rows());
        for (int row = 0; row < samples.rows(); ++row)
          values.col(row) = rational_coefficients(samples.row(row).transpose(), weights);
        for (const int k : vtk_order)
          for (int row = 0; row < samples.rows(); ++row) field.values.push_back(values(k, row));
      };
      auto field = grid.point_data.begin() + 1;
      for (const SampledField& sampled : fields) add(*field++, (e.*sampled.values).transpose());
      for (const SampledVector& sampled : vectors) add(*field++, e.*sampled.values);
      const double of_cell[] = {static_cast<double>(b), static_cast<double>(i), e.s_start, e.s_end,
                                e.axial_mismatch};
      for (int k = 0; k < 5; ++k) grid.cell_data[k].values.push_back(of_cell[k]);
    }
  return grid;
}

void append(std::vector<double>& values, const Eigen::Vector3d& x) {
  values.insert(values.end(), x.begin(), x.end());
}

Grid reaction_grid(const std::vector<ReactionRecord>& reactions) {
  Grid grid{.cell_type = vertex_cell, .points_per_cell = 1};
  grid.point_data = {{"force", 3, {}}, {"couple", 3, {}}};
  grid.cell_data = {{"reaction", 1, {}}};
  for (const ReactionRecord& reaction : reactions) {
    append(grid.points, reaction.position);
    append(grid.point_data[0].values, reaction.force);
    append(grid.point_data[1].values, reaction.couple);
    grid.cell_data[0].values.push_back(static_cast<double>(grid.cell_data[0].values.size()));
  }
  return grid;
}

Grid body_grid(const std::vector<BodyRecord>& bodies) {
  Grid grid{.cell_type = vertex_cell, .points_per_cell = 1};
  grid.point_data = {{"velocity", 3, {}}, {"joint_force", 3, {}}, {"s", 1, {}}};
  grid.cell_data = {{"body", 1, {}}};
  for (const BodyRecord& body : bodies) {
    append(grid.points, body.point.position);
    append(grid.point_data[0].values, body.point.velocity);
    append(grid.point_data[1].values, body.joint_force);
    grid.point_data[2].values.push_back(body.s.value_or(std::numeric_limits<double>::quiet_NaN()));
    grid.cell_data[0].values.push_back(static_cast<double>(grid.cell_data[0].values.size()));
  }
  return grid;
}

// Boxes about rigid bodies; VTK counts the corners of a hexahedron round its bottom, then round its top.
Grid box_grid(const std::vector<BodyRecord>& bodies, const std::vector<Eigen::Matrix3d>& boxes) {
  constexpr int corners[8][3] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},
                                 {-1, -1, 1},  {1, -1, 1},  {1, 1, 1},  {-1, 1, 1}};
  Grid grid{.cell_type = hexahedron_cell, .points_per_cell = 8};
  grid.cell_data = {{"body", 1, {}}};
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    if (boxes[i].isZero(0) || !bodies.at(i).turn) continue;
    const Eigen::Vector4d& q = bodies[i].turn->attitude;
    const Eigen::Matrix3d edges = Eigen::Quaterniond(q[0], q[1], q[2], q[3]).normalized() * boxes[i];
    for (const auto& [x, y, z] : corners)
      append(grid.points, Eigen::Vector3d(bodies[i].point.position + edges * Eigen::Vector3d(x, y, z)));
    grid.cell_data[0].values.push_back(static_cast<double>(i));
  }
  return grid;
}

Grid connector_grid(const std::vector<ConnectorRecord>& connectors) {
  Grid grid{.cell_type = line_cell, .points_per_cell = 2};
  grid.cell_data = {{"force", 1, {}}, {"length", 1, {}}, {"connector", 1, {}}};
  for (const ConnectorRecord& connector : connectors) {
    append(grid.points, connector.from);
    append(grid.points, connector.to);
    grid.cell_data[0].values.push_back(connector.force);
    grid.cell_data[1].values.push_back(connector.length);
    grid.cell_data[2].values.push_back(static_cast<double>(grid.cell_data[2].values.size()));
  }
  return grid;
}

}  // namespace

Eigen::Vector4d rational_coefficients(const Eigen::Vector4d& samples, const Eigen::Vector4d& weights) {
  static const Eigen::Matrix4d bernstein = [] {  // row i: the values at u = i/3
    Eigen::Matrix4d values;
    for (int i = 0; i < 4; ++i) {
      const double u = i / 3.0, v = 1 - u;
      values.row(i) << v * v * v, 3 * u * v * v, 3 * u * u * v, u * u * u;
    }
    return values;
  }();
  static const Eigen::Matrix4d inverse = bernstein.inverse();
  return (inverse * samples.cwiseProduct(bernstein * weights)).cwiseQuotient(weights);
}

ParaviewSeries::ParaviewSeries(fs::path directory, SnapshotNames names, std::vector<double> times,
                               const std::string& name, std::vector<Eigen::Matrix3d> boxes)
    : directory_(std::move(directory)),
      index_((name.empty() ? "frames" : name) + ".pvd"),
      prefix_(name.empty() ? "" : name + "_"),
      names_(std::move(names)),
      times_(std::move(times)),
      boxes_(std::move(boxes)) {
  std::error_code error;
  fs::create_directory(directory_ / "frames", error);
  if (error)
    throw std::runtime_error((directory_ / "frames").string() + ": cannot be made: " + error.message());
}

std::string ParaviewSeries::frame_file(const char* kind, std::size_t frame) const {
  char end[64];
  std::snprintf(end, sizeof end, "%s_%06zu.vtu", kind, frame);
  return "frames/" + prefix_ + end;
}

void ParaviewSeries::write(const Snapshot& frame) {
  const std::size_t i = times_.size();
  write_grid(directory_ / frame_file("beams", i), frame.time, beam_grid(frame.beams, names_.sections));
  if (!names_.bodies.empty())
    write_grid(directory_ / frame_file("bodies", i), frame.time, body_grid(frame.bodies));
  if (!names_.reactions.empty())
    write_grid(directory_ / frame_file("reactions", i), frame.time, reaction_grid(frame.reactions));
  if (!names_.connectors.empty())
    write_grid(directory_ / frame_file("connectors", i), frame.time, connector_grid(frame.connectors));
  if (!boxes_.empty())
    write_grid(directory_ / frame_file("boxes", i), frame.time, box_grid(frame.bodies, boxes_));
  times_.push_back(frame.time);
}

void ParaviewSeries::write_index() const {
  write_xml(
      directory_ / index_,
      [&](std::ostream& out) {
        out << "<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n<Collection>\n";
        const auto entry = [&](std::size_t frame, int part, const char* kind) {
          out << "<DataSet timestep=\"" << number(times_[frame]) << "\" part=\"" << part << "\" name=\""
              << kind << "\" file=\"" << frame_file(kind, frame) << "\"/>\n";
        };
        for (std::size_t i = 0; i < times_.size(); ++i) {
          entry(i, 0, "beams");
          if (!names_.bodies.empty()) entry(i, 1, "bodies");
          if (!names_.reactions.empty()) entry(i, 2, "reactions");
          if (!names_.connectors.empty()) entry(i, 3, "connectors");
          if (!boxes_.empty()) entry(i, 4, "boxes");
        }
        out << "</Collection>\n</VTKFile>\n";
      });
}

}  // namespace nurbeam
