#pragma once
/// The writers behind write_mesh(), one per format.

#include <filesystem>

#include "mesher/io/io.hpp"
#include "mesher/io/output_mesh.hpp"
#include "mesher/io/text_writer.hpp"

namespace quadrille {

/// A mesh on its way into a file.
struct Writing {
  const ShellMesh& mesh;
  const OutputMesh& output;  ///< the same mesh, in the coordinates of the model
  const std::filesystem::path& path;
  const WriteOptions& options;
};

void write_msh(const Writing& writing, TextWriter& out);  ///< Gmsh .msh, ASCII, 2.2 or 4.1
void write_inp(const Writing& writing, TextWriter& out);  ///< Abaqus/CalculiX .inp
void write_unv(const Writing& writing, TextWriter& out);
void write_bdf(const Writing& writing, TextWriter& out);
/// Legacy .vtk and XDMF 3 as text, with only the shell elements as cells.
void write_vtk(const Writing& writing, TextWriter& out);
void write_xdmf(const Writing& writing, TextWriter& out);
/// SU2's native mesh; it holds first order only.
void write_su2(const Writing& writing, TextWriter& out);

}  // namespace quadrille
