/// Triangulates the surface and looks sizes up at its points, once for all sources and once for each alone.

#include "mesher/size_map.hpp"

#include <algorithm>
#include <limits>
#include <string_view>

#include "geometry/base/threads.hpp"
#include "geometry/cad/cad_shape.hpp"
#include "geometry/cad/parallel_ids.hpp"
#include "geometry/sizing/sizing_field.hpp"
#include "geometry/surfaces/face_surface.hpp"
#include "geometry/surfaces/surface_triangles.hpp"
#include "mesher/estimate.hpp"
#include "mesher/settings.hpp"
#include "mesher/stages/prepared.hpp"

namespace quadrille {

namespace {

/// Triangle sides are at most this share of the model's diagonal or this many sizes, whichever is larger.
constexpr double longest_share = 1 / 300.0, longest_sizes = 1.5;
constexpr std::size_t most_triangles = 1000000;
/// Radians between neighboring triangles on curved faces. Small fillets far below the size should not take
/// most of the triangles.
constexpr double turn_of_triangle = 0.4;

/// Edges stay whole, so that entities are those of the model.
const Preparation undivided{.divides = false};

/// One source of sizes: whether options use it, and how to copy it into options without sources.
struct Kind {
  std::string_view name;
  bool (*has)(const SizingOptions&);
  void (*take)(SizingOptions& to, const SizingOptions& from);
};

using Options = SizingOptions;

template <auto... members>
void take(Options& to, const Options& from) {
  ((to.*members = from.*members), ...);
}

constexpr Kind kinds[] = {
    {"curvature", [](const Options& o) { return o.elements_per_circle > 0; },
     take<&Options::elements_per_circle>},
    {"chord-error", [](const Options& o) { return o.chord_error.length > 0 || o.chord_error.share > 0; },
     take<&Options::chord_error>},
    {"short edges", [](const Options& o) { return o.short_edges; }, take<&Options::short_edges>},
    {"proximity", [](const Options& o) { return o.proximity > 0; }, take<&Options::proximity>},
    {"size-on",
     [](const Options& o) {
       return !o.face_sizes.empty() || !o.edge_sizes.empty() || !o.vertex_sizes.empty();
     },
     take<&Options::face_sizes, &Options::edge_sizes, &Options::vertex_sizes>},
    {"size-in", [](const Options& o) { return !o.regions.empty(); }, take<&Options::regions>},
    // The sizes of edges determine the number of segments if there is only a bias.
    {"segments, bias", [](const Options& o) { return !o.spacings.empty(); },
     take<&Options::spacings, &Options::edge_sizes>},
    {"size-points", [](const Options& o) { return !o.size_points.empty(); }, take<&Options::size_points>},
    {"size-field", [](const Options& o) { return !o.size_field.empty(); },
     take<&Options::size_field, &Options::size_field_scale, &Options::size_field_unit>},
};

/// Options with the same limits, gradation and budget, but without sources.
SizingOptions without_sources(const SizingOptions& options, const SizeLimits& limits) {
  SizingOptions none;
  take<&Options::growth, &Options::gradation, &Options::aspect, &Options::budget>(none, options);
  none.size = limits.largest;
  none.size_min = limits.least;
  none.elements_per_circle = 0;
  none.short_edges = false;
  return none;
}

/// Looks up sizes at the points of a map.
class Look {
 public:
  Look(const CadShape& shape, SurfaceTriangles surface)
      : points_(std::move(surface.points)), curvatures_(points_.size(), 0), of_face_(shape.faces.size()) {
    for (std::size_t i = 0; i < points_.size(); ++i)
      of_face_[surface.point_faces[i]].push_back(static_cast<int>(i));
    for_each_id(of_face_, [&](FaceId face) {
      const FaceSurface own(shape.faces[face]);
      for (const int i : of_face_[face]) curvatures_[i] = own.max_curvature(surface.uv[i]);
    });
  }

  struct Sizes {
    std::vector<double> across, along;  // (points) of bends; equal elsewhere
  };

  Sizes sizes(const SizingField& field) const {
    Sizes result{std::vector<double>(points_.size(), 0), std::vector<double>(points_.size(), 0)};
    for_each_id(of_face_, [&](FaceId face) {
      if (of_face_[face].empty()) return;
      SizingField::Sampler size_at(field, face);
      for (const int i : of_face_[face]) {
        result.along[i] = size_at(points_[i]);
        result.across[i] = size_at.across(result.along[i], curvatures_[i]);
      }
    });
    return result;
  }

 private:
  std::vector<Vector3> points_;
  std::vector<double> curvatures_;              // (points)
  IdVector<FaceId, std::vector<int>> of_face_;  // indices of the points on each
};

/// Sums up area and quads, and finds the range of sizes, where each source governs.
void sum_up(SizeMap& map) {
  for (SizeMap::Source& source : map.sources) source.least = std::numeric_limits<double>::infinity();
  for (const auto& nodes : map.triangles) {
    const Vector3 &a = map.points[nodes[0]], &b = map.points[nodes[1]], &c = map.points[nodes[2]];
    const double area = (b - a).cross(c - a).norm() / 6;  // a third of the triangle's area for each corner
    for (const int node : nodes) {
      SizeMap::Source& source = map.sources[map.rulers[node]];
      const double size = map.sizes[node];
      source.area += area;
      source.quads += area / (size * map.along[node]);
      source.least = std::min(source.least, size);
      source.largest = std::max(source.largest, size);
    }
  }
  double sum = 0;
  for (const SizeMap::Source& source : map.sources) sum += source.quads;
  for (SizeMap::Source& source : map.sources) {
    if (sum > 0) source.quads *= map.quads / sum;
    if (source.area == 0) source.least = 0;
  }
}

/// Finds the source that gives the smallest size at each point when used alone.
void find_rulers(const CadModel& model, const MeshOptions& options, const Look& look, SizeMap& map,
                 ExecutionContext& context) {
  const SizeLimits limits = size_limits(model, options.sizing);
  // Interpolation returns slightly less than the largest size even where no source requests less.
  constexpr double less = 0.999;
  std::vector<double> least(map.points.size(), less * limits.largest);
  map.sources.push_back({"size"});
  map.rulers.assign(map.points.size(), 0);
  for (const Kind& kind : kinds) {
    if (!kind.has(options.sizing)) continue;
    MeshOptions alone = options;
    alone.sizing = without_sources(options.sizing, limits);
    kind.take(alone.sizing, options.sizing);
    const std::vector<double> sizes =
        look.sizes(sizes_for(Prepared(model, alone, undivided), context)).across;
    const int number = static_cast<int>(map.sources.size());
    map.sources.push_back({std::string(kind.name)});
    for (std::size_t i = 0; i < sizes.size(); ++i) {
      if (sizes[i] >= least[i]) continue;
      least[i] = sizes[i];
      map.rulers[i] = number;
    }
  }
}

SurfaceTriangles triangles_for(const CadModel& model, const MeshOptions& options, const SizingField& field,
                               const ExecutionContext& context) {
  const double share = longest_share * model.diagonal();
  const double deflection = std::min(0.1 * field.limits().largest, share);
  SurfaceTriangles surface =
      triangulate_surface(model.shape(), deflection, turn_of_triangle, faces_used(model, options), context);
  IdVector<FaceId, std::unique_ptr<SizingField::Sampler>> samplers(model.face_count());
  const auto longest = [&](FaceId face, const Vector3& point) {
    auto& size_at = samplers[face];
    if (!size_at) size_at = std::make_unique<SizingField::Sampler>(field, face);
    return std::max(longest_sizes * (*size_at)(point), share);
  };
  divide_sides(surface, longest, most_triangles, context);
  return surface;
}

}  // namespace

SizeMap size_map(const CadModel& model, const MeshOptions& options, ExecutionContext& context) {
  SizeMap map;
  QuadEstimate estimate(model, context);
  map.quads = estimate.quads(options);
  on_threads(context.threads(), [&] {
    const SizingField field = sizes_for(Prepared(model, options, undivided), context);
    if (!options.write_size_field.empty()) field.write(options.write_size_field);
    SurfaceTriangles surface = triangles_for(model, options, field, context);
    map.triangles = std::move(surface.triangles);
    for (const FaceId face : surface.faces) map.faces.push_back(face.number());
    for (const FaceId face : surface.missing) map.missing.push_back(face.number());
    for (const SurfaceTriangles::Line& line : surface.lines) map.lines.push_back({line.points, line.edge});
    map.points = surface.points;
    const Look look(model.shape(), std::move(surface));
    Look::Sizes found = look.sizes(field);
    map.sizes = std::move(found.across);
    map.along = std::move(found.along);
    find_rulers(model, options, look, map, context);
  });
  sum_up(map);
  return map;
}

}  // namespace quadrille
