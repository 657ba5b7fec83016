#include "geometry/sizing/surface_gradation.hpp"

#include <oneapi/tbb/parallel_for.h>
#include <BRepBndLib.hxx>
#include <Bnd_Box.hxx>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <optional>
#include <utility>

#include "geometry/surfaces/edge_curve.hpp"
#include "geometry/surfaces/face_surface.hpp"

namespace quadrille {

namespace {

/// Voxels that faces keep beside them: look-ups read the corners of the voxel that a point is in, and points
/// may be a little off the surface.
constexpr double band = 2;

/// Where voxels of a face lie.
class FaceBand {
 public:
  explicit FaceBand(const CadFace& face) : surface_(face) {
    Bnd_Box box;
    BRepBndLib::Add(face.face, box, Standard_False);
    if (box.IsVoid()) return;
    low_ = to_vector(box.CornerMin());
    high_ = to_vector(box.CornerMax());
  }
  bool operator()(const Vector3& p, double voxel) const {
    const double width = band * voxel;
    return (low_ - p).cwiseMax(p - high_).maxCoeff() <= width && surface_.distance_at_least(p) <= width;
  }

 private:
  FaceSurface surface_;
  Vector3 low_{0, 0, 0}, high_{0, 0, 0};
};

class SurfaceGradation {
 public:
  SurfaceGradation(const CadShape& shape, FaceCascades& cascades, double slope, double most,
                   BlockCount& blocks, const ExecutionContext& context)
      : shape_(shape),
        cascades_(cascades),
        slope_(slope),
        most_(most),
        blocks_(blocks),
        context_(context),
        bands_(shape.faces.size()),
        graded_(shape.faces.size(), 0),
        samples_(shape.edges.size()),
        lowered_(shape.edges.size()) {}

  void run() {
    while (grade_faces()) {
      pass_over_edges();
      take_what_passed();
    }
  }

 private:
  struct Sample {
    double t;
    Vector3 point;
  };
  /// A voxel whose size came over an edge.
  struct Lowered {
    int face, level;
    Coord coord;
    float value;
  };

  /// \return whether there was anything to do.
  bool grade_faces() {
    oneapi::tbb::parallel_for(0, static_cast<int>(cascades_.size()), [&](int face) {
      graded_[face] = cascades_[face]->is_fresh();
      if (!graded_[face]) return;
      if (!bands_[face]) bands_[face] = std::make_unique<FaceBand>(shape_.faces[face]);
      const FaceBand& near = *bands_[face];
      const auto is_near = [&near](const Vector3& p, double voxel) { return near(p, voxel); };
      cascades_[face]->grade(slope_, most_, is_near, blocks_, context_);
    });
    return std::any_of(graded_.begin(), graded_.end(), [](char graded) { return graded != 0; });
  }

  /// The faces of an edge, each once.
  static std::vector<int> faces_of(const CadEdge& edge) {
    std::vector<int> faces;
    std::unique_copy(edge.faces.begin(), edge.faces.end(), std::back_inserter(faces));
    for (int& face : faces) --face;
    return faces;
  }

  void pass_over_edges() {
    oneapi::tbb::parallel_for(0, static_cast<int>(shape_.edges.size()), [&](int index) {
      const CadEdge& edge = shape_.edges[index];
      if (edge.degenerate || !(edge.length > 0)) return;
      const std::vector<int> faces = faces_of(edge);
      if (faces.size() < 2) return;
      for (const int face : faces) {
        if (graded_[face]) pass(index, face, faces);
      }
    });
  }

  /// What a face's sizes ask of its neighbors along an edge.
  void pass(int index, int from, const std::vector<int>& faces) {
    const CadEdge& edge = shape_.edges[index];
    const SizeCascade& cascade = *cascades_[from];
    if (cascade.levels() == 0) return;
    const EdgeCurve curve(edge);
    SizeCascade::Lookup size_at(cascade);
    std::vector<Sample>& samples = samples_[index];
    if (samples.empty()) {
      const int n = 1 + static_cast<int>(std::ceil(edge.length / cascade.frame().size_max));
      for (int i = 0; i <= n; ++i)
        samples.push_back(sample(curve, edge.first + (edge.last - edge.first) * i / n));
    }
    std::vector<Sample> closer;
    SparseCheck check(context_, 256);
    for (std::size_t i = 0; i < samples.size(); ++i) {
      check();
      closer.push_back(samples[i]);
      if (i + 1 < samples.size()) split(curve, size_at, samples[i], samples[i + 1], 0, closer);
    }
    samples = std::move(closer);
    Coord last;
    int last_level = -1;
    for (const Sample& at : samples) {
      const int level = level_at(cascade, at.point);
      if (level < 0) continue;
      const Coord base = base_at(cascade, at.point, level);
      if (level == last_level && base == last) continue;
      last = base;
      last_level = level;
      for (const int to : faces) {
        if (to != from) pass_voxel(index, from, to, level, base);
      }
    }
  }

  static Sample sample(const EdgeCurve& curve, double t) { return {t, curve.point(t)}; }

  /// Appends samples between two until they are half as far apart as the sizes there are.
  void split(const EdgeCurve& curve, SizeCascade::Lookup& size_at, const Sample& a, const Sample& b,
             int depth, std::vector<Sample>& samples) const {
    constexpr int max_depth = 40;
    const double size = std::min(size_at(a.point), size_at(b.point));
    if (depth > max_depth || (a.point - b.point).norm() <= 0.5 * size) return;
    const Sample middle = sample(curve, 0.5 * (a.t + b.t));
    if (std::min(size, size_at(middle.point)) >= cascades_.front()->frame().size_max) return;
    split(curve, size_at, a, middle, depth + 1, samples);
    samples.push_back(middle);
    split(curve, size_at, middle, b, depth + 1, samples);
  }

  static Coord base_at(const SizeCascade& cascade, const Vector3& p, int level) {
    const Vector3 index = p / cascade.frame().voxel(level);
    return Coord::floor(openvdb::Vec3d(index.x(), index.y(), index.z()));
  }

  /// The finest level with an active corner at a point; -1 where there is none.
  static int level_at(const SizeCascade& cascade, const Vector3& p) {
    for (int level = cascade.levels() - 1; level >= 0; --level) {
      if (cascade.tree(level) == nullptr) continue;
      VoxelAccessor accessor(*cascade.tree(level));
      const Coord base = base_at(cascade, p, level);
      float value = 0;
      for (int k = 0; k < 8; ++k) {
        if (accessor.probe(base.offsetBy(k & 1, k >> 1 & 1, k >> 2), value)) return level;
      }
    }
    return -1;
  }

  /// Notes the corners of a voxel that are less on one face than on another.
  void pass_voxel(int edge, int from, int to, int level, const Coord& base) {
    const SizeCascade& target = *cascades_[to];
    VoxelAccessor there(*cascades_[from]->tree(level));
    const bool known = level < target.levels() && target.tree(level) != nullptr;
    for (int k = 0; k < 8; ++k) {
      const Coord c = base.offsetBy(k & 1, k >> 1 & 1, k >> 2);
      float value = 0, own = 0;
      if (!there.probe(c, value)) continue;
      if (known && VoxelAccessor(*target.tree(level)).probe(c, own) && own <= value) continue;
      lowered_[edge].push_back({to, level, c, value});
    }
  }

  void take_what_passed() {
    std::vector<std::vector<int>> edges_of(cascades_.size());
    for (std::size_t i = 0; i < lowered_.size(); ++i) {
      if (lowered_[i].empty()) continue;
      for (const int face : faces_of(shape_.edges[i])) edges_of[face].push_back(static_cast<int>(i));
    }
    oneapi::tbb::parallel_for(0, static_cast<int>(cascades_.size()), [&](int face) {
      for (const int edge : edges_of[face]) {
        for (const Lowered& voxel : lowered_[edge]) {
          if (voxel.face == face) cascades_[face]->lower(voxel.level, voxel.coord, voxel.value, blocks_);
        }
      }
    });
    for (auto& lowered : lowered_) lowered.clear();
  }

  const CadShape& shape_;
  FaceCascades& cascades_;
  double slope_, most_;
  BlockCount& blocks_;
  const ExecutionContext& context_;
  std::vector<std::unique_ptr<FaceBand>> bands_;
  std::vector<char> graded_;                   // (faces) in this round
  std::vector<std::vector<Sample>> samples_;   // (edges) along it, as close as sizes were found to be
  std::vector<std::vector<Lowered>> lowered_;  // (edges)
};

}  // namespace

void grade_on_surface(const CadShape& shape, FaceCascades& cascades, double slope, double most,
                      BlockCount& blocks, const ExecutionContext& context) {
  SurfaceGradation(shape, cascades, slope, most, blocks, context).run();
}

}  // namespace quadrille
