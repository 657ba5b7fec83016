/// Builds the report with nlohmann::json from the quality, criteria, notes and times of the run.

#include "mesher/io/report.hpp"

#include <CGAL/version.h>
#include <oneapi/tbb/parallel_invoke.h>
#include <openvdb/version.h>

#include <Standard_Version.hxx>
#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "geometry/base/atomic_file.hpp"
#include "geometry/base/process_usage.hpp"
#include "mesher/io/io.hpp"
#include "mesher/mesh/entity_name.hpp"
#include "mesher/mesh/joined_faces.hpp"
#include "mesher/remesh/surface_locator.hpp"

namespace quadrille {

namespace {

using nlohmann::json;

/// What `item` makes of each member of a list.
template <class List, class Item>
json listed(const List& list, Item&& item) {
  json result = json::array();
  for (const auto& member : list) result.push_back(item(member));
  return result;
}

json quality_to_json(const QualitySummary& summary) {
  return {{"q_min", summary.q_min},
          {"q_mean", summary.q_mean},
          {"sj_min", summary.sj_min},
          {"sj_mean", summary.sj_mean},
          {"jacobian_min", summary.jacobian_min},
          {"inverted", summary.inverted},
          {"irregular_percent", summary.irregular_percent},
          {"histogram", summary.q_histogram},
          {"valence_counts", summary.valence_counts},
          {"aspect_mean", summary.aspect_mean},
          {"aspect_max", summary.aspect_max},
          {"warping_max_degrees", summary.warping_max_degrees},
          {"edge_min", summary.edge_min},
          {"edge_median", summary.edge_median},
          {"edge_max", summary.edge_max}};
}

/// Counts and shares of the quads that fail, by criterion and face, and the worst.
json criteria_to_json(const CriteriaSummary& summary, const CriteriaLimits& limits) {
  const auto percent = [&](int failing) { return 100.0 * failing / std::max(summary.quads, 1); };
  json result{{"quads", summary.quads},
              {"failing", summary.failing},
              {"failing_percent", percent(summary.failing)},
              {"outside", summary.outside},
              {"outside_percent", percent(summary.outside)},
              {"by_criterion", json::object()},
              {"by_face", json::object()},
              {"worst", json::array()}};
  for (std::size_t i = 0; i < criterion_count; ++i) {
    const double limit = limits.values[i];
    result["by_criterion"][std::string(criteria_info[i].name)] = {
        {"limit", std::isnan(limit) ? json() : json(limit)},
        {"failing", summary.failing_by[i]},
        {"failing_percent", percent(summary.failing_by[i])}};
  }
  for (const auto& face : summary.faces)
    result["by_face"][entity_name(2, face.face)] = {{"quads", face.quads}, {"failing", face.failing}};
  for (const auto& quad : summary.worst) {
    const CriterionInfo& info = criteria_info[static_cast<std::size_t>(quad.criterion)];
    result["worst"].push_back({{"quad", quad.quad + 1},
                               {"face", entity_name(2, quad.face)},
                               {"center", quad.center},
                               {"criterion", info.name},
                               {"value", quad.value}});
  }
  return result;
}

json seconds_to_json(const ExecutionContext& context) {
  json seconds = json::object();
  for (const std::string_view stage : stage_names) {
    if (stage != name_of(Stage::mesh) && stage != name_of(Stage::midsurface))
      seconds[std::string(stage)] = 0.0;
  }
  for (const auto& [stage, value] : context.seconds()) seconds[stage] = value;
  return seconds;
}

json faces_to_json(const ShellMesh& mesh) {
  return listed(mesh.faces, [](const ShellMesh::Face& face) {
    return json{{"name", entity_name(2, face.face)},
                {"status", name_of(face.status)},
                {"quads", face.quads},
                {"q_min", face.q_min},
                {"seconds", face.seconds},
                {"off_geometry", {{"nodes", face.off_geometry}, {"largest", face.off_geometry_max}}},
                {"attempts", face.attempts},
                {"work", face.work},
                {"share", face.share},
                {"note", face.note}};
  });
}

/// The edges that quads cross, and how far they lie from these quads, each of which counts as two triangles:
/// the farthest of the points that an edge is drawn by; 0 if its faces have no quads.
json crossed_to_json(const ShellMesh& mesh) {
  if (mesh.crossed_edges.empty()) return json::array();
  const JoinedFaces joined(mesh);
  TriangleMesh surface;
  surface.points = mesh.points;
  std::vector<int> patches;
  std::map<int, int> patch_of;  // by the first of the faces that are taken as one
  for (std::size_t q = 0; q < mesh.quads.size(); ++q) {
    if (!joined.contains(mesh.quad_faces[q])) continue;
    const auto& [a, b, c, d] = mesh.quads[q];
    surface.triangles.insert(surface.triangles.end(), {{a, b, c}, {a, c, d}});
    const int next = static_cast<int>(patch_of.size());
    patches.insert(patches.end(), 2,
                   patch_of.try_emplace(joined.first(mesh.quad_faces[q]), next).first->second);
  }
  const SurfaceLocator locator(surface, patches, static_cast<int>(patch_of.size()));
  return listed(mesh.crossed_edges, [&](const ShellMesh::CrossedEdge& edge) {
    double farthest = 0;
    if (const auto patch = patch_of.find(joined.first(edge.faces[0])); patch != patch_of.end())
      for (const Vector3& point : edge.line)
        farthest = std::max(farthest, (locator.nearest(patch->second, point).point - point).norm());
    return json{{"name", entity_name(1, edge.edge)},
                {"faces", {entity_name(2, edge.faces[0]), entity_name(2, edge.faces[1])}},
                {"distance", farthest},
                {"line", edge.line}};
  });
}

/// The nodes of --node: name and place; none for those that are left out.
json placed_to_json(const ShellMesh& mesh) {
  return listed(mesh.placed_nodes, [&](const ShellMesh::PlacedNode& node) {
    const auto corner = std::find_if(mesh.corners.begin(), mesh.corners.end(),
                                     [&](const auto& other) { return other.vertex == node.vertex; });
    const bool found = corner != mesh.corners.end();
    return json{{"name", node.name}, {"at", found ? json(mesh.points[corner->node]) : json()}};
  });
}

/// The groups with names of the CAD file or of a solid's faces.
json extra_groups_to_json(const ShellMesh& mesh) {
  return listed(mesh.extra_groups, [](const ShellMesh::Group& group) {
    return json{{"name", group.name}, {"entities", entity_names(group.dimension, group.entities)}};
  });
}

json suppressed_to_json(const ShellMesh& mesh) {
  using Kind = ShellMesh::SuppressedFeature::Kind;
  return listed(mesh.suppressed_features, [](const ShellMesh::SuppressedFeature& feature) {
    return json{{"name", entity_name(feature.kind == Kind::edge ? 1 : 0, feature.number)},
                {"to", entity_name(feature.to_kind == Kind::edge ? 1 : 0, feature.to)},
                {"distance", feature.distance}};
  });
}

json filled_holes_to_json(const ShellMesh& mesh) {
  return listed(mesh.filled_holes, [](const ShellMesh::FilledHole& hole) {
    return json{{"kind", hole.boss ? "boss" : "hole"},
                {"center", hole.center},
                {"diameter", hole.diameter},
                {"in", entity_names(2, hole.in)},
                {"faces", entity_names(2, hole.faces)}};
  });
}

json poor_quads_to_json(const ShellMesh& mesh) {
  constexpr std::array<const char*, 4> names{"short edge", "sharp corner", "narrow", "none"};
  return listed(mesh.poor_quads, [&](const ShellMesh::PoorQuads& found) {
    return json{{"name", entity_name(found.dimension, found.number)},
                {"quads", found.quads},
                {"shortest", found.shortest},
                {"forced", found.is_forced()},
                {"cause", names[static_cast<std::size_t>(found.cause)]},
                {"why", found.why}};
  });
}

/// Numbers of elements, from 1.
json elements_to_json(std::vector<int> indices) {
  for (int& index : indices) ++index;
  return indices;
}

}  // namespace

json entity_names(int dimension, const std::vector<int>& numbers) {
  return listed(numbers, [dimension](int number) { return entity_name(dimension, number); });
}

MeshMeasures measure(const ShellMesh& mesh) {
  MeshMeasures measures;
  oneapi::tbb::parallel_invoke([&] { measures.quality = quality(mesh); },
                               [&] { measures.criteria = check_criteria(mesh, limits_of(mesh)); });
  return measures;
}

json make_report(const ShellMesh& mesh, const MeshMeasures& measures, const ExecutionContext& context,
                 const std::filesystem::path& input, const std::vector<std::string>& warnings, double scale) {
  const ProcessUsage usage = process_usage();
  const QualitySummary& summary = measures.quality;
  const auto off_geometry = [](const ShellMesh::OffGeometry& off) {  // nodes numbered as in mesh files
    return json{{"node", off.node + 1}, {"distance", off.distance}};
  };
  const auto kept = [](const ShellMesh::Kept& feature) {
    return json{{"name", entity_name(feature.dimension, feature.number)}, {"why", feature.why}};
  };
  return {{"input", input.string()},
          {"scale", scale},
          {"order", mesh.order},
          {"counts", {{"nodes", summary.nodes}, {"quads", summary.quads}, {"triangles", summary.triangles}}},
          {"quality", quality_to_json(summary)},
          {"criteria", criteria_to_json(measures.criteria, limits_of(mesh))},
          {"seconds", seconds_to_json(context)},
          {"cpu_seconds", usage.cpu_seconds},
          {"peak_bytes", usage.peak_bytes},
          {"faces", faces_to_json(mesh)},
          {"off_geometry", listed(mesh.off_geometry, off_geometry)},
          {"suppressed_features", suppressed_to_json(mesh)},
          {"kept", listed(mesh.kept, kept)},
          {"filled_holes", filled_holes_to_json(mesh)},
          {"crossed_edges", crossed_to_json(mesh)},
          {"groups", extra_groups_to_json(mesh)},
          {"placed_nodes", placed_to_json(mesh)},
          {"poor_quads", poor_quads_to_json(mesh)},
          {"finer_quads", elements_to_json(mesh.finer_quads)},
          {"warnings", warnings},
          {"versions",
           {{"quadrille", QUADRILLE_VERSION},
            {"opencascade", OCC_VERSION_COMPLETE},
            {"openvdb", OPENVDB_LIBRARY_VERSION_STRING},
            {"cgal", CGAL_VERSION_STR}}}};
}

std::string quality_json(const ShellMesh& mesh, const CriteriaLimits& limits) {
  const QualitySummary summary = quality(mesh);
  json result = quality_to_json(summary);
  result["nodes"] = summary.nodes;
  result["quads"] = summary.quads;
  result["triangles"] = summary.triangles;
  result["criteria"] = criteria_to_json(check_criteria(mesh, limits), limits);
  return result.dump();
}

void write_report(const json& report, const std::filesystem::path& path) {
  // File names need not be UTF-8, but JSON must be.
  write_file(path, report.dump(2, ' ', false, json::error_handler_t::replace) + "\n");
}

}  // namespace quadrille
