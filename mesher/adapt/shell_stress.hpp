#pragma once
/// Stresses inside shell elements, from how their corners at the bottom and the top moved. Internal.

#include <Eigen/Core>
#include <array>
#include <vector>

#include "geometry/base/vector.hpp"
#include "mesher/io/result_reader.hpp"
#include "mesher/mesh/mesh_types.hpp"

namespace quadrille {

/// Components xx, yy, zz, xy, yz, zx in the model's axes.
using Tensor = Eigen::Matrix<double, 6, 1>;

/// The stress at a point in the middle of a shell's thickness, for Young's modulus 1.
struct ShellStress {
  Vector3 point;
  double area = 0;  ///< of the middle surface that it stands for
  double thickness = 0;
  Tensor membrane, bending;  ///< at the middle; what the top has more
};

/// Twice the energy of a stress in an area.
double energy(const Tensor& membrane, const Tensor& bending, double area, double thickness, double poisson);

/// (quads) the stresses at the four points where quadratic elements are most exact. CalculiX makes bricks of
/// shell and plane elements, of eight or twenty nodes, numbered as those; the quads of the mesh are found
/// among them by number or, if that does not fit, in their order. Throws Error (failure) where the two do not
/// belong together.
std::vector<std::array<ShellStress, 4>> shell_stresses(const ShellMesh& mesh, const SolverResult& result,
                                                       double poisson, const std::string& name);

}  // namespace quadrille
