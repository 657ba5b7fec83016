#pragma once
/// Meshes as Python has them, over the public header alone.

#include <pybind11/pybind11.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "mesher/quadrille.hpp"

namespace quadrille {

/// A mesh with the arrays that Python sees; never changed once made, so that arrays can point into it.
struct PythonMesh {
  ShellMesh mesh;
  std::vector<std::array<int, 8>> quads8;  ///< corners and midsides side by side, at second order
  std::optional<RemeshFidelity> fidelity;  ///< of meshes that remesh() made

  explicit PythonMesh(ShellMesh made) : mesh(std::move(made)) {
    if (mesh.order != 2) return;
    quads8.resize(mesh.quads.size());
    for (std::size_t i = 0; i < mesh.quads.size(); ++i) {
      std::copy(mesh.quads[i].begin(), mesh.quads[i].end(), quads8[i].begin());
      std::copy(mesh.midsides[i].begin(), mesh.midsides[i].end(), quads8[i].begin() + 4);
    }
  }
};

/// A docstring whose first line, "name(self, path, *, title='')", is what inspect.signature() tells; defaults
/// must be literals.
std::string documented(const std::string& signature, const std::string& text);

/// Adds to the class Mesh what it makes of arrays and gives as arrays: its constructor, points, quads,
/// triangles, face_ids, segments and corners, pickling, and the picture that notebooks show.
void bind_arrays(pybind11::class_<PythonMesh>& mesh);

/// Adds the function recombine.
void bind_recombine(pybind11::module_& module);

}  // namespace quadrille
