/// Strips that want no more than one row.

#include "mesher/edges/edge_counts.hpp"

#include <gtest/gtest.h>

#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakePolygon.hxx>
#include <BRepPrimAPI_MakePrism.hxx>
#include <gp_Pnt.hxx>
#include <gp_Vec.hxx>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <numbers>
#include <vector>

#include "mesher/quadrille.hpp"
#include "mesher/shell/validate.hpp"

namespace quadrille {
namespace {

/// The numbers of rows on the chamfers, 0.8 wide, of a bar of 40 x 30 x 60 that has some along its edges.
std::map<int, int> rows_of_chamfers(int chamfers) {
  const double leg = 0.8 / std::numbers::sqrt2;
  BRepBuilderAPI_MakePolygon outline;
  const std::vector<gp_Pnt> corners{{0, 0, 0}, {40, 0, 0}, {40, 30, 0}, {0, 30, 0}};
  for (int i = 0; i < 4; ++i) {
    const gp_Pnt& corner = corners[i];
    if (i >= chamfers) {
      outline.Add(corner);
      continue;
    }
    const gp_Vec before(corner, corners[(i + 3) % 4]), after(corner, corners[(i + 1) % 4]);
    outline.Add(corner.Translated(leg * before.Normalized()));
    outline.Add(corner.Translated(leg * after.Normalized()));
  }
  outline.Close();
  const CadModel bar(std::make_shared<CadShape>(
      BRepPrimAPI_MakePrism(BRepBuilderAPI_MakeFace(outline.Wire()).Face(), gp_Vec(0, 0, 60)).Shape(),
      "bar"));
  MeshOptions options;
  options.sizing.size = 8;
  options.sizing.size_min = 1;
  ExecutionContext context(1);
  const ShellMesh result = mesh(bar, options, context);
  EXPECT_EQ(validate(result, true), std::vector<std::string>{});
  std::map<int, int> rows;
  for (std::size_t i = 0; i < result.quads.size(); ++i) {
    const Vector3 diagonal = result.points[result.quads[i][2]] - result.points[result.quads[i][0]];
    const CadFace& face = bar.shape().faces[FaceId::from_number(result.quad_faces[i])];
    const auto is_end = [&](const Coedge& edge) { return bar.shape().edges[edge.edge].length < 1; };
    const auto& around = face.wires.front().coedges;
    if (around.size() != 4 || std::none_of(around.begin(), around.end(), is_end)) continue;
    const double width = Vector2(diagonal.x(), diagonal.y()).norm();
    rows[result.quad_faces[i]] = static_cast<int>(std::lround(0.8 / width));
  }
  return rows;
}

/// The end faces of the bar need an even number of segments: pairs of chamfers may have one row each.
TEST(SingleSegments, KeepFacesEven) {
  for (const int chamfers : {1, 2, 3, 4}) {
    int single = 0;
    const std::map<int, int> rows = rows_of_chamfers(chamfers);
    EXPECT_EQ(rows.size(), chamfers);
    for (const auto& [face, number] : rows) single += number == 1;
    EXPECT_EQ(single, chamfers - chamfers % 2) << chamfers;
  }
}

}  // namespace
}  // namespace quadrille
