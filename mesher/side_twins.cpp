#include "mesher/side_twins.hpp"

namespace quadrille {

void check_indices(const TriangleMesh& mesh) {
  const auto fail = [](std::size_t t, const std::string& what) {
    throw failure(fmt::format("triangle {}", t), fmt::format("triangle {} {}", t, what));
  };
  const auto points = static_cast<unsigned>(mesh.points.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& c = mesh.triangles[t];
    for (int v : c) {
      if (static_cast<unsigned>(v) >= points)
        fail(t, fmt::format("refers to point {}, which does not exist", v));
    }
    if (c[0] == c[1] || c[1] == c[2] || c[2] == c[0]) fail(t, "has the same point twice");
  }
  if (!mesh.tags.empty() && mesh.tags.size() != mesh.triangles.size()) {
    throw failure(
        "tags", fmt::format("{} tags were given for {} triangles", mesh.tags.size(), mesh.triangles.size()));
  }
}

}  // namespace quadrille
