/// Reads a mesh as deal.II does and prints "nodes quads faces": vertices, cells, material numbers.

#include <deal.II/grid/grid_in.h>
#include <deal.II/grid/tria.h>

#include <fstream>
#include <iostream>
#include <set>

int main(int, char** arguments) try {
  dealii::Triangulation<2, 3> triangulation;
  dealii::GridIn<2, 3> reader(triangulation);
  std::ifstream file(arguments[1]);
  reader.read_msh(file);
  std::set<int> materials;
  for (const auto& cell : triangulation.active_cell_iterators()) materials.insert(cell->material_id());
  std::cout << triangulation.n_used_vertices() << ' ' << triangulation.n_active_cells() << ' '
            << materials.size() << '\n';
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 1;
}
