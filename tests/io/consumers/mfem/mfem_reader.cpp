/// Reads a mesh as MFEM does and prints "nodes quads faces"; nodes are those inside of elements too.

#include <iostream>
#include <mfem.hpp>

int main(int, char** arguments) try {
  mfem::Mesh mesh(arguments[1]);
  int quads = 0;
  for (int i = 0; i < mesh.GetNE(); ++i) quads += mesh.GetElementGeometry(i) == mfem::Geometry::SQUARE;
  const mfem::FiniteElementSpace* space = mesh.GetNodalFESpace();
  std::cout << (space == nullptr ? mesh.GetNV() : space->GetNDofs()) << ' ' << quads << ' '
            << mesh.attributes.Size() << '\n';
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 1;
}
