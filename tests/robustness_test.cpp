/// Every class of trouble that real CAD files bring, each on a small model of its own.

#include <gtest/gtest.h>

#include <BRepTools.hxx>
#include <chrono>
#include <cmath>
#include <memory>
#include <ostream>
#include <set>

#include "geometry/cad_shape.hpp"
#include "mesher/quadrille.hpp"
#include "tests/models/trouble_models.hpp"
#include "tests/process.hpp"

namespace quadrille {

/// What a failed test shows of its model.
void PrintTo(const TroubleModel& model, std::ostream* out) {
  *out << model.trouble;
}

namespace {

CadModel model_of(const TroubleModel& trouble) {
  return CadModel(std::make_shared<CadShape>(trouble.make(), trouble.name));
}

ShellMesh mesh_of(const CadModel& model, double divisions, Strategy strategy = Strategy::subdivide,
                  int threads = 1) {
  MeshOptions options;
  options.sizing.elements_per_diagonal = divisions;
  options.strategy = strategy;
  ExecutionContext context(threads);
  return mesh(model, options, context);
}

double mesh_area(const ShellMesh& mesh) {
  double sum = 0;
  for (const auto& quad : mesh.quads) {
    const auto& p = mesh.points;
    sum += 0.5 * (p[quad[2]] - p[quad[0]]).cross(p[quad[3]] - p[quad[1]]).norm();
  }
  return sum;
}

std::string joined(const std::vector<std::string>& lines) {
  std::string result;
  for (const auto& line : lines) result += line + "\n";
  return result;
}

class EveryTrouble : public testing::TestWithParam<TroubleModel> {};

TEST_P(EveryTrouble, GivesAValidMesh) {
  const TroubleModel& trouble = GetParam();
  const CadModel model = model_of(trouble);
  const double area = trouble.area > 0 ? trouble.area : model.area();
  for (const double divisions : {8.0, 20.0, 60.0}) {
    SCOPED_TRACE(divisions);
    const ShellMesh mesh = mesh_of(model, divisions);
    EXPECT_EQ(joined(validate(mesh, trouble.closed)), "");
    const std::set<int> faces(mesh.quad_faces.begin(), mesh.quad_faces.end());
    EXPECT_EQ(static_cast<int>(faces.size()), model.face_count());
    EXPECT_EQ(static_cast<int>(mesh.corners.size()),
              trouble.corners >= 0 ? trouble.corners : model.vertex_count());
    EXPECT_NEAR(mesh_area(mesh) / area, 1, divisions > 50 ? 0.01 : divisions > 10 ? 0.03 : 0.12);
  }
}

INSTANTIATE_TEST_SUITE_P(Robustness, EveryTrouble, testing::ValuesIn(trouble_models()),
                         [](const auto& test) { return test.param.name; });

TEST(Robustness, HasModelsForEveryClass) {
  EXPECT_GE(trouble_models().size(), 40u);
}

TEST(Robustness, BytesDoNotDependOnThreads) {
  const test::TemporaryFolder folder;
  int compared = 0;
  for (const TroubleModel& trouble : trouble_models()) {
    const CadModel model = model_of(trouble);
    if (model.face_count() < 3) continue;
    SCOPED_TRACE(trouble.name);
    std::string first;
    for (const int threads : {1, 2, 8, 1}) {
      const auto path = folder / "mesh.msh";
      write_mesh(mesh_of(model, 25, Strategy::subdivide, threads), path);
      const std::string bytes = test::file_text(path);
      if (first.empty()) first = bytes;
      EXPECT_EQ(bytes == first, true) << threads << " threads";
    }
    ++compared;
  }
  EXPECT_GT(compared, 5);
}

TEST(Robustness, TimeLimitEndsTheWorkInOneSentence) {
  const CadModel model = CadModel(std::make_shared<CadShape>(trouble_models().front().make(), "sphere"));
  MeshOptions options;
  options.sizing.elements_per_diagonal = 2000;
  ExecutionContext context(1);
  context.limit_time(0.1);
  const auto start = std::chrono::steady_clock::now();
  try {
    mesh(model, options, context);
    FAIL() << "not ended";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), Error::Kind::failure);
    EXPECT_EQ(error.subject(), "--time-limit");
  }
  // 0.2 s on an idle machine; the rest is for busy ones and sanitizers.
  EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), 3);
}

TEST(Robustness, DamagedFilesEndInOneSentence) {
  const test::TemporaryFolder folder;
  const auto& models = trouble_models();
  const auto path = folder / "model.brep";
  ASSERT_TRUE(BRepTools::Write(models.front().make(), path.c_str()));
  const std::string whole = test::file_text(path);
  ASSERT_GT(whole.size(), 500u);
  int failed = 0;
  for (int part = 1; part < 20; ++part) {
    try {
      CadModel::from_brep(std::string_view(whole).substr(0, whole.size() * part / 20));
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), Error::Kind::failure);
      EXPECT_NE(std::string(error.what()), "");
      ++failed;
    }
  }
  EXPECT_EQ(failed, 19);
}

}  // namespace
}  // namespace quadrille
