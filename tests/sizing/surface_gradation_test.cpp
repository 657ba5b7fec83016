/// Sizes grow along the surface: not across gaps, not through walls, and by the distance that brute force
/// finds.

#include "geometry/sizing/surface_gradation.hpp"

#include <gtest/gtest.h>

#include <BRepAlgoAPI_Cut.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRep_Builder.hxx>
#include <TopoDS_Compound.hxx>
#include <algorithm>
#include <cmath>
#include <memory>
#include <queue>
#include <vector>

#include "geometry/cad/cad_model.hpp"
#include "geometry/cad/cad_shape.hpp"
#include "geometry/sizing/sizing_field.hpp"
#include "geometry/surfaces/face_surface.hpp"

namespace quadrille {
namespace {

CadModel model_of(const TopoDS_Shape& shape) {
  return CadModel(std::make_shared<CadShape>(shape, "made"));
}

TopoDS_Shape box(const gp_Pnt& a, const gp_Pnt& b) {
  return BRepPrimAPI_MakeBox(a, b).Shape();
}

/// A tray of walls 1 thick.
CadModel housing() {
  return model_of(BRepAlgoAPI_Cut(box({0, 0, 0}, {60, 40, 30}), box({1, 1, 1}, {59, 39, 31})).Shape());
}

int vertex_at(const CadModel& model, const Vector3& place) {
  const auto& vertices = model.shape().vertices;
  for (const VertexId vertex : vertices.ids()) {
    if ((vertices[vertex] - place).norm() < 1e-6) return vertex.number();
  }
  ADD_FAILURE() << "no vertex at " << place.transpose();
  return 1;
}

SizingField field_of(const CadModel& model, const SizingOptions& options) {
  ExecutionContext context;
  return SizingField::build(model, options, context);
}

/// Points on the faces, with the shortest way along them from a source: through all pairs of points of a face
/// that are near each other, over points that faces share.
class BruteForce {
 public:
  BruteForce(const CadModel& model, const Vector3& source) {
    constexpr double step = 1;
    for (const CadFace& face : model.shape().faces) {
      const FaceSurface surface(face);  // a plane: parameters are lengths
      std::vector<int>& here = faces_.emplace_back();
      const auto n = [](double length) { return static_cast<int>(std::lround(length / step)); };
      const int nu = n(face.u_max - face.u_min), nv = n(face.v_max - face.v_min);
      for (int k = 0; k < (nu + 1) * (nv + 1); ++k) {
        const int column = k % (nu + 1), row = k / (nu + 1);
        const Vector3 p = surface.point({face.u_min + step * column, face.v_min + step * row});
        here.push_back(index_of(p));
      }
    }
    walk(index_of(source), step);
  }

  template <class Visit>
  void visit(Visit&& visit) const {
    for (std::size_t face = 0; face < faces_.size(); ++face) {
      for (const int i : faces_[face]) visit(static_cast<int>(face), points_[i], distance_[i]);
    }
  }

 private:
  int index_of(const Vector3& p) {
    for (std::size_t i = 0; i < points_.size(); ++i) {
      if ((points_[i] - p).norm() < 1e-6) return static_cast<int>(i);
    }
    points_.push_back(p);
    return static_cast<int>(points_.size()) - 1;
  }

  void walk(int source, double step) {
    distance_.assign(points_.size(), 1e9);
    std::vector<std::vector<int>> faces_of(points_.size());
    for (std::size_t face = 0; face < faces_.size(); ++face) {
      for (const int i : faces_[face]) faces_of[i].push_back(static_cast<int>(face));
    }
    using Item = std::pair<double, int>;
    std::priority_queue<Item, std::vector<Item>, std::greater<>> queue;
    distance_[source] = 0;
    queue.push({0, source});
    while (!queue.empty()) {
      const auto [d, at] = queue.top();
      queue.pop();
      if (d > distance_[at]) continue;
      for (const int face : faces_of[at]) {
        for (const int to : faces_[face]) {
          const double way = (points_[to] - points_[at]).norm();
          if (way > 4.5 * step || d + way >= distance_[to]) continue;
          distance_[to] = d + way;
          queue.push({distance_[to], to});
        }
      }
    }
  }

  std::vector<Vector3> points_;
  std::vector<std::vector<int>> faces_;
  std::vector<double> distance_;
};

TEST(SurfaceGradation, IsExactToTheVoxel) {
  const CadModel model = housing();
  const Vector3 source(0, 0, 30);
  const BruteForce exact(model, source);
  SizingOptions options;
  options.size = 8;
  options.short_edges = false;
  options.gradation = Gradation::surface;
  for (const double growth : {0.15, 0.3}) {
    options.growth = growth;
    options.vertex_sizes = {{vertex_at(model, source), 0.5}};
    options.size_min = 0.5;
    for (const CadEdge& edge : model.shape().edges) ASSERT_GT(edge.length, 8);
    const SizingField field = field_of(model, options);
    std::vector<std::unique_ptr<SizingField::Sampler>> samplers;
    for (const FaceId face : model.shape().faces.ids())
      samplers.push_back(std::make_unique<SizingField::Sampler>(field, face));
    int between = 0;
    exact.visit([&](int face, const Vector3& p, double distance) {
      const double expected = std::min(8.0, 0.5 + growth * distance), size = (*samplers[face])(p);
      // What it grows over the voxels at both ends; paths over 26 neighbors are up to 8 % too long.
      const double slack = growth * 2 * field_voxel(8, std::min(expected, 7.9), growth);
      EXPECT_LE(size, 1.08 * expected + slack) << p.transpose();
      EXPECT_GE(size, expected - slack) << p.transpose();
      between += expected > 1 && expected < 7;
    });
    EXPECT_GT(between, 500);
  }
}

/// The least size on the faces where a predicate holds of the face's middle.
template <class Holds>
double least_on(const CadModel& model, const SizingField& field, Holds&& holds) {
  double least = 1e9;
  for (const FaceId id : model.shape().faces.ids()) {
    const CadFace& face = model.shape().faces[id];
    const FaceSurface surface(face);
    const Vector2 low(face.u_min, face.v_min), extent(face.u_max - face.u_min, face.v_max - face.v_min);
    if (!holds(surface.point(low + 0.5 * extent))) continue;
    SizingField::Sampler size_at(field, id);
    for (int k = 0; k <= 20 * 20; ++k)
      least =
          std::min(least, size_at(surface.point(low + extent.cwiseProduct(Vector2(k % 20, k / 20) / 20))));
  }
  return least;
}

TEST(SurfaceGradation, DetailsStayOnTheirSideOfAGap) {
  BRep_Builder builder;
  TopoDS_Compound plates;
  builder.MakeCompound(plates);
  builder.Add(plates, box({0, 0, 0}, {50, 50, 10}));
  builder.Add(plates, box({0, 0, 11}, {50, 50, 21}));  // 1 above
  const CadModel model = model_of(plates);
  const auto above = [](const Vector3& middle) { return middle.z() > 10.5; };
  const auto below = [](const Vector3& middle) { return middle.z() == 10; };
  SizingOptions on_face;
  on_face.size = 5;
  for (const FaceId face : model.shape().faces.ids()) {
    const CadFace& cad = model.shape().faces[face];
    const Vector3 middle =
        FaceSurface(cad).point({0.5 * (cad.u_min + cad.u_max), 0.5 * (cad.v_min + cad.v_max)});
    if (std::abs(middle.z() - 10) < 1e-9) on_face.face_sizes[face.number()] = 0.3;
  }
  ASSERT_EQ(on_face.face_sizes.size(), 1u);
  on_face.gradation = Gradation::surface;
  const SizingField surface = field_of(model, on_face);
  EXPECT_NEAR(least_on(model, surface, below), 0.3, 0.01);
  EXPECT_DOUBLE_EQ(least_on(model, surface, above), 5);
  on_face.gradation = Gradation::space;
  EXPECT_LT(least_on(model, field_of(model, on_face), above), 1);
}

TEST(SurfaceGradation, DetailsStayOnTheirSideOfAWall) {
  const CadModel model = housing();
  SizingOptions options;
  options.size = 8;
  options.size_min = 0.1;
  options.gradation = Gradation::surface;
  const CadEdge* outer = nullptr;  // along the outer bottom
  for (const CadEdge& edge : model.shape().edges) {
    if (edge.length > 59.5 && model.shape().vertices[edge.first_vertex].z() == 0) outer = &edge;
  }
  ASSERT_NE(outer, nullptr);
  options.edge_sizes = {{outer->number, 0.4}};
  const auto is_inner_bottom = [](const Vector3& p) { return std::abs(p.z() - 1) < 1e-6; };
  EXPECT_DOUBLE_EQ(least_on(model, field_of(model, options), is_inner_bottom), 8);
  options.gradation = Gradation::space;
  EXPECT_LT(least_on(model, field_of(model, options), is_inner_bottom), 1.2);
}

}  // namespace
}  // namespace quadrille
