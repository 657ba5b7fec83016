#pragma once
/// What .vtk and .xdmf files say of each shell element or node: its face, q, thickness, and its sets.

#include <functional>
#include <string>
#include <vector>

#include "mesher/io/writers.hpp"

namespace quadrille {

/// An array of one number for each shell element or each node.
struct MeshArray {
  enum class Type { set, integer, real };  ///< set: 1 for members, else 0

  std::string name;  ///< as array_of_set() makes it
  Type type = Type::set;
  bool of_nodes = false;
  std::function<void(int, TextWriter&)> write;  ///< the number of an element or of a node of the file, from 0
};

/// The arrays of a mesh, those of nodes last. Sets of segments and corners, which are not cells in these
/// files, are sets of nodes. Valid as long as the mesh.
std::vector<MeshArray> mesh_arrays(const Writing& writing);

/// Writes the numbers of an array, one a line.
void write_numbers(const MeshArray& array, const OutputMesh& mesh, TextWriter& out);

}  // namespace quadrille
