/// Offsets the elements of a shell by half its thickness, as solvers do that expand it into solid elements.

#include "mesher/mesh/skins.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "geometry/base/place_text.hpp"
#include "mesher/mesh/second_order.hpp"

namespace quadrille {

namespace {

/// Where the nodes of an element are in its plane: four corners, then the middles of the sides.
constexpr std::array<std::array<double, 2>, 8> places{
    {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}, {0, -1}, {1, 0}, {0, 1}, {-1, 0}}};

/// The normal at a node of an element.
Vector3 normal_at(const CurvedQuad& element, int i) {
  return area_vector(element, places[i][0], places[i][1]).stableNormalized();
}

class Skins {
 public:
  explicit Skins(const ShellMesh& mesh) : mesh_(mesh), nodes_(mesh.midsides.empty() ? 4 : 8) {
    around_.resize(mesh.points.size());
    for (std::size_t quad = 0; quad < mesh.quads.size(); ++quad) {
      const CurvedQuad element = element_of(quad);
      for (int i = 0; i < nodes_; ++i) around_[node(quad, i)].push_back(normal_at(element, i));
    }
    for (const ShellMesh::VaryingThickness& varying : mesh.varying_thicknesses)
      varying_[varying.face] = &varying;
  }

  bool is_good(std::size_t quad) const {
    const CurvedQuad element = element_of(quad);
    CurvedQuad offset;
    for (int i = 0; i < nodes_; ++i) {
      const int at = node(quad, i);
      (i < 4 ? offset.corners[i] : offset.midsides[i - 4]) =
          0.5 * thickness(mesh_.quad_faces[quad], at) * nodal_normal(at, normal_at(element, i));
    }
    if (nodes_ == 4) straighten(offset);
    for (const double side : {-1.0, 1.0}) {
      CurvedQuad skin;
      for (int k = 0; k < 4; ++k) {
        skin.corners[k] = element.corners[k] + side * offset.corners[k];
        skin.midsides[k] = element.midsides[k] + side * offset.midsides[k];
      }
      const double gauss = std::sqrt(1.0 / 3);
      for (int i = 0; i < 4; ++i) {
        const double x = gauss * places[i][0], y = gauss * places[i][1];
        if (area_vector(skin, x, y).dot(area_vector(element, x, y)) <= 0) return false;
      }
    }
    return true;
  }

 private:
  int node(std::size_t quad, int i) const {
    return i < 4 ? mesh_.quads[quad][i] : mesh_.midsides[quad][i - 4];
  }

  CurvedQuad element_of(std::size_t quad) const {
    return nodes_ == 4 ? straight_quad(mesh_, quad) : curved_quad(mesh_, quad);
  }

  Vector3 nodal_normal(int node, const Vector3& own) const {
    constexpr double cosine = 0.9397;  // the cosine of 20 degrees: across sharper corners nodes are doubled
    Vector3 sum = Vector3::Zero();
    for (const Vector3& other : around_[node]) {
      if (std::abs(other.dot(own)) > cosine) sum += other.dot(own) > 0 ? other : Vector3(-other);
    }
    return sum.norm() > 0 ? Vector3(sum.normalized()) : own;
  }

  double thickness(int face, int node) const {
    const auto varying = varying_.find(face);
    if (varying == varying_.end()) return mesh_.thicknesses[face - 1];
    const auto& nodes = varying->second->nodes;
    const auto found = std::lower_bound(nodes.begin(), nodes.end(), node);
    if (found == nodes.end() || *found != node) return mesh_.thicknesses[face - 1];
    return varying->second->thicknesses[found - nodes.begin()];
  }

  const ShellMesh& mesh_;
  int nodes_;                                 // of an element
  std::vector<std::vector<Vector3>> around_;  // normals of the elements at each node
  std::map<int, const ShellMesh::VaryingThickness*> varying_;
};

}  // namespace

std::vector<int> faces_with_bad_skins(const ShellMesh& mesh) {
  if (mesh.thicknesses.empty()) return {};
  const Skins skins(mesh);
  std::set<int> result;
  for (std::size_t quad = 0; quad < mesh.quads.size(); ++quad) {
    const int face = mesh.quad_faces[quad];
    if (face < 1 || face > static_cast<int>(mesh.thicknesses.size()) || result.count(face) != 0) continue;
    if (!skins.is_good(quad)) result.insert(face);
  }
  return {result.begin(), result.end()};
}

std::string bad_skins_sentence(const std::vector<int>& faces) {
  if (faces.empty()) return {};
  return fmt::format(
      "elements of {} are inverted on a surface of the shell, since it is too thick for its bend radius "
      "there: solvers that expand shells refuse them; make the bend a sharp corner, or mesh it as a solid",
      face_names(faces));
}

}  // namespace quadrille
