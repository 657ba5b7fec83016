/// Sizes on the surface, and which source rules where.

#include "mesher/size_map.hpp"

#include <gtest/gtest.h>
#include <BRepPrimAPI_MakeCylinder.hxx>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "geometry/cad/cad_shape.hpp"
#include "geometry/sizing/sizing_field.hpp"
#include "mesher/quadrille.hpp"
#include "tests/support/ids.hpp"
#include "tests/support/sample_models.hpp"

namespace quadrille {
namespace {

SizeMap map_of(const CadModel& model, const MeshOptions& options) {
  ExecutionContext context;
  return size_map(model, options, context);
}

double area_of(const SizeMap& map) {
  double sum = 0;
  for (const auto& [a, b, c] : map.triangles)
    sum += 0.5 * (map.points[b] - map.points[a]).cross(map.points[c] - map.points[a]).norm();
  return sum;
}

/// Inner sides have two triangles, others lie on CAD edges: nothing hangs.
void expect_conforming(const SizeMap& map) {
  std::map<std::pair<int, int>, int> sides;
  for (const auto& nodes : map.triangles) {
    for (int k = 0; k < 3; ++k) ++sides[std::minmax(nodes[k], nodes[(k + 1) % 3])];
  }
  std::set<std::pair<int, int>> lines;
  for (const SizeMap::Line& line : map.lines) lines.insert(std::minmax(line.points[0], line.points[1]));
  for (const auto& [side, triangles] : sides) {
    ASSERT_LE(triangles, 2);
    const bool is_pole = (map.points[side.first] - map.points[side.second]).norm() < 1e-6;
    if (triangles == 1 && !is_pole) {
      ASSERT_TRUE(lines.count(side)) << side.first << " " << side.second;
    }
  }
}

class Maps : public testing::TestWithParam<SampleModel> {};

TEST_P(Maps, CoverTheModel) {
  const CadModel model = CadModel::read(GetParam().path());
  MeshOptions options;
  options.sizing.elements_per_diagonal = 30;
  const SizeMap map = map_of(model, options);
  EXPECT_TRUE(map.missing.empty());
  EXPECT_NEAR(area_of(map), GetParam().area, 0.01 * GetParam().area);
  expect_conforming(map);
  ASSERT_EQ(map.sizes.size(), map.points.size());
  ASSERT_EQ(map.along.size(), map.points.size());
  ASSERT_EQ(map.rulers.size(), map.points.size());
  ASSERT_EQ(map.faces.size(), map.triangles.size());
  const double largest = model.diagonal() / 30, share = model.diagonal() / 300;
  double quads = 0, area = 0;
  for (const SizeMap::Source& source : map.sources) {
    quads += source.quads;
    area += source.area;
  }
  EXPECT_NEAR(quads, map.quads, 1e-6 * map.quads);
  EXPECT_NEAR(area, area_of(map), 1e-6 * area);
  for (const auto& nodes : map.triangles) {
    for (int k = 0; k < 3; ++k) {
      const int a = nodes[k], b = nodes[(k + 1) % 3];
      EXPECT_LE((map.points[a] - map.points[b]).norm(),
                std::max(1.01 * share, 1.6 * std::max(map.along[a], map.along[b])));
    }
  }
  for (const double size : map.sizes) {
    EXPECT_LE(size, largest * (1 + 1e-9));
    EXPECT_GE(size, largest / 8 * (1 - 1e-9));
  }
}

INSTANTIATE_TEST_SUITE_P(SampleModels, Maps, testing::ValuesIn(sample_models()),
                         [](const auto& model) { return model.param.name; });

/// What the names of sources rest on: the field of all sources is the least of the fields of each alone.
TEST(SizeMap, FieldIsTheLeastOfItsSources) {
  const CadModel model = CadModel::read(sample_model("bracket").path());
  for (const Gradation gradation : {Gradation::surface, Gradation::space}) {
    MeshOptions all;
    all.sizing.gradation = gradation;
    all.sizing.proximity = 3;
    all.sizing.face_sizes[1] = 0.4;
    all.sizing.vertex_sizes[7] = 0.5;
    const SizeMap map = map_of(model, all);
    ASSERT_EQ(map.sources.size(), 5u);
    ExecutionContext context;
    const SizeLimits limits = size_limits(model, all.sizing);
    SizingOptions none;
    none.size = limits.largest;
    none.size_min = limits.size_min;
    none.gradation = gradation;
    none.elements_per_circle = 0;
    none.short_edges = false;
    std::vector<SizingOptions> alone(4, none);
    alone[0].elements_per_circle = all.sizing.elements_per_circle;
    alone[1].short_edges = true;
    alone[2].proximity = 3;
    alone[3].face_sizes = all.sizing.face_sizes;
    alone[3].vertex_sizes = all.sizing.vertex_sizes;
    std::vector<SizingField> fields;
    fields.reserve(alone.size());
    for (const SizingOptions& options : alone) fields.push_back(SizingField::build(model, options, context));
    std::map<int, int> face_of;  // a point's
    for (std::size_t i = 0; i < map.triangles.size(); ++i) {
      for (const int node : map.triangles[i]) face_of[node] = map.faces[i];
    }
    std::set<int> rulers;
    int near = 0;
    for (const auto& [point, face] : face_of) {
      double least = limits.largest;
      for (const SizingField& field : fields) {
        SizingField::Sampler size_at(field, face_id(face));
        least = std::min(least, size_at(map.points[point]));
      }
      // Voxels of other levels interpolate otherwise.
      EXPECT_LE(map.sizes[point], 1.01 * least);
      EXPECT_GE(map.sizes[point], 0.75 * least);
      near += map.sizes[point] > 0.97 * least;
      rulers.insert(map.rulers[point]);
    }
    EXPECT_GT(near, 0.9 * static_cast<double>(face_of.size()));
    EXPECT_GE(rulers.size(), 3u);
  }
}

/// A quarter tube of radius 5, 40 long: curvature asks for rows across, and the size for long quads.
TEST(SizeMap, SizesOnBendsHaveDirections) {
  constexpr double radius = 5, size = 8;
  const CadModel model(
      std::make_shared<CadShape>(BRepPrimAPI_MakeCylinder(radius, 40, M_PI / 2).Shell(), "quarter"));
  MeshOptions options;
  options.sizing.size = size;
  options.sizing.elements_per_circle = 16;
  const SizeMap map = map_of(model, options);
  const double across = 2 * M_PI * radius / 16;
  double longest = 0;
  for (std::size_t i = 0; i < map.points.size(); ++i) {
    if (!(map.sizes[i] < 0.99 * map.along[i])) continue;
    EXPECT_NEAR(std::hypot(map.points[i].x(), map.points[i].y()), radius, 0.05 * radius);  // on chords
    EXPECT_NEAR(map.sizes[i], across, 1e-6);
    longest = std::max(longest, map.along[i]);
    EXPECT_EQ(map.sources[map.rulers[i]].name, "curvature");
  }
  EXPECT_GT(longest, 0.85 * std::min(size, options.sizing.aspect * across));  // between the ends
}

TEST(SizeMap, CountsChosenFacesOnly) {
  const CadModel model = CadModel::read(sample_model("box").path());
  MeshOptions options;
  options.sizing.size = 1;
  options.faces = {1};
  const SizeMap map = map_of(model, options);
  ExecutionContext context;
  EXPECT_NEAR(map.quads / static_cast<double>(mesh(model, options, context).quads.size()), 1, 0.2);
  double quads = 0;
  for (const SizeMap::Source& source : map.sources) quads += source.quads;
  EXPECT_NEAR(quads, map.quads, 1e-6 * map.quads);
}

TEST(SizeMap, NamesWhatRules) {
  const CadModel model = CadModel::read(sample_model("box").path());  // 30 x 20 x 10, nothing curved
  MeshOptions options;
  options.sizing.size = 2;
  options.sizing.gradation = Gradation::surface;
  options.sizing.face_sizes[3] = 0.4;
  options.sizing.regions.push_back({});
  options.sizing.regions[0].shape = SizeRegion::Shape::sphere;
  const Vector3 corner = model.shape().vertices[vertex_id(1)];
  options.sizing.regions[0].a = corner;
  options.sizing.regions[0].radius = 2;
  options.sizing.regions[0].size = 0.3;
  const SizeMap map = map_of(model, options);
  const auto number_of = [&](const std::string& name) {
    const auto found = std::find_if(map.sources.begin(), map.sources.end(),
                                    [&](const SizeMap::Source& source) { return source.name == name; });
    return static_cast<int>(found - map.sources.begin());
  };
  const int face = number_of("size-on"), region = number_of("size-in"), size = number_of("size");
  for (std::size_t i = 0; i < map.triangles.size(); ++i) {
    for (const int node : map.triangles[i]) {
      const double distance = (map.points[node] - corner).norm();
      if (distance < 1.8) {
        EXPECT_EQ(map.rulers[node], region);
        EXPECT_NEAR(map.sizes[node], 0.3, 0.01);
      } else if (map.faces[i] == 3 && distance > 4) {
        EXPECT_EQ(map.rulers[node], face);
        EXPECT_NEAR(map.sizes[node], 0.4, 0.01);
      }
      if (map.rulers[node] == size) {
        EXPECT_GE(map.sizes[node], 1.9);
      }
    }
  }
  EXPECT_GT(map.sources[size].area, 0);
  EXPECT_EQ(map.sources[number_of("curvature")].area, 0);
  EXPECT_EQ(map.sources[number_of("short edges")].area, 0);
}

}  // namespace
}  // namespace quadrille
