/// Renders at twice the size with VTK and takes the mean of four pixels, so that lines are smooth.

#include "mesher/io/picture_scene.hpp"

#include <vtkCamera.h>
#include <vtkImageData.h>
#include <vtkLookupTable.h>
#include <vtkPNGWriter.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderWindow.h>
#include <vtkTextProperty.h>
#include <vtkUnsignedCharArray.h>
#include <vtkWindowToImageFilter.h>

namespace quadrille {

namespace {

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

}  // namespace

vtkNew<vtkPoints> make_points(const std::vector<Vector3>& positions) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(static_cast<vtkIdType>(positions.size()));
  for (std::size_t i = 0; i < positions.size(); ++i)
    points->SetPoint(static_cast<vtkIdType>(i), positions[i].data());
  return points;
}

vtkNew<vtkLookupTable> color_table(const ColorStops& stops) {
  constexpr int colors = 256;
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
  return table;
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

vtkNew<vtkActor> colored_actor(vtkPolyData* surface, vtkLookupTable* colors) {
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(surface);
  mapper->SetLookupTable(colors);
  mapper->UseLookupTableScalarRangeOn();
  mapper->InterpolateScalarsBeforeMappingOn();
  // Behind the lines that are drawn on the surface.
  mapper->SetResolveCoincidentTopologyToPolygonOffset();
  mapper->SetRelativeCoincidentTopologyPolygonOffsetParameters(1.5, 2);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetInterpolationToFlat();
  actor->GetProperty()->SetAmbient(0.6);
  actor->GetProperty()->SetDiffuse(0.45);
  return actor;
}

vtkNew<vtkScalarBarActor> color_bar(vtkScalarsToColors* colors, const BarTexts& texts, int height) {
  vtkNew<vtkScalarBarActor> bar;
  bar->SetLookupTable(colors);
  bar->SetTitle(texts.title);
  bar->SetNumberOfLabels(texts.labels);
  bar->SetLabelFormat(texts.format);
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

double parallel_scale(const View& view, double aspect) {
  return 1.06 * std::max(view.half_height, view.half_width / aspect);
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

}  // namespace quadrille
