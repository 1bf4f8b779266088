#include <pybind11/eigen.h>
#include <pybind11/functional.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <atomic>
#include <chrono>
#include <sstream>
#include <stdexcept>

#include "fem/motion/run/simulation.h"
#include "nurbs/number_text.h"
#include "pipelines/diagnostics/simulation_text.h"
#include "pipelines/model/model_snapshot.h"
#include "pipelines/results/restart_file.h"
#include "pipelines/run/mode_run.h"
#include "pipelines/run/run.h"
#include "pipelines/run/run_checks.h"
#include "pipelines/run/simulation_plan.h"
#include "python/bindings.h"
#include "python/interrupts.h"
#include "python/laws.h"
#include "python/live_run.h"
#include "python/signal.h"

namespace nurbeam::python {

namespace {

namespace py = pybind11;
using namespace py::literals;

py::dict event_facts(const RunEvent& event, const BuiltCase& c) {
  const BuiltModel& built = c.built();
  py::object beam = py::none(), body = py::none();
  if (event.beam >= 0) beam = py::str(built.model.beams[event.beam].name);
  if (event.body >= 0) body = py::str(built.model.bodies[event.body].name);
  return py::dict("time"_a = event.time, "kind"_a = name_of(event.kind), "beam"_a = beam, "body"_a = body,
                  "s"_a = event.s);
}

// What a run came to.
py::dict report_facts(const SimulationReport& report, const BuiltCase& c,
                      const std::vector<Diagnostic>& warnings) {
  py::list events;
  for (const RunEvent& event : report.events) events.append(event_facts(event, c));
  return py::dict(
      "status"_a = outcome_in_world(report, c.built()), "done"_a = report.status == SimulationStatus::done,
      "time"_a = report.time, "steps"_a = report.steps, "rejected_steps"_a = report.rejected_steps,
      "newton_iterations"_a = report.newton_iterations, "seconds"_a = report.motion_seconds,
      "energy_drift"_a = report.energy_drift, "events"_a = events, "warnings"_a = plain(warnings));
}

// (recording, report) of modes or buckling.
py::tuple modes(const std::shared_ptr<BuiltCase>& c, const Functions& functions) {
  auto recording = std::make_shared<Recording>();
  BuiltModel built = c->built();
  built.model = with_laws(built, functions, c->case_file.analysis);
  recording->title = c->case_file.name;
  recording->names = snapshot_names(built);
  Interrupts interrupts;
  SimulationReport report;
  FrameChecks checks(built.model);
  {
    const WithoutLock others_go_on;
    const auto keep = [&](const Snapshot& local) {
      recording->frames.push_back(to_world(built.frame, local));
    };
    ModeTable table;
    report = run_modes(
        c->case_file, built, [&] { return interrupts.pending(); },
        {.state =
             [&](const Snapshot& state) {
               keep(state);
               checks.look_at(recording->frames.back());
             },
         .shape = keep,
         .turn = [](const auto&, const auto&) {}},
        table);
    recording->modes = std::move(table);
  }
  interrupts.rethrow();
  std::vector<Diagnostic> warnings = run_warnings(c->case_file, built, report, checks);
  if (report.status == SimulationStatus::done)  // else it has not come to them
    for (const auto& more : {round_off_warning(c->case_file.path, built.model, *recording->modes),
                             coarse_waves_warning(c->case_file.path, *recording->modes),
                             short_waves_warning(c->case_file.path, *recording->modes),
                             fewer_modes_note(c->case_file, *recording->modes)})
      if (more) warnings.push_back(*more);
  return py::make_tuple(recording, report_facts(report, *c, warnings));
}

// Runs into a results directory: (exit code, messages). `progress` is told the time ten times a second.
py::tuple run_into(const std::shared_ptr<BuiltCase>& c, const Functions& functions,
                   const std::filesystem::path& out, bool resume,
                   const std::optional<std::function<void(double)>>& progress) {
  using Clock = std::chrono::steady_clock;
  BuildReport report = c->report;
  report.value->model = with_laws(c->built(), functions, c->case_file.analysis);
  std::ostringstream messages;
  Interrupts interrupts;
  Clock::time_point told = Clock::now();
  RunOptions options{.out = out, .quiet = true, .resume = resume, .messages = &messages};
  options.interrupted = [&] { return interrupts.pending(); };
  options.progress = [&](const StepRecord& step) {
    const bool last = step.time >= c->case_file.analysis.end_time;
    if (!progress || (!last && Clock::now() - told < std::chrono::milliseconds(100))) return;
    told = Clock::now();
    const WithLock lock;
    (*progress)(step.time);
  };
  int code = 0;
  {
    const WithoutLock others_go_on;
    code = run_model(c->case_file, report, options);
  }
  interrupts.rethrow();
  return py::make_tuple(code, messages.str());
}

}  // namespace

void bind_simulations(py::module_& module) {
  py::class_<Signal, std::shared_ptr<Signal>>(module, "Signal", "A value that a run reads at its time.")
      .def(py::init([](int size, const Eigen::Vector3d& value) {
             return std::make_shared<Signal>(Signal::State{.size = size, .value = value});
           }),
           py::arg("size"), py::arg("value"))
      .def(
          "__call__", [](const Signal& signal, double t) { return signal.at(t).value; }, py::arg("t"))
      .def("state",
           [](const Signal& signal) {
             const Signal::State s = signal.state();
             return py::make_tuple(s.size, s.value, s.slope, s.integral, s.since, s.until, s.drives);
           })
      .def("restore", [](Signal& signal, const py::tuple& s) {
        signal.restore({s[0].cast<int>(), s[1].cast<Eigen::Vector3d>(), s[2].cast<Eigen::Vector3d>(),
                        s[3].cast<Eigen::Vector3d>(), s[4].cast<double>(), s[5].cast<double>(),
                        s[6].cast<bool>()});
      });
  module.def("modes", &modes, py::arg("case"), py::arg("functions"));
  module.def("run_into", &run_into, py::arg("case"), py::arg("functions"), py::arg("out"), py::arg("resume"),
             py::arg("progress"));
  py::class_<Checkpoint, std::shared_ptr<Checkpoint>>(module, "Checkpoint",
                                                      "A moment that a motion can go on from.")
      .def_property_readonly(
          "time", [](const Checkpoint& c) { return c.state.t; })
      .def(
          "save", [](const Checkpoint& c, const std::filesystem::path& file) { write_checkpoint(file, c); },
          py::arg("file"), py::call_guard<WithoutLock>())
      .def_static(
          "load", [](const std::filesystem::path& file) { return read_checkpoint(file); }, py::arg("file"),
          py::call_guard<WithoutLock>());
  py::class_<LiveRun, std::shared_ptr<LiveRun>>(module, "LiveRun", "A run that is taken step by step.",
                                                py::dynamic_attr())
      .def_static(
          "begin",
          [](std::shared_ptr<BuiltCase> c, const py::object& functions, const Checkpoint* start) {
            return keeping(functions, py::cast(std::make_shared<LiveRun>(
                                          std::move(c), functions.cast<Functions>(), start)));
          },
          py::arg("case"), py::arg("functions"), py::arg("start"))
      .def("step", &LiveRun::step)
      .def("next", &LiveRun::next)
      .def_property_readonly("time", &LiveRun::time)
      .def_property_readonly("begun", &LiveRun::begun)
      .def_property_readonly("ended", &LiveRun::ended)
      .def_property_readonly("recording", &LiveRun::recording)
      .def("now", &LiveRun::now)
      .def("checkpoint", &LiveRun::checkpoint)
      .def("values", &LiveRun::values, py::arg("names"))
      .def("set_signal", &LiveRun::set_signal, py::arg("signal"), py::arg("value"), py::arg("slope"),
           py::arg("until"))
      .def("change_load", &LiveRun::change_load, py::arg("number"), py::arg("value"))
      .def("extremes",
           [](const LiveRun& run) {
             py::list list;
             for (const RunExtreme& each : run.extremes())
               list.append(py::dict("quantity"_a = each.quantity, "unit"_a = each.unit,
                                    "value"_a = each.value, "s [m]"_a = each.s, "time [s]"_a = each.time));
             return list;
           })
      .def("collectors", &LiveRun::collectors)
      .def("report", [](const LiveRun& run) {
        const BuiltCase& of = *run.of();
        const auto [report, warnings] = run.report();
        return report_facts(report, of, warnings);
      });
}

}  // namespace nurbeam::python
