#include "geometry/cad/cad_model.hpp"

#include <gtest/gtest.h>

#include <BRepPrimAPI_MakeBox.hxx>
#include <IGESControl_Controller.hxx>
#include <IGESControl_Writer.hxx>
#include <Interface_Static.hxx>
#include <STEPControl_Controller.hxx>
#include <STEPControl_Writer.hxx>

#include "tests/support/process.hpp"

namespace quadrille {
namespace {

/// A box of 25.4 by 50.8 by 101.6 mm in a file whose lengths are in `unit`.
void write_step(const std::filesystem::path& file, const char* unit) {
  STEPControl_Controller::Init();
  ASSERT_TRUE(Interface_Static::SetCVal("write.step.unit", unit));
  STEPControl_Writer writer;
  writer.Transfer(BRepPrimAPI_MakeBox(25.4, 50.8, 101.6).Shape(), STEPControl_AsIs);
  ASSERT_EQ(writer.Write(file.c_str()), IFSelect_RetDone);
}

void write_iges(const std::filesystem::path& file, const char* unit) {
  IGESControl_Controller::Init();
  IGESControl_Writer writer(unit, 1);
  writer.AddShape(BRepPrimAPI_MakeBox(25.4, 50.8, 101.6).Shape());
  writer.ComputeModel();
  ASSERT_TRUE(writer.Write(file.c_str()));
}

TEST(CadModel, LengthsAreMillimetersWhateverTheFilesUnit) {
  const test::TemporaryFolder folder;
  write_step(folder / "mm.step", "MM");
  write_step(folder / "inch.step", "INCH");
  write_step(folder / "meter.step", "M");
  write_iges(folder / "mm.igs", "MM");
  write_iges(folder / "inch.igs", "INCH");
  write_iges(folder / "meter.igs", "M");
  // The files do differ: an inch is an inch.
  EXPECT_NE(test::file_text(folder / "inch.step").find("INCH"), std::string::npos);
  EXPECT_EQ(test::file_text(folder / "mm.step").find("INCH"), std::string::npos);
  for (const char* name : {"mm.step", "inch.step", "meter.step", "mm.igs", "inch.igs", "meter.igs"}) {
    SCOPED_TRACE(name);
    const CadModel model = CadModel::read(folder / name);
    const Vector3 extent = model.box_max() - model.box_min();
    EXPECT_NEAR(extent.x(), 25.4, 1e-5);
    EXPECT_NEAR(extent.y(), 50.8, 1e-5);
    EXPECT_NEAR(extent.z(), 101.6, 1e-5);
    EXPECT_EQ(model.face_count(), 6);
  }
}

}  // namespace
}  // namespace quadrille
