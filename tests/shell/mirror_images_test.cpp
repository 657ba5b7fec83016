/// Meshes of symmetric models are their own mirror images.

#include "mesher/shell/mirror_images.hpp"

#include <gtest/gtest.h>

#include <BRepAlgoAPI_Cut.hxx>
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRep_Builder.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Compound.hxx>
#include <algorithm>
#include <filesystem>
#include <gp_Pln.hxx>
#include <map>
#include <set>

#include "geometry/symmetry/mirror_planes.hpp"
#include "mesher/quadrille.hpp"
#include "tests/models/trouble_models.hpp"
#include "tests/support/ids.hpp"
#include "tests/support/sample_models.hpp"

namespace quadrille {
namespace {

CadModel model_of(const TopoDS_Shape& shape) {
  return CadModel(std::make_shared<CadShape>(shape, "test"));
}

/// Its seam lies at an angle of that many radians.
TopoDS_Shape rod(double x, double y, double radius, double height, double seam = 0) {
  const gp_Ax2 axis(gp_Pnt(x, y, -1), gp_Dir(0, 0, 1), gp_Dir(std::cos(seam), std::sin(seam), 0));
  return BRepPrimAPI_MakeCylinder(axis, radius, height + 2).Shape();
}

/// 40 by 30 by 5 with a hole at each of these places.
TopoDS_Shape plate(const std::vector<std::pair<double, double>>& holes, double seam = 0) {
  TopoDS_Shape result = BRepPrimAPI_MakeBox(40, 30, 5).Shape();
  for (const auto& [x, y] : holes) result = BRepAlgoAPI_Cut(result, rod(x, y, 3, 5, seam)).Shape();
  return result;
}

/// The flat one of the quality figures: 100 by 80, holes of 12.
TopoDS_Shape flat_plate() {
  TopoDS_Shape result = BRepBuilderAPI_MakeFace(gp_Pln(), 0, 100, 0, 80).Shape();
  for (const double x : {25.0, 75.0}) {
    for (const double y : {20.0, 60.0}) result = BRepAlgoAPI_Cut(result, rod(x, y, 6, 1)).Shape();
  }
  return result;
}

ShellMesh mesh_of(const CadModel& model, MeshOptions options, int threads = 1) {
  ExecutionContext context(threads);
  return mesh(model, options, context);
}

MeshOptions symmetric(double size, int order = 1) {
  MeshOptions options;
  options.sizing.size = size;
  options.order = order;
  options.symmetry = true;
  return options;
}

std::vector<MirrorPlane> planes_of(const CadModel& model) {
  return mirror_planes(model.shape(), ExecutionContext());
}

/// The node at each node's mirror image, -1 where there is none within a distance.
std::vector<int> image_nodes(const ShellMesh& mesh, const MirrorPlane& plane, double reach) {
  std::vector<int> order(mesh.points.size()), images(mesh.points.size(), -1);
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<int>(i);
  const Vector3 way = Vector3(0.3, 0.5, 0.81);
  const auto key = [&](const Vector3& point) { return way.dot(point); };
  std::sort(order.begin(), order.end(),
            [&](int a, int b) { return key(mesh.points[a]) < key(mesh.points[b]); });
  for (std::size_t i = 0; i < images.size(); ++i) {
    const Vector3 wanted = plane.mirrored(mesh.points[i]);
    auto it = std::lower_bound(order.begin(), order.end(), key(wanted) - 2 * reach,
                               [&](int node, double x) { return key(mesh.points[node]) < x; });
    for (; it != order.end() && key(mesh.points[*it]) <= key(wanted) + 2 * reach; ++it) {
      if ((mesh.points[*it] - wanted).norm() <= reach) images[i] = *it;
    }
  }
  return images;
}

/// Node by node and element by element, midside nodes too.
void expect_own_image(const ShellMesh& mesh, const MirrorPlane& plane, double diagonal) {
  const std::vector<int> images = image_nodes(mesh, plane, 1e-9 * diagonal);
  EXPECT_EQ(std::count(images.begin(), images.end(), -1), 0) << plane.name();
  // Parts that touch have nodes on each other, which count as one place.
  std::vector<int> places = images;
  for (int& place : places) place = place < 0 ? -1 : images[place];
  std::multiset<std::set<int>> quads, mirrored;
  for (std::size_t i = 0; i < mesh.quads.size(); ++i) {
    std::set<int> quad, image;
    const auto add = [&](int node) {
      quad.insert(places[node]);
      image.insert(images[node]);
    };
    for (const int node : mesh.quads[i]) add(node);
    if (mesh.order == 2) {
      for (const int node : mesh.midsides[i]) add(node);
    }
    quads.insert(quad);
    mirrored.insert(image);
  }
  EXPECT_TRUE(quads == mirrored) << plane.name();
  std::set<int> sides_cross;  // a side with an end on each side of the plane
  for (const auto& quad : mesh.quads) {
    for (int k = 0; k < 4; ++k) {
      const double a = plane.distance(mesh.points[quad[k]]),
                   b = plane.distance(mesh.points[quad[(k + 1) % 4]]);
      if (std::min(a, b) < -1e-9 * diagonal && std::max(a, b) > 1e-9 * diagonal) sides_cross.insert(quad[k]);
    }
  }
  EXPECT_TRUE(sides_cross.empty()) << "nodes do not lie on " << plane.name();
}

std::string joined(const std::vector<std::string>& lines) {
  std::string result;
  for (const auto& line : lines) result += line + "\n";
  return result;
}

/// Parts that touch have nodes on each other.
std::vector<std::string> but_coincidence(std::vector<std::string> problems) {
  std::erase_if(problems, [](const std::string& line) { return line.find("coincide") != std::string::npos; });
  return problems;
}

template <class Elements, class Number>
std::set<int> numbers(const Elements& elements, Number number) {
  std::set<int> result;
  for (const auto& element : elements) result.insert(number(element));
  return result;
}

/// The edges and vertices that a mesh has, those that were let go too.
std::pair<std::set<int>, std::set<int>> entities(const ShellMesh& mesh) {
  auto result = std::pair(numbers(mesh.segments, [](const auto& segment) { return segment.edge; }),
                          numbers(mesh.corners, [](const auto& corner) { return corner.vertex; }));
  for (const ShellMesh::LetGo& feature : mesh.let_go)
    (feature.kind == ShellMesh::LetGo::Kind::edge ? result.first : result.second).insert(feature.number);
  return result;
}

/// The mesh is valid, its own image in so many planes, and has the groups of the mesh that is made without.
void expect_symmetric(const CadModel& model, const MeshOptions& options, std::size_t planes, bool closed) {
  const ShellMesh mesh = mesh_of(model, options);
  EXPECT_EQ(mesh.symmetry.planes.size(), planes) << mesh.symmetry.note;
  EXPECT_EQ(joined(validate(mesh, closed)), "");
  const auto found = planes_of(model);
  ASSERT_EQ(found.size(), planes);
  for (const MirrorPlane& plane : found) expect_own_image(mesh, plane, model.diagonal());
  MeshOptions plain = options;
  plain.symmetry = false;
  const ShellMesh other = mesh_of(model, plain);
  EXPECT_TRUE(other.symmetry.planes.empty());
  EXPECT_EQ(numbers(mesh.quad_faces, [](int face) { return face; }),
            numbers(other.quad_faces, [](int face) { return face; }));
  EXPECT_EQ(entities(mesh), entities(other));
  for (const ShellMesh::Corner& corner : mesh.corners)
    EXPECT_LT((mesh.points[corner.node] - model.shape().vertices[vertex_id(corner.vertex)]).norm(),
              1e-7 * model.diagonal());
}

/// Nodes inside the mesh that have not four quads.
int irregular_inside(const ShellMesh& mesh) {
  std::vector<int> valence(mesh.points.size(), 0);
  std::set<int> on_edges;
  for (const auto& quad : mesh.quads) {
    for (const int node : quad) ++valence[node];
  }
  for (const ShellMesh::Segment& segment : mesh.segments)
    on_edges.insert(segment.nodes.begin(), segment.nodes.end());
  int count = 0;
  for (std::size_t i = 0; i < valence.size(); ++i)
    count += valence[i] != 4 && !on_edges.contains(static_cast<int>(i)) ? 1 : 0;
  return count;
}

/// Of the mesh round each face, against the model's.
void expect_normals(const CadModel& model, const ShellMesh& mesh, MeshOptions options) {
  options.symmetry = false;
  const ShellMesh plain = mesh_of(model, options);
  const auto vector_areas = [&](const ShellMesh& of) {
    std::vector<Vector3> sums(model.face_count(), Vector3::Zero());
    for (std::size_t i = 0; i < of.quads.size(); ++i) {
      const auto& q = of.quads[i];
      sums[of.quad_faces[i] - 1] +=
          0.5 * (of.points[q[2]] - of.points[q[0]]).cross(of.points[q[3]] - of.points[q[1]]);
    }
    return sums;
  };
  const auto a = vector_areas(mesh), b = vector_areas(plain);
  for (int i = 0; i < model.face_count(); ++i)
    EXPECT_LT((a[i] - b[i]).norm(), std::max(0.01 * b[i].norm(), 2.0)) << "Face" << i + 1;
}

TEST(MirrorImages, PlanesOfBoxesPlatesAndRods) {
  EXPECT_EQ(planes_of(model_of(BRepPrimAPI_MakeBox(3, 2, 1).Shape())).size(), 3U);
  EXPECT_EQ(planes_of(model_of(BRepPrimAPI_MakeBox(2, 2, 2).Shape())).size(), 3U);
  EXPECT_EQ(planes_of(model_of(rod(5, 5, 3, 7))).size(), 3U);
  EXPECT_EQ(planes_of(model_of(plate({{10, 15}, {30, 15}}))).size(), 3U);
  const auto one_way = planes_of(model_of(plate({{10, 12}, {30, 12}})));
  ASSERT_EQ(one_way.size(), 2U);
  EXPECT_TRUE(std::any_of(one_way.begin(), one_way.end(),
                          [](const MirrorPlane& plane) { return plane.name() == "x = 20"; }));
}

TEST(MirrorImages, ASmallHoleMakesAPartUnsymmetrical) {
  const TopoDS_Shape whole = BRepPrimAPI_MakeBox(40, 30, 5).Shape();
  EXPECT_EQ(planes_of(model_of(whole)).size(), 3U);
  const TopoDS_Shape drilled = BRepAlgoAPI_Cut(whole, rod(5, 7, 0.05, 5)).Shape();
  const auto planes = planes_of(model_of(drilled));
  ASSERT_EQ(planes.size(), 1U);  // it goes all the way through
  EXPECT_EQ(planes.front().name(), "z = 2.5");
  EXPECT_TRUE(planes_of(model_of(plate({{10, 15}, {30, 15.001}}))).size() == 1);
}

TEST(MirrorImages, WithoutAPlaneTheMeshIsTheSame) {
  const CadModel model =
      model_of(BRepAlgoAPI_Cut(plate({{10, 12}, {28, 17}}), BRepPrimAPI_MakeBox(1, 1, 1)).Shape());
  ASSERT_TRUE(planes_of(model).empty());
  MeshOptions options = symmetric(2);
  const ShellMesh a = mesh_of(model, options);
  options.symmetry = false;
  const ShellMesh b = mesh_of(model, options);
  EXPECT_EQ(a.points, b.points);
  EXPECT_EQ(a.quads, b.quads);
  EXPECT_TRUE(a.symmetry.planes.empty());
}

class Orders : public testing::TestWithParam<int> {};

TEST_P(Orders, BoxesAreTheirOwnImages) {
  expect_symmetric(model_of(BRepPrimAPI_MakeBox(3, 2, 1).Shape()), symmetric(0.3, GetParam()), 3, true);
}

TEST_P(Orders, RodsAreTheirOwnImages) {
  expect_symmetric(model_of(rod(5, 5, 3, 7)), symmetric(0.7, GetParam()), 3, true);
}

TEST_P(Orders, TheSeamsOfHolesKeepTheirGroups) {
  for (const double seam : {0.0, 0.7}) {
    SCOPED_TRACE(seam);
    expect_symmetric(model_of(plate({{10, 8}, {30, 8}, {10, 22}, {30, 22}}, seam)),
                     symmetric(1.5, GetParam()), 3, true);
  }
}

TEST_P(Orders, HolesThatThePlaneCrosses) {
  expect_symmetric(model_of(plate({{20, 15}}, 0.3)), symmetric(2, GetParam()), 3, true);
}

TEST_P(Orders, TheFlatPlate) {
  const CadModel model = model_of(flat_plate());
  // The plane that it lies in is none of its own.
  expect_symmetric(model, symmetric(3, GetParam()), 2, false);
}

INSTANTIATE_TEST_SUITE_P(MirrorImages, Orders, testing::Values(1, 2));

TEST(MirrorImages, ThePlateOfTheFiguresIsNoWorseThanWithout) {
  const CadModel model = model_of(flat_plate());
  MeshOptions options = symmetric(3);
  const ShellMesh mesh = mesh_of(model, options);
  const QualitySummary found = quality(mesh);
  EXPECT_GE(found.q_mean, 0.945);
  EXPECT_GE(found.q_min, 0.65);
  EXPECT_EQ(irregular_inside(mesh), 16);
}

TEST(MirrorImages, FacesKeepTheirOuterSides) {
  const CadModel model = model_of(plate({{10, 15}, {30, 15}}));
  const ShellMesh mesh = mesh_of(model, symmetric(2));
  ASSERT_EQ(mesh.symmetry.planes.size(), 3U);
  expect_normals(model, mesh, symmetric(2));
}

TEST(MirrorImages, AShellWhoseHalvesAreTurnedApart) {
  // Two squares that face opposite ways: the mirror image of one is the other turned over.
  TopoDS_Compound both;
  BRep_Builder().MakeCompound(both);
  const TopoDS_Face first = BRepBuilderAPI_MakeFace(gp_Pln(gp::Origin(), gp_Dir(0, 0, 1)), 1, 5, 0, 6).Face();
  const TopoDS_Face second =
      BRepBuilderAPI_MakeFace(gp_Pln(gp::Origin(), gp_Dir(0, 0, 1)), -5, -1, 0, 6).Face();
  BRep_Builder().Add(both, first);
  BRep_Builder().Add(both, second.Reversed());
  const CadModel model = model_of(both);
  const ShellMesh mesh = mesh_of(model, symmetric(1));
  ASSERT_EQ(mesh.symmetry.planes.size(), 2U);
  expect_normals(model, mesh, symmetric(1));
}

TEST(MirrorImages, PartsThatTouchStayApart) {
  // Two boxes with a face on each other: the planes cut both along the same lines.
  TopoDS_Compound both;
  BRep_Builder().MakeCompound(both);
  BRep_Builder().Add(both, BRepPrimAPI_MakeBox(gp_Pnt(0, 0, 0), 8, 6, 2).Shape());
  BRep_Builder().Add(both, BRepPrimAPI_MakeBox(gp_Pnt(0, 0, 2), 8, 6, 3).Shape());
  const CadModel model = model_of(both);
  const ShellMesh mesh = mesh_of(model, symmetric(1));
  ASSERT_EQ(mesh.symmetry.planes.size(), 2U);
  for (const MirrorPlane& plane : planes_of(model)) expect_own_image(mesh, plane, model.diagonal());
  std::map<int, int> box_of;  // by node
  for (std::size_t i = 0; i < mesh.quads.size(); ++i) {
    const int box = mesh.quad_faces[i] <= 6 ? 1 : 2;
    for (const int node : mesh.quads[i]) EXPECT_EQ(box_of.emplace(node, box).first->second, box);
  }
}

TEST(MirrorImages, TroubleModels) {
  int found = 0;
  for (const TroubleModel& trouble : trouble_models()) {
    SCOPED_TRACE(trouble.name);
    const CadModel model = model_of(trouble.make());
    const double diagonal = trouble.diagonal > 0 ? trouble.diagonal : model.diagonal();
    MeshOptions plain = symmetric(diagonal / 20);
    plain.symmetry = false;
    const ShellMesh mesh = mesh_of(model, symmetric(diagonal / 20)), other = mesh_of(model, plain);
    EXPECT_EQ(joined(but_coincidence(validate(mesh, trouble.closed))),
              joined(but_coincidence(validate(other, trouble.closed))));
    EXPECT_EQ(entities(mesh), entities(other));
    found += mesh.symmetry.planes.empty() ? 0 : 1;
  }
  EXPECT_GE(found, 3);
}

/// Of real parts; the folder lies beside the project.
TEST(MirrorImages, RealParts) {
  const std::filesystem::path shared = std::filesystem::path(QUADRILLE_SOURCE_DIR) / ".." / "shared";
  if (!std::filesystem::exists(shared)) GTEST_SKIP() << shared << " is not there";
  const std::pair<const char*, std::size_t> parts[] = {{"corpus_parts/as1_pe_203.stp", 2},
                                                       {"corpus_parts/dm1-pe-214.stp", 1},
                                                       {"corpus/Angled.step", 1},
                                                       {"corpus/as1-tu-203.stp", 2},
                                                       {"corpus/cylinder.brep", 3},
                                                       {"corpus/full_sphere.brep", 3},
                                                       {"corpus/rod.brep", 3},
                                                       {"corpus/tank.brep", 1},
                                                       {"corpus/sewfaces.step", 1},
                                                       {"corpus/component8.step", 0}};
  for (const auto& [file, planes] : parts) {
    SCOPED_TRACE(file);
    const CadModel model = CadModel::read(shared / file);
    for (const int order : {1, 2}) {
      const double size = model.diagonal() / 40;
      const ShellMesh mesh = mesh_of(model, symmetric(size, order));
      EXPECT_EQ(mesh.symmetry.planes.size(), planes) << mesh.symmetry.note;
      for (const MirrorPlane& plane : planes_of(model)) expect_own_image(mesh, plane, model.diagonal());
      MeshOptions plain = symmetric(size, order);
      plain.symmetry = false;
      const ShellMesh other = mesh_of(model, plain);
      EXPECT_EQ(joined(but_coincidence(validate(mesh))), joined(but_coincidence(validate(other))));
      EXPECT_EQ(entities(mesh), entities(other));
    }
  }
}

TEST(MirrorImages, SizesThatAreNotSymmetricTurnItOff) {
  const CadModel model = model_of(BRepPrimAPI_MakeBox(3, 2, 1).Shape());
  MeshOptions options = symmetric(0.3);
  options.sizing.face_sizes[1] = 0.1;  // at x = 0
  const ShellMesh one = mesh_of(model, options);
  EXPECT_EQ(one.symmetry.planes.size(), 2U);
  EXPECT_NE(one.symmetry.note.find("x = 1.5"), std::string::npos);
  options.sizing.face_sizes[2] = 0.1;  // at x = 3
  expect_symmetric(model, options, 3, true);
  options.sizing.regions.push_back({SizeRegion::Shape::sphere, {0, 0, 0}, {0, 0, 0}, 0.5, 0.1, 0});
  const ShellMesh none = mesh_of(model, options);
  EXPECT_TRUE(none.symmetry.planes.empty());
  EXPECT_NE(none.symmetry.note.find("size_in"), std::string::npos);
}

TEST(MirrorImages, SomeFacesOfTheModel) {
  const CadModel model = model_of(BRepPrimAPI_MakeBox(3, 2, 1).Shape());
  MeshOptions options = symmetric(0.3);
  options.faces = {1};
  const ShellMesh one = mesh_of(model, options);
  EXPECT_EQ(one.symmetry.planes.size(), 2U);
  EXPECT_EQ(joined(validate(one)), "");
  EXPECT_EQ(numbers(one.quad_faces, [](int face) { return face; }), std::set<int>{1});
}

TEST(MirrorImages, DoNotDependOnTheThreads) {
  const CadModel model = model_of(plate({{10, 8}, {30, 8}}));
  const ShellMesh a = mesh_of(model, symmetric(2), 1), b = mesh_of(model, symmetric(2), 2);
  EXPECT_EQ(a.points, b.points);
  EXPECT_EQ(a.quads, b.quads);
}

TEST(MirrorImages, SampleModels) {
  int found = 0;
  for (const SampleModel& sample : sample_models()) {
    SCOPED_TRACE(sample.name);
    const CadModel model = CadModel::read(sample.path());
    const ShellMesh mesh = mesh_of(model, symmetric(model.diagonal() / 25));
    EXPECT_EQ(joined(validate(mesh, sample.closed)), "");
    EXPECT_EQ(static_cast<int>(mesh.corners.size()), sample.vertices);
    EXPECT_EQ(static_cast<int>(numbers(mesh.quad_faces, [](int face) { return face; }).size()), sample.faces);
    found += mesh.symmetry.planes.empty() ? 0 : 1;
  }
  EXPECT_GE(found, 3);
}

}  // namespace
}  // namespace quadrille
