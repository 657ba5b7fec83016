/// Rows of flat quads beside edges: divisions that grids carry.

#include "mesher/edges/chords.hpp"

#include <gtest/gtest.h>
#include <BRepAlgoAPI_Cut.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>

#include <algorithm>
#include <cmath>
#include <set>

#include "geometry/cad/cad_shape.hpp"
#include "mesher/edges/edge_sampling.hpp"
#include "mesher/quadrille.hpp"
#include "tests/support/sample_models.hpp"

namespace quadrille {
namespace {

ShellMesh mesh_of(const CadModel& model, const MeshOptions& options) {
  ExecutionContext context;
  return mesh(model, options, context);
}

int count_grids(const ShellMesh& mesh) {
  return static_cast<int>(
      std::count_if(mesh.faces.begin(), mesh.faces.end(),
                    [](const ShellMesh::Face& face) { return face.note.find("grid") != std::string::npos; }));
}

/// A division in grids alone leaves them grids, however uneven it is.
TEST(GridRows, BiasKeepsGrids) {
  const CadModel box = CadModel::read(sample_model("box").path());
  MeshOptions options;
  options.sizing.size = 2;
  options.sizing.spacings[4] = {24, 1.2, 1};
  const ShellMesh mesh = mesh_of(box, options);
  EXPECT_EQ(count_grids(mesh), 6);
  std::set<int> nodes;
  double shortest = 1e9, longest = 0;
  for (const ShellMesh::Segment& segment : mesh.segments) {
    if (segment.edge != 4) continue;
    const double length = (mesh.points[segment.nodes[0]] - mesh.points[segment.nodes[1]]).norm();
    shortest = std::min(shortest, length);
    longest = std::max(longest, length);
    nodes.insert(segment.nodes.begin(), segment.nodes.end());
  }
  EXPECT_EQ(nodes.size(), 25u);
  EXPECT_NEAR(longest / shortest, std::pow(1.2, 23), 1e-3 * std::pow(1.2, 23));
}

/// On a plate with a hole, those are the edges through its thickness.
TEST(GridRows, AreOfEdgesBetweenFourSidedFacesAlone) {
  const CadShape shape(
      BRepAlgoAPI_Cut(BRepPrimAPI_MakeBox(40, 30, 8).Shape(),
                      BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(20, 15, -1), gp::DZ()), 5, 10).Shape()),
      "drilled");
  const SamplingPlan plan(shape);
  IdVector<EdgeId, double> wanted;
  for (const CadEdge& edge : shape.edges) wanted.push_back(edge.length);
  const FaceOutlines sides = find_face_sides(shape, FaceFlags(shape.faces.size(), 1), plan.tiny, wanted);
  int rows = 0;
  for (const EdgeId id : shape.edges.ids()) {
    const CadEdge& edge = shape.edges[id];
    SizingOptions options;
    options.spacings[edge.number].segments = std::max(4, static_cast<int>(edge.length));
    const EdgeFlags divided = find_grid_rows(shape, sides, prescribed_edges(shape, options, 1), options, 1);
    const bool is_in_grids = std::all_of(edge.faces.begin(), edge.faces.end(), [&](FaceId face) {
      return sides[face].has_four_sides() && sides[face].facing.size() == 2;
    });
    EXPECT_EQ(divided[id] != 0, is_in_grids) << edge.number;
    EXPECT_EQ(std::count(divided.begin(), divided.end(), 1), is_in_grids ? 1 : 0);
    rows += is_in_grids;
  }
  EXPECT_EQ(rows, 5);  // and the seam of the hole
}

}  // namespace
}  // namespace quadrille
