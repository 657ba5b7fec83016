/// Boxes and plates that touch, cross, or do neither.

#include "geometry/surfaces/contacts.hpp"

#include <gtest/gtest.h>

#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <gp_Pln.hxx>

#include "geometry/cad/cad_model.hpp"
#include "tests/models/trouble_models.hpp"

namespace quadrille {
namespace {

Contacts contacts_of(const std::vector<TopoDS_Shape>& parts) {
  return contacts(CadShape(compound(parts), "parts"));
}

TopoDS_Shape box(const gp_Pnt& low, const gp_Pnt& high) {
  return BRepPrimAPI_MakeBox(low, high).Shape();
}

TopoDS_Shape rectangle(const gp_Pln& plane, double u0, double u1, double v0, double v1) {
  return BRepBuilderAPI_MakeFace(plane, u0, u1, v0, v1).Face();
}

const gp_Pln flat(gp::Origin(), gp::DZ());

TEST(Contacts, ASolidHasNone) {
  EXPECT_TRUE(contacts_of({box({0, 0, 0}, {10, 10, 10})}).faces.empty());
  EXPECT_EQ(contacts_of({box({0, 0, 0}, {10, 10, 10})}).sentence(), "");
}

TEST(Contacts, BoxesApartHaveNone) {
  EXPECT_TRUE(contacts_of({box({0, 0, 0}, {10, 10, 10}), box({0, 0, 10.1}, {10, 10, 20})}).faces.empty());
}

/// The upper box stands inside the lower one's top, whose edges it does not meet.
TEST(Contacts, BoxesThatTouchInsideAFace) {
  const Contacts found = contacts_of({box({0, 0, 0}, {10, 10, 10}), box({3, 3, 10}, {7, 7, 16})});
  ASSERT_EQ(found.faces.size(), 1u);
  EXPECT_EQ(found.edges, 0);
  EXPECT_FALSE(found.free_edges);
  EXPECT_NE(found.sentence().find("`imprint`"), std::string::npos) << found.sentence();
}

TEST(Contacts, BoxesOfOneSizeLieAlongTheirEdges) {
  const Contacts found = contacts_of({box({0, 0, 0}, {10, 10, 10}), box({0, 0, 10}, {10, 10, 16})});
  EXPECT_EQ(found.faces.size(), 1u);
  EXPECT_EQ(found.edges, 4);
  EXPECT_FALSE(found.free_edges);
}

TEST(Contacts, PlatesThatCross) {
  const Contacts found = contacts_of(
      {rectangle(flat, -10, 10, -10, 10), rectangle(gp_Pln(gp::Origin(), gp::DX()), -10, 10, -10, 10)});
  EXPECT_EQ(found.faces, (std::vector<std::array<int, 2>>{{1, 2}}));
}

/// Free edges are for sewing.
TEST(Contacts, FacesSideBySide) {
  const Contacts found = contacts_of({rectangle(flat, 0, 10, 0, 10), rectangle(flat, 10, 20, 0, 10)});
  EXPECT_EQ(found.edges, 1);
  EXPECT_TRUE(found.free_edges);
  EXPECT_NE(found.sentence().find("`sew`"), std::string::npos) << found.sentence();
}

/// Faces with the same edges are for imprinting: sewing would leave two of them.
TEST(Contacts, FacesOnFaces) {
  const Contacts found = contacts_of({rectangle(flat, 0, 10, 0, 10), rectangle(flat, 0, 10, 0, 10)});
  EXPECT_EQ(found.edges, 4);
  EXPECT_EQ(found.remedy(), "imprint");
}

/// The corner of one plate lies inside the other, which has a vertex there: they share it.
TEST(Contacts, PartsThatShareAnInnerVertexAreOne) {
  const gp_Pln upright(gp_Ax3(gp::Origin(), gp::DY(), gp_Dir(1, 0, 1)));
  const CadModel apart(std::make_shared<CadShape>(
      compound({rectangle(flat, -10, 10, -10, 10), rectangle(upright, 0, 5, -5, 0)}), "plates"));
  EXPECT_EQ(contacts(apart.shape()).faces.size(), 1u);
  EXPECT_TRUE(contacts(apart.imprinted().shape()).faces.empty());
}

/// What was tried is not advised again.
TEST(Contacts, AdvisesNothingTwice) {
  const Contacts found = contacts_of({rectangle(flat, 0, 10, 0, 10), rectangle(flat, 10, 20, 0, 10)});
  EXPECT_NE(found.sentence().find("`sew` joins"), std::string::npos);
  EXPECT_NE(found.sentence({"imprint"}).find("`sew` joins"), std::string::npos);
  const std::string left = found.sentence({"imprint", "sew"});
  EXPECT_EQ(left.find("joins"), std::string::npos) << left;
  EXPECT_NE(left.find("Face1 and Face2"), std::string::npos) << left;
}

}  // namespace
}  // namespace quadrille
