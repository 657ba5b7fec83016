#include "mesher/command/command.hpp"

#include <fmt/format.h>
#include <sys/stat.h>
#include <sys/time.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstring>
#include <thread>

#include "geometry/base/atomic_file.hpp"
#include "geometry/base/error.hpp"
#include "geometry/base/isolated_work.hpp"
#include "geometry/base/printable.hpp"
#include "geometry/cad/isolated_reading.hpp"
#include "mesher/command/setting_options.hpp"
#include "mesher/quadrille.hpp"

namespace quadrille::command {

void print(std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = ::write(STDOUT_FILENO, text.data(), text.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0)
      throw failure("stdout", fmt::format("cannot write to the standard output: {}", std::strerror(errno)));
    text.remove_prefix(static_cast<std::size_t>(written));
  }
}

void require_readable(const std::filesystem::path& path) {
  const std::string name = path.string();
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0)
    throw failure(name, fmt::format("{}: cannot be read: {}", name, std::strerror(errno)));
  if (S_ISDIR(status.st_mode)) throw failure(name, fmt::format("{}: is a folder, not a file", name));
  if (::access(path.c_str(), R_OK) != 0)
    throw failure(name, fmt::format("{}: cannot be read: {}", name, std::strerror(errno)));
}

void require_writable(const std::filesystem::path& path) {
  const std::string name = path.string();
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored))
    throw usage_error(name, fmt::format("{}: is a folder, not a file", name));
  if (std::filesystem::exists(path, ignored) && !std::filesystem::is_regular_file(path, ignored)) return;
  const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : ".";
  if (!std::filesystem::is_directory(folder, ignored))
    throw usage_error(name, fmt::format("{}: the folder {} does not exist", name, folder.string()));
  if (::access(folder.c_str(), W_OK | X_OK) != 0)
    throw usage_error(name, fmt::format("{}: the folder {} is not writable: {}", name, folder.string(),
                                        std::strerror(errno)));
}

void require_ending(const std::filesystem::path& path, std::string_view ending, std::string_view option) {
  if (path.extension() != ending)
    throw usage_error(std::string(option),
                      fmt::format("{}: the file name must end in {}, not {}", option, ending, path.string()));
  require_writable(path);
}

void draw_apart(const std::filesystem::path& path, ExecutionContext& context,
                const std::function<void()>& draw) {
  IsolatedWork options;
  options.subject = path.string();
  options.crashed = fmt::format(
      "{}: the picture cannot be drawn: the renderer crashed, for want of memory or threads "
      "perhaps",
      path.string());
  options.context = &context;
  options.stage = Stage::write;
  const auto work = [&](std::ostream&) {
    try {
      draw();
    } catch (const std::exception& problem) {
      const std::string sentence = problem.what();
      if (sentence.rfind(path.string(), 0) == 0) throw;  // the file, not the renderer
      throw failure(path.string(),
                    fmt::format("{}: the picture cannot be drawn ({})", path.string(), sentence));
    }
  };
  run_isolated(options, work, [](std::istream&) {});
}

namespace {

bool is_regular(const std::filesystem::path& path) {
  std::error_code none;
  const auto type = std::filesystem::status(path, none).type();
  return type == std::filesystem::file_type::regular || type == std::filesystem::file_type::not_found;
}

bool is_same_file(const std::filesystem::path& a, const std::filesystem::path& b) {
  std::error_code none;
  if (std::filesystem::equivalent(a, b, none)) return is_regular(a);
  // Those that are still to be made.
  const auto place = [&](const std::filesystem::path& path) {
    return std::filesystem::weakly_canonical(std::filesystem::absolute(written_file(path), none), none);
  };
  return is_regular(a) && is_regular(b) && place(a) == place(b);
}

}  // namespace

void require_different_files(const std::vector<NamedFile>& files) {
  for (std::size_t i = 0; i < files.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      const auto& [before, first] = files[k];
      const auto& [argument, second] = files[i];
      if (first.empty() || second.empty() || !is_same_file(first, second)) continue;
      throw usage_error(argument, fmt::format("{} {} is the same file as {} {}: give each a file of its own",
                                              argument, second.string(), before, first.string()));
    }
  }
}

void require_usable(const ModelFiles& files) {
  for (const std::filesystem::path& output : files.outputs) require_writable(output);
  if (!files.report.empty()) require_writable(files.report);
  if (!files.picture.empty()) require_ending(files.picture, ".png", "--picture");
  if (!files.write_size_field.empty()) require_ending(files.write_size_field, ".vdb", "--write-size-field");
  if (!files.size_field.empty()) require_readable(files.size_field);
  require_readable(files.input);
  std::vector<NamedFile> named{{"IN", files.input}, {"--size-field", files.size_field}};
  for (const std::filesystem::path& output : files.outputs) named.push_back({"-o", output});
  named.insert(named.end(), {{"--report", files.report},
                             {"--picture", files.picture},
                             {"--write-size-field", files.write_size_field}});
  require_different_files(named);
}

ProgressDisplay::ProgressDisplay(bool quiet)
    : quiet_(quiet), terminal_(::isatty(STDERR_FILENO) == 1), last_(std::chrono::steady_clock::now()) {}

ProgressDisplay::~ProgressDisplay() {
  if (drawn_ && terminal_) fmt::print(stderr, "\r\033[K");
}

bool ProgressDisplay::show(std::string_view stage, double fraction) {
  if (quiet_) return true;
  const auto interval = std::chrono::milliseconds(terminal_ ? 100 : 500);
  const auto now = std::chrono::steady_clock::now();
  if (now - last_ < interval) return true;
  last_ = now;
  const int percent = static_cast<int>(100 * std::min(std::max(fraction, 0.0), 1.0));
  if (terminal_) {
    draw_bar(stage, percent);
    return true;
  }
  std::string text = fmt::format("progress: {} {} %\n", stage, percent);
  if (text == last_text_) return true;
  std::fputs(text.c_str(), stderr);
  last_text_ = std::move(text);
  return true;
}

void ProgressDisplay::draw_bar(std::string_view stage, int percent) {
  constexpr int width = 30;
  const int full = percent * width / 100;
  fmt::print(stderr, "\r\033[K{:<12} [{:#<{}}{:.<{}}] {:3} %", stage, "", full, "", width - full, percent);
  std::fflush(stderr);
  drawn_ = true;
}

namespace {

// What the handlers below need; they may call nothing that is not safe in a signal handler.
std::atomic<ExecutionContext*> cancellable{nullptr};
std::atomic<bool> ending{false};
char crash_line[512], time_line[512];
constexpr char cancel_line[] = "quadrille: the work was cancelled\n";
constexpr int grace_microseconds = 150000;

void ring_after(double seconds) {
  struct itimerval timer {};
  timer.it_value.tv_sec = static_cast<time_t>(seconds);
  timer.it_value.tv_usec = static_cast<suseconds_t>(1e6 * (seconds - std::floor(seconds)));
  ::setitimer(ITIMER_REAL, &timer, nullptr);
}

[[noreturn]] void end_process(const char* line, int code) {
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

/// The time is over (the context knows by itself), or work that should have ended has not.
extern "C" void handle_alarm(int) {
  if (!ending.exchange(true)) {
    ring_after(1e-6 * grace_microseconds);
    return;
  }
  const ExecutionContext* context = cancellable.load();
  const bool was_cancelled = context != nullptr && context->cancelled();
  end_process(was_cancelled ? cancel_line : time_line, was_cancelled ? 130 : 1);
}

extern "C" void handle_crash(int) {
  end_process(crash_line, 1);
}

extern "C" void handle_cpu_limit(int) {
  end_process("quadrille: the CPU time that this process may use (ulimit -t) is over\n", 1);
}

/// Cuts what does not fit.
template <std::size_t n>
void copy_line(char (&buffer)[n], const std::string& line) {
  const std::size_t length = std::min(line.size(), n - 2);
  std::memcpy(buffer, line.data(), length);
  buffer[length] = '\n';
  buffer[length + 1] = 0;
}

std::vector<std::string> whole_files;

void prepare_time_line(double time_limit) {
  copy_line(time_line,
            fmt::format("quadrille: the time limit of {:g} s is over{}", time_limit, left_behind()));
}

}  // namespace

std::string left_behind() {
  if (whole_files.empty()) return ", and nothing was written";
  return fmt::format(", and {} was written before", fmt::join(whole_files, ", "));
}

CancelOnSignal::CancelOnSignal(ExecutionContext& context, double time_limit)
    : time_limit_(time_limit), start_(std::chrono::steady_clock::now()) {
  cancellable.store(&context);
  ending.store(false);
  whole_files.clear();
  prepare_time_line(time_limit);
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
            "quadrille: " + with_options(reading_too_long(printable(file.string(), ' '), seconds)));
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

void report_crashes(const std::filesystem::path& file, std::string_view work) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  static_cast<void>(file), static_cast<void>(work);  // the sanitizer tells more
#else
  copy_line(crash_line, fmt::format("quadrille: {}: {} this file crashed: it may be damaged",
                                    printable(file.string()), work));
  static char stack[1 << 16];  // crashes by endless recursion leave no other
  stack_t alternative{};
  alternative.ss_sp = stack;
  alternative.ss_size = sizeof(stack);
  ::sigaltstack(&alternative, nullptr);
  struct sigaction action {};
  action.sa_handler = handle_crash;
  action.sa_flags = SA_ONSTACK;
  for (const int signal_number : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT}) {
    ::sigaction(signal_number, &action, nullptr);
  }
#endif
}

void write_outputs(const ShellMesh& mesh, const MeshFiles& files, const Settings& settings,
                   ExecutionContext& context, CancelOnSignal& cancel) {
  const StageTimer timer(context, Stage::write);
  WriteOptions options = settings.write;
  options.threads = settings.threads;
  options.title = fmt::format("Quadrille {}: {}", version(), files.input.filename().string());
  const double count = static_cast<double>(files.outputs.size());
  for (std::size_t i = 0; i < files.outputs.size(); ++i) {
    context.report(Stage::write, static_cast<double>(i) / count);
    write_mesh(mesh, files.outputs[i], options);
    cancel.wrote(files.outputs[i]);
  }
  if (!files.picture.empty()) draw_apart(files.picture, context, [&] { write_picture(mesh, files.picture); });
}

}  // namespace quadrille::command
