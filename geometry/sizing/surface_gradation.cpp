/// Grades each face in its own band of voxels and passes sizes over shared edges until nothing changes.

#include "geometry/sizing/surface_gradation.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <optional>
#include <utility>

#include "geometry/base/whole_number.hpp"
#include "geometry/cad/bounding_box.hpp"
#include "geometry/cad/parallel_ids.hpp"
#include "geometry/surfaces/edge_curve.hpp"
#include "geometry/surfaces/face_surface.hpp"

namespace quadrille {

namespace {

/// Determines which voxels a face needs. Look-ups read the corners of the voxel around a point, and points
/// may be a little off the surface.
class FaceBand {
 public:
  explicit FaceBand(const CadFace& face) : surface_(face) {
    constexpr double off = 0.3;
    // Largest distance of a voxel corner from a plane through the voxel.
    width_ = off + (surface_.planar() ? surface_.normal({0, 0}).lpNorm<1>() : std::sqrt(3.0));
    const Bnd_Box box = box_of(face.face);
    if (box.IsVoid()) return;
    low_ = to_vector(box.CornerMin());
    high_ = to_vector(box.CornerMax());
  }
  bool operator()(const Vector3& p, double voxel) const {
    const double width = width_ * voxel;
    return (low_ - p).cwiseMax(p - high_).maxCoeff() <= width && surface_.distance_at_least(p) <= width;
  }

 private:
  FaceSurface surface_;
  double width_;  // half width of the band, in voxels
  Vector3 low_{0, 0, 0}, high_{0, 0, 0};
};

/// Finds the voxels of a cascade around points.
class VoxelFinder {
 public:
  explicit VoxelFinder(const SizeCascade& cascade) : cascade_(cascade) {
    for (int level = 0; level < cascade.levels(); ++level) {
      accessors_.emplace_back();
      if (SizeTree* tree = cascade.tree(level)) accessors_.back().emplace(*tree);
    }
  }

  /// The voxel around a point on the finest level on which it has an active corner, and the level. Nothing
  /// if the last grading has changed no corner of it.
  std::optional<std::pair<int, Coord>> find_changed(const Vector3& p) {
    for (int level = cascade_.levels() - 1; level >= 0; --level) {
      if (!accessors_[level]) continue;
      const Coord base = voxel_at(p / cascade_.frame().voxel(level));
      bool active = false, changed = false;
      for (int k = 0; k < 8; ++k) {
        const Coord c = corner_of(base, k);
        float value = 0;
        active |= accessors_[level]->probe(c, value);
        changed |= accessors_[level]->stamp(c) >= cascade_.stamp();
      }
      if (active) return changed ? std::optional(std::pair(level, base)) : std::nullopt;
    }
    return {};
  }

  /// \return whether the voxel is active.
  bool probe(int level, const Coord& c, float& value) {
    return level < cascade_.levels() && accessors_[level] && accessors_[level]->probe(c, value);
  }

 private:
  const SizeCascade& cascade_;
  std::vector<std::optional<VoxelAccessor>> accessors_;
};

class SurfaceGradation {
 public:
  SurfaceGradation(const CadShape& shape, FaceCascades& cascades, double slope, BlockCount& blocks,
                   const ExecutionContext& context)
      : shape_(shape),
        cascades_(cascades),
        slope_(slope),
        blocks_(blocks),
        context_(context),
        bands_(shape.faces.size()),
        graded_(shape.faces.size()),
        samples_(shape.edges.size()),
        lowered_(shape.edges.size()) {}

  void run() {
    // Most sizes that pass over edges lie at the edges, so pass them before the first grading.
    for (const FaceId face : graded_.ids()) graded_[face] = cascade_of(face).is_fresh();
    do {
      pass_over_edges();
      take_what_passed();
    } while (grade_faces());
  }

 private:
  struct Sample {
    double t;
    Vector3 point;
    double size = 0;  // on the face whose sizes are passed
  };
  /// A voxel that gets a smaller size from across an edge.
  struct Lowered {
    FaceId face;
    int level;
    Coord coord;
    float value;
  };

  /// \return whether there was anything to do.
  bool grade_faces() {
    for_each_id(graded_, [&](FaceId face) {
      graded_[face] = cascade_of(face).is_fresh();
      if (!graded_[face]) return;
      if (!bands_[face]) bands_[face] = std::make_unique<FaceBand>(shape_.faces[face]);
      cascade_of(face).grade(slope_, std::cref(*bands_[face]), blocks_, context_);
    });
    return std::any_of(graded_.begin(), graded_.end(), [](char graded) { return graded != 0; });
  }

  /// The faces of an edge, each once.
  static std::vector<FaceId> faces_of(const CadEdge& edge) {
    std::vector<FaceId> faces;
    std::unique_copy(edge.faces.begin(), edge.faces.end(), std::back_inserter(faces));
    return faces;
  }

  void pass_over_edges() {
    for_each_id(shape_.edges, [&](EdgeId id) {
      const CadEdge& edge = shape_.edges[id];
      if (edge.degenerate || !(edge.length > 0)) return;
      const std::vector<FaceId> faces = faces_of(edge);
      if (faces.size() < 2) return;
      for (const FaceId face : faces) {
        if (graded_[face]) pass(id, face, faces);
      }
    });
  }

  /// Passes a face's sizes to its neighbors along an edge.
  void pass(EdgeId id, FaceId from, const std::vector<FaceId>& faces) {
    const CadEdge& edge = shape_.edges[id];
    const SizeCascade& cascade = cascade_of(from);
    if (cascade.levels() == 0) return;
    const EdgeCurve curve(edge);
    std::vector<Sample>& samples = samples_[id];
    if (samples.empty()) {
      const int n = 1 + to_int(std::ceil(edge.length / cascade.frame().size_max));
      for (int i = 0; i <= n; ++i)
        samples.push_back(sample(curve, edge.first + (edge.last - edge.first) * i / n));
    }
    Passing passing{id, SizeCascade::Lookup(cascade), VoxelFinder(cascade), {}, {}};
    for (const FaceId face : faces) {
      if (face != from) passing.targets.emplace_back(face, VoxelFinder(cascade_of(face)));
    }
    SparseCheck check(context_, 256);
    bool changed = pass_voxel(passing, samples.front().point);
    std::vector<Sample>& closer = passing.samples;
    closer.push_back(samples.front());
    for (std::size_t i = 1; i < samples.size(); ++i) {
      check();
      const bool changed_before = changed;
      changed = pass_voxel(passing, samples[i].point);
      if (changed || changed_before) {
        for (Sample* end : {&samples[i - 1], &samples[i]}) end->size = passing.size_at(end->point);
        split(curve, passing, samples[i - 1], samples[i], 0);
      }
      closer.push_back(samples[i]);
    }
    samples = std::move(closer);
  }

  /// The state of passing one face's sizes to others across an edge.
  struct Passing {
    EdgeId edge;
    SizeCascade::Lookup size_at;
    VoxelFinder finder;
    std::vector<std::pair<FaceId, VoxelFinder>> targets;
    std::vector<Sample> samples;  // samples along the edge
  };

  static Sample sample(const EdgeCurve& curve, double t) { return {t, curve.point(t)}; }

  /// Passes sizes at samples between two others, by halving until they are about a voxel apart.
  void split(const EdgeCurve& curve, Passing& passing, const Sample& a, const Sample& b, int depth) {
    constexpr int max_halvings = 40;
    constexpr double share = 0.7;  // share of the size, which is at most a voxel width
    if (depth > max_halvings || (a.point - b.point).norm() <= share * std::min(a.size, b.size)) return;
    Sample middle = sample(curve, 0.5 * (a.t + b.t));
    middle.size = passing.size_at(middle.point);
    if (std::min({a.size, b.size, middle.size}) >= cascades_.front()->frame().size_max) return;
    split(curve, passing, a, middle, depth + 1);
    pass_voxel(passing, middle.point);
    passing.samples.push_back(middle);
    split(curve, passing, middle, b, depth + 1);
  }

  /// Records the corners of the voxel around a point that are smaller on one face than on others. \return
  /// whether the last grading changed the voxel.
  bool pass_voxel(Passing& passing, const Vector3& point) {
    const auto changed = passing.finder.find_changed(point);
    if (!changed) return false;
    const auto& [level, base] = *changed;
    for (int k = 0; k < 8; ++k) {
      const Coord c = corner_of(base, k);
      float value = 0, own = 0;
      if (!passing.finder.probe(level, c, value)) continue;
      for (auto& [face, finder] : passing.targets) {
        if (!finder.probe(level, c, own) || value < own)
          lowered_[passing.edge].push_back({face, level, c, value});
      }
    }
    return true;
  }

  void take_what_passed() {
    IdVector<FaceId, std::vector<EdgeId>> edges_of(cascades_.size());
    for (const EdgeId edge : lowered_.ids()) {
      if (lowered_[edge].empty()) continue;
      for (const FaceId face : faces_of(shape_.edges[edge])) edges_of[face].push_back(edge);
    }
    for_each_id(edges_of, [&](FaceId face) {
      for (const EdgeId edge : edges_of[face]) {
        for (const Lowered& voxel : lowered_[edge]) {
          if (voxel.face == face) cascade_of(face).lower(voxel.level, voxel.coord, voxel.value, blocks_);
        }
      }
    });
    for (auto& lowered : lowered_) lowered.clear();
  }

  SizeCascade& cascade_of(FaceId face) { return *cascades_[face.index()]; }

  const CadShape& shape_;
  FaceCascades& cascades_;
  double slope_;
  BlockCount& blocks_;
  const ExecutionContext& context_;
  IdVector<FaceId, std::unique_ptr<FaceBand>> bands_;
  FaceFlags graded_;                                // 1 = graded in this round
  IdVector<EdgeId, std::vector<Sample>> samples_;   // samples along the edge, refined to the sizes there
  IdVector<EdgeId, std::vector<Lowered>> lowered_;  // voxels to lower
};

}  // namespace

void grade_on_surface(const CadShape& shape, FaceCascades& cascades, double slope, BlockCount& blocks,
                      const ExecutionContext& context) {
  SurfaceGradation(shape, cascades, slope, blocks, context).run();
}

}  // namespace quadrille
