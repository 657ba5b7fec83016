/// Part of the module libquadrille_vtk.so: meshes in the formats that VTK reads. See modules.hpp.

#include <fmt/format.h>
#include <vtkAlgorithm.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkDataSet.h>
#include <vtkDataSetReader.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkOBJReader.h>
#include <vtkObjectFactory.h>
#include <vtkOutputWindow.h>
#include <vtkPLYReader.h>
#include <vtkPointData.h>
#include <vtkSTLReader.h>
#include <vtkSmartPointer.h>
#include <vtkUnsignedCharArray.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <algorithm>
#include <array>
#include <boost/scope_exit.hpp>
#include <cstring>
#include <exception>
#include <initializer_list>
#include <limits>
#include <span>

#include "geometry/base/error.hpp"
#include "geometry/base/module_loader.hpp"
#include "mesher/io/modules.hpp"

namespace quadrille {

namespace {

/// Keeps the first complaint, of the reader itself or of one that it uses, in place of printing it.
class Complaints : public vtkOutputWindow {
 public:
  static Complaints* New() { VTK_STANDARD_NEW_BODY(Complaints); }
  vtkTypeMacro(Complaints, vtkOutputWindow);
  void DisplayText(const char*) override {}
  void DisplayErrorText(const char* text) override { keep(text); }
  void DisplayGenericWarningText(const char* text) override { keep(text); }
  void DisplayWarningText(const char*) override {}
  const std::string& first() const { return first_; }

 private:
  void keep(const char* text) {
    if (first_.empty() && text != nullptr) first_ = text;
  }
  std::string first_;
};

/// VTK's messages have several lines. The first names the source, the last says what is wrong.
std::string last_line(std::string text) {
  text.resize(text.find_last_not_of("\n ") + 1);
  text.erase(0, text.find_last_of('\n') + 1);
  // "vtkSTLReader (0x55d0): what is wrong"
  const std::size_t source = text.find("): ");
  return source == std::string::npos ? text : text.substr(source + 3);
}

template <class Reader>
vtkSmartPointer<vtkDataSet> read_with(Reader* reader, const std::string& path) {
  const vtkNew<Complaints> complaints;
  vtkOutputWindow::SetInstance(complaints);
  BOOST_SCOPE_EXIT_ALL(&) {
    vtkOutputWindow::SetInstance(nullptr);
  };
  vtkObject::GlobalWarningDisplayOn();  // VTK makes no texts otherwise
  reader->SetFileName(path.c_str());
  reader->Update();
  vtkSmartPointer<vtkDataSet> mesh = vtkDataSet::SafeDownCast(reader->GetOutputDataObject(0));
  const std::string& problem = complaints->first();
  if (!problem.empty() || reader->GetErrorCode() != 0 || mesh == nullptr)
    throw failure(path, problem.empty() ? "VTK could not read it" : last_line(problem));
  if (mesh->GetNumberOfPoints() <= 0 || mesh->GetNumberOfCells() <= 0)
    throw failure(path, "it holds no elements");
  return mesh;
}

vtkSmartPointer<vtkDataSet> read_data_set(const std::string& path, const std::string& ending) {
  if (ending == ".stl") {
    const vtkNew<vtkSTLReader> reader;
    reader->ScalarTagsOn();
    return read_with(reader.Get(), path);
  }
  if (ending == ".obj") return read_with(vtkNew<vtkOBJReader>().Get(), path);
  if (ending == ".ply") return read_with(vtkNew<vtkPLYReader>().Get(), path);
  if (ending == ".vtu") return read_with(vtkNew<vtkXMLUnstructuredGridReader>().Get(), path);
  if (ending == ".vtp") return read_with(vtkNew<vtkXMLPolyDataReader>().Get(), path);
  const vtkNew<vtkDataSetReader> reader;
  reader->ReadAllScalarsOn();
  return read_with(reader.Get(), path);
}

std::vector<Vector3> points_of(vtkDataSet* mesh) {
  std::vector<Vector3> points(static_cast<std::size_t>(mesh->GetNumberOfPoints()));
  for (std::size_t i = 0; i < points.size(); ++i) mesh->GetPoint(static_cast<vtkIdType>(i), points[i].data());
  return points;
}

/// The array with the CAD entity of each cell of a dimension, in our files or those of others; or null.
vtkDataArray* entity_array(vtkDataSet* mesh, int dimension) {
  constexpr const char* own[] = {"vertex", "edge", "face"};
  constexpr const char* others[] = {"CellEntityIds", "gmsh:geometrical", "STLSolidLabeling"};
  vtkCellData* data = mesh->GetCellData();
  vtkDataArray* array = data->GetArray(own[dimension]);
  for (const char* name : others)
    if (array == nullptr) array = data->GetArray(name);
  return array != nullptr && array->GetNumberOfComponents() == 1 ? array : nullptr;
}

/// Arrays of bytes that are all 0 or 1 are sets.
std::vector<vtkUnsignedCharArray*> sets_in(vtkDataSetAttributes* data) {
  std::vector<vtkUnsignedCharArray*> sets;
  for (int i = 0; i < data->GetNumberOfArrays(); ++i) {
    auto* array = vtkUnsignedCharArray::SafeDownCast(data->GetArray(i));
    if (array == nullptr || array->GetNumberOfComponents() != 1 || array->GetName() == nullptr) continue;
    if (std::string_view(array->GetName()).substr(0, 3) == "vtk") continue;
    const unsigned char *values = array->GetPointer(0), *end = values + array->GetNumberOfTuples();
    if (std::all_of(values, end, [](unsigned char value) { return value <= 1; })) sets.push_back(array);
  }
  return sets;
}

/// Stores the name of a set; returns its index.
std::int64_t place_of_name(const char* name, ImportedMesh& result) {
  const auto place = std::count(result.set_names.begin(), result.set_names.end(), '\0');
  result.set_names.insert(result.set_names.end(), name, name + std::strlen(name) + 1);
  return place;
}

void import_node_sets(vtkDataSet* mesh, ImportedMesh& result) {
  for (vtkUnsignedCharArray* set : sets_in(mesh->GetPointData())) {
    const std::int64_t place = place_of_name(set->GetName(), result);
    for (vtkIdType point = 0; point < set->GetNumberOfTuples(); ++point)
      if (set->GetValue(point) == 1) result.node_in_set.push_back({point, place});
  }
}

class CellImport {
 public:
  CellImport(vtkDataSet* mesh, ImportedMesh& result) : mesh_(mesh), result_(result) {
    for (int dimension = 0; dimension < 3; ++dimension) arrays_[dimension] = entity_array(mesh, dimension);
    for (vtkUnsignedCharArray* set : sets_in(mesh->GetCellData()))
      sets_.emplace_back(set, place_of_name(set->GetName(), result));
  }

  void add(vtkIdType cell) {
    const int type = mesh_->GetCellType(cell);
    mesh_->GetCellPoints(cell, nodes_);
    const auto count = static_cast<int>(nodes_->GetNumberOfIds());
    switch (type) {
      case VTK_EMPTY_CELL:
        return;
      case VTK_POLY_LINE:
        for (int i = 1; i < count; ++i) add(cell, ElementShape::line, {i - 1, i});
        return;
      case VTK_TRIANGLE_STRIP:
        for (int i = 2; i < count; ++i)
          add(cell, ElementShape::triangle, {i - 2, i % 2 == 0 ? i - 1 : i, i % 2 == 0 ? i : i - 1});
        return;
      case VTK_PIXEL:
        return add(cell, ElementShape::quad, {0, 1, 3, 2});
      case VTK_POLYGON:
        if (count == 3) return add(cell, ElementShape::triangle, {0, 1, 2});
        if (count == 4) return add(cell, ElementShape::quad, {0, 1, 2, 3});
        throw bad(cell,
                  fmt::format("is a polygon with {} corners: only triangles and quads are read", count));
      default:
        if (const ElementType* known = find_element_type(&ElementType::vtk, type))
          return add(cell, known->shape, std::span(in_order).first(known->kept_nodes()));
        throw bad(cell,
                  fmt::format("is of VTK's type {}: only triangles, quads, lines and points are read", type));
    }
  }

 private:
  static constexpr std::array<int, 8> in_order{0, 1, 2, 3, 4, 5, 6, 7};

  static Error bad(vtkIdType cell, const std::string& what) {
    return failure("", fmt::format("cell {} (counted from 0) {}", cell, what));
  }

  void add(vtkIdType cell, ElementShape shape, std::initializer_list<int> places) {
    add(cell, shape, std::span(places.begin(), places.size()));
  }
  void add(vtkIdType cell, ElementShape shape, std::span<const int> places) {
    FileElement element;
    element.number = cell + 1;
    element.shape = shape;
    if (vtkDataArray* array = arrays_[dimension_of(shape)]; array != nullptr) {
      const double number = array->GetComponent(cell, 0);
      if (number > 0 && number <= std::numeric_limits<int>::max()) element.cad = static_cast<int>(number);
      // VTK counts solids from 0.
      if (array->GetName() == std::string_view("STLSolidLabeling") && number >= 0 && number < 1e6)
        element.cad = static_cast<int>(number) + 1;
    }
    for (const int place : places) {
      if (place >= nodes_->GetNumberOfIds()) throw bad(cell, "has too few nodes");
      element.nodes[element.node_count++] = nodes_->GetId(place) + 1;
    }
    for (const auto& [set, place] : sets_)
      if (set->GetValue(cell) == 1)
        result_.in_set.push_back({static_cast<std::int64_t>(result_.elements.size()), place});
    result_.elements.push_back(element);
  }

  vtkDataSet* mesh_;
  ImportedMesh& result_;
  vtkNew<vtkIdList> nodes_;
  vtkDataArray* arrays_[3];
  std::vector<std::pair<vtkUnsignedCharArray*, std::int64_t>> sets_;
};

/// The displacements, found by the names that solvers and converters give them.
std::vector<Vector3> displacements_of(vtkDataSet* mesh) {
  vtkDataArray* array = nullptr;
  for (const char* name : {"U", "DISP", "Displacement", "displacement"})
    if (array == nullptr) array = mesh->GetPointData()->GetArray(name);
  if (array == nullptr)
    throw failure("",
                  "there are no displacements: the point array U, DISP, Displacement or displacement is "
                  "wanted");
  if (array->GetNumberOfComponents() != 3)
    throw failure("", fmt::format("the array {} has {} components, not 3", array->GetName(),
                                  array->GetNumberOfComponents()));
  std::vector<Vector3> result(static_cast<std::size_t>(array->GetNumberOfTuples()));
  for (std::size_t i = 0; i < result.size(); ++i) {
    array->GetTuple(static_cast<vtkIdType>(i), result[i].data());
    if (!result[i].allFinite())
      throw failure("", fmt::format("the displacement of point {} (counted from 0) is not finite", i));
  }
  return result;
}

/// A cell with its nodes in the order of .frd files, with the upright sides' midside nodes before the top's.
SolverResult::Element brick_of(vtkDataSet* mesh, vtkIdType cell) {
  using Element = SolverResult::Element;
  const int type = mesh->GetCellType(cell);
  vtkNew<vtkIdList> nodes;
  mesh->GetCellPoints(cell, nodes);
  Element element;
  element.number = static_cast<int>(cell) + 1;
  element.type = type == VTK_HEXAHEDRON             ? Element::eight_nodes
                 : type == VTK_QUADRATIC_HEXAHEDRON ? Element::twenty_nodes
                                                    : 0;
  for (vtkIdType i = 0; i < nodes->GetNumberOfIds(); ++i)
    element.nodes.push_back(static_cast<int>(nodes->GetId(i)));
  if (element.type == Element::twenty_nodes)
    std::rotate(element.nodes.begin() + 12, element.nodes.begin() + 16, element.nodes.end());
  return element;
}

}  // namespace

}  // namespace quadrille

QUADRILLE_EXPORT std::string quadrille_vtk_read(const std::string& path, const std::string& ending,
                                                quadrille::ImportedMesh& mesh) try {
  const vtkSmartPointer<vtkDataSet> read = quadrille::read_data_set(path, ending);
  mesh.points = quadrille::points_of(read);
  quadrille::CellImport cells(read, mesh);
  mesh.elements.reserve(read->GetNumberOfCells());
  for (vtkIdType cell = 0; cell < read->GetNumberOfCells(); ++cell) cells.add(cell);
  quadrille::import_node_sets(read, mesh);
  return {};
} catch (const std::exception& error) {
  return quadrille::sentence_of(error);
}

QUADRILLE_EXPORT std::string quadrille_vtk_result(const std::string& path,
                                                  quadrille::SolverResult& result) try {
  const vtkSmartPointer<vtkDataSet> read = quadrille::read_data_set(path, ".vtu");
  result.points = quadrille::points_of(read);
  for (vtkIdType cell = 0; cell < read->GetNumberOfCells(); ++cell)
    result.elements.push_back(quadrille::brick_of(read, cell));
  result.displacements = quadrille::displacements_of(read);
  return {};
} catch (const std::exception& error) {
  return quadrille::sentence_of(error);
}
