/// The sizing field, edge sampling with parity, and the geometry they stand on.

#include <gtest/gtest.h>
#include <BRepFilletAPI_MakeFillet.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepTools.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>

#include <algorithm>
#include <cmath>
#include <random>
#include <sstream>
#include <string>

#include "geometry/base/trimmed_domain.hpp"
#include "geometry/cad/cad_shape.hpp"
#include "geometry/sizing/element_count.hpp"
#include "geometry/sizing/sizing_field.hpp"
#include "geometry/surfaces/edge_curve.hpp"
#include "geometry/surfaces/face_surface.hpp"
#include "mesher/edges/edge_sampling.hpp"
#include "mesher/options.hpp"
#include "mesher/shell/remedies.hpp"
#include "tests/support/ids.hpp"
#include "tests/support/sample_models.hpp"

namespace quadrille {
namespace {

SizingField field_of(const CadModel& model, const SizingOptions& options) {
  ExecutionContext context;
  return SizingField::build(model, options, context);
}

Vector3 random_point(const CadModel& model, std::mt19937& random) {
  std::uniform_real_distribution<double> unit(0, 1);
  const Vector3 extent = model.box_max() - model.box_min();
  return model.box_min() +
         Vector3(unit(random) * extent.x(), unit(random) * extent.y(), unit(random) * extent.z());
}

TEST(SizingField, IsUniformWhereNothingAsksForLess) {
  const CadModel model = CadModel::read(sample_model("box").path());
  SizingOptions options;
  options.size = 2;
  const SizingField field = field_of(model, options);
  SizingField::Sampler size_at(field);
  std::mt19937 random(1);
  for (int i = 0; i < 100; ++i) EXPECT_DOUBLE_EQ(size_at(random_point(model, random)), 2);
}

TEST(SizingField, StaysBetweenItsLimitsAndGrowsNoFasterThanAsked) {
  for (const SampleModel& sample : sample_models()) {
    SCOPED_TRACE(sample.name);
    const CadModel model = CadModel::read(sample.path());
    SizingOptions options;
    options.size = model.diagonal() / 20;
    options.vertex_sizes[1] = options.size / 10;
    const SizingField field = field_of(model, options);
    SizingField::Sampler size_at(field);
    std::mt19937 random(2);
    std::normal_distribution<double> step(0, 1);
    for (int i = 0; i < 2000; ++i) {
      const Vector3 a = random_point(model, random);
      const Vector3 b = a + options.size * Vector3(step(random), step(random), step(random));
      const double at_a = size_at(a), at_b = size_at(b);
      EXPECT_GE(at_a, field.limits().least);
      EXPECT_LE(at_a, field.limits().largest);
      // Voxels smear by up to one of their own size, which is about the size itself.
      const double slack = options.growth * 2 * std::max(at_a, at_b);
      EXPECT_LE(std::abs(at_a - at_b), options.growth * (a - b).norm() * 1.1 + slack);
    }
  }
}

/// One small size on a vertex of a plane plate: the field is the least of it and what grows from it, computed
/// here point by point.
TEST(SizingField, GrowsFromASourceAsBruteForceSays) {
  const CadModel model = CadModel::read(sample_model("box").path());
  SizingOptions options;
  options.size = model.diagonal() / 8;
  options.elements_per_circle = 0;
  options.gradation = Gradation::space;
  for (const double growth : {0.1, 0.3, 0.6}) {
    SCOPED_TRACE(growth);
    options.growth = growth;
    const double source = options.size / 20;
    options.vertex_sizes[1] = source;
    const SizingField field = field_of(model, options);
    SizingField::Sampler size_at(field);
    const Vector3 vertex = model.shape().vertices[vertex_id(1)];
    int between = 0;
    double sum = 0;
    for (const CadFace& face : model.shape().faces) {
      const FaceSurface surface(face);
      for (int i = 0; i <= 20; ++i) {
        for (int j = 0; j <= 20; ++j) {
          const Vector3 p = surface.point({face.u_min + (face.u_max - face.u_min) * i / 20,
                                           face.v_min + (face.v_max - face.v_min) * j / 20});
          const double expected = std::min(options.size, source + growth * (p - vertex).norm());
          // Voxels are about as wide as the size: the field is off by what it grows over one of them.
          EXPECT_LE(size_at(p), expected * (1 + 2 * growth) + 1e-9);
          EXPECT_GE(size_at(p), 0.7 * expected);
          if (expected == options.size || expected < 3 * source) continue;
          ++between;
          sum += size_at(p) / expected;
        }
      }
    }
    ASSERT_GT(between, 50);
    EXPECT_NEAR(sum / between, 1, 0.2);
  }
}

TEST(SizingField, TakesNoMoreRoomTheSlowerSizesGrow) {
  const CadModel model = CadModel::read(sample_model("bracket").path());
  SizingOptions options;
  options.size = model.diagonal() / 60;
  options.budget.blocks = 400;
  for (const double growth : {1.0, 0.3, 0.05, 0.005, 1e-4, 1e-9, 1e-300}) {
    SCOPED_TRACE(growth);
    options.growth = growth;
    const SizingField field = field_of(model, options);
    SizingField::Sampler size_at(field);
    for (const CadEdge& edge : model.shape().edges) {
      if (edge.degenerate) continue;
      const double size = size_at(EdgeCurve(edge).point(0.5 * (edge.first + edge.last)));
      EXPECT_LE(size, std::max(edge.length, field.limits().least) * 1.05);
    }
  }
}

TEST(SizingField, KeepsToItsBudget) {
  const CadModel model = CadModel::read(sample_model("bracket").path());
  SizingOptions options;
  options.size = model.diagonal() / 60;
  options.budget.blocks = 10;
  options.vertex_sizes[1] = options.size / 100;
  EXPECT_THROW(field_of(model, options), Error);
  options.budget = Budget();
  options.edge_sizes[1] = 1e-3;
  options.budget.segments = 1000;
  EXPECT_THROW(field_of(model, options), Error);
  options.budget = Budget::unlimited();
  EXPECT_NO_THROW(field_of(model, options));
}

TEST(SizingField, AFilletOfATenThousandthTakesLittleRoom) {
  const TopoDS_Shape box = BRepPrimAPI_MakeBox(1000, 400, 50).Shape();
  BRepFilletAPI_MakeFillet fillet(box);
  TopoDS_Shape long_edge;  // the last one runs along the longest side
  for (TopExp_Explorer it(box, TopAbs_EDGE); it.More(); it.Next()) long_edge = it.Current();
  fillet.Add(0.1, TopoDS::Edge(long_edge));
  std::ostringstream text;
  BRepTools::Write(fillet.Shape(), text);
  const CadModel model = CadModel::from_brep(text.str());
  SizingOptions options;
  options.size_min = 0.05;
  for (const Gradation gradation : {Gradation::space, Gradation::surface}) {
    options.gradation = gradation;
    const SizingField field = field_of(model, options);
    double bytes = 0, blocks = 0;
    for (const SizingField::Level& level : field.levels()) {
      bytes += static_cast<double>(level.bytes);
      blocks += static_cast<double>(level.blocks);
    }
    EXPECT_GT(field.levels().size(), 7u);
    EXPECT_GT(blocks, 1000);
    EXPECT_GT(bytes, 2048 * blocks);  // each holds 512 floats
    EXPECT_LT(bytes, 200e6);
    double least = options.size_min * 100;
    for (const CadEdge& edge : model.shape().edges) {
      SizingField::Sampler size_at(field, edge);
      least = std::min(least, size_at(EdgeCurve(edge).point(0.5 * (edge.first + edge.last))));
    }
    EXPECT_NEAR(least, 2 * M_PI * 0.1 / 12, 0.002);
  }
}

/// Refused by an estimate, which has to be about right: half of the budget that it names is enough for twice
/// the size.
TEST(SizingField, IsExactAtATinyVertexToo) {
  const CadModel model = CadModel::read(sample_model("box").path());
  SizingOptions options;
  options.size = 2;
  options.vertex_sizes[1] = 1e-7;
  const SizingField field = field_of(model, options);
  SizingField::Sampler size_at(field);
  const Vector3 corner = model.shape().vertices[vertex_id(1)];
  EXPECT_NEAR(size_at(corner), 1e-7, 1e-9);
  for (const double distance : {1e-6, 1e-4, 1e-2, 1.0}) {
    const double size = size_at(corner + Vector3(distance, 0, 0));
    EXPECT_LE(size, 1e-7 + options.growth * distance * 1.01);
    EXPECT_GE(size, 0.2 * options.growth * distance);
  }
}

TEST(SizingField, TakesSizesFromNamesAndCurvature) {
  const CadModel cylinder = CadModel::read(sample_model("cylinder").path());
  SizingOptions options;
  options.size = cylinder.diagonal() / 3;
  options.elements_per_circle = 30;
  const SizingField curved = field_of(cylinder, options);
  SizingField::Sampler curved_at(curved);
  const CadEdge* circle = nullptr;
  for (const CadEdge& edge : cylinder.shape().edges) {
    if (edge.closed()) circle = &edge;
  }
  ASSERT_NE(circle, nullptr);
  const EdgeCurve curve(*circle);
  const double wanted = circle->length / 30;
  for (int i = 0; i < 20; ++i) {
    const Vector3 p = curve.point(circle->first + (circle->last - circle->first) * i / 20);
    EXPECT_NEAR(curved_at(p), wanted, 0.1 * wanted);
  }
  const CadModel box = CadModel::read(sample_model("box").path());
  SizingOptions named;
  named.size = 4;
  named.vertex_sizes[2] = 0.4;
  named.edge_sizes[5] = 1;
  const SizingField field = field_of(box, named);
  SizingField::Sampler size_at(field);
  EXPECT_NEAR(size_at(box.shape().vertices[vertex_id(2)]), 0.4, 0.1);
  const EdgeCurve straight(box.shape().edges[edge_id(5)]);
  const CadEdge& edge = box.shape().edges[edge_id(5)];
  for (int i = 1; i < 10; ++i)
    EXPECT_LE(size_at(straight.point(edge.first + (edge.last - edge.first) * i / 10)), 1.05);
}

/// A small size by name must not let curvature elsewhere go below the minimum size.
TEST(SizingField, NamedSizesLeaveTheMinimumSizeOfOtherSourcesAlone) {
  const CadModel cylinder = CadModel::read(sample_model("cylinder").path());
  const CadShape& shape = cylinder.shape();
  SizingOptions options;
  options.size = cylinder.diagonal() / 3;
  options.size_min = options.size / 2;
  options.elements_per_circle = 300;
  options.growth = 2;
  options.vertex_sizes[shape.edges[edge_id(1)].first_vertex.number()] = options.size / 50;
  const SizeLimits limits = size_limits(cylinder, options);
  EXPECT_DOUBLE_EQ(limits.least, options.size / 50);
  EXPECT_DOUBLE_EQ(limits.size_min, options.size_min);
  EXPECT_DOUBLE_EQ(size_of_curvature(options, limits, 1e6), options.size_min);
  const SizingField field = field_of(cylinder, options);
  SizingField::Sampler size_at(field);
  EXPECT_NEAR(size_at(shape.vertices[shape.edges[edge_id(1)].first_vertex]), options.size / 50,
              options.size / 500);
  // Farther away, all sizes are those without the vertex.
  const Vector3 vertex = shape.vertices[shape.edges[edge_id(1)].first_vertex];
  SizingOptions without = options;
  without.vertex_sizes.clear();
  const SizingField plain = field_of(cylinder, without);
  SizingField::Sampler plain_at(plain);
  int compared = 0;
  for (const CadEdge& edge : shape.edges) {
    const EdgeCurve curve(edge);
    for (int i = 0; i < 20; ++i) {
      const Vector3 p = curve.point(edge.first + (edge.last - edge.first) * i / 20);
      if ((p - vertex).norm() < options.size) continue;
      EXPECT_NEAR(size_at(p), plain_at(p), 1e-3 * options.size);
      ++compared;
    }
  }
  EXPECT_GT(compared, 5);
  const EdgeFlags fine = edges_below_size_min(cylinder, options, limits);
  EXPECT_TRUE(fine[edge_id(1)]);
  EXPECT_LT(std::count(fine.begin(), fine.end(), 1), static_cast<int>(fine.size()));
}

/// Biases below 1 from both ends have their shortest segments in the middle.
TEST(SizingField, GoesDownToTheShortestSegmentOfAnEdge) {
  const CadModel box = CadModel::read(sample_model("box").path());
  SizingOptions options;
  options.size = 4;
  options.spacings[1] = {21, 1, 0.6};
  const SizeLimits limits = size_limits(box, options);
  double sum = 0;
  for (int k = 0; k < 21; ++k) sum += std::pow(0.6, std::min(k, 20 - k));
  EXPECT_NEAR(limits.least, box.shape().edges[edge_id(1)].length * std::pow(0.6, 10) / sum, 1e-9);
}

TEST(SizingField, ComesBackFromItsFile) {
  const CadModel model = CadModel::read(sample_model("bracket").path());
  SizingOptions options;
  options.size = model.diagonal() / 30;
  const SizingField field = field_of(model, options);
  const std::filesystem::path path = std::filesystem::temp_directory_path() / "quadrille_sizing_test.vdb";
  field.write(path);
  SizingOptions reread;
  reread.size = options.size;
  reread.elements_per_circle = 0;
  reread.size_field = path;
  const SizingField again = field_of(model, reread);
  SizingField::Sampler first(field), second(again);
  int refined = 0;
  for (const CadEdge& edge : model.shape().edges) {
    if (edge.degenerate) continue;
    const Vector3 p = EdgeCurve(edge).point(0.5 * (edge.first + edge.last));
    EXPECT_LE(second(p), 1.05 * first(p));
    EXPECT_GE(second(p), 0.4 * first(p));
    refined += first(p) < 0.9 * options.size;
  }
  EXPECT_GT(refined, 0);
  std::filesystem::remove(path);
}

/// A field of one size throughout has no voxels.
TEST(SizingField, OfOneSizeComesBackFromItsFile) {
  const CadModel model = CadModel::read(sample_model("box").path());
  SizingOptions options;
  options.size = 1;
  const std::filesystem::path path = std::filesystem::temp_directory_path() / "quadrille_one_size_test.vdb";
  field_of(model, options).write(path);
  options.size_field = path;
  const SizingField again = field_of(model, options);
  for (const CadEdge& edge : model.shape().edges)
    EXPECT_EQ(SizingField::Sampler(again)(EdgeCurve(edge).point(edge.first)), 1);
  std::filesystem::remove(path);
}

TEST(SizingField, RefusesFilesThatAreNotGrids) {
  const CadModel model = CadModel::read(sample_model("box").path());
  SizingOptions options;
  options.size = 1;
  options.size_field = sample_model("box").path();
  EXPECT_THROW(field_of(model, options), Error);
}

/// Every face's number of segments, seams twice.
IdVector<FaceId, int> face_counts(const CadModel& model, const BoundaryNodes& nodes) {
  IdVector<FaceId, int> counts(model.face_count());
  for (const EdgeId edge : model.shape().edges.ids()) {
    if (nodes.edges[edge].nodes.empty()) continue;
    for (const FaceId face : model.shape().edges[edge].faces) counts[face] += nodes.edges[edge].segments();
  }
  return counts;
}

TEST(EdgeSampling, MakesEveryFaceEvenWithSegmentsOfTheSize) {
  for (const SampleModel& sample : sample_models()) {
    const CadModel model = CadModel::read(sample.path());
    for (const Strategy strategy : {Strategy::direct, Strategy::subdivide}) {
      for (const double divisions : {5.0, 13.0, 40.0, 111.0}) {
        SCOPED_TRACE(sample.name + " " + std::to_string(divisions));
        MeshOptions options;
        options.strategy = strategy;
        options.sizing.size = model.diagonal() / divisions;
        ExecutionContext context;
        const SizingField field = field_of(model, options.sizing);
        const BoundaryNodes nodes =
            sample_edges(model.shape(), field, stride(options.strategy), FaceFlags(sample.faces, 1),
                         SamplingPlan(model.shape()), context);
        const IdVector<FaceId, int> counts = face_counts(model, nodes);
        for (const FaceId face : counts.ids()) {
          // Only grids go without the stride, and faces with edges that are too short for two segments.
          const std::vector<EdgeId> around = model.shape().faces[face].edges();
          const bool has_single = std::any_of(around.begin(), around.end(),
                                              [&](EdgeId edge) { return nodes.edges[edge].segments() == 1; });
          const bool is_grid = nodes.plans[face].sides.rest.empty();
          EXPECT_EQ(counts[face] % (is_grid || has_single ? 2 : 2 * nodes.stride), 0);
          EXPECT_GE(counts[face], 4);
        }
        for (const EdgeId i : model.shape().edges.ids()) {
          const auto& edge = nodes.edges[i];
          const CadEdge& cad = model.shape().edges[i];
          if (cad.degenerate) {
            EXPECT_TRUE(edge.nodes.empty());
            continue;
          }
          ASSERT_GE(edge.segments(), cad.closed() ? 4 : 1);
          EXPECT_TRUE(std::is_sorted(edge.parameters.begin(), edge.parameters.end()));
          EXPECT_EQ(cad.closed(), edge.nodes.front() == edge.nodes.back());
          const EdgeCurve curve(cad);
          for (std::size_t k = 0; k < edge.nodes.size(); ++k) {
            EXPECT_LT((curve.point(edge.parameters[k]) - nodes.points[edge.nodes[k]]).norm(),
                      1e-6 * model.diagonal());
          }
        }
      }
    }
  }
}

/// What a remedy asks for holds, although the opposite edges, which get the same count, want fewer segments.
TEST(EdgeSampling, FinerStretchesGetTheirSegments) {
  const CadModel box = CadModel::read(sample_model("box").path());
  const CadEdge& edge = box.shape().edges[edge_id(1)];
  SizingOptions options;
  ExecutionContext context;
  for (const int wanted : {3, 4, 7}) {
    for (const int asked : {wanted + 1, 2 * wanted - 1, 2 * wanted, 5 * wanted}) {
      options.size = 0.5 * edge.length / wanted;  // half of it: triangles have twice the size
      SamplingPlan plan(box.shape());
      plan.finer = {{edge_id(1), edge.first, edge.last, asked}};
      const BoundaryNodes nodes =
          sample_edges(box.shape(), field_of(box, options), 2, FaceFlags(box.face_count(), 1), plan, context);
      EXPECT_GE(nodes.edges[edge_id(1)].segments(), 2 * asked) << wanted;
    }
  }
}

TEST(EdgeSampling, NoSegmentIsFarFromItsNeighborOnAUniformField) {
  const CadModel model = CadModel::read(sample_model("bezier_patch").path());
  MeshOptions options;
  options.sizing.size = model.diagonal() / 80;
  options.sizing.elements_per_circle = 0;
  ExecutionContext context;
  const BoundaryNodes nodes =
      sample_edges(model.shape(), field_of(model, options.sizing), stride(options.strategy), FaceFlags(1, 1),
                   SamplingPlan(model.shape()), context);
  for (const auto& edge : nodes.edges) {
    double low = 1e9, high = 0;
    for (int k = 0; k < edge.segments(); ++k) {
      const double length = (nodes.points[edge.nodes[k + 1]] - nodes.points[edge.nodes[k]]).norm();
      low = std::min(low, length);
      high = std::max(high, length);
    }
    EXPECT_LT(high / low, 1.02);
  }
}

}  // namespace
}  // namespace quadrille
