/// consumer IN OUT...: meshes a CAD file, tells of progress and errors, and writes files, through the public
/// header.

#include <iostream>
#include <quadrille/quadrille.hpp>
#include <quadrille/settings.hpp>

int main(int argc, char** argv) try {
  const quadrille::CadModel model = quadrille::CadModel::read(argv[1]);
  quadrille::MeshOptions options;
  options.sizing.size = model.diagonal() / 20;
  int reports = 0;
  quadrille::ExecutionContext context(0, [&](std::string_view, double) { return ++reports > 0; });
  const quadrille::ShellMesh mesh = quadrille::mesh(model, options, context);
  for (int i = 2; i < argc; ++i) quadrille::write_mesh(mesh, argv[i]);
  const quadrille::QualitySummary summary = quadrille::quality(mesh);
  std::cout << quadrille::version() << ' ' << model.face_count() << " faces, " << mesh.quads.size()
            << " quads, " << summary.inverted << " inverted, " << quadrille::check_criteria(mesh).quads
            << " checked, " << quadrille::validate(mesh).size() << " problems\n";
  options.sizing.size = -1;  // an error of the library, caught on this side of it
  quadrille::mesh(model, options, context);
  return 1;
} catch (const quadrille::Error& error) {
  std::cout << (error.kind() == quadrille::Error::Kind::usage ? "refused: " : "failed: ") << error.what()
            << '\n';
  return error.kind() == quadrille::Error::Kind::usage ? 0 : 1;
}
