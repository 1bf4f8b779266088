#include "pipelines/run/run_messages.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <ostream>

#include "pipelines/diagnostics/print_diagnostics.h"

namespace nurbeam {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::chrono::milliseconds interval{200};

// Names of files may be no UTF-8: what cannot be read is replaced.
std::string line_of(const Json& json) {
  return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

Json number_or_null(const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); }

Json finding(const std::string& severity, const std::string& where, const std::string& message) {
  return {{"severity", severity}, {"where", where}, {"message", message}};
}

}  // namespace

RunMessages::RunMessages(std::ostream& stream, Form form) : stream_(stream), form_(form) {}

RunMessages::~RunMessages() { stop(); }

void RunMessages::stop() {
  {
    const std::lock_guard lock(mutex_);
    ended_ = true;
  }
  ending_.notify_all();
  if (teller_.joinable()) teller_.join();
}

void RunMessages::put(const std::string& line) {
  const std::lock_guard lock(mutex_);
  stream_ << line << std::endl;
}

void RunMessages::findings(const std::vector<Diagnostic>& findings) {
  if (!is_json()) return print_diagnostics(stream_, findings);
  for (const Diagnostic& each : findings)
    put(line_of(finding(severity_name(each.severity), each.where, each.message)));
}

void RunMessages::error(const std::string& message) {
  put(is_json() ? line_of(finding("error", "", message)) : "error: " + message);
}

void RunMessages::failure(const std::filesystem::path& file, const std::string& message) {
  put(is_json() ? line_of(finding("error", file.string(), message)) : file.string() + ": error: " + message);
}

void RunMessages::text(const std::string& line) {
  if (is_json())
    put(line_of(Json{{"text", line}}));
  else
    stream_ << line << "\n";
}

void RunMessages::begin(const std::string& phase) {
  if (!is_json()) return;
  const std::lock_guard lock(mutex_);
  if (phase_ && phase_->name == phase) return;
  phase_ = {.name = phase, .begun = Clock::now()};
  tell_phase();
  if (!teller_.joinable()) teller_ = std::thread([this] { tell_every_fifth_of_a_second(); });
}

void RunMessages::reach(double fraction, double time) {
  if (!is_json()) return;
  const std::lock_guard lock(mutex_);
  if (!phase_) return;
  if (!phase_->fraction) phase_->first_fraction = fraction;
  phase_->fraction = std::clamp(fraction, 0.0, 1.0);
  phase_->time = time;
}

void RunMessages::end(int code, const std::filesystem::path& out) {
  stop();
  if (is_json()) put(line_of({{"phase", "ended"}, {"code", code}, {"out", out.string()}}));
}

// Precondition: the mutex is held.
void RunMessages::tell_phase() {
  const double seconds = std::chrono::duration<double>(Clock::now() - phase_->begun).count();
  std::optional<double> to_go;
  if (phase_->fraction && *phase_->fraction > phase_->first_fraction)
    to_go = seconds * (1 - *phase_->fraction) / (*phase_->fraction - phase_->first_fraction);
  stream_ << line_of({{"phase", phase_->name},
                      {"fraction", number_or_null(phase_->fraction)},
                      {"time", number_or_null(phase_->time)},
                      {"seconds", seconds},
                      {"seconds_to_go", number_or_null(to_go)}})
          << std::endl;
}

void RunMessages::tell_every_fifth_of_a_second() {
  std::unique_lock lock(mutex_);
  while (!ending_.wait_for(lock, interval, [this] { return ended_; })) tell_phase();
}

}  // namespace nurbeam
