/// Every class of trouble that real CAD files bring, each on a small model of its own.

#include <gtest/gtest.h>

#include <BRepAlgoAPI_Cut.hxx>
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepGProp.hxx>
#include <BRepLib.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepTools.hxx>
#include <GProp_GProps.hxx>
#include <Geom2d_Line.hxx>
#include <Geom_Ellipse.hxx>
#include <Geom_SurfaceOfRevolution.hxx>
#include <Geom_ToroidalSurface.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <gp.hxx>
#include <gp_Ax2.hxx>
#include <gp_Ax3.hxx>
#include <map>
#include <memory>
#include <ostream>
#include <set>
#include <stdexcept>
#include <tuple>

#include "geometry/cad/cad_shape.hpp"
#include "geometry/cad/seams.hpp"
#include "mesher/estimate.hpp"
#include "mesher/mesh/criteria.hpp"
#include "mesher/quadrille.hpp"
#include "mesher/shell/area_check.hpp"
#include "tests/models/thin_models.hpp"
#include "tests/models/trouble_models.hpp"
#include "tests/support/process.hpp"

namespace quadrille {

/// What a failed test shows of its model.
void PrintTo(const TroubleModel& model,  // NOLINT(readability-identifier-naming): GoogleTest looks for it
             std::ostream* out) {
  *out << model.trouble;
}

namespace {

CadModel model_of(const TroubleModel& trouble) {
  return CadModel(std::make_shared<CadShape>(trouble.make(), trouble.name));
}

ShellMesh mesh_of(const CadModel& model, double divisions, Strategy strategy = Strategy::subdivide,
                  int threads = 1, int order = 1) {
  MeshOptions options;
  options.sizing.elements_per_diagonal = divisions;
  options.strategy = strategy;
  options.order = order;
  options.keep_features = true;  // these tests are about meshing what is hard to mesh
  options.sizing.short_edges = false;
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

/// Sides with one quad.
int open_sides(const ShellMesh& mesh) {
  std::map<std::pair<int, int>, int> uses;
  for (const auto& quad : mesh.quads) {
    for (int k = 0; k < 4; ++k) ++uses[std::minmax({quad[k], quad[(k + 1) % 4]})];
  }
  return static_cast<int>(
      std::count_if(uses.begin(), uses.end(), [](const auto& use) { return use.second == 1; }));
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
    for (const auto& face : mesh.faces) EXPECT_LE(face.attempts, 12) << face.face;
    const std::set<int> faces(mesh.quad_faces.begin(), mesh.quad_faces.end());
    EXPECT_EQ(static_cast<int>(faces.size()), model.face_count());
    EXPECT_EQ(static_cast<int>(mesh.corners.size()),
              trouble.corners >= 0 ? trouble.corners : model.vertex_count());
    EXPECT_NEAR(mesh_area(mesh) / area, 1, divisions > 50 ? 0.01 : divisions > 10 ? 0.03 : 0.12);
  }
}

TEST_P(EveryTrouble, IsMeshedFarTooCoarselyToo) {
  const TroubleModel& trouble = GetParam();
  const CadModel model = model_of(trouble);
  MeshOptions options;
  options.sizing.elements_per_diagonal = 8;
  options.sizing.elements_per_circle = 0;
  options.keep_features = true;
  ExecutionContext context(1);
  const ShellMesh coarse = mesh(model, options, context);
  EXPECT_EQ(joined(validate(coarse, trouble.closed)), "");
  const std::set<int> faces(coarse.quad_faces.begin(), coarse.quad_faces.end());
  EXPECT_EQ(static_cast<int>(faces.size()), model.face_count());
}

INSTANTIATE_TEST_SUITE_P(Robustness, EveryTrouble, testing::ValuesIn(trouble_models()),
                         [](const auto& test) { return test.param.name; });

const TroubleModel& trouble_named(const std::string& name) {
  for (const TroubleModel& model : trouble_models()) {
    if (name == model.name) return model;
  }
  throw std::invalid_argument(name);
}

std::string note_of(const ShellMesh& mesh, int face) {
  return mesh.faces.at(face - 1).note;
}

TEST(Robustness, NamesTheCauseAndItsRemedy) {
  const auto meshed = [](const char* name) { return mesh_of(model_of(trouble_named(name)), 20); };
  const auto has = [](const std::string& note, const std::string& words) {
    return note.find(words) != std::string::npos;
  };
  EXPECT_EQ(note_of(meshed("disc"), 1), "");
  EXPECT_PRED2(has, note_of(meshed("looped_edge"), 1), "meets Edge2 (parameters ");
  const std::string note = note_of(meshed("wrong_curves"), 1);
  EXPECT_PRED2(has, note, "parametric curves recreated by projection");
  EXPECT_FALSE(has(note, "seen from above")) << note;
  const ShellMesh ribs = mesh_of(CadModel(std::make_shared<CadShape>(ribbed_plate(3), "ribbed_plate")), 40);
  // Where one way to mesh a face fails, the next is tried at once.
  for (const auto& face : ribs.faces) EXPECT_EQ(face.attempts, 1) << face.face << ": " << face.note;
  // What the boundary alone tells costs no meshing.
  for (const char* name : {"disc", "looped_edge", "wrong_curves", "other_parameters"})
    EXPECT_EQ(meshed(name).faces[0].attempts, 1) << name;
}

/// Ribs narrower than the elements are no steps of a grid: their columns would go through the whole plate.
TEST(Robustness, LeavesStepsNarrowerThanElements) {
  const CadModel ribs(std::make_shared<CadShape>(ribbed_plate(6), "ribbed_plate"));
  const ShellMesh shell = mesh_of(ribs, 39.165);
  for (const auto& face : shell.faces) EXPECT_LE(face.attempts, 2) << face.face << ": " << face.note;
  EXPECT_LT(shell.quads.size(), 8000U);
}

TEST(Robustness, RefusesASurfaceThatIsACurve) {
  const TopoDS_Shape torus =
      BRepBuilderAPI_MakeFace(new Geom_ToroidalSurface(gp_Ax3(gp::XOY()), 20, 0), 1e-7).Shape();
  const CadModel model(std::make_shared<CadShape>(torus, "torus"));
  try {
    mesh_of(model, 15);
    FAIL() << "meshed";
  } catch (const Error& error) {
    EXPECT_EQ(error.subject(), "Face1");
    EXPECT_NE(std::string(error.what()).find("is a curve"), std::string::npos) << error.what();
  }
}

/// OpenCASCADE's STEP reader leaves only the rim of a dome that is a turned ellipse.
TEST(Robustness, TellsThatAReaderLostThePole) {
  const Handle(Geom_Ellipse) ellipse = new Geom_Ellipse(gp_Ax2(gp::Origin(), -gp::DY(), gp::DX()), 50, 25);
  const Handle(Geom_Surface) surface = new Geom_SurfaceOfRevolution(ellipse, gp::OZ());
  const TopoDS_Edge rim =
      BRepBuilderAPI_MakeEdge(new Geom2d_Line({0, 0}, gp_Dir2d(1, 0)), surface, 0, 2 * std::acos(-1)).Edge();
  BRepLib::BuildCurves3d(rim);
  const TopoDS_Shape dome = BRepBuilderAPI_MakeFace(surface, BRepBuilderAPI_MakeWire(rim)).Face();
  try {
    mesh_of(CadModel(std::make_shared<CadShape>(dome, "dome")), 15);
    FAIL() << "meshed";
  } catch (const Error& error) {
    EXPECT_EQ(error.subject(), "Face1");
    EXPECT_NE(std::string(error.what()).find("export"), std::string::npos) << error.what();
  }
}

/// Least and greatest length of the segments on a CAD edge.
std::pair<double, double> segment_lengths(const ShellMesh& mesh, int edge) {
  std::pair<double, double> range{INFINITY, 0};
  for (const auto& segment : mesh.segments) {
    if (segment.edge != edge) continue;
    const double length = (mesh.points[segment.nodes[1]] - mesh.points[segment.nodes[0]]).norm();
    range = {std::min(range.first, length), std::max(range.second, length)};
  }
  return range;
}

TEST(Robustness, RefinesOnlyWhereSegmentsCross) {
  const CadModel model = model_of(trouble_named("eccentric_hole"));
  MeshOptions options;
  options.sizing.size = 3;
  options.sizing.elements_per_circle = 0;
  ExecutionContext context(1);
  const ShellMesh coarse = mesh(model, options, context);
  EXPECT_EQ(joined(validate(coarse, false)), "");
  EXPECT_NE(note_of(coarse, 1).find(": finer segments there"), std::string::npos);
  for (const int edge : {1, 2}) {
    const auto [least, greatest] = segment_lengths(coarse, edge);
    EXPECT_LT(least, 1.5) << edge;     // where the hole is 0.05 from the rim
    EXPECT_GT(greatest, 2.2) << edge;  // elsewhere as asked
  }
}

/// Holes of radius 10 with a gap between each and the next.
CadModel plate_with_holes(int columns, int rows, double gap) {
  const double pitch = 20 + gap;
  TopoDS_Shape result =
      BRepPrimAPI_MakeBox({-30, -30, 0}, pitch * columns + 40, pitch * rows + 40, 5).Shape();
  for (int i = 0; i < columns * rows; ++i) {
    const int column = i % columns, row = i / columns;
    const gp_Ax2 axis({pitch * column, pitch * row, -1}, gp::DZ());
    result = BRepAlgoAPI_Cut(result, BRepPrimAPI_MakeCylinder(axis, 10, 7).Shape()).Shape();
  }
  return CadModel(std::make_shared<CadShape>(result, "plate_with_holes"));
}

TEST(Robustness, MakesRoomInGapsBeforeMeshing) {
  MeshOptions options;
  options.sizing.size = 6;
  options.sizing.short_edges = false;
  options.sizing.elements_per_circle = 0;
  for (const double gap : {0.3, 6.0}) {
    ExecutionContext context(1);
    const ShellMesh mesh = quadrille::mesh(plate_with_holes(2, 1, gap), options, context);
    EXPECT_EQ(joined(validate(mesh, true)), "") << gap;
    int narrow = 0;
    for (const auto& face : mesh.faces) {
      const bool is_told = face.note.find("is narrower near") != std::string::npos;
      narrow += is_told;
      EXPECT_LE(face.attempts, 1) << gap << " Face" << face.face;
    }
    EXPECT_EQ(narrow, gap < 1 ? 2 : 0) << gap;
  }
}

/// The number of quads in the plane z = 0 that a segment along x passes.
int quads_along_x(const ShellMesh& mesh, double from, double to, double y) {
  std::set<std::size_t> passed;
  constexpr int samples = 400;
  for (int k = 1; k < samples; ++k) {
    const Vector3 p(from + (to - from) * k / samples, y, 0);
    for (std::size_t i = 0; i < mesh.quads.size(); ++i) {
      int sign = 0;
      bool inside = true;
      for (int side = 0; side < 4; ++side) {
        const Vector3 &a = mesh.points[mesh.quads[i][side]], &b = mesh.points[mesh.quads[i][(side + 1) % 4]];
        const double turn = (b - a).cross(p - a).z();
        inside = inside && std::abs(a.z()) < 1e-6 && (sign == 0 || turn * sign > 0);
        sign = turn > 0 ? 1 : -1;
      }
      if (inside) passed.insert(i);
    }
  }
  return static_cast<int>(passed.size());
}

TEST(Robustness, GivesAtLeastTheElementsAskedForAcrossAGap) {
  const double gap = 2;
  MeshOptions options;
  options.sizing.size = 10;
  for (const int asked : {2, 3, 4, 5}) {
    options.sizing.proximity = asked;
    ExecutionContext context(1);
    const ShellMesh mesh = quadrille::mesh(plate_with_holes(2, 1, gap), options, context);
    EXPECT_GE(quads_along_x(mesh, 10, 10 + gap, 1e-3), asked);
    EXPECT_LE(quads_along_x(mesh, 10, 10 + gap, 1e-3), asked + 3);
  }
}

/// Between holes nodes face each other, and quads go from one hole to the next: at the first attempt, without
/// finer elements, and most of them within the limits.
TEST(Robustness, CrossesLigamentsInOneRow) {
  MeshOptions options;
  options.sizing.size = 20;
  for (const double gap : {0.5, 1.0, 1.1, 1.4, 2.0}) {
    ExecutionContext context(1);
    const ShellMesh mesh = quadrille::mesh(plate_with_holes(4, 3, gap), options, context);
    EXPECT_EQ(joined(validate(mesh, true)), "") << gap;
    for (const auto& face : mesh.faces) EXPECT_LE(face.attempts, 1) << gap << " Face" << face.face;
    EXPECT_LT(mesh.quads.size(), 2000u) << gap;
    const CriteriaSummary summary = check_criteria(mesh);
    EXPECT_LT(static_cast<std::size_t>(summary.failing), mesh.quads.size() / 10) << gap;
  }
}

/// Where pairing at the final size leaves quads turned over, or a triangle: on even edges then, cut in four.
TEST(Robustness, SubdividesFacesThatCannotBeMeshedDirectly) {
  MeshOptions options;
  options.strategy = Strategy::direct;
  int subdivided = 0;
  const auto count = [&](const CadModel& model, double divisions, bool closed) {
    options.sizing.elements_per_diagonal = divisions;
    ExecutionContext context(1);
    const ShellMesh result = mesh(model, options, context);
    EXPECT_EQ(joined(validate(result, closed)), "") << divisions;
    EXPECT_EQ(static_cast<int>(std::set<int>(result.quad_faces.begin(), result.quad_faces.end()).size()),
              model.face_count());
    for (const auto& face : result.faces) subdivided += face.note.find("by subdivision") != std::string::npos;
  };
  const CadModel ribs(std::make_shared<CadShape>(ribbed_plate(6), "ribbed_plate"));
  for (const double divisions : {3.1, 6.2, 9.5, 14.0}) count(ribs, divisions, true);
  EXPECT_GE(subdivided, 4);
  count(model_of(trouble_named("crack")), 6.2, false);
  EXPECT_GE(subdivided, 5);
}

TEST(Robustness, CountsTheQuadsInGapsBeforeMeshing) {
  MeshOptions options;
  options.sizing.size = 20;
  for (const double gap : {0.3, 1.0, 2.0, 6.0}) {
    ExecutionContext context(1);
    const CadModel plate = plate_with_holes(4, 3, gap);
    const auto quads = static_cast<double>(quadrille::mesh(plate, options, context).quads.size());
    const double estimate = QuadEstimate(plate, context).quads(options);
    // Twice as many where gaps are a sixtieth of the size: the margins of both sides of a gap overlap.
    EXPECT_LT(std::max(estimate / quads, quads / estimate), gap < 1 ? 2.2 : 1.5)
        << gap << ": " << estimate << ", " << quads;
  }
}

TEST(Robustness, MeshesPolesAtManySizes) {
  for (const char* name : {"lemon", "apex", "seam_and_poles", "collapsed_patch"}) {
    const CadModel model = model_of(trouble_named(name));
    for (int size = 0; size < 7; ++size) {
      const double divisions = 60 * std::pow(1.06, size);
      EXPECT_EQ(joined(validate(mesh_of(model, divisions), false)), "") << name << " " << divisions;
    }
  }
  EXPECT_EQ(joined(validate(mesh_of(model_of(trouble_named("lemon")), 77.33), false)), "");
}

TEST(Robustness, DeliversATinyFaceThatFails) {
  const CadModel model(std::make_shared<CadShape>(tiny_cusp(), "tiny_cusp"));
  const ShellMesh mesh = mesh_of(model, 20);
  EXPECT_EQ(joined(validate(mesh, false)), "");
  EXPECT_EQ(mesh.faces[0].status, FaceStatus::meshed);
  EXPECT_EQ(mesh.faces[1].status, FaceStatus::meshed);
  EXPECT_NEAR(mesh_area(mesh), 400, 1e-2);
}

TEST(Robustness, WritesNoMeshWithoutQuads) {
  const CadModel model(std::make_shared<CadShape>(tiny_cusp(), "tiny_cusp"));
  MeshOptions options;
  options.faces = {2};
  try {
    ExecutionContext context(1);
    mesh(model, options, context);
    FAIL() << "meshed";
  } catch (const Error& error) {
    EXPECT_EQ(error.subject(), "size_min");
  }
}

TEST(Robustness, MergesTinyFeaturesWhenAsked) {
  const CadModel model = model_of(trouble_named("sliver"));
  MeshOptions options;
  options.sizing.size = 5;
  options.keep_features = true;
  ExecutionContext context(1);
  const ShellMesh kept = mesh(model, options, context);
  EXPECT_EQ(kept.faces[1].status, FaceStatus::meshed);
  options.merge_tiny = 0.1;
  const ShellMesh merged = mesh(model, options, context);
  EXPECT_EQ(joined(validate(merged, false)), "");
  EXPECT_EQ(merged.faces[1].status, FaceStatus::merged);
  EXPECT_EQ(merged.faces[0].status, FaceStatus::meshed);
  EXPECT_EQ(merged.faces[2].status, FaceStatus::meshed);
  EXPECT_NEAR(mesh_area(merged) / 10000, 1, 1e-3);
  // The two rectangles hang together: their common side is no border.
  const auto segments_on = [&](int edge) {
    return std::count_if(merged.segments.begin(), merged.segments.end(),
                         [&](const auto& segment) { return segment.edge == edge; });
  };
  long border = 0;
  for (const int edge : {1, 2, 4, 8, 9, 10}) border += segments_on(edge);
  EXPECT_EQ(segments_on(3), segments_on(1));
  EXPECT_EQ(open_sides(merged), border);
  options.merge_tiny = 6;
  EXPECT_THROW(mesh(model, options, context), Error);
}

TEST(Robustness, SewsFacesThatTouch) {
  const CadModel apart = model_of(trouble_named("touching_faces"));
  MeshOptions options;
  options.sizing.size = 2;
  ExecutionContext context(1);
  EXPECT_EQ(open_sides(mesh(apart, options, context)), 2 * (10 + 10 + 20 + 20) / 2);
  const CadModel sewn = apart.sewn(0.01);
  EXPECT_EQ(sewn.face_count(), 2);
  EXPECT_EQ(sewn.edge_count(), apart.edge_count() - 1);
  const ShellMesh joined_mesh = mesh(sewn, options, context);
  EXPECT_EQ(joined(validate(joined_mesh, false)), "");
  EXPECT_EQ(open_sides(joined_mesh), 2 * (10 + 10 + 20) / 2);
  EXPECT_THROW(apart.sewn(0), Error);
  EXPECT_THROW(apart.sewn(1e6), Error);
}

TEST(Robustness, LetsNodesFaceEachOtherAcrossARimInParts) {
  const ShellMesh mesh = mesh_of(model_of(trouble_named("split_rim")), 20);
  const std::vector<double> q = quad_qualities(mesh);
  EXPECT_GT(*std::min_element(q.begin(), q.end()), 0.3);
}

TEST(Robustness, MeshesEveryLayerOfARolledSheetAsFinely) {
  const CadModel model = model_of(trouble_named("rolled_sheet"));
  const double size = model.diagonal() / 20;
  const ShellMesh mesh = mesh_of(model, 20);
  double longest = 0;
  for (const auto& quad : mesh.quads) {
    for (int k = 0; k < 4; ++k)
      longest = std::max(longest, (mesh.points[quad[(k + 1) % 4]] - mesh.points[quad[k]]).norm());
  }
  EXPECT_LT(longest, 4 * size);
}

TEST(Robustness, WarnsOfAreasThatFlatElementsDoNotExplain) {
  // Coarse, and of the right shape.
  for (const char* name : {"seam_and_poles", "rational_torus", "apex", "disc", "hole_across_seam"}) {
    const CadModel model = model_of(trouble_named(name));
    EXPECT_TRUE(area_differences(model, mesh_of(model, 8)).empty()) << name;
  }
  // Twice the area, by OpenCASCADE's integration.
  const CadModel model = model_of(trouble_named("false_poles"));
  EXPECT_EQ(area_differences(model, mesh_of(model, 20)).size(), 1u);
  // A fifth of the quads is missing.
  const CadModel sphere = model_of(trouble_named("seam_and_poles"));
  ShellMesh part = mesh_of(sphere, 20);
  part.quads.resize(part.quads.size() * 4 / 5);
  part.quad_faces.resize(part.quads.size());
  EXPECT_EQ(area_differences(sphere, part).size(), 1u);
  EXPECT_TRUE(area_differences(sphere, part, AreasChecked::planes).empty());
}

TEST(Robustness, ComparesCurvedAreasOnlyIfAsked) {
  const CadModel model = model_of(trouble_named("false_poles"));
  MeshOptions options;
  options.sizing.size = model.diagonal() / 20;
  ExecutionContext context(1);
  const auto warns = [&] {
    const auto warnings = mesh(model, options, context).warnings;
    return std::any_of(warnings.begin(), warnings.end(),
                       [](const std::string& warning) { return warning.find("area of") != warning.npos; });
  };
  EXPECT_TRUE(warns());
  options.check_curved_areas = false;
  EXPECT_FALSE(warns());
  // A wrong plane face is found all the same, and as certainly.
  const CadModel disc = model_of(trouble_named("disc"));
  ShellMesh part = mesh_of(disc, 20);
  part.quads.resize(part.quads.size() / 2);
  part.quad_faces.resize(part.quads.size());
  for (const AreasChecked checked : {AreasChecked::all, AreasChecked::planes}) {
    const auto found = area_differences(disc, part, checked);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_TRUE(found.front().is_certain);
  }
}

TEST(Robustness, KeepsTheNumbersOfEdgesThatAreSplit) {
  const TopoDS_Shape shape = trouble_named("no_seam").make();
  TopTools_IndexedMapOfShape edges;
  TopExp::MapShapes(shape, TopAbs_EDGE, edges);
  const CadModel model(std::make_shared<CadShape>(shape, "no_seam"));
  EXPECT_EQ(model.problems().size(), 1u);
  EXPECT_GT(model.edge_count(), edges.Extent());
  MeshOptions options;
  options.sizing.size = 3;
  options.sizing.edge_sizes[edges.Extent()] = 0.5;  // the rim that the new seam divides is the last one
  ExecutionContext context(1);
  const ShellMesh quads = mesh(model, options, context);
  double length = 0;
  int count = 0;
  for (const auto& segment : quads.segments) {
    if (segment.edge != edges.Extent()) continue;
    length += (quads.points[segment.nodes[1]] - quads.points[segment.nodes[0]]).norm();
    ++count;
  }
  GProp_GProps rim;
  BRepGProp::LinearProperties(edges(edges.Extent()), rim);
  EXPECT_NEAR(length / rim.Mass(), 1, 0.02);
  EXPECT_GE(count, 30);
  options.sizing.edge_sizes[edges.Extent()] = 1e-6;
  try {
    mesh(model, options, context);
    ADD_FAILURE() << "the segments are not refused";
  } catch (const Error& error) {
    EXPECT_EQ(std::string(error.what()).find("Edge" + std::to_string(edges.Extent()) + " of "), 0u);
  }
  // The shape that was given stays as it was.
  TopTools_IndexedMapOfShape after;
  TopExp::MapShapes(shape, TopAbs_EDGE, after);
  EXPECT_EQ(after.Extent(), edges.Extent());
  EXPECT_TRUE(lacks_seam(TopoDS::Face(TopExp_Explorer(shape, TopAbs_FACE).Current())));
}

TEST(Robustness, HasModelsForEveryClass) {
  EXPECT_GE(trouble_models().size(), 40u);
}

class Bytes : public testing::TestWithParam<std::tuple<Strategy, int>> {};

TEST_P(Bytes, DoNotDependOnThreads) {
  const auto [strategy, order] = GetParam();
  const test::TemporaryFolder folder;
  int compared = 0;
  for (const TroubleModel& trouble : trouble_models()) {
    const CadModel model = model_of(trouble);
    if (model.face_count() < 3) continue;
    SCOPED_TRACE(trouble.name);
    std::string first;
    for (const int threads : {1, 2, 8, 1}) {
      const auto path = folder / "mesh.msh";
      write_mesh(mesh_of(model, 25, strategy, threads, order), path);
      const std::string bytes = test::file_text(path);
      if (first.empty()) first = bytes;
      EXPECT_EQ(bytes == first, true) << threads << " threads";
    }
    ++compared;
  }
  EXPECT_GT(compared, 5);
}

INSTANTIATE_TEST_SUITE_P(Robustness, Bytes,
                         testing::Combine(testing::Values(Strategy::subdivide, Strategy::direct),
                                          testing::Values(1, 2)));

/// All of the work takes minutes, and looks at the time hundreds of thousands of times.
TEST(Robustness, TimeLimitEndsTheWorkInOneSentence) {
  const CadModel model = CadModel(std::make_shared<CadShape>(trouble_models().front().make(), "sphere"));
  MeshOptions options;
  options.sizing.elements_per_diagonal = 2000;
  ExecutionContext* running = nullptr;
  int calls_past = 0;
  ExecutionContext context(1, [&](std::string_view, double) {
    calls_past += running->seconds_left() < 0;
    return true;
  });
  running = &context;
  context.ask_every(std::chrono::milliseconds(0));
  context.limit_time(0.1);
  try {
    mesh(model, options, context);
    FAIL() << "not ended";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), Error::Kind::failure);
    EXPECT_EQ(error.subject(), "time_limit");
    EXPECT_EQ(std::string(error.what()), "the time limit of 0.1 s is reached");
  }
  EXPECT_LE(calls_past, 2);  // one report, and the look after it
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
