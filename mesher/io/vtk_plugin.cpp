/// The module libquadrille_vtk.so: writes meshes and sizes as .vtu with VTK; vtk_import.cpp reads. See
/// modules.hpp.

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkStringArray.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <algorithm>
#include <array>
#include <exception>
#include <limits>

#include "geometry/base/error.hpp"
#include "geometry/base/module_loader.hpp"
#include "mesher/io/modules.hpp"

namespace quadrille {

namespace {

/// Makes a VTK grid of a mesh: shell elements, then lines, then points, each with its CAD numbers.
class GridMaker {
 public:
  explicit GridMaker(const OutputMesh& mesh) : mesh_(mesh) {
    constexpr const char* names[] = {"vertex", "edge", "face"};
    for (int dimension = 0; dimension < 3; ++dimension) cad_[dimension]->SetName(names[dimension]);
    q_->SetName("q");
    thickness_->SetName("thickness");
  }

  vtkNew<vtkUnstructuredGrid> make(const std::vector<double>& qualities) {
    for (const int dimension : {2, 1, 0})
      for (int i = 0; i < mesh_.count(dimension); ++i) {
        add(mesh_.element_nodes(dimension, i), mesh_.entity(dimension, i));
        // Lines and points have no q: colored by q, they get the color of "not a number".
        const bool shell = dimension == 2;
        q_->InsertNextValue(!shell             ? std::numeric_limits<double>::quiet_NaN()
                            : mesh_.is_quad(i) ? qualities[i]
                                               : 0);
        thickness_->InsertNextValue(shell ? mean_thickness(mesh_, i) : 0);
      }
    vtkNew<vtkUnstructuredGrid> grid;
    grid->SetPoints(points());
    grid->SetCells(types_, cells_);
    for (const int dimension : {2, 1, 0}) grid->GetCellData()->AddArray(cad_[dimension]);
    grid->GetCellData()->AddArray(q_);
    if (!mesh_.thicknesses().empty()) grid->GetCellData()->AddArray(thickness_);
    for (const std::string& name : mesh_.set_names()) grid->GetCellData()->AddArray(set_of(name));
    return grid;
  }

 private:
  /// 1 for the cells in a set, 0 for others.
  vtkNew<vtkUnsignedCharArray> set_of(const std::string& name) const {
    vtkNew<vtkUnsignedCharArray> set;
    set->SetName(array_of_set(name).c_str());
    for (const int dimension : {2, 1, 0})
      for (const char member : mesh_.is_in_set(dimension, name)) set->InsertNextValue(member);
    return set;
  }

  void add(const ElementNodes& nodes, int number) {
    std::array<vtkIdType, 9> ids;
    std::transform(nodes.begin(), nodes.end(), ids.begin(), [&](int node) { return mesh_.number(node) - 1; });
    cells_->InsertNextCell(nodes.count, ids.data());
    types_->InsertNextValue(static_cast<unsigned char>(nodes.type().vtk));
    for (int i = 0; i < 3; ++i) cad_[i]->InsertNextValue(i == nodes.dimension ? number : 0);
  }

  vtkNew<vtkPoints> points() const {
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    points->SetNumberOfPoints(static_cast<vtkIdType>(mesh_.nodes().size()));
    for (std::size_t i = 0; i < mesh_.nodes().size(); ++i)
      points->SetPoint(static_cast<vtkIdType>(i), mesh_.point(static_cast<int>(i)).data());
    return points;
  }

  const OutputMesh& mesh_;
  vtkNew<vtkCellArray> cells_;
  vtkNew<vtkUnsignedCharArray> types_;
  vtkNew<vtkIntArray> cad_[3];  ///< by dimension: the number of the CAD entity, 0 for other cells
  vtkNew<vtkDoubleArray> q_, thickness_;
};

/// The grid: triangles, then lines, with their CAD numbers; sizes and sources at points; the sources' names.
vtkNew<vtkUnstructuredGrid> sizes_grid(const SizeMap& map) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkDoubleArray> sizes, along;
  vtkNew<vtkIntArray> sources, faces, edges;
  vtkNew<vtkStringArray> names;
  sizes->SetName("size");
  along->SetName("size_along");
  sources->SetName("source");
  faces->SetName("face");
  edges->SetName("edge");
  names->SetName("sources");
  for (const Vector3& point : map.points) points->InsertNextPoint(point.data());
  for (const double size : map.sizes) sizes->InsertNextValue(size);
  for (const double size : map.along) along->InsertNextValue(size);
  for (const int source : map.rulers) sources->InsertNextValue(source);
  for (const SizeMap::Source& source : map.sources) names->InsertNextValue(source.name);
  vtkNew<vtkCellArray> cells;
  vtkNew<vtkUnsignedCharArray> types;
  const auto add = [&](const auto& nodes, int type, int face, int edge) {
    cells->InsertNextCell(static_cast<int>(nodes.size()));
    for (const int node : nodes) cells->InsertCellPoint(node);
    types->InsertNextValue(static_cast<unsigned char>(type));
    faces->InsertNextValue(face);
    edges->InsertNextValue(edge);
  };
  for (std::size_t i = 0; i < map.triangles.size(); ++i) add(map.triangles[i], VTK_TRIANGLE, map.faces[i], 0);
  for (const SizeMap::Line& line : map.lines) add(line.points, VTK_LINE, 0, line.edge);
  vtkNew<vtkUnstructuredGrid> grid;
  grid->SetPoints(points);
  grid->SetCells(types, cells);
  grid->GetPointData()->AddArray(sizes);
  grid->GetPointData()->AddArray(along);
  grid->GetPointData()->AddArray(sources);
  grid->GetCellData()->AddArray(faces);
  grid->GetCellData()->AddArray(edges);
  grid->GetFieldData()->AddArray(names);
  return grid;
}

std::string vtu_bytes(vtkUnstructuredGrid* grid) {
  vtkNew<vtkXMLUnstructuredGridWriter> writer;
  writer->SetInputData(grid);
  writer->WriteToOutputStringOn();
  writer->SetDataModeToBinary();  // base64 inside valid XML
  return writer->Write() == 1 ? writer->GetOutputString() : std::string();
}

}  // namespace

}  // namespace quadrille

QUADRILLE_EXPORT const char* quadrille_vtk_version() {
  return QUADRILLE_VERSION;
}

QUADRILLE_EXPORT std::string quadrille_vtk_file(const quadrille::OutputMesh& mesh,
                                                const std::vector<double>& qualities,
                                                std::string& bytes) try {
  bytes = quadrille::vtu_bytes(quadrille::GridMaker(mesh).make(qualities));
  return bytes.empty() ? "VTK could not write the mesh" : "";
} catch (const std::exception& error) {
  return quadrille::sentence_of(error);
}

QUADRILLE_EXPORT std::string quadrille_vtk_sizes(const quadrille::SizeMap& map, std::string& bytes) try {
  bytes = quadrille::vtu_bytes(quadrille::sizes_grid(map));
  return bytes.empty() ? "VTK could not write the sizes" : "";
} catch (const std::exception& error) {
  return quadrille::sentence_of(error);
}
