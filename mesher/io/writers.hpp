#pragma once
/// The writers behind write_mesh(), one per format.

#include <filesystem>

#include "mesher/io/io.hpp"
#include "mesher/io/output_mesh.hpp"
#include "mesher/io/text_writer.hpp"

namespace quadrille {

void write_msh2(const OutputMesh& mesh, TextWriter& out);  ///< Gmsh .msh 2.2, ASCII
void write_msh4(const OutputMesh& mesh, TextWriter& out);  ///< Gmsh .msh 4.1, ASCII
/// Abaqus/CalculiX .inp. \param comment a line for readers of the file; empty = none.
void write_inp(const OutputMesh& mesh, const WriteOptions& options, const std::string& comment,
               TextWriter& out);
void write_unv(const OutputMesh& mesh, TextWriter& out);
void write_bdf(const OutputMesh& mesh, const WriteOptions& options, TextWriter& out);
/// Legacy .vtk as text, with only the shell elements as cells. \param qualities (quads) q of each quad.
void write_vtk(const OutputMesh& mesh, const WriteOptions& options, const std::vector<double>& qualities,
               TextWriter& out);

}  // namespace quadrille
