#include "geometry/base/isolated_work.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <ext/stdio_filebuf.h>
#include <fstream>
#include <istream>
#include <iterator>
#include <new>
#include <ostream>

#include <fmt/format.h>

#include "geometry/base/error.hpp"

namespace quadrille {

namespace {

/// The first byte of what a child hands over, written last: a child that crashes leaves nothing.
enum Answer : char { nothing = 0, result_follows = 'R', failure_follows = 'F', usage_follows = 'U' };

class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor() { close(); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  operator int() const { return number_; }
  void close() {
    if (number_ >= 0) ::close(number_);
    number_ = -1;
  }

 private:
  int number_;
};

Error no_process(const std::string& name) {
  return failure(
      name, fmt::format("{}: cannot be worked on in a process of its own: {}", name, std::strerror(errno)));
}

/// A child of this process; ended and waited for when it goes.
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
    // An error: the program around us waits for all its children, and has this one.
    if (answer == 0 || (answer < 0 && errno == EINTR)) return false;
    id_ = 0;
    return true;
  }

 private:
  pid_t id_;
};

/// What signal handlers and open streams the program has are none of the child's business.
void become_worker() {
  for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGTERM, SIGALRM})
    std::signal(signal, SIG_DFL);
  std::signal(SIGINT, SIG_IGN);  // Ctrl-C reaches the whole group; the parent decides
  const rlimit no_core{0, 0};
  ::setrlimit(RLIMIT_CORE, &no_core);
  if (const int null = ::open("/dev/null", O_RDWR); null >= 0) {
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) ::dup2(null, stream);
  }
}

/// Beyond what is mapped now.
void limit_memory(std::size_t bytes) {
  std::size_t pages = 0;
  if (!(std::ifstream("/proc/self/statm") >> pages)) return;
  const rlim_t most = pages * static_cast<std::size_t>(::sysconf(_SC_PAGESIZE)) + bytes;
  const rlimit limit{most, most};
  ::setrlimit(RLIMIT_AS, &limit);
}

/// What the child writes after the first byte, and that byte.
Answer answer(const std::string& subject, const std::function<void(std::ostream&)>& work, std::ostream& out) {
  try {
    work(out);
    return result_follows;
  } catch (const Error& error) {
    out << error.what();
    return error.kind() == Error::Kind::usage ? usage_follows : failure_follows;
  } catch (const std::bad_alloc&) {
    out << subject << ": is too large for the memory of this machine";
  } catch (const std::exception& problem) {
    out << subject << ": " << problem.what();
  }
  return failure_follows;
}

[[noreturn]] void work_as_child(const IsolatedWork& options, const std::function<void(std::ostream&)>& work,
                                int result) {
  become_worker();
  if (options.memory > 0) limit_memory(options.memory);
  bool written = false;
  Answer first = nothing;
  {
    __gnu_cxx::stdio_filebuf<char> buffer(::dup(result), std::ios::out | std::ios::binary);
    std::ostream out(&buffer);
    out.put(nothing);
    first = answer(options.subject, work, out);
    out.flush();
    written = out.good();
  }
  if (written && ::pwrite(result, &first, 1, 0) != 1) ::_exit(1);
  ::_exit(0);
}

void wait_for(Child& child, int alive, const IsolatedWork& options) {
  constexpr int interval = 20;  // milliseconds
  const auto start = std::chrono::steady_clock::now();
  while (!child.ended()) {
    struct pollfd watched {
      alive, POLLIN, 0
    };
    // The child holds the other end, so that this returns as soon as it ends.
    ::poll(&watched, 1, interval);
    if (options.context != nullptr) options.context->report(options.stage, 0);
    const std::chrono::duration<double> past = std::chrono::steady_clock::now() - start;
    if (options.time_limit > 0 && past.count() > options.time_limit)
      throw failure(options.subject, options.too_long);
  }
}

void take_result(const IsolatedWork& options, int result, const std::function<void(std::istream&)>& take) {
  ::lseek(result, 0, SEEK_SET);
  __gnu_cxx::stdio_filebuf<char> buffer(::dup(result), std::ios::in | std::ios::binary);
  std::istream in(&buffer);
  const int first = in.get();
  if (first == result_follows) return take(in);
  const std::string sentence{std::istreambuf_iterator<char>(in), {}};
  if (first == failure_follows) throw failure(options.subject, sentence);
  if (first == usage_follows) throw usage_error(options.subject, sentence);
  throw failure(options.subject, options.crashed);
}

}  // namespace

void run_isolated(const IsolatedWork& options, const std::function<void(std::ostream&)>& work,
                  const std::function<void(std::istream&)>& take) {
  if (options.context != nullptr) options.context->check();
  const Descriptor result(::memfd_create("quadrille", MFD_CLOEXEC));
  std::array<int, 2> ends{-1, -1};
  if (result < 0 || ::pipe2(ends.data(), O_CLOEXEC) != 0) throw no_process(options.subject);
  const Descriptor alive(ends[0]);
  Descriptor held(ends[1]);
  const pid_t id = ::fork();
  if (id < 0) throw no_process(options.subject);
  if (id == 0) work_as_child(options, work, result);
  Child child(id);
  held.close();
  wait_for(child, alive, options);
  take_result(options, result, take);
}

}  // namespace quadrille
