#include "pipelines/study/study_command.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <fstream>
#include <iostream>
#include <optional>
#include <sstream>
#include <thread>
#include <vector>

#include "nurbs/number_text.h"
#include "pipelines/diagnostics/closest_name.h"
#include "pipelines/diagnostics/exit_code.h"
#include "pipelines/diagnostics/print_diagnostics.h"
#include "pipelines/run/signals.h"
#include "pipelines/study/best_variant.h"
#include "pipelines/study/mpi_engine.h"
#include "pipelines/study/study_output.h"
#include "pipelines/study/study_report.h"
#include "pipelines/study/variant_errors.h"

namespace nurbeam {

namespace {

/// A study that can run.
struct ReadyStudy {
  StudyFile study;
  std::optional<StudyCase> study_case;
};

// What is wrong with the quantities of a study whose case, changes or variables cannot be used as they are.
std::vector<Diagnostic> wrong_quantities(StudyFile study, const std::vector<StudyChange>& changes) {
  study.changes = changes;
  study.derivatives = false;
  for (StudyVariable& variable : study.variables) {  // the case as it stands: their values may be wrong
    variable.target.reset();
    variable.derived.reset();
  }
  study.refinements.clear();
  const StudyCaseReport plain = read_study_case(study);
  return plain.value ? check_quantities(study, &*plain.value) : std::vector<Diagnostic>{};
}

// What is wrong with a study besides what its file alone shows: beams, control points, columns.
void tell_of_case(StudyFile study, std::ostream& err) {
  if (!study.case_file) return;
  const StudyCaseReport of_case = read_study_case(study);
  print_diagnostics(err, of_case.diagnostics);
  print_diagnostics(err, wrong_quantities(std::move(study), of_case.changes));
}

/// Nothing, with its errors printed, where it cannot run.
std::optional<ReadyStudy> read_study(const std::filesystem::path& file, std::ostream& err) {
  StudyFileReport read = read_study_file(file);
  print_diagnostics(err, read.diagnostics);
  if (!read.value) {
    if (read.with_errors) tell_of_case(std::move(*read.with_errors), err);
    return {};
  }
  ReadyStudy ready{.study = std::move(*read.value)};
  if (ready.study.case_file) {
    StudyCaseReport of_case = read_study_case(ready.study);
    print_diagnostics(err, of_case.diagnostics);
    if (!of_case.value) {
      print_diagnostics(err, wrong_quantities(std::move(ready.study), of_case.changes));
      return {};
    }
    ready.study_case = std::move(of_case.value);
  }
  std::vector<Diagnostic> wrong =
      check_quantities(ready.study, ready.study_case ? &*ready.study_case : nullptr);
  if (!wrong.empty() && !has_errors(wrong)) {  // the nominal variant cannot be built
    const std::vector<Diagnostic> plain = wrong_quantities(ready.study, ready.study.changes);
    if (has_errors(plain)) wrong.insert(wrong.end(), plain.begin(), plain.end());
  }
  print_diagnostics(err, wrong);
  if (has_errors(wrong)) return {};
  if (ready.study.derivatives && ready.study.derivatives_where_known)
    ready.study.derivatives = has_derivatives(ready.study, ready.study_case ? &*ready.study_case : nullptr);
  return ready;
}

/// One line that is rewritten on a terminal; elsewhere one at every tenth of the way.
class StudyLine {
 public:
  StudyLine(std::ostream& err, bool quiet)
      : err_(err), quiet_(quiet), terminal_(isatty(STDERR_FILENO) != 0) {}

  void show(const StudyProgress& p) {
    if (quiet_) return;
    const std::size_t ended = p.done + p.failed;
    const std::size_t tenth = p.total > 0 ? 10 * ended / p.total : 0;
    const auto now = std::chrono::steady_clock::now();
    if (terminal_ ? now - last_ < std::chrono::milliseconds(100) && ended < p.total
                  : tenth == tenth_ && total_ == p.total)
      return;
    last_ = now;
    tenth_ = tenth;
    total_ = p.total;
    const std::string most = p.at_most ? "at most " : "";
    err_ << (terminal_ ? "\r\033[K" : "") << ended << " of " << most << p.total << " variants, " << p.failed
         << " not done, " << p.running << " running";
    if (p.seconds_to_go) err_ << ", " << most << text_of(std::ceil(*p.seconds_to_go)) << " s to go";
    err_ << (terminal_ ? "" : "\n") << std::flush;
    open_ = terminal_;
  }
  ~StudyLine() {
    if (open_) err_ << "\n";
  }

 private:
  std::ostream& err_;
  bool quiet_, terminal_, open_ = false;
  std::size_t tenth_ = 11, total_ = 0;
  std::chrono::steady_clock::time_point last_{};
};

WorkerCommand worker_command(const StudyOptions& options) {
  return {options.program.string(), "worker", options.file.string()};
}

// As many processes as are asked for, but no more than keep this machine busy.
int useful_jobs(int wanted, std::ostream& err) {
  constexpr int most_per_core = 4;
  const int most = most_per_core * static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  if (wanted <= most) return wanted;
  err << "warning: --jobs " << wanted << ": no more than " << most << " variants run at a time here, "
      << most_per_core << " for each core\n";
  return most;
}

constexpr std::array result_names{"study.csv",  "study.nc",  "study.json",
                                  "study.html", "best.json", "best.step"};

// The study, its case and what that reads.
std::vector<std::filesystem::path> inputs_of(const ReadyStudy& ready, const StudyOptions& options) {
  std::vector<std::filesystem::path> inputs;
  if (ready.study_case) inputs = ready.study_case->inputs();
  inputs.insert(inputs.begin(), {options.file, ready.study.case_file.value_or(options.file)});
  return inputs;
}

/// Makes the directory of the results, of a study that can run; an exit code.
ExitCode make_directory(const ReadyStudy& ready, const StudyOptions& options, std::ostream& err) {
  for (const std::filesystem::path& input : inputs_of(ready, options)) {
    const std::filesystem::path file = std::filesystem::weakly_canonical(input);
    const bool is_result = std::ranges::count(result_names, file.filename().string()) > 0;
    if (!is_result ||
        file.parent_path() != std::filesystem::weakly_canonical(options.out / "study.csv").parent_path())
      continue;
    err << "error: " << input.string()
        << ": is an input of this study, and a name of its results, which would take its place; give another "
           "--out, or the file another name\n";
    return exit_bad_input;
  }
  if (options.resume && !std::filesystem::exists(options.out / "study.rows")) {
    err << "error: " << (options.out / "study.rows").string()
        << ": does not exist: there is no study to resume; run without --resume\n";
    return exit_bad_input;
  }
  std::error_code error;
  std::filesystem::create_directories(options.out, error);
  if (std::filesystem::is_directory(options.out)) return exit_done;
  err << "error: " << options.out.string() << ": cannot be made a directory\n";
  return exit_not_written;
}

void write_results(const ReadyStudy& ready, const StudyOptions& options, const StudyResult& result) {
  write_study_table(options.out / "study.csv", ready.study, result);
  write_study_netcdf(options.out / "study.nc", ready.study, result);
  write_study_summary(options.out / "study.json", ready.study, result, options.out / "study.csv");
  const StudyCase* study_case = ready.study_case ? &*ready.study_case : nullptr;
  write_study_report(options.out / "study.html", ready.study, study_case, result);
  if (!study_case) return;
  if (const auto* optimum = std::get_if<OptimumResult>(&result.answer))
    write_best_variant(options.out, ready.study, *study_case, optimum->points.front());
  if (const auto* calibrated = std::get_if<CalibrationResult>(&result.answer))
    write_best_variant(options.out, ready.study, *study_case, calibrated->point);
}

// Of a study that was here before.
void remove_former_results(const std::filesystem::path& directory) {
  for (const char* name : result_names) {
    std::error_code ignored;
    std::filesystem::remove(directory / name, ignored);
  }
}

// What an answer is not.
void warn_of_answer(const StudyResult& result, const StudyOptions& options, std::ostream& err) {
  const auto is_crashed = [](const Variant& each) { return each.status == VariantStatus::crashed; };
  const auto first = std::ranges::find_if(result.variants, is_crashed);
  if (first != result.variants.end())
    err << "warning: " << options.file.string() << ": " << std::ranges::count_if(result.variants, is_crashed)
        << " of " << result.variants.size() << " variants crashed (variant " << first->number << ": "
        << first->reason << "); --resume runs them again\n";
  const auto* optimum = std::get_if<OptimumResult>(&result.answer);
  if (optimum && !optimum->not_converged.empty())
    err << "warning: " << options.file.string() << ": optimise: " << optimum->not_converged << "\n";
  for (std::size_t i = 0; optimum && i < optimum->doubts.size(); ++i)
    err << "warning: " << options.file.string() << ": optimise.subject_to: " << optimum->doubts[i] << "\n";
  const auto* calibrated = std::get_if<CalibrationResult>(&result.answer);
  for (std::size_t i = 0; calibrated && i < calibrated->active.size(); ++i)
    err << "warning: " << options.file.string() << ": calibrate: the estimate lies at the edge of \""
        << calibrated->active[i]
        << "\", beyond which the measurements would fit better: it has no standard deviations and no "
           "intervals, which are those of an estimate that nothing holds; widen the constraint for them\n";
}

// Quantities whose differences are noise, and so optima and indices of them.
void warn_of_errors(const StudyFile& study, const StudyResult& result, const StudyOptions& options,
                    std::ostream& err) {
  for (const std::string& name : drowned_in_errors(study, result.variants))
    err << "warning: " << options.file.string() << ": quantities: " << in_quotes(name)
        << " differs from variant to variant by less than its errors of mesh and step: what the study finds "
           "of it is their noise; take more elements and shorter steps in the case\n";
}

int run_and_write(const ReadyStudy& ready, const StudyOptions& options, StudyEngine& engine,
                  std::ostream& out, std::ostream& err) {
  silence_openturns();
  const InterruptGuard guard;
  StudyRows rows(options.out / "study.rows",
                 identity_of(ready.study, ready.study_case ? &*ready.study_case : nullptr), options.resume);
  if (!options.resume) remove_former_results(options.out);
  StudyResult result;
  {
    StudyLine line(err, options.quiet);
    const StudyObserver observer{.interrupted = [&] { return guard.interrupted(); },
                                 .progress = [&](const StudyProgress& p) { line.show(p); }};
    result = run_study(ready.study, engine, rows, observer);
  }
  write_results(ready, options, result);
  out << answer_text(ready.study, result) << "open " << (options.out / "study.html").string() << "\n";
  warn_of_answer(result, options, err);
  warn_of_errors(ready.study, result, options, err);
  if (result.interrupted) {
    err << "interrupted after " << result.variants.size() << " variants; go on with --resume\n";
    return exit_interrupted;
  }
  if (result.failure.empty()) return exit_done;
  err << "error: " << options.file.string() << ": " << result.failure << "\n";
  return exit_not_converged;
}

int run_at_one_rank(const ReadyStudy& ready, const StudyOptions& options, StudyEngine& engine,
                    std::ostream& out, std::ostream& err) {
  try {
    return run_and_write(ready, options, engine, out, err);
  } catch (const UnusableRowsError& problem) {
    err << "error: " << problem.what() << "\n";
    return exit_bad_input;
  } catch (const std::runtime_error& problem) {
    err << "error: " << problem.what() << "\n";
    return exit_not_written;
  }
}

int run_under_mpi(const StudyOptions& options, std::ostream& out, std::ostream& err) {
  const MpiSession session;
  const bool first = session.rank() == 0;
  std::ofstream silent;
  const std::optional<ReadyStudy> ready = read_study(options.file, first ? err : silent);
  ExitCode code = ready ? exit_done : exit_bad_input;
  if (first && ready) code = make_directory(*ready, options, err);
  if (!session.agreed(code == exit_done)) return code == exit_done ? exit_bad_input : code;
  if (!first) {
    serve_mpi(session, worker_command(options), ready->study.time_limit);
    return exit_done;
  }
  const std::unique_ptr<StudyEngine> engine = make_mpi_engine(session);
  return run_at_one_rank(*ready, options, *engine, out, err);
}

}  // namespace

int study_command(const StudyOptions& options, std::ostream& out, std::ostream& err) {
  if (started_by_mpi()) return run_under_mpi(options, out, err);
  const std::optional<ReadyStudy> ready = read_study(options.file, err);
  if (!ready) return exit_bad_input;
  if (const ExitCode code = make_directory(*ready, options, err); code != exit_done) return code;
  const std::unique_ptr<StudyEngine> engine =
      make_process_pool(worker_command(options), useful_jobs(options.jobs, err), ready->study.time_limit);
  return run_at_one_rank(*ready, options, *engine, out, err);
}

int study_check_command(const StudyOptions& options, std::ostream& out, std::ostream& err) {
  const std::optional<ReadyStudy> ready = read_study(options.file, err);
  if (!ready) return exit_bad_input;
  const StudyFile& study = ready->study;
  const StudyCase* study_case = ready->study_case ? &*ready->study_case : nullptr;
  out << study_plan_text(study);
  for (const auto& [beam, curve] : study_case ? study_case->curves() : std::map<std::string, StudyCurve>{}) {
    out << "control points of " << beam << "\n";
    const Eigen::Matrix4Xd& points = curve.drawn.control_points();
    for (Eigen::Index i = 0; i < points.cols(); ++i)
      out << "  " << i << "  " << text_of(Eigen::Vector3d(points.col(i).head<3>() / points(3, i)), 6)
          << "  weight " << text_of(points(3, i), 6) << "\n";
  }
  const Variant variant = run_variant(study, study_case, 0, all_values(study, study.nominal()));
  out << "the nominal variant: " << name_of(variant.status) << ", in " << text_of(variant.seconds, 3)
      << " s\n";
  for (std::size_t k = 0; k < variant.quantities.size(); ++k)
    out << "  " << study.quantities[k].name << " = " << text_of(variant.quantities[k], 8) << " "
        << study.quantities[k].unit << "\n";
  if (!variant.reason.empty()) out << "  " << variant.reason << "\n";
  return exit_done;
}

int study_worker_command(const std::filesystem::path& file, std::ostream& err) {
  std::ostringstream messages;  // the study has said them already, where it runs
  const std::optional<ReadyStudy> ready = read_study(file, messages);
  if (!ready) {
    err << messages.str();
    return exit_bad_input;
  }
  return serve_variants(ready->study, ready->study_case ? &*ready->study_case : nullptr);
}

}  // namespace nurbeam
