/// The module libquadrille_picture.so: pictures by VTK, which need OpenGL and an X display. See modules.hpp.
/// Renders at twice the size and takes the mean of four pixels, so that lines are smooth.

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkImageData.h>
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
#include <exception>
#include <set>

#include "geometry/base/error.hpp"
#include "geometry/base/module_loader.hpp"
#include "geometry/base/whole_number.hpp"
#include "mesher/io/modules.hpp"
#include "mesher/io/x_display.hpp"
#include "mesher/mesh/sides.hpp"

namespace quadrille {

namespace {

template <std::size_t N>
void add_cell(vtkCellArray* cells, const std::array<int, N>& nodes) {
  std::array<vtkIdType, N> ids;
  std::copy(nodes.begin(), nodes.end(), ids.begin());
  cells->InsertNextCell(static_cast<vtkIdType>(N), ids.data());
}

/// The view of a scene: along a diagonal of space; along the normal if the scene is flat.
struct View {
  Vector3 center, from, up;        ///< from: unit vector towards the eye
  double half_width, half_height;  ///< of the scene in the picture plane
};

/// The image at half its size; each pixel is the mean of four. Smooths lines without the driver's help.
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

vtkNew<vtkPoints> make_points(const std::vector<Vector3>& positions) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(static_cast<vtkIdType>(positions.size()));
  for (std::size_t i = 0; i < positions.size(); ++i)
    points->SetPoint(static_cast<vtkIdType>(i), positions[i].data());
  return points;
}

/// Dark lines between points. \param width pixels.
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

/// \param height of the picture, pixels
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

View make_view(const std::vector<Vector3>& points) {
  Eigen::AlignedBox3d box;
  for (const Vector3& point : points) box.extend(point);
  const Vector3 extent = box.diagonal();
  int flat = 0;
  extent.minCoeff(&flat);
  View view{box.center(), {1, -1.2, 0.9}, {0, 0, 1}, 0, 0};
  if (extent[flat] < 1e-6 * extent.norm()) {
    view.from = flat == 1 ? Vector3(0, -1, 0) : Vector3::Unit(flat);
    if (flat == 2) view.up = {0, 1, 0};
  }
  view.from.normalize();
  const Vector3 right = view.up.cross(view.from).normalized(), above = view.from.cross(right);
  Eigen::AlignedBox2d seen;
  for (const Vector3& point : points)
    seen.extend(Vector2((point - view.center).dot(right), (point - view.center).dot(above)));
  const Vector2 middle = seen.center();
  view.center += middle.x() * right + middle.y() * above;
  view.half_width = 0.5 * seen.diagonal().x();
  view.half_height = 0.5 * seen.diagonal().y();
  return view;
}

void aim_camera(const View& view, double scale, vtkRenderer* renderer) {
  const double depth = 4 * (view.half_width + view.half_height);
  vtkCamera* camera = renderer->GetActiveCamera();
  const Vector3 position = view.center + depth * view.from;
  camera->ParallelProjectionOn();
  camera->SetFocalPoint(view.center.data());
  camera->SetPosition(position.data());
  camera->SetViewUp(view.up.data());
  camera->SetParallelScale(scale);
  renderer->ResetCameraClippingRange();
}

std::string rendered(const std::vector<vtkRenderer*>& renderers, int width, int height) {
  vtkNew<vtkRenderWindow> window;
  window->SetOffScreenRendering(1);
  window->SetMultiSamples(0);
  window->SetSize(2 * width, 2 * height);
  for (vtkRenderer* renderer : renderers) {
    renderer->SetBackground(1, 1, 1);
    window->AddRenderer(renderer);
  }
  window->Render();
  vtkNew<vtkWindowToImageFilter> image;
  image->SetInput(window);
  image->ReadFrontBufferOff();
  image->Update();
  return png_bytes(halved(image->GetOutput()));
}

/// From red (bad) through yellow to blue (good), which the color-blind can also tell apart.
vtkNew<vtkLookupTable> color_map() {
  constexpr int colors = 256;
  constexpr double stops[][4] = {{0.0, 0.65, 0.00, 0.15}, {0.3, 0.91, 0.36, 0.23},  {0.5, 0.99, 0.68, 0.38},
                                 {0.7, 1.00, 0.92, 0.62}, {0.85, 0.80, 0.92, 0.94}, {1.0, 0.42, 0.66, 0.82}};
  vtkNew<vtkLookupTable> table;
  table->SetNumberOfTableValues(colors);
  for (int i = 0; i < colors; ++i) {
    const double value = i / (colors - 1.0);
    std::size_t right = 1;
    while (stops[right][0] < value) ++right;
    const auto &a = stops[right - 1], &b = stops[right];
    const double t = (value - a[0]) / (b[0] - a[0]);
    table->SetTableValue(i, a[1] + t * (b[1] - a[1]), a[2] + t * (b[2] - a[2]), a[3] + t * (b[3] - a[3]));
  }
  table->SetRange(0, 1);
  return table;
}

constexpr double picture_share = 0.9;  // share of the width; the rest is for the color bar

vtkNew<vtkActor> surface_actor(const ShellMesh& mesh, const std::vector<double>& qualities, vtkPoints* points,
                               vtkLookupTable* colors) {
  vtkNew<vtkCellArray> cells;
  for (const auto& quad : mesh.quads) add_cell(cells, quad);
  for (const auto& triangle : mesh.triangles) add_cell(cells, triangle);
  vtkNew<vtkPolyData> surface;
  surface->SetPoints(points);
  surface->SetPolys(cells);
  vtkNew<vtkDoubleArray> q;  // of triangles 0
  for (std::size_t i = 0; i < mesh.quads.size(); ++i) q->InsertNextValue(qualities[i]);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) q->InsertNextValue(0);
  surface->GetCellData()->SetScalars(q);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(surface);
  mapper->SetLookupTable(colors);
  mapper->UseLookupTableScalarRangeOn();
  // Behind the lines that are drawn on the surface.
  mapper->SetResolveCoincidentTopologyToPolygonOffset();
  mapper->SetRelativeCoincidentTopologyPolygonOffsetParameters(1.5, 2);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetInterpolationToFlat();
  actor->GetProperty()->SetAmbient(0.55);
  actor->GetProperty()->SetDiffuse(0.5);
  return actor;
}

/// The two corner nodes of each element side; sides that elements share appear once.
std::vector<std::array<int, 2>> unique_sides(const ShellMesh& mesh) {
  std::vector<std::array<int, 2>> sides;
  const auto add = [&](int low, int high, std::span<const Side>) { sides.push_back({low, high}); };
  for_each_shared_side(mesh.points.size(), no_check, add, mesh.quads, mesh.triangles);
  return sides;
}

double median_length(const ShellMesh& mesh, const std::vector<std::array<int, 2>>& sides) {
  std::vector<double> lengths;
  lengths.reserve(sides.size());
  for (const auto& side : sides) lengths.push_back((mesh.points[side[0]] - mesh.points[side[1]]).norm());
  const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
  std::nth_element(lengths.begin(), middle, lengths.end());
  return *middle;
}

/// Dots along the edges that quads cross. \param step from dot to dot, mesh units
vtkNew<vtkActor> suppressed_actor(const ShellMesh& mesh, double step, double width) {
  std::vector<Vector3> ends;
  std::vector<std::array<int, 2>> dots;
  for (const ShellMesh::CrossedEdge& edge : mesh.crossed_edges) {
    for (std::size_t k = 0; k + 1 < edge.line.size(); ++k) {
      const Vector3 &from = edge.line[k], &to = edge.line[k + 1];
      constexpr double max_dots = 1000;
      const int count = to_int(std::clamp(std::ceil((to - from).norm() / step), 1.0, max_dots));
      for (int i = 0; i < count; ++i) {
        for (const double part : {0.25, 0.75}) ends.emplace_back(from + (i + part) / count * (to - from));
        dots.push_back({static_cast<int>(ends.size()) - 2, static_cast<int>(ends.size()) - 1});
      }
    }
  }
  return line_actor(dots, make_points(ends), width, 1);
}

/// \param pixel size of a pixel in mesh units.
void add_actors(const ShellMesh& mesh, const std::vector<double>& qualities, double pixel, double line_width,
                vtkLookupTable* colors, vtkRenderer* renderer) {
  const vtkNew<vtkPoints> points = make_points(mesh.points);
  const auto sides = unique_sides(mesh);
  // Sides closer than a few pixels would paint the picture black.
  const double opacity = std::clamp(median_length(mesh, sides) / (12 * pixel * line_width), 0.04, 0.85);
  std::vector<std::array<int, 2>> features, marked;
  const std::set<int> to_mark(mesh.marked_edges.begin(), mesh.marked_edges.end());
  for (const ShellMesh::Segment& segment : mesh.segments)
    (to_mark.count(segment.edge) != 0 ? marked : features).push_back(segment.nodes);
  renderer->AddActor(surface_actor(mesh, qualities, points, colors));
  renderer->AddActor(line_actor(sides, points, line_width, opacity));
  renderer->AddActor(line_actor(features, points, 2.4 * line_width, 1));
  const vtkNew<vtkActor> marks = line_actor(marked, points, 6 * line_width, 1);
  marks->GetProperty()->SetColor(0.9, 0, 0.1);
  renderer->AddActor(marks);
  if (!mesh.crossed_edges.empty())
    renderer->AddActor(suppressed_actor(mesh, 8 * line_width * pixel, 2.4 * line_width));
}

std::string draw(const ShellMesh& mesh, const std::vector<double>& qualities, int width, int height) {
  const View view = make_view(mesh.points);
  const vtkNew<vtkLookupTable> colors = color_map();
  vtkNew<vtkRenderer> scene, legend;
  scene->SetViewport(0, 0, picture_share, 1);
  legend->SetViewport(picture_share, 0, 1, 1);
  // Half the height of the picture in model units, with a margin.
  const double scale = 1.06 * std::max(view.half_height, view.half_width / (picture_share * width / height));
  add_actors(mesh, qualities, scale / height, std::max(1.0, height / 600.0), colors, scene);
  legend->AddViewProp(color_bar(colors, 2 * height));
  aim_camera(view, scale, scene);
  return rendered({scene, legend}, width, height);
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
  if (!display.problem().empty()) return display.problem();
  bytes = quadrille::draw(mesh, qualities, width, height);
  return bytes.empty() ? "VTK could not draw the picture" : "";
} catch (const std::exception& error) {
  return quadrille::sentence_of(error);
}
