/// quadrille quality MESH: the measures of a mesh file.

#include "mesher/command/command.hpp"
#include "mesher/command/print_quality.hpp"
#include "mesher/quadrille.hpp"

namespace quadrille::command {

void add_quality_command(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("quality", "measure a mesh: counts, q, scaled Jacobian, valence, aspect");
  auto input = std::make_shared<std::filesystem::path>();
  command->add_option("MESH", *input, "mesh file: .msh or .inp")->required();
  command->callback([input] {
    require_readable(*input);
    const QualitySummary summary = quality(read_mesh(*input));
    print(quality_table(summary) + "\n" + quality_histogram(summary) + "\n" + valence_table(summary));
  });
}

}  // namespace quadrille::command
