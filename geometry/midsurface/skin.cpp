/// Samples the triangles of faces; rays meet triangles first and are then polished on the surface by Newton.

#include "geometry/midsurface/skin.hpp"
#include "geometry/base/whole_number.hpp"

#include <BRepMesh_IncrementalMesh.hxx>
#include <Poly_Triangulation.hxx>
#include <Precision.hxx>
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "geometry/cad/bounding_box.hpp"
#include "geometry/cad/shape_parts.hpp"
#include "geometry/midsurface/widths.hpp"

namespace quadrille {

namespace {

std::vector<SkinTriangle> triangles_of(const TopoDS_Face& face) {
  TopLoc_Location place;
  const Handle(Poly_Triangulation) mesh = BRep_Tool::Triangulation(face, place);
  std::vector<SkinTriangle> result;
  if (mesh.IsNull() || !mesh->HasUVNodes()) return result;
  for (int i = 1; i <= mesh->NbTriangles(); ++i) {
    std::array<int, 3> nodes{};
    mesh->Triangle(i).Get(nodes[0], nodes[1], nodes[2]);
    SkinTriangle triangle;
    for (int j = 0; j < 3; ++j) {
      triangle.points[j] = mesh->Node(nodes[j]).Transformed(place.Transformation());
      triangle.uv[j] = mesh->UVNode(nodes[j]);
    }
    const gp_Vec ab(triangle.points[0], triangle.points[1]), ac(triangle.points[0], triangle.points[2]);
    triangle.area = 0.5 * ab.Crossed(ac).Magnitude();
    result.push_back(triangle);
  }
  return result;
}

gp_Pnt2d blend(const std::array<gp_Pnt2d, 3>& corners, double a, double b) {
  const double c = 1 - a - b;
  return {a * corners[0].X() + b * corners[1].X() + c * corners[2].X(),
          a * corners[0].Y() + b * corners[1].Y() + c * corners[2].Y()};
}

/// Adds the centers of the n * n equal parts of a triangle. \param area that they represent together.
void add_centers(const SkinTriangle& triangle, double area, int n, const BRepAdaptor_Surface& surface,
                 std::vector<FaceSample>& samples) {
  const auto add = [&](double a, double b) {
    const gp_Pnt2d uv = blend(triangle.uv, a, b);
    samples.push_back({uv, surface.Value(uv.X(), uv.Y()), area / (n * n)});
  };
  for (int i = 0; i < n; ++i) {
    for (int j = 0; i + j < n; ++j) {
      add((i + 1.0 / 3) / n, (j + 1.0 / 3) / n);
      if (i + j + 1 < n) add((i + 2.0 / 3) / n, (j + 2.0 / 3) / n);
    }
  }
}

/// Points inside a face, evenly spread over its parameters but in no rows, in which holes may lie too; more
/// and more until there are enough.
std::vector<FaceSample> grid_samples(const TopoDS_Face& face, int at_least) {
  constexpr int max_rows = 256;
  const BRepAdaptor_Surface surface(face, Standard_True);
  const InsideTest inside(face);
  const double u = surface.FirstUParameter(), v = surface.FirstVParameter();
  std::vector<FaceSample> result;
  for (int n = 16; n <= max_rows && std::ssize(result) < at_least; n *= 2) {
    result.clear();
    const double du = (surface.LastUParameter() - u) / n, dv = (surface.LastVParameter() - v) / n;
    for (int i = 0; i < n * n; ++i) {
      const double along_u = 0.5 + 0.7548776662466927 * i, along_v = 0.5 + 0.5698402909980532 * i;
      const gp_Pnt2d uv(u + n * du * (along_u - std::floor(along_u)),
                        v + n * dv * (along_v - std::floor(along_v)));
      if (inside.at(uv, Precision::PConfusion()) != TopAbs_IN) continue;
      gp_Pnt at;
      gp_Vec by_u, by_v;
      surface.D1(uv.X(), uv.Y(), at, by_u, by_v);
      result.push_back({uv, at, by_u.Crossed(by_v).Magnitude() * std::abs(du * dv)});
    }
  }
  return result;
}

/// The point of a surface on a line, starting from a guess.
std::optional<SkinFace::LineHit> polished(const gp_Lin& line, const BRepAdaptor_Surface& surface, double near,
                                          gp_Pnt2d uv, double along) {
  const gp_Vec direction(line.Direction());
  for (int step = 0; step < 12; ++step) {  // Newton iteration
    gp_Pnt at;
    gp_Vec du, dv;
    surface.D1(uv.X(), uv.Y(), at, du, dv);
    const gp_Vec off(at, line.Location().Translated(along * direction));
    if (off.Magnitude() < near) return SkinFace::LineHit{uv, along};
    const gp_Vec normal = du.Crossed(dv);
    const double volume = normal.Dot(direction);
    if (std::abs(volume) < 1e-9 * normal.Magnitude() || !(normal.Magnitude() > 0)) return std::nullopt;
    along -= off.Dot(normal) / volume;
    uv.SetX(uv.X() + off.Crossed(dv).Dot(direction) / volume);
    uv.SetY(uv.Y() + du.Crossed(off).Dot(direction) / volume);
  }
  return std::nullopt;
}

std::optional<SkinFace::LineHit> hit_at(const gp_Lin& line, const SkinTriangle& flat,
                                        const BRepAdaptor_Surface& surface, double near) {
  const gp_Vec along(line.Direction()), ab(flat.points[0], flat.points[1]),
      ac(flat.points[0], flat.points[2]);
  // Barycentric coordinates, with a small margin. A line through a shared edge may give a hit twice.
  const gp_Vec normal = along.Crossed(ac);
  const double volume = ab.Dot(normal);
  if (std::abs(volume) < 1e-12 * ab.Magnitude() * ac.Magnitude()) return std::nullopt;
  const gp_Vec from(flat.points[0], line.Location());
  const double b = from.Dot(normal) / volume;
  const gp_Vec aside = from.Crossed(ab);
  const double c = along.Dot(aside) / volume;
  constexpr double beyond = 1e-9;
  if (b < -beyond || c < -beyond || b + c > 1 + beyond) return std::nullopt;
  return polished(line, surface, near, blend(flat.uv, 1 - b - c, b), ac.Dot(aside) / volume);
}

}  // namespace

std::vector<FaceSample> sample_face(const TopoDS_Face& face, int at_least) {
  if (has_many_holes(face)) return grid_samples(face, at_least);
  const std::vector<SkinTriangle> triangles = triangles_of(face);
  double area = 0;
  for (const SkinTriangle& triangle : triangles) area += triangle.area;
  std::vector<FaceSample> result;
  if (!(area > 0)) return result;
  // OpenCASCADE fills some crescents with triangles that leave the face.
  constexpr double most_off = 0.25;
  if (std::abs(area / area_of(face) - 1) > most_off) {
    result = grid_samples(face, at_least);
    if (!result.empty()) return result;
  }
  const BRepAdaptor_Surface surface(face, Standard_False);
  double left_out = 0;  // area of small triangles, which the next one represents
  for (const SkinTriangle& triangle : triangles) {
    left_out += triangle.area;
    if (left_out < 0.5 * area / at_least && &triangle != &triangles.back()) continue;
    const int n = to_int(std::clamp(std::ceil(std::sqrt(at_least * triangle.area / area)), 1.0, 64.0));
    add_centers(triangle, left_out, n, surface, result);
    left_out = 0;
  }
  return result;
}

void triangulate(const TopoDS_Shape& shape, double deflection, double angle) {
  std::vector<TopoDS_Shape> faces = list_of(shape, TopAbs_FACE);
  std::erase_if(faces, [](const TopoDS_Shape& face) { return has_many_holes(TopoDS::Face(face)); });
  BRepMesh_IncrementalMesh(compound_of(faces), deflection, Standard_False, angle, Standard_False);
}

SkinFace::SkinFace(const TopoDS_Face& face, int number, double near)
    : face_(face),
      number_(number),
      near_(near),
      area_(area_of(face)),
      width_(width_of(face)),
      box_(box_of(face)),
      adaptor_(std::make_shared<BRepAdaptor_Surface>(face, Standard_False)),
      inverse_(std::make_shared<ClosestPoint>(face)),
      inside_(std::make_shared<InsideTest>(face)) {
  if (has_many_holes(face)) return;
  triangles_ = triangles_of(face);
  std::vector<Bnd_Box> boxes(triangles_.size());
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    for (const gp_Pnt& corner : triangles_[i].points) boxes[i].Add(corner);
    boxes[i].Enlarge(near);
  }
  boxes_ = BoxTree(boxes);
}

std::optional<gp_Dir> SkinFace::outward(const gp_Pnt2d& uv) const {
  gp_Pnt at;
  gp_Vec du, dv;
  adaptor_->D1(uv.X(), uv.Y(), at, du, dv);
  const gp_Vec normal = du.Crossed(dv);
  if (normal.Magnitude() <= 1e-12 * (du.SquareMagnitude() + dv.SquareMagnitude())) return std::nullopt;
  return face_.Orientation() == TopAbs_REVERSED ? gp_Dir(normal.Reversed()) : gp_Dir(normal);
}

gp_Pnt2d SkinFace::closest(const gp_Pnt& point) const {
  return (*inverse_)(point);
}

bool SkinFace::holds(const gp_Pnt2d& uv) const {
  const double near = 1e-6 * std::sqrt(box_.SquareExtent());
  const TopAbs_State state =
      inside_->at(uv, std::max(adaptor_->UResolution(near), adaptor_->VResolution(near)));
  return state == TopAbs_IN || state == TopAbs_ON;
}

std::optional<gp_Pnt> SkinFace::foot(const gp_Pnt& from) const {
  const gp_Pnt2d uv = closest(from);
  return holds(uv) ? std::optional(point(uv)) : std::nullopt;
}

std::vector<SkinFace::LineHit> SkinFace::hits(const gp_Lin& line, double from, double to) const {
  std::vector<LineHit> result;
  if (has_many_holes(face_)) {  // on a plane one step of Newton's is enough, from anywhere
    const auto hit = polished(line, *adaptor_, near_, {}, 0);
    if (hit && holds(hit->uv)) result.push_back(*hit);
  }
  for (const std::size_t i : boxes_.met(line, from, to))
    if (const auto hit = hit_at(line, triangles_[i], *adaptor_, near_)) result.push_back(*hit);
  return result;
}

Skin::Skin(const TopoDS_Solid& solid, const TopTools_DataMapOfShapeInteger& numbers) : solid_(solid) {
  TopExp::MapShapes(solid, TopAbs_FACE, map_);
  TopExp::MapShapesAndAncestors(solid, TopAbs_EDGE, TopAbs_FACE, around_);
  Bnd_Box whole;
  std::vector<Bnd_Box> boxes;
  for (int i = 1; i <= map_.Extent(); ++i) whole.Add(boxes.emplace_back(box_of(map_(i))));
  boxes_ = BoxTree(boxes);
  size_ = std::sqrt(whole.SquareExtent());
  faces_.reserve(map_.Extent());
  for (int i = 1; i <= map_.Extent(); ++i)
    faces_.emplace_back(TopoDS::Face(map_(i)), numbers.Find(map_(i)), 1e-8 * size_);
}

std::vector<std::pair<TopoDS_Edge, int>> Skin::neighbors(const SkinFace& of) const {
  std::vector<std::pair<TopoDS_Edge, int>> result;
  for (const TopoDS_Edge& edge : edges_of(of.face())) {
    for (const TopoDS_Shape& face : around_.FindFromKey(edge))
      if (!face.IsSame(of.face())) result.emplace_back(edge, index_of(face));
  }
  return result;
}

std::vector<int> Skin::faces_at(const gp_Pnt& point, double tolerance) const {
  const Bnd_Box at(point, point);
  std::vector<int> result;
  for (std::size_t i = 0; i < faces_.size(); ++i) {
    if (faces_[i].box().Distance(at) > tolerance) continue;
    const auto foot = faces_[i].foot(point);
    if (foot && foot->Distance(point) < tolerance) result.push_back(static_cast<int>(i));
  }
  return result;
}

std::optional<Skin::Hit> Skin::first_hit(const gp_Pnt& from, const gp_Dir& direction, double reach) const {
  const gp_Lin line(from, direction);
  const double far = std::min(reach, size_);
  Hit best;
  for (const std::size_t face : boxes_.met(line, 1e-6 * size_, far)) {
    for (const SkinFace::LineHit& hit : faces_[face].hits(line, 0, far)) {
      if (hit.along < 1e-6 * size_ || (best.face >= 0 && hit.along >= best.distance)) continue;
      best = {static_cast<int>(face), hit.uv, faces_[face].point(hit.uv), hit.along};
    }
  }
  return best.face < 0 ? std::nullopt : std::optional(best);
}

bool Skin::in_material(const gp_Pnt& point) const {
  constexpr double grazing = 0.05;  // cosine between ray and normal below which another ray is tried
  bool result = false;
  for (const gp_Dir& along :
       {gp_Dir(0.31, 0.52, 0.79), gp_Dir(-0.73, 0.41, -0.55), gp_Dir(0.59, -0.76, 0.27)}) {
    const auto hit = first_hit(point, along);
    const auto outward = hit ? faces_[hit->face].outward(hit->uv) : std::nullopt;
    result = outward && outward->Dot(along) > 0;
    if (!hit || (outward && std::abs(outward->Dot(along)) > grazing)) break;
  }
  return result;
}

bool Skin::meets_face(const gp_Pnt& from, const gp_Dir& direction, double reach) const {
  const auto hit = first_hit(from.Translated(-reach * gp_Vec(direction)), direction, 2 * reach);
  return hit && hit->distance < 2 * reach;
}

}  // namespace quadrille
