/// Sizes on the surface as .vtu: part of the module libquadrille_vtk.so. See modules.hpp.

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

#include <exception>

#include "geometry/base/error.hpp"
#include "mesher/io/module_export.hpp"
#include "mesher/io/modules.hpp"

namespace quadrille {

namespace {

/// The grid: triangles, then lines, with their CAD numbers; sizes and sources at points; the sources' names.
vtkNew<vtkUnstructuredGrid> grid_of(const SizeMap& map) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkDoubleArray> sizes;
  vtkNew<vtkIntArray> sources, faces, edges;
  vtkNew<vtkStringArray> names;
  sizes->SetName("size");
  sources->SetName("source");
  faces->SetName("face");
  edges->SetName("edge");
  names->SetName("sources");
  for (const Vector3& point : map.points) points->InsertNextPoint(point.data());
  for (const double size : map.sizes) sizes->InsertNextValue(size);
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
  grid->GetPointData()->AddArray(sources);
  grid->GetCellData()->AddArray(faces);
  grid->GetCellData()->AddArray(edges);
  grid->GetFieldData()->AddArray(names);
  return grid;
}

}  // namespace

}  // namespace quadrille

QUADRILLE_EXPORT std::string quadrille_vtk_sizes(const quadrille::SizeMap& map, std::string& bytes) try {
  vtkNew<vtkXMLUnstructuredGridWriter> writer;
  writer->SetInputData(quadrille::grid_of(map));
  writer->WriteToOutputStringOn();
  writer->SetDataModeToBinary();  // base64 inside valid XML
  if (writer->Write() != 1) return "VTK could not write the sizes";
  bytes = writer->GetOutputString();
  return {};
} catch (const std::exception& error) {
  return quadrille::sentence_of(error);
}
