#include "pipelines/results/history_table.h"

#include <cerrno>
#include <charconv>
#include <cstring>
#include <stdexcept>

namespace nurbeam {

HistoryTable::HistoryTable(const std::filesystem::path& file, const SnapshotNames& names)
    : file_(file), stream_(file) {
  row_ = "time [s]";
  for (const std::string& name : names.probes) add_point_columns(name);
  for (const std::string& name : names.bodies) {
    add_point_columns(name);
    row_ += "," + name + ".s [m]";
  }
  for (const std::string& name : names.beams) row_ += "," + name + ".length [m]";
  for (const char* part : {"kinetic", "gravity", "axial", "bending", "dissipated", "total", "input"})
    row_ += std::string(",energy.") + part + " [J]";
  write_row();
}

void HistoryTable::write(const Snapshot& frame) {
  add_number(frame.time);
  for (const PointRecord& probe : frame.probes) add_point(probe);
  for (const BodyRecord& body : frame.bodies) {
    add_point(body.point);
    row_ += ',';
    if (body.s) add_number(*body.s);
  }
  for (const BeamRecord& beam : frame.beams) {
    row_ += ',';
    add_number(beam.length);
  }
  const EnergyRecord& e = frame.energy;
  for (const double value : {e.kinetic, e.gravity, e.axial, e.bending, e.dissipated, e.total, e.input}) {
    row_ += ',';
    add_number(value);
  }
  write_row();
}

void HistoryTable::close() {
  stream_.close();
  check_stream();
}

void HistoryTable::add_point_columns(const std::string& name) {
  for (const char* column : {".x [m]", ".y [m]", ".z [m]", ".vx [m/s]", ".vy [m/s]", ".vz [m/s]"})
    row_ += "," + name + column;
}

void HistoryTable::add_point(const PointRecord& point) {
  for (const Eigen::Vector3d& vector : {point.position, point.velocity}) {
    for (const double value : vector) {
      row_ += ',';
      add_number(value);
    }
  }
}

// Appends a number with the 17 digits that give it back exactly, with a decimal point in every locale.
void HistoryTable::add_number(double value) {
  char digits[32];
  const auto end = std::to_chars(digits, digits + sizeof digits, value, std::chars_format::general, 17).ptr;
  row_.append(digits, end);
}

void HistoryTable::write_row() {
  stream_ << row_ << '\n' << std::flush;
  row_.clear();
  check_stream();
}

void HistoryTable::check_stream() const {
  if (!stream_) throw std::runtime_error(file_.string() + ": cannot be written: " + std::strerror(errno));
}

}  // namespace nurbeam
