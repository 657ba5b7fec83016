/// Meshes made from arrays, read as arrays, pickled, and shown in notebooks; quads made of triangulations.

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <numeric>
#include <optional>
#include <string>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "mesher/quads/triangulated_surface.hpp"  // improve_on(), which is not in the public headers
#include "workbench/python_mesh.hpp"

namespace py = pybind11;

namespace quadrille {

namespace {

/// A read-only NumPy array over memory that `owner` keeps alive.
template <typename Scalar>
py::array view(const void* data, std::vector<py::ssize_t> shape, const py::object& owner) {
  py::array_t<Scalar> array(std::move(shape), static_cast<const Scalar*>(data), owner);
  array.attr("setflags")(py::arg("write") = false);
  return array;
}

/// A read-only (n, columns) array over a vector of plain records.
template <typename Scalar, typename Record>
py::array table(const std::vector<Record>& records, const py::object& owner) {
  static_assert(sizeof(Record) % sizeof(Scalar) == 0);
  constexpr py::ssize_t columns = sizeof(Record) / sizeof(Scalar);
  return view<Scalar>(records.data(), {static_cast<py::ssize_t>(records.size()), columns}, owner);
}

const PythonMesh& mesh_of(const py::object& self) {
  return self.cast<const PythonMesh&>();
}

py::array quads(const py::object& self) {
  const PythonMesh& mesh = mesh_of(self);
  return mesh.mesh.order == 2 ? table<int>(mesh.quads8, self) : table<int>(mesh.mesh.quads, self);
}

py::array face_ids(const py::object& self) {
  const std::vector<int>& faces = mesh_of(self).mesh.quad_faces;
  return view<int>(faces.data(), {static_cast<py::ssize_t>(faces.size())}, self);
}

template <class Scalar>
using Array = py::array_t<Scalar, py::array::c_style | py::array::forcecast>;
using Integers = Array<std::int64_t>;

Error wrong_shape(const char* name, const std::string& wanted) {
  return usage_error(name, fmt::format("{} must be an array of the shape {}", name, wanted));
}

/// The whole numbers of an array. Throws Error (usage) if it holds others.
Integers integers_of(const char* name, const py::array& given) {
  const char kind = given.dtype().kind();
  if (given.size() > 0 && kind != 'i' && kind != 'u')
    throw usage_error(name, fmt::format("{} must hold whole numbers", name));
  return Integers::ensure(given);
}

int narrowed(const char* name, std::size_t row, std::int64_t value) {
  if (!std::in_range<int>(value))
    throw usage_error(name, fmt::format("{}[{}] has the number {}, which is out of range", name, row, value));
  return static_cast<int>(value);
}

/// The rows of an (n, columns) array of integers; None gives no rows. Throws Error (usage) for other arrays.
/// \param bounded number of leading columns that hold node indices, from 0 to `below` - 1.
template <std::size_t columns>
std::vector<std::array<int, columns>> rows(const char* name, const py::object& given, std::size_t bounded,
                                           std::size_t below) {
  if (given.is_none()) return {};
  const py::array plain = py::array::ensure(given);
  if (!plain || (plain.size() > 0 && (plain.ndim() != 2 || plain.shape(1) != columns)))
    throw wrong_shape(name, fmt::format("(any, {})", columns));
  const Integers numbers = integers_of(name, plain);
  std::vector<std::array<int, columns>> result(plain.size() > 0 ? plain.shape(0) : 0);
  for (std::size_t i = 0; i < result.size(); ++i) {
    for (std::size_t k = 0; k < columns; ++k) {
      const std::int64_t value = numbers.at(i, k);
      if (k < bounded && (value < 0 || value >= static_cast<std::int64_t>(below)))
        throw usage_error(
            name, fmt::format("{}[{}] has the node {}, but there are {} points", name, i, value, below));
      result[i][k] = narrowed(name, i, value);
    }
  }
  return result;
}

std::vector<int> numbers_of(const char* name, const py::object& given, std::size_t count) {
  if (given.is_none()) return std::vector<int>(count, 0);
  const py::array plain = py::array::ensure(given);
  if (!plain || plain.ndim() != 1 || static_cast<std::size_t>(plain.size()) != count)
    throw wrong_shape(name, fmt::format("({},)", count));
  const Integers numbers = integers_of(name, plain);
  std::vector<int> result(count);
  for (std::size_t i = 0; i < count; ++i) {
    result[i] = narrowed(name, i, numbers.at(i));
    if (result[i] < 0)
      throw usage_error(name,
                        fmt::format("{}[{}] is {}: numbers of faces are not negative", name, i, result[i]));
  }
  return result;
}

std::vector<Vector3> points_of(const py::object& given) {
  const Array<double> array = Array<double>::ensure(given);
  if (!array || array.ndim() != 2 || array.shape(1) != 3) throw wrong_shape("points", "(any, 3)");
  std::vector<Vector3> points(array.shape(0));
  for (std::size_t i = 0; i < points.size(); ++i) {
    points[i] = {array.at(i, 0), array.at(i, 1), array.at(i, 2)};
    if (!points[i].allFinite()) throw usage_error("points", fmt::format("points[{}] is not finite", i));
  }
  return points;
}

void set_quads(const py::object& given, ShellMesh& mesh) {
  const py::array array = py::array::ensure(given);
  const bool second = array && array.ndim() == 2 && array.shape(1) == 8;
  if (!second) {
    mesh.quads = rows<4>("quads", given, 4, mesh.points.size());
    return;
  }
  mesh.order = 2;
  for (const auto& row : rows<8>("quads", given, 8, mesh.points.size())) {
    mesh.quads.push_back({row[0], row[1], row[2], row[3]});
    mesh.midsides.push_back({row[4], row[5], row[6], row[7]});
  }
}

PythonMesh mesh_of_arrays(const py::object& points, const py::object& quads, const py::object& triangles,
                          const py::object& face_ids, const py::object& triangle_face_ids,
                          const py::object& segments, const py::object& corners) {
  ShellMesh mesh;
  mesh.points = points_of(points);
  set_quads(quads, mesh);
  mesh.triangles = rows<3>("triangles", triangles, 3, mesh.points.size());
  mesh.quad_faces = numbers_of("face_ids", face_ids, mesh.quads.size());
  mesh.triangle_faces = numbers_of("triangle_face_ids", triangle_face_ids, mesh.triangles.size());
  for (const auto& row : rows<4>("segments", segments, 2, mesh.points.size())) {
    if (row[2] < -1 || row[2] >= static_cast<int>(mesh.points.size()))
      throw usage_error("segments", fmt::format("segments have the midside node {}, but there are {} points",
                                                row[2], mesh.points.size()));
    mesh.segments.push_back({{row[0], row[1]}, row[2], row[3]});
  }
  for (const auto& row : rows<2>("corners", corners, 1, mesh.points.size()))
    mesh.corners.push_back({row[0], row[1]});
  return PythonMesh(std::move(mesh));
}

py::array triangles(const py::object& self) {
  return table<int>(mesh_of(self).mesh.triangles, self);
}

py::array triangle_face_ids(const py::object& self) {
  const std::vector<int>& faces = mesh_of(self).mesh.triangle_faces;
  return view<int>(faces.data(), {static_cast<py::ssize_t>(faces.size())}, self);
}

/// A list of tuples (name, dimension, number, entities), one per group.
py::list list_of(const std::vector<ShellMesh::Group>& groups) {
  py::list result;
  for (const ShellMesh::Group& group : groups)
    result.append(py::make_tuple(group.name, group.dimension, group.number, group.entities));
  return result;
}

py::list groups_of(const py::object& self) {
  return list_of(mesh_of(self).mesh.groups);
}

std::vector<ShellMesh::Group> groups_in(const py::handle& list) {
  std::vector<ShellMesh::Group> result;
  for (const py::handle entry : list) {
    auto [name, dimension, number, entities] =
        entry.cast<std::tuple<std::string, int, int, std::vector<int>>>();
    result.push_back({std::move(name), dimension, number, std::move(entities)});
  }
  return result;
}

/// What pickle stores: the constructor's arguments, face statuses, thicknesses, groups, extra groups,
/// placed nodes, and the minimum size.
py::tuple state_of(const py::object& self) {
  py::list varying;
  for (const ShellMesh::VaryingThickness& entry : mesh_of(self).mesh.varying_thicknesses)
    varying.append(
        py::make_tuple(entry.face, entry.thinnest, entry.thickest, entry.nodes, entry.thicknesses));
  py::list placed;
  for (const ShellMesh::PlacedNode& node : mesh_of(self).mesh.placed_nodes)
    placed.append(py::make_tuple(node.name, node.vertex, node.added));
  py::list faces;
  for (const ShellMesh::Face& face : mesh_of(self).mesh.faces)
    faces.append(py::make_tuple(face.face, static_cast<int>(face.status), face.note, face.work, face.share,
                                face.attempts, face.quads, face.q_min, face.seconds, face.off_geometry,
                                face.off_geometry_max, face.filled_area));
  return py::make_tuple(self.attr("points"), self.attr("quads"), self.attr("triangles"),
                        self.attr("face_ids"), self.attr("triangle_face_ids"), self.attr("segments"),
                        self.attr("corners"), faces, mesh_of(self).mesh.thicknesses,
                        list_of(mesh_of(self).mesh.groups), varying, list_of(mesh_of(self).mesh.extra_groups),
                        placed, mesh_of(self).mesh.size_min);
}

PythonMesh from_state(const py::tuple& state) {
  PythonMesh result = mesh_of_arrays(state[0], state[1], state[2], state[3], state[4], state[5], state[6]);
  for (const py::handle entry : state[7]) {
    using Kept = std::tuple<int, int, std::string, std::int64_t, std::int64_t, int, int, double, double, int,
                            double, double>;
    const auto [number, status, note, work, share, attempts, quads, q_min, seconds, off, off_max, filled] =
        entry.cast<Kept>();
    result.mesh.faces.push_back({number, static_cast<FaceStatus>(status), note, work, share, attempts, quads,
                                 q_min, seconds, off, off_max, filled});
  }
  result.mesh.size_min = state[13].cast<double>();
  result.mesh.thicknesses = state[8].cast<std::vector<double>>();
  result.mesh.groups = groups_in(state[9]);
  result.mesh.extra_groups = groups_in(state[11]);
  for (const py::handle entry : state[12]) {
    auto [name, vertex, added] = entry.cast<std::tuple<std::string, int, bool>>();
    result.mesh.placed_nodes.push_back({std::move(name), vertex, added});
  }
  for (const py::handle entry : state[10]) {
    auto [face, thinnest, thickest, nodes, thicknesses] =
        entry.cast<std::tuple<int, double, double, std::vector<int>, std::vector<double>>>();
    result.mesh.varying_thicknesses.push_back(
        {face, thinnest, thickest, std::move(nodes), std::move(thicknesses)});
  }
  return result;
}

/// The HTML that notebooks show: a picture with the counts below it, or the counts alone if drawing fails.
std::string html_of(const py::object& self) {
  const std::string text = py::str(py::module_::import("html").attr("escape")(py::repr(self)));
  const py::object folder = py::module_::import("tempfile").attr("TemporaryDirectory")();
  const py::object path =
      py::module_::import("pathlib").attr("Path")(folder.attr("name")) / py::str("mesh.png");
  try {
    const std::string file = py::str(path);
    const py::gil_scoped_release release;
    write_picture(mesh_of(self).mesh, file, 800, 600);
  } catch (const Error&) {
    return "<p>" + text + "</p>";
  }
  const std::string data = py::str(
      py::module_::import("base64").attr("b64encode")(path.attr("read_bytes")()).attr("decode")("ascii"));
  return "<img width=\"800\" alt=\"" + text + "\" src=\"data:image/png;base64," + data + "\"><p>" + text +
         "</p>";
}

PythonMesh recombine_arrays(const py::object& points, const py::object& triangles, const py::object& tags,
                            bool improve, int threads) {
  TriangleMesh mesh;
  mesh.points = points_of(points);
  mesh.triangles = rows<3>("triangles", triangles, 3, mesh.points.size());
  if (mesh.triangles.empty()) throw usage_error("triangles", "there are no triangles");
  mesh.tags = numbers_of("tags", tags, mesh.triangles.size());
  const py::gil_scoped_release release;
  ExecutionContext context(threads);
  RecombineOptions options;
  options.method = improve ? Method::quality : Method::paper;
  QuadMesh quads = recombine(mesh, options, context);
  if (improve) {
    std::vector<int> renumbered(mesh.points.size());
    std::iota(renumbered.begin(), renumbered.end(), 0);
    quads = improve_on(mesh, quads, {}, renumbered, context);
  }
  ShellMesh result;
  result.points = std::move(quads.points);
  result.quads = std::move(quads.quads);
  result.triangles = std::move(quads.triangles);
  result.quad_faces = std::move(quads.quad_tags);
  result.triangle_faces = std::move(quads.triangle_tags);
  return PythonMesh(std::move(result));
}

py::object fidelity_of(const PythonMesh& mesh) {
  if (!mesh.fidelity) return py::none();
  const auto distance = [](const RemeshFidelity::Distance& d) {
    return py::dict(py::arg("distance") = d.length,
                    py::arg("at") = py::make_tuple(d.at.x(), d.at.y(), d.at.z()), py::arg("face") = d.face);
  };
  const RemeshFidelity& fidelity = *mesh.fidelity;
  return py::dict(py::arg("mesh_from_surface") = distance(fidelity.of_mesh),
                  py::arg("surface_from_mesh") = distance(fidelity.of_surface),
                  py::arg("surface_area") = fidelity.surface_area, py::arg("mesh_area") = fidelity.mesh_area);
}

PythonMesh recombined(const PythonMesh& mesh, double feature_angle, const std::optional<double>& merge,
                      bool improve, int threads) {
  if (!(feature_angle >= 0 && feature_angle <= 180))
    throw usage_error("feature_angle", "`feature_angle` must be from 0 to 180 degrees");
  if (merge && !(*merge >= 0)) throw usage_error("merge", "`merge` must not be negative");
  std::vector<std::string> notes;
  PythonMesh result = [&] {
    const py::gil_scoped_release release;
    ExecutionContext context(threads);
    FromTrianglesOptions options;
    options.feature_angle = feature_angle;
    options.merge = merge.value_or(-1);
    options.improve = improve;
    options.recombine.method = improve ? Method::quality : Method::paper;
    return PythonMesh(quads_from_triangles(mesh.mesh, options, notes, context));
  }();
  for (const std::string& note : notes) py::module_::import("warnings").attr("warn")(note);
  return result;
}

}  // namespace

std::string documented(const std::string& signature, const std::string& text) {
  return signature + "\n--\n\n" + text;
}

void bind_arrays(py::class_<PythonMesh>& mesh) {
  mesh.def(py::init(&mesh_of_arrays), py::arg("points"), py::arg("quads"), py::kw_only(),
           py::arg("triangles") = py::none(), py::arg("face_ids") = py::none(),
           py::arg("triangle_face_ids") = py::none(), py::arg("segments") = py::none(),
           py::arg("corners") = py::none(),
           documented(
               "__init__(self, points, quads, *, triangles=None, face_ids=None, triangle_face_ids=None, "
               "segments=None, corners=None)",
               "A mesh of arrays, as the properties of these names give them: points (n, 3) in mm, quads (m, "
               "4) or\n"
               "(m, 8), triangles (t, 3); nodes count from 0, CAD numbers from 1, 0 = none. The arrays are "
               "copied.\nRaises quadrille.Error (usage), which names the array and the row.")
               .c_str())
      .def_property_readonly(
          "points", [](const py::object& self) { return table<double>(mesh_of(self).mesh.points, self); },
          "(n, 3) float64: the nodes in mm, corner nodes first, then midside nodes.")
      .def_property_readonly("quads", &quads,
                             "(m, 4) or (m, 8) int32: corner nodes counter-clockwise, then midside nodes.")
      .def_property_readonly("face_ids", &face_ids, "(m,) int32: CAD face of each quad.")
      .def_property_readonly("triangles", &triangles,
                             "(t, 3) int32: triangles of meshes that were read or recombined; else empty.")
      .def_property_readonly("triangle_face_ids", &triangle_face_ids,
                             "(t,) int32: CAD face of each triangle.")
      .def_property_readonly(
          "segments", [](const py::object& self) { return table<int>(mesh_of(self).mesh.segments, self); },
          "(k, 4) int32: first node, second node, midside node or -1, CAD edge.")
      .def_property_readonly(
          "corners", [](const py::object& self) { return table<int>(mesh_of(self).mesh.corners, self); },
          "(c, 2) int32: node, CAD vertex.")
      .def_property_readonly("groups", &groups_of,
                             "Of a mesh that was read from a file with names: a list of (name, dimension, "
                             "number, entities): the\n"
                             "faces (dimension 2), edges (1) or vertices (0) that belong to it.")
      .def("recombined", &recombined, py::kw_only(), py::arg("feature_angle") = 40.0,
           py::arg("merge") = py::none(), py::arg("improve") = true, py::arg("threads") = 0,
           documented(
               "recombined(self, *, feature_angle=40.0, merge=None, improve=True, threads=0)",
               "A Mesh of quads instead of the triangles; quads are cut in two first. feature_angle: sides\n"
               "are kept from this angle between normals on, degrees, 0 = none; merge: nodes at most this\n"
               "far apart are merged, mm; improve: clean up and smooth the quads; threads: 0 = all cores.\n"
               "Groups, segments and corners are kept. Repairs and losses give a warning. Raises\n"
               "quadrille.Error.")
               .c_str())
      .def_property_readonly("fidelity", &fidelity_of,
                             "Of a mesh that remesh() made: a dict of mesh_from_surface and "
                             "surface_from_mesh (dicts of distance "
                             "in mm,\n"
                             "at, face), surface_area, mesh_area in mm2. "
                             "Else None;\nit is not pickled.")
      .def("_repr_html_", &html_of, documented("_repr_html_(self)", "The picture, for notebooks.").c_str())
      .def(py::pickle(&state_of, &from_state));
}

void bind_recombine(py::module_& module) {
  module.def(
      "recombine", &recombine_arrays, py::arg("points"), py::arg("triangles"), py::kw_only(),
      py::arg("tags") = py::none(), py::arg("improve") = true, py::arg("threads") = 0,
      documented(
          "recombine(points, triangles, *, tags=None, improve=True, threads=0)",
          "A Mesh of quads made of a triangulation: points (n, 3) in mm, triangles (m, 3) "
          "counter-clockwise,\n"
          "counted from 0, tags (m,): triangles of different tags are never joined, and face_ids of the mesh "
          "are\ntags. improve: clean up and smooth the quads on the triangulation, so that points move and "
          "are "
          "renumbered;\nwithout it points stay as they are. threads: 0 = all cores. An odd count leaves "
          "triangles. Raises\nquadrille.Error.")
          .c_str());
}

}  // namespace quadrille
