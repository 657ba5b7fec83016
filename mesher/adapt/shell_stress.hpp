#pragma once
/// Stresses inside shell elements, from the displacements of the nodes at their bottom and top. Internal.

#include <Eigen/Core>
#include <array>
#include <vector>

#include "geometry/base/vector.hpp"
#include "mesher/io/result_reader.hpp"
#include "mesher/mesh/mesh_types.hpp"

namespace quadrille {

/// Components xx, yy, zz, xy, yz, zx in the global axes of the model.
using Tensor = Eigen::Matrix<double, 6, 1>;

/// The stress at a point in the middle of a shell's thickness, for Young's modulus 1.
struct ShellStress {
  Vector3 point;
  double area = 0;           ///< area of the middle surface that the point stands for
  double thickness = 0;      ///< thickness of the shell
  Tensor membrane, bending;  ///< stress at the middle; stress at the top minus that at the middle
};

/// Twice the strain energy of a stress state in an area, for Young's modulus 1.
double energy(const Tensor& membrane, const Tensor& bending, double area, double thickness, double poisson);

/// (quads) The stresses at the four points where quadratic elements are most accurate, one for each corner.
/// CalculiX expands shell and plane elements into bricks of eight or twenty nodes. The bricks, in ascending
/// number, belong to the quads of the mesh in order. Throws Error (failure) if the number of elements
/// differs, or a brick is of another type or lies elsewhere than its quad. \param name result file, for
/// messages.
std::vector<std::array<ShellStress, 4>> shell_stresses(const ShellMesh& mesh, const SolverResult& result,
                                                       double poisson, const std::string& name);

}  // namespace quadrille
