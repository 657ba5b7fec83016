#pragma once
/// The CAD models of examples/models/ by property, so that a test runs on all that fit:
///
///     for (const SampleModel& model : sample_models_where([](const SampleModel& m) { return m.closed; }))
///     ...

#include <filesystem>
#include <string>
#include <vector>

namespace quadrille {

struct SampleModel {
  std::string name;           ///< file name without its ending
  std::string file;           ///< file name
  bool closed = false;        ///< a watertight skin: every mesh side has at least two elements
  bool periodic = false;      ///< has a seam
  bool poles = false;         ///< has degenerate edges
  bool holes = false;         ///< has a face with more than one wire
  bool non_manifold = false;  ///< has an edge of three or more faces
  bool closed_edges = false;  ///< has a closed edge that is not a seam
  int solids = 0;
  int faces = 0, edges = 0, vertices = 0;  ///< counts as FreeCAD gives them
  double area = 0;                         ///< sum of the face areas, shared faces once, in mm^2

  std::filesystem::path path() const {
    return std::filesystem::path(QUADRILLE_SOURCE_DIR) / "examples" / "models" / file;
  }
};

/// All sample models; the first is the main sample part.
inline const std::vector<SampleModel>& sample_models() {
  static const std::vector<SampleModel> models = {
      {.name = "bracket",
       .file = "bracket.step",
       .closed = true,
       .periodic = true,
       .holes = true,
       .closed_edges = true,
       .solids = 1,
       .faces = 23,
       .edges = 62,
       .vertices = 41,
       .area = 18310.303609},
      {.name = "box",
       .file = "box.brep",
       .closed = true,
       .solids = 1,
       .faces = 6,
       .edges = 12,
       .vertices = 8,
       .area = 2200.000000},
      {.name = "cylinder",
       .file = "cylinder.brep",
       .closed = true,
       .periodic = true,
       .closed_edges = true,
       .solids = 1,
       .faces = 3,
       .edges = 3,
       .vertices = 2,
       .area = 2513.274123},
      {.name = "cone",
       .file = "cone.brep",
       .closed = true,
       .periodic = true,
       .poles = true,
       .closed_edges = true,
       .solids = 1,
       .faces = 2,
       .edges = 3,
       .vertices = 2,
       .area = 1160.058975},
      {.name = "sphere",
       .file = "sphere.brep",
       .closed = true,
       .periodic = true,
       .poles = true,
       .solids = 1,
       .faces = 1,
       .edges = 3,
       .vertices = 2,
       .area = 2827.433388},
      {.name = "torus",
       .file = "torus.brep",
       .closed = true,
       .periodic = true,
       .solids = 1,
       .faces = 1,
       .edges = 2,
       .vertices = 1,
       .area = 4737.410113},
      {.name = "disc",
       .file = "disc.brep",
       .closed_edges = true,
       .solids = 0,
       .faces = 1,
       .edges = 1,
       .vertices = 1,
       .area = 452.389342},
      {.name = "plate_with_holes",
       .file = "plate_with_holes.brep",
       .holes = true,
       .closed_edges = true,
       .solids = 0,
       .faces = 1,
       .edges = 12,
       .vertices = 12,
       .area = 7206.416017},
      {.name = "bezier_patch",
       .file = "bezier_patch.brep",
       .solids = 0,
       .faces = 1,
       .edges = 4,
       .vertices = 4,
       .area = 1167.594229},
      {.name = "wing",
       .file = "wing.brep",
       .closed = true,
       .solids = 1,
       .faces = 4,
       .edges = 6,
       .vertices = 4,
       .area = 23081.137942},
      {.name = "t_junction",
       .file = "t_junction.brep",
       .non_manifold = true,
       .solids = 0,
       .faces = 3,
       .edges = 10,
       .vertices = 8,
       .area = 3600.000000},
      {.name = "two_solids",
       .file = "two_solids.brep",
       .closed = true,
       .periodic = true,
       .holes = true,
       .non_manifold = true,
       .closed_edges = true,
       .solids = 2,
       .faces = 9,
       .edges = 15,
       .vertices = 10,
       .area = 5286.371579},
      {.name = "tube_with_hole",
       .file = "tube_with_hole.brep",
       .periodic = true,
       .closed_edges = true,
       .solids = 0,
       .faces = 1,
       .edges = 7,
       .vertices = 5,
       .area = 2935.561911},
  };
  return models;
}

/// The sample models for which `fits(model)` is true. Tests should check that the list is not empty.
template <typename Predicate>
std::vector<SampleModel> sample_models_where(Predicate fits) {
  std::vector<SampleModel> chosen;
  for (const SampleModel& model : sample_models()) {
    if (fits(model)) chosen.push_back(model);
  }
  return chosen;
}

/// The sample model of a name; the first one when there is none of that name.
inline const SampleModel& sample_model(const std::string& name) {
  for (const SampleModel& model : sample_models()) {
    if (model.name == name) return model;
  }
  return sample_models().front();
}

}  // namespace quadrille
