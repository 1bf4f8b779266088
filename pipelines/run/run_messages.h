#pragma once
#include <chrono>
#include <condition_variable>
#include <filesystem>
#include <iosfwd>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "cad_import/report/diagnostic.h"

namespace nurbeam {

/// What a run tells on a stream while it goes on: lines for people, or one JSON object a line for a program.
///
/// JSON lines have one of these forms, in any order; a reader skips keys that it does not know:
///
///   {"severity": "warning", "where": "case.json: beams[0]", "message": "..."}
///   {"text": "largest displacement 3 mm (cable, s = 1 m)"}
///   {"phase": "motion", "fraction": 0.25, "time": 1.25, "seconds": 0.8, "seconds_to_go": 2.4}
///   {"phase": "ended", "code": 0, "out": "case_results"}
///
/// A phase is "model", "equilibrium", "motion", "modes", "accuracy", "results" or "ended". While a phase
/// lasts its line comes every 0.2 s, and one when it begins. `fraction` is 0 to 1, `time` the simulated time
/// [s], of a static analysis the load factor; `seconds` of wall time since the phase began. What is not known
/// is null.
class RunMessages {
 public:
  enum class Form { text, json };

  RunMessages(std::ostream& stream, Form form);
  ~RunMessages();
  RunMessages(const RunMessages&) = delete;
  RunMessages& operator=(const RunMessages&) = delete;

  bool is_json() const { return form_ == Form::json; }
  /// For what is told in text alone.
  std::ostream& stream() { return stream_; }
  void findings(const std::vector<Diagnostic>& findings);
  /// An error that belongs to no place of the case: "error: MESSAGE".
  void error(const std::string& message);
  /// How a run has failed: "FILE: error: MESSAGE".
  void failure(const std::filesystem::path& file, const std::string& message);
  /// A line for people.
  void text(const std::string& line);

  /// A phase begins. In text these three say nothing.
  void begin(const std::string& phase);
  void reach(double fraction, double time);
  void end(int code, const std::filesystem::path& out);

 private:
  using Clock = std::chrono::steady_clock;
  struct Phase {
    std::string name;
    Clock::time_point begun;
    std::optional<double> fraction, time;
    double first_fraction = 0;  ///< the first one that was told: of a resumed run not 0
  };

  void put(const std::string& line);
  void tell_phase();
  void tell_every_fifth_of_a_second();
  void stop();

  std::ostream& stream_;
  Form form_;
  std::mutex mutex_;  // of all below, and of the stream
  std::condition_variable ending_;
  bool ended_ = false;
  std::optional<Phase> phase_;
  std::thread teller_;
};

}  // namespace nurbeam
