/// quadrille info IN: what a CAD model contains, and suitable sizes.

#include <fmt/format.h>

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

struct InfoArguments : RunArguments {
  bool features = false;
};

std::string line(std::string_view label, const std::string& value) {
  return fmt::format("{:<12} {}\n", label, value);
}

std::string sizes(const CadModel& model, ExecutionContext& context) {
  QuadEstimate estimate(model, context);
  std::string text;
  double before = 0;
  for (const double quads : {1e3, 1e4, 1e5}) {
    const QuadEstimate::Suggestion found = estimate.size_for(quads);
    if (found.size == before) continue;  // the model's own edges need more quads
    before = found.size;
    text += line("size", fmt::format("--size {:g} for about {:.0f} quads", found.size, found.quads));
  }
  return text;
}

std::string describe(const CadModel& model, ExecutionContext& context) {
  std::string text =
      line("solids", std::to_string(model.solid_count())) +
      line("shells", std::to_string(model.shell_count())) +
      line("faces", std::to_string(model.face_count())) + line("edges", std::to_string(model.edge_count())) +
      line("vertices", std::to_string(model.vertex_count())) +
      line("box", fmt::format("{} to {}", place_text(model.box_min()), place_text(model.box_max()))) +
      line("diagonal", fmt::format("{:.6g} mm", model.diagonal()));
  std::string unmeasured;
  try {
    text += line("area", fmt::format("{:.6g} mm2", model.area(context)));
  } catch (const Error& error) {
    if (error.kind() != Error::Kind::failure || !error.subject().starts_with("Face")) throw;
    unmeasured = error.what();
  }
  const auto strays = stray_edges(model.shape(), FaceFlags(model.face_count(), 1));
  if (strays.empty()) text += sizes(model, context);
  std::vector<std::string> problems{with_options(contacts(model.shape(), context).sentence())};
  for (const StrayEdge& stray : strays) problems.push_back(stray.sentence());
  problems.push_back(unmeasured);
  problems.insert(problems.end(), model.problems().begin(), model.problems().end());
  std::erase(problems, "");
  for (const std::string& problem : problems) text += line("problem", problem);
  return problems.empty() ? text + line("problems", "none found") : text;
}

/// The features that are suppressed at a size, and small ones that are kept.
std::string features(const CadModel& model, const MeshOptions& options) {
  const SmallFeatures found = small_features(model, options);
  using Kind = ShellMesh::SuppressedFeature::Kind;
  std::string text;
  for (const auto& feature : found.suppressed_features)
    text += line("suppressed", fmt::format("{} becomes {}, at most {} mm away",
                                           entity_name(feature.kind == Kind::edge ? 1 : 0, feature.number),
                                           entity_name(feature.to_kind == Kind::edge ? 1 : 0, feature.to),
                                           number_text(feature.distance)));
  for (const int face : found.faces) text += line("suppressed", entity_name(2, face));
  for (const auto& hole : found.holes)
    text +=
        line("suppressed", fmt::format("{} of diameter {} in Face{} at {}", hole.boss ? "boss" : "hole",
                                       number_text(hole.diameter), hole.in.front(), place_text(hole.center)));
  for (const auto& feature : found.kept)
    text += line("kept", fmt::format("{}: {}", entity_name(feature.dimension, feature.number), feature.why));
  return text.empty() ? line("features", "nothing is too small for this size") : text;
}

void run(const InfoArguments& arguments) {
  require_readable(arguments.input);
  Work work(arguments);
  const CadModel model = read_model(arguments, "measuring", work);
  print(arguments.features ? features(model, arguments.settings.mesh) : describe(model, work.context));
}

}  // namespace

void add_info_command(CLI::App& app) {
  auto [command, arguments] =
      add_command<InfoArguments>(app, "info", "show the contents of a CAD model and suitable sizes");
  arguments.quiet = true;
  add_model(command, arguments);
  add_settings(
      command, arguments,
      {"imprint", "sew", "read_time_limit", "time_limit", "size", "size_min", "reach", "keep", "fill_holes"});
  command
      .add_flag("--features", arguments.features,
                "list the small features that a mesh of --size suppresses, and those that it keeps and why")
      ->needs("--size");
}

}  // namespace quadrille::command
