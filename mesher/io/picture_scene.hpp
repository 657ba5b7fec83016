#pragma once
/// Common parts of pictures: view, lines, color bars, rendering. Part of libquadrille_picture.so.

#include <vtkActor.h>
#include <vtkCellArray.h>
#include <vtkLookupTable.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkRenderer.h>
#include <vtkScalarBarActor.h>
#include <vtkScalarsToColors.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "geometry/base/vector.hpp"
#include "mesher/size_map.hpp"

namespace quadrille {

vtkNew<vtkPoints> make_points(const std::vector<Vector3>& points);

template <std::size_t N>
void add_cell(vtkCellArray* cells, const std::array<int, N>& nodes) {
  std::array<vtkIdType, N> ids;
  std::copy(nodes.begin(), nodes.end(), ids.begin());
  cells->InsertNextCell(static_cast<vtkIdType>(N), ids.data());
}

/// Colors at values from 0 to 1, ascending: value, red, green, blue.
using ColorStops = std::vector<std::array<double, 4>>;

/// 256 colors between those of the stops, from the first to the last.
vtkNew<vtkLookupTable> color_table(const ColorStops& stops);

/// Dark lines between points. \param width pixels.
vtkNew<vtkActor> line_actor(const std::vector<std::array<int, 2>>& lines, vtkPoints* points, double width,
                            double opacity);

/// A surface colored by its scalars, those of points interpolated, of cells not.
vtkNew<vtkActor> colored_actor(vtkPolyData* surface, vtkLookupTable* colors);

struct BarTexts {
  const char* title;
  const char* format;  ///< printf format of the numbers in the labels
  int labels;          ///< number of labels
};

/// \param height height of the picture, pixels.
vtkNew<vtkScalarBarActor> color_bar(vtkScalarsToColors* colors, const BarTexts& texts, int height);

/// The view of a scene: along a diagonal of space; along the normal if the scene is flat.
struct View {
  Vector3 center, from, up;        ///< from: unit vector towards the eye
  double half_width, half_height;  ///< of the scene in the picture plane
};

View make_view(const std::vector<Vector3>& points);

/// Half the height of the picture in model units, with a margin. \param aspect width over height of the
/// picture.
double parallel_scale(const View& view, double aspect);

void aim_camera(const View& view, double scale, vtkRenderer* renderer);

/// The bytes of a PNG; empty if VTK cannot draw it. \param renderers with their viewports set.
std::string rendered(const std::vector<vtkRenderer*>& renderers, int width, int height);

/// The same of a picture with the sizes on the left, the governing sources on the right. \param width, height
/// pixels.
std::string draw_sizes(const SizeMap& map, int width, int height);

}  // namespace quadrille
