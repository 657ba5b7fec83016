/// Ctrl-C, time limits and crashes on Windows, where handlers and timers run in separate threads.
/// mesher/command/signals.cpp does the same for POSIX.
#include <windows.h>

#include <fmt/format.h>
#include <io.h>

#include <algorithm>
#include <atomic>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <mutex>
#include <string>
#include <thread>

#include "geometry/base/atomic_file.hpp"
#include "geometry/base/printable.hpp"
#include "mesher/command/command.hpp"
#include "mesher/command/signals.hpp"

namespace quadrille::command {

namespace {

std::atomic<ExecutionContext*> cancellable{nullptr};
std::atomic<bool> ending{false}, delivers_part{false};
std::atomic<HANDLE> timer{nullptr};
std::mutex lines;
std::string crash_line, time_line;
constexpr const char* cancel_line = "quadrille: the work was cancelled\n";
constexpr double grace = 0.15, grace_of_parts = 0.85;  // seconds

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

}  // namespace

/// Replaces the timer by one that fires once; 0 = none.
void ring_after(double seconds) {
  HANDLE next = nullptr;
  const auto milliseconds = static_cast<DWORD>(std::clamp(1e3 * seconds, 1.0, 4e9));
  if (seconds > 0)
    ::CreateTimerQueueTimer(&next, nullptr, ring, nullptr, milliseconds, 0, WT_EXECUTEONLYONCE);
  if (HANDLE old = timer.exchange(next)) ::DeleteTimerQueueTimer(nullptr, old, nullptr);
}

namespace {

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

}  // namespace

void set_alarm_line(const std::string& line) {
  const std::lock_guard lock(lines);
  time_line = line;
}

void watch_signals(ExecutionContext& context, bool delivers) {
  cancellable.store(&context);
  ending.store(false);
  delivers_part.store(delivers);
  ::SetConsoleCtrlHandler(cancel_work, TRUE);
}

void stop_watching_signals() {
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
