/// The module libquadrille_step.so: reads and writes STEP.

#include <Interface_InterfaceModel.hxx>
#include <STEPControl_Reader.hxx>
#include <STEPControl_Writer.hxx>
#include <StepBasic_Product.hxx>
#include <StepBasic_ProductDefinition.hxx>
#include <StepBasic_ProductDefinitionFormation.hxx>
#include <StepData_Protocol.hxx>
#include <StepData_StepModel.hxx>
#include <StepData_StepWriter.hxx>
#include <StepRepr_RepresentationItem.hxx>
#include <TCollection_HAsciiString.hxx>
#include <TransferBRep.hxx>
#include <Transfer_TransientProcess.hxx>
#include <XSControl_TransferReader.hxx>
#include <XSControl_WorkSession.hxx>
#include <unordered_map>
#include <vector>

#include "geometry/cad/readers/transfer.hpp"

namespace {

/// The name of a part, solid, face or other item of a shape; null for other entities.
Handle(TCollection_HAsciiString) name_of(const Handle(Standard_Transient) & entity) {
  if (const auto item = Handle(StepRepr_RepresentationItem)::DownCast(entity)) return item->Name();
  const auto part = Handle(StepBasic_ProductDefinition)::DownCast(entity);
  if (part.IsNull() || part->Formation().IsNull() || part->Formation()->OfProduct().IsNull()) return {};
  return part->Formation()->OfProduct()->Name();
}

/// Parts of an assembly that are the same have the same faces in other places, and so the same names.
quadrille::FaceNames face_names(const STEPControl_Reader& reader, const TopoDS_Shape& shape) {
  const TopTools_IndexedMapOfShape faces = quadrille::map_of(shape, TopAbs_FACE);
  std::unordered_map<const TopoDS_TShape*, std::vector<int>> numbers;
  for (int i = 1; i <= faces.Extent(); ++i) numbers[faces(i).TShape().get()].push_back(i);
  const Handle(Transfer_TransientProcess) process = reader.WS()->TransferReader()->TransientProcess();
  const Handle(Interface_InterfaceModel) model = reader.WS()->Model();
  quadrille::FaceNames names;
  for (int i = 1; i <= model->NbEntities(); ++i) {
    const auto name = name_of(model->Value(i));
    if (name.IsNull() || name->IsEmpty()) continue;
    const TopoDS_Shape made = TransferBRep::ShapeResult(process, model->Value(i));
    for (TopExp_Explorer face(made, TopAbs_FACE); face.More(); face.Next())
      if (const auto found = numbers.find(face.Current().TShape().get()); found != numbers.end())
        names[name->ToCString()].insert(found->second.begin(), found->second.end());
  }
  return names;
}

}  // namespace

QUADRILLE_EXPORT const char* quadrille_step_version() {
  return QUADRILLE_VERSION;
}

QUADRILLE_EXPORT std::string quadrille_step_read(const std::string& path, quadrille::NamedShape& read) {
  return quadrille::transfer<STEPControl_Reader>(path, "STEP", read, face_names);
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
