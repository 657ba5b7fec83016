/// Draws two views with VTK: sizes, colored by their logarithm, and the governing source at each place.

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkIntArray.h>
#include <vtkLegendBoxActor.h>
#include <vtkLookupTable.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkProperty.h>
#include <vtkTextProperty.h>

#include <fmt/format.h>

#include "mesher/io/picture_scene.hpp"

namespace quadrille {

namespace {

using Color = std::array<double, 3>;

/// Gray for the global size, then colors that the color-blind can tell apart (Okabe and Ito). From the ninth
/// source on, lighter versions of these colors.
Color color_of_source(std::size_t source) {
  constexpr Color colors[] = {{0.80, 0.80, 0.80}, {0.90, 0.62, 0.00}, {0.34, 0.71, 0.91}, {0.00, 0.62, 0.45},
                              {0.80, 0.47, 0.65}, {0.00, 0.45, 0.70}, {0.84, 0.37, 0.00}, {0.94, 0.89, 0.26}};
  constexpr std::size_t n = std::size(colors);
  Color color = colors[source < n ? source : 1 + (source - n) % (n - 1)];
  if (source >= n) {
    for (double& part : color) part = 0.5 * (1 + part);
  }
  return color;
}

/// From dark (small) to light (large), by the logarithm of the size. The lightness grows evenly (viridis).
vtkNew<vtkLookupTable> colors_of_sizes(const SizeMap& map) {
  vtkNew<vtkLookupTable> table = color_table({{0, 0.267, 0.005, 0.329},
                                              {0.25, 0.229, 0.322, 0.546},
                                              {0.5, 0.128, 0.567, 0.551},
                                              {0.75, 0.369, 0.789, 0.383},
                                              {1, 0.993, 0.906, 0.144}});
  const auto [least, largest] = std::minmax_element(map.sizes.begin(), map.sizes.end());
  constexpr double narrowest = 1.1;  // least ratio of the range, so that the range is never empty
  table->SetScaleToLog10();
  table->SetRange(std::min(*least, *largest / narrowest), *largest);
  return table;
}

vtkNew<vtkLookupTable> colors_of_sources(const SizeMap& map) {
  vtkNew<vtkLookupTable> table;
  const auto n = static_cast<int>(map.sources.size());
  table->SetNumberOfTableValues(n);
  table->SetRange(-0.5, n - 0.5);
  for (int i = 0; i < n; ++i) {
    const Color color = color_of_source(static_cast<std::size_t>(i));
    table->SetTableValue(i, color[0], color[1], color[2]);
  }
  return table;
}

vtkNew<vtkPolyData> surface_of(const SizeMap& map, vtkPoints* points) {
  vtkNew<vtkCellArray> cells;
  for (const auto& triangle : map.triangles) add_cell(cells, triangle);
  vtkNew<vtkPolyData> surface;
  surface->SetPoints(points);
  surface->SetPolys(cells);
  return surface;
}

vtkNew<vtkActor> sizes_actor(const SizeMap& map, vtkPoints* points, vtkLookupTable* colors) {
  const vtkNew<vtkPolyData> surface = surface_of(map, points);
  vtkNew<vtkDoubleArray> sizes;
  for (const double size : map.sizes) sizes->InsertNextValue(size);
  surface->GetPointData()->SetScalars(sizes);
  return colored_actor(surface, colors);
}

vtkNew<vtkActor> sources_actor(const SizeMap& map, vtkPoints* points, vtkLookupTable* colors) {
  const vtkNew<vtkPolyData> surface = surface_of(map, points);
  vtkNew<vtkIntArray> rulers;
  for (const auto& [a, b, c] : map.triangles)  // the source at two corners or more, if any two agree
    rulers->InsertNextValue(map.rulers[b] == map.rulers[c] ? map.rulers[b] : map.rulers[a]);
  surface->GetCellData()->SetScalars(rulers);
  return colored_actor(surface, colors);
}

/// For each source that rules somewhere: a square of its color, its name, its approximate share of the quads.
vtkNew<vtkLegendBoxActor> legend_of(const SizeMap& map) {
  vtkNew<vtkPoints> corners;
  for (const auto& [x, y] : {std::pair(0, 0), {1, 0}, {1, 1}, {0, 1}}) corners->InsertNextPoint(x, y, 0);
  vtkNew<vtkCellArray> cells;
  add_cell(cells, std::array<int, 4>{0, 1, 2, 3});
  vtkNew<vtkPolyData> square;
  square->SetPoints(corners);
  square->SetPolys(cells);
  vtkNew<vtkLegendBoxActor> legend;
  double sum = 0;
  std::vector<std::size_t> shown;
  for (std::size_t i = 0; i < map.sources.size(); ++i) {
    sum += map.sources[i].quads;
    if (map.sources[i].area > 0) shown.push_back(i);
  }
  legend->SetNumberOfEntries(static_cast<int>(shown.size()));
  for (std::size_t i = 0; i < shown.size(); ++i) {
    const SizeMap::Source& source = map.sources[shown[i]];
    const std::string text =
        fmt::format("{}: {:.0f} % of the quads", source.name, sum > 0 ? 100 * source.quads / sum : 0);
    Color color = color_of_source(shown[i]);
    if (shown[i] == 0) color = {0.5, 0.5, 0.5};  // the text has this color too and must be readable on white
    legend->SetEntry(static_cast<int>(i), square, text.c_str(), color.data());
  }
  legend->GetPositionCoordinate()->SetCoordinateSystemToNormalizedViewport();
  legend->GetPositionCoordinate()->SetValue(0.05, 0.02);
  legend->GetPosition2Coordinate()->SetCoordinateSystemToNormalizedViewport();
  legend->GetPosition2Coordinate()->SetValue(0.9, 0.96);
  legend->GetEntryTextProperty()->SetColor(0.1, 0.1, 0.1);
  legend->GetEntryTextProperty()->SetFontFamilyToArial();
  legend->BorderOff();
  return legend;
}

}  // namespace

std::string draw_sizes(const SizeMap& map, int width, int height) {
  constexpr double strip = 0.2;  // share of the height for the color bar and the legend
  const View view = make_view(map.points);
  const double scale = parallel_scale(view, 0.5 * width / ((1 - strip) * height));
  const vtkNew<vtkPoints> points = make_points(map.points);
  const vtkNew<vtkLookupTable> size_colors = colors_of_sizes(map), source_colors = colors_of_sources(map);
  std::vector<std::array<int, 2>> lines;
  for (const SizeMap::Line& line : map.lines) lines.push_back(line.points);
  const double line_width = std::max(1.0, height / 600.0);
  vtkNew<vtkRenderer> sizes, sources, bar, legend;
  sizes->SetViewport(0, strip, 0.5, 1);
  sources->SetViewport(0.5, strip, 1, 1);
  bar->SetViewport(0, 0, 0.5, strip);
  legend->SetViewport(0.5, 0, 1, strip);
  sizes->AddActor(sizes_actor(map, points, size_colors));
  sources->AddActor(sources_actor(map, points, source_colors));
  for (vtkRenderer* scene : {sizes.Get(), sources.Get()}) {
    scene->AddActor(line_actor(lines, points, line_width, 0.6));
    aim_camera(view, scale, scene);
  }
  const std::string title = fmt::format("size in mm, {}about {:.0f} quads",
                                        map.sizes == map.along ? "" : "of bends across, ", map.quads);
  const vtkNew<vtkScalarBarActor> scale_of_sizes =
      color_bar(size_colors, {title.c_str(), "%.3g", 5}, 2 * height);
  scale_of_sizes->SetOrientationToHorizontal();
  scale_of_sizes->SetPosition(0.1, 0.1);
  scale_of_sizes->SetWidth(0.8);
  scale_of_sizes->SetHeight(0.7);
  bar->AddViewProp(scale_of_sizes);
  legend->AddViewProp(legend_of(map));
  return rendered({sizes, sources, bar, legend}, width, height);
}

}  // namespace quadrille
