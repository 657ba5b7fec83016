/// The stages inside a face, one by one, on every face of every sample model.

#include <gtest/gtest.h>

#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakePolygon.hxx>
#include <gp_Pnt.hxx>

#include <algorithm>
#include <memory>
#include <set>

#include "geometry/cad/cad_shape.hpp"
#include "mesher/faces/face_boundary.hpp"
#include "mesher/faces/face_triangulation.hpp"
#include "mesher/quadrille.hpp"
#include "mesher/quads/subdivision.hpp"
#include "tests/support/ids.hpp"
#include "tests/support/sample_models.hpp"

namespace quadrille {
namespace {

std::string joined(const std::vector<std::string>& lines) {
  std::string result;
  for (const auto& line : lines) result += line + "\n";
  return result;
}

/// What the stages before a face give, for one model.
struct Prepared {
  CadModel model;
  MeshOptions options;
  ExecutionContext context;
  SizingField field;
  BoundaryNodes nodes;

  Prepared(const SampleModel& sample, double divisions, Strategy strategy)
      : model(CadModel::read(sample.path())),
        options(make_options(model, divisions, strategy)),
        field(SizingField::build(model, options.sizing, context)),
        nodes(sample_edges(model.shape(), field, stride(options.strategy), FaceFlags(sample.faces, 1),
                           SamplingPlan(model.shape()), context)) {}

  static MeshOptions make_options(const CadModel& model, double divisions, Strategy strategy) {
    MeshOptions options;
    options.strategy = strategy;
    options.sizing.size = model.diagonal() / divisions;
    return options;
  }
};

template <class Visit>
void for_each_face(Visit&& visit) {
  int faces = 0;
  for (const SampleModel& sample : sample_models()) {
    for (const Strategy strategy : {Strategy::direct, Strategy::subdivide}) {
      for (const double divisions : {10.0, 37.0}) {
        Prepared prepared(sample, divisions, strategy);
        for (const FaceId face : prepared.model.shape().faces.ids()) {
          SCOPED_TRACE(sample.name + " Face" + std::to_string(face.number()) + " at 1/" +
                       std::to_string(divisions));
          const FaceSurface surface(prepared.model.shape().faces[face]);
          visit(prepared, face, surface,
                face_boundary(prepared.model.shape(), face, surface, prepared.nodes));
          ++faces;
        }
      }
    }
  }
  EXPECT_GT(faces, 100);
}

PlacedPoints place(Prepared& prepared, const FaceSurface& surface, const FaceBoundary& boundary) {
  SizingField::Sampler size_at(prepared.field);
  PlacementOptions options;
  options.scale = prepared.nodes.stride;
  return place_points(boundary, surface, enclosed_domain(boundary), size_at, options, prepared.context);
}

TEST(FaceBoundary, LiesOnTheEdgesAndCloses) {
  for_each_face([](Prepared& prepared, FaceId, const FaceSurface& surface, const FaceBoundary& boundary) {
    std::vector<int> leaving(boundary.size(), 0), arriving(boundary.size(), 0);
    for (const auto& segment : boundary.segments) {
      ++leaving[segment.a];
      ++arriving[segment.b];
    }
    for (int i = 0; i < boundary.size(); ++i) {
      EXPECT_EQ(leaving[i], arriving[i]);
      const double off = (surface.point(boundary.uv[i]) - boundary.points[i]).norm();
      EXPECT_LT(off, 1e-5 * prepared.model.diagonal());
    }
    const auto with_length = std::count_if(boundary.segments.begin(), boundary.segments.end(),
                                           [](const FaceBoundary::Segment& s) { return !s.degenerate; });
    EXPECT_EQ(with_length % 2, 0);
  });
}

TEST(Placement, KeepsItsDistanceAndStaysInside) {
  for_each_face([](Prepared& prepared, FaceId, const FaceSurface& surface, const FaceBoundary& boundary) {
    const TrimmedDomain domain = enclosed_domain(boundary);
    const PlacedPoints placed = place(prepared, surface, boundary);
    SizingField::Sampler size_at(prepared.field);
    // Points come as near to each other as the nodes of the boundary, down to 0.4 times the size.
    double least = 1;
    for (const auto& segment : boundary.segments) {
      const double length = (boundary.points[segment.b] - boundary.points[segment.a]).norm();
      for (const int end : {segment.a, segment.b})
        least = std::min(least, length / (prepared.nodes.stride * size_at(boundary.points[end])));
    }
    least = std::max(least, 0.4);
    for (std::size_t i = 0; i < placed.uv.size(); ++i) {
      EXPECT_TRUE(domain.inside(placed.uv[i]));
      EXPECT_LT((surface.point(placed.uv[i]) - placed.points[i]).norm(), 1e-9 * prepared.model.diagonal());
      const double limit = 0.5 * least * prepared.nodes.stride * size_at(placed.points[i]);
      for (std::size_t j = i + 1; j < std::min(placed.uv.size(), i + 50); ++j) {
        EXPECT_GT((placed.points[i] - placed.points[j]).norm(), limit);
      }
    }
  });
}

TEST(Triangulation, IsValidAndKeepsTheBoundary) {
  for_each_face(
      [](Prepared& prepared, FaceId face, const FaceSurface& surface, const FaceBoundary& boundary) {
        const FaceTriangulation result =
            triangulate_face(face, boundary, place(prepared, surface, boundary), surface);
        EXPECT_EQ(joined(validate(result.mesh)), "");
        EXPECT_EQ(result.mesh.triangles.size() % 2, 0U);
        std::set<std::pair<int, int>> open;
        for (const auto& t : result.mesh.triangles) {
          for (int k = 0; k < 3; ++k) {
            const auto side = std::minmax(t[k], t[(k + 1) % 3]);
            if (!open.insert(side).second) open.erase(side);
          }
        }
        std::set<std::pair<int, int>> wanted;
        for (const auto& segment : result.segments) wanted.insert(std::minmax(segment.a, segment.b));
        EXPECT_EQ(open, wanted);
      });
}

TEST(Recombination, LeavesNoTriangleAndKeepsTheArea) {
  for_each_face(
      [](Prepared& prepared, FaceId face, const FaceSurface& surface, const FaceBoundary& boundary) {
        const FaceTriangulation triangulation =
            triangulate_face(face, boundary, place(prepared, surface, boundary), surface);
        const QuadMesh quads = recombine(triangulation.mesh, prepared.options.recombine, prepared.context);
        EXPECT_EQ(joined(validate(quads)), "");
        EXPECT_TRUE(quads.triangles.empty());
        EXPECT_EQ(2 * quads.quads.size(), triangulation.mesh.triangles.size());
      });
}

TEST(FaceSurface, IsTheSameSeenFromAbove) {
  const CadModel model = CadModel::read(sample_model("bezier_patch").path());
  const CadFace& face = model.shape().faces[face_id(1)];
  const FaceSurface own(face);
  std::vector<Vector3> loop;
  const Vector2 low(face.u_min, face.v_min), span(face.u_max - face.u_min, face.v_max - face.v_min);
  for (const Vector2& corner : {Vector2(0, 0), Vector2(1, 0), Vector2(1, 1), Vector2(0, 1)})
    loop.push_back(own.point(low + corner.cwiseProduct(span)));
  const FaceSurface view = FaceSurface::seen_from_above(face, loop);
  EXPECT_TRUE(view.is_view());
  const double size = (loop[2] - loop[0]).norm();
  for (int i = 0; i < 100; ++i) {
    const int column = i % 10, row = i / 10;
    const Vector2 uv = low + Vector2(0.05 + column / 11.0, 0.05 + row / 11.0).cwiseProduct(span);
    const Vector3 point = own.point(uv);
    const Vector2 seen = view.seen_at(point);
    const SurfacePoint at = view.evaluate(seen);
    EXPECT_LT((at.point - point).norm(), 1e-6 * size);
    EXPECT_GT(view.normal(seen).dot(own.normal(uv)), 1 - 1e-6);
    const double step = 1e-5 * size;
    EXPECT_LT((view.point(seen + Vector2(step, 0)) - at.point - step * at.du).norm(), 1e-3 * step);
    EXPECT_LT((view.point(seen + Vector2(0, step)) - at.point - step * at.dv).norm(), 1e-3 * step);
    Vector2 moved = seen;
    EXPECT_LT((view.project(moved, point + 0.01 * size * view.normal(seen)).point - point).norm(),
              0.02 * size);
  }
}

TEST(FaceBoundary, IsHalvedAtTheNodesBetween) {
  for_each_face([](Prepared& prepared, FaceId, const FaceSurface&, const FaceBoundary& boundary) {
    const FaceBoundary half = halved(boundary);
    if (boundary.stride == 1) {
      EXPECT_EQ(half.size(), boundary.size());
      return;
    }
    const auto with_length = [](const FaceBoundary& of) {
      return std::count_if(of.segments.begin(), of.segments.end(),
                           [](const FaceBoundary::Segment& s) { return !s.degenerate; });
    };
    EXPECT_EQ(half.stride, 1);
    EXPECT_EQ(with_length(half), 2 * with_length(boundary));
    EXPECT_EQ(half.size(), boundary.size() + with_length(boundary));
    std::vector<int> leaving(half.size(), 0), arriving(half.size(), 0);
    for (const auto& segment : half.segments) {
      EXPECT_EQ(segment.middle_node, -1);
      ++leaving[segment.a];
      ++arriving[segment.b];
    }
    EXPECT_EQ(leaving, arriving);
    for (int i = 0; i < half.size(); ++i) EXPECT_EQ(half.points[i], prepared.nodes.points[half.nodes[i]]);
    for (std::size_t wire = 0; wire < half.first_segments.size(); ++wire) {
      for (std::size_t k = 0; k < half.first_segments[wire].size(); ++k) {
        const int first = boundary.first_segments[wire][k], now = half.first_segments[wire][k];
        ASSERT_EQ(first < 0, now < 0);
        if (first >= 0) {
          EXPECT_EQ(half.segments[now].a, boundary.segments[first].a);
        }
      }
    }
  });
}

/// Cut into four, elements of twice the size leave 23 quads of this wedge outside the limits.
TEST(FaceMesher, TakesElementsOfTheFinalSizeWherePartsOfLargerOnesArePoor) {
  const TopoDS_Shape wedge =
      BRepBuilderAPI_MakeFace(
          BRepBuilderAPI_MakePolygon(gp_Pnt(0, 0, 0), gp_Pnt(40, 0, 0), gp_Pnt(40, 8, 0), true).Wire())
          .Face();
  MeshOptions options;
  options.sizing.size = 4;
  ExecutionContext context(1);
  const ShellMesh shell = mesh(CadModel(std::make_shared<CadShape>(wedge, "wedge")), options, context);
  EXPECT_EQ(joined(validate(shell)), "");
  EXPECT_LE(check_criteria(shell).failing, 6);
}

}  // namespace
}  // namespace quadrille
