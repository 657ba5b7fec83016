/// quadrille quality MESH: the measures of a mesh file.

#include <fmt/format.h>

#include "mesher/command/command.hpp"
#include "mesher/command/limits_option.hpp"
#include "mesher/command/tables.hpp"
#include "mesher/quadrille.hpp"

namespace quadrille::command {

namespace {

struct QualityArguments {
  std::filesystem::path input;
  double size_min = 0;
  LimitsOption limits;
};

void run(const QualityArguments& arguments) {
  require_readable(arguments.input);
  arguments.limits.check();
  ShellMesh mesh = read_mesh(arguments.input);
  mesh.size_min = arguments.size_min;
  const CriteriaLimits limits = arguments.limits.of(mesh);
  const QualitySummary summary = quality(mesh);
  print(quality_table(summary) + "\n" + quality_histogram(summary) + "\n" + valence_table(summary) + "\n" +
        criteria_table(check_criteria(mesh, limits), limits));
  arguments.limits.hold(arguments.input, mesh);
}

}  // namespace

void add_quality_command(CLI::App& app) {
  auto [command, arguments] = add_command<QualityArguments>(
      app, "quality",
      "measure a mesh: counts, q, Jacobians, valence, and quads that fail the industry criteria");
  command.add_option("MESH", arguments.input, "mesh file: " + read_endings("or"))->required();
  arguments.limits.add_to(command);
  command
      .add_option("--size-min", arguments.size_min,
                  "minimum size of the mesh, in mm: sides shorter than half of it fail")
      ->check(number(positive));
}

}  // namespace quadrille::command
