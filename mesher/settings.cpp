/// Each row of the table holds two functions, which read a setting from the options and write it there.

#include "mesher/settings.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "geometry/base/error.hpp"
#include "geometry/cad/cad_model.hpp"
#include "mesher/mesh/entity_name.hpp"
#include "mesher/size_entries.hpp"

namespace quadrille {

namespace {

using Use = Setting::Use;
using Names = std::vector<std::string>;
using Sizes = std::map<std::string, double>;

/// The words for the values of an enumeration.
template <class Word>
constexpr std::nullptr_t words_for = nullptr;
template <>
constexpr std::pair<Strategy, std::string_view> words_for<Strategy>[] = {{Strategy::subdivide, "subdivide"},
                                                                         {Strategy::direct, "direct"}};
template <>
constexpr std::pair<Gradation, std::string_view> words_for<Gradation>[] = {{Gradation::surface, "surface"},
                                                                           {Gradation::space, "space"}};
template <>
constexpr std::pair<MshVersion, std::string_view> words_for<MshVersion>[] = {{MshVersion::v2_2, "2.2"},
                                                                             {MshVersion::v4_1, "4.1"}};
template <>
constexpr const auto& words_for<InpElement> = inp_elements;
constexpr std::pair<bool GroupKinds::*, std::string_view> group_kinds[] = {
    {&GroupKinds::faces, "faces"}, {&GroupKinds::edges, "edges"}, {&GroupKinds::vertices, "vertices"}};
constexpr std::string_view no_groups = "none";

template <class... Visitors>
struct Overloaded : Visitors... {
  using Visitors::operator()...;
};
template <class... Visitors>
Overloaded(Visitors...) -> Overloaded<Visitors...>;

Error refused(const Setting& setting, const std::string& rule) {
  return usage_error(std::string(setting.name), fmt::format("`{}` {}", setting.name, rule));
}

NumberRule rule_of(const Setting& setting) {
  NumberRule rule = setting.range;
  rule.whole = setting.kind() == "count";
  return rule;
}

double checked(const Setting& setting, double value) {
  const NumberRule rule = rule_of(setting);
  if (!rule.allows(value))
    throw refused(setting, fmt::format("must be {}, not {:g}", rule.sentence(), value));
  return value;
}

/// A value of the type that the setting takes.
template <class Wanted>
const Wanted& as(const Setting& setting, const SettingValue& value) {
  if (const Wanted* found = std::get_if<Wanted>(&value)) return *found;
  throw refused(setting, fmt::format("takes a value of the kind {}", setting.kind()));
}

/// The value that a word stands for.
template <class Word>
Word chosen(const Setting& setting, const SettingValue& value) {
  const auto& word = as<std::string>(setting, value);
  for (const auto& [choice, name] : words_for<Word>)
    if (name == word) return choice;
  throw refused(setting, fmt::format("must be {}, not '{}'", fmt::join(setting.choices(), " or "), word));
}

GroupKinds kinds_of(const Setting& setting, const SettingValue& value) {
  GroupKinds kinds{false, false, false};
  const Names& words = as<Names>(setting, value);
  if (words.empty()) throw refused(setting, fmt::format("takes {}", fmt::join(setting.choices(), ", ")));
  for (const std::string& word : words) {
    const auto* found = std::find_if(std::begin(group_kinds), std::end(group_kinds),
                                     [&](const auto& pair) { return pair.second == word; });
    if (found != std::end(group_kinds))
      kinds.*found->first = true;
    else if (word != no_groups)
      throw refused(setting, fmt::format("takes {}, not '{}'", fmt::join(setting.choices(), ", "), word));
    else if (words.size() > 1)
      throw refused(setting, "takes 'none' alone");
  }
  return kinds;
}

Names words_of(const GroupKinds& kinds) {
  Names words;
  for (const auto& [member, word] : group_kinds) {
    if (kinds.*member) words.emplace_back(word);
  }
  if (words.empty()) words.emplace_back(no_groups);
  return words;
}

std::vector<int> face_numbers(const Setting& setting, const SettingValue& value) {
  std::vector<int> faces;
  for (const std::string& name : as<Names>(setting, value)) {
    const auto [dimension, number] = entity_of(name);
    if (dimension != 2) throw refused(setting, fmt::format("takes names such as Face3, not '{}'", name));
    faces.push_back(number);
  }
  return faces;
}

/// The sizes of vertices, edges and faces, by dimension.
template <class Options>
auto sizes_by_name(Options& sizing) {
  return std::array{&sizing.vertex_sizes, &sizing.edge_sizes, &sizing.face_sizes};
}

void set_sizes(const Setting& setting, const SettingValue& value, SizingOptions& sizing) {
  for (const auto& [name, size] : as<Sizes>(setting, value)) {
    if (!positive.allows(size))
      throw refused(setting, fmt::format("takes positive sizes, not {:g} on {}", size, name));
    const auto [dimension, number] = entity_of(name);
    if (dimension < 0)
      throw refused(setting, fmt::format("takes names such as Face3, Edge4 or Vertex2, not '{}'", name));
    (*sizes_by_name(sizing)[dimension])[number] = size;
  }
}

Sizes sizes_of(const SizingOptions& sizing) {
  Sizes sizes;
  for (int dimension = 0; dimension < 3; ++dimension)
    for (const auto& [number, size] : *sizes_by_name(sizing)[dimension])
      sizes[entity_name(dimension, number)] = size;
  return sizes;
}

double parse_number(const Setting& setting, std::string_view text) {
  if (const std::optional<double> value = exactly<double>(text)) return *value;
  throw refused(setting, fmt::format("must be {}, not '{}'", rule_of(setting).sentence(), text));
}

Sizes parse_sizes(const Setting& setting, const std::vector<std::string>& texts) {
  Sizes sizes;
  for (const std::string& text : texts) {
    const auto [name, number] = sides_of_equals(text);
    const std::optional<double> size = exactly<double>(number);
    if (!size)
      throw refused(setting, fmt::format("takes Face3=0.5, Edge4=0.5 or Vertex2=0.5, not '{}'", text));
    if (!sizes.emplace(name, *size).second) throw refused(setting, fmt::format("names {} twice", name));
  }
  return sizes;
}

/// The member of the settings, of their options or of the sizes.
template <auto member>
auto& at(Settings& settings) {
  if constexpr (requires { settings.mesh.sizing.*member; })
    return settings.mesh.sizing.*member;
  else if constexpr (requires { settings.mesh.*member; })
    return settings.mesh.*member;
  else if constexpr (requires { settings.write.*member; })
    return settings.write.*member;
  else
    return settings.*member;
}

std::vector<Setting> make_table() {
  const auto mm = "mm", s = "s", none = "";
  const auto read = Use::read, mesh = Use::mesh, write = Use::write;
  const NumberRule any;
  const auto within = [](double low, double high, bool above_low = false) {
    return NumberRule{low, high, above_low};
  };
  // name, option, property, label, use, unit, range, otherwise, help, place
  return {
      {"size", "size", "Size", "Size", mesh, mm, positive, "a sixtieth of the model's diagonal",
       "target edge length", at<&SizingOptions::size>},
      {"elements_per_diagonal", "elements-per-diagonal", none, none, mesh, none, within(1, any.high), none,
       "target edge length: the model's diagonal divided by this number",
       at<&SizingOptions::elements_per_diagonal>},
      {"size_min", "size-min", "SizeMin", "Minimum", mesh, mm, positive, "size / 8",
       "no size goes below this, except those given by name or region", at<&SizingOptions::size_min>},
      {"elements_per_circle", "curvature", "ElementsPerCircle", "Per circle", mesh, none, any, none,
       "elements on a full circle of curvature; 0 = curvature is ignored",
       at<&SizingOptions::elements_per_circle>},
      {"aspect", "aspect", "Aspect", none, mesh, none, within(1, 10), none,
       "largest length over width of quads in rows over bends, fillets and narrow faces; 1 = squares",
       at<&SizingOptions::aspect>},
      {"growth", "growth", "Growth", "Growth", mesh, none, positive, none,
       "how fast sizes may grow: millimeters of size per millimeter of distance", at<&SizingOptions::growth>},
      {"gradation", "gradation", "Gradation", none, mesh, none, any, none,
       "surface: sizes grow along faces and across their edges, but not across gaps or through walls; space: "
       "through air too",
       at<&SizingOptions::gradation>},
      {"chord_error", "chord-error", "ChordError", "Chord error", mesh, none, any, "any",
       "largest distance of a segment from its curve or surface: a length in mm such as 0.05, or a share of "
       "the size such as 2%",
       Setting::Text{set_chord_error, chord_error_of}},
      {"proximity", "proximity", "Proximity", "Across gaps", mesh, none, within(0, 1000), none,
       "elements across a gap inside a face, between its loops and rims; 0 = any number",
       at<&SizingOptions::proximity>},
      {"order", "order", "ElementOrder", "Order", mesh, none, within(1, 2),
       "2 where a solver reads the mesh: in FreeCAD and in .inp, .unv, .med and .bdf files; else 1",
       "1: four-node quads; 2: eight-node quads, better for shells", at<&MeshOptions::order>},
      {"strategy", "strategy", "Strategy", "Strategy", mesh, none, any, none,
       "subdivide: triangles at twice the size are paired and each quad is cut in four; direct: triangles at "
       "the size are paired, except on faces where that fails",
       at<&MeshOptions::strategy>},
      {"faces", "faces", "Faces", "Faces", mesh, none, any, "all faces", "faces to mesh, such as Face1,Face7",
       at<&MeshOptions::faces>},
      {"sizes", "size-on", none, none, mesh, mm, any, "none",
       "sizes on faces, edges and vertices, such as Face3=0.5,Edge4=1", at<&MeshOptions::sizing>},
      {"size_field", "size-field", "SizeField", none, mesh, none, any, "none",
       "OpenVDB grid (.vdb) that limits the size", at<&SizingOptions::size_field>},
      {"size_field_scale", "size-field-scale", "SizeFieldScale", none, mesh, none, positive, none,
       "factor for the sizes in the grid", at<&SizingOptions::size_field_scale>},
      {"size_field_unit", "size-field-unit", "SizeFieldUnit", none, mesh, none, positive, none,
       "unit of length of the grid in millimeters, for its coordinates and its sizes",
       at<&SizingOptions::size_field_unit>},
      {"size_points", "size-points", "SizePoints", none, mesh, none, any, "none",
       "file (.csv) with lines x,y,z,size: points that request a size", at<&SizingOptions::size_points>},
      {"size_in", "size-in", "SizeIn", none, mesh, none, any, "none",
       "sizes in space: box:x,y,z,x,y,z=SIZE, sphere:x,y,z,r=SIZE, cylinder:x,y,z,x,y,z,r=SIZE, "
       "halfspace:x,y,z,nx,ny,nz=SIZE (the side that the direction points to), in mm; SIZE,LENGTH: around "
       "the region the size grows to the global one over that length",
       Setting::EntryList{set_regions, regions_of}},
      {"segments", "segments", "Segments", none, mesh, none, any, "by size",
       "number of segments on edges, such as Edge4=20; opposite edges of grids get the same number",
       Setting::EntryList{set_spacings<&EdgeSpacing::segments>, spacings_of<&EdgeSpacing::segments>}},
      {"bias", "bias", "Bias", none, mesh, none, any, "none",
       "ratio of each segment's length to that of the one before, such as Edge4=1.2",
       Setting::EntryList{set_spacings<&EdgeSpacing::bias>, spacings_of<&EdgeSpacing::bias>}},
      {"bias_both", "bias-both", "BiasBoth", none, mesh, none, any, "none",
       "the same ratio from both ends of an edge to its middle",
       Setting::EntryList{set_spacings<&EdgeSpacing::bias_both>, spacings_of<&EdgeSpacing::bias_both>}},
      {"imprint", "imprint", "Imprint", "Imprint", read, none, any, none,
       "first cut parts that touch or cross where they meet, so that they share faces, edges and nodes",
       at<&Settings::imprint>},
      {"sew", "sew", "Sew", "Sew", read, mm, positive, "not sewn",
       "first join edges of neighboring faces that lie within this length of each other", at<&Settings::sew>},
      {"merge_tiny", "merge-tiny", "MergeTiny", "Merge tiny", mesh, mm, positive, "all are meshed",
       "leave out edges that are shorter and faces that are narrower than this length",
       at<&MeshOptions::merge_tiny>},
      {"reach", "reach", "Reach", none, mesh, mm, positive, "half the minimum size",
       "suppress edges shorter and faces narrower than this length, where that does no harm",
       at<&MeshOptions::reach>},
      {"fill_holes", "fill-holes", "FillHoles", "Fill holes", mesh, mm, positive, "all are meshed",
       "leave out holes, pockets and bosses that are no wider than this length",
       at<&MeshOptions::fill_holes>},
      {"keep_features", "keep-features", "KeepFeatures", "Keep features", mesh, none, any, none,
       "also mesh features below the reach instead of suppressing them, and let no quad cross a smooth edge",
       at<&MeshOptions::keep_features>},
      {"keep", "keep", "Keep", none, mesh, none, any, "none",
       "faces and edges that keep nodes of their own, whatever their size and shape, such as Edge7,Face3",
       Setting::EntryList{set_kept, kept_of}},
      {"nodes_at", "node", "NodesAt", none, mesh, none, any, "none",
       "a place on a face, edge or vertex that gets a node and a group of that node, x,y,z or Name=x,y,z in "
       "mm; without a name the groups are Node1, Node2, ...",
       Setting::EntryList{set_nodes, nodes_of}},
      {"rings", "rings", "Rings", "Rings", mesh, none, within(0, 100), none,
       "rings of quads around each hole without corners, if there is room for them; 0 = none",
       at<&MeshOptions::rings>},
      {"partial", "partial", "Partial", "Partial", mesh, none, any, none,
       "keep what could be meshed if a face fails", at<&MeshOptions::partial>},
      {"strict", "strict", "Strict", "Strict", mesh, none, any, none,
       "refuse a face that has no valid mesh on its surface, instead of letting nodes leave it",
       at<&MeshOptions::strict>},
      {"force", "force", "Force", none, mesh, none, any, none,
       "allow more than 50 million elements and 5 million segments on edges", at<&MeshOptions::force>},
      {"read_time_limit", "read-time-limit", "ReadTimeLimit", none, read, s, within(0, 1e8), none,
       "give up reading the model after this time; 0 = never", at<&Settings::read_time_limit>},
      {"time_limit", "time-limit", "TimeLimit", "Time limit", mesh, s, within(0, 1e8, true), "none",
       "give up after this time", at<&Settings::time_limit>},
      {"threads", "threads", "Threads", none, mesh, none, within(0, 4096), none,
       "number of threads, at most the number of cores; 0 = all cores", at<&Settings::threads>},
      {"msh_version", "msh-version", none, none, write, none, any, none, "version of .msh files",
       at<&WriteOptions::msh_version>},
      {"nodes", "nodes", none, none, write, none, within(8, 9), none,
       "nodes of second-order quads in files: 8, or 9 with one in the middle (.msh, .med, .vtu, .vtk and "
       ".xdmf)",
       at<&WriteOptions::quad_nodes>},
      {"element", "element", none, none, write, none, any, none,
       "type of the quads in .inp files; shell: S4, at second order S8R; for plane and axisymmetric elements "
       "(CPS, CPE, CAX) a plane mesh is turned into the plane z = 0",
       at<&WriteOptions::element>},
      {"scale", "scale", none, none, write, none, within(0, 1e9, true), none,
       "factor of all lengths in mesh files, such as 0.001 for meters; all other lengths stay in mm",
       at<&WriteOptions::scale>},
      {"groups", "groups", none, none, write, none, any, none,
       "groups to write, such as faces,edges; lines and points are written only with their groups",
       at<&WriteOptions::groups>},
  };
}

const Setting& entry(std::string_view name) {
  return *find_setting(name);
}

/// Throws Error (usage) if a value differs from the default and the setting does not allow it.
void check_limits(const Settings& settings) {
  static const Settings defaults;
  for (const Setting& setting : all_settings()) {
    const SettingValue value = setting.value(settings);
    if (value == setting.value(defaults)) continue;
    Settings scratch;
    assign(scratch, setting, value);
  }
}

void check_name(const Setting& setting, int dimension, int number, int count) {
  if (number < 1 || number > count)
    throw refused(setting, fmt::format("names {0}, and there is no {0}: the model has {1} of them",
                                       entity_name(dimension, number), count));
}

/// The setting that a spacing comes from.
const Setting& entry_of(const EdgeSpacing& spacing) {
  return entry(spacing.segments > 0 ? "segments" : spacing.bias != 1 ? "bias" : "bias_both");
}

/// The numbers of the pieces of a face, edge or vertex.
std::vector<int> pieces_of(const Setting& setting, int dimension, int number, const CadModel& model) {
  const std::vector<std::vector<int>>& pieces = dimension == 2   ? model.pieces()
                                                : dimension == 1 ? model.edge_pieces()
                                                                 : model.vertex_pieces();
  if (pieces.empty())
    throw refused(setting, fmt::format("names {}: edges and vertices cannot be named where a model is "
                                       "imprinted with `sew`, which renumbers them",
                                       entity_name(dimension, number)));
  check_name(setting, dimension, number, static_cast<int>(pieces.size()));
  return pieces[static_cast<std::size_t>(number) - 1];
}

/// Where several entities share a piece, the smallest of their sizes.
void rename(int dimension, const CadModel& model, std::map<int, double>& sizes) {
  std::map<int, double> renamed;
  for (const auto& [number, size] : sizes) {
    for (const int piece : pieces_of(entry("sizes"), dimension, number, model)) {
      double& own = renamed.emplace(piece, size).first->second;
      own = std::min(own, size);
    }
  }
  sizes = std::move(renamed);
}

}  // namespace

std::string_view Setting::kind() const {
  constexpr std::string_view kinds[] = {"number", "count", "flag",   "choice",  "file", "names", "sizes",
                                        "choice", "words", "choice", "entries", "text", "choice"};
  return kinds[place.index()];
}

std::vector<std::string_view> Setting::choices() const {
  std::vector<std::string_view> words;
  const auto take_from = [&](const auto& table) {
    for (const auto& [value, word] : table) words.push_back(word);
  };
  std::visit(Overloaded{[&]<class Value>(Value& (*)(Settings&)) {
                          if constexpr (std::is_enum_v<Value>) take_from(words_for<Value>);
                        },
                        [&](GroupKinds& (*)(Settings&)) {
                          take_from(group_kinds);
                          words.push_back(no_groups);
                        },
                        []<class Value>(const Accessors<Value>&) {}},
             place);
  return words;
}

SettingValue Setting::value(const Settings& settings) const {
  auto& from = const_cast<Settings&>(settings);  // only read
  return std::visit(
      Overloaded{
          [&](double& (*at)(Settings&)) -> SettingValue { return at(from); },
          [&](int& (*at)(Settings&)) -> SettingValue { return static_cast<double>(at(from)); },
          [&](bool& (*at)(Settings&)) -> SettingValue { return at(from); },
          [&]<class Word>(Word& (*at)(Settings&)) -> SettingValue {
            const auto has_value = [&](const auto& row) { return row.first == at(from); };
            return std::string(
                std::find_if(std::begin(words_for<Word>), std::end(words_for<Word>), has_value)->second);
          },
          [&](GroupKinds& (*at)(Settings&)) -> SettingValue { return words_of(at(from)); },
          [&]<class Value>(const Accessors<Value>& at) -> SettingValue { return at.get(from.mesh.sizing); },
          [&](std::filesystem::path& (*at)(Settings&)) -> SettingValue { return at(from).string(); },
          [&](std::vector<int>& (*at)(Settings&)) -> SettingValue {
            Names names;
            for (const int face : at(from)) names.push_back(entity_name(2, face));
            return names;
          },
          [&](SizingOptions& (*at)(Settings&)) -> SettingValue { return sizes_of(at(from)); },
      },
      place);
}

const std::vector<Setting>& all_settings() {
  static const std::vector<Setting> table = make_table();
  return table;
}

const Setting* find_setting(std::string_view name) {
  const auto& table = all_settings();
  const auto it = std::find_if(table.begin(), table.end(), [&](const Setting& s) { return s.name == name; });
  return it == table.end() ? nullptr : &*it;
}

std::string option_of(std::string_view name) {
  if (const Setting* setting = find_setting(name)) return fmt::format("--{}", setting->option);
  if (name == "merge") return "--merge";
  return name == "feature_angle" ? "--feature-angle" : "";
}

SettingValue parse(const Setting& setting, const std::vector<std::string>& texts) {
  const std::string_view kind = setting.kind();
  if (kind == "names" || kind == "words" || kind == "entries") return texts;
  if (kind == "sizes") return parse_sizes(setting, texts);
  if (texts.size() != 1) throw refused(setting, fmt::format("takes one value, not {}", texts.size()));
  if (kind == "choice" || kind == "file" || kind == "text") return texts.front();
  if (kind == "flag") return texts.front() == "true";
  return parse_number(setting, texts.front());
}

void assign(Settings& settings, const Setting& setting, const SettingValue& value) {
  std::visit(
      Overloaded{
          [&](double& (*at)(Settings&)) { at(settings) = checked(setting, as<double>(setting, value)); },
          [&](int& (*at)(Settings&)) {
            at(settings) = static_cast<int>(checked(setting, as<double>(setting, value)));
          },
          [&](bool& (*at)(Settings&)) { at(settings) = as<bool>(setting, value); },
          [&]<class Word>(Word& (*at)(Settings&)) { at(settings) = chosen<Word>(setting, value); },
          [&](GroupKinds& (*at)(Settings&)) { at(settings) = kinds_of(setting, value); },
          [&]<class Value>(const Setting::Accessors<Value>& at) {
            try {
              at.set(settings.mesh.sizing, as<Value>(setting, value));
            } catch (const std::invalid_argument& problem) {
              throw refused(setting, problem.what());
            }
          },
          [&](std::filesystem::path& (*at)(Settings&)) {
            const auto& name = as<std::string>(setting, value);
            if (name.empty()) throw refused(setting, "must be the name of a file, not ''");
            at(settings) = name;
          },
          [&](std::vector<int>& (*at)(Settings&)) { at(settings) = face_numbers(setting, value); },
          [&](SizingOptions& (*at)(Settings&)) { set_sizes(setting, value, at(settings)); },
      },
      setting.place);
}

CadModel joined(const Settings& settings, const CadModel& model) {
  const CadModel imprinted = settings.imprint ? model.imprinted(settings.sew) : model;
  return settings.sew > 0 ? imprinted.sewn(settings.sew) : imprinted;
}

Settings with_pieces(const Settings& settings, const CadModel& model) {
  if (model.pieces().empty()) return settings;
  Settings result = settings;
  std::vector<int>& faces = result.mesh.faces;
  faces.clear();
  for (const int face : settings.mesh.faces)
    for (const int piece : pieces_of(entry("faces"), 2, face, model))
      if (std::find(faces.begin(), faces.end(), piece) == faces.end()) faces.push_back(piece);
  SizingOptions& sizing = result.mesh.sizing;
  for (const int dimension : {2, 1, 0}) rename(dimension, model, *sizes_by_name(sizing)[dimension]);
  for (const int dimension : {2, 1}) {
    std::set<int>& kept = dimension == 2 ? sizing.kept_faces : sizing.kept_edges;
    for (const int number : std::exchange(kept, {})) {
      const std::vector<int> pieces = pieces_of(entry("keep"), dimension, number, model);
      kept.insert(pieces.begin(), pieces.end());
    }
  }
  std::map<int, EdgeSpacing> spacings;
  for (const auto& [edge, spacing] : sizing.spacings) {
    const Setting& setting = entry_of(spacing);
    const std::vector<int> pieces = pieces_of(setting, 1, edge, model);
    if (pieces.size() != 1 || !spacings.emplace(pieces.front(), spacing).second)
      throw refused(setting,
                    fmt::format("names Edge{}, which `imprint` cuts, joins with another edge that is "
                                "named too, or drops",
                                edge));
  }
  sizing.spacings = std::move(spacings);
  return result;
}

void check(const Settings& settings, const CadModel& model) {
  check_limits(settings);
  const SizingOptions& sizing = settings.mesh.sizing;
  const double diagonal = model.diagonal();
  if (sizing.size > diagonal)
    throw refused(entry("size"), fmt::format("is {:g}, larger than the model, whose diagonal is {:.6g}",
                                             sizing.size, diagonal));
  const double size = sizing.size > 0 ? sizing.size : diagonal / sizing.elements_per_diagonal;
  if (sizing.size_min > size)
    throw refused(entry("size_min"),
                  fmt::format("must be at most the size, {:.6g}, not {:g}", size, sizing.size_min));
  for (const auto& [name, length] :
       {std::pair("merge_tiny", settings.mesh.merge_tiny), std::pair("reach", settings.mesh.reach)})
    if (length > size)
      throw refused(entry(name), fmt::format("must be at most the size, {:.6g}, not {:g}", size, length));
  const int counts[] = {model.vertex_count(), model.edge_count(), model.face_count()};
  for (const int face : settings.mesh.faces) check_name(entry("faces"), 2, face, counts[2]);
  for (const int dimension : {2, 1, 0})
    for (const auto& [number, wanted] : *sizes_by_name(sizing)[dimension])
      check_name(entry("sizes"), dimension, number, counts[dimension]);
  for (const int face : sizing.kept_faces) check_name(entry("keep"), 2, face, counts[2]);
  for (const int edge : sizing.kept_edges) check_name(entry("keep"), 1, edge, counts[1]);
  for (const auto& [edge, spacing] : sizing.spacings) {
    check_name(entry_of(spacing), 1, edge, counts[1]);
    if (spacing.bias != 1 && spacing.bias_both != 1)
      throw refused(entry("bias_both"),
                    fmt::format("names Edge{}, which has a bias from one end: give one of them", edge));
  }
}

nlohmann::ordered_json settings_table() {
  using json = nlohmann::ordered_json;
  constexpr const char* uses[] = {"read", "mesh", "write"};
  const Settings defaults;
  json table = json::array();
  for (const Setting& setting : all_settings()) {
    json standard;
    if (setting.otherwise.empty())
      std::visit([&](const auto& value) { standard = value; }, setting.value(defaults));
    const bool numeric = setting.kind() == "number" || setting.kind() == "count";
    table.push_back(
        {{"name", setting.name},
         {"option", "--" + std::string(setting.option)},
         {"property", setting.property},
         {"label", setting.label},
         {"kind", setting.kind()},
         {"use", uses[static_cast<int>(setting.use)]},
         {"unit", setting.unit},
         {"default", standard},
         {"low", numeric ? json(setting.range.low) : json()},
         {"high", numeric && std::isfinite(setting.range.high) ? json(setting.range.high) : json()},
         {"above_low", setting.range.above_low},
         {"choices", setting.choices()},
         {"otherwise", setting.otherwise},
         {"help", setting.help}});
  }
  return table;
}

}  // namespace quadrille
