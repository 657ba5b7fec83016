/// The module libquadrille_vtk.so: writes meshes and sizes as .vtu with VTK; vtk_import.cpp reads. See
/// modules.hpp.

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

template <class Array, class Values>
vtkNew<Array> array_of(const char* name, const Values& values) {
  vtkNew<Array> array;
  array->SetName(name);
  for (const auto& value : values) array->InsertNextValue(value);
  return array;
}

/// A grid without cells yet.
template <class Points>
vtkNew<vtkUnstructuredGrid> grid_of(const Points& positions) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const Vector3& position : positions) points->InsertNextPoint(position.data());
  vtkNew<vtkUnstructuredGrid> grid;
  grid->SetPoints(points);
  return grid;
}

/// A VTK grid of a mesh: shell elements, then lines, then points, each with its CAD numbers.
vtkNew<vtkUnstructuredGrid> mesh_grid(const OutputMesh& mesh, const std::vector<double>& qualities) {
  std::vector<int> cad[3];  // by dimension: the number of the CAD entity, 0 for other cells
  std::vector<double> q, thickness;
  std::vector<Vector3> points;
  for (const int node : mesh.nodes()) points.push_back(mesh.position(node));
  vtkNew<vtkUnstructuredGrid> grid = grid_of(points);
  for (const int dimension : {2, 1, 0})
    for (int i = 0; i < mesh.count(dimension); ++i) {
      const ElementNodes nodes = mesh.element_nodes(dimension, i);
      std::array<vtkIdType, 9> ids;
      std::transform(nodes.begin(), nodes.end(), ids.begin(),
                     [&](int node) { return mesh.number(node) - 1; });
      grid->InsertNextCell(nodes.type().vtk, nodes.count, ids.data());
      for (int k = 0; k < 3; ++k) cad[k].push_back(k == dimension ? mesh.entity(dimension, i) : 0);
      // Lines and points have no q: colored by q, they get the color of "not a number".
      const bool shell = dimension == 2;
      q.push_back(!shell ? std::numeric_limits<double>::quiet_NaN() : mesh.is_quad(i) ? qualities[i] : 0);
      thickness.push_back(shell ? mean_thickness(mesh, i) : 0);
    }
  constexpr const char* names[] = {"vertex", "edge", "face"};
  vtkCellData* data = grid->GetCellData();
  for (const int dimension : {2, 1, 0})
    data->AddArray(array_of<vtkIntArray>(names[dimension], cad[dimension]));
  data->AddArray(array_of<vtkDoubleArray>("q", q));
  if (!mesh.thicknesses().empty()) data->AddArray(array_of<vtkDoubleArray>("thickness", thickness));
  for (const std::string& name : mesh.set_names()) {
    std::vector<char> members;
    for (const int dimension : {2, 1, 0}) {
      const std::vector<char> own = mesh.is_in_set(dimension, name);
      members.insert(members.end(), own.begin(), own.end());
    }
    data->AddArray(array_of<vtkUnsignedCharArray>(array_of_set(name).c_str(), members));
  }
  return grid;
}

/// The grid: triangles, then lines, with their CAD numbers; sizes and sources at points; the sources' names.
vtkNew<vtkUnstructuredGrid> sizes_grid(const SizeMap& map) {
  vtkNew<vtkUnstructuredGrid> grid = grid_of(map.points);
  std::vector<int> faces, edges;
  std::vector<std::string> names;
  const auto add = [&](const auto& nodes, int type, int face, int edge) {
    const std::vector<vtkIdType> ids(nodes.begin(), nodes.end());
    grid->InsertNextCell(type, static_cast<vtkIdType>(ids.size()), ids.data());
    faces.push_back(face);
    edges.push_back(edge);
  };
  for (std::size_t i = 0; i < map.triangles.size(); ++i) add(map.triangles[i], VTK_TRIANGLE, map.faces[i], 0);
  for (const SizeMap::Line& line : map.lines) add(line.points, VTK_LINE, 0, line.edge);
  for (const SizeMap::Source& source : map.sources) names.push_back(source.name);
  grid->GetPointData()->AddArray(array_of<vtkDoubleArray>("size", map.sizes));
  grid->GetPointData()->AddArray(array_of<vtkDoubleArray>("size_along", map.along));
  grid->GetPointData()->AddArray(array_of<vtkIntArray>("source", map.rulers));
  grid->GetCellData()->AddArray(array_of<vtkIntArray>("face", faces));
  grid->GetCellData()->AddArray(array_of<vtkIntArray>("edge", edges));
  grid->GetFieldData()->AddArray(array_of<vtkStringArray>("sources", names));
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
  bytes = quadrille::vtu_bytes(quadrille::mesh_grid(mesh, qualities));
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
