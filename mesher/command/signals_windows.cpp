/// Ctrl-C, time limits and crashes on Windows, where handlers and timers run in separate threads.
/// mesher/command/signals.cpp does the same for POSIX.
#include <windows.h>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <io.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "geometry/base/atomic_file.hpp"
#include "geometry/base/printable.hpp"
#include "geometry/cad/isolated_reading.hpp"
#include "mesher/command/command.hpp"
#include "mesher/command/setting_options.hpp"

namespace quadrille::command {

namespace {

std::atomic<ExecutionContext*> cancellable{nullptr};
std::atomic<bool> ending{false}, delivers_part{false};
std::atomic<HANDLE> timer{nullptr};
std::mutex lines;
std::string crash_line, time_line;
constexpr const char* cancel_line = "quadrille: the work was cancelled\n";
constexpr double grace = 0.15, grace_of_parts = 0.85;  // seconds

void ring_after(double seconds);

[[noreturn]] void end_process(const std::string& line, unsigned code) {
  remove_unfinished_files();
  ::_write(::_fileno(stderr), line.data(), static_cast<unsigned>(line.size()));
  ::TerminateProcess(::GetCurrentProcess(), code);
  std::abort();  // not reached
}

/// Does the same as the SIGALRM handler in signals.cpp.
void CALLBACK ring(void*, BOOLEAN) {
  if (!ending.exchange(true)) {
    ring_after(delivers_part ? grace_of_parts : grace);
    return;
  }
  const ExecutionContext* context = cancellable.load();
  const bool was_cancelled = context != nullptr && context->cancelled();
  if (delivers_part && !was_cancelled && context != nullptr && !context->has_time_limit()) return;
  std::string line = cancel_line;
  if (!was_cancelled) {
    const std::lock_guard lock(lines);
    line = time_line;
  }
  end_process(line, was_cancelled ? 130 : 1);
}

/// Replaces the timer by one that fires once; 0 = none.
void ring_after(double seconds) {
  HANDLE next = nullptr;
  const auto milliseconds = static_cast<DWORD>(std::clamp(1e3 * seconds, 1.0, 4e9));
  if (seconds > 0)
    ::CreateTimerQueueTimer(&next, nullptr, ring, nullptr, milliseconds, 0, WT_EXECUTEONLYONCE);
  if (HANDLE old = timer.exchange(next)) ::DeleteTimerQueueTimer(nullptr, old, nullptr);
}

/// A second Ctrl-C ends the process at once.
BOOL WINAPI cancel_work(DWORD) {
  ExecutionContext* context = cancellable.load();
  if (context == nullptr || ending.exchange(true)) end_process(cancel_line, 130);
  context->cancel();
  ring_after(grace);
  return TRUE;
}

LONG WINAPI handle_crash(EXCEPTION_POINTERS*) {
  end_process(crash_line, 1);
}

extern "C" void handle_abort(int) {
  end_process(crash_line, 1);
}

std::vector<std::string> whole_files;

void prepare_time_line(double time_limit) {
  const std::lock_guard lock(lines);
  time_line = fmt::format("quadrille: the time limit of {:g} s is reached{}\n", time_limit, left_behind());
}

}  // namespace

std::string left_behind() {
  if (whole_files.empty()) return ", and nothing was written";
  return fmt::format(", and {} was written before", fmt::join(whole_files, ", "));
}

CancelOnSignal::CancelOnSignal(ExecutionContext& context, double time_limit, bool partial)
    : time_limit_(time_limit), start_(std::chrono::steady_clock::now()) {
  cancellable.store(&context);
  ending.store(false);
  delivers_part.store(partial);
  whole_files.clear();
  prepare_time_line(time_limit);
  ::SetConsoleCtrlHandler(cancel_work, TRUE);
  if (time_limit <= 0) return;
  context.limit_time(time_limit);
  ring_after(time_limit);
}

void CancelOnSignal::reading(const std::filesystem::path& file, double seconds) {
  if (seconds <= 0 || (time_limit_ > 0 && time_limit_ <= seconds)) return;
  {
    const std::lock_guard lock(lines);
    time_line = "quadrille: " + with_options(reading_too_long(printable(file.string(), ' '), seconds)) + "\n";
  }
  ring_after(seconds);
}

void CancelOnSignal::reading_is_done() {
  const std::chrono::duration<double> past = std::chrono::steady_clock::now() - start_;
  ring_after(0);
  prepare_time_line(time_limit_);
  if (time_limit_ > 0) ring_after(std::max(time_limit_ - past.count(), 1e-3));
}

void CancelOnSignal::wrote(const std::filesystem::path& file) {
  whole_files.push_back(printable(file.string(), ' '));
  prepare_time_line(time_limit_);
}

CancelOnSignal::~CancelOnSignal() {
  ring_after(0);
  ::SetConsoleCtrlHandler(cancel_work, FALSE);
  cancellable.store(nullptr);
}

void end_with_input() {
  std::thread([] {
    char ignored[256];
    while (::_read(::_fileno(stdin), ignored, sizeof(ignored)) > 0) {
    }
    cancel_work(CTRL_BREAK_EVENT);
  }).detach();
}

void tell_limits() {}

void report_crashes(const std::filesystem::path& file, std::string_view work) {
  crash_line =
      fmt::format("quadrille: {}: {} this file crashed: it may be damaged\n", printable(file.string()), work);
  ULONG stack = 1 << 16;  // after endless recursion there is no other left
  ::SetThreadStackGuarantee(&stack);
  ::SetUnhandledExceptionFilter(handle_crash);
  std::signal(SIGABRT, handle_abort);
}

}  // namespace quadrille::command
