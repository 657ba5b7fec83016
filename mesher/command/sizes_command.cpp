/// quadrille sizes IN: the sizes that a mesh would have, before it is made.

#include <fmt/format.h>

#include <array>
#include <bit>
#include <boost/archive/iterators/base64_from_binary.hpp>
#include <boost/archive/iterators/transform_width.hpp>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <numeric>

#include "geometry/base/atomic_file.hpp"
#include "geometry/base/error.hpp"
#include "geometry/base/file_access.hpp"
#include "geometry/base/threads.hpp"
#include "geometry/sizing/sizing_field.hpp"
#include "mesher/command/command.hpp"
#include "mesher/quadrille.hpp"

namespace quadrille::command {

namespace {

using json = nlohmann::ordered_json;

struct SizesArguments : RunArguments {
  bool count_only = false;
  double wanted_quads = 0;  // 0 = the size is given
};

void check_files(const SizesArguments& arguments) {
  for (const std::filesystem::path& output : arguments.outputs) {
    if (lower_ending(output) != ".vtu" && lower_ending(output) != ".json")
      throw usage_error("-o",
                        fmt::format("-o: the file name must end in .vtu or .json, not {}", output.string()));
  }
  require_usable(arguments, "IN");
}

json summary_of(const SizeMap& map) {
  json sources = json::array();
  for (const SizeMap::Source& source : map.sources)
    sources.push_back({{"name", source.name},
                       {"area", source.area},
                       {"quads", source.quads},
                       {"size_min", source.least},
                       {"size_max", source.largest}});
  return {{"quads", map.quads}, {"sources", sources}, {"missing", map.missing}};
}

/// The bytes of numbers, in base64.
template <class Number>
std::string text_of(const std::vector<Number>& numbers) {
  static_assert(std::endian::native == std::endian::little);
  using namespace boost::archive::iterators;
  using Letters = base64_from_binary<transform_width<const char*, 6, 8>>;
  const char* bytes = reinterpret_cast<const char*>(numbers.data());
  const std::size_t count = numbers.size() * sizeof(Number);
  std::string text(Letters(bytes), Letters(bytes + count));
  text.append((3 - count % 3) % 3, '=');
  return text;
}

/// The elements of all lists, one after another, converted to another type of number.
template <class Number, class Lists>
std::vector<Number> flat(const Lists& lists) {
  std::vector<Number> numbers;
  for (const auto& list : lists) {
    for (const auto value : list) numbers.push_back(static_cast<Number>(value));
  }
  return numbers;
}

/// The whole map, for programs that draw it.
json all_of(const SizeMap& map) {
  json result = summary_of(map);
  std::vector<std::array<int, 2>> lines;
  for (const SizeMap::Line& line : map.lines) lines.push_back(line.points);
  result.update({{"points", text_of(flat<float>(map.points))},
                 {"point_sizes", text_of(std::vector<float>(map.sizes.begin(), map.sizes.end()))},
                 {"point_sizes_along", text_of(std::vector<float>(map.along.begin(), map.along.end()))},
                 {"point_sources", text_of(map.rulers)},
                 {"triangles", text_of(flat<int>(map.triangles))},
                 {"triangle_faces", text_of(map.faces)},
                 {"lines", text_of(flat<int>(lines))}});
  return result;
}

std::string table_of(const SizeMap& map) {
  double area = 0;
  for (const SizeMap::Source& source : map.sources) area += source.area;
  std::string text = fmt::format("quads        about {:.0f}\n\n{:<16} {:>8} {:>12} {:>10} {:>10}\n",
                                 map.quads, "source", "area", "quads", "from mm", "to mm");
  for (const SizeMap::Source& source : map.sources) {
    if (source.area == 0) {
      text += fmt::format("{:<16} {:>8}\n", source.name, "nowhere");
      continue;
    }
    text += fmt::format("{:<16} {:>6.1f} % {:>12.0f} {:>10.4g} {:>10.4g}\n", source.name,
                        100 * source.area / area, source.quads, source.least, source.largest);
  }
  return text;
}

void write_outputs(const SizeMap& map, const SizesArguments& arguments, Work& work) {
  const StageTimer timer(work.context, Stage::write);
  for (const std::filesystem::path& output : arguments.outputs) {
    work.context.report(Stage::write, 0);
    if (lower_ending(output) == ".vtu")
      write_sizes_vtu(map, output);
    else
      write_file(output, all_of(map).dump() + "\n");
    work.cancel.wrote(output);
  }
  if (!arguments.report.empty()) write_file(arguments.report, summary_of(map).dump(2) + "\n");
}

/// Counts the quads that each face would get, at the size that gives the wanted number if there is one.
void count(const CadModel& model, MeshOptions options, const SizesArguments& arguments,
           ExecutionContext& context) {
  QuadEstimate estimate(model, context);
  if (arguments.wanted_quads > 0)
    options.sizing.size = estimate.size_for(arguments.wanted_quads, options).size;
  const std::vector<double> counts = estimate.quads_by_face(options);
  const double sum = std::accumulate(counts.begin(), counts.end(), 0.0);
  if (!arguments.report.empty()) {
    json by_face = json::object();
    for (std::size_t i = 0; i < counts.size(); ++i) {
      if (counts[i] > 0) by_face[fmt::format("Face{}", i + 1)] = std::round(counts[i]);
    }
    const double size = size_limits(model, options.sizing).largest;
    write_file(arguments.report,
               json{{"size", size}, {"quads", sum}, {"quads_by_face", by_face}}.dump(2) + "\n");
  }
  if (arguments.quiet) return;
  if (arguments.wanted_quads > 0) print(fmt::format("size         {:g}\n", options.sizing.size));
  print(fmt::format("quads        about {:.0f}\n", sum));
}

void run(const SizesArguments& arguments) {
  check_files(arguments);
  Settings settings = arguments.settings;
  Work work(arguments, {Stage::read, Stage::size, Stage::write});
  ExecutionContext& context = work.context;
  const CadModel model = read_model(arguments, "measuring", work);
  context.check();
  settings = with_pieces(settings, model);
  check(settings, model);
  if (arguments.count_only) return count(model, settings.mesh, arguments, context);
  const SizeMap map = size_map(model, settings.mesh, context);
  write_outputs(map, arguments, work);
  for (const int face : map.missing)
    say("warning: Face{} is not shown: OpenCASCADE cannot triangulate it", face);
  if (!arguments.quiet) print(table_of(map));
}

}  // namespace

void add_sizes_command(CLI::App& app) {
  auto [command, arguments] = add_command<SizesArguments>(
      app, "sizes", "show the sizes that a mesh would have, and where they come from");
  add_model(command, arguments);
  add_outputs(command, arguments, "the surface with sizes and their sources: .vtu or .json")->required(false);
  command.add_option("--write-size-field", arguments.settings.mesh.write_size_field,
                     "write the sizes as OpenVDB grids (.vdb)");
  command.add_option("--report", arguments.report, "write area, quads and sizes of each source as JSON");
  command
      .add_flag("--count-only", arguments.count_only,
                "only print the expected number of quads; the report lists it by face")
      ->excludes("--output")
      ->excludes("--write-size-field");
  std::set<std::string_view> of_meshing;
  for (const Setting& setting : all_settings())
    if (setting.use != Setting::Use::write) of_meshing.insert(setting.name);
  add_settings(command, arguments, of_meshing);
  command.get_option("--elements-per-diagonal")->excludes("--size");
  command
      .add_option("--wanted-quads", arguments.wanted_quads,
                  "with --count-only: find the size that gives about this many quads")
      ->needs("--count-only")
      ->excludes("--size")
      ->excludes("--elements-per-diagonal")
      ->check(number(positive));
  add_run_options(command, arguments, "no progress, no table");
}

}  // namespace quadrille::command
