/// quadrille remesh SURFACE -o OUT --size H: a triangulated surface in, an all-quad shell mesh out.

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "geometry/base/place_text.hpp"
#include "geometry/base/threads.hpp"
#include "mesher/command/command.hpp"
#include "mesher/command/limits_option.hpp"
#include "mesher/command/surface_input.hpp"
#include "mesher/command/tables.hpp"
#include "mesher/io/report.hpp"
#include "mesher/quadrille.hpp"

namespace quadrille::command {

namespace {

struct RemeshArguments : SurfaceArguments {
  LimitsOption limits;
};

nlohmann::json fidelity_json(const RemeshFidelity& fidelity) {
  const auto distance = [](const RemeshFidelity::Distance& d) {
    return nlohmann::json{{"distance", d.length}, {"at", d.at}, {"face", fmt::format("Face{}", d.face)}};
  };
  nlohmann::json result{{"mesh_from_surface", distance(fidelity.of_mesh)},
                        {"surface_from_mesh", distance(fidelity.of_surface)},
                        {"area", {{"surface", fidelity.surface_area}, {"mesh", fidelity.mesh_area}}}};
  if (fidelity.surface_volume != 0)
    result["volume"] = {{"surface", fidelity.surface_volume}, {"mesh", fidelity.mesh_volume}};
  return result;
}

std::string fidelity_line(const RemeshFidelity& fidelity) {
  const double percent = 100 * (fidelity.mesh_area / fidelity.surface_area - 1);
  return fmt::format(
      "surface: the mesh is up to {} off it (Face{}), it is up to {} off the mesh (Face{}), area "
      "{:+.2g} %\n",
      number_text(fidelity.of_mesh.length), fidelity.of_mesh.face, number_text(fidelity.of_surface.length),
      fidelity.of_surface.face, percent);
}

void tell(const ShellMesh& mesh, const RemeshFidelity& fidelity, const std::vector<std::string>& notes,
          const RemeshArguments& arguments, ExecutionContext& context) {
  for (const std::string& note : notes) say("{}: {}", arguments.input.string(), note);
  if (arguments.quiet && arguments.report.empty()) return;
  const MeshMeasures measures = on_threads(arguments.settings.threads, [&] { return measure(mesh); });
  if (!arguments.report.empty()) {
    nlohmann::json report =
        make_report(mesh, measures, context, arguments.input, notes, arguments.settings.write.scale);
    report["fidelity"] = fidelity_json(fidelity);
    write_report(report, arguments.report);
  }
  if (!arguments.quiet) print(quality_table(measures.quality) + fidelity_line(fidelity));
}

void run(const RemeshArguments& arguments) {
  check_formats(arguments);
  require_usable(arguments, "SURFACE", {{"--limits", arguments.limits.file()}});
  Work work(arguments,
            {Stage::read, Stage::sample, Stage::triangulate, Stage::mesh, Stage::assemble, Stage::write});
  ExecutionContext& context = work.context;
  arguments.limits.check();  // may wait, if the file is a pipe
  std::vector<std::string> notes;
  context.report(Stage::read, 0);
  const ShellMesh input = [&] {
    const StageTimer timer(context, Stage::read);
    return read_mesh(arguments.input, &notes);
  }();
  RemeshOptions options;
  options.size = arguments.settings.mesh.sizing.size;
  options.order = order_of(arguments);
  options.force = arguments.settings.mesh.force;
  options.merge = arguments.merge;
  options.feature_angle = arguments.feature_angle(input);
  RemeshFidelity fidelity;
  const ShellMesh mesh =
      made_from(input, arguments.input, [&] { return remesh(input, options, &fidelity, notes, context); });
  write_outputs(mesh, arguments, work);
  tell(mesh, fidelity, notes, arguments, context);
  // Last, so that a failing mesh has been written and can be inspected.
  arguments.limits.hold(arguments.outputs.front(), mesh);
}

}  // namespace

void add_remesh_command(CLI::App& app) {
  auto [command, arguments] = add_command<RemeshArguments>(
      app, "remesh", "remesh a triangulated surface, such as a scan, with quads");
  command.add_option("SURFACE", arguments.input, "triangles, or triangles and quads: " + read_endings("or"))
      ->required();
  add_outputs(command, arguments, "mesh file: " + written_endings("or"));
  add_settings(command, arguments,
               {"size", "order", "force", "time_limit", "threads", "msh_version", "nodes", "element", "scale",
                "groups"});
  command.get_option("--size")->required()->description("target edge length, in mm");
  add_surface_options(command, arguments,
                      "on they belong to different faces; 0 = faces do not depend on angles");
  command.add_option("--report", arguments.report,
                     "write counts, quality, distances to the surface and times as JSON");
  command.add_option("--picture", arguments.picture, "draw the mesh into a .png");
  add_run_options(command, arguments, "no progress, no quality table");
  arguments.limits.add_to(command);
}

}  // namespace quadrille::command
