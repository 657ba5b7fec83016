/// quadrille mesh IN -o OUT: a CAD model in, an all-quad shell mesh out.

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <oneapi/tbb/parallel_invoke.h>

#include <algorithm>
#include <future>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>

#include "geometry/base/place_text.hpp"
#include "geometry/base/threads.hpp"
#include "geometry/surfaces/contacts.hpp"
#include "mesher/command/command.hpp"
#include "mesher/command/limits_option.hpp"
#include "mesher/command/tables.hpp"
#include "mesher/io/midsurface_writer.hpp"
#include "mesher/io/report.hpp"
#include "mesher/mesh/coincidences.hpp"
#include "mesher/mesh/entity_name.hpp"
#include "mesher/mesh/skins.hpp"
#include "mesher/quadrille.hpp"
#include "mesher/shell/size_fidelity.hpp"

namespace quadrille::command {

namespace {

struct MeshArguments : RunArguments {
  LimitsOption limits;
  bool thin = false, join = false;
};

/// Draws a middle surface that was refused, as far as it can be made and meshed, with the edges marked that
/// end inside the material. \return what the picture shows, in words; empty = there is none.
std::string draw_refused(const CadModel& model, MidSurfaceOptions options, const MeshArguments& arguments,
                         ExecutionContext& context) {
  options.partial = true;
  MeshOptions meshing = arguments.settings.mesh;
  meshing.partial = true;
  meshing.write_size_field.clear();
  try {
    const MidSurface middle = midsurface(model, options, context);
    ShellMesh result = mesh(middle, meshing, context);
    result.marked_edges = middle.stray_edges;
    draw_apart(result, arguments.picture, context);
    return fmt::format("{} shows it{}", arguments.picture.string(),
                       middle.stray_edges.empty() ? "" : ", with edges inside the material in red");
  } catch (const Error& error) {
    if (error.kind() == Error::Kind::cancelled) throw;
    return "";  // the error message says more
  }
}

/// The middle surface of the model's solids with --thin; else empty.
std::optional<MidSurface> middle_of(const CadModel& model, const MeshArguments& arguments,
                                    ExecutionContext& context) {
  if (!arguments.thin) return std::nullopt;
  MidSurfaceOptions options;
  options.partial = arguments.settings.mesh.partial;
  options.join = arguments.join;
  try {
    return midsurface(model, options, context);
  } catch (const Error& refusal) {
    if (arguments.picture.empty() || refusal.kind() != Error::Kind::failure ||
        refusal.subject() == ExecutionContext::time_subject)
      throw;
    const std::string shown = draw_refused(model, options, arguments, context);
    if (shown.empty()) throw;
    throw failure(refusal.subject(), fmt::format("{}; {}", refusal.what(), shown));
  }
}

/// Prints one line for each face, and each node of --node, that --partial leaves out.
void list_left_out(const ShellMesh& mesh) {
  for (const ShellMesh::Face& face : mesh.faces) {
    if (face.status == FaceStatus::failed) say("quadrille: left out: Face{}: {}", face.face, face.note);
  }
  for (const ShellMesh::PlacedNode& node : mesh.placed_nodes) {
    if (node.vertex == 0) say("quadrille: left out: {}: the mesh has no node there", node.name);
  }
}

/// Adds a warning if nodes lie off the geometry.
void warn_off_geometry(const ShellMesh& mesh, std::vector<std::string>& warnings) {
  const auto worst = std::max_element(mesh.faces.begin(), mesh.faces.end(), [](const auto& a, const auto& b) {
    return a.off_geometry_max < b.off_geometry_max;
  });
  if (mesh.off_geometry.empty() || worst == mesh.faces.end()) return;
  warnings.push_back(
      fmt::format("{} nodes lie off the geometry, because elements on it would be invalid, the farthest on "
                  "Face{} (by {}): use a smaller size there to keep them on it",
                  mesh.off_geometry.size(), worst->face, number_text(worst->off_geometry_max)));
}

struct Measured {
  MeshMeasures elements;
  Coincidences coincidences;
  Contacts contacts;
  std::vector<int> bad_skins;  ///< faces, see faces_with_bad_skins()
};

/// Measures in a thread of its own while the files are written, if more than one thread may be used.
std::future<Measured> start_to_measure(const ShellMesh& mesh, const CadModel& model, int threads) {
  const auto policy =
      std::launch::deferred | (usable_threads(threads) > 1 ? std::launch::async : std::launch::deferred);
  return std::async(policy, [&mesh, &model, threads] {
    return on_threads(threads, [&] {
      Measured measured;
      oneapi::tbb::parallel_invoke(
          [&] {
            Coincidences& found = measured.coincidences = coincidences(mesh);
            // Parts that touch may have no node in common, and edges on each other few.
            const Contacts touching = contacts(model.shape());
            if (found.nodes == 0)
              measured.contacts = touching;
            else if (!touching.faces.empty())
              found.sewing_suffices = touching.free_edges && found.quads == 0;
          },
          [&] { measured.elements = measure(mesh); },
          [&] { measured.bad_skins = faces_with_bad_skins(mesh); });
      return measured;
    });
  });
}

/// The settings against coincident nodes that hold already.
std::set<std::string_view> tried_settings(const Settings& settings) {
  std::set<std::string_view> tried;
  if (settings.imprint) tried.insert("imprint");
  if (settings.sew > 0) tried.insert("sew");
  if (settings.mesh.keep_features) tried.insert("keep_features");
  return tried;
}

/// What touches without being joined, in the mesh and between the parts of the model.
nlohmann::json coincident_to_json(const Measured& measured, const std::set<std::string_view>& tried) {
  const Coincidences& found = measured.coincidences;
  nlohmann::json touching = nlohmann::json::array();
  for (const auto& [face, other] : measured.contacts.faces)
    touching.push_back(entity_names(2, {face, other}));
  const std::string_view setting =
      measured.contacts.faces.empty() ? found.remedy() : measured.contacts.remedy();
  const std::string remedy = tried.count(setting) > 0 ? "" : option_of(setting);
  return {{"nodes", found.nodes},
          {"quads", found.quads},
          {"free_edges", entity_names(1, found.free_edges)},
          {"faces", entity_names(2, found.faces)},
          {"touching_faces", touching},
          {"remedy", remedy.empty() ? nlohmann::json() : nlohmann::json(remedy)}};
}

/// What each face, edge and vertex of the file became.
nlohmann::json imprinted_to_json(const CadModel& model) {
  nlohmann::json result = nlohmann::json::object();
  const auto add = [&](int dimension, const std::vector<std::vector<int>>& pieces) {
    for (std::size_t i = 0; i < pieces.size(); ++i)
      result[entity_name(dimension, static_cast<int>(i) + 1)] = entity_names(dimension, pieces[i]);
  };
  add(2, model.pieces());
  add(1, model.edge_pieces());
  add(0, model.vertex_pieces());
  return result;
}

/// The mesh, its model and their checks.
struct Meshed {
  const CadModel& model;
  const std::optional<MidSurface>& middle;  ///< with --thin
  const std::optional<SizeFidelity>& sizes;
};

/// Adds a note on quads outside the limits and short sides, with what forces most of them.
void tell_poor_quads(const ShellMesh& mesh) {
  if (mesh.poor_quads.empty()) return;
  int quads = 0, forced = 0;
  for (const auto& found : mesh.poor_quads) {
    quads += found.quads;
    if (found.is_forced()) forced += found.quads;
  }
  const auto& most = mesh.poor_quads.front();
  say("note: {} quads are outside the usual limits (warp is not counted) or have sides under half the least "
      "size, {} of them forced by edges, corners and widths of the part; most of all at {} ({}): {}; "
      "--report lists all",
      quads, forced, entity_name(most.dimension, most.number), most.quads, most.why);
}

/// Writes the report, the warnings to stderr and the tables to stdout, if requested.
void tell_quality(const ShellMesh& result, const Measured& measured, const Meshed& meshed,
                  const MeshArguments& arguments, ExecutionContext& context) {
  std::vector<std::string> warnings = meshed.model.problems();
  if (meshed.middle) {
    for (const auto& told : {meshed.middle->problems, meshed.middle->warnings})
      warnings.insert(warnings.end(), told.begin(), told.end());
  }
  for (const std::string& warning : result.warnings) warnings.push_back(with_options(warning));
  warn_off_geometry(result, warnings);
  const std::set<std::string_view> tried = tried_settings(arguments.settings);
  for (const std::string& sentence :
       {measured.coincidences.sentence(tried), measured.contacts.sentence(tried)})
    if (!sentence.empty()) warnings.push_back(with_options(sentence));
  if (!measured.bad_skins.empty()) warnings.push_back(bad_skins_sentence(measured.bad_skins));
  if (!arguments.report.empty()) {
    nlohmann::json report = make_report(result, measured.elements, context, arguments.input, warnings,
                                        arguments.settings.write.scale);
    if (meshed.sizes) report["sizes"] = meshed.sizes->json();
    if (meshed.middle) report["middle_surface"] = midsurface_json(*meshed.middle);
    if (meshed.middle) report["skins"] = {{"turned_over", entity_names(2, measured.bad_skins)}};
    report["coincident"] = coincident_to_json(measured, tried);
    if (!meshed.model.pieces().empty()) report["imprinted"] = imprinted_to_json(meshed.model);
    write_report(report, arguments.report);
  }
  if (arguments.quiet) return;
  for (const std::string& warning : warnings) say("warning: {}", warning);
  if (!result.crossed_edges.empty()) {
    const int edge = result.crossed_edges.front().edge;
    say("note: quads cross smooth edges ({}, Edge{} first), which get no groups of their own: --keep "
        "Edge{} keeps "
        "it, --keep-features all",
        result.crossed_edges.size(), edge, edge);
  }
  if (!result.filled_holes.empty())
    say("note: {} holes, pockets and bosses are left out; --report lists them", result.filled_holes.size());
  tell_poor_quads(result);
  if (meshed.middle) print(middle_table(*meshed.middle));
  print(quality_table(measured.elements.quality));
}

void run(const MeshArguments& arguments) {
  check_formats(arguments);
  require_usable(arguments, "IN", {{"--limits", arguments.limits.file()}});
  Settings settings = arguments.settings;
  std::vector<Stage> stages{Stage::read,  Stage::size,     Stage::sample, Stage::mesh,
                            Stage::slide, Stage::assemble, Stage::write};
  if (arguments.thin) stages.insert(stages.begin() + 1, Stage::midsurface);
  Work work(arguments, stages, settings.mesh.partial);
  ExecutionContext& context = work.context;
  arguments.limits.check();  // may wait, if the file is a pipe
  const CadModel source = read_model(arguments, "meshing", work);
  const std::optional<MidSurface> middle = middle_of(source, arguments, context);
  const CadModel& model = middle ? middle->model : source;
  context.check();
  if (!middle) settings = with_pieces(settings, model);
  check(settings, model);
  MeshOptions options = settings.mesh;
  options.order = order_of(arguments);
  const bool is_told = !arguments.quiet || !arguments.report.empty();
  options.check_curved_areas = is_told;  // whose differences are warnings only
  std::optional<SizeFidelity> sizes;
  if (!arguments.report.empty())
    options.inspect = [&](const ShellMesh& made, const SizingField& field) {
      sizes = size_fidelity(made, field, model.shape());
    };
  const ShellMesh result = middle ? mesh(*middle, options, context) : mesh(model, options, context);
  context.check();
  std::future<Measured> measured;
  if (is_told) measured = start_to_measure(result, model, settings.threads);
  write_outputs(result, arguments, work);
  list_left_out(result);
  if (measured.valid()) tell_quality(result, measured.get(), {model, middle, sizes}, arguments, context);
  // Last, so that a failing mesh has been written and can be inspected.
  arguments.limits.hold(arguments.outputs.front(), result);
}

}  // namespace

void add_mesh_command(CLI::App& app) {
  auto [command, arguments] = add_command<MeshArguments>(app, "mesh", "mesh a CAD model with quads");
  add_model(command, arguments);
  add_outputs(command, arguments, "mesh file: " + written_endings("or"));
  add_settings(command, arguments);
  command.get_option("--elements-per-diagonal")->excludes("--size");
  command.add_option("--write-size-field", arguments.settings.mesh.write_size_field,
                     "write the sizing field of the mesh as OpenVDB grids (.vdb)");
  command.add_option("--report", arguments.report, "write counts, quality and times as JSON");
  command.add_option("--picture", arguments.picture, "draw the mesh into a .png");
  command.add_flag("--thin", arguments.thin,
                   "mesh the middle surface of thin solids, with a group for each thickness");
  command
      .add_flag("--join", arguments.join, "with --thin: treat solids that touch as one part, as if welded")
      ->needs("--thin");
  add_run_options(command, arguments, "no progress, no quality table");
  arguments.limits.add_to(command);
}

}  // namespace quadrille::command
