/// What sizes come from: regions, points, layers, gaps, chord errors, grids of others, and how users write
/// them.

#include <gtest/gtest.h>

#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakePolygon.hxx>
#include <BRepTools.hxx>
#include <gp_Pln.hxx>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <sstream>

#include "geometry/base/module_loader.hpp"
#include "geometry/cad/cad_shape.hpp"
#include "geometry/sizing/face_gaps.hpp"
#include "geometry/sizing/sizing_field.hpp"
#include "geometry/sizing/spatial_sizes.hpp"
#include "geometry/sizing/vdb_module.hpp"
#include "geometry/surfaces/edge_curve.hpp"
#include "geometry/surfaces/face_surface.hpp"
#include "mesher/quadrille.hpp"
#include "mesher/settings.hpp"
#include "tests/support/ids.hpp"
#include "tests/support/sample_models.hpp"

namespace quadrille {
namespace {

CadModel sample(const std::string& name) {
  return CadModel::read(sample_model(name).path());
}

/// The settings that "name=text" gives.
Settings settings_of(const std::string& name, const std::vector<std::string>& texts) {
  Settings settings;
  const Setting& setting = *find_setting(name);
  assign(settings, setting, parse(setting, texts));
  return settings;
}

/// Looks at points of all faces: visit(point, size there).
template <class Visit>
void look(const CadModel& model, const SizingOptions& options, Visit&& visit) {
  ExecutionContext context;
  const SizingField field = SizingField::build(model, options, context);
  for (const FaceId face : model.shape().faces.ids()) {
    SizingField::Sampler size_at(field, face);
    const CadFace& cad = model.shape().faces[face];
    const FaceSurface surface(cad);
    constexpr int n = 40;
    for (int k = 0; k <= n * n; ++k) {
      const int row = k / n;
      const Vector2 share(1.0 * (k % n) / n, 1.0 * row / n);
      const Vector3 p = surface.point(
          {cad.u_min + share.x() * (cad.u_max - cad.u_min), cad.v_min + share.y() * (cad.v_max - cad.v_min)});
      visit(p, size_at(p));
    }
  }
}

class SizeIn : public testing::TestWithParam<std::pair<const char*, Gradation>> {};

/// Inside the size asked for, outside what grows from it: computed point by point.
TEST_P(SizeIn, HasItsSizeInsideAndGrowsOutside) {
  const CadModel box = sample("box");  // 30 x 20 x 10
  SizingOptions options = settings_of("size_in", {GetParam().first}).mesh.sizing;
  options.size = 4;
  options.gradation = GetParam().second;
  int inside = 0, beyond = 0;
  look(box, options, [&](const Vector3& p, double size) {
    const SizeRegion& region = options.regions[0];
    const double distance = region.distance(p);
    double slope = options.growth;
    if (region.transition > 0) slope = std::min(slope, (4 - region.size) / region.transition);
    const double expected = std::min(4.0, region.size + slope * distance);
    EXPECT_LE(size, expected * 1.35 + 1e-6) << p.transpose();
    EXPECT_GE(size, expected * 0.5) << p.transpose();
    inside += distance == 0;
    beyond += expected == 4.0 && size > 3.9;
    if (distance == 0) {
      EXPECT_NEAR(size, region.size, 0.05 * region.size);
    }
  });
  EXPECT_GT(inside, 0);
  EXPECT_GT(beyond, 100);
}

INSTANTIATE_TEST_SUITE_P(Regions, SizeIn,
                         testing::Values(std::pair{"box:-1,-1,-1,2,3,4=0.5", Gradation::space},
                                         std::pair{"box:12,8,-1,12.4,8.4,0.5=0.4", Gradation::space},
                                         std::pair{"sphere:30,20,10,2=0.5", Gradation::space},
                                         std::pair{"sphere:3,3,0,1=0.5,20", Gradation::surface},
                                         std::pair{"cylinder:0,0,10,0,20,10,1=0.6", Gradation::surface},
                                         std::pair{"halfspace:25,0,0,1,0,0=0.7", Gradation::surface}));

TEST(SizeSources, NoRegionMakesSizesLarger) {
  SizingOptions options = settings_of("size_in", {"sphere:0,0,0,5=9,2"}).mesh.sizing;
  options.size = 4;
  look(sample("box"), options, [](const Vector3&, double size) { EXPECT_EQ(size, 4); });
}

TEST(SizeSources, PointsAskForTheirSize) {
  const auto path = std::filesystem::temp_directory_path() / "quadrille_points_test.csv";
  std::ofstream(path) << "x,y,z,size\n30,20,10,0.3\r\n\n 0 , 0 , 0 , 1\n";
  const std::vector<SizePoint> points = read_size_points(path);
  ASSERT_EQ(points.size(), 2u);
  EXPECT_EQ(points[0].point, Vector3(30, 20, 10));
  for (const Gradation gradation : {Gradation::space, Gradation::surface}) {
    SizingOptions options;
    options.size = 4;
    options.size_points = path;
    options.gradation = gradation;
    int near = 0;
    look(sample("box"), options, [&](const Vector3& p, double size) {
      const double a = 0.3 + 0.3 * (p - points[0].point).norm(), b = 1 + 0.3 * (p - points[1].point).norm();
      const double expected = std::max(options.size / 8, std::min({4.0, a, b}));
      EXPECT_LE(size, 1.35 * expected) << p.transpose();
      EXPECT_GE(size, 0.5 * expected) << p.transpose();
      near += expected < 2;
    });
    EXPECT_GT(near, 50);
  }
  std::filesystem::remove(path);
}

TEST(SizeSources, ChordErrorIsTheHeightOverTheChord) {
  const CadModel cylinder = sample("cylinder");
  const CadEdge* circle = nullptr;
  for (const CadEdge& edge : cylinder.shape().edges) {
    if (edge.closed()) circle = &edge;
  }
  ASSERT_NE(circle, nullptr);
  const double radius = circle->length / (2 * M_PI);
  for (const char* text : {"0.05", "1%"}) {
    SizingOptions options = settings_of("chord_error", {text}).mesh.sizing;
    options.size = 5;
    options.elements_per_circle = 0;
    ExecutionContext context;
    const SizingField field = SizingField::build(cylinder, options, context);
    SizingField::Sampler size_at(field, *circle);
    const double size = size_at(EdgeCurve(*circle).point(circle->first));
    EXPECT_NEAR(radius - std::sqrt(radius * radius - size * size / 4), 0.05, 1e-4) << text;
  }
}

TEST(SizeSources, SoManyElementsAreAcrossAGap) {
  const CadModel model = sample("bracket");
  SizingOptions options;
  options.size = 6;
  options.elements_per_circle = 0;
  options.proximity = 4;
  options.size_min = 0.2;
  ExecutionContext context;
  const SizingField field = SizingField::build(model, options, context);
  int gaps = 0;
  for (const FaceId face : model.shape().faces.ids()) {
    SizingField::Sampler size_at(field, face);
    for (const FaceGap& gap : face_gaps(model.shape(), face, 24, 0.8, context)) {
      ++gaps;
      for (const double share : {0.0, 0.3, 0.5, 0.9})
        EXPECT_LE(size_at(gap.from + share * (gap.to - gap.from)), 1.3 * std::max(0.2, gap.width() / 4));
    }
  }
  EXPECT_GT(gaps, 100);
}

/// Replaces a number among the metadata of all grids of a .vdb file: name, type, length and value follow each
/// other.
void set_metadata(const std::filesystem::path& path, const std::string& name, double value) {
  std::ifstream in(path, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(in), {}};
  const std::string before = name + std::string("\6\0\0\0double\10\0\0\0", 14);
  int found = 0;
  for (std::size_t at = bytes.find(before); at != std::string::npos; at = bytes.find(before, at + 1), ++found)
    std::memcpy(bytes.data() + at + before.size(), &value, sizeof value);
  ASSERT_GT(found, 0);
  std::ofstream(path, std::ios::binary) << bytes;
}

/// A file of ours gives back what it was written from, also where sizes change, and not the least of all
/// near.
TEST(SizeSources, SizesOfAFileOfOursAreThoseItWasWrittenWith) {
  const CadModel box = sample("box");
  const auto path = std::filesystem::temp_directory_path() / "quadrille_again_test.vdb";
  SizingOptions written;
  written.size = 2;
  written.vertex_sizes[1] = 0.1;
  written.gradation = Gradation::space;
  ExecutionContext context;
  const SizingField first = SizingField::build(box, written, context);
  first.write(path);
  SizingField::Sampler before(first);
  SizingOptions read;
  read.size = 2;
  read.size_min = 0.1;
  read.size_field = path;
  read.gradation = Gradation::space;
  double sum = 0, count = 0;
  look(box, read, [&](const Vector3& p, double size) {
    const double ratio = size / before(p);
    EXPECT_GT(ratio, 0.7) << p.transpose();
    EXPECT_LT(ratio, 1.3) << p.transpose();
    sum += std::log(ratio);
    ++count;
  });
  EXPECT_NEAR(std::exp(sum / count), 1, 0.02);
  std::filesystem::remove(path);
}

TEST(SizeSources, GridsOfOthersHaveAScaleAndAUnit) {
  const CadModel box = sample("box");
  const auto path = std::filesystem::temp_directory_path() / "quadrille_scale_test.vdb";
  SizingOptions written;
  written.size = 2;
  const auto& vertices = box.shape().vertices;
  const Vector3 corner = *std::min_element(vertices.begin(), vertices.end(),
                                           [](const auto& a, const auto& b) { return a.norm() < b.norm(); });
  ASSERT_LT(corner.norm(), 1e-6);  // so that it stays there in any unit
  for (const VertexId vertex : vertices.ids()) {
    if (vertices[vertex] == corner) written.vertex_sizes[vertex.number()] = 0.2;
  }
  ExecutionContext context;
  SizingField::build(box, written, context).write(path);
  const auto size_with = [&](double scale, double unit, double size) {
    SizingOptions options;
    options.size = size;
    options.size_min = 0.01;
    options.size_field = path;
    options.size_field_scale = scale;
    options.size_field_unit = unit;
    const SizingField field = SizingField::build(box, options, context);
    return SizingField::Sampler(field)(corner);
  };
  EXPECT_NEAR(size_with(1, 1, 2), 0.2, 0.01);
  EXPECT_NEAR(size_with(3, 1, 2), 0.6, 0.03);
  EXPECT_NEAR(size_with(1, 2, 4), 0.4, 0.02);
  // Sizes in another unit than the places.
  set_metadata(path, "unit", 3);
  EXPECT_NEAR(size_with(1, 1, 2), 0.6, 0.03);
  std::filesystem::remove(path);
}

TEST(SizeSources, RefuseGridsThatMakeNoSense) {
  const CadModel box = sample("box");
  const auto path = std::filesystem::temp_directory_path() / "quadrille_bad_grid_test.vdb";
  const Module module("quadrille_vdb");
  const auto refused = [&](const std::vector<float>& values, int place, double unit,
                           const std::string& part) {
    VdbField field{{}, 2, 0.3};
    field.levels.push_back({"size", 1.0, {}, values});
    for (std::size_t i = 0; i < values.size(); ++i)
      field.levels[0].coordinates.push_back({place + static_cast<int>(i), place, place});
    std::string bytes;
    ASSERT_EQ(module.function<VdbFileFunction>("_file")(field, bytes), "");
    std::ofstream(path, std::ios::binary) << bytes;
    SizingOptions options;
    options.size = 2;
    options.size_field = path;
    options.size_field_unit = unit;
    ExecutionContext context;
    if (part.empty()) {
      EXPECT_NO_THROW(SizingField::build(box, options, context));
      return;
    }
    try {
      SizingField::build(box, options, context);
      ADD_FAILURE() << "no error that says " << part;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
    }
  };
  refused({1, 1, 1}, 3, 1, "");
  refused({}, 3, 1, "");  // one of ours, of one size everywhere
  refused({1, 0}, 3, 1, "the size 0 at");
  refused({1, -2}, 3, 1, "the size -2 at");
  refused({1, std::nanf("")}, 3, 1, "nan");
  refused({1, INFINITY}, 3, 1, "inf");
  refused({1, 1}, 900, 1, "does not overlap the model");
  refused({1, 1}, 3, 1000, "does not overlap the model");
  std::filesystem::remove(path);
}

TEST(SizeSources, RefuseWhatMakesNoSense) {
  const auto refused = [](const std::string& name, const std::vector<std::string>& texts) {
    try {
      settings_of(name, texts);
      ADD_FAILURE() << name << " takes " << texts.front();
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), Error::Kind::usage) << error.what();
      EXPECT_EQ(error.subject(), name);
    }
  };
  for (const char* text :
       {"box:0,0,0,1,1=1", "box=1", "ball:0,0,0,1=1", "sphere:0,0,0,-1=1", "sphere:0,0,0,1=0",
        "sphere:0,0,0,1=nan", "sphere:0,0,0,1=1,-2", "cylinder:1,1,1,1,1,1,2=1", "halfspace:0,0,0,0,0,0=1",
        "sphere:0,0,0,1=1,2,3", "", "="})
    refused("size_in", {text});
  for (const char* text :
       {"Edge4", "Edge4=0", "Edge4=2.5", "Edge4=-3", "Edge=3", "Face4=3", "Edge4=3,Edge4=5", ""})
    refused("segments", {text});
  for (const char* text : {"Edge4=0", "Edge4=11", "Edge4=-1.2", "Edge4=x"}) refused("bias", {text});
  for (const char* text : {"0", "-1", "%", "1 %", "mm", "nan"}) refused("chord_error", {text});
  const CadModel box = sample("box");
  const auto senseless = [&](const std::string& name, const std::string& text) {
    try {
      Settings settings = settings_of(name, {text});
      settings.mesh.sizing.size = 2;
      ExecutionContext context(1);
      mesh(box, settings.mesh, context);
      ADD_FAILURE() << name << " takes " << text;
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), Error::Kind::usage) << error.what();
      EXPECT_EQ(error.subject(), name) << error.what();
    }
  };
  senseless("size_in", "sphere:100,0,0,1=1");
  senseless("size_in", "halfspace:31,0,0,1,0,0=1");
  senseless("segments", "Edge99=4");
  senseless("bias", "Edge99=1.1");
}

}  // namespace
}  // namespace quadrille
