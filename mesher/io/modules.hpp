#pragma once
/// The modules libquadrille_vtk.so, libquadrille_picture.so and libquadrille_med.so, which contain all code
/// that needs VTK, VTK with OpenGL and X11, and libmed, in this order. They are opened on demand, since
/// loading those libraries takes more time than meshing a small part.

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "geometry/base/module_loader.hpp"
#include "mesher/io/mesh_builder.hpp"
#include "mesher/io/output_mesh.hpp"
#include "mesher/io/result_reader.hpp"
#include "mesher/mesh/mesh_types.hpp"
#include "mesher/size_map.hpp"

namespace quadrille {

/// What a build may lack, each with a module of its own.
enum class Library { none, vtk, pictures, med };

/// Throws Error (usage) if this build lacks the library. \param ending of the files that need it (".med").
void require_library(Library library, std::string_view ending);

/// A mesh read by VTK. Nodes are numbered from 1 in the order of the points.
struct ImportedMesh {
  std::vector<Vector3> points;
  std::vector<FileElement> elements;
  std::vector<char> set_names;                           ///< names of all sets, each followed by a 0
  std::vector<std::array<std::int64_t, 2>> in_set;       ///< index of an element, index of the set's name
  std::vector<std::array<std::int64_t, 2>> node_in_set;  ///< index of a point, index of the set's name

  /// Visits all lists.
  template <class Visit>
  void each(Visit&& visit) {
    std::apply([&](auto&... lists) { (visit(lists), ...); },
               std::tie(points, elements, set_names, in_set, node_in_set));
  }
};

/// The module of a library, opened by the first call. Throws as require_library(), and Error (failure) if it
/// cannot be opened.
const Module& module_of(Library library);

/// A function that a module exports as a C symbol. There it has one more argument, which receives the result.
/// It returns an empty string, or a sentence that says what went wrong; no exception leaves a module.
template <class Result, class... Arguments>
struct ModuleFunction {
  Library library;
  const char* name;

  /// Opens the module. Throws Error (failure) with the sentence, which does not name the file.
  Result operator()(Arguments... arguments) const {
    const auto work = module_of(library).template function<std::string(Arguments..., Result&)>(name);
    Result result;
    const std::string problem = work(arguments..., result);
    if (!problem.empty()) throw failure("", problem);
    return result;
  }
};

/// The bytes of a .vtu file: shell elements, lines on CAD edges, points on CAD vertices, with their CAD
/// numbers. The second argument has (quads) q of each quad.
inline constexpr ModuleFunction<std::string, const OutputMesh&, const std::vector<double>&> vtu_file{
    Library::vtk, "_file"};

/// The bytes of a PNG of the mesh with (quads) q of each quad; width and height.
inline constexpr ModuleFunction<std::string, const ShellMesh&, const std::vector<double>&, int, int>
    vtk_picture{Library::pictures, "_draw"};

/// The bytes of a .vtu file of the sizes.
inline constexpr ModuleFunction<std::string, const SizeMap&> vtu_sizes{Library::vtk, "_sizes"};

/// The mesh in a file, given its ending: .stl, .obj, .ply, .vtk, .vtu or .vtp.
inline constexpr ModuleFunction<ImportedMesh, const std::string&, const std::string&> vtk_mesh{Library::vtk,
                                                                                               "_read"};

/// A solver's result from a .vtu file.
inline constexpr ModuleFunction<SolverResult, const std::string&> vtk_result{Library::vtk, "_result"};

/// Opens the module for .med files ahead of time. If it cannot be opened, med_file() reports why.
void open_med_module() noexcept;

/// The bytes of a .med file.
/// \param name name of the mesh in the file. FreeCAD reads only a mesh with the same name as its file,
/// without the ending. \param unit of its coordinates, as text. Throws Error (failure).
std::string med_file(const OutputMesh& mesh, const std::string& name, const std::string& description,
                     const std::string& unit);

}  // namespace quadrille
