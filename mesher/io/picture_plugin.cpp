/// The module libquadrille_picture.so: pictures by VTK, which need OpenGL and an X display. See modules.hpp.

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkImageData.h>
#include <vtkIntArray.h>
#include <vtkLookupTable.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkScalarBarActor.h>
#include <vtkTextProperty.h>
#include <vtkUnsignedCharArray.h>
#include <vtkWindowToImageFilter.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <limits>

#include "mesher/io/module_export.hpp"
#include "mesher/io/modules.hpp"
#include "mesher/io/x_display.hpp"

namespace quadrille {

namespace {

vtkNew<vtkPoints> make_points(const ShellMesh& mesh) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(static_cast<vtkIdType>(mesh.points.size()));
  for (std::size_t i = 0; i < mesh.points.size(); ++i)
    points->SetPoint(static_cast<vtkIdType>(i), mesh.points[i].data());
  return points;
}

/// Face and q of each polygon, quads before triangles. A triangle has no q.
void add_cell_data(const ShellMesh& mesh, const std::vector<double>& qualities, vtkCellData* data) {
  vtkNew<vtkIntArray> faces;
  faces->SetName("face");
  vtkNew<vtkDoubleArray> q;
  q->SetName("q");
  for (std::size_t i = 0; i < mesh.quads.size(); ++i) {
    faces->InsertNextValue(i < mesh.quad_faces.size() ? mesh.quad_faces[i] : 0);
    q->InsertNextValue(qualities[i]);
  }
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    faces->InsertNextValue(i < mesh.triangle_faces.size() ? mesh.triangle_faces[i] : 0);
    q->InsertNextValue(0);
  }
  data->AddArray(faces);
  data->AddArray(q);
}

template <std::size_t N>
void add_cell(vtkCellArray* cells, const std::array<int, N>& nodes) {
  std::array<vtkIdType, N> ids;
  std::copy(nodes.begin(), nodes.end(), ids.begin());
  cells->InsertNextCell(static_cast<vtkIdType>(N), ids.data());
}

/// Red (bad) over yellow to blue (good): told apart by the color-blind too.
vtkNew<vtkLookupTable> color_map() {
  constexpr double stops[][4] = {{0.0, 0.65, 0.00, 0.15}, {0.3, 0.91, 0.36, 0.23},  {0.5, 0.99, 0.68, 0.38},
                                 {0.7, 1.00, 0.92, 0.62}, {0.85, 0.80, 0.92, 0.94}, {1.0, 0.42, 0.66, 0.82}};
  constexpr int colors = 256;
  vtkNew<vtkLookupTable> table;
  table->SetNumberOfTableValues(colors);
  table->SetRange(0, 1);
  for (int i = 0; i < colors; ++i) {
    const double value = i / (colors - 1.0);
    int right = 1;
    while (stops[right][0] < value) ++right;
    const double *a = stops[right - 1], *b = stops[right];
    const double t = (value - a[0]) / (b[0] - a[0]);
    table->SetTableValue(i, a[1] + t * (b[1] - a[1]), a[2] + t * (b[2] - a[2]), a[3] + t * (b[3] - a[3]));
  }
  return table;
}

vtkNew<vtkActor> surface_actor(const ShellMesh& mesh, const std::vector<double>& qualities, vtkPoints* points,
                               vtkLookupTable* colors) {
  vtkNew<vtkCellArray> cells;
  for (const auto& quad : mesh.quads) add_cell(cells, quad);
  for (const auto& triangle : mesh.triangles) add_cell(cells, triangle);
  vtkNew<vtkPolyData> surface;
  surface->SetPoints(points);
  surface->SetPolys(cells);
  add_cell_data(mesh, qualities, surface->GetCellData());
  surface->GetCellData()->SetActiveScalars("q");
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(surface);
  mapper->SetLookupTable(colors);
  mapper->UseLookupTableScalarRangeOn();
  // Behind the lines that are drawn on it.
  mapper->SetResolveCoincidentTopologyToPolygonOffset();
  mapper->SetRelativeCoincidentTopologyPolygonOffsetParameters(1.5, 2);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetInterpolationToFlat();
  actor->GetProperty()->SetAmbient(0.55);
  actor->GetProperty()->SetDiffuse(0.5);
  return actor;
}

/// Each side of an element as its two corner nodes, once.
std::vector<std::array<int, 2>> unique_sides(const ShellMesh& mesh) {
  std::vector<std::array<int, 2>> sides;
  const auto add = [&](const auto& nodes) {
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const int a = nodes[i], b = nodes[(i + 1) % nodes.size()];
      sides.push_back({std::min(a, b), std::max(a, b)});
    }
  };
  for (const auto& quad : mesh.quads) add(quad);
  for (const auto& triangle : mesh.triangles) add(triangle);
  std::sort(sides.begin(), sides.end());
  sides.erase(std::unique(sides.begin(), sides.end()), sides.end());
  return sides;
}

vtkNew<vtkActor> line_actor(const std::vector<std::array<int, 2>>& lines, vtkPoints* points, double width,
                            double opacity) {
  vtkNew<vtkCellArray> cells;
  for (const auto& line : lines) add_cell(cells, line);
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetLines(cells);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(data);
  mapper->ScalarVisibilityOff();
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(0.12, 0.14, 0.18);
  actor->GetProperty()->SetLineWidth(static_cast<float>(width));
  actor->GetProperty()->SetOpacity(opacity);
  actor->GetProperty()->LightingOff();
  return actor;
}

vtkNew<vtkScalarBarActor> color_bar(vtkLookupTable* colors, int height) {
  vtkNew<vtkScalarBarActor> bar;
  bar->SetLookupTable(colors);
  bar->SetTitle("q");
  bar->SetNumberOfLabels(6);
  bar->SetLabelFormat("%.1f");
  bar->SetPosition(0.1, 0.2);
  bar->SetWidth(0.6);
  bar->SetHeight(0.6);
  bar->SetMaximumNumberOfColors(256);
  bar->SetVerticalTitleSeparation(height / 100);
  bar->UnconstrainedFontSizeOn();
  for (vtkTextProperty* text : {bar->GetTitleTextProperty(), bar->GetLabelTextProperty()}) {
    text->SetColor(0.1, 0.1, 0.1);
    text->SetFontSize(std::max(10, height / 50));
    text->SetFontFamilyToArial();
    text->ItalicOff();
    text->BoldOff();
    text->ShadowOff();
  }
  return bar;
}

/// How the mesh is looked at: along the cube's diagonal; flat meshes along their normal.
struct View {
  Vector3 center, from, up;        // from: unit vector towards the eye
  double half_width, half_height;  // of the mesh in the picture
};

View make_view(const ShellMesh& mesh) {
  Vector3 low = mesh.points.front(), high = low;
  for (const Vector3& point : mesh.points) {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  const Vector3 extent = high - low;
  int flat = 0;
  extent.minCoeff(&flat);
  View view{0.5 * (low + high), {1, -1.2, 0.9}, {0, 0, 1}, 0, 0};
  if (extent[flat] < 1e-6 * extent.norm()) {
    view.from = flat == 1 ? Vector3(0, -1, 0) : Vector3::Unit(flat);
    if (flat == 2) view.up = {0, 1, 0};
  }
  view.from.normalize();
  const Vector3 right = view.up.cross(view.from).normalized(), above = view.from.cross(right);
  Vector2 least = Vector2::Constant(std::numeric_limits<double>::max()), most = -least;
  for (const Vector3& point : mesh.points) {
    const Vector2 place((point - view.center).dot(right), (point - view.center).dot(above));
    least = least.cwiseMin(place);
    most = most.cwiseMax(place);
  }
  const Vector2 middle = 0.5 * (least + most);
  view.center += middle.x() * right + middle.y() * above;
  view.half_width = 0.5 * (most - least).x();
  view.half_height = 0.5 * (most - least).y();
  return view;
}

constexpr double picture_share = 0.9;  // of the width; the color bar has the rest

/// Half the height of the picture in the mesh's unit, with a margin around the mesh.
double parallel_scale(const View& view, int width, int height) {
  return 1.06 * std::max(view.half_height, view.half_width * height / (picture_share * width));
}

void aim_camera(const View& view, double scale, double depth, vtkRenderer* renderer) {
  vtkCamera* camera = renderer->GetActiveCamera();
  const Vector3 position = view.center + depth * view.from;
  camera->ParallelProjectionOn();
  camera->SetFocalPoint(view.center.data());
  camera->SetPosition(position.data());
  camera->SetViewUp(view.up.data());
  camera->SetParallelScale(scale);
  renderer->ResetCameraClippingRange();
}

double median_length(const ShellMesh& mesh, const std::vector<std::array<int, 2>>& sides) {
  std::vector<double> lengths;
  for (const auto& side : sides) lengths.push_back((mesh.points[side[0]] - mesh.points[side[1]]).norm());
  const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
  std::nth_element(lengths.begin(), middle, lengths.end());
  return *middle;
}

/// \param pixel size of a pixel in the mesh's unit.
void add_actors(const ShellMesh& mesh, const std::vector<double>& qualities, double pixel, double line_width,
                vtkLookupTable* colors, vtkRenderer* renderer) {
  const vtkNew<vtkPoints> points = make_points(mesh);
  const auto sides = unique_sides(mesh);
  // Sides closer than a few pixels would paint the picture black.
  const double opacity = std::clamp(median_length(mesh, sides) / (12 * pixel * line_width), 0.04, 0.85);
  std::vector<std::array<int, 2>> features;
  for (const ShellMesh::Segment& segment : mesh.segments) features.push_back(segment.nodes);
  renderer->AddActor(surface_actor(mesh, qualities, points, colors));
  renderer->AddActor(line_actor(sides, points, line_width, opacity));
  renderer->AddActor(line_actor(features, points, 2.4 * line_width, 1));
}

/// Half the size, each pixel the mean of four: smooth lines without the driver's help.
vtkNew<vtkImageData> halved(vtkImageData* image) {
  const int* size = image->GetDimensions();
  vtkNew<vtkImageData> result;
  result->SetDimensions(size[0] / 2, size[1] / 2, 1);
  result->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  const auto* from = static_cast<const unsigned char*>(image->GetScalarPointer());
  auto* to = static_cast<unsigned char*>(result->GetScalarPointer());
  const std::ptrdiff_t row = 3 * static_cast<std::ptrdiff_t>(size[0]);
  for (int y = 0; y < size[1] / 2; ++y)
    for (int x = 0; x < size[0] / 2; ++x)
      for (int channel = 0; channel < 3; ++channel) {
        const unsigned char* corner = from + 2 * y * row + 6 * x + channel;
        *to++ = static_cast<unsigned char>((corner[0] + corner[3] + corner[row] + corner[row + 3] + 2) / 4);
      }
  return result;
}

std::string png_bytes(vtkImageData* image) {
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputData(image);
  writer->WriteToMemoryOn();
  writer->Write();
  vtkUnsignedCharArray* bytes = writer->GetResult();
  if (bytes == nullptr || bytes->GetNumberOfValues() == 0) return {};
  return {reinterpret_cast<const char*>(bytes->GetPointer(0)),
          static_cast<std::size_t>(bytes->GetNumberOfValues())};
}

std::string draw(const ShellMesh& mesh, const std::vector<double>& qualities, int width, int height) {
  const View view = make_view(mesh);
  const double scale = parallel_scale(view, width, height);
  const vtkNew<vtkLookupTable> colors = color_map();
  vtkNew<vtkRenderer> scene, legend;
  scene->SetViewport(0, 0, picture_share, 1);
  legend->SetViewport(picture_share, 0, 1, 1);
  for (vtkRenderer* renderer : {scene.Get(), legend.Get()}) renderer->SetBackground(1, 1, 1);
  add_actors(mesh, qualities, scale / height, std::max(1.0, height / 600.0), colors, scene);
  legend->AddActor2D(color_bar(colors, 2 * height));
  aim_camera(view, scale, 4 * (view.half_width + view.half_height), scene);
  vtkNew<vtkRenderWindow> window;
  window->SetOffScreenRendering(1);
  window->SetMultiSamples(0);
  window->SetSize(2 * width, 2 * height);
  window->AddRenderer(scene);
  window->AddRenderer(legend);
  window->Render();
  vtkNew<vtkWindowToImageFilter> image;
  image->SetInput(window);
  image->ReadFrontBufferOff();
  image->Update();
  return png_bytes(halved(image->GetOutput()));
}

}  // namespace

}  // namespace quadrille

QUADRILLE_EXPORT const char* quadrille_picture_version() {
  return QUADRILLE_VERSION;
}

QUADRILLE_EXPORT std::string quadrille_picture_draw(const quadrille::ShellMesh& mesh,
                                                    const std::vector<double>& qualities, int width,
                                                    int height, std::string& bytes) try {
  const quadrille::XDisplay display;
  if (!display.usable()) return display.problem();
  bytes = quadrille::draw(mesh, qualities, width, height);
  return bytes.empty() ? "VTK could not draw the picture" : "";
} catch (const std::exception& error) {
  return error.what();
}
