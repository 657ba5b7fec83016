#pragma once
/// Meshes as Python sees them. Uses the public header alone.

#include <pybind11/pybind11.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "mesher/quadrille.hpp"

namespace quadrille {

/// A mesh with the arrays that Python sees. It never changes once made, so NumPy arrays can point into it.
struct PythonMesh {
  ShellMesh mesh;
  std::vector<std::array<int, 8>> quads8;  ///< second order only: corners, then midside nodes
  std::optional<RemeshFidelity> fidelity;  ///< set only by remesh()

  explicit PythonMesh(ShellMesh made) : mesh(std::move(made)) {
    if (mesh.order != 2) return;
    quads8.resize(mesh.quads.size());
    for (std::size_t i = 0; i < mesh.quads.size(); ++i) {
      std::copy(mesh.quads[i].begin(), mesh.quads[i].end(), quads8[i].begin());
      std::copy(mesh.midsides[i].begin(), mesh.midsides[i].end(), quads8[i].begin() + 4);
    }
  }
};

/// A docstring whose first line is the signature, such as "name(self, path, *, title='')".
/// inspect.signature() reads it, so default values must be literals.
std::string documented(const std::string& signature, const std::string& text);

/// Adds to the class Mesh its constructor from arrays, the array properties (points, quads, triangles, face
/// ids, segments, corners), groups, recombined(), fidelity, pickling, and the picture that notebooks show.
void bind_arrays(pybind11::class_<PythonMesh>& mesh);

/// Adds the function recombine.
void bind_recombine(pybind11::module_& module);

}  // namespace quadrille
