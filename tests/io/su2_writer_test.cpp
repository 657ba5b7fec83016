/// SU2's own format: dimensions and markers.

#include <gtest/gtest.h>

#include <string>

#include "mesher/io/io.hpp"
#include "tests/support/process.hpp"
#include "tests/support/shell_grid.hpp"

namespace quadrille {
namespace {

using test::ShellGrid;
using test::TemporaryFolder;

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// SU2 refuses lines in a mesh with three coordinates.
TEST(Su2, HasTwoCoordinatesInThePlaneAndMarkersOfItsEdges) {
  const TemporaryFolder folder;
  const auto text_of = [&](const ShellMesh& mesh) {
    write_mesh(mesh, folder / "a.su2");
    return test::file_text(folder / "a.su2");
  };
  ShellMesh mesh = ShellGrid(2, 1, 0).mesh();
  mesh.extra_groups = {{"all rims", 1, 0, {4, 5, 6, 7}}};
  mesh.points[0].z() = 1e-16;
  const std::string plane = text_of(mesh);
  EXPECT_TRUE(contains(plane, "NDIME= 2\nNPOIN= 15\n0 0\n0.5 0\n")) << plane;
  EXPECT_TRUE(contains(plane, "\nNELEM= 8\n9 0 1 6 5\n")) << plane;
  EXPECT_TRUE(contains(plane, "\nNMARK= 7\nMARKER_TAG= Edge1\nMARKER_ELEMS= 2\n3 0 5\n3 5 10\n")) << plane;
  mesh.groups = {{"far (field), 1", 1, 0, {4, 6}}};
  EXPECT_TRUE(contains(text_of(mesh), "\nNMARK= 1\nMARKER_TAG= far__field___1\nMARKER_ELEMS= 4\n"));
  EXPECT_TRUE(contains(text_of(ShellGrid(2, 1).mesh()), "NDIME= 3\nNPOIN= 15\n0 0 0\n"));
}

}  // namespace
}  // namespace quadrille
