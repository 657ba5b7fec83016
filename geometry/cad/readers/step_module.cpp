/// The module libquadrille_step.so: reads and writes STEP.

#include <STEPControl_Reader.hxx>
#include <STEPControl_Writer.hxx>
#include <StepData_Protocol.hxx>
#include <StepData_StepModel.hxx>
#include <StepData_StepWriter.hxx>

#include "geometry/cad/readers/transfer.hpp"

QUADRILLE_EXPORT const char* quadrille_step_version() {
  return QUADRILLE_VERSION;
}

QUADRILLE_EXPORT std::string quadrille_step_read(const std::string& path, TopoDS_Shape& shape) {
  return quadrille::transfer<STEPControl_Reader>(path, "STEP", shape);
}

QUADRILLE_EXPORT std::string quadrille_step_write(const TopoDS_Shape& shape, std::ostream& out) {
  try {
    STEPControl_Writer writer;
    Interface_Static::SetCVal("write.step.unit", "MM");
    if (writer.Transfer(shape, STEPControl_AsIs) != IFSelect_RetDone) return "OpenCASCADE refused the shape";
    const Handle(StepData_StepModel) model = writer.Model();
    StepData_StepWriter text(model);
    text.SendModel(Handle(StepData_Protocol)::DownCast(model->Protocol()));
    return text.Print(out) ? "" : "OpenCASCADE could not print the model";
  } catch (const Standard_Failure& problem) {
    return problem.GetMessageString();
  }
}
