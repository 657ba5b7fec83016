#pragma once
/// The elements of mesh files, and what each format calls them.

#include <algorithm>
#include <stdexcept>

namespace quadrille {

/// Shapes of elements that a shell mesh can hold.
enum class ElementShape { point, line, triangle, quad };

constexpr int dimension_of(ElementShape shape) {
  return std::min(static_cast<int>(shape), 2);
}
constexpr int corner_count(ElementShape shape) {
  return static_cast<int>(shape) + 1;
}

/// A type of element, with the numbers and names that formats give it.
struct ElementType {
  ElementShape shape = ElementShape::point;
  int nodes = 0;
  int msh = 0;            ///< Gmsh's number
  int vtk = 0;            ///< VTK's cell type, which SU2 uses too
  int unv = 0;            ///< I-deas' descriptor; 0 = not written
  int xdmf_code = 0;      ///< before the nodes of each element, where elements of several kinds are mixed
  const char* bdf = "";   ///< Nastran's card
  const char* xdmf = "";  ///< XDMF's name

  /// The nodes that a mesh keeps: not the middle of nine-node quads, which follows from the others.
  constexpr int kept_nodes() const { return std::min(nodes, 8); }
};

/// Triangles of six nodes are only read.
inline constexpr ElementType element_types[] = {
    {ElementShape::point, 1, 15, 1},
    {ElementShape::line, 2, 1, 3, 21},
    {ElementShape::line, 3, 8, 21, 24},
    {ElementShape::triangle, 3, 2, 5, 91, 0x4, "CTRIA3", "Triangle"},
    {ElementShape::triangle, 6, 9, 22},
    {ElementShape::quad, 4, 3, 9, 94, 0x5, "CQUAD4", "Quadrilateral"},
    {ElementShape::quad, 8, 16, 23, 45, 0x25, "CQUAD8", "Quadrilateral_8"},
    {ElementShape::quad, 9, 10, 28, 0, 0x23, "", "Quadrilateral_9"},
};

/// The type with a number that one of the formats gives it; null if there is none.
constexpr const ElementType* find_element_type(int ElementType::*format, long long number) {
  for (const ElementType& type : element_types)
    if (type.*format == number) return &type;
  return nullptr;
}

/// The type of points, lines or shell elements (dimension 0, 1 or 2) with so many nodes. Throws
/// std::logic_error where there is none.
constexpr const ElementType& element_type(int dimension, int nodes) {
  for (const ElementType& type : element_types)
    if (dimension_of(type.shape) == dimension && type.nodes == nodes) return type;
  throw std::logic_error("no element of this dimension has so many nodes");
}

}  // namespace quadrille
