/// A time limit and cancellation end every stage of all long work, however slow the stage is.

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <ctime>
#include <functional>
#include <map>
#include <memory>
#include <random>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "geometry/cad/cad_shape.hpp"
#include "mesher/quadrille.hpp"
#include "tests/models/thin_models.hpp"
#include "tests/support/sample_models.hpp"
#include "tests/support/sheet.hpp"

namespace quadrille {
namespace {

using std::chrono::milliseconds;

struct Work {
  std::string name;
  std::function<void(ExecutionContext&)> run;
  std::vector<std::string> stages;  ///< that it must report
};

CadModel sample(const std::string& name) {
  return CadModel::read(sample_model(name).path());
}

MeshOptions options_for(const CadModel& model, double divisions, Strategy strategy = Strategy::subdivide,
                        int order = 1) {
  MeshOptions options;
  options.sizing.size = model.diagonal() / divisions;
  options.strategy = strategy;
  options.order = order;
  return options;
}

ShellMesh triangles_of(const CadModel& model) {
  ExecutionContext context(1);
  ShellMesh result = mesh(model, options_for(model, 30), context);
  for (std::size_t i = 0; i < result.quads.size(); ++i) {
    const auto [a, b, c, d] = result.quads[i];
    for (const std::array<int, 3>& triangle : {std::array{a, b, c}, std::array{a, c, d}}) {
      result.triangles.push_back(triangle);
      result.triangle_faces.push_back(result.quad_faces[i]);
    }
  }
  result.quads.clear();
  result.quad_faces.clear();
  return result;
}

std::vector<Work> all_work() {
  std::vector<Work> result;
  const std::vector<std::string> of_mesh{"size", "sample", "mesh", "slide", "assemble"};
  const CadModel bracket = sample("bracket");
  for (const Strategy strategy : {Strategy::subdivide, Strategy::direct}) {
    for (const int order : {1, 2}) {
      const MeshOptions options = options_for(bracket, 30, strategy, order);
      result.push_back({fmt::format("mesh, strategy {}, order {}", static_cast<int>(strategy), order),
                        [=](ExecutionContext& context) { mesh(bracket, options, context); }, of_mesh});
    }
  }
  result.push_back({"reading",
                    [](ExecutionContext& context) {
                      ReadOptions options;
                      options.isolated = true;
                      options.context = &context;
                      CadModel::read(sample_model("bracket").path(), options);
                    },
                    {"read"}});
  result.push_back({"info",
                    [=](ExecutionContext& context) { QuadEstimate(bracket, context).size_for(3000); },
                    {"size", "sample"}});
  result.push_back({"sizes",
                    [=](ExecutionContext& context) { size_map(bracket, options_for(bracket, 30), context); },
                    {"size", "sample"}});
  const CadModel thin(std::make_shared<CadShape>(thin_models().front().make(), "thin"));
  result.push_back({"middle surface",
                    [=](ExecutionContext& context) {
                      const MidSurface middle = midsurface(thin, {}, context);
                      mesh(middle, options_for(middle.model, 30), context);
                    },
                    {"midsurface", "size", "sample", "mesh", "slide", "assemble"}});
  for (const JoinedModel& of : joined_models()) {
    if (of.name != "frame_with_gaps" && of.name != "tube_in_sleeve") continue;  // flat and curved gaps
    const CadModel apart(std::make_shared<CadShape>(of.make(), of.name));
    MidSurfaceOptions joining;
    joining.join = true;
    result.push_back({fmt::format("middle surface of the solids {}", of.name),
                      [=](ExecutionContext& context) { midsurface(apart, joining, context); },
                      {"midsurface"}});
  }
  const auto triangles = std::make_shared<ShellMesh>(triangles_of(bracket));
  result.push_back({"recombine",
                    [=](ExecutionContext& context) {
                      std::vector<std::string> notes;
                      context.report(Stage::color, 0);
                      quads_from_triangles(*triangles, {}, notes, context);
                    },
                    {"color", "improve"}});
  RemeshOptions remeshing;
  remeshing.size = bracket.diagonal() / 25;
  result.push_back({"remesh",
                    [=](ExecutionContext& context) {
                      std::vector<std::string> notes;
                      remesh(*triangles, remeshing, nullptr, notes, context);
                    },
                    {"sample", "triangulate", "mesh", "assemble"}});
  return result;
}

/// The number of progress calls by stage.
std::map<std::string, int> calls_of(const Work& work) {
  std::map<std::string, int> calls;
  ExecutionContext context(1, [&](std::string_view stage, double) {
    ++calls[std::string(stage)];
    return true;
  });
  context.ask_every(milliseconds(0));
  context.limit_time(3600);
  work.run(context);
  return calls;
}

/// The calls of each stage in which the fraction done changes: reports, in which the time can run out too.
std::map<std::string, std::vector<int>> reports_of(const Work& work) {
  std::map<std::string, int> calls;
  std::map<std::string, std::vector<int>> reports;
  double before = -1;
  ExecutionContext context(1, [&](std::string_view stage, double fraction) {
    const int call = ++calls[std::string(stage)];
    if (fraction != before) reports[std::string(stage)].push_back(call);
    before = fraction;
    return true;
  });
  context.ask_every(milliseconds(0));
  context.limit_time(3600);
  work.run(context);
  return reports;
}

/// What became of work one stage of which was slowed.
struct Outcome {
  std::string subject = "none";  ///< of the Error that ended it
  Error::Kind kind = Error::Kind::usage;
  std::string last_stage;  ///< at the end
  int calls_past = 0;      ///< progress calls once the time was over, as long as there was a limit
};

enum class End { time_limit, cancelled };

/// Slows a stage from one of its calls on, as if each step there took longer than all the time left. What
/// happens does not depend on the machine: sleeping takes at least as long as asked.
Outcome end_of_slowed(const Work& work, const std::string& slow, int from_call, End end) {
  Outcome outcome;
  int calls = 0;
  ExecutionContext* whole = nullptr;
  ExecutionContext context(1, [&](std::string_view stage, double) {
    outcome.last_stage = stage;
    if (!whole->has_time_limit()) return true;
    if (outcome.calls_past > 0 || (stage == slow && ++calls == from_call)) ++outcome.calls_past;
    if (outcome.calls_past == 0) return true;
    if (end == End::cancelled) return false;
    if (outcome.calls_past == 1) whole->limit_time(0.001);
    std::this_thread::sleep_for(milliseconds(2));
    return true;
  });
  whole = &context;
  context.ask_every(milliseconds(0));
  context.limit_time(3600);
  try {
    work.run(context);
  } catch (const Error& error) {
    outcome.subject = error.subject();
    outcome.kind = error.kind();
  }
  return outcome;
}

/// The calls of a stage at which to begin: the first, the last, and some between.
std::vector<int> some_calls(int calls) {
  std::vector<int> result;
  constexpr int parts = 6;
  for (int part = 0; part <= parts; ++part) {
    const int call = 1 + (calls - 1) * part / parts;
    if (result.empty() || result.back() != call) result.push_back(call);
  }
  return result;
}

/// One call reports and the check after it may call again.
constexpr int most_calls_past = 2;

TEST(TimeLimit, EndsEveryStage) {
  for (const Work& work : all_work()) {
    SCOPED_TRACE(work.name);
    const std::map<std::string, int> calls = calls_of(work);
    for (const std::string& stage : work.stages) EXPECT_TRUE(calls.contains(stage)) << stage;
    for (const auto& [stage, count] : calls) {
      // How often reading calls depends on how long it takes.
      const std::vector<int> chosen = stage == "read" ? std::vector{1} : some_calls(count);
      for (const int call : chosen) {
        SCOPED_TRACE(fmt::format("{}, call {} of {}", stage, call, count));
        const Outcome late = end_of_slowed(work, stage, call, End::time_limit);
        EXPECT_EQ(late.subject, ExecutionContext::time_subject);
        EXPECT_EQ(late.kind, Error::Kind::failure);
        EXPECT_EQ(late.last_stage, stage);
        EXPECT_LE(late.calls_past, most_calls_past);
        const Outcome cancelled = end_of_slowed(work, stage, call, End::cancelled);
        EXPECT_EQ(cancelled.kind, Error::Kind::cancelled);
        EXPECT_EQ(cancelled.last_stage, stage);
        EXPECT_LE(cancelled.calls_past, most_calls_past);
      }
    }
  }
}

/// A wall of so many rows of bricks, of random lengths.
CadModel brick_wall(int rows) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> shift(-0.3, 0.3);
  std::vector<std::vector<double>> joints(rows, {0});  // (rows) ends of the bricks
  for (int row = 0; row < rows; ++row) {
    for (int i = 0; i < rows; ++i) joints[row].push_back(i + 0.75 + 0.5 * (row % 2) + shift(random));
    joints[row].push_back(rows + 1);
  }
  std::vector<testing::Polygon> bricks;
  for (int row = 0; row < rows; ++row) {
    for (int i = 0; i <= rows; ++i) {
      const double from = joints[row][i], to = joints[row][i + 1];
      const auto add_joints = [&](int beside, double y) {
        if (beside < 0 || beside >= rows) return;
        for (const double x : joints[beside])
          if (x > from && x < to) bricks.back().push_back({x, y});
      };
      bricks.push_back({{to, row + 1.0}, {from, row + 1.0}, {from, 1.0 * row}});
      add_joints(row - 1, row);
      bricks.back().push_back({to, 1.0 * row});
      const auto lower = static_cast<std::ptrdiff_t>(bricks.back().size());
      add_joints(row + 1, row + 1);
      std::reverse(bricks.back().begin() + lower, bricks.back().end());
    }
  }
  return testing::sheet(bricks);
}

/// One brick of a wall can have none of the numbers of segments that are asked for around it. To find which
/// numbers would do takes long.
TEST(TimeLimit, EndsTheChoiceOfCounts) {
  const CadModel wall = brick_wall(50);
  MeshOptions options;
  options.strategy = Strategy::direct;
  options.sizing.size = 0.5;
  const FaceId brick = FaceId::from_index(wall.face_count() / 2);
  int segments = 3;
  for (const CadWire& wire : wall.shape().faces[brick].wires) {
    for (const Coedge& coedge : wire.coedges) {
      options.sizing.spacings[coedge.edge.number()] = {.segments = segments};
      segments = 2;
    }
  }
  // CPU time, for busy machines.
  std::clock_t started = 0, limited = 0, whole = 0;
  ExecutionContext* current = nullptr;
  const auto run = [&] {
    started = limited = 0;
    ExecutionContext context(1, [&](std::string_view stage, double) {
      if (stage != "sample") return true;
      if (started == 0) started = std::clock();
      if (whole > 0 && limited == 0 && std::clock() - started > whole / 2) {
        limited = std::clock();
        current->limit_time(1e-6);
      }
      return true;
    });
    current = &context;
    context.ask_every(milliseconds(0));
    try {
      mesh(wall, options, context);
    } catch (const Error& error) {
      return error.subject();
    }
    return std::string("none");
  };
  EXPECT_EQ(run(), "segments");
  whole = std::clock() - started;
  EXPECT_EQ(run(), ExecutionContext::time_subject);
  EXPECT_LT(limited - started, whole * 5 / 8) << "nothing looks at the time";
  EXPECT_LT(std::clock() - limited, whole / 2);
}

/// With options.partial the faces that were done when the time was over are delivered.
TEST(TimeLimit, LeavesPartialResults) {
  const CadModel model = sample("bracket");
  const auto all = static_cast<std::size_t>(model.face_count());
  for (const Strategy strategy : {Strategy::subdivide, Strategy::direct}) {
    MeshOptions options = options_for(model, 30, strategy, 2);
    options.partial = true;
    std::set<int> faces;
    const auto run = [&](ExecutionContext& context) {
      faces.clear();
      const ShellMesh result = mesh(model, options, context);
      EXPECT_EQ(fmt::format("{}", fmt::join(validate(result), "; ")), "");
      faces.insert(result.quad_faces.begin(), result.quad_faces.end());
    };
    const Work work{"partial", run, {}};
    const std::map<std::string, int> calls = calls_of(work);
    ASSERT_EQ(faces.size(), all);
    auto reports = reports_of(work);
    ASSERT_GT(reports["mesh"].size(), all / 2);
    int parts = 0;
    for (const auto& [stage, count] : calls) {
      std::vector<int> chosen = some_calls(count);
      if (stage == "mesh") chosen.insert(chosen.end(), reports[stage].begin(), reports[stage].end());
      for (const int call : chosen) {
        SCOPED_TRACE(fmt::format("{}, call {} of {}", stage, call, count));
        const Outcome late = end_of_slowed(work, stage, call, End::time_limit);
        if (stage == "slide" || stage == "assemble") {
          EXPECT_EQ(faces.size(), all) << late.subject;
        } else if (stage == "size") {
          EXPECT_EQ(late.subject, ExecutionContext::time_subject);
        } else {
          EXPECT_TRUE(!faces.empty() || late.kind == Error::Kind::failure);
        }
        // The first face is done soon, being the smallest.
        if (stage == "mesh" && 2 * call > count) {
          EXPECT_FALSE(faces.empty()) << late.subject;
        }
        parts += !faces.empty() && faces.size() < all;
        // Each face left looks at the time a few times in each stage.
        EXPECT_LE(late.calls_past, 8 * model.face_count());
        const Outcome cancelled = end_of_slowed(work, stage, call, End::cancelled);
        if (stage != "assemble") {
          EXPECT_EQ(cancelled.kind, Error::Kind::cancelled);
          EXPECT_LE(cancelled.calls_past, most_calls_past);
        }
      }
    }
    EXPECT_GT(parts, 1) << "no mesh of some faces alone";
  }
}

}  // namespace
}  // namespace quadrille
