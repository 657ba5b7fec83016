#include "mesher/shell/symmetry.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "geometry/sizing/sizing_field.hpp"

namespace quadrille {

namespace {

/// The name of a given setting that rules out symmetry: its values have places in space or along edges, and
/// are not compared with their mirror images. Null if there is none.
const char* one_sided_setting(const MeshOptions& options) {
  const SizingOptions& sizing = options.sizing;
  const std::pair<bool, const char*> given[] = {{!sizing.regions.empty(), "size_in"},
                                                {!sizing.layers.empty(), "layers"},
                                                {!sizing.spacings.empty(), "segments"},
                                                {!sizing.size_field.empty(), "size_field"},
                                                {!sizing.size_points.empty(), "size_points"},
                                                {sizing.proximity > 0, "proximity"},
                                                {!options.write_size_field.empty(), "write_size_field"}};
  for (const auto& [is_given, name] : given) {
    if (is_given) return name;
  }
  return nullptr;
}

/// Whether each entity has the same size as its image. \param sizes by number.
template <class Id>
bool is_symmetric(const std::map<int, double>& sizes, const IdVector<Id, Id>& images) {
  return std::all_of(sizes.begin(), sizes.end(), [&](const auto& entry) {
    const Id image = images[Id::from_number(entry.first)];
    if (!image.exists()) return false;
    const auto found = sizes.find(image.number());
    return found != sizes.end() && found->second == entry.second;
  });
}

/// Whether the sizes and faces given by number are symmetric about the plane.
bool is_symmetric(const MeshOptions& options, const MirrorPlane& plane) {
  const std::set<int> faces(options.faces.begin(), options.faces.end());
  return is_symmetric(options.sizing.face_sizes, plane.faces) &&
         is_symmetric(options.sizing.edge_sizes, plane.edges) &&
         is_symmetric(options.sizing.vertex_sizes, plane.vertices) &&
         std::all_of(faces.begin(), faces.end(), [&](int face) {
           return faces.contains(plane.faces[FaceId::from_number(face)].number());
         });
}

/// Converts values by number in the whole model to values by number in the part.
template <class Id>
std::map<int, double> on_part(const std::map<int, double>& sizes, const IdVector<Id, Id>& names) {
  std::map<int, double> result;
  for (const Id id : names.ids()) {
    const auto found = sizes.find(names[id].number());
    if (found != sizes.end()) result[id.number()] = found->second;
  }
  return result;
}

MeshOptions options_for(const ModelPart& part, const CadModel& model, MeshOptions options) {
  SizingOptions& sizing = options.sizing;
  const SizeLimits limits = size_limits(model, sizing);
  sizing.size = limits.largest;
  sizing.size_min = limits.size_min;
  const ModelPart::Image& names = part.images.front();
  sizing.face_sizes = on_part(sizing.face_sizes, names.faces);
  sizing.edge_sizes = on_part(sizing.edge_sizes, names.edges);
  sizing.vertex_sizes = on_part(sizing.vertex_sizes, names.vertices);
  const std::set<int> faces(options.faces.begin(), options.faces.end());
  options.faces.clear();
  for (const FaceId face : names.faces.ids()) {
    if (faces.contains(names.faces[face].number())) options.faces.push_back(face.number());
  }
  // Failures must name entities of the whole model, so after a failure the whole model is meshed.
  options.partial = false;
  return options;
}

}  // namespace

SymmetricJob find_symmetry(const CadModel& model, const MeshOptions& options,
                           const ExecutionContext& context) {
  SymmetricJob job;
  if (const char* setting = one_sided_setting(options)) {
    job.note = fmt::format("not looked for: `{}` is given", setting);
    return job;
  }
  std::vector<MirrorPlane> planes = mirror_planes(model.shape(), context);
  std::string left_out;
  std::erase_if(planes, [&](const MirrorPlane& plane) {
    if (is_symmetric(options, plane)) return false;
    left_out += fmt::format("{}{}: the sizes or faces given are not symmetric", left_out.empty() ? "" : "; ",
                            plane.name());
    return true;
  });
  job.note = left_out;
  if (planes.empty() && left_out.empty()) job.note = "the model has no mirror plane";
  if (planes.empty()) return job;
  job.part = cut_at_planes(model, std::move(planes), context);
  if (!job.part) {
    job.note += std::string(left_out.empty() ? "" : "; ") + "the model could not be cut at its planes";
    return job;
  }
  job.options = options_for(*job.part, model, options);
  return job;
}

}  // namespace quadrille
