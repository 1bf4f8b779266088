#include "pipelines/results/restart_file.h"

#include <algorithm>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "cad_import/files/atomic_file.h"
#include "pipelines/results/checksum.h"
#include "pipelines/results/netcdf_file.h"

namespace nurbeam {

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// The name of the attribute that holds a text of a list.
std::string numbered(const std::string& name, std::size_t index) {
  return name + "_" + std::to_string(index);
}

Eigen::VectorXd vector_of(const std::vector<double>& values) {
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

/// Writes named lists of numbers and of texts; an empty list is left out.
class Writer {
 public:
  explicit Writer(const std::filesystem::path& file) : file_(NetcdfFile::create_classic(file)) {
    file_.put_attribute("", "title", "restart point");
    file_.put_attribute("", "source", "nurbeam " NURBEAM_VERSION);
    file_.put_attribute("", "checksum", std::string(checksum_attribute));
  }

  void numbers(const std::string& name, const std::string& meaning,
               std::shared_ptr<const Eigen::VectorXd> values) {
    if (values->size() == 0) return;
    const std::string dimension = name + "_count";
    file_.define_dimension(dimension, static_cast<std::size_t>(values->size()));
    file_.define_plain(name, NetcdfFile::Type::real, {dimension}, "SI", meaning);
    numbers_.emplace_back(name, std::move(values));
  }
  void numbers(const std::string& name, const std::string& meaning, Eigen::VectorXd values) {
    numbers(name, meaning, std::make_shared<const Eigen::VectorXd>(std::move(values)));
  }
  void texts(const std::string& name, std::vector<std::string>& values) {
    if (values.empty()) return;
    file_.define_dimension(name + "_count", values.size());
    for (std::size_t i = 0; i < values.size(); ++i) file_.put_attribute("", numbered(name, i), values[i]);
  }
  void close() {
    for (const auto& [name, values] : numbers_)
      file_.put(name, {0}, {static_cast<std::size_t>(values->size())}, values->data());
    file_.close();
  }

 private:
  NetcdfFile file_;
  /// Put when all are defined.
  std::vector<std::pair<std::string, std::shared_ptr<const Eigen::VectorXd>>> numbers_;
};

class Reader {
 public:
  explicit Reader(const std::filesystem::path& file) : file_(NetcdfFile::open(file)) {}

  void numbers(const std::string& name, const std::string&, std::vector<double>& values) {
    values.clear();
    if (file_.has_dimension(name + "_count"))
      values = file_.doubles(name, {0}, {file_.size(name + "_count")});
  }
  void texts(const std::string& name, std::vector<std::string>& values) {
    values.clear();
    if (!file_.has_dimension(name + "_count")) return;
    values.resize(file_.size(name + "_count"));
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = file_.attribute("", numbered(name, i));
  }

 private:
  NetcdfFile file_;
};

/// A row of numbers: what `visit(row, slot)` calls slot with, in order. The same visit writes and reads.
class RowWriter {
 public:
  explicit RowWriter(std::vector<double>& values) : values_(&values) {}
  template <class T>
  void operator()(T& value) {
    values_->push_back(static_cast<double>(value));
  }
  void operator()(std::optional<double>& value) { values_->push_back(value.value_or(none)); }

 private:
  std::vector<double>* values_;
};

class RowReader {
 public:
  explicit RowReader(const std::vector<double>& values) : values_(&values) {}
  template <class T>
  void operator()(T& value) {
    value = static_cast<T>(next());
  }
  void operator()(std::optional<double>& value) {
    const double x = next();
    value = x == x ? std::optional(x) : std::nullopt;
  }
  bool at_end() const { return next_ == values_->size(); }

 private:
  double next() { return values_->at(next_++); }

  const std::vector<double>* values_;
  std::size_t next_ = 0;
};

template <class Row, class Visit>
void exchange_rows(Writer& archive, const std::string& name, const std::string& meaning,
                   std::vector<Row>& rows, Visit visit) {
  std::vector<double> values;
  RowWriter slot(values);
  for (Row& row : rows) visit(row, slot);
  archive.numbers(name, meaning, vector_of(values));
}

template <class Row, class Visit>
void exchange_rows(Reader& archive, const std::string& name, const std::string& meaning,
                   std::vector<Row>& rows, Visit visit) {
  std::vector<double> values;
  archive.numbers(name, meaning, values);
  rows.clear();
  for (RowReader slot(values); !slot.at_end();) visit(rows.emplace_back(), slot);
}

// Long ones: the archive takes them.
void exchange_vector(Writer& archive, const std::string& name, const std::string& meaning,
                     Eigen::VectorXd& x) {
  archive.numbers(name, meaning, std::move(x));
}

void exchange_vector(Reader& archive, const std::string& name, const std::string& meaning,
                     Eigen::VectorXd& x) {
  std::vector<double> values;
  archive.numbers(name, meaning, values);
  x = vector_of(values);
}

// The same where others look at the whole, which is not changed where it is written.
void exchange_vector(Writer& archive, const std::string& name, const std::string& meaning,
                     const std::shared_ptr<Linearisation>& whole, Eigen::VectorXd& x) {
  archive.numbers(name, meaning, std::shared_ptr<const Eigen::VectorXd>(whole, &x));
}

void exchange_vector(Reader& archive, const std::string& name, const std::string& meaning,
                     const std::shared_ptr<Linearisation>&, Eigen::VectorXd& x) {
  exchange_vector(archive, name, meaning, x);
}

struct PresentNode {
  int beam = 0;
  bool present = false;
};

std::vector<PresentNode> flattened(const std::vector<BeamPlan>& beams) {
  std::vector<PresentNode> nodes;
  for (std::size_t b = 0; b < beams.size(); ++b)
    for (const bool node : beams[b].present) nodes.push_back({static_cast<int>(b), node});
  return nodes;
}

std::vector<BeamPlan> by_beam(const std::vector<PresentNode>& nodes) {
  std::vector<BeamPlan> beams;
  for (const PresentNode& node : nodes) {
    beams.resize(std::max<std::size_t>(beams.size(), node.beam + 1));
    beams[node.beam].present.push_back(node.present);
  }
  return beams;
}

template <class Slot>
void visit_vector(Eigen::Vector3d& x, Slot& slot) {
  for (double& component : x) slot(component);
}

template <class Slot>
void visit_loading(std::optional<Loading>& loading, Slot& slot) {
  std::optional<double> load, t;
  if (loading) std::tie(load, t) = std::tie(loading->load, loading->t);
  slot(load);
  slot(t);
  if (load && t) loading = {*load, *t};
}

template <class Archive>
void exchange_events(Archive& archive, std::vector<RunEvent>& events) {
  exchange_rows(
      archive, "events", "time, kind, beam, body, s, energies, momenta, impulse and lengths of each event",
      events,
      [](RunEvent& event, auto& slot) {
        slot(event.time);
        slot(event.kind);
        slot(event.beam);
        slot(event.body);
        slot(event.s);
        slot(event.energy_before);
        slot(event.energy_after);
        visit_vector(event.momentum_before, slot);
        visit_vector(event.momentum_after, slot);
        visit_vector(event.support_impulse, slot);
        slot(event.length_before);
        slot(event.length_after);
      });
}

// Of a step's matrix: when it was taken, and for which step.
struct MatrixTime {
  double time = 0, step = 0;
};

template <class Archive>
void exchange_linearisation(Archive& archive, std::shared_ptr<const Linearisation>& linearisation) {
  std::vector<MatrixTime> times;
  if (linearisation) times.push_back({linearisation->state.t, linearisation->step});
  exchange_rows(archive, "matrix_step", "time and step of the matrix that the next step begins with", times,
                [](MatrixTime& each, auto& slot) {
                  slot(each.time);
                  slot(each.step);
                });
  if (times.empty()) return;
  const auto whole =
      linearisation ? std::const_pointer_cast<Linearisation>(linearisation)
                    : std::make_shared<Linearisation>(Linearisation{{.t = times[0].time}, times[0].step});
  State& state = whole->state;
  const auto exchange = [&](const char* name, const char* meaning, Eigen::VectorXd& x) {
    exchange_vector(archive, name, meaning, whole, x);
  };
  exchange("matrix_q", "generalised positions of that matrix", state.q);
  exchange("matrix_v", "generalised velocities of that matrix", state.v);
  exchange("matrix_a", "generalised accelerations of that matrix", state.a);
  exchange("matrix_lambda", "Lagrange multipliers of that matrix", state.lambda);
  exchange("matrix_memory", "memory of forces at that matrix", state.memory);
  linearisation = whole;
}

template <class Archive>
void exchange_history(Archive& archive, IntegratorHistory& history) {
  const auto copy = [](double& x, auto& slot) { slot(x); };
  exchange_rows(archive, "method_numbers", "what the method keeps between steps", history.numbers, copy);
  std::vector<double> count{static_cast<double>(history.vectors.size())};
  exchange_rows(archive, "method_vector_count", "number of vectors that the method keeps", count, copy);
  history.vectors.resize(static_cast<std::size_t>(count.at(0)));
  for (std::size_t i = 0; i < history.vectors.size(); ++i)
    exchange_vector(archive, "method_vector_" + std::to_string(i), "what the method keeps between steps",
                    history.vectors[i]);
  exchange_linearisation(archive, history.linearisation);
}

// All that is a single number, as one row. The times that the run took are left out: equal runs write equal
// bytes.
template <class Archive>
void exchange_numbers(Archive& archive, Checkpoint& p) {
  std::vector<Checkpoint> row;
  row.push_back(std::move(p));
  exchange_rows(archive, "scalars", "time, frames, and what the run has counted", row,
                [](Checkpoint& point, auto& slot) {
                  SimulationReport& r = point.report;
                  slot(point.state.t);
                  slot(point.snapshots);
                  slot(point.next_step);
                  slot(point.last_step);
                  slot(point.transient);
                  slot(point.restarted);
                  slot(point.dissipated);
                  slot(point.input);
                  slot(point.start_energy);
                  slot(point.iterations_in_snapshots);
                  slot(r.time);
                  slot(r.steps);
                  slot(r.rejected_steps);
                  slot(r.newton_iterations);
                  slot(r.cut_steps);
                  slot(r.shortest_cut);
                  slot(r.energy_drift);
                  slot(r.integration_error);
                  slot(r.peak_kinetic_energy);
                  for (EnergyRange* range : {&r.strain_energy, &r.gravity_energy}) {
                    slot(range->least);
                    slot(range->greatest);
                  }
                  slot(r.diverges);
                  visit_loading(r.snap, slot);
                });
  p = std::move(row.at(0));
}

template <class Archive>
void exchange_plan(Archive& archive, MeshPlan& plan) {
  std::vector<PresentNode> nodes = flattened(plan.beams);
  exchange_rows(archive, "home_nodes", "beam, and whether the node is in the mesh", nodes,
                [](PresentNode& node, auto& slot) {
                  slot(node.beam);
                  slot(node.present);
                });
  plan.beams = by_beam(nodes);
  exchange_rows(
      archive, "joint_places", "s of the sliding joints when the mesh was made", plan.places,
      [](double& place, auto& slot) { slot(place); });
  exchange_rows(archive, "joint_modes", "node, point, stopped, free", plan.modes,
                [](Carried& mode, auto& slot) { slot(mode); });
  std::vector<int> held(plan.held.begin(), plan.held.end());
  exchange_rows(archive, "held_joints", "whether a body waits for its release", held,
                [](int& each, auto& slot) { slot(each); });
  plan.held.assign(held.begin(), held.end());
  std::vector<int> for_good(plan.points_for_good.begin(), plan.points_for_good.end());
  exchange_rows(archive, "points_for_good", "whether a body stays a point of the mesh", for_good,
                [](int& each, auto& slot) { slot(each); });
  plan.points_for_good.assign(for_good.begin(), for_good.end());
  std::vector<int> closed(plan.closed.begin(), plan.closed.end());
  exchange_rows(archive, "closed_stops", "whether a body rests against a stop", closed,
                [](int& each, auto& slot) { slot(each); });
  plan.closed.assign(closed.begin(), closed.end());
  exchange_rows(archive, "spins", "with which bodies that followed a section have left their beams",
                plan.spins, [](double& spin, auto& slot) { slot(spin); });
  exchange_rows(archive, "constant_weights", "beam, s_a, s_b, w_0 to w_3", plan.weights,
                [](MeshPlan::Weights& weights, auto& slot) {
                  slot(weights.beam);
                  slot(weights.s_a);
                  slot(weights.s_b);
                  for (double& w : weights.w) slot(w);
                });
  exchange_rows(archive, "section_charts",
                "beam, s_a, s_b, axes at both ends and turn, of elements with torsion", plan.section_charts,
                [](MeshPlan::SectionCharts& charts, auto& slot) {
                  slot(charts.beam);
                  slot(charts.s_a);
                  slot(charts.s_b);
                  for (Eigen::Matrix3d& chart : charts.charts)
                    for (double& component : chart.reshaped()) slot(component);
                  slot(charts.turn);
                });
}

/// The one list of what a restart point holds: it writes and reads.
template <class Archive>
void exchange(Archive& archive, Checkpoint& p) {
  std::vector<std::string> inputs{p.inputs, p.model};
  archive.texts("inputs", inputs);
  exchange_numbers(archive, p);
  p.inputs = inputs.at(0);
  p.model = inputs.at(1);
  exchange_vector(archive, "q", "generalised positions", p.state.q);
  exchange_vector(archive, "v", "generalised velocities", p.state.v);
  exchange_vector(archive, "a", "generalised accelerations", p.state.a);
  exchange_vector(archive, "lambda", "Lagrange multipliers", p.state.lambda);
  exchange_vector(archive, "memory",
                  "memory of forces: per body with friction z [m], s [m] and the way it slides; per stop; "
                  "per connector of one sign with a damper",
                  p.state.memory);
  exchange_history(archive, p.history);

  exchange_plan(archive, p.plan);
  exchange_rows(archive, "connector_lengths", "free lengths of the connectors", p.connector_lengths,
                [](double& length, auto& slot) { slot(length); });
  exchange_rows(archive, "changed_loads", "load, its value since it was changed", p.changed_loads,
                [](ChangedLoad& load, auto& slot) {
                  slot(load.number);
                  for (double& component : load.value) slot(component);
                });
  exchange_rows(
      archive, "steps", "time, size, Newton iterations, rejected, of each step since the last frame", p.steps,
      [](StepRecord& step, auto& slot) {
        slot(step.time);
        slot(step.size);
        slot(step.newton_iterations);
        slot(step.rejected);
      });
  exchange_rows(
      archive, "peaks", "what was largest, by the watch between frames", p.peaks,
      [](double& number, auto& slot) { slot(number); });
  exchange_rows(archive, "run_extremes", "value, s, time and layer of each extreme of the run", p.extremes,
                [](double& number, auto& slot) { slot(number); });
  exchange_events(archive, p.report.events);
  exchange_rows(archive, "nodes_given_up", "joint, time, s, and energy that its node would have cost",
                p.report.points_for_good, [](PointForGood& point, auto& slot) {
                  slot(point.rider);
                  slot(point.time);
                  slot(point.s);
                  slot(point.energy);
                });
  archive.texts("said_of_files", p.said_of_files);
}

}  // namespace

void write_checkpoint(const std::filesystem::path& file, Checkpoint point) {
  try {
    Writer archive(temporary_name(file));
    exchange(archive, point);
    archive.close();
    append_checksum(temporary_name(file));
  } catch (const std::runtime_error&) {
    std::error_code ignored;
    std::filesystem::remove(temporary_name(file), ignored);
    throw;
  }
  publish(file);
}

Checkpoint read_checkpoint(const std::filesystem::path& file) {
  if (check_file(file) == Checksum::none)
    throw std::runtime_error(file.string() +
                             ": has no checksum: an earlier version has written it, or it is damaged");
  Checkpoint point;
  Reader archive(file);
  try {
    exchange(archive, point);
  } catch (const std::out_of_range&) {
    throw std::runtime_error(file.string() + ": is not a restart point of this version");
  }
  return point;
}

}  // namespace nurbeam
