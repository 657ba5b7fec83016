/// Reading in a child process: the same model, and only an Error where the child crashes, hangs or fails.

#include <gtest/gtest.h>

#include <BRepTools.hxx>
#include <Standard_Failure.hxx>
#include <algorithm>
#include <chrono>
#include <csignal>
#include <memory>
#include <sstream>
#include <thread>

#include "geometry/base/error.hpp"
#include "geometry/base/execution_context.hpp"
#include "geometry/cad/cad_shape.hpp"
#include "geometry/cad/isolated_reading.hpp"
#include "mesher/quadrille.hpp"
#include "tests/models/trouble_models.hpp"
#include "tests/support/process.hpp"

namespace quadrille {
namespace {

constexpr ReadOptions isolated{true, nullptr};
const std::string models = QUADRILLE_SOURCE_DIR "/examples/models/";

/// The sentence and the kind of the Error that reading so ends with.
std::string error_of(const std::function<TopoDS_Shape()>& read, ExecutionContext* context = nullptr) {
  try {
    read_isolated("part.step", read, context);
    return "no error";
  } catch (const Error& error) {
    const char* kinds[] = {"usage: ", "failure: ", "cancelled: "};
    return kinds[static_cast<int>(error.kind())] + std::string(error.what());
  }
}

void expect_same_mesh(const CadModel& a, const CadModel& b) {
  MeshOptions options;
  options.sizing.elements_per_diagonal = 15;
  ExecutionContext context(1);
  const ShellMesh one = mesh(a, options, context), other = mesh(b, options, context);
  EXPECT_EQ(one.quads == other.quads, true);
  ASSERT_EQ(one.points.size(), other.points.size());
  double apart = 0;
  for (std::size_t i = 0; i < one.points.size(); ++i)
    apart = std::max(apart, (one.points[i] - other.points[i]).norm());
  // Composed placements come back with other last digits.
  EXPECT_LT(apart, 1e-9 * a.diagonal());
}

TEST(IsolatedReading, GivesTheSameModel) {
  int compared = 0;
  for (const TroubleModel& trouble : trouble_models()) {
    SCOPED_TRACE(trouble.name);
    std::ostringstream text;
    BRepTools::Write(trouble.make(), text);
    const CadModel here = CadModel::from_brep(text.str());
    const CadModel there = CadModel::from_brep(text.str(), "shape", isolated);
    EXPECT_EQ(there.problems(), here.problems());
    expect_same_mesh(here, there);
    ++compared;
  }
  EXPECT_GE(compared, 40);
  const CadModel here = CadModel::read(models + "bracket.step");
  expect_same_mesh(here, CadModel::read(models + "bracket.step", isolated));
}

TEST(IsolatedReading, SurvivesCrashes) {
  const std::string crashed = "failure: part.step: reading this file crashed: it may be damaged";
  for (const int signal_number : {SIGSEGV, SIGABRT, SIGFPE, SIGKILL}) {
    EXPECT_EQ(error_of([&]() -> TopoDS_Shape {
                ::raise(signal_number);
                return {};
              }),
              crashed);
  }
  EXPECT_EQ(error_of([]() -> TopoDS_Shape { std::_Exit(0); }), crashed);
}

TEST(IsolatedReading, HandsErrorsOver) {
  EXPECT_EQ(error_of([]() -> TopoDS_Shape { throw failure("x", "one sentence"); }), "failure: one sentence");
  EXPECT_EQ(error_of([]() -> TopoDS_Shape { throw usage_error("x", "of no use"); }), "usage: of no use");
  EXPECT_EQ(error_of([]() -> TopoDS_Shape { throw Standard_Failure("odd"); }),
            "failure: part.step could not be read as CAD (odd)");
  EXPECT_EQ(error_of([]() -> TopoDS_Shape { throw std::bad_alloc(); }),
            "failure: part.step: there is not enough memory for it (a damaged file may promise more than it "
            "holds)");
  EXPECT_THROW(CadModel::from_brep("not a shape", "shape", isolated), Error);
  EXPECT_THROW(CadModel::read("/nowhere/part.step", isolated), Error);
}

TEST(IsolatedReading, EndsWhenCancelledOrOutOfTime) {
  const auto endless = []() -> TopoDS_Shape {
    for (;;) std::this_thread::sleep_for(std::chrono::seconds(1));
  };
  ExecutionContext cancelled(1, [](std::string_view, double) { return false; });
  EXPECT_EQ(error_of(endless, &cancelled), "cancelled: the work was cancelled");
  ExecutionContext limited(1);
  limited.limit_time(0.1);
  EXPECT_EQ(error_of(endless, &limited).substr(0, 27), "failure: the time limit of ");
}

TEST(IsolatedReading, SaysNothingOfItsOwn) {
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  error_of([]() -> TopoDS_Shape {
    std::puts("chatter");
    std::fputs("noise", stderr);
    std::fflush(nullptr);
    return {};
  });
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace quadrille
