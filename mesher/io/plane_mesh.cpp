/// The plane is fitted to the nodes, since normals of faces that lie in one plane may point to either side.

#include "mesher/io/plane_mesh.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "geometry/base/error.hpp"

namespace quadrille {

namespace {

constexpr double relative_tolerance = 1e-5;  // of the diagonal; files of other programs have few digits
constexpr double rounding = 1e-8;            // direction cosines below this are taken for 0

/// Axes of the file in the model, and the distance of the mesh's plane from the origin along z.
struct Frame {
  Vector3 x, y, z;
  double height = 0;
};

/// Calls `visit(node, face)` for the nodes of all elements.
template <class Visit>
void for_each_node(const ShellMesh& mesh, Visit&& visit) {
  for (std::size_t i = 0; i < mesh.quads.size(); ++i) {
    for (const int node : mesh.quads[i]) visit(node, mesh.quad_faces[i]);
    if (mesh.order == 2)
      for (const int node : mesh.midsides[i]) visit(node, mesh.quad_faces[i]);
  }
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    for (const int node : mesh.triangles[i]) visit(node, mesh.triangle_faces[i]);
}

/// The largest value that `measure` gives for a node, at least 0, and the face that the node is on.
template <class Measure>
std::pair<double, int> largest(const ShellMesh& mesh, Measure&& measure) {
  std::pair<double, int> result(0, 0);
  for_each_node(mesh, [&](int node, int face) {
    if (const double value = measure(mesh.points[node]); value > result.first) result = {value, face};
  });
  return result;
}

double diagonal_of(const ShellMesh& mesh) {
  Eigen::AlignedBox3d box;
  for_each_node(mesh, [&](int node, int) { box.extend(mesh.points[node]); });
  return box.isEmpty() ? 0 : box.diagonal().norm();
}

/// Normal of the plane that fits best, with components that differ from 0 only by rounding set to 0.
Vector3 fitted_normal(const ShellMesh& mesh, const Vector3& center) {
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for_each_node(mesh, [&](int node, int) {
    const Vector3 from_center = mesh.points[node] - center;
    spread += from_center * from_center.transpose();
  });
  Vector3 normal = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(spread).eigenvectors().col(0);
  for (double& cosine : normal)
    if (std::abs(cosine) < rounding) cosine = 0;
  return normal.normalized();
}

Frame frame_of(const ShellMesh& mesh) {
  Vector3 center = Vector3::Zero();
  double count = 0;
  for_each_node(mesh, [&](int node, int) {
    center += mesh.points[node];
    count += 1;
  });
  center /= std::max(count, 1.0);
  Frame frame;
  frame.z = fitted_normal(mesh, center);
  const bool faces_x = std::abs(frame.z.x()) > 1 - rounding;  // then x has no direction in the plane
  const Vector3 along = faces_x ? Vector3::UnitY() : Vector3::UnitX();
  frame.x = (along - along.dot(frame.z) * frame.z).normalized();
  frame.y = frame.z.cross(frame.x);
  const bool is_level = std::abs(frame.y.z()) < rounding;
  if ((is_level ? frame.y.y() : frame.y.z()) < 0) {
    frame.y = -frame.y;
    frame.z = -frame.z;
  }
  frame.height = center.dot(frame.z);
  return frame;
}

std::string vector_text(const Vector3& v) {
  return fmt::format("({:.9g}, {:.9g}, {:.9g})", v.x() + 0.0, v.y() + 0.0, v.z() + 0.0);  // -0 becomes 0
}

std::string turn_text(const Frame& frame, double tolerance) {
  const bool same = frame.x == Vector3::UnitX() && frame.y == Vector3::UnitY();
  if (same && std::abs(frame.height) <= tolerance) return "";
  return fmt::format(
      "Rotated into the plane z = 0: the point (x, y) here is x {} + y {} + {:.9g} {} in the model",
      vector_text(frame.x), vector_text(frame.y), frame.height, vector_text(frame.z));
}

void check_plane(const ShellMesh& mesh, const Frame& frame, double tolerance, const std::string& subject) {
  const auto [farthest, face] =
      largest(mesh, [&](const Vector3& point) { return std::abs(point.dot(frame.z) - frame.height); });
  if (farthest <= tolerance) return;
  throw usage_error(
      "element",
      fmt::format("{} needs a mesh in one plane, and Face{} leaves the plane that fits "
                  "best by {:.3g}: mesh only faces in one plane (`faces`), or choose a shell or membrane",
                  subject, face, farthest));
}

void check_radii(const ShellMesh& plane, const Frame& frame, double tolerance, const std::string& subject) {
  const auto [beyond, face] = largest(plane, [](const Vector3& point) { return -point.x(); });
  if (beyond <= tolerance) return;
  throw usage_error(
      "element", fmt::format("{} has its axis through the origin along {}, and Face{} reaches to the radius "
                             "{:.6g}: move the model to one side of the axis, where {} is positive",
                             subject, vector_text(frame.y), face, -beyond, vector_text(frame.x)));
}

/// Twice the signed area of the corners in the plane.
template <std::size_t n>
double signed_area(const ShellMesh& mesh, const std::array<int, n>& corners) {
  double sum = 0;
  const Vector3& origin = mesh.points[corners[0]];
  for (std::size_t i = 1; i + 1 < n; ++i)
    sum += (mesh.points[corners[i]] - origin).cross(mesh.points[corners[i + 1]] - origin).z();
  return sum;
}

/// Keeps the first corner of each element.
void make_counter_clockwise(ShellMesh& mesh) {
  for (std::size_t i = 0; i < mesh.quads.size(); ++i) {
    if (signed_area(mesh, mesh.quads[i]) >= 0) continue;
    std::swap(mesh.quads[i][1], mesh.quads[i][3]);
    if (mesh.order == 2) std::reverse(mesh.midsides[i].begin(), mesh.midsides[i].end());
  }
  for (auto& triangle : mesh.triangles)
    if (signed_area(mesh, triangle) < 0) std::swap(triangle[1], triangle[2]);
}

}  // namespace

PlaneMesh in_plane(const ShellMesh& mesh, InpElement element, const std::string& name) {
  const std::string subject = fmt::format("{}: `element` {}", name, name_of(element));
  const double diagonal = diagonal_of(mesh), tolerance = relative_tolerance * diagonal;
  const Frame frame = frame_of(mesh);
  check_plane(mesh, frame, tolerance, subject);
  PlaneMesh result{mesh, turn_text(frame, tolerance)};
  for (Vector3& point : result.mesh.points) point = Vector3(point.dot(frame.x), point.dot(frame.y), 0);
  if (family_of(element) == InpFamily::axisymmetric) {
    check_radii(result.mesh, frame, tolerance, subject);
    for (Vector3& point : result.mesh.points)  // nodes on the axis must lie there exactly
      if (point.x() < rounding * diagonal) point.x() = 0;
  }
  make_counter_clockwise(result.mesh);
  return result;
}

}  // namespace quadrille
