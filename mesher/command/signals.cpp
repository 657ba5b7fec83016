/// What ends a run early, by POSIX signals: Ctrl-C, time limits, the end of standard input, and crashes.
#include <dlfcn.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/time.h>
#include <unistd.h>

#include <cxxabi.h>
#include <Standard_OutOfMemory.hxx>
#include <algorithm>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <filesystem>
#include <new>
#include <string>
#include <thread>
#include <typeinfo>
#include <vector>

#include "geometry/base/atomic_file.hpp"
#include "geometry/base/printable.hpp"
#include "geometry/base/threads.hpp"
#include "geometry/cad/isolated_reading.hpp"
#include "mesher/command/command.hpp"

namespace quadrille::command {

namespace {

/// Rings once after that many seconds, in place of an earlier alarm; 0 = never.
void ring_after(double seconds) {
  struct itimerval timer {};
  // Rounded up: setitimer takes zero for "never".
  const double microseconds = std::ceil(1e6 * seconds);
  timer.it_value.tv_sec = static_cast<time_t>(microseconds / 1e6);
  timer.it_value.tv_usec = static_cast<suseconds_t>(std::fmod(microseconds, 1e6));
  ::setitimer(ITIMER_REAL, &timer, nullptr);
}

// State of the handlers below, which may call only what is safe in a signal handler.
std::atomic<ExecutionContext*> cancellable{nullptr};
std::atomic<bool> ending{false}, delivers_part{false};
char time_line[512];
constexpr char cancel_line[] = "quadrille: the work was cancelled\n";
constexpr int grace_microseconds = 150000, grace_of_parts_microseconds = 850000;

[[noreturn]] void end_process(const char* line, int code) {
  static std::atomic<bool> told{false};
  if (told.exchange(true)) ::sleep(1);  // another thread ends the process, or this one within a handler
  remove_unfinished_files();
  [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, line, std::strlen(line));
  ::_exit(code);
}

extern "C" void cancel_work(int signal_number) {
  if (ExecutionContext* context = cancellable.load()) context->cancel();
  std::signal(signal_number, SIG_DFL);
  ending.store(true);
  ring_after(1e-6 * grace_microseconds);
}

/// The first alarm means that the time is over: the context notices by itself and gets the grace period. The
/// next alarm, or one after a signal, means that work that should have ended has not. Where a part of the
/// mesh is delivered, the limit was lifted by then, so that it is assembled and written.
extern "C" void handle_alarm(int) {
  if (!ending.exchange(true)) {
    ring_after(1e-6 * (delivers_part ? grace_of_parts_microseconds : grace_microseconds));
    return;
  }
  const ExecutionContext* context = cancellable.load();
  const bool was_cancelled = context != nullptr && context->cancelled();
  if (delivers_part && !was_cancelled && context != nullptr && !context->has_time_limit()) return;
  end_process(was_cancelled ? cancel_line : time_line, was_cancelled ? 130 : 1);
}

extern "C" void handle_cpu_limit(int) {
  end_process("quadrille: the CPU time limit of this process (ulimit -t) is reached\n", 1);
}

/// Copies a line; cuts off what does not fit before its line break.
template <std::size_t n>
void copy_line(char (&buffer)[n], const std::string& line) {
  const std::size_t length = std::min(line.size() - 1, n - 2);
  std::memcpy(buffer, line.data(), length);
  buffer[length] = '\n';
  buffer[length + 1] = 0;
}

std::vector<std::string> whole_files;

void prepare_time_line(double time_limit) {
  copy_line(time_line,
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
  cancellable.store(&context);
  ending.store(false);
  delivers_part.store(partial);
  std::signal(SIGINT, cancel_work);
  std::signal(SIGTERM, cancel_work);
  std::signal(SIGALRM, handle_alarm);
  if (time_limit <= 0) return;
  context.limit_time(time_limit);
  ring_after(time_limit);
}

void CancelOnSignal::reading(const std::filesystem::path& file, double seconds) {
  if (seconds <= 0 || (time_limit_ > 0 && time_limit_ <= seconds)) return;
  copy_line(time_line,
            "quadrille: " + with_options(reading_too_long(printable(file.string()), seconds)) + "\n");
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
  std::signal(SIGALRM, SIG_IGN);
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
  cancellable.store(nullptr);
}

void end_with_input() {
  std::thread([] {
    char ignored[256];
    ssize_t count = 0;
    do {
      count = ::read(STDIN_FILENO, ignored, sizeof(ignored));
    } while (count > 0 || (count < 0 && errno == EINTR));
    ::kill(::getpid(), SIGTERM);
  }).detach();
}

void tell_limits() {
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
  std::signal(SIGXCPU, handle_cpu_limit);
}

#ifdef QUADRILLE_SANITIZED

void report_crashes(const std::filesystem::path&, std::string_view) {}  // the sanitizer's report says more

#else

namespace {

char crash_line[512] = "quadrille: the program crashed\n";

extern "C" [[noreturn]] void handle_crash(int) {
  end_process(crash_line, 1);
}

/// Memory that is lacking ends the program at once: an exception may not pass everywhere (destructors,
/// threads, constructors of static objects), OpenCASCADE swallows it and goes on with less, and to make one
/// takes memory.
[[noreturn]] void end_without_memory() {
  end_process("quadrille: there is not enough memory (a damaged file may promise more than it holds)\n", 1);
}

/// An exception that nobody catches: a crash, unless there was no memory to make one.
[[noreturn]] void handle_termination() {
  if (abi::__cxa_current_exception_type() == nullptr) end_without_memory();
  handle_crash(SIGABRT);
}

/// Lets the handlers run on this thread after endless recursion, when its own stack has no room left.
void give_handlers_a_stack() {
  thread_local char stack[1 << 16];
  stack_t alternative{};
  alternative.ss_sp = stack;
  alternative.ss_size = sizeof(stack);
  ::sigaltstack(&alternative, nullptr);
}

void tell_crashes() {
  std::set_new_handler(end_without_memory);
  std::set_terminate(handle_termination);
  struct sigaction action {};
  action.sa_handler = handle_crash;
  action.sa_flags = SA_ONSTACK;
  for (const int signal_number : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT}) {
    ::sigaction(signal_number, &action, nullptr);
  }
}

/// Called before the constructors of all libraries, which may fail too.
[[gnu::section(".preinit_array"), gnu::used]] void (*const first_call)() = tell_crashes;

}  // namespace

/// Takes the place of the C++ runtime's own function in all libraries: what is thrown for lack of memory may
/// not come from operator new, which calls the handler, of this process or of a child.
extern "C" [[gnu::visibility("default")]] void __cxa_throw(  // NOLINT(bugprone-reserved-identifier)
    void* exception, std::type_info* type, void (*destroy)(void*)) {
  const std::new_handler handler = std::get_new_handler();
  if ((*type == typeid(std::bad_alloc) || *type == typeid(Standard_OutOfMemory)) && handler != nullptr)
    handler();
  static const auto next = reinterpret_cast<decltype(&__cxa_throw)>(::dlsym(RTLD_NEXT, "__cxa_throw"));
  next(exception, type, destroy);
  std::abort();
}

void report_crashes(const std::filesystem::path& file, std::string_view work) {
  copy_line(crash_line, fmt::format("quadrille: {}: {} this file crashed: it may be damaged\n",
                                    printable(file.string()), work));
  give_handlers_a_stack();
  prepare_threads(give_handlers_a_stack);
}

#endif

}  // namespace quadrille::command
