/// Middle surfaces of the thin models, measured against the solids, and refusals of what is not thin.

#include "geometry/midsurface/midsurface.hpp"

#include <gtest/gtest.h>

#include <BRepAdaptor_Curve.hxx>
#include <BRepAlgoAPI_Common.hxx>
#include <BRepAlgoAPI_Cut.hxx>
#include <BRepAlgoAPI_Fuse.hxx>
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakePolygon.hxx>
#include <BRepBuilderAPI_MakeVertex.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepBuilderAPI_NurbsConvert.hxx>
#include <BRepBuilderAPI_Transform.hxx>
#include <BRepExtrema_DistShapeShape.hxx>
#include <BRepFilletAPI_MakeFillet.hxx>
#include <BRepGProp.hxx>
#include <BRepOffsetAPI_MakeThickSolid.hxx>
#include <BRepOffsetAPI_ThruSections.hxx>
#include <BRepOffset_MakeOffset.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakePrism.hxx>
#include <BRepPrimAPI_MakeRevol.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <GProp_GProps.hxx>
#include <GeomAPI_PointsToBSpline.hxx>
#include <Geom_BSplineCurve.hxx>
#include <Geom_BSplineSurface.hxx>
#include <Geom_BezierCurve.hxx>
#include <IntCurvesFace_ShapeIntersector.hxx>
#include <ShapeUpgrade_UnifySameDomain.hxx>
#include <TColgp_Array1OfPnt.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopTools_ListOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Compound.hxx>
#include <algorithm>
#include <cmath>
#include <ctime>
#include <gp_Circ.hxx>
#include <gp_Elips.hxx>
#include <map>
#include <numeric>
#include <set>
#include <sstream>

#include <fmt/format.h>

#include "geometry/base/error.hpp"
#include "geometry/cad/cad_shape.hpp"
#include "mesher/mesh/skins.hpp"
#include "mesher/quadrille.hpp"
#include "tests/models/thin_models.hpp"

namespace quadrille {

void PrintTo(const ThinModel& model, std::ostream* stream) {
  *stream << model.name;
}
void PrintTo(const JoinedModel& model, std::ostream* stream) {
  *stream << model.name;
}

namespace {

CadModel model_of(const TopoDS_Shape& shape, const std::string& name = "part") {
  return CadModel(std::make_shared<CadShape>(shape, name));
}

MidSurface middle_of(const TopoDS_Shape& shape, bool partial = false, bool join = false) {
  ExecutionContext context;
  MidSurfaceOptions options;
  options.partial = partial;
  options.join = join;
  return midsurface(model_of(shape), options, context);
}

std::string brep_of(const MidSurface& middle) {
  std::ostringstream text;
  BRepTools::Write(middle.model.shape().shape, text);
  return text.str();
}

double area_of(const MidSurface& middle) {
  return std::accumulate(middle.faces.begin(), middle.faces.end(), 0.0,
                         [](double sum, const MiddleFace& face) { return sum + face.area; });
}

/// The sum is that of the faces, and what counts twice is told where it is more than a fiftieth. The only
/// other warnings are of fillets and narrow walls.
void expect_told(const MidSurface& middle) {
  double sum = 0;
  for (const MiddleFace& face : middle.faces) sum += face.area * face.thickness;
  EXPECT_NEAR(middle.shell_volume / sum, 1, 1e-12);
  int twice = 0;
  for (const std::string& warning : middle.warnings) {
    const bool told = warning.find("of the volume twice") != std::string::npos;
    const bool is_known = warning.find("fillets or welds") != std::string::npos ||
                          warning.find("times as wide as thick") != std::string::npos;
    EXPECT_TRUE(told || is_known) << warning;
    twice += told ? 1 : 0;
  }
  EXPECT_EQ(twice, middle.counted_twice > 0.02 * middle.volume ? 1 : 0)
      << middle.counted_twice / middle.volume;
}

/// Closed chains that the free edges form; chains that touch count as one.
int free_loops(const CadModel& model) {
  IdVector<VertexId, VertexId> chain;
  for (const VertexId vertex : model.shape().vertices.ids()) chain.push_back(vertex);
  std::set<VertexId> used;
  const auto end_of = [&](VertexId vertex) {
    while (chain[vertex] != vertex) vertex = chain[vertex];
    return vertex;
  };
  for (const CadEdge& edge : model.shape().edges) {
    if (edge.degenerate || edge.faces.size() != 1) continue;
    chain[end_of(edge.first_vertex)] = end_of(edge.last_vertex);
    used.insert({edge.first_vertex, edge.last_vertex});
  }
  std::set<VertexId> ends;
  for (const VertexId vertex : used) ends.insert(end_of(vertex));
  return static_cast<int>(ends.size());
}

class Thin : public testing::TestWithParam<ThinModel> {};

TEST_P(Thin, BecomesItsMiddleSurface) {
  const ThinModel& model = GetParam();
  const MidSurface middle = middle_of(model.make());
  EXPECT_TRUE(middle.problems.empty());
  expect_told(middle);
  EXPECT_EQ(middle.parts, 1);
  EXPECT_TRUE(middle.stray_edges.empty());
  EXPECT_NEAR(middle.shell_volume / middle.volume, 1, model.share_off);
  EXPECT_NEAR((middle.shell_volume - middle.counted_twice) / middle.volume, 1, 0.02);
  if (model.middle_area > 0) {
    EXPECT_NEAR(area_of(middle) / model.middle_area, 1, 1e-6);
  }
  EXPECT_EQ(free_loops(middle.model), model.free_loops);
  std::vector<double> thicknesses;
  for (const MiddleFace& face : middle.faces) {
    EXPECT_GE(face.solid_faces.size(), 2U);
    // Means of what varies depend a little on where it is sampled.
    const double steps = face.thickest > 1.01 * face.thinnest ? 10 : 100;
    thicknesses.push_back(std::round(steps * face.thickness) / steps);
  }
  std::sort(thicknesses.begin(), thicknesses.end());
  thicknesses.erase(std::unique(thicknesses.begin(), thicknesses.end()), thicknesses.end());
  EXPECT_EQ(thicknesses, model.thicknesses);
}

/// Without the inside, at which distances end.
TopoDS_Compound shells_of(const TopoDS_Shape& solid) {
  TopoDS_Compound result;
  const BRep_Builder builder;
  builder.MakeCompound(result);
  for (TopExp_Explorer it(solid, TopAbs_SHELL); it.More(); it.Next()) builder.Add(result, it.Current());
  return result;
}

/// How far a point is from the middle of the material: from the nearest point of the skin straight through
/// the point to the other side.
double off_the_middle(const gp_Pnt& point, const TopoDS_Shape& skin) {
  const BRepExtrema_DistShapeShape nearest(BRepBuilderAPI_MakeVertex(point).Vertex(), skin);
  IntCurvesFace_ShapeIntersector ray;
  ray.Load(skin, 1e-7);
  ray.PerformNearest(gp_Lin(point, gp_Dir(gp_Vec(nearest.PointOnShape2(1), point))), 0, 1e3);
  if (!ray.IsDone() || ray.NbPnt() == 0) return nearest.Value();
  return 0.5 * (ray.WParameter(1) - nearest.Value());
}

// Measured without what made the surface: the mesh's nodes against the solid's skin.
TEST_P(Thin, LiesInTheMiddleAndCanBeMeshed) {
  const TopoDS_Shape solid = GetParam().make();
  const MidSurface middle = middle_of(solid);
  MeshOptions options;
  options.sizing.elements_per_diagonal = 25;
  ExecutionContext context;
  const ShellMesh result = mesh(middle.model, options, context);
  EXPECT_FALSE(result.quads.empty());
  const TopoDS_Shape skin = shells_of(solid);
  std::vector<bool> on_edge(result.points.size());
  for (const ShellMesh::Segment& segment : result.segments)
    on_edge[segment.nodes[0]] = on_edge[segment.nodes[1]] = true;
  int on_middle = 0, asked = 0;
  const std::size_t stride = std::max<std::size_t>(1, result.quads.size() / 200);
  for (std::size_t i = 0; i < result.quads.size(); i += stride) {
    const MiddleFace& face = middle.faces[result.quad_faces[i] - 1];
    if (face.step || on_edge[result.quads[i][0]]) continue;
    const Vector3& node = result.points[result.quads[i][0]];
    const double off = off_the_middle(gp_Pnt(node.x(), node.y(), node.z()), skin);
    ++asked;
    // Further off only where another wall stands on this one.
    if (std::abs(off) < (face.fitted ? 0.05 : 0.01) * face.thickness) ++on_middle;
  }
  EXPECT_GE(on_middle, 0.88 * asked);
}

INSTANTIATE_TEST_SUITE_P(Models, Thin, testing::ValuesIn(thin_models()),
                         [](const auto& test) { return test.param.name; });

TEST(MidSurface, RefusesABlock) {
  try {
    middle_of(thick_block(), true);
    FAIL() << "a block is not thin";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), Error::Kind::failure);
    EXPECT_NE(std::string(error.what()).find("not a thin solid"), std::string::npos);
  }
}

/// One solid that is not thin does not spoil the others.
TEST(MidSurface, NamesTheSolidThatIsNotThin) {
  TopoDS_Compound both;
  const BRep_Builder builder;
  builder.MakeCompound(both);
  builder.Add(both, BRepPrimAPI_MakeBox(200, 150, 3).Shape());
  builder.Add(both, BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(50, 50, 10), gp::DZ()), 5, 30).Shape());
  for (const bool partial : {false, true}) {
    const MidSurface middle = middle_of(both, partial);
    EXPECT_TRUE(middle.problems.empty());
    EXPECT_EQ(middle.solids, 1);
    ASSERT_EQ(middle.faces.size(), 1U);
    EXPECT_EQ(middle.faces[0].solid_faces, (std::vector<int>{5, 6}));
    EXPECT_NEAR(middle.volume, 200 * 150 * 3, 1e-3);
    ASSERT_EQ(middle.warnings.size(), 1U);
    EXPECT_NE(middle.warnings[0].find("solid 2 (Face7, Face8, Face9) is not a thin solid"), std::string::npos)
        << middle.warnings[0];
  }
}

TEST(MidSurface, NamesTheFacesWithoutAPartner) {
  try {
    middle_of(plate_on_block());
    FAIL() << "the block under the plate is not thin";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("without a partner: Face"), std::string::npos);
  }
  const MidSurface middle = middle_of(plate_on_block(), true);
  EXPECT_EQ(middle.problems.size(), 1U);
  ASSERT_EQ(middle.faces.size(), 1U);
  EXPECT_NEAR(middle.faces[0].thickness, 3, 1e-9);
  EXPECT_GE(middle.unpaired.size(), 4U);
}

TEST(MidSurface, NamesWhatIsThick) {
  try {
    middle_of(plate_on_block(24));
    FAIL() << "the block under the plate is not thin";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("are farther apart than 0.2 times their width"),
              std::string::npos);
  }
  const MidSurface middle = middle_of(plate_on_block(24), true);
  ASSERT_EQ(middle.faces.size(), 1U);
  EXPECT_NEAR(middle.faces[0].thickness, 3, 1e-9);
  EXPECT_NE(middle.problems.front().find("thin only in places"), std::string::npos);
}

TEST(MidSurface, TellsTheRangeOfAThicknessThatVaries) {
  for (const ThinModel& model : thin_models()) {
    if (model.name != "tapering_web") continue;
    const MidSurface middle = middle_of(model.make());
    EXPECT_NEAR(middle.faces[0].thinnest, 2, 1e-2);
    EXPECT_NEAR(middle.faces[0].thickest, 4, 1e-2);
  }
}

/// The thin model of that name.
TopoDS_Shape thin_model(const std::string& name) {
  for (const ThinModel& model : thin_models()) {
    if (model.name == name) return model.make();
  }
  throw std::invalid_argument(name);
}

/// A rib that thickens toward the lid does not go on below its rim inside the walls that it runs into.
TEST(MidSurface, EndsDraftedRibsAtTheirRims) {
  int ribs = 0;
  for (const MiddleFace& face : middle_of(thin_model("housing")).faces) {
    if (!varies(face) || face.fitted) continue;
    ++ribs;
    EXPECT_NEAR(face.thinnest, 1.2, 1e-3);
  }
  EXPECT_EQ(ribs, 3);
}

TEST(MidSurface, TellsTheThicknessAtEachNodeWhereItVaries) {
  const TopoDS_Shape solid = thin_model("tapering_web");
  const TopoDS_Shape skin = shells_of(solid);
  const MidSurface middle = middle_of(solid);
  MeshOptions options;
  options.sizing.size = 10;
  options.order = 2;
  ExecutionContext context;
  const ShellMesh result = mesh(middle, options, context);
  ASSERT_EQ(result.varying_thicknesses.size(), 1U);
  const ShellMesh::VaryingThickness& varying = result.varying_thicknesses[0];
  EXPECT_EQ(varying.nodes.size(), result.points.size());
  ASSERT_EQ(varying.thicknesses.size(), varying.nodes.size());
  // Of the wall's two sides, which are at an angle, the point half way has feet on both.
  const double lean = std::cos(0.5 * std::atan(0.02));
  for (std::size_t i = 0; i < varying.nodes.size(); ++i) {
    const Vector3& node = result.points[varying.nodes[i]];
    if (node.x() < 5 || node.x() > 95 || node.z() < 5 || node.z() > 55) continue;  // rims are nearer
    const gp_Pnt point(node.x(), node.y(), node.z());
    const BRepExtrema_DistShapeShape nearest(BRepBuilderAPI_MakeVertex(point).Vertex(), skin);
    EXPECT_NEAR(varying.thicknesses[i], 2 * lean * nearest.Value(), 1e-6);
  }
  EXPECT_TRUE(mesh(middle_of(thin_model("i_beam")), options, context).varying_thicknesses.empty());
}

TEST(MidSurface, JoinsSolidsThatTouchWhereThatIsWanted) {
  const TopoDS_Shape frame = welded_frame();
  const MidSurface apart = middle_of(frame);
  EXPECT_EQ(apart.solids, 3);
  EXPECT_EQ(apart.parts, 3);
  const MidSurface joined = middle_of(frame, false, true);
  EXPECT_TRUE(joined.problems.empty());
  EXPECT_EQ(joined.solids, 1);
  EXPECT_EQ(joined.parts, 1);
  // The beam ends at the middle of the columns' walls.
  EXPECT_NEAR(area_of(joined), 2 * 4 * 37 * 200 + 4 * 28 * 163, 1e-3);
  EXPECT_NEAR(joined.shell_volume / joined.volume, 1, 0.02);
  const int solid_faces = model_of(frame).face_count();
  for (const MiddleFace& face : joined.faces) {
    EXPECT_NEAR(face.thickness, face.thickness > 2.5 ? 3 : 2, 1e-9);
    EXPECT_GE(face.solid_faces.size(), 2U);
    EXPECT_GE(face.solid_faces.front(), 1);
    EXPECT_LE(face.solid_faces.back(), solid_faces);
  }
  MeshOptions options;
  options.sizing.size = 10;
  ExecutionContext context;
  const ShellMesh result = mesh(joined, options, context);
  EXPECT_TRUE(validate(result).empty());
}

class Joined : public testing::TestWithParam<JoinedModel> {};

TEST_P(Joined, IsOnePart) {
  const TopoDS_Shape shape = GetParam().make();
  EXPECT_EQ(middle_of(shape).solids, GetParam().solids);
  const MidSurface middle = middle_of(shape, false, true);
  EXPECT_TRUE(middle.problems.empty());
  EXPECT_EQ(middle.solids, 1);
  EXPECT_EQ(middle.parts, 1);
  EXPECT_TRUE(middle.stray_edges.empty());
  EXPECT_TRUE(middle.unpaired.empty());
  EXPECT_NEAR(middle.shell_volume / middle.volume, 1, 0.035);
  if (GetParam().middle_area > 0) {
    EXPECT_NEAR(area_of(middle), GetParam().middle_area, 1e-6 * GetParam().middle_area);
  }
  std::set<double> thicknesses;
  const int solid_faces = model_of(shape).face_count();
  for (const MiddleFace& face : middle.faces) {
    thicknesses.insert(std::round(100 * face.thickness) / 100);
    EXPECT_GE(face.solid_faces.size(), 2U);
    EXPECT_GE(face.solid_faces.front(), 1);
    EXPECT_LE(face.solid_faces.back(), solid_faces);
  }
  EXPECT_EQ(std::vector<double>(thicknesses.begin(), thicknesses.end()), GetParam().thicknesses);
  MeshOptions options;
  options.sizing.elements_per_diagonal = 25;
  ExecutionContext context;
  const ShellMesh result = mesh(middle.model, options, context);
  EXPECT_TRUE(validate(result).empty());
}

INSTANTIATE_TEST_SUITE_P(Models, Joined, testing::ValuesIn(joined_models()),
                         [](const auto& test) { return test.param.name; });

/// The beam's wall is 2 mm thick: wider gaps stay.
TEST(MidSurface, LeavesWideGaps) {
  const MidSurface middle = middle_of(welded_frame(2.1), false, true);
  EXPECT_TRUE(middle.problems.empty());
  EXPECT_EQ(middle.solids, 3);
  EXPECT_EQ(middle.parts, 3);
}

/// What closes a gap has the names of the faces that it carries on.
TEST(MidSurface, NamesTheFacesOfSolidsJoinedOverGaps) {
  const auto faces_of = [](double gap) {
    std::vector<std::pair<double, std::vector<int>>> result;
    for (const MiddleFace& face : middle_of(welded_frame(gap), false, true).faces)
      result.emplace_back(std::round(10 * face.area), face.solid_faces);
    std::sort(result.begin(), result.end());
    return result;
  };
  EXPECT_EQ(faces_of(1), faces_of(0));
}

/// What is turned round an axis is a torus and the like to the program: faces keep their numbers, and have
/// exact middles.
TEST(MidSurface, KnowsTurnedFaces) {
  const TopoDS_Shape solid = thin_model("beaded_disc");
  const CadModel model = model_of(solid);
  TopTools_IndexedMapOfShape solid_faces, middle_faces;
  TopExp::MapShapes(model.shape().shape, TopAbs_FACE, solid_faces);
  const MidSurface middle = middle_of(solid);
  TopExp::MapShapes(middle.model.shape().shape, TopAbs_FACE, middle_faces);
  ASSERT_EQ(middle_faces.Extent(), static_cast<int>(middle.faces.size()));
  for (int i = 1; i <= middle_faces.Extent(); ++i) {
    EXPECT_FALSE(middle.faces[i - 1].fitted);
    EXPECT_EQ(middle.faces[i - 1].solid_faces.size(), 2U);
    for (const int face : middle.faces[i - 1].solid_faces) {
      const BRepExtrema_DistShapeShape apart(middle_faces(i), solid_faces(face));
      EXPECT_NEAR(apart.Value(), 0.5 * middle.faces[i - 1].thickness, 1e-3);
    }
  }
}

TEST(MidSurface, TellsHowFarItIs) {
  std::vector<double> told;
  ExecutionContext context(1, [&](std::string_view stage, double fraction) {
    EXPECT_EQ(stage, "midsurface");
    told.push_back(fraction);
    return true;
  });
  context.expect({Stage::midsurface});
  midsurface(model_of(welded_frame()), {}, context);
  EXPECT_TRUE(std::is_sorted(told.begin(), told.end()));
  EXPECT_GT(std::set<double>(told.begin(), told.end()).size(), 9U);  // some in each of three solids
  EXPECT_GT(told.back(), 0.9);
}

TEST(MidSurface, TellsWhichFacesOfTheSolidFreeEdgesLieOn) {
  const TopoDS_Shape solid = thin_model("i_beam");
  const MidSurface middle = middle_of(solid);
  // Five edges at each end of the beam, and the four long ones of the flanges.
  EXPECT_EQ(static_cast<int>(middle.rims.size()), middle.free_edges);
  std::map<int, int> edges_on;
  for (const MiddleRim& rim : middle.rims) {
    ASSERT_EQ(rim.solid_faces.size(), 1U);
    ++edges_on[rim.solid_faces[0]];
  }
  std::vector<int> counts;
  counts.reserve(edges_on.size());
  for (const auto& [face, count] : edges_on) counts.push_back(count);
  std::sort(counts.begin(), counts.end());
  EXPECT_EQ(counts, (std::vector<int>{1, 1, 1, 1, 5, 5}));
}

TEST(MidSurface, TellsWhatIsFittedAndHowFarItIsOff) {
  int fitted = 0;
  for (const ThinModel& model : thin_models()) {
    if (model.name != "loose_bend") continue;
    for (const MiddleFace& face : middle_of(model.make()).faces) {
      fitted += face.fitted ? 1 : 0;
      EXPECT_EQ(face.off > 0, face.fitted);
      EXPECT_LT(face.off, 2e-3 * face.thickness);
    }
    // Drawn along a line: of one span that way, and of one beyond either end.
    for (TopExp_Explorer it(middle_of(model.make()).model.shape().shape, TopAbs_FACE); it.More(); it.Next()) {
      const auto spline =
          Handle(Geom_BSplineSurface)::DownCast(BRep_Tool::Surface(TopoDS::Face(it.Current())));
      if (!spline.IsNull()) {
        EXPECT_LE(std::min(spline->NbUKnots(), spline->NbVKnots()), 4);
      }
    }
  }
  EXPECT_EQ(fitted, 1);
}

TEST(MidSurface, NamesTheWallsThatCannotBeFittedWellEnough) {
  MidSurfaceOptions options;
  options.tolerance = 1e-7;  // the sides have kinks
  ExecutionContext context;
  const CadModel model = model_of(thin_model("loose_bend"));
  try {
    midsurface(model, options, context);
    FAIL() << "its bend is off by more";
  } catch (const Error& error) {
    const std::string sentence = error.what();
    EXPECT_NE(sentence.find("part: the middle between Face"), std::string::npos) << sentence;
    EXPECT_NE(sentence.find("more than 0.0001 % of the thickness"), std::string::npos) << sentence;
  }
  options.partial = true;
  EXPECT_EQ(midsurface(model, options, context).problems.size(), 1U);
}

/// Where thick walls cross, area times thickness exceeds the volume, though nothing is missing.
TEST(MidSurface, TellsWhereWallsOverlapTooMuch) {
  MidSurfaceOptions options;
  options.thickest = 1;
  ExecutionContext context;
  const std::vector<Corner2d> cross = {{-3, -10}, {3, -10}, {3, -3}, {10, -3}, {10, 3},   {3, 3},
                                       {3, 10},   {-3, 10}, {-3, 3}, {-10, 3}, {-10, -3}, {-3, -3}};
  try {
    midsurface(model_of(profile({cross}, 100)), options, context);
    FAIL() << "it is 117.6 % of the volume";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("part has walls that overlap too much"), std::string::npos)
        << error.what();
  }
}

/// Sewing keeps solids, the same one at two places too.
TEST(MidSurface, OfSewnSolids) {
  const TopoDS_Shape sheet = thin_model("l_section");
  gp_Trsf aside;
  aside.SetTranslation(gp_Vec(200, 0, 0));
  TopoDS_Compound both;
  const BRep_Builder builder;
  builder.MakeCompound(both);
  builder.Add(both, sheet);
  builder.Add(both, sheet.Moved(TopLoc_Location(aside)));
  const CadModel model = model_of(both), sewn = model.sewn(1e-3);
  EXPECT_EQ(sewn.edge_count(), model.edge_count());
  ExecutionContext context;
  const MidSurface before = midsurface(model, {}, context), after = midsurface(sewn, {}, context);
  EXPECT_EQ(after.solids, 2);
  EXPECT_NEAR(after.volume, before.volume, 1e-6);
  ASSERT_EQ(after.faces.size(), before.faces.size());
  for (std::size_t i = 0; i < after.faces.size(); ++i) {
    EXPECT_EQ(after.faces[i].solid_faces, before.faces[i].solid_faces);
    EXPECT_NEAR(after.faces[i].area, before.faces[i].area, 1e-6);
  }
}

/// A tray with rounded edges, all of whose faces are B-splines: its bends are fitted, and edges of walls that
/// should be shared may lie beside each other. Either they are, or that is told.
TEST(MidSurface, NeverTakesEdgesBesideEachOtherForShared) {
  const TopoDS_Shape block = BRepPrimAPI_MakeBox(100, 60, 30).Shape();
  BRepFilletAPI_MakeFillet fillet(block);
  for (TopExp_Explorer it(block, TopAbs_EDGE); it.More(); it.Next()) {
    const BRepAdaptor_Curve curve(TopoDS::Edge(it.Current()));
    const double low =
        std::min(curve.Value(curve.FirstParameter()).Z(), curve.Value(curve.LastParameter()).Z());
    if (low < 29) fillet.Add(6, TopoDS::Edge(it.Current()));
  }
  TopTools_ListOfShape open;
  for (TopExp_Explorer it(fillet.Shape(), TopAbs_FACE); it.More(); it.Next()) {
    GProp_GProps properties;
    BRepGProp::SurfaceProperties(it.Current(), properties);
    if (properties.CentreOfMass().Z() > 29.9) open.Append(it.Current());
  }
  ASSERT_EQ(open.Extent(), 1);
  BRepOffsetAPI_MakeThickSolid tray;
  tray.MakeThickSolidByJoin(fillet.Shape(), open, -2, 1e-3);
  const TopoDS_Shape splines = BRepBuilderAPI_NurbsConvert(tray.Shape(), Standard_True).Shape();
  try {
    const MidSurface middle = middle_of(splines);
    EXPECT_EQ(free_loops(middle.model), 1);
    EXPECT_NEAR(middle.shell_volume / middle.volume, 1, 0.01);
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("end inside the material"), std::string::npos) << error.what();
  }
}

/// Of a shell between spheres, cut by a plane, wherever the spheres' seams and poles are.
TEST(MidSurface, OfSphericalCaps) {
  const double outer = 30, inner = 28, height = 12, middle_radius = 29;
  for (const gp_Dir& up :
       {gp_Dir(1, 0, 0), gp_Dir(-1, 0, 0), gp_Dir(0, 0, 1), gp_Dir(1, 1, 1), gp_Dir(1, 0.1, 0.4)}) {
    const gp_Ax2 seam(gp_Pnt(0, 0, 0), gp::DZ());
    const TopoDS_Shape shell = BRepAlgoAPI_Cut(BRepPrimAPI_MakeSphere(seam, outer).Shape(),
                                               BRepPrimAPI_MakeSphere(seam, inner).Shape())
                                   .Shape();
    const gp_Ax2 above(gp_Pnt(height * gp_Vec(up).XYZ()), up);
    const TopoDS_Shape tool = BRepPrimAPI_MakeCylinder(above, 50, 50).Shape();
    SCOPED_TRACE(up.X() + 10 * up.Y() + 100 * up.Z());
    const MidSurface middle = middle_of(BRepAlgoAPI_Common(shell, tool).Shape(), true);
    EXPECT_TRUE(middle.problems.empty());
    EXPECT_EQ(middle.faces.size(), 1U);
    EXPECT_NEAR(area_of(middle), 2 * M_PI * middle_radius * (middle_radius - height), 1e-3);
  }
}

/// Whether a wall is thin is asked of each of its pieces: together, many short ones would seem narrow.
TEST(MidSurface, OfACorrugatedSheet) {
  constexpr int waves = 8;
  constexpr double wide = 30, high = 15, thick = 3;
  std::vector<Corner2d> below, above;
  for (int i = 0; i < 2 * waves; ++i) {
    const double base = i % 2 == 0 ? 0 : high, x = i * wide;
    below.push_back({x, base});
    below.push_back({x + wide, base});
    above.push_back({x, base + thick});
    above.push_back({x + wide, base + thick});
  }
  // The risers of the upper side stand beside those of the lower one, by the thickness.
  for (int i = 0; i + 1 < 2 * waves; ++i) {
    const bool rises = i % 2 == 0;
    above[2 * i + 1].x += rises ? -thick : 0;
    above[2 * i + 2].x += rises ? -thick : 0;
    below[2 * i + 1].x += rises ? 0 : -thick;
    below[2 * i + 2].x += rises ? 0 : -thick;
  }
  below.insert(below.end(), above.rbegin(), above.rend());
  const MidSurface middle = middle_of(profile({below}, 20));
  EXPECT_TRUE(middle.problems.empty());
  EXPECT_EQ(middle.faces.size(), 4U * waves - 1);
}

/// Expects one connected part without problems, whose area times thickness is the volume.
void expect_right(const MidSurface& middle) {
  EXPECT_TRUE(middle.problems.empty());
  expect_told(middle);
  EXPECT_TRUE(middle.stray_edges.empty());
  EXPECT_EQ(middle.parts, middle.solids);
  EXPECT_NEAR((middle.shell_volume - middle.counted_twice) / middle.volume, 1, 0.01);
}

/// A tube from a rounded square to a smaller one, between whose flat parts and corners there is no edge in
/// the surface: eight free-form walls.
TopoDS_Shape transition_duct(double thickness) {
  const auto loft = [](double low, double high) {
    BRepOffsetAPI_ThruSections result(Standard_True, Standard_False, 1e-6);
    for (const double z : {0.0, 40.0, 100.0}) {
      const double half = z == 0 ? low : high, bulge = z == 40 ? 3 : 0, corner = 10;
      BRepBuilderAPI_MakeWire wire;
      for (int i = 0; i < 4; ++i) {
        gp_Trsf turn;
        turn.SetRotation(gp::OZ(), 0.5 * M_PI * i);
        const auto at = [&](double x, double y) { return gp_Pnt(x, y, z).Transformed(turn); };
        const double r = half + bulge, flat = half - corner;
        TColgp_Array1OfPnt side(1, 4), round(1, 4);
        // Tangents along the flat part end those of the corner.
        side(1) = at(-flat, -r);
        side(2) = at(-flat / 3, -r);
        side(3) = at(flat / 3, -r);
        side(4) = at(flat, -r);
        round(1) = at(flat, -r);
        round(2) = at(flat + 0.6 * (r - flat), -r);
        round(3) = at(r, -flat - 0.6 * (r - flat));
        round(4) = at(r, -flat);
        wire.Add(BRepBuilderAPI_MakeEdge(new Geom_BezierCurve(side)).Edge());
        wire.Add(BRepBuilderAPI_MakeEdge(new Geom_BezierCurve(round)).Edge());
      }
      result.AddWire(wire.Wire());
    }
    result.Build();
    return result.Shape();
  };
  return BRepAlgoAPI_Cut(loft(40, 30), loft(40 - thickness, 30 - thickness)).Shape();
}

/// Walls that go on into each other are joined, whatever their number.
TEST(MidSurface, JoinsTheFreeFormWallsOfADuct) {
  const TopoDS_Shape duct = transition_duct(2);
  const MidSurface middle = middle_of(duct);
  expect_right(middle);
  EXPECT_EQ(middle.faces.size(), 8U);
  EXPECT_EQ(free_loops(middle.model), 2);
}

/// A tube from a square to a circle: four ruled walls whose corners fade away.
TopoDS_Shape square_to_round(double thickness) {
  const auto loft = [](double half, double radius) {
    BRepBuilderAPI_MakeWire square, round;
    for (int i = 0; i < 4; ++i) {
      gp_Trsf turn;
      turn.SetRotation(gp::OZ(), 0.5 * M_PI * i);
      const auto at = [&](double x, double y, double z) { return gp_Pnt(x, y, z).Transformed(turn); };
      square.Add(BRepBuilderAPI_MakeEdge(at(-half, -half, 0), at(half, -half, 0)).Edge());
      const gp_Circ circle(gp_Ax2(gp_Pnt(0, 0, 75), gp::DZ()), radius);
      const double c = radius * std::sqrt(0.5);
      round.Add(BRepBuilderAPI_MakeEdge(circle, at(-c, -c, 75), at(c, -c, 75)).Edge());
    }
    BRepOffsetAPI_ThruSections result(Standard_True, Standard_True, 1e-6);
    result.CheckCompatibility(Standard_False);
    result.AddWire(square.Wire());
    result.AddWire(round.Wire());
    return result.Shape();
  };
  return BRepAlgoAPI_Cut(loft(40, 25), loft(40 - thickness, 25 - thickness)).Shape();
}

/// Up to the corner between two walls each middle goes on straight: no kink there asks for a finer fit.
TEST(MidSurface, FitsFreeFormWallsUpToTheirCorners) {
  const MidSurface middle = middle_of(square_to_round(1));
  expect_right(middle);
  ASSERT_EQ(middle.faces.size(), 4U);
  EXPECT_EQ(free_loops(middle.model), 2);
  for (const MiddleFace& face : middle.faces) EXPECT_LT(face.off, 1e-3 * face.thickness);
}

/// A square tube along z, closed at the bottom by what it stands on.
TopoDS_Shape standing_on(const TopoDS_Shape& below, double top) {
  const TopoDS_Shape outside = BRepPrimAPI_MakeBox(gp_Pnt(80, -20, top), gp_Pnt(120, 20, top + 100)).Shape();
  const TopoDS_Shape inside = BRepPrimAPI_MakeBox(gp_Pnt(83, -17, top), gp_Pnt(117, 17, top + 100)).Shape();
  return BRepAlgoAPI_Fuse(below, BRepAlgoAPI_Cut(outside, inside).Shape()).Shape();
}

/// A shell has no depth where a tube stands on another one; on a plate the solid has none either.
TEST(MidSurface, TellsWhereHollowSectionsMeet) {
  const auto told = [](const MidSurface& middle) {
    std::vector<std::string> result;
    for (const std::string& warning : middle.warnings)
      if (warning.find("hollow sections") != std::string::npos) result.push_back(warning);
    return result;
  };
  const TopoDS_Shape tube =
      BRepAlgoAPI_Cut(BRepPrimAPI_MakeBox(gp_Pnt(0, -30, -60), gp_Pnt(200, 30, 0)).Shape(),
                      BRepPrimAPI_MakeBox(gp_Pnt(0, -26, -56), gp_Pnt(200, 26, -4)).Shape())
          .Shape();
  const MidSurface tee = middle_of(standing_on(tube, 0));
  const auto warnings = told(tee);
  ASSERT_EQ(warnings.size(), 1U);
  const auto closed_off = std::find_if(tee.faces.begin(), tee.faces.end(), [](const MiddleFace& face) {
    return std::abs(face.area - 37 * 37) < 1e-3;
  });
  ASSERT_NE(closed_off, tee.faces.end());
  const std::string name = fmt::format("Face{}:", closed_off - tee.faces.begin() + 1);
  EXPECT_NE(warnings[0].find(name), std::string::npos) << warnings[0];
  const TopoDS_Shape plate = BRepPrimAPI_MakeBox(gp_Pnt(0, -60, -4), gp_Pnt(200, 60, 0)).Shape();
  EXPECT_TRUE(told(middle_of(standing_on(plate, 0))).empty());
}

/// A head around z between two profiles from the plane z = 0 to the axis.
TopoDS_Shape head(const TopoDS_Edge& outer, const TopoDS_Edge& inner) {
  const auto point = [](const TopoDS_Edge& edge, bool last) {
    const BRepAdaptor_Curve curve(edge);
    return curve.Value(last ? curve.LastParameter() : curve.FirstParameter());
  };
  BRepBuilderAPI_MakeWire wire(outer);
  wire.Add(BRepBuilderAPI_MakeEdge(point(outer, true), point(inner, true)).Edge());
  wire.Add(inner);
  wire.Add(BRepBuilderAPI_MakeEdge(point(inner, false), point(outer, false)).Edge());
  return BRepPrimAPI_MakeRevol(BRepBuilderAPI_MakeFace(wire.Wire()).Face(), gp::OZ()).Shape();
}

/// The middle of two profiles around an axis is a profile around it, up to the pole.
TEST(MidSurface, ReachesTheAxisOfWallsOfRevolution) {
  const auto ellipse = [](double radius, double height) {
    const gp_Elips arc(gp_Ax2(gp::Origin(), gp_Dir(0, -1, 0), gp::DX()), radius, height);
    return BRepBuilderAPI_MakeEdge(arc, 0, 0.5 * M_PI).Edge();
  };
  const auto free_form = [](double radius, double height) {
    TColgp_Array1OfPnt poles(1, 4);
    poles(1) = gp_Pnt(radius, 0, 0);
    poles(2) = gp_Pnt(radius, 0, 0.7 * height);
    poles(3) = gp_Pnt(0.6 * radius, 0, height);
    poles(4) = gp_Pnt(0, 0, height);
    return BRepBuilderAPI_MakeEdge(new Geom_BezierCurve(poles)).Edge();
  };
  for (const TopoDS_Shape& solid :
       {head(ellipse(102, 52), ellipse(100, 50)), head(free_form(102, 52), free_form(100, 50))}) {
    const MidSurface middle = middle_of(solid);
    expect_right(middle);
    ASSERT_EQ(middle.faces.size(), 1U);
    EXPECT_EQ(free_loops(middle.model), 1);
    EXPECT_LT(middle.faces[0].off, 1e-3 * middle.faces[0].thickness);
    const TopoDS_Shape pole = BRepBuilderAPI_MakeVertex(gp_Pnt(0, 0, 51)).Vertex();
    EXPECT_LT(BRepExtrema_DistShapeShape(pole, middle.model.shape().shape).Value(), 1e-5);
  }
}

TEST(MidSurface, NamesTheFreeFormWallsThatItCannotJoin) {
  try {
    middle_of(blended_housing());
    FAIL() << "its bends are of free form, and go on into each other";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("8 free-form walls continue into each other"), std::string::npos)
        << error.what();
    EXPECT_NE(std::string(error.what()).find(": Face1, "), std::string::npos) << error.what();
  }
  const MidSurface middle = middle_of(blended_housing(), true);
  EXPECT_EQ(middle.faces.size(), 9U);  // the flat sides, the lid, and four walls in a chain
  ASSERT_FALSE(middle.problems.empty());
  EXPECT_NE(middle.problems[0].find("free-form walls"), std::string::npos);
}

/// A sheet of 5 mm with a pocket whose floor leans. \param low, high heights of the floor at its ends.
TopoDS_Shape leaning_pocket(double low, double high) {
  BRepBuilderAPI_MakePolygon section(gp_Pnt(20, 20, low), gp_Pnt(140, 20, high), gp_Pnt(140, 20, 9),
                                     gp_Pnt(20, 20, 9), Standard_True);
  const TopoDS_Shape pocket =
      BRepPrimAPI_MakePrism(BRepBuilderAPI_MakeFace(section.Wire()).Face(), gp_Vec(0, 60, 0)).Shape();
  return BRepAlgoAPI_Cut(BRepPrimAPI_MakeBox(160, 100, 5).Shape(), pocket).Shape();
}

/// A plate with a rib in its middle that ends free, rounded at its two long sides only.
TopoDS_Shape rib_rounded_at_its_sides() {
  const TopoDS_Shape sharp = BRepAlgoAPI_Fuse(BRepPrimAPI_MakeBox(100, 60, 3).Shape(),
                                              BRepPrimAPI_MakeBox(gp_Pnt(30, 28.5, 0), 40, 3, 18).Shape())
                                 .Shape();
  BRepFilletAPI_MakeFillet fillet(sharp);
  TopTools_IndexedMapOfShape edges;
  TopExp::MapShapes(sharp, TopAbs_EDGE, edges);
  for (int i = 1; i <= edges.Extent(); ++i) {
    const BRepAdaptor_Curve curve(TopoDS::Edge(edges(i)));
    const gp_Pnt from = curve.Value(curve.FirstParameter()), to = curve.Value(curve.LastParameter());
    const bool foot = std::abs(from.Z() - 3) + std::abs(to.Z() - 3) < 1e-6;
    if (foot && std::abs(std::abs(from.X() - to.X()) - 40) < 1e-6) fillet.Add(1, TopoDS::Edge(edges(i)));
  }
  return fillet.Shape();
}

/// A plate with two ribs that cross at 20 degrees.
TopoDS_Shape ribs_at_an_acute_angle() {
  TopoDS_Shape result = BRepPrimAPI_MakeBox(gp_Pnt(-60, -40, 0), 120, 80, 3).Shape();
  for (const double degrees : {-10.0, 10.0}) {
    gp_Trsf turn;
    turn.SetRotation(gp::OZ(), degrees * M_PI / 180);
    const TopoDS_Shape rib = BRepPrimAPI_MakeBox(gp_Pnt(-45, -1.5, 0), 90, 3, 20).Shape();
    result = BRepAlgoAPI_Fuse(result, BRepBuilderAPI_Transform(rib, turn).Shape()).Shape();
  }
  return result;
}

/// A T-beam whose web is welded to its flange. \param weld width of either weld, which is flat.
TopoDS_Shape welded_tee(double weld) {
  const std::vector<Corner2d> outline = {{-60, 0}, {60, 0},  {60, 10},        {3 + weld, 10},  {3, 10 + weld},
                                         {3, 90},  {-3, 90}, {-3, 10 + weld}, {-3 - weld, 10}, {-60, 10}};
  return profile({outline}, 200);
}

/// A box open on two sides: a bottom and two walls in its corner, one of which ends half way.
TopoDS_Shape bottom_with_a_short_wall() {
  const TopoDS_Shape bottom = BRepPrimAPI_MakeBox(100, 60, 1.5).Shape();
  const TopoDS_Shape walls = BRepAlgoAPI_Fuse(BRepPrimAPI_MakeBox(100, 1.5, 20).Shape(),
                                              BRepPrimAPI_MakeBox(gp_Pnt(98.5, 0, 0), 1.5, 30, 20).Shape())
                                 .Shape();
  ShapeUpgrade_UnifySameDomain unify(BRepAlgoAPI_Fuse(bottom, walls).Shape());
  unify.Build();
  return unify.Shape();
}

/// What is delivered as right has no free edge but at a rim.
TEST(MidSurface, RefusesFreeEdgesThatAreNotAtARim) {
  // The plate ends inside the foot of a wall that is wider than it and reaches past its corner.
  const TopoDS_Shape solid = BRepAlgoAPI_Fuse(BRepPrimAPI_MakeBox(100, 60, 3).Shape(),
                                              BRepPrimAPI_MakeBox(gp_Pnt(97, 50, 0), 5, 20, 30).Shape())
                                 .Shape();
  try {
    middle_of(solid);
    ADD_FAILURE() << "its middle surface has free edges in the material";
  } catch (const Error& error) {
    const std::string told = error.what();
    EXPECT_NE(told.find("inside the material between Face"), std::string::npos) << told;
    EXPECT_NE(told.find("; `partial` gives it nevertheless"), std::string::npos) << told;
    EXPECT_EQ(told.find("fillet"), std::string::npos) << told;  // there is none
  }
  const MidSurface middle = middle_of(solid, true);
  ASSERT_FALSE(middle.stray_edges.empty());
  ASSERT_EQ(middle.stray_faces.size(), middle.stray_edges.size());
  const std::size_t edges = middle.stray_edges.size();
  const std::string count = edges == 1 ? "a free edge of the middle surface ends"
                                       : fmt::format("{} free edges of the middle surface end", edges);
  EXPECT_NE(middle.problems[0].find(count + " inside"), std::string::npos) << middle.problems[0];
  for (const std::vector<int>& faces : middle.stray_faces) EXPECT_EQ(faces.size(), 2U);
}

double area_of_steps(const MidSurface& middle) {
  return std::accumulate(
      middle.faces.begin(), middle.faces.end(), 0.0,
      [](double sum, const MiddleFace& face) { return sum + (face.step ? face.area : 0); });
}

/// The floor is not parallel to the sheet, so that its own normal leans to the step.
TopoDS_Shape block(const gp_Pnt& corner, double x, double y, double z) {
  return BRepPrimAPI_MakeBox(corner, x, y, z).Shape();
}

/// One solid without edges between faces on one surface.
TopoDS_Shape fused(const std::vector<TopoDS_Shape>& parts) {
  TopoDS_Shape result = parts.front();
  for (std::size_t i = 1; i < parts.size(); ++i) result = BRepAlgoAPI_Fuse(result, parts[i]).Shape();
  ShapeUpgrade_UnifySameDomain unify(result);
  unify.Build();
  return unify.Shape();
}

/// Walls grow up to the next ones or to their rims, no farther, and joined by strips where they lie apart.
void expect_one_part(const TopoDS_Shape& solid, double off = 0.01) {
  const MidSurface middle = middle_of(solid);
  EXPECT_EQ(middle.parts, 1);
  EXPECT_TRUE(middle.stray_edges.empty());
  EXPECT_NEAR(middle.shell_volume - middle.counted_twice, middle.volume, off * middle.volume);
}

TEST(MidSurface, EndsRibsThatAreLowerThanTheirBoss) {
  for (const double height : {12.0, 16.0, 19.0}) {
    const auto cylinder = [](double radius, double low, double high) {
      return BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(70, 50, low), gp::DZ()), radius, high - low).Shape();
    };
    const TopoDS_Shape solid =
        fused({block({0, 0, 0}, 140, 100, 3), cylinder(10, 1, 21), block({20, 48.75, 1}, 44, 2.5, height)});
    expect_one_part(BRepAlgoAPI_Cut(solid, cylinder(7.5, -1, 22)).Shape());
  }
}

/// The strips beside its foot end at its leg.
TEST(MidSurface, EndsAnAngleOnAWiderPlate) {
  expect_one_part(
      fused({block({0, 0, 0}, 120, 80, 3), block({60, 10, 3}, 40, 60, 3), block({97, 10, 6}, 3, 60, 80)}));
}

TEST(MidSurface, EndsCapsAtTheRimOfAHat) {
  for (const double thickness : {2.0, 3.0}) {
    const double t = thickness;
    expect_one_part(fused(
        {block({-50, 0, 0}, 30, t, 200), block({20, 0, 0}, 30, t, 200), block({-20 - t, 0, 0}, t, 32, 200),
         block({20, 0, 0}, t, 32, 200), block({-20 - t, 32 - t, 0}, 40 + 2 * t, t, 200),
         block({-20 - t, 0, 0}, 40 + 2 * t, 32, t), block({-20 - t, 0, 200 - t}, 40 + 2 * t, 32, t)}));
  }
}

TEST(MidSurface, FindsPocketsBesideEachOther) {
  const TopoDS_Shape plate = block({0, 0, 0}, 160, 100, 6);
  const TopoDS_Shape one = BRepAlgoAPI_Cut(plate, block({15, 15, 4}, 90, 70, 4)).Shape();
  expect_one_part(BRepAlgoAPI_Cut(one, block({60, 15, -2}, 85, 70, 4)).Shape());
  expect_one_part(BRepAlgoAPI_Cut(one, block({60, 15, -2}, 85, 70, 3)).Shape());
  expect_one_part(BRepAlgoAPI_Cut(one, block({80, 25, -2}, 65, 50, 4)).Shape());
  expect_one_part(BRepAlgoAPI_Cut(one, block({60, 40, -2}, 85, 50, 4)).Shape());
}

/// What a pocket leaves along the rim is narrower than thick, and belongs to the plate.
TEST(MidSurface, MakesNoWallBetweenARimAndAPocket) {
  const TopoDS_Shape plate = block({0, 0, 0}, 200, 120, 8);
  const TopoDS_Shape one = BRepAlgoAPI_Cut(plate, block({20, 25, 4}, 80, 70, 4)).Shape();
  const TopoDS_Shape solid = BRepAlgoAPI_Cut(one, block({115, 30, 0}, 80, 60, 3)).Shape();
  expect_one_part(solid);
  for (const MiddleFace& face : middle_of(solid).faces) {
    const double t = face.thickness;
    EXPECT_TRUE(t < 4.001 || std::abs(t - 5) < 0.001 || t > 7.999) << t;
    EXPECT_TRUE(std::abs(t - 5) > 0.001 || face.step || face.area > 4799) << face.area;
  }
}

/// The edge of a pocket is no rim, which would make the part seem narrow.
TEST(MidSurface, TakesPocketsAndPadsForPartsOfTheirPlate) {
  const TopoDS_Shape plate = block({0, 0, 0}, 180, 120, 10);
  const TopoDS_Shape one = BRepAlgoAPI_Cut(plate, block({20, 15, 7}, 140, 90, 3)).Shape();
  expect_one_part(BRepAlgoAPI_Cut(one, block({50, 35, 3}, 70, 50, 4)).Shape());
}

/// The strips of the step have the thickness of the plate, also where the stem crosses them.
TEST(MidSurface, OfAPadBehindATee) {
  for (const double y : {0.0, 5.0, 11.0}) {
    const TopoDS_Shape solid =
        fused({block({0, 0, 0}, 220, 65, 8), block({0, 29, 7}, 220, 7, 42), block({60, y, -5}, 80, 42, 6)});
    expect_one_part(solid);
    for (const MiddleFace& face : middle_of(solid).faces)
      EXPECT_TRUE(!face.step || std::abs(face.thickness - 8) < 1e-6) << face.thickness;
  }
}

/// The ring is hollow toward the ends of the blades, which are lower than ring and hub.
TEST(MidSurface, EndsBladesInARing) {
  for (const double radius : {24.0, 63.0}) {
    const auto tube = [&](double inner, double outer) {
      return BRepAlgoAPI_Cut(BRepPrimAPI_MakeCylinder(outer, 40).Shape(),
                             BRepPrimAPI_MakeCylinder(inner, 40).Shape())
          .Shape();
    };
    std::vector<TopoDS_Shape> parts{tube(9, 12), tube(radius, radius + 3)};
    for (int i = 0; i < 5; ++i) {
      gp_Trsf turn;
      turn.SetRotation(gp::OZ(), 0.4 * M_PI * i + 0.05);
      parts.push_back(
          BRepBuilderAPI_Transform(block({11, -1.25, 8}, radius - 10, 2.5, 24), turn, Standard_True).Shape());
    }
    expect_one_part(fused(parts));
  }
}

/// A rim that is too flat to run on into the plate ends across it.
TEST(MidSurface, EndsFlatGussets) {
  gp_Trsf aside;
  aside.SetTranslation({0, 0, 30});
  for (const double height : {10.0, 12.0}) {
    SCOPED_TRACE(height);
    const TopoDS_Shape gusset = profile({{{22, 2}, {22, 3 + height}, {47, 3}, {47, 2}}}, 2.5);
    expect_one_part(fused({block({0, 0, 0}, 120, 3, 60), block({20, 0, 0}, 3, 40, 60),
                           BRepBuilderAPI_Transform(gusset, aside, Standard_True).Shape()}));
  }
}

/// What is narrow for a shell is kept, with a word: beads, lips, hats of thick sheet.
TEST(MidSurface, TellsNarrowWalls) {
  const auto told = [](const std::vector<TopoDS_Shape>& parts) {
    const MidSurface middle = middle_of(fused(parts));
    return std::any_of(middle.warnings.begin(), middle.warnings.end(), [](const std::string& warning) {
      return warning.find("times as wide as thick") != std::string::npos;
    });
  };
  const TopoDS_Shape plate = block({0, 0, 0}, 160, 70, 3);
  EXPECT_TRUE(told({plate, block({0, 0, 0}, 160, 7, 8)}));
  EXPECT_TRUE(told({plate, block({0, 67, 0}, 160, 3, 18)}));
  EXPECT_FALSE(told({plate, block({0, 0, 0}, 160, 3, 45)}));
}

TEST(MidSurface, EndsBulkheadsFlushWithTheLipsOfAChannel) {
  for (const double thickness : {1.0, 2.0, 3.0}) {
    expect_one_part(fused({block({-30, 0, 0}, 60, 2, 120), block({-30, 0, 0}, 2, 40, 120),
                           block({28, 0, 0}, 2, 40, 120), block({-45, 38, 0}, 17, 2, 120),
                           block({28, 38, 0}, 17, 2, 120), block({-30, 0, 60}, 60, 40, thickness)}));
  }
}

TEST(MidSurface, LeadsALipRoundACorner) {
  for (const double lip : {0.8, 1.0, 1.4}) {
    SCOPED_TRACE(lip);
    expect_one_part(fused({block({0, 0, 0}, 100, 2, 40), block({0, 0, 0}, 2, 70, 40),
                           block({2 - lip, 2 - lip, 39}, 98 + lip, lip, 9),
                           block({2 - lip, 2 - lip, 39}, lip, 68 + lip, 9)}));
    expect_one_part(fused({block({0, 0, 0}, 100, 2, 40), block({0, 0, 0}, 2, 70, 40),
                           block({0, 0, 39}, 100, lip, 9), block({0, 0, 39}, lip, 70, 9)}));
  }
  // Half beside the wall.
  expect_one_part(fused({block({0, 0, 0}, 100, 2, 40), block({0, 0, 0}, 2, 70, 40),
                         block({1, 1, 38}, 99, 2, 10), block({1, 1, 38}, 2, 69, 10)}));
}

TEST(MidSurface, LeadsALipRoundASlantingCorner) {
  for (const double degrees : {60.0, 120.0}) {
    const double angle = degrees * M_PI / 180;
    /// The material between two distances from the outside of both walls.
    const auto band = [&](double low, double high, double height) {
      const auto corner = [&](double d) { return Corner2d{d / std::tan(0.5 * angle), d}; };
      const auto end = [&](double d) {
        return Corner2d{70 * std::cos(angle) + d * std::sin(angle),
                        70 * std::sin(angle) - d * std::cos(angle)};
      };
      return profile({{{100, low}, {100, high}, corner(high), end(high), end(low), corner(low)}}, height);
    };
    for (const double lip : {0.8, 1.0, 1.4}) {
      SCOPED_TRACE(fmt::format("{} degrees, {} mm", degrees, lip));
      expect_one_part(fused({band(0, 2, 40), band(0, lip, 48)}));
      expect_one_part(fused({band(0, 2, 40), band(2 - lip, 2, 48)}));
    }
  }
}

/// The lip stands on the inside of all four walls.
TEST(MidSurface, LeadsALipRoundATray) {
  const TopoDS_Shape tray =
      BRepAlgoAPI_Cut(fused({block({0, 0, 0}, 100, 70, 40), block({1, 1, 39}, 98, 68, 9)}),
                      block({2, 2, 2}, 96, 66, 50))
          .Shape();
  expect_one_part(tray);
}

/// The plate below the pad ends where the angle on it does.
TEST(MidSurface, EndsAnAngleAtTheEdgeOfAPlate) {
  expect_one_part(
      fused({block({0, 0, 0}, 60, 40, 3), block({40, 5, 3}, 20, 30, 3), block({57, 5, 6}, 3, 30, 40)}),
      0.015);
}

TEST(MidSurface, JoinsALeaningFloorToItsStep) {
  for (const auto& [low, high] : {std::pair(2.6, 3.5), std::pair(1.5, 3.6), std::pair(0.8, 4.0)}) {
    SCOPED_TRACE(high);
    const MidSurface middle = middle_of(leaning_pocket(low, high));
    expect_right(middle);
    EXPECT_EQ(free_loops(middle.model), 1);
  }
}

/// The rib's middle ends where the rib does, also where the fillets beside it hide its corner.
TEST(MidSurface, EndsFilletedRibsAtTheirRims) {
  const MidSurface middle = middle_of(rib_rounded_at_its_sides());
  expect_right(middle);
  EXPECT_NEAR(area_of(middle), 100 * 60 + 40 * 16.5, 1e-6);
}

/// The bottom ends at the wall's middle where the wall stands at its rim, and at its own rim past the wall's
/// end.
TEST(MidSurface, EndsAPlateAtAWallThatIsShorter) {
  const MidSurface middle = middle_of(bottom_with_a_short_wall());
  expect_right(middle);
  EXPECT_NEAR(area_of(middle), 99.25 * 59.25 + 0.75 * 30 + 19.25 * (99.25 + 29.25), 1e-6);
}

/// The middle of the pad lies in the outside of the tube, and its own side leans to its rim.
TEST(MidSurface, OfAPadOnATube) {
  const TopoDS_Shape pad =
      BRepAlgoAPI_Common(BRepPrimAPI_MakeCylinder(51, 90).Shape(),
                         BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(0, 0, 45), gp::DX()), 15, 80).Shape())
          .Shape();
  const TopoDS_Shape solid =
      BRepAlgoAPI_Cut(BRepAlgoAPI_Fuse(BRepPrimAPI_MakeCylinder(50, 90).Shape(), pad).Shape(),
                      BRepPrimAPI_MakeCylinder(49, 90).Shape())
          .Shape();
  const MidSurface middle = middle_of(solid);
  expect_right(middle);
  EXPECT_EQ(free_loops(middle.model), 2);
}

/// The pairs of sides that face each other across both ribs are no walls.
TEST(MidSurface, MakesNoWallsBetweenCrossingRibs) {
  const MidSurface middle = middle_of(ribs_at_an_acute_angle());
  expect_right(middle);
  EXPECT_NEAR(area_of(middle), 120 * 80 + 2 * 90 * 18.5, 1e-6);
  for (const MiddleFace& face : middle.faces) EXPECT_NEAR(face.thickest, 3, 1e-6);
}

/// An I-beam of 400 mm, 200 high and 100 wide, with flanges of 9 and a web of 6, and pairs of stiffeners.
TopoDS_Shape stiffened_beam(const std::vector<double>& stiffeners, double thickness, double wide) {
  const auto box = [](double x, double y, double z, double dx, double dy, double dz) {
    return BRepPrimAPI_MakeBox(gp_Pnt(x, y, z), dx, dy, dz).Shape();
  };
  TopoDS_Shape result = box(0, -50, 0, 400, 100, 9);
  const auto add = [&](const TopoDS_Shape& part) { result = BRepAlgoAPI_Fuse(result, part).Shape(); };
  add(box(0, -50, 191, 400, 100, 9));
  add(box(0, -3, 9, 400, 6, 182));
  for (const double x : stiffeners) add(box(x, -0.5 * wide, 9, thickness, wide, 182));
  ShapeUpgrade_UnifySameDomain unify(result);
  unify.Build();
  return unify.Shape();
}

/// The rims of stiffeners face each other through the web: no wall lies between them.
TEST(MidSurface, MakesNoWallsBetweenRimsOfStiffeners) {
  for (const double wide : {100.0, 90.0, 60.0}) {
    for (const std::vector<double>& stiffeners :
         {std::vector<double>{200}, std::vector<double>{100, 300}, std::vector<double>{80, 180, 280}}) {
      const MidSurface middle = middle_of(stiffened_beam(stiffeners, 6, wide));
      SCOPED_TRACE(fmt::format("{} pairs, {} wide", stiffeners.size(), wide));
      expect_right(middle);
      const double area = 2 * 400 * 100 + 400 * 191 + static_cast<double>(stiffeners.size()) * wide * 191;
      EXPECT_NEAR(area_of(middle), area, 1e-6 * area);
      for (const MiddleFace& face : middle.faces) EXPECT_LT(face.thickest, 9.001);
    }
  }
}

/// Two flat parts of a sheet of 2 mm, 50 mm long in the middle, at an angle, without a radius.
TopoDS_Shape sharp_fold(double degrees) {
  const double turn = degrees * M_PI / 180, c = std::cos(turn), s = std::sin(turn), k = std::tan(0.5 * turn);
  return profile({{{0, -1},
                   {50 + k, -1},
                   {50 + 50 * c + s, 50 * s - c},
                   {50 + 50 * c - s, 50 * s + c},
                   {50 - k, 1},
                   {0, 1}}},
                 80);
}

TEST(MidSurface, JoinsSharpFoldsInAnEdge) {
  for (const double degrees : {0.5, 2.0, 10.0, 30.0, 45.0, 60.0}) {
    const MidSurface middle = middle_of(sharp_fold(degrees));
    expect_right(middle);
    EXPECT_EQ(middle.faces.size(), 2U) << degrees;
    EXPECT_NEAR(area_of(middle), 80 * 100, 1e-5) << degrees;
    EXPECT_EQ(area_of_steps(middle), 0) << degrees;
  }
}

/// A sheet that is folded sharply where its thickness changes.
TopoDS_Shape fold_of_two_thicknesses(double degrees, double first, double second) {
  const double turn = degrees * M_PI / 180, c = std::cos(turn), s = std::sin(turn);
  const double upper = (c * first - second) / s;  // where the upper sides meet
  return profile({{{-50, 0},
                   {0, 0},
                   {50 * c, 50 * s},
                   {50 * c - second * s, 50 * s + second * c},
                   {upper, first},
                   {-50, first}}},
                 80);
}

/// The middles intersect far from the edge, but in no wall.
TEST(MidSurface, JoinsFoldsOfTwoThicknessesInAnEdge) {
  for (const double degrees : {7.0, 10.0, 20.0, 45.0}) {
    for (const double second : {2.2, 2.5, 3.0}) {
      SCOPED_TRACE(fmt::format("{} degrees, {} mm", degrees, second));
      const MidSurface middle = middle_of(fold_of_two_thicknesses(degrees, 2, second));
      expect_right(middle);
      EXPECT_EQ(middle.faces.size(), 2U);
      EXPECT_NEAR(middle.shell_volume / middle.volume, 1, 1e-3);
    }
  }
}

/// A plate with a rib that leans, and ends free.
TopoDS_Shape leaning_rib(double degrees) {
  const double turn = degrees * M_PI / 180, wide = 3 / std::cos(turn), aside = 30 * std::tan(turn);
  BRepBuilderAPI_MakePolygon foot(gp_Pnt(20, 40, 0), gp_Pnt(20, 40 + wide, 0),
                                  gp_Pnt(20, 40 + wide + aside, 30), gp_Pnt(20, 40 + aside, 30),
                                  Standard_True);
  const TopoDS_Shape rib =
      BRepPrimAPI_MakePrism(BRepBuilderAPI_MakeFace(foot.Wire()).Face(), gp_Vec(80, 0, 0)).Shape();
  return BRepAlgoAPI_Fuse(BRepPrimAPI_MakeBox(120, 80, 3).Shape(), rib).Shape();
}

TEST(MidSurface, EndsLeaningRibsAtTheirRims) {
  for (const double degrees : {10.0, 20.0, 40.0}) {
    SCOPED_TRACE(degrees);
    const MidSurface middle = middle_of(leaning_rib(degrees));
    expect_right(middle);
    EXPECT_NEAR(area_of(middle), 120 * 80 + 80 * 28.5 / std::cos(degrees * M_PI / 180), 1e-6);
  }
}

/// Where a bent sheet leaves the plate on which it lies, there are two walls behind the double one. The
/// crevice under the bend is no gap to be filled.
TEST(MidSurface, JoinsABentSheetThatLiesOnAPlate) {
  TopoDS_Compound both;
  const BRep_Builder builder;
  builder.MakeCompound(both);
  builder.Add(both, profile({{{0, 0, 5}, {40, 0}, {40, 2}, {2, 2, 3}, {2, 40}, {0, 40}}}, 100));
  builder.Add(both, BRepPrimAPI_MakeBox(gp_Pnt(-20, -2, 0), 100, 2, 100).Shape());
  const MidSurface middle = middle_of(both, false, true);
  expect_right(middle);
  EXPECT_NEAR(middle.volume, 100 * (2 * 100 + 2 * (35 + 35) + M_PI / 4 * (25 - 9)), 1e-3);
  EXPECT_NEAR(area_of_steps(middle), 3 * 100, 1e-6);
}

/// A sheet with holes in rows and columns.
TopoDS_Shape sheet_with_holes(int count) {
  std::vector<std::vector<Corner2d>> outlines{
      {{0, 0}, {10.0 * count, 0}, {10.0 * count, 10.0 * count}, {0, 10.0 * count}}};
  BRepBuilderAPI_MakeFace face(TopoDS::Face(section(outlines)));
  for (int i = 0; i < count * count; ++i) {
    const int row = i / count;
    const gp_Ax2 axis(gp_Pnt(10 * (i % count) + 5, 10 * row + 5, 0), -gp::DZ());
    face.Add(BRepBuilderAPI_MakeWire(BRepBuilderAPI_MakeEdge(gp_Circ(axis, 3)).Edge()).Wire());
  }
  return BRepPrimAPI_MakePrism(face.Face(), gp_Vec(0, 0, 2)).Shape();
}

/// In CPU time: the work that grew with the square of the holes was OpenCASCADE's.
TEST(MidSurface, TakesTimeInProportionToHoles) {
  const auto seconds_for = [](int count) {
    const TopoDS_Shape sheet = sheet_with_holes(count);
    const std::clock_t start = std::clock();
    const MidSurface middle = middle_of(sheet);
    const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    expect_right(middle);
    EXPECT_EQ(middle.free_edges, 4 + count * count);
    return seconds;
  };
  const double few = seconds_for(10), many = seconds_for(30);
  RecordProperty("ratio", fmt::format("{:.1f} for 9 times the holes", many / few));
  EXPECT_LT(many, 15 * few);
}

/// OpenCASCADE integrates the volume of this solid 7 % too large.
TEST(MidSurface, OfASineSheet) {
  TColgp_Array1OfPnt points(1, 61);
  for (int i = 0; i <= 60; ++i) points.SetValue(i + 1, gp_Pnt(5 * i, 0, 6 * std::sin(2 * M_PI * i / 20)));
  const TopoDS_Edge line = BRepBuilderAPI_MakeEdge(GeomAPI_PointsToBSpline(points).Curve());
  const TopoDS_Shape sheet = BRepPrimAPI_MakePrism(line, gp_Vec(0, 120, 0)).Shape();
  BRepOffset_MakeOffset thicken(sheet, 1, 1e-4, BRepOffset_Skin, Standard_False, Standard_False,
                                GeomAbs_Intersection, Standard_True);
  ASSERT_TRUE(thicken.IsDone());
  const MidSurface middle = middle_of(thicken.Shape());
  expect_right(middle);
  EXPECT_EQ(middle.faces.size(), 1U);
}

/// Studs are left out, what is counted twice where walls meet does not make up for them.
TEST(MidSurface, TellsWhatIsLeftOutOfTheVolume) {
  const std::vector<Corner2d> outline = {{-60, 0}, {60, 0},  {60, 10}, {3, 10},
                                         {3, 90},  {-3, 90}, {-3, 10}, {-60, 10}};
  const TopoDS_Shape tee = profile({outline}, 200);
  const auto with_stud = [&](double height) {
    const gp_Ax2 axis(gp_Pnt(35, 0, 100), gp_Dir(0, -1, 0));
    return BRepAlgoAPI_Fuse(tee, BRepPrimAPI_MakeCylinder(axis, 12, height).Shape()).Shape();
  };
  const MidSurface middle = middle_of(with_stud(20));
  EXPECT_NEAR(middle.counted_twice, 6 * 5 * 200, 1e-3);
  ASSERT_FALSE(middle.warnings.empty());
  EXPECT_NE(middle.warnings[0].find("97.4 % of its volume; without a partner: Face"), std::string::npos)
      << middle.warnings[0];
  try {
    middle_of(with_stud(60));
    FAIL() << "7.5 % are left out";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("% of its volume; without a partner: Face"), std::string::npos)
        << error.what();
  }
}

/// A plate counts once with its pocket, but the strips that join its steps count too.
TEST(MidSurface, TellsTheVolumeOfTheStripsAtSteps) {
  const TopoDS_Shape plate = BRepPrimAPI_MakeBox(180, 120, 6).Shape();
  const TopoDS_Shape pocket = BRepPrimAPI_MakeBox(gp_Pnt(15, 15, 3), 150, 90, 3).Shape();
  const MidSurface middle = middle_of(BRepAlgoAPI_Cut(plate, pocket).Shape());
  expect_told(middle);
  const double strips = 2 * (150 + 90) * 1.5 * 3;
  EXPECT_NEAR(middle.counted_twice, strips, 1e-3);
  EXPECT_NEAR(middle.shell_volume, middle.volume + strips, 1e-3);
  ASSERT_EQ(middle.warnings.size(), 1U);
  EXPECT_NE(middle.warnings[0].find("in the faces that join the walls of a step), at the result's Face"),
            std::string::npos)
      << middle.warnings[0];
}

/// The material of a weld keeps both walls from bending and twisting: each gets all of it, whatever its size.
TEST(MidSurface, AddsFlatFilletsToTheThickness) {
  for (const double leg : {6.0, 8.0, 10.0}) {
    const MidSurface middle = middle_of(welded_tee(leg));
    EXPECT_EQ(middle.faces.size(), 6U);
    expect_told(middle);
    EXPECT_NEAR((middle.shell_volume - middle.counted_twice) / middle.volume, 1, 1e-6);
    const double area = leg * leg;  // of both welds
    EXPECT_NEAR(middle.shell_volume / 200, 1200 + 6 * 85 + 2 * area, 1e-3);
    int added = 0;  // strips
    for (const MiddleFace& face : middle.faces) {
      const bool web = std::abs(face.area / 200 - (5 + leg)) < 1e-3;
      const bool flange = std::abs(face.area / 200 - (3 + leg)) < 1e-3;
      if (web) {
        EXPECT_NEAR((face.thickness - 6) * (5 + leg), area, 1e-6);
      }
      if (flange) {
        EXPECT_NEAR((face.thickness - 10) * (3 + leg), 0.5 * area, 1e-6);
      }
      added += web || flange ? 1 : 0;
    }
    EXPECT_EQ(added, 3) << leg;
  }
}

/// A box with flat fillets in its corners, which count nothing twice.
TEST(MidSurface, AddsFlatFilletsInABox) {
  const std::vector<Corner2d> outside = {{0, 0}, {80, 0}, {80, 60}, {0, 60}};
  const std::vector<Corner2d> inside = {{10, 4},  {70, 4},  {76, 10}, {76, 50},
                                        {70, 56}, {10, 56}, {4, 50},  {4, 10}};
  const MidSurface middle = middle_of(profile({outside, inside}, 150));
  EXPECT_TRUE(middle.warnings.empty());
  EXPECT_EQ(middle.faces.size(), 12U);
  EXPECT_NEAR(middle.shell_volume / middle.volume, 1, 1e-6);
}

/// The end of a gusset is inclined to both walls too, but no fillet.
TEST(MidSurface, TakesNoGussetForAFillet) {
  const std::vector<Corner2d> angle = {{0, 0}, {60, 0}, {60, 4}, {4, 4}, {4, 60}, {0, 60}};
  const std::vector<Corner2d> gusset = {{2, 2}, {16, 2}, {16, 4}, {4, 16}, {2, 16}};
  gp_Trsf to_the_middle;
  to_the_middle.SetTranslation(gp_Vec(0, 0, 38));
  const TopoDS_Shape rib = BRepBuilderAPI_Transform(profile({gusset}, 4), to_the_middle).Shape();
  const MidSurface middle = middle_of(BRepAlgoAPI_Fuse(profile({angle}, 80), rib).Shape(), true);
  for (const MiddleFace& face : middle.faces) EXPECT_NEAR(face.thickness, 4, 1e-6);
}

/// The flange of a rolled channel is thickest at its root, where the fillet adds to it.
TEST(MidSurface, AddsFilletsToTheThicknessWhereTheyAre) {
  const std::vector<Corner2d> outline = {
      {0, 0}, {75, 0}, {75, 8.5}, {8.5, 13.82, 11.5}, {8.5, 186.18, 11.5}, {75, 191.5}, {75, 200}, {0, 200}};
  const MidSurface middle = middle_of(profile({outline}, 300));
  expect_told(middle);
  EXPECT_NEAR(middle.shell_volume / middle.volume, 1.0135, 0.001) << "the web gets its fillets once more";
  EXPECT_NEAR((middle.shell_volume - middle.counted_twice) / middle.volume, 1, 0.002);
  double thickest = 0;
  for (const MiddleFace& face : middle.faces) thickest = std::max(thickest, face.thickness);
  EXPECT_NEAR(thickest, 15.2, 0.5) << "13.5 at the root, and a fillet of 28 mm2 over 16 mm";
}

/// The middle of a bend whose radii are equal and no larger than the sheet is thick is nearly a corner.
TEST(MidSurface, MakesACornerOfATightBendWithEqualRadii) {
  for (const double radius : {1.0, 3.0}) {
    const std::vector<Corner2d> outline = {{0, 0, radius}, {40, 0}, {40, 4},
                                           {4, 4, radius}, {4, 40}, {0, 40}};
    const MidSurface middle = middle_of(profile({outline}, 60));
    EXPECT_EQ(middle.faces.size(), 2U);
    EXPECT_NEAR(middle.shell_volume / middle.volume, 1, 0.01);
    MeshOptions options;
    options.sizing.size = 4;
    options.order = 2;
    ExecutionContext context;
    EXPECT_TRUE(faces_with_bad_skins(mesh(middle, options, context)).empty());
  }
}

/// A quarter of a tube of radius 2, in a mesh of eight quads.
TEST(MidSurface, NeedsASolid) {
  const TopoDS_Shape face = TopExp_Explorer(thick_block(), TopAbs_FACE).Current();
  EXPECT_THROW(middle_of(face), Error);
}

TEST(MidSurface, IsTheSameEachTime) {
  const TopoDS_Shape solid = ribbed_plate(2);
  EXPECT_EQ(brep_of(middle_of(solid)), brep_of(middle_of(solid)));
}

TEST(MidSurface, NeverEditsTheSolid) {
  const TopoDS_Shape solid = ribbed_plate(6);
  std::ostringstream before, after;
  BRepTools::Write(solid, before);
  const MidSurface middle = middle_of(solid);
  BRepTools::Write(solid, after);
  EXPECT_GE(model_of(solid).face_count(), 200);
  EXPECT_EQ(middle.parts, 1);
  EXPECT_EQ(before.str(), after.str());
}

double checks_for_the_middle_of(const TopoDS_Shape& solid) {
  ExecutionContext context;
  midsurface(model_of(solid), {}, context);
  return static_cast<double>(context.work());
}

/// The work is counted in checks of the context; bench/midsurface_figures.py measures times.
TEST(MidSurface, TakesWorkInProportion) {
  const TopoDS_Shape small = ribbed_plate(3), large = ribbed_plate(6);
  const double faces = static_cast<double>(model_of(large).face_count()) / model_of(small).face_count();
  const double checks = checks_for_the_middle_of(large) / checks_for_the_middle_of(small);
  RecordProperty("ratio", fmt::format("{:.2f} for {:.2f} times the faces", checks, faces));
  EXPECT_GT(checks, 1);
  EXPECT_LT(checks, 1.5 * faces * faces);
}

}  // namespace
}  // namespace quadrille
