/// quadrille mesh IN -o OUT: a CAD model in, an all-quad shell mesh out.

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <optional>

#include "geometry/base/threads.hpp"
#include "mesher/command/command.hpp"
#include "mesher/command/print_quality.hpp"
#include "mesher/io/report.hpp"
#include "mesher/quadrille.hpp"
#include "mesher/shell/area_check.hpp"

namespace quadrille::command {

namespace {

struct MeshArguments {
  std::filesystem::path input;
  std::vector<std::filesystem::path> outputs;
  std::optional<double> size, elements_per_diagonal, size_min, elements_per_circle, growth;
  int order = 1;
  std::vector<std::string> faces;
  std::vector<std::string> sizes_on;
  std::filesystem::path size_field, write_size_field, report, picture;
  std::string strategy;
  std::uint64_t seed = 1;
  std::optional<double> time_limit, sew, merge_tiny;
  int threads = 0;
  double msh_version = 2.2;
  bool thin = false, partial = false, force = false, quiet = false, end_with_input = false;
};

void require(bool holds, std::string_view option, std::string_view rule, double value) {
  if (!holds)
    throw usage_error(std::string(option), fmt::format("{} must be {}, not {}", option, rule, value));
}

void require_positive(const std::optional<double>& value, std::string_view option) {
  if (value) require(*value > 0 && std::isfinite(*value), option, "a positive number", *value);
}

/// A name such as "Face3" as its number; 0 when it is not of that kind.
int cad_number(std::string_view name, std::string_view kind) {
  if (name.substr(0, kind.size()) != kind) return 0;
  name.remove_prefix(kind.size());
  int number = 0;
  const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), number);
  return error == std::errc() && end == name.data() + name.size() && number > 0 ? number : 0;
}

/// One of --size-on: "Face3=0.5".
void add_size_on(const std::string& text, SizingOptions& sizing) {
  const auto bad = [&](std::string_view rule) {
    return usage_error("--size-on", fmt::format("--size-on {}: {}", text, rule));
  };
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos) throw bad("write it as Face3=0.5, Edge4=0.5 or Vertex2=0.5");
  const std::string_view name = std::string_view(text).substr(0, equals);
  const char* begin = text.data() + equals + 1;
  const char* end = text.data() + text.size();
  double size = 0;
  const auto parsed = std::from_chars(begin, end, size);
  if (parsed.ec != std::errc() || parsed.ptr != end || !(size > 0) || !std::isfinite(size))
    throw bad("the size must be a positive number");
  if (const int face = cad_number(name, "Face"))
    sizing.face_sizes[face] = size;
  else if (const int edge = cad_number(name, "Edge"))
    sizing.edge_sizes[edge] = size;
  else if (const int vertex = cad_number(name, "Vertex"))
    sizing.vertex_sizes[vertex] = size;
  else
    throw bad(fmt::format("{} is not a name such as Face3, Edge4 or Vertex2", name));
}

void check_numbers(const MeshArguments& arguments) {
  require_positive(arguments.size, "--size");
  require_positive(arguments.size_min, "--size-min");
  require_positive(arguments.growth, "--growth");
  require_positive(arguments.time_limit, "--time-limit");
  require_positive(arguments.sew, "--sew");
  require_positive(arguments.merge_tiny, "--merge-tiny");
  if (arguments.time_limit)
    require(*arguments.time_limit <= 1e8, "--time-limit", "at most 1e8 seconds", *arguments.time_limit);
  if (const auto& count = arguments.elements_per_diagonal)
    require(*count >= 1 && std::isfinite(*count), "--elements-per-diagonal", "1 or more", *count);
  if (const auto& count = arguments.elements_per_circle)
    require(*count >= 0 && std::isfinite(*count), "--curvature", "0 (off) or a positive number", *count);
  if (arguments.size && arguments.size_min && *arguments.size_min > *arguments.size)
    require(false, "--size-min", fmt::format("at most --size ({})", *arguments.size), *arguments.size_min);
  require(arguments.order == 1 || arguments.order == 2, "--order", "1 or 2", arguments.order);
  require(arguments.msh_version == 2.2 || arguments.msh_version == 4.1, "--msh-version", "2.2 or 4.1",
          arguments.msh_version);
  require_threads(arguments.threads);
}

void check_files(const MeshArguments& arguments) {
  for (const std::filesystem::path& output : arguments.outputs) {
    if (!is_mesh_format(output))
      throw usage_error(
          "-o", fmt::format("{}: unknown mesh format (known are .msh, .inp, .unv, .med, .vtu, .vtk and "
                            ".bdf)",
                            output.string()));
    require_writable(output);
  }
  if (!arguments.report.empty()) require_writable(arguments.report);
  if (!arguments.write_size_field.empty())
    require_ending(arguments.write_size_field, ".vdb", "--write-size-field");
  if (!arguments.picture.empty()) require_ending(arguments.picture, ".png", "--picture");
  if (!arguments.size_field.empty()) require_readable(arguments.size_field);
  require_readable(arguments.input);
  std::vector<NamedFile> files{{"IN", arguments.input}, {"--size-field", arguments.size_field}};
  for (const std::filesystem::path& output : arguments.outputs) files.push_back({"-o", output});
  files.insert(files.end(), {{"--report", arguments.report},
                             {"--picture", arguments.picture},
                             {"--write-size-field", arguments.write_size_field}});
  require_different_files(files);
}

MeshOptions make_options(const MeshArguments& arguments) {
  MeshOptions options;
  SizingOptions& sizing = options.sizing;
  sizing.size = arguments.size.value_or(sizing.size);
  sizing.elements_per_diagonal = arguments.elements_per_diagonal.value_or(sizing.elements_per_diagonal);
  sizing.size_min = arguments.size_min.value_or(sizing.size_min);
  sizing.elements_per_circle = arguments.elements_per_circle.value_or(sizing.elements_per_circle);
  sizing.growth = arguments.growth.value_or(sizing.growth);
  sizing.size_field = arguments.size_field;
  for (const std::string& text : arguments.sizes_on) add_size_on(text, sizing);
  if (!arguments.strategy.empty())
    options.strategy = arguments.strategy == "direct" ? Strategy::direct : Strategy::subdivide;
  for (const std::string& name : arguments.faces) {
    const int face = cad_number(name, "Face");
    if (face == 0) throw usage_error("--faces", fmt::format("--faces: {} is not a name such as Face3", name));
    options.faces.push_back(face);
  }
  options.write_size_field = arguments.write_size_field;
  options.order = arguments.order;
  options.merge_tiny = arguments.merge_tiny.value_or(options.merge_tiny);
  options.partial = arguments.partial;
  options.force = arguments.force;
  options.recombine.seed = arguments.seed;
  return options;
}

void check_name(std::string_view option, std::string_view kind, int number, int count) {
  if (number > count)
    throw usage_error(std::string(option), fmt::format("{}: there is no {}{}: the model has {} of them",
                                                       option, kind, number, count));
}

/// What can be told only once the model is read.
void check_against_model(const MeshOptions& options, const CadModel& model) {
  for (const int face : options.faces) check_name("--faces", "Face", face, model.face_count());
  const SizingOptions& sizing = options.sizing;
  for (const auto& [face, size] : sizing.face_sizes)
    check_name("--size-on", "Face", face, model.face_count());
  for (const auto& [edge, size] : sizing.edge_sizes)
    check_name("--size-on", "Edge", edge, model.edge_count());
  for (const auto& [vertex, size] : sizing.vertex_sizes)
    check_name("--size-on", "Vertex", vertex, model.vertex_count());
  if (sizing.size > model.diagonal())
    throw usage_error("--size", fmt::format("--size {} is larger than the model, whose diagonal is {:.6g}",
                                            sizing.size, model.diagonal()));
}

CadModel read_model(const MeshArguments& arguments, ExecutionContext& context) {
  const StageTimer timer(context, "read");
  const CadModel model = CadModel::read(arguments.input);
  return arguments.sew ? model.sewn(*arguments.sew) : model;
}

/// With --thin the middle surface of the model's solids.
std::optional<MidSurface> middle_of(const CadModel& model, const MeshArguments& arguments,
                                    ExecutionContext& context) {
  if (!arguments.thin) return std::nullopt;
  MidSurfaceOptions options;
  options.partial = arguments.partial;
  return midsurface(model, options, context);
}

void write_outputs(const ShellMesh& mesh, const MeshArguments& arguments, ExecutionContext& context) {
  const StageTimer timer(context, "write");
  WriteOptions options;
  options.msh_version = arguments.msh_version;
  options.threads = arguments.threads;
  options.title = fmt::format("Quadrille {}: {}", version(), arguments.input.filename().string());
  const double count = static_cast<double>(arguments.outputs.size());
  for (std::size_t i = 0; i < arguments.outputs.size(); ++i) {
    context.report("write", static_cast<double>(i) / count);
    write_mesh(mesh, arguments.outputs[i], options);
  }
  if (!arguments.picture.empty()) write_picture(mesh, arguments.picture);
}

/// One line for each face that --partial goes without.
void list_left_out(const ShellMesh& mesh) {
  for (const ShellMesh::FaceStatus& face : mesh.faces) {
    if (face.status == "failed")
      fmt::print(stderr, "quadrille: left out: Face{}: {}\n", face.face, face.note);
  }
}

/// Tells where the mesh leaves the geometry.
void warn_off_geometry(const ShellMesh& mesh, std::vector<std::string>& warnings) {
  const auto worst = std::max_element(mesh.faces.begin(), mesh.faces.end(), [](const auto& a, const auto& b) {
    return a.off_geometry_max < b.off_geometry_max;
  });
  if (mesh.off_geometry.empty() || worst == mesh.faces.end()) return;
  warnings.push_back(
      fmt::format("{} midside nodes lie off the geometry so that no element folds, most on "
                  "Face{} (by {:.3g}): a smaller size there, or more elements by --curvature, "
                  "keeps them on it",
                  mesh.off_geometry.size(), worst->face, worst->off_geometry_max));
}

void run(const MeshArguments& arguments) {
  check_numbers(arguments);
  const MeshOptions options = make_options(arguments);
  check_files(arguments);
  ProgressDisplay display(arguments.quiet);
  ExecutionContext context(arguments.threads, [&](std::string_view stage, double fraction) {
    return display.show(stage, fraction);
  });
  report_crashes(arguments.input, "reading");
  // With --partial what is done when the time is over is still put together and written.
  const CancelOnSignal cancel(context, arguments.partial ? 0 : arguments.time_limit.value_or(0));
  if (arguments.partial && arguments.time_limit) context.limit_time(*arguments.time_limit);
  if (arguments.end_with_input) end_with_input();
  const CadModel source = read_model(arguments, context);
  report_crashes(arguments.input, "meshing");
  const std::optional<MidSurface> middle = middle_of(source, arguments, context);
  const CadModel& model = middle ? middle->model : source;
  context.check();
  check_against_model(options, model);
  const ShellMesh result = middle ? mesh(*middle, options, context) : mesh(model, options, context);
  context.check();
  write_outputs(result, arguments, context);
  list_left_out(result);
  if (arguments.quiet && arguments.report.empty()) return;
  QualitySummary summary;
  std::vector<std::string> warnings = model.problems();
  warn_off_geometry(result, warnings);
  if (middle) warnings.insert(warnings.end(), middle->problems.begin(), middle->problems.end());
  on_threads(arguments.threads, [&] {
    summary = quality(result);
    for (std::string& warning : area_differences(model, result)) warnings.push_back(std::move(warning));
  });
  if (!arguments.report.empty())
    write_report(result, summary, context, arguments.input, arguments.report, warnings);
  if (arguments.quiet) return;
  for (const std::string& warning : warnings) fmt::print(stderr, "warning: {}\n", warning);
  print(quality_table(summary));
}

void add_sizing_options(CLI::App& command, MeshArguments& arguments) {
  auto* size = command.add_option("--size", arguments.size, "target edge length, in millimetres");
  command
      .add_option("--elements-per-diagonal", arguments.elements_per_diagonal,
                  "target size as the model's diagonal over this (default 60)")
      ->excludes(size);
  command.add_option("--size-min", arguments.size_min, "no size below this (default: size / 8)");
  command.add_option("--curvature", arguments.elements_per_circle,
                     "elements per 2 pi of curvature; 0 = off (default 12)");
  command.add_option("--growth", arguments.growth, "largest growth of the size per length (default 0.3)");
  command.add_option("--size-on", arguments.sizes_on, "size on a face, edge or vertex: Face3=0.5,Edge4=1")
      ->delimiter(',')
      ->allow_extra_args(false);
  command.add_option("--size-field", arguments.size_field, "OpenVDB grid (.vdb) that caps the size");
  command.add_option("--write-size-field", arguments.write_size_field,
                     "write the size that is meshed with as OpenVDB grids (.vdb)");
}

void add_run_options(CLI::App& command, MeshArguments& arguments) {
  command.add_option("--order", arguments.order, "1: four-node quads; 2: eight-node quads (default 1)");
  command.add_option("--faces", arguments.faces, "mesh these faces only: Face1,Face7")
      ->delimiter(',')
      ->allow_extra_args(false);
  command.add_option("--strategy", arguments.strategy, "direct or subdivide (default)")
      ->check(CLI::IsMember({"direct", "subdivide"}));
  command.add_option("--seed", arguments.seed, "seed of random choices");
  command.add_option("--threads", arguments.threads, "threads to use; 0 = all cores (default)");
  command.add_option("--time-limit", arguments.time_limit,
                     "give up after so many seconds, with nothing written");
  command.add_option("--sew", arguments.sew,
                     "join edges of neighbouring faces that lie within this length of each other first");
  command.add_option("--merge-tiny", arguments.merge_tiny,
                     "leave out edges shorter and faces narrower than this length");
  command.add_flag("--thin", arguments.thin,
                   "mesh the middle surface of thin solids, with a group for each thickness");
  command.add_flag("--partial", arguments.partial,
                   "write what could be meshed when a face fails, and list the rest on stderr");
  command.add_flag("--force", arguments.force, "go on where the mesh would pass 50 million elements");
  command.add_flag("--end-with-input", arguments.end_with_input,
                   "end the work when standard input closes, for programs that start this one");
  command.add_flag("--quiet", arguments.quiet, "no progress, no quality table");
}

}  // namespace

void add_mesh_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("mesh", "mesh a CAD model with quads");
  auto arguments = std::make_shared<MeshArguments>();
  command->add_option("IN", arguments->input, "CAD file: .step, .stp, .iges, .igs, .brep")->required();
  command
      ->add_option("-o,--output", arguments->outputs,
                   "mesh file: .msh, .inp, .unv, .med, .vtu, .vtk or .bdf; may be given more than once")
      ->required()
      ->allow_extra_args(false);
  command->add_option("--msh-version", arguments->msh_version, "version of .msh files: 2.2 (default) or 4.1");
  command->add_option("--report", arguments->report, "write counts, quality and times as JSON");
  command->add_option("--picture", arguments->picture, "draw the mesh into a .png");
  add_sizing_options(*command, *arguments);
  add_run_options(*command, *arguments);
  command->callback([arguments] { run(*arguments); });
}

}  // namespace quadrille::command
