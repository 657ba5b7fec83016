/// Names of faces and parts in a STEP file become groups of the mesh, in every format that has groups.

#include "geometry/cad/face_names.hpp"

#include <gtest/gtest.h>

#include <BRepPrimAPI_MakeBox.hxx>
#include <BRep_Builder.hxx>
#include <Interface_Static.hxx>
#include <STEPConstruct.hxx>
#include <STEPControl_Controller.hxx>
#include <STEPControl_Writer.hxx>
#include <StepBasic_Product.hxx>
#include <StepData_StepModel.hxx>
#include <StepRepr_RepresentationItem.hxx>
#include <TCollection_HAsciiString.hxx>
#include <TopExp.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS_Compound.hxx>
#include <Transfer_FinderProcess.hxx>
#include <XSControl_TransferWriter.hxx>
#include <XSControl_WorkSession.hxx>
#include <algorithm>

#include "mesher/quadrille.hpp"
#include "tests/support/process.hpp"

namespace quadrille {
namespace {

constexpr ReadOptions isolated{true, nullptr};
const std::string part_name = "L\xc3\xa4ngstr\xc3\xa4ger";

/// Writes a shape whose faces have these names, in the order of its faces.
void write_named(const TopoDS_Shape& shape, const std::vector<const char*>& names,
                 const std::filesystem::path& file) {
  STEPControl_Controller::Init();
  Interface_Static::SetCVal("write.step.unit", "MM");
  STEPControl_Writer writer;
  ASSERT_EQ(writer.Transfer(shape, STEPControl_AsIs), IFSelect_RetDone);
  TopTools_IndexedMapOfShape faces;
  TopExp::MapShapes(shape, TopAbs_FACE, faces);
  for (std::size_t i = 0; i < names.size(); ++i)
    STEPConstruct::FindEntity(writer.WS()->TransferWriter()->FinderProcess(), faces(static_cast<int>(i) + 1))
        ->SetName(new TCollection_HAsciiString(names[i]));
  const Handle(StepData_StepModel) model = writer.Model();
  for (int i = 1; i <= model->NbEntities(); ++i)
    if (const auto part = Handle(StepBasic_Product)::DownCast(model->Value(i)))
      part->SetName(new TCollection_HAsciiString(part_name.c_str()));
  ASSERT_EQ(writer.Write(file.c_str()), IFSelect_RetDone);
}

/// A sheet of 40 by 30 by 2; the last two faces, the large ones, share a name.
void write_sheet(const std::filesystem::path& file) {
  write_named(BRepPrimAPI_MakeBox(40, 30, 2).Shape(),
              {"In\"let, cold", "NONE", "face7", " 12", "skin", "skin"}, file);
}

const FaceNames names_of_sheet{
    {"CAD_face7", {3}}, {"In_let, cold", {1}}, {part_name, {1, 2, 3, 4, 5, 6}}, {"skin", {5, 6}}};

/// The area of each group of faces.
std::map<std::string, double> areas_of(const ShellMesh& mesh, const std::vector<ShellMesh::Group>& groups) {
  std::map<std::string, double> result;
  for (const ShellMesh::Group& group : groups)
    for (std::size_t i = 0; group.dimension == 2 && i < mesh.quads.size(); ++i)
      if (std::binary_search(group.entities.begin(), group.entities.end(), mesh.quad_faces[i])) {
        const auto& [a, b, c, d] = mesh.quads[i];
        result[group.name] +=
            0.5 * (mesh.points[c] - mesh.points[a]).cross(mesh.points[d] - mesh.points[b]).norm();
      }
  return result;
}

ShellMesh meshed(const CadModel& model) {
  MeshOptions options;
  options.sizing.size = 5;
  ExecutionContext context(1);
  return mesh(model, options, context);
}

TEST(FaceNames, AreReadHereAndInAChild) {
  const test::TemporaryFolder folder;
  write_sheet(folder / "sheet.step");
  EXPECT_EQ(CadModel::read(folder / "sheet.step").face_names(), names_of_sheet);
  EXPECT_EQ(CadModel::read(folder / "sheet.step", isolated).face_names(), names_of_sheet);
}

TEST(FaceNames, LeavesOutWhatSaysNothing) {
  const FaceNames read{{"", {1}},
                       {"#12", {1}},
                       {"None", {2}},
                       {"Open CASCADE STEP translator 7.6 1", {1, 2}},
                       {std::string(81, 'x'), {1}},
                       {std::string(80, 'y'), {2}},
                       {"Thickness2.5", {2}},
                       {"two\nlines ", {1}},
                       {"two_lines", {2}}};
  const FaceNames kept{{"CAD_Thickness2.5", {2}}, {"two_lines", {1, 2}}, {std::string(80, 'y'), {2}}};
  EXPECT_EQ(names_of_groups(read), kept);
  EXPECT_EQ(names_of_groups(kept), kept);
}

TEST(FaceNames, StayWithTheFacesOfJoinedParts) {
  const test::TemporaryFolder folder;
  TopoDS_Compound parts;
  const BRep_Builder builder;
  builder.MakeCompound(parts);
  builder.Add(parts, BRepPrimAPI_MakeBox(10, 10, 10).Shape());
  builder.Add(parts, BRepPrimAPI_MakeBox(gp_Pnt(10, 2, 2), 5, 6, 6).Shape());
  write_named(parts, {"back", "contact"}, folder / "parts.step");
  const CadModel model = CadModel::read(folder / "parts.step");
  const auto area = [](const CadModel& of, const char* name) {
    const ShellMesh mesh = meshed(of);
    return areas_of(mesh, mesh.extra_groups)[name];
  };
  for (const CadModel& joined : {model, model.imprinted(), model.sewn(0.01), model.imprinted().sewn(0.01)}) {
    EXPECT_NEAR(area(joined, "back"), 100, 1e-9);
    EXPECT_NEAR(area(joined, "contact"), 100, 1e-9);
  }
  EXPECT_EQ(model.face_names().at("contact").size(), 1U);
  EXPECT_EQ(model.imprinted().face_names().at("contact").size(), 2U);
}

TEST(FaceNames, AreGroupsOfFiles) {
  const test::TemporaryFolder folder;
  write_sheet(folder / "sheet.step");
  const ShellMesh mesh = meshed(CadModel::read(folder / "sheet.step"));
  const double all = 2 * (40 * 30 + 40 * 2 + 30 * 2);
  const auto expected = [&](const char* cold) {
    return std::map<std::string, double>{
        {"CAD_face7", 40 * 2}, {cold, 30 * 2}, {part_name, all}, {"skin", 2 * 40 * 30}};
  };
  WriteOptions options;
  options.msh_version = MshVersion::v4_1;
  for (const double scale : {1.0, 0.001})
    for (const char* ending : {".msh", ".inp", ".vtk", ".vtu"}) {
      SCOPED_TRACE(ending);
      options.scale = scale;
      write_mesh(mesh, folder / (std::string("a") + ending), options);
      const ShellMesh read = read_mesh(folder / (std::string("a") + ending));
      const auto found = areas_of(read, read.groups);
      for (const auto& [name, area] :
           expected(ending == std::string(".inp") ? "In_let__cold" : "In_let, cold")) {
        ASSERT_TRUE(found.contains(name)) << name;
        EXPECT_NEAR(found.at(name), area * scale * scale, 1e-9 * area * scale * scale) << name;
      }
    }
}

TEST(FaceNames, AreOnMiddleSurfaces) {
  const test::TemporaryFolder folder;
  write_sheet(folder / "sheet.step");
  ExecutionContext context(1);
  MeshOptions options;
  options.sizing.size = 5;
  const ShellMesh shell =
      mesh(midsurface(CadModel::read(folder / "sheet.step"), {}, context), options, context);
  const auto found = areas_of(shell, shell.extra_groups);
  for (const std::string& name : {std::string("skin"), part_name}) EXPECT_NEAR(found.at(name), 40 * 30, 1e-6);
  const auto& groups = shell.extra_groups;
  const auto rim = std::find_if(groups.begin(), groups.end(),
                                [](const ShellMesh::Group& group) { return group.name == "CAD_face7Rim"; });
  ASSERT_NE(rim, groups.end());
  EXPECT_EQ(rim->dimension, 1);
  EXPECT_EQ(rim->entities.size(), 1U);
  WriteOptions meters;
  meters.scale = 0.001;
  write_mesh(shell, folder / "a.inp", meters);
  EXPECT_NE(test::file_text(folder / "a.inp").find("MATERIAL=Material\n0.002\n"), std::string::npos);
}

}  // namespace
}  // namespace quadrille
