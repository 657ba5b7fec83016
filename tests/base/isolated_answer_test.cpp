/// What a child process writes is taken apart as it was put together, and what breaks off is told from it.

#include "geometry/base/isolated_answer.hpp"

#include <gtest/gtest.h>

#include <new>
#include <sstream>
#include <stdexcept>
#include <string>

#include "geometry/base/error.hpp"

namespace quadrille {
namespace {

std::string written(const std::function<void(std::ostream&)>& work) {
  std::ostringstream out;
  write_answer("part.step", work, out);
  return out.str();
}

/// The result, or the kind and the sentence of the Error.
std::string taken(const std::string& bytes) {
  IsolatedWork options;
  options.subject = "part.step";
  options.crashed = "crashed";
  try {
    return result_of(options, bytes);
  } catch (const Error& error) {
    return (error.kind() == Error::Kind::usage ? "usage: " : "failure: ") + std::string(error.what());
  }
}

TEST(IsolatedAnswer, BringsResultsAndErrors) {
  std::string all;
  for (int i = 0; i < 256; ++i) all += static_cast<char>(i);
  for (const std::string& bytes : {std::string(), all, std::string("\nquadrille has answered: F")})
    EXPECT_EQ(taken(written([&](std::ostream& out) { out << bytes; })), bytes);
  EXPECT_EQ(taken(written([](std::ostream&) { throw failure("x", "the sentence"); })),
            "failure: the sentence");
  EXPECT_EQ(taken(written([](std::ostream&) { throw usage_error("x", "wrong use"); })), "usage: wrong use");
  EXPECT_EQ(taken(written([](std::ostream&) { throw std::bad_alloc(); })),
            "failure: part.step: there is not enough memory for it (a damaged file may promise more than it "
            "holds)");
  EXPECT_EQ(taken("part of a shape" + std::string(answer_without_memory)),
            taken(written([](std::ostream&) { throw std::bad_alloc(); })));
  EXPECT_EQ(taken(written([](std::ostream&) { throw std::runtime_error("why"); })),
            "failure: part.step: why");
}

TEST(IsolatedAnswer, TellsWhatBreaksOff) {
  const std::string whole = written([](std::ostream& out) { out << "a shape"; });
  for (std::size_t length = 0; length < whole.size(); ++length)
    EXPECT_EQ(taken(whole.substr(0, length)), "failure: crashed") << length;
  EXPECT_EQ(taken(whole + "printed later"), "failure: crashed");
}

}  // namespace
}  // namespace quadrille
