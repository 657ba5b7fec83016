/// The last look at a mesh finds faces, sides and chains that are not as in the CAD model.

#include "mesher/shell/shell_check.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "mesher/quadrille.hpp"
#include "tests/support/sample_models.hpp"

namespace quadrille {
namespace {

struct Meshed {
  explicit Meshed(const std::string& name) : model(CadModel::read(path_of(name))) {
    MeshOptions options;
    options.sizing.size = model.diagonal() / 15;
    options.rings = 0;  // they are narrower than what may be suppressed
    ExecutionContext context(1);
    shell = mesh(model, options, context);
  }

  static std::filesystem::path path_of(const std::string& name) {
    const auto& models = sample_models();
    return std::find_if(models.begin(), models.end(), [&](const auto& m) { return m.name == name; })->path();
  }

  std::string defects() const {
    std::string text;
    const FaceFlags all(model.shape().faces.size(), 1);
    for (const std::string& sentence : shell_defects(model.shape(), all, shell)) text += sentence + "\n";
    return text;
  }

  /// Leaves out the quads for which `goes(index)` holds.
  template <class Goes>
  void drop(Goes&& goes) {
    ShellMesh rest = shell;
    rest.quads.clear();
    rest.quad_faces.clear();
    for (std::size_t i = 0; i < shell.quads.size(); ++i) {
      if (goes(i)) continue;
      rest.quads.push_back(shell.quads[i]);
      rest.quad_faces.push_back(shell.quad_faces[i]);
    }
    shell = rest;
  }

  CadModel model;
  ShellMesh shell;
};

TEST(ShellCheck, AllSampleModelsAreWhole) {
  for (const SampleModel& sample : sample_models())
    EXPECT_EQ(Meshed(sample.name).defects(), "") << sample.name;
}

TEST(ShellCheck, AFaceWithoutQuadsIsNamed) {
  Meshed bracket("bracket");
  bracket.drop([&](std::size_t i) { return bracket.shell.quad_faces[i] == 3; });
  EXPECT_NE(bracket.defects().find("Face3 has no mesh"), std::string::npos) << bracket.defects();
  EXPECT_NE(bracket.defects().find("not as tight"), std::string::npos) << bracket.defects();
  // A face that is known to have failed is not lost, and the edges round it are free.
  bracket.shell.faces[2].status = FaceStatus::failed;
  EXPECT_EQ(bracket.defects(), "");
}

TEST(ShellCheck, AMissingQuadLeavesOpenSides) {
  Meshed box("box");
  box.drop([](std::size_t i) { return i == 7; });
  EXPECT_NE(box.defects().find("4 of its sides are open"), std::string::npos) << box.defects();
}

TEST(ShellCheck, AGapBesideAFreeEdgeIsNoFreeEdge) {
  // Quads inside a sheet are far from its rim, those at the rim are not: their inner sides must count too. A
  // quad with all its nodes on rims is left out: what is left without it is a mesh of a coarser rim.
  Meshed sheet("plate_with_holes");
  const ShellMesh whole = sheet.shell;
  std::set<int> on_rim;
  for (const auto& segment : whole.segments) on_rim.insert(segment.nodes.begin(), segment.nodes.end());
  for (std::size_t quad = 0; quad < whole.quads.size(); ++quad) {
    const auto& corners = whole.quads[quad];
    if (std::all_of(corners.begin(), corners.end(), [&](int node) { return on_rim.contains(node); }))
      continue;
    sheet.shell = whole;
    sheet.drop([&](std::size_t i) { return i == quad; });
    EXPECT_NE(sheet.defects().find("not as tight"), std::string::npos)
        << quad << " at " << whole.points[corners[0]].transpose() << ", "
        << whole.points[corners[1]].transpose() << ", " << whole.points[corners[2]].transpose() << ", "
        << whole.points[corners[3]].transpose();
  }
}

TEST(ShellCheck, NodesOfAnEdgeThatAreApartAreTold) {
  Meshed box("box");
  auto& segments = box.shell.segments;
  const auto inner = std::find_if(segments.begin() + 1, segments.end(),
                                  [&](const auto& segment) { return segment.edge == segments.front().edge; });
  segments.erase(inner);
  EXPECT_NE(box.defects().find("form 2 chains"), std::string::npos) << box.defects();
}

TEST(ShellCheck, InvertedQuadsAreTold) {
  Meshed box("box");
  auto& quad = box.shell.quads[5];
  box.shell.points[quad[0]] = 2 * box.shell.points[quad[2]] - box.shell.points[quad[0]];
  EXPECT_NE(box.defects().find("inverted, the first on Face"), std::string::npos) << box.defects();
}

}  // namespace
}  // namespace quadrille
