/// Work in a child process: it ends with the process that wants it, and where its memory does. What it writes
/// arrives whole, and what breaks off is told from it.

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <new>
#include <ostream>
#include <stdexcept>
#include <string>
#include <thread>

#include "geometry/base/error.hpp"
#include "geometry/base/isolated_work.hpp"
#include "tests/support/process.hpp"

namespace quadrille {
namespace {

using Work = std::function<void(std::ostream&)>;

/// Long, for busy machines, but shorter than the work of these tests.
bool within_patience(const std::function<bool()>& holds) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(3);
  while (std::chrono::steady_clock::now() < end) {
    if (holds()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return false;
}

/// One that has ended and was not waited for is left as a zombie where nobody adopts it.
bool is_running(pid_t process) {
  std::ifstream stat("/proc/" + std::to_string(process) + "/stat");
  std::string number, name, state;
  return stat >> number >> name >> state && state != "Z";
}

/// Kills a process whose isolated work is at work; true if that ends too.
bool ends_with_its_parent(const Work& work) {
  const test::TemporaryFolder folder;
  const std::filesystem::path started = folder.path() / "started";
  const pid_t parent = ::fork();
  if (parent == 0) {
    IsolatedWork options;
    options.subject = "work";
    const Work told = [&](std::ostream& out) {
      std::ofstream(started) << ::getpid() << std::endl;
      work(out);
    };
    run_isolated(options, told);
    ::_exit(0);
  }
  pid_t worker = 0;
  const bool is_told = within_patience([&] { return std::ifstream(started) >> worker && worker > 0; });
  ::kill(parent, SIGKILL);
  ::waitpid(parent, nullptr, 0);
  const bool ended = is_told && within_patience([&] { return !is_running(worker); });
  if (is_told && !ended) ::kill(worker, SIGKILL);
  return ended;
}

/// The result, or the kind and the sentence of the Error.
std::string answer_of(const Work& work) {
  IsolatedWork options;
  options.subject = "part.step";
  options.crashed = "crashed";
  options.too_long = "too long";
  options.time_limit = 20;
  try {
    return run_isolated(options, work);
  } catch (const Error& error) {
    return (error.kind() == Error::Kind::usage ? "usage: " : "failure: ") + std::string(error.what());
  }
}

constexpr char no_memory[] =
    "failure: part.step: there is not enough memory for it (a damaged file may promise more than it holds)";

TEST(IsolatedWork, BringsResultsAndErrors) {
  std::string all;
  for (int i = 0; i < 256; ++i) all += static_cast<char>(i);
  for (const std::string& bytes : {std::string(), all, std::string("\nquadrille has answered: F")})
    EXPECT_EQ(answer_of([&](std::ostream& out) { out << bytes; }), bytes);
  EXPECT_EQ(answer_of([](std::ostream&) { throw failure("x", "the sentence"); }), "failure: the sentence");
  EXPECT_EQ(answer_of([](std::ostream&) { throw usage_error("x", "wrong use"); }), "usage: wrong use");
  EXPECT_EQ(answer_of([](std::ostream&) { throw std::bad_alloc(); }), no_memory);
  EXPECT_EQ(answer_of([](std::ostream&) { throw std::runtime_error("why"); }), "failure: part.step: why");
}

TEST(IsolatedWork, TellsWhatBreaksOff) {
  const auto ends_after = [](const std::string& bytes) {
    return answer_of([&](std::ostream& out) {
      out << bytes << std::flush;
      ::_exit(0);
    });
  };
  const std::string whole = "a shape\nquadrille has answered: R";
  EXPECT_EQ(ends_after(whole), "a shape");
  for (std::size_t length = 0; length < whole.size(); ++length)
    EXPECT_EQ(ends_after(whole.substr(0, length)), "failure: crashed") << length;
  EXPECT_EQ(ends_after(whole + "printed later"), "failure: crashed");
}

TEST(IsolatedWork, EndsWhereItsParentIsKilled) {
  EXPECT_TRUE(
      ends_with_its_parent([](std::ostream&) { std::this_thread::sleep_for(std::chrono::minutes(9)); }));
  EXPECT_TRUE(ends_with_its_parent([](std::ostream& out) {
    std::this_thread::sleep_for(std::chrono::seconds(1));
    out << std::string(8'000'000, 'a');  // far more than a pipe holds
    std::this_thread::sleep_for(std::chrono::minutes(9));
  }));
}

/// Libraries swallow the exception, or wait forever for what it left half made.
TEST(IsolatedWork, EndsWhereMemoryDoes) {
  volatile std::size_t too_much = std::numeric_limits<std::ptrdiff_t>::max();
  EXPECT_EQ(answer_of([&](std::ostream& out) {
              out << "part of a shape" << std::flush;
              try {
                ::operator delete(::operator new(too_much));
              } catch (const std::bad_alloc&) {
                std::this_thread::sleep_for(std::chrono::minutes(9));
              }
            }),
            no_memory);
}

}  // namespace
}  // namespace quadrille
