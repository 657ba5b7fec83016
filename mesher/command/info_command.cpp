/// quadrille info IN: what a CAD model contains, and suitable sizes.

#include <fmt/format.h>

#include <functional>

#include "geometry/base/error.hpp"
#include "geometry/base/place_text.hpp"
#include "geometry/cad/cad_shape.hpp"
#include "geometry/surfaces/contacts.hpp"
#include "geometry/surfaces/stray_edges.hpp"
#include "mesher/command/command.hpp"
#include "mesher/mesh/entity_name.hpp"
#include "mesher/quadrille.hpp"

namespace quadrille::command {

namespace {

void add_sizes(const CadModel& model, ExecutionContext& context,
               const std::function<void(std::string_view, const std::string&)>& line) {
  QuadEstimate estimate(model, context);
  double before = 0;
  for (const double quads : {1e3, 1e4, 1e5}) {
    const QuadEstimate::Suggestion found = estimate.size_for(quads);
    if (found.size == before) continue;  // the model's own edges need more quads
    before = found.size;
    line("size", fmt::format("--size {:g} for about {:.0f} quads", found.size, found.quads));
  }
}

std::string describe(const CadModel& model, ExecutionContext& context) {
  std::string text;
  const auto line = [&](std::string_view label, const std::string& value) {
    text += fmt::format("{:<12} {}\n", label, value);
  };
  line("solids", std::to_string(model.solid_count()));
  line("shells", std::to_string(model.shell_count()));
  line("faces", std::to_string(model.face_count()));
  line("edges", std::to_string(model.edge_count()));
  line("vertices", std::to_string(model.vertex_count()));
  line("box", fmt::format("{} to {}", place_text(model.box_min()), place_text(model.box_max())));
  line("diagonal", fmt::format("{:.6g} mm", model.diagonal()));
  std::string unmeasured;
  try {
    line("area", fmt::format("{:.6g} mm2", model.area(context)));
  } catch (const Error& error) {
    if (error.kind() != Error::Kind::failure || !error.subject().starts_with("Face")) throw;
    unmeasured = error.what();
  }
  const auto strays = stray_edges(model.shape(), FaceFlags(model.face_count(), 1));
  if (strays.empty()) add_sizes(model, context, line);
  const std::string touching = contacts(model.shape(), context).sentence();
  if (!touching.empty()) line("problem", with_options(touching));
  for (const StrayEdge& stray : strays) line("problem", stray.sentence());
  if (!unmeasured.empty()) line("problem", unmeasured);
  if (model.problems().empty() && strays.empty() && unmeasured.empty() && touching.empty())
    line("problems", "none found");
  for (const std::string& problem : model.problems()) line("problem", problem);
  return text;
}

/// The features that are suppressed at a size, and small ones that are kept.
std::string features(const CadModel& model, const MeshOptions& options, ExecutionContext& context) {
  const SmallFeatures found = small_features(model, options, context);
  using Kind = ShellMesh::SuppressedFeature::Kind;
  std::string text;
  for (const auto& feature : found.suppressed_features)
    text += fmt::format("{:<12} {} becomes {}, at most {} mm away\n", "suppressed",
                        entity_name(feature.kind == Kind::edge ? 1 : 0, feature.number),
                        entity_name(feature.to_kind == Kind::edge ? 1 : 0, feature.to),
                        number_text(feature.distance));
  for (const int face : found.faces) text += fmt::format("{:<12} Face{}\n", "suppressed", face);
  for (const auto& hole : found.holes)
    text +=
        fmt::format("{:<12} {} of diameter {} in Face{} at {}\n", "suppressed", hole.boss ? "boss" : "hole",
                    number_text(hole.diameter), hole.in.front(), place_text(hole.center));
  for (const auto& feature : found.kept)
    text +=
        fmt::format("{:<12} {}: {}\n", "kept", entity_name(feature.dimension, feature.number), feature.why);
  return text.empty() ? fmt::format("{:<12} nothing is too small for this size\n", "features") : text;
}

}  // namespace

void add_info_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("info", "show the contents of a CAD model and suitable sizes");
  auto arguments = std::make_shared<RunArguments>();
  arguments->quiet = true;
  command->add_option("IN", arguments->input, "CAD file: .step, .stp, .iges, .igs, .brep")->required();
  add_settings(
      *command, *arguments,
      {"imprint", "sew", "read_time_limit", "time_limit", "size", "size_min", "reach", "keep", "fill_holes"});
  auto with_features = std::make_shared<bool>(false);
  command
      ->add_flag("--features", *with_features,
                 "list the small features that a mesh of --size suppresses, and those that it keeps and why")
      ->needs("--size");
  command->callback([arguments, with_features] {
    require_readable(arguments->input);
    Work work(*arguments);
    const CadModel model = read_model(*arguments, "measuring", work);
    print(*with_features ? features(model, arguments->settings.mesh, work.context)
                         : describe(model, work.context));
  });
}

}  // namespace quadrille::command
