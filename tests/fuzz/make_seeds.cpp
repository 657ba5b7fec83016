/// Writes what the fuzz targets start from: a folder of small inputs for each of them.

#include <BRepTools.hxx>
#include <IGESControl_Writer.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <Message_PrinterOStream.hxx>
#include <STEPControl_Writer.hxx>
#include <Standard_Failure.hxx>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>

#include "geometry/cad/cad_shape.hpp"
#include "mesher/io/readers.hpp"
#include "mesher/quadrille.hpp"
#include "tests/fuzz/option_bytes.hpp"
#include "tests/models/trouble_models.hpp"

namespace quadrille {

namespace {

void write_cad(const TopoDS_Shape& shape, const std::filesystem::path& folder, const std::string& name) {
  BRepTools::Write(shape, (folder / "brep" / name).c_str());
  if (name == "missing_curves") return;  // OpenCASCADE's writers crash on it
  STEPControl_Writer step;
  step.Transfer(shape, STEPControl_AsIs);
  step.Write((folder / "step" / name).c_str());
  IGESControl_Writer iges("MM", 1);  // 1: with topology
  iges.AddShape(shape);
  iges.Write((folder / "iges" / name).c_str());
}

void write_meshes(const TroubleModel& trouble, const std::filesystem::path& folder) {
  const CadModel model(std::make_shared<CadShape>(trouble.make(), trouble.name));
  for (const int order : {1, 2}) {
    MeshOptions options;
    options.sizing.elements_per_diagonal = 5;
    options.order = order;
    if (order == 1) options.write_size_field = folder / "vdb" / (trouble.name + ".vdb");
    ExecutionContext context(1);
    const ShellMesh result = mesh(model, options, context);
    for (const char* format : {"msh", "inp"}) {
      const std::string name = trouble.name + std::to_string(order) + "." + format;
      write_mesh(result, folder / format / name);
    }
    write_mesh(result, folder / "msh" / (trouble.name + std::to_string(order) + "v4.msh"),
               {.msh_version = MshVersion::v4_1});
  }
}

constexpr const char* command_lines[] = {
    "mesh\nbox.brep\n-o\nout.msh\n--size\n1\n--size-min\n0.5\n--curvature\n12\n--growth\n0.3",
    "mesh\nbox.brep\n-o\nout.inp\n-o\nout.unv\n--elements-per-diagonal\n20\n--order\n2\n--threads\n2",
    "mesh\nbox.brep\n--output=out.vtu\n--size-on\nFace3=0.5,Edge4=1,Vertex2=0.1\n--faces\nFace1,Face7",
    "mesh\nbox.brep\n-oout.bdf\n--strategy\ndirect\n--time-limit\n3.5\n--partial\n--force\n--"
    "quiet",
    "mesh\nbox.brep\n-o\nout.med\n--size-field\nf.vdb\n--write-size-field\ng.vdb\n--report\nr.json\n--"
    "picture\np.png",
    "mesh\nbox.brep\n-o\nout.vtk\n--msh-version\n4.1",
    "recombine\ntri.msh\n-o\nquad.msh\n--seed\n3\n--no-improve\n--threads\n1\n--quiet",
    "info\nbox.brep",
    "quality\nmesh.msh",
    "--version",
    "mesh\n--help",
};

/// Puts the bytes that choose the options before a file.
void put_options_first(const std::filesystem::path& path) {
  const std::string bytes = whole_file(path);
  std::ofstream(path, std::ios::binary) << std::string(fuzz::OptionBytes::count, '\0') << bytes;
}

void write_seeds(const std::filesystem::path& folder) {
  for (const char* format : {"brep", "step", "iges", "msh", "inp", "vdb", "options"}) {
    std::filesystem::create_directories(folder / format);
  }
  Message::DefaultMessenger()->RemovePrinters(STANDARD_TYPE(Message_PrinterOStream));
  for (const TroubleModel& trouble : trouble_models()) {
    try {
      write_cad(trouble.make(), folder, trouble.name);
      write_meshes(trouble, folder);
    } catch (const Standard_Failure& problem) {
      std::fprintf(stderr, "%s: %s\n", trouble.name.c_str(), problem.GetMessageString());
    } catch (const Error& error) {
      std::fprintf(stderr, "%s: %s\n", trouble.name.c_str(), error.what());
    }
  }
  for (const auto& file : std::filesystem::recursive_directory_iterator(folder)) {
    if (file.is_regular_file()) put_options_first(file.path());
  }
  int number = 0;
  for (const char* line : command_lines) {
    std::ofstream(folder / "options" / std::to_string(number++)) << line;
  }
}

}  // namespace

}  // namespace quadrille

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fputs("usage: make_seeds FOLDER\n", stderr);
    return 2;
  }
  quadrille::write_seeds(argv[1]);
  return 0;
}
