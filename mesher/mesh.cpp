/// The facade: model in, mesh out.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <map>
#include <optional>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "geometry/base/place_text.hpp"
#include "geometry/base/threads.hpp"
#include "geometry/cad/face_names.hpp"
#include "mesher/quadrille.hpp"
#include "mesher/shell/area_check.hpp"
#include "mesher/shell/assembly.hpp"
#include "mesher/shell/shell_check.hpp"
#include "mesher/stages/stages.hpp"

namespace quadrille {

namespace {

/// Edges between faces of unlike thickness, and at steps. No quad may belong to both sides.
std::set<int> edges_where_thickness_changes(const MidSurface& middle) {
  std::set<int> result;
  const auto differ = [&](const MiddleFace& a, const MiddleFace& b) {
    constexpr double same = 1e-6;
    return a.step != b.step || varies(a) || varies(b) ||
           std::abs(a.thickness - b.thickness) > same * std::max(a.thickness, b.thickness);
  };
  for (const CadEdge& edge : middle.model.shape().edges)
    for (const FaceId face : edge.faces)
      if (differ(middle.faces[edge.faces.front().index()], middle.faces[face.index()]))
        result.insert(edge.number);
  return result;
}

bool suppresses_features(const CadModel& model, const Prepared& prepared) {
  return prepared.shape.edges.size() > model.shape().edges.size() ||
         !suppressed_features(prepared, prepared.plan.tiny).empty();
}

ShellMesh mesh_prepared(const CadModel& model, const Prepared& prepared, ExecutionContext& context) {
  const MeshOptions& options = prepared.options;
  const SizingField field = sizes_for(prepared, context);
  if (!options.write_size_field.empty()) field.write(options.write_size_field);
  const Run run{prepared, field, context};
  Boundary boundary(prepared);
  Faces faces(prepared);
  const std::vector<EdgeId> crossed = mesh_faces(run, boundary, faces);
  ShellMesh result = assemble(run, boundary, faces, crossed);
  note_off_geometry(result);
  std::vector<std::string> defects = shell_defects(model.shape(), faces_used(model, options), result);
  const AreasChecked checked = options.check_curved_areas ? AreasChecked::all : AreasChecked::planes;
  for (const AreaDifference& found : area_differences(model, result, checked))
    (found.is_certain ? defects : result.warnings).push_back(found.sentence);
  if (!defects.empty() && !options.partial)
    throw failure("", fmt::format("{}; `partial` writes the mesh all the same", fmt::join(defects, "; ")));
  result.warnings.insert(result.warnings.end(), defects.begin(), defects.end());
  if (options.inspect) options.inspect(result, field);
  return result;
}

/// \param middle what the model is the middle surface of, if any: its faces belong to faces of a solid, and
/// are not joined
ShellMesh mesh_whole(const CadModel& model, const MeshOptions& options, const MidSurface* middle,
                     ExecutionContext& context) {
  Preparation how{.joins = middle == nullptr,
                  .uncrossed = middle ? edges_where_thickness_changes(*middle) : std::set<int>()};
  // A part that has no mesh may have one when fewer features are suppressed.
  std::optional<Error> first;
  for (how.reach_share = 1;; how.reach_share = how.reach_share == 1 ? 0.5 : 0) {
    const Prepared prepared(model, options, how);
    try {
      ShellMesh result = mesh_prepared(model, prepared, context);
      if (first)
        result.warnings.push_back(
            fmt::format("features are suppressed below {} only, because with more of them {}",
                        number_text(prepared.reach), first->what()));
      return result;
    } catch (const Error& error) {
      const bool is_of_faces = dynamic_cast<const FaceProblem*>(&error) != nullptr || error.subject().empty();
      if (!is_of_faces || error.kind() != Error::Kind::failure) throw;
      if (!first) first = error;
      if (how.reach_share == 0 || !suppresses_features(model, prepared)) throw Error(*first);
    }
  }
}

std::vector<int> nodes_of_face(const ShellMesh& mesh, int face) {
  std::set<int> nodes;
  for (std::size_t i = 0; i < mesh.quads.size(); ++i) {
    if (mesh.quad_faces[i] != face) continue;
    nodes.insert(mesh.quads[i].begin(), mesh.quads[i].end());
    if (mesh.order == 2) nodes.insert(mesh.midsides[i].begin(), mesh.midsides[i].end());
  }
  return {nodes.begin(), nodes.end()};
}

/// Groups of the faces with names in the CAD file, as far as they have elements.
std::vector<ShellMesh::Group> groups_of_names(const FaceNames& names, const ShellMesh& mesh) {
  std::vector<ShellMesh::Group> result;
  for (const auto& [name, faces] : names) {
    ShellMesh::Group group{name, 2, 0, {}};
    std::copy_if(faces.begin(), faces.end(), std::back_inserter(group.entities),
                 [&](int face) { return mesh.faces[face - 1].quads > 0; });
    if (!group.entities.empty()) result.push_back(std::move(group));
  }
  return result;
}

std::ptrdiff_t how_many(const std::vector<int>& faces, const std::set<int>& named) {
  return std::count_if(faces.begin(), faces.end(), [&](int face) { return named.contains(face); });
}

/// The names of the middle faces: those of the solid's faces that they lie between, which for a face that
/// joins the middles of a step must all have the name.
FaceNames names_of_middle(const MidSurface& middle) {
  FaceNames result;
  for (const auto& [name, faces] : middle.face_names)
    for (std::size_t i = 0; i < middle.faces.size(); ++i) {
      const std::vector<int>& own = middle.faces[i].solid_faces;
      const std::ptrdiff_t named = how_many(own, faces);
      if (named > 0 && (!middle.faces[i].step || named == std::ssize(own)))
        result[name].insert(static_cast<int>(i) + 1);
    }
  return result;
}

/// Groups of the middle faces and rims that belong to the named faces of the solid and to each of its faces,
/// for loads and supports that were meant for them. A name has rims only if it has no middle faces.
std::vector<ShellMesh::Group> groups_of_solid_faces(const MidSurface& middle, const ShellMesh& mesh) {
  std::map<std::pair<bool, int>, std::vector<int>> found;  // whether they are rims, and the solid's face
  for (std::size_t i = 0; i < middle.faces.size(); ++i) {
    if (middle.faces[i].step) continue;  // lies across, between two middle surfaces
    for (const int face : middle.faces[i].solid_faces)
      found[{false, face}].push_back(static_cast<int>(i) + 1);
  }
  for (const MiddleRim& rim : middle.rims)
    for (const int face : rim.solid_faces) found[{true, face}].push_back(rim.edge);
  const FaceNames names = names_of_middle(middle);
  std::vector<ShellMesh::Group> result = groups_of_names(names, mesh);
  for (const auto& [name, faces] : middle.face_names) {
    std::vector<int> edges;
    for (const MiddleRim& rim : middle.rims)
      if (how_many(rim.solid_faces, faces) > 0) edges.push_back(rim.edge);
    if (!names.contains(name) && !edges.empty()) result.push_back({name + "Rim", 1, 0, std::move(edges)});
  }
  for (auto& [of, numbers] : found)
    result.push_back({fmt::format("SolidFace{}{}", of.second, of.first ? "Rim" : ""), of.first ? 1 : 2, 0,
                      std::move(numbers)});
  return result;
}

}  // namespace

ShellMesh mesh(const CadModel& model, const MeshOptions& options, ExecutionContext& context) {
  ShellMesh result =
      on_threads(context.threads(), [&] { return mesh_whole(model, options, nullptr, context); });
  result.extra_groups = groups_of_names(model.face_names(), result);
  return result;
}

SmallFeatures small_features(const CadModel& model, const MeshOptions& options) {
  const Prepared prepared(model, options);
  SmallFeatures result{suppressed_features(prepared, prepared.plan.tiny),
                       {},
                       kept_features(prepared.shape, prepared.suppressed),
                       prepared.simple.holes};
  for (const FaceId face : prepared.asked.ids())
    if (prepared.asked[face] && prepared.plan.tiny.merged_faces[face]) result.faces.push_back(face.number());
  return result;
}

ShellMesh mesh(const MidSurface& middle, const MeshOptions& options, ExecutionContext& context) {
  ShellMesh result =
      on_threads(context.threads(), [&] { return mesh_whole(middle.model, options, &middle, context); });
  result.extra_groups = groups_of_solid_faces(middle, result);
  for (const MiddleFace& face : middle.faces) {
    result.thicknesses.push_back(face.thickness);
    if (!varies(face) || !middle.thickness_at) continue;
    const int number = static_cast<int>(result.thicknesses.size());
    ShellMesh::VaryingThickness varying{
        number, face.thinnest, face.thickest, nodes_of_face(result, number), {}};
    for (const int node : varying.nodes)
      varying.thicknesses.push_back(middle.thickness_at(number, result.points[node]));
    if (!varying.nodes.empty()) result.varying_thicknesses.push_back(std::move(varying));
  }
  return result;
}

std::string version() {
  return QUADRILLE_VERSION;
}

}  // namespace quadrille
