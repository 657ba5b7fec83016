/// The module libquadrille_picture.so: pictures by VTK, which need OpenGL and an X display. See modules.hpp.

#include <vtkActor.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkLookupTable.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>

#include <algorithm>
#include <array>
#include <exception>
#include <set>

#include "geometry/base/error.hpp"
#include "geometry/base/module_loader.hpp"
#include "mesher/io/modules.hpp"
#include "mesher/io/picture_scene.hpp"
#include "mesher/io/x_display.hpp"
#include "mesher/mesh/sides.hpp"

namespace quadrille {

namespace {

/// From red (bad) through yellow to blue (good), which the color-blind can also tell apart.
vtkNew<vtkLookupTable> color_map() {
  vtkNew<vtkLookupTable> table = color_table({{0.0, 0.65, 0.00, 0.15},
                                              {0.3, 0.91, 0.36, 0.23},
                                              {0.5, 0.99, 0.68, 0.38},
                                              {0.7, 1.00, 0.92, 0.62},
                                              {0.85, 0.80, 0.92, 0.94},
                                              {1.0, 0.42, 0.66, 0.82}});
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
  vtkNew<vtkActor> actor = colored_actor(surface, colors);
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
      const double count = std::clamp(std::ceil((to - from).norm() / step), 1.0, max_dots);
      for (double i = 0; i < count; ++i) {
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
  const double scale = parallel_scale(view, picture_share * width / height);
  add_actors(mesh, qualities, scale / height, std::max(1.0, height / 600.0), colors, scene);
  legend->AddViewProp(color_bar(colors, {"q", "%.1f", 6}, 2 * height));
  aim_camera(view, scale, scene);
  return rendered({scene, legend}, width, height);
}

/// Draws on a display. Returns what went wrong as a sentence, else an empty string.
template <class Draw>
std::string drawn(std::string& bytes, Draw&& draw_it) try {
  const XDisplay display;
  if (!display.usable()) return display.problem();
  bytes = draw_it();
  return bytes.empty() ? "VTK could not draw the picture" : "";
} catch (const std::exception& error) {
  return sentence_of(error);
}

}  // namespace

}  // namespace quadrille

QUADRILLE_EXPORT const char* quadrille_picture_version() {
  return QUADRILLE_VERSION;
}

QUADRILLE_EXPORT std::string quadrille_picture_draw(const quadrille::ShellMesh& mesh,
                                                    const std::vector<double>& qualities, int width,
                                                    int height, std::string& bytes) {
  return quadrille::drawn(bytes, [&] { return quadrille::draw(mesh, qualities, width, height); });
}

QUADRILLE_EXPORT std::string quadrille_picture_sizes(const quadrille::SizeMap& map, int width, int height,
                                                     std::string& bytes) {
  return quadrille::drawn(bytes, [&] { return quadrille::draw_sizes(map, width, height); });
}
