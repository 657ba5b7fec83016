/// Keeps the time limits and the message for a run that is ended; signals.hpp rings.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

#include "geometry/base/printable.hpp"
#include "geometry/cad/isolated_reading.hpp"
#include "mesher/command/command.hpp"
#include "mesher/command/setting_options.hpp"
#include "mesher/command/signals.hpp"

namespace quadrille::command {

namespace {

std::vector<std::string> whole_files;

void prepare_time_line(double time_limit) {
  set_alarm_line(
      fmt::format("quadrille: the time limit of {:g} s is reached{}\n", time_limit, left_behind()));
}

}  // namespace

std::string left_behind() {
  if (whole_files.empty()) return ", and nothing was written";
  return fmt::format(", and {} was written before", fmt::join(whole_files, ", "));
}

CancelOnSignal::CancelOnSignal(ExecutionContext& context, double time_limit, bool partial)
    : time_limit_(time_limit), start_(std::chrono::steady_clock::now()) {
  whole_files.clear();
  prepare_time_line(time_limit);
  watch_signals(context, partial);
  if (time_limit <= 0) return;
  context.limit_time(time_limit);
  ring_after(time_limit);
}

void CancelOnSignal::reading(const std::filesystem::path& file, double seconds) {
  if (seconds <= 0 || (time_limit_ > 0 && time_limit_ <= seconds)) return;
  set_alarm_line("quadrille: " + with_options(reading_too_long(printable(file.string()), seconds)) + "\n");
  ring_after(seconds);
}

void CancelOnSignal::reading_is_done() {
  const std::chrono::duration<double> past = std::chrono::steady_clock::now() - start_;
  ring_after(0);
  prepare_time_line(time_limit_);
  if (time_limit_ > 0) ring_after(std::max(time_limit_ - past.count(), 1e-3));
}

void CancelOnSignal::wrote(const std::filesystem::path& file) {
  whole_files.push_back(printable(file.string()));
  prepare_time_line(time_limit_);
}

CancelOnSignal::~CancelOnSignal() {
  ring_after(0);
  stop_watching_signals();
}

}  // namespace quadrille::command
