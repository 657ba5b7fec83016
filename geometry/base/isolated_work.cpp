/// Forks a child that writes its answer to a pipe, with an end mark that a crashed child does not get to.

#include "geometry/base/isolated_work.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <exception>
#include <ext/stdio_filebuf.h>
#include <fstream>
#include <new>
#include <ostream>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "geometry/base/error.hpp"

namespace quadrille {

namespace {

/// An end of a pipe, which it closes.
using PipeEnd = __gnu_cxx::stdio_filebuf<char>;

Error no_process(const std::string& name) {
  return failure(name,
                 fmt::format("{}: cannot be processed in a child process: {}", name, std::strerror(errno)));
}

/// A child of this process. The destructor kills it and waits for it.
class Child {
 public:
  explicit Child(pid_t id) : id_(id) {}
  ~Child() {
    if (id_ <= 0) return;
    ::kill(id_, SIGKILL);
    while (::waitpid(id_, nullptr, 0) < 0 && errno == EINTR) {
    }
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  bool ended() {
    int status = 0;
    const pid_t answer = ::waitpid(id_, &status, WNOHANG);
    // An error: the surrounding program waits for all of its children and has already reaped this one.
    if (answer == 0 || (answer < 0 && errno == EINTR)) return false;
    id_ = 0;
    return true;
  }

 private:
  pid_t id_;
};

constexpr std::string_view answer_without_memory = "\nquadrille has answered: M";
constexpr std::string_view end_of_answer = answer_without_memory.substr(0, answer_without_memory.size() - 1);

/// The kind of a child's answer, which it writes at the very end. A child that crashes does not get there.
enum Answer : char {
  result = 'R',
  failure_sentence = 'F',
  usage_sentence = 'U',
  no_memory = answer_without_memory.back()
};

std::string sentence_about(const std::string& subject, const std::exception& problem) {
  return subject + ": " + sentence_of(problem);
}

Answer answer(const std::string& subject, const std::function<void(std::ostream&)>& work,
              std::ostream& out) try {
  work(out);
  return result;
} catch (const Error& error) {
  out << error.what();
  return error.kind() == Error::Kind::usage ? usage_sentence : failure_sentence;
} catch (const std::exception& problem) {
  out << sentence_about(subject, problem);
  return failure_sentence;
}

/// What the child has made, from all that it wrote. Throws the Error that the child has thrown; Error
/// (failure) if the end mark is missing.
std::string result_of(const IsolatedWork& options, std::string bytes) {
  const std::size_t length = end_of_answer.size() + 1;
  const std::string_view all = bytes;
  if (all.size() < length || !all.substr(all.size() - length).starts_with(end_of_answer))
    throw failure(options.subject, options.crashed);
  const char given = bytes.back();
  if (given == no_memory) throw failure(options.subject, sentence_about(options.subject, std::bad_alloc()));
  bytes.resize(bytes.size() - length);
  if (given == failure_sentence) throw failure(options.subject, bytes);
  if (given == usage_sentence) throw usage_error(options.subject, bytes);
  return bytes;
}

int answering_pipe = -1;  ///< of a child

/// Lack of memory ends a child at once: libraries swallow the exception and go on with less, or wait forever
/// for what it left half made, as oneTBB does.
[[noreturn]] void end_without_memory() {
  [[maybe_unused]] const ssize_t written =
      ::write(answering_pipe, answer_without_memory.data(), answer_without_memory.size());
  ::_exit(1);
}

/// Detaches the child from the program's handlers and standard streams. It ends with its parent, even
/// if the parent is killed.
void become_worker(pid_t parent, int pipe) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(1);  // the parent had already been killed
  for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGTERM, SIGALRM, SIGPIPE})
    std::signal(signal, SIG_DFL);
  // The parent tells what happens here, and the unfinished files are its own.
  answering_pipe = pipe;
  std::set_new_handler(end_without_memory);
  std::set_terminate([] { ::_exit(1); });
  std::signal(SIGINT, SIG_IGN);  // Ctrl-C reaches the whole group; the parent decides
  const rlimit no_core{0, 0};
  ::setrlimit(RLIMIT_CORE, &no_core);
  if (const int null = ::open("/dev/null", O_RDWR); null >= 0) {
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) ::dup2(null, stream);
  }
}

/// Limits the address space to what is mapped now plus `bytes`.
void limit_memory(std::size_t bytes) {
  std::size_t pages = 0;
  if (!(std::ifstream("/proc/self/statm") >> pages)) return;
  const rlim_t most = pages * static_cast<std::size_t>(::sysconf(_SC_PAGESIZE)) + bytes;
  const rlimit limit{most, most};
  ::setrlimit(RLIMIT_AS, &limit);
}

/// No exception leaves it: it would go on as if the child were the parent.
[[noreturn]] void work_as_child(const IsolatedWork& options, const std::function<void(std::ostream&)>& work,
                                PipeEnd& pipe) noexcept {
  if (options.memory > 0) limit_memory(options.memory);
  std::ostream out(&pipe);
  const Answer given = answer(options.subject, work, out);
  out << end_of_answer << static_cast<char>(given);
  out.flush();
  ::_exit(0);
}

/// Everything that the child writes until it ends.
std::string listen(Child& child, int pipe, const IsolatedWork& options) {
  constexpr int interval = 20;  // milliseconds
  std::vector<char> chunk(1 << 16);
  std::string bytes;
  const auto start = std::chrono::steady_clock::now();
  for (bool ended = false;;) {
    struct pollfd watched {
      pipe, POLLIN, 0
    };
    if (::poll(&watched, 1, ended ? 0 : interval) > 0) {
      const ssize_t count = ::read(pipe, chunk.data(), chunk.size());
      if (count == 0) return bytes;
      if (count < 0 && errno != EINTR) throw no_process(options.subject);
      if (count > 0) bytes.append(chunk.data(), count);
    } else if (ended) {
      return bytes;
    } else {
      ended = child.ended();
    }
    if (options.context != nullptr) options.context->report(options.stage, 0);
    const std::chrono::duration<double> past = std::chrono::steady_clock::now() - start;
    if (options.time_limit > 0 && past.count() > options.time_limit)
      throw failure(options.subject, options.too_long);
  }
}

}  // namespace

std::string run_isolated(const IsolatedWork& options, const std::function<void(std::ostream&)>& work) {
  if (options.context != nullptr) options.context->check();
  std::array<int, 2> ends{-1, -1};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) throw no_process(options.subject);
  PipeEnd heard(ends[0], std::ios::in | std::ios::binary), told(ends[1], std::ios::out | std::ios::binary);
  const pid_t parent = ::getpid(), id = ::fork();
  if (id < 0) throw no_process(options.subject);
  if (id == 0) {
    become_worker(parent, told.fd());
    heard.close();  // otherwise a write to a full pipe would wait for this process itself to read
    work_as_child(options, work, told);
  }
  Child child(id);
  told.close();
  return result_of(options, listen(child, heard.fd(), options));
}

}  // namespace quadrille
