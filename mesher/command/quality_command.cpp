/// quadrille quality MESH: the measures of a mesh file.

#include <fmt/format.h>

#include "mesher/command/command.hpp"
#include "mesher/command/limits_option.hpp"
#include "mesher/command/tables.hpp"
#include "mesher/quadrille.hpp"

namespace quadrille::command {

void add_quality_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "quality", "measure a mesh: counts, q, Jacobians, valence, and quads that fail the industry criteria");
  auto input = std::make_shared<std::filesystem::path>();
  auto limits_option = std::make_shared<LimitsOption>();
  command->add_option("MESH", *input, "mesh file: " + read_endings("or"))->required();
  limits_option->add_to(*command);
  auto size_min = std::make_shared<double>(0);
  command
      ->add_option("--size-min", *size_min,
                   "minimum size of the mesh, in mm: sides shorter than half of it fail")
      ->check(number(positive));
  command->callback([input, limits_option, size_min] {
    require_readable(*input);
    limits_option->check();
    ShellMesh mesh = read_mesh(*input);
    mesh.size_min = *size_min;
    const CriteriaLimits limits = limits_option->limits(mesh);
    const QualitySummary summary = quality(mesh);
    const CriteriaSummary criteria = check_criteria(mesh, limits);
    print(quality_table(summary) + "\n" + quality_histogram(summary) + "\n" + valence_table(summary) + "\n" +
          criteria_table(criteria, limits));
    limits_option->hold(*input, mesh);
  });
}

}  // namespace quadrille::command
