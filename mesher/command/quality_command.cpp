/// quadrille quality MESH: the measures of a mesh file.

#include <fmt/format.h>

#include "mesher/command/command.hpp"
#include "mesher/command/print_quality.hpp"
#include "mesher/quadrille.hpp"

namespace quadrille::command {

void add_quality_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "quality", "measure a mesh: counts, q, Jacobians, valence, and what fails industry's criteria");
  auto input = std::make_shared<std::filesystem::path>();
  auto limits_file = std::make_shared<std::string>();
  command->add_option("MESH", *input, "mesh file: .msh or .inp")->required();
  CLI::Option* limits_option =
      command
          ->add_option(
              "--limits", *limits_file,
              "exit with 1 when quads fail the criteria; with a FILE, JSON or a HyperMesh criteria file, "
              "those of it in place of the usual limits")
          ->expected(0, 1);
  command->callback([input, limits_file, limits_option] {
    require_readable(*input);
    CriteriaLimits limits;
    if (!limits_file->empty()) {
      require_readable(*limits_file);
      limits = read_limits(*limits_file);
    }
    const ShellMesh mesh = read_mesh(*input);
    const QualitySummary summary = quality(mesh);
    const CriteriaSummary criteria = check_criteria(mesh, limits);
    print(quality_table(summary) + "\n" + quality_histogram(summary) + "\n" + valence_table(summary) + "\n" +
          criteria_table(criteria, limits));
    if (limits_option->count() > 0 && criteria.failing > 0)
      throw failure(input->string(), fmt::format("{}: {} of {} quads are outside the limits", input->string(),
                                                 criteria.failing, criteria.quads));
  });
}

}  // namespace quadrille::command
