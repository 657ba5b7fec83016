#include "mesher/command/command.hpp"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>

#include "geometry/error.hpp"

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

void require_threads(int threads) {
  constexpr int most = 4096;
  if (threads < 0 || threads > most)
    throw usage_error("--threads",
                      fmt::format("--threads must be between 0 (all cores) and {}, not {}", most, threads));
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

std::atomic<ExecutionContext*> cancellable{nullptr};

extern "C" void cancel_work(int signal_number) {
  if (ExecutionContext* context = cancellable.load()) context->cancel();
  std::signal(signal_number, SIG_DFL);
}

}  // namespace

CancelOnSignal::CancelOnSignal(ExecutionContext& context) {
  cancellable.store(&context);
  std::signal(SIGINT, cancel_work);
  std::signal(SIGTERM, cancel_work);
}

CancelOnSignal::~CancelOnSignal() {
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
  cancellable.store(nullptr);
}

}  // namespace quadrille::command
