#include "pipelines/run/run.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <exception>
#include <fstream>
#include <iostream>
#include <memory>
#include <optional>
#include <sstream>
#include <utility>

#include "fem/motion/run/simulation.h"
#include "nurbs/number_text.h"
#include "pipelines/accuracy/error_files.h"
#include "pipelines/accuracy/level_file.h"
#include "pipelines/diagnostics/exit_code.h"
#include "pipelines/diagnostics/print_diagnostics.h"
#include "pipelines/diagnostics/simulation_text.h"
#include "pipelines/model/build_model.h"
#include "pipelines/model/model_snapshot.h"
#include "pipelines/model/model_summary.h"
#include "pipelines/report/report.h"
#include "pipelines/results/checksum.h"
#include "pipelines/results/file_error.h"
#include "pipelines/results/file_hash.h"
#include "pipelines/results/results_directory.h"
#include "pipelines/results/run_summary.h"
#include "pipelines/run/accuracy_lines.h"
#include "pipelines/run/accuracy_question.h"
#include "pipelines/run/accuracy_run.h"
#include "pipelines/run/closing_lines.h"
#include "pipelines/run/history_rows.h"
#include "pipelines/run/kept_memory.h"
#include "pipelines/run/mode_run.h"
#include "pipelines/run/motion_mesh.h"
#include "pipelines/run/progress.h"
#include "pipelines/run/round_off.h"
#include "pipelines/run/run_checkpoint.h"
#include "pipelines/run/run_evidence.h"
#include "pipelines/run/run_messages.h"
#include "pipelines/run/run_outputs.h"
#include "pipelines/run/signals.h"
#include "pipelines/run/simulation_plan.h"
#include "pipelines/run/speed_run.h"
#include "solver/algebra/side_by_side.h"

namespace nurbeam {

namespace {

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

ExitCode exit_code_of(SimulationStatus status) {
  switch (status) {
    case SimulationStatus::done:
      return exit_done;
    case SimulationStatus::not_converged:
      return exit_not_converged;
    case SimulationStatus::interrupted:
      return exit_interrupted;
  }
  return exit_not_converged;
}

// The run itself, once everything it needs is there.
class Run {
 public:
  Run(const CaseFile& c, const BuildReport& report, const RunOptions& options, RunMessages& messages,
      RunSummary summary)
      : case_(c),
        built_(*report.value),
        options_(options),
        messages_(messages),
        directory_(options.out),
        inputs_(digest_of_inputs(c, built_)),
        summary_(std::move(summary)) {
    from_ = options.resume ? find_checkpoint(options.out, inputs_) : finished_before(c, options.out, inputs_);
    if (!from_) directory_.clear();
    remove_other_levels(options.out, c.analysis.accuracy.is_on ? inputs_ : "");
    check_is_file(options.out / "run.log");
    log_.emplace(options.out / "run.log", from_ ? std::ios::app : std::ios::trunc);
    if (c.analysis.accuracy.is_on)
      accuracy_.emplace(c, built_, options.threads, LevelStore{options.out, inputs_});
  }

  ExitCode play() {
    begin_log();
    RunOutputs outputs(case_, built_, options_.out, inputs_, from_ ? &*from_ : nullptr);
    if (accuracy_) watch(outputs);
    const SimulationReport simulated =
        case_.analysis.has_modes() ? find_modes_into(outputs) : simulate_into(outputs);
    messages_.begin("results");
    outputs.finish();
    if (accuracy_ && simulated.status == SimulationStatus::done && !thrown_) find_errors(simulated, outputs);
    // A run that ended before its first frame has nothing to show.
    const bool with_report = case_.output.report && outputs.frame_count() > 0;
    summarise(simulated, outputs, with_report);
    write_run_summary(options_.out / "run.json", summary_);
    if (with_report) {
      const std::optional<StoredResults> frames = outputs.all_frames();
      frames ? write_report(options_.out, *frames) : write_report(options_.out);
    }
    if (simulated.status != SimulationStatus::done && !thrown_)
      tell_failure(outcome_in_world(simulated, built_));
    if (simulated.status == SimulationStatus::done) tell_outcome(simulated, with_report);
    if (summary_.accuracy) tell_accuracy(*summary_.accuracy);
    *log_ << "ended at t = " << simulated.time << " s after " << simulated.steps << " steps" << std::endl;
    if (thrown_) std::rethrow_exception(thrown_);
    return exit_code_of(simulated);
  }

 private:
  ExitCode exit_code_of(const SimulationReport& simulated) const {
    if (errors_interrupted_) return exit_interrupted;
    if (summary_.accuracy && !summary_.accuracy->reached) return exit_not_converged;
    return nurbeam::exit_code_of(simulated.status);
  }

  // Starts the runs that errors come from; a run that goes on has frames and steps already.
  void watch(RunOutputs& outputs) {
    if (from_ && from_->snapshots > 0) {
      const StoredFrames stored(options_.out);
      for (std::size_t i = 0; i < from_->snapshots; ++i) {
        const Snapshot frame = std::move(stored.read(i, 1)[0]);
        for (const StepRecord& step : frame.steps) accuracy_->step(step);
        accuracy_->look_at(frame);
      }
    }
    if (from_)
      for (const StepRecord& step : from_->steps) accuracy_->step(step);
    outputs.show_frames_to([this](const Snapshot& frame) { accuracy_->look_at(frame); });
    accuracy_->begin();
  }

  void find_errors(const SimulationReport& simulated, const RunOutputs& outputs) {
    messages_.begin("accuracy");
    const std::function<bool()> interrupted = interruption();
    const AccuracyTable* table = accuracy_->finish(
        simulated, outputs.extremes(), summary_.modes, interrupted,
        [this](const auto& line) { options_.quiet ? void(*log_ << line << std::endl) : tell(line); });
    errors_interrupted_ = interrupted();
    if (!table) return;
    summary_.accuracy = accuracy_->accuracy();
    if (summary_.modes) {
      for (std::size_t i = 0; i < summary_.modes->rows.size(); ++i)
        if (std::isfinite(summary_.accuracy->modes[i]))
          summary_.modes->rows[i].error = summary_.accuracy->modes[i];
      write_mode_table(options_.out / "modes.csv", *summary_.modes);
    } else {
      write_errors_table(options_.out, *table);
      write_errors_netcdf(options_.out, *table, history_columns(snapshot_names(built_)),
                          accuracy_->own_times());
    }
  }

  void tell_accuracy(const Accuracy& accuracy) {
    for (const std::string& line : accuracy_lines(accuracy))
      options_.quiet ? void(*log_ << line << std::endl) : tell(line);
    if (!accuracy.reached) tell_failure(summary_.status);
  }

  // A line for people, and for the log.
  void tell(const std::string& line) {
    messages_.text(line);
    *log_ << line << std::endl;
  }

  void tell_failure(const std::string& outcome) {
    messages_.failure(case_.path, outcome);
    *log_ << case_.path.string() << ": error: " << outcome << std::endl;
  }

  void tell_outcome(const SimulationReport& simulated, bool with_report) {
    for (const std::string& line :
         closing_lines(summary_, simulated, case_.analysis, options_.out, with_report))
      options_.quiet ? void(*log_ << line << std::endl) : tell(line);
  }

  void begin_log() {
    *log_ << "nurbeam " << NURBEAM_VERSION << ": " << case_.path.string()
          << (from_ ? ", resumed at t = " + text_of(from_->state.t) + " s" : std::string()) << std::endl;
    print_diagnostics(*log_, summary_.diagnostics);
  }

  // What asks for an end: the caller, or else the signals, the second of which ends the program, also while
  // results are written.
  std::function<bool()> interruption() {
    if (options_.interrupted) return options_.interrupted;
    guard_.emplace();
    return [this] { return guard_->interrupted(); };
  }

  SimulationReport find_modes_into(RunOutputs& outputs) {
    messages_.begin("modes");
    ModeTable table;
    const ModeShapes shapes{
        .state = [&](const Snapshot& state) { outputs.write(state); },
        .shape = [&](const Snapshot& shape) { outputs.write_shape(shape); },
        .turn = [&](const std::string& name, const auto& frames) { outputs.write_series(name, frames); }};
    const SimulationReport report = run_modes(case_, built_, interruption(), shapes, table);
    if (report.status != SimulationStatus::done) return report;
    write_mode_table(options_.out / "modes.csv", table);
    for (std::size_t i = 0; i < table.rows.size(); ++i)
      options_.quiet ? void(*log_ << mode_text(table, i) << std::endl) : tell(mode_text(table, i));
    for (const auto& warning :
         {round_off_warning(case_.path, built_.model, table), coarse_waves_warning(case_.path, table),
          short_waves_warning(case_.path, table)})
      if (warning) warn(*warning);
    summary_.modes = std::move(table);
    return with_speeds(report);
  }

  void warn(const Diagnostic& warning) {
    messages_.findings({warning});
    print_diagnostics(*log_, {warning});
    summary_.diagnostics.push_back(warning);
  }

  // Natural frequencies over speeds of rotation, where these are asked for.
  SimulationReport with_speeds(SimulationReport report) {
    if (case_.analysis.modes.speeds.empty()) return report;
    Findings findings(case_.path.string());
    summary_.speeds = modes_over_speed(case_, built_, interruption(), report, findings);
    if (!summary_.speeds) return report;
    for (const Diagnostic& finding : findings.take()) warn(finding);
    write_speed_table(options_.out / "speeds.csv", *summary_.speeds);
    for (const CriticalSpeed& each : summary_.speeds->critical)
      options_.quiet ? void(*log_ << critical_text(each) << std::endl) : tell(critical_text(each));
    return report;
  }

  SimulationReport simulate_into(RunOutputs& outputs) {
    const double start_time = from_ ? from_->state.t : 0, end_time = case_.analysis.end_time;
    const bool moves = case_.analysis.type == CaseAnalysis::Type::dynamic;
    const double states_at_rest =
        std::max(1.0, static_cast<double>(simulation_options(case_).output_times.size()));
    const bool silent = options_.quiet || options_.progress || messages_.is_json();
    messages_.begin(moves && (from_ || !simulation_options(case_).start_from_equilibrium) ? "motion"
                                                                                          : "equilibrium");
    Progress shown(messages_.stream(), Progress::style_of_stderr(silent), start_time, end_time);
    Progress logged(*log_, Progress::Style::lines, start_time, end_time);
    SimulationObserver observer;
    observer.interrupted = interruption();
    observer.progress = [&](const StepRecord& step) {
      shown.update(step);
      logged.update(step);
      if (accuracy_) accuracy_->step(step);
      messages_.reach(step.time / end_time, step.time);
      if (options_.progress) options_.progress(step);
    };
    if (outputs.takes_elements_ahead())
      observer.elements = [&, first = true](double time, int beam, auto& elements) mutable {
        // What made the mesh and the first state leaves pieces behind that nothing later has a use for.
        if (std::exchange(first, false)) give_back_memory();
        outputs.write_ahead(time, beam, elements);
      };
    observer.snapshot = [&, first = true, count = 0](Snapshot snapshot) mutable {
      if (!moves) messages_.reach(++count / states_at_rest, snapshot.time);
      outputs.write(std::move(snapshot));
      if (!std::exchange(first, false)) return;
      if (moves) messages_.begin("motion");
      shown.begin_motion();
      logged.begin_motion();
    };
    observer.peak = [&](Snapshot snapshot) { outputs.look_between(std::move(snapshot)); };
    observer.checkpoint_due = [&] { return outputs.checkpoint_due(); };
    observer.checkpoint = [&](Checkpoint point) {
      give_back_memory();  // it takes much to write
      outputs.write(std::move(point));
    };
    // The model itself, which stays where it is: a copy would be there as long.
    const std::shared_ptr<const BeamModel> model(std::shared_ptr<void>(), &built_.model);
    SimulationReport simulated = simulated_until_thrown(model, std::move(observer), outputs);
    shown.finish();
    simulated.motion_seconds = std::max(0.0, simulated.motion_seconds - outputs.seconds());
    return simulated;
  }

  // The run, with the rows of histories that are due at the ends of its steps: also before a restart point is
  // written, which counts them.
  SimulationReport simulated_with_rows(const std::shared_ptr<const BeamModel>& model,
                                       SimulationObserver observer, RunOutputs& outputs) {
    const HistoryRows rows(case_.output);
    const bool has_rows = rows.any() && case_.analysis.type == CaseAnalysis::Type::dynamic;
    const Simulation* running = nullptr;
    double frame = -1, seen = from_ ? from_->state.t : 0;
    const auto write_row = [&] {
      const double now = running->state().t;
      if (has_rows && now != frame && rows.due(seen, now))
        outputs.write_between(running->present(contents_between_frames));
      seen = now;
    };
    observer.snapshot = [&frame, told = std::move(observer.snapshot)](Snapshot snapshot) {
      frame = snapshot.time;
      told(std::move(snapshot));
    };
    observer.checkpoint = [&write_row, told = std::move(observer.checkpoint)](Checkpoint point) {
      write_row();
      told(std::move(point));
    };
    Simulation simulation(model, probe_places(built_), simulation_options(case_), std::move(observer),
                          from_ ? &*from_ : nullptr);
    running = &simulation;
    while (simulation.advance()) write_row();
    return simulation.report();
  }

  // What functions of the caller throw ends the run as an interruption does, and is thrown behind it.
  SimulationReport simulated_until_thrown(const std::shared_ptr<const BeamModel>& model,
                                          SimulationObserver observer, RunOutputs& outputs) {
    SimulationReport so_far;
    so_far.time = from_ ? from_->state.t : 0;
    observer.progress = [&so_far, told = std::move(observer.progress)](const StepRecord& step) {
      so_far.time = step.time;
      ++so_far.steps;
      told(step);
    };
    try {
      return simulated_with_rows(model, std::move(observer), outputs);
    } catch (const std::runtime_error&) {  // of our own: files that cannot be written
      throw;
    } catch (...) {
      thrown_ = std::current_exception();
      so_far.status = SimulationStatus::interrupted;
      return so_far;
    }
  }

  void summarise(const SimulationReport& simulated, const RunOutputs& outputs, bool with_report) {
    summary_.status = outcome_in_world(simulated, built_);
    if (summary_.accuracy && !summary_.accuracy->reached)
      summary_.status = accuracy_status + (" of " + text_of(100 * *summary_.accuracy->target, 3)) +
                        " % is not reached: " + summary_.accuracy->unreached;
    if (errors_interrupted_) summary_.status = std::string(accuracy_status) + ": interrupted";
    summary_.wall_times.output = outputs.seconds();
    summary_.wall_times.motion = simulated.motion_seconds;
    summary_.diagnostics.insert(summary_.diagnostics.end(), outputs.diagnostics().begin(),
                                outputs.diagnostics().end());
    messages_.findings(outputs.diagnostics());
    print_diagnostics(*log_, outputs.diagnostics());
    summary_.wall_times.length_control = simulated.length_control_seconds;
    if (from_) summary_.resumed_at = from_->state.t;
    summary_.end_time = simulated.time;
    summary_.steps = simulated.steps;
    summary_.rejected_steps = simulated.rejected_steps;
    summary_.newton_iterations = simulated.newton_iterations;
    summary_.energy_drift = simulated.energy_drift;
    summary_.axial_mismatch = outputs.checks().axial_mismatch();
    summary_.extremes = outputs.extremes();
    summary_.collectors = outputs.collectors();
    summary_.round_off = round_off(built_.model, simulated);
    summary_.events = simulated.events;
    const SnapshotNames names = snapshot_names(built_);
    summary_.beams = names.beams;
    summary_.bodies = names.bodies;
    for (RunEvent& event : summary_.events) {
      event.energy_before += built_.frame.gravity_energy;
      event.energy_after += built_.frame.gravity_energy;
      event.momentum_before = built_.frame.direction_to_world(event.momentum_before);
      event.momentum_after = built_.frame.direction_to_world(event.momentum_after);
    }
    std::vector<Diagnostic> warnings = run_warnings(case_, built_, simulated, outputs.checks());
    if (summary_.modes)
      if (const auto note = fewer_modes_note(case_, *summary_.modes)) warnings.push_back(*note);
    if (case_.analysis.type == CaseAnalysis::Type::dynamic)
      for (Diagnostic& warning : contact_warnings(case_.path, summary_.collectors))
        warnings.push_back(std::move(warning));
    messages_.findings(warnings);
    print_diagnostics(*log_, warnings);
    summary_.diagnostics.insert(summary_.diagnostics.end(), warnings.begin(), warnings.end());
    summary_.files = directory_.files();
    summary_.files.emplace_back("run.json");
    if (with_report) summary_.files.emplace_back("report.html");
    std::sort(summary_.files.begin(), summary_.files.end());  // a resumed run finds both there
    summary_.files.erase(std::unique(summary_.files.begin(), summary_.files.end()), summary_.files.end());
  }

  std::optional<InterruptGuard> guard_;
  const CaseFile& case_;
  const BuiltModel& built_;
  const RunOptions& options_;
  RunMessages& messages_;
  ResultsDirectory directory_;
  std::string inputs_;
  RunSummary summary_;
  std::optional<Checkpoint> from_;
  std::optional<std::ofstream> log_;
  std::optional<AccuracyRun> accuracy_;
  bool errors_interrupted_ = false;
  std::exception_ptr thrown_;  // by a function of the caller
};

}  // namespace

namespace {

int run_built(const CaseFile& c, const BuildReport& report, const RunOptions& options, RunMessages& messages,
              double build_seconds) {
  RunSummary summary;
  summary.version = NURBEAM_VERSION;
  summary.case_name = c.name;
  summary.model = model_summary(c, *report.value);
  summary.evidence = run_evidence(c, *report.value);
  summary.diagnostics = report.diagnostics;
  if (const auto errors = unknown_in_accuracy(c, *report.value); !errors.empty()) {
    messages.findings(errors);
    return exit_bad_input;
  }
  summary.wall_times.import = report.value->import_seconds;
  summary.wall_times.model = build_seconds;
  std::optional<ThreadLimit> limit;
  if (options.threads > 0) limit.emplace(options.threads);
  try {
    const bool in_file = std::filesystem::is_regular_file(c.path);
    summary.inputs.push_back({c.path, in_file ? sha256_of_file(c.path) : sha256_of_text(c.json)});
    for (const auto& file : report.value->inputs) summary.inputs.push_back({file, sha256_of_file(file)});
    std::vector<std::filesystem::path> inputs = c.files;
    if (in_file) inputs.insert(inputs.begin(), std::filesystem::absolute(c.path));
    if (const std::string taken = taken_by_input(options.out, inputs); !taken.empty()) {
      messages.error(taken);
      return exit_bad_input;
    }
    return Run(c, report, options, messages, std::move(summary)).play();
  } catch (const UnusableCheckpoint& problem) {
    messages.error(problem.what());
    return exit_bad_input;
  } catch (const DamagedError& problem) {
    messages.error(std::string(problem.what()) + ": run without --resume");
    return exit_bad_input;
  } catch (const std::runtime_error& problem) {
    messages.error(problem.what());
    return exit_not_written;
  }
}

int build_and_run(const CaseFile& c, const RunOptions& options, RunMessages& messages) {
  const auto start = std::chrono::steady_clock::now();
  if (options.resume && !std::filesystem::exists(restart_file(options.out))) {
    messages.error(restart_file(options.out).string() +
                   ": does not exist: there is no run to resume; run without --resume");
    return exit_bad_input;
  }
  messages.begin("model");
  BuildReport report = build_model(c);
  if (report.value)
    for (Diagnostic& found : divide_for_motion(c, *report.value, options.interrupted))
      report.diagnostics.push_back(std::move(found));
  messages.findings(report.diagnostics);
  if (!report.value) return exit_bad_input;
  return run_built(c, report, options, messages, seconds_since(start) - report.value->import_seconds);
}

std::ostream& stream_of(const RunOptions& options) {
  return options.messages ? *options.messages : std::cerr;
}

RunMessages::Form form_of(const RunOptions& options) {
  return options.json ? RunMessages::Form::json : RunMessages::Form::text;
}

}  // namespace

int run_case(const CaseFile& c, const RunOptions& options) {
  RunMessages messages(stream_of(options), form_of(options));
  const int code = build_and_run(c, options, messages);
  messages.end(code, options.out);
  return code;
}

int run_model(const CaseFile& c, const BuildReport& report, const RunOptions& options, double build_seconds) {
  RunMessages messages(stream_of(options), form_of(options));
  const int code = run_built(c, report, options, messages, build_seconds);
  messages.end(code, options.out);
  return code;
}

}  // namespace nurbeam
