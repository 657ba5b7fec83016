/// The compiled half of the Python package: quadrille._quadrille, over the public header alone.

#include <pybind11/functional.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <exception>
#include <memory>
#include <optional>
#include <utility>

#include "mesher/quadrille.hpp"

namespace py = pybind11;

namespace quadrille {

namespace {

/// A mesh with the arrays that Python sees; never changed once made, so that arrays can point into it.
struct PythonMesh {
  ShellMesh mesh;
  std::vector<std::array<int, 8>> quads8;  ///< corners and midsides side by side, at second order

  explicit PythonMesh(ShellMesh made) : mesh(std::move(made)) {
    if (mesh.order != 2) return;
    quads8.resize(mesh.quads.size());
    for (std::size_t i = 0; i < mesh.quads.size(); ++i) {
      std::copy(mesh.quads[i].begin(), mesh.quads[i].end(), quads8[i].begin());
      std::copy(mesh.midsides[i].begin(), mesh.midsides[i].end(), quads8[i].begin() + 4);
    }
  }
};

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

/// \param limits a limits file; none = the usual limits.
py::object quality_dict(const PythonMesh& mesh, const std::optional<std::filesystem::path>& limits) {
  std::string text;
  {
    const py::gil_scoped_release release;
    text = quality_json(mesh.mesh, limits ? read_limits(*limits) : CriteriaLimits());
  }
  return py::module_::import("json").attr("loads")(text);
}

py::list face_statuses(const PythonMesh& mesh) {
  py::list result;
  for (const ShellMesh::FaceStatus& face : mesh.mesh.faces) {
    result.append(py::dict(
        py::arg("face") = face.face, py::arg("status") = face.status, py::arg("note") = face.note,
        py::arg("quads") = face.quads, py::arg("q_min") = face.q_min, py::arg("seconds") = face.seconds,
        py::arg("off_geometry") = face.off_geometry, py::arg("off_geometry_max") = face.off_geometry_max,
        py::arg("attempts") = face.attempts));
  }
  return result;
}

/// Calls a Python function from the mesher's threads; keeps the exception it raises, and Ctrl-C, for later.
class ProgressCall {
 public:
  explicit ProgressCall(py::object function) : function_(std::move(function)) {}

  bool operator()(std::string_view stage, double fraction) {
    const py::gil_scoped_acquire acquire;
    try {
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
      if (function_.is_none()) return true;
      const py::object answer = function_(py::str(stage.data(), stage.size()), fraction);
      return answer.is_none() || answer.cast<bool>();
    } catch (...) {
      raised_ = std::current_exception();
      return false;
    }
  }

  void rethrow() const {
    if (raised_) std::rethrow_exception(raised_);
  }

 private:
  py::object function_;
  std::exception_ptr raised_;
};

/// "Face3" as 3 and "Edge4" as 4, each into its own map.
void add_size(const std::string& name, double size, SizingOptions& sizing) {
  for (auto& [kind, sizes] : {std::pair<std::string_view, std::map<int, double>&>("Face", sizing.face_sizes),
                              {"Edge", sizing.edge_sizes},
                              {"Vertex", sizing.vertex_sizes}}) {
    if (name.compare(0, kind.size(), kind) != 0) continue;
    int number = 0;
    const char* end = name.data() + name.size();
    const auto parsed = std::from_chars(name.data() + kind.size(), end, number);
    if (parsed.ec == std::errc() && parsed.ptr == end && number > 0) {
      sizes[number] = size;
      return;
    }
  }
  throw usage_error("sizes", "sizes: " + name + " is not a name such as Face3, Edge4 or Vertex2");
}

int face_number(const py::handle& face) {
  if (py::isinstance<py::int_>(face)) return face.cast<int>();
  SizingOptions parsed;
  const auto name = face.cast<std::string>();
  add_size(name, 1, parsed);
  if (parsed.face_sizes.empty())
    throw usage_error("faces", "faces: " + name + " is not a name such as Face3");
  return parsed.face_sizes.begin()->first;
}

Strategy strategy_of(const std::string& name) {
  if (name == "direct") return Strategy::direct;
  if (name == "subdivide") return Strategy::subdivide;
  throw usage_error("strategy", "strategy must be 'direct' or 'subdivide', not '" + name + "'");
}

/// Calls `read` with the options for it; Ctrl-C ends it.
template <class Read>
CadModel read_model(bool isolated, Read read) {
  ProgressCall call{py::none()};
  ExecutionContext context(1, std::ref(call));
  try {
    const py::gil_scoped_release release;
    return read(ReadOptions{isolated, &context});
  } catch (const Error&) {
    call.rethrow();
    throw;
  }
}

PythonMesh mesh_model(const CadModel& model, std::optional<double> size,
                      std::optional<double> elements_per_diagonal, std::optional<double> size_min,
                      std::optional<double> elements_per_circle, std::optional<double> growth, int order,
                      const py::iterable& faces, const std::map<std::string, double>& sizes,
                      const std::filesystem::path& size_field, const std::optional<std::string>& strategy,
                      std::uint64_t seed, int threads, bool partial, bool force, const py::object& progress) {
  MeshOptions options;
  SizingOptions& sizing = options.sizing;
  if (size && !(*size > 0)) throw usage_error("size", "size must be a positive number");
  sizing.size = size.value_or(sizing.size);
  sizing.elements_per_diagonal = elements_per_diagonal.value_or(sizing.elements_per_diagonal);
  sizing.size_min = size_min.value_or(sizing.size_min);
  sizing.elements_per_circle = elements_per_circle.value_or(sizing.elements_per_circle);
  sizing.growth = growth.value_or(sizing.growth);
  sizing.size_field = size_field;
  for (const auto& [name, value] : sizes) add_size(name, value, sizing);
  for (const py::handle face : faces) options.faces.push_back(face_number(face));
  if (strategy) options.strategy = strategy_of(*strategy);
  options.order = order;
  options.recombine.seed = seed;
  options.partial = partial;
  options.force = force;

  ProgressCall call(progress);
  ExecutionContext context(threads, std::ref(call));
  try {
    const py::gil_scoped_release release;
    return PythonMesh(mesh(model, options, context));
  } catch (const Error&) {
    call.rethrow();
    throw;
  }
}

const char* kind_name(Error::Kind kind) {
  switch (kind) {
    case Error::Kind::usage:
      return "usage";
    case Error::Kind::cancelled:
      return "cancelled";
    case Error::Kind::failure:
      break;
  }
  return "failure";
}

/// quadrille::Error becomes the package's own quadrille.Error, written in Python.
void translate(std::exception_ptr pointer) {
  try {
    if (pointer) std::rethrow_exception(std::move(pointer));
  } catch (const Error& error) {
    const py::object type = py::module_::import("quadrille.errors").attr("Error");
    const py::object value = type(error.what(), kind_name(error.kind()), error.subject());
    PyErr_SetObject(type.ptr(), value.ptr());
  }
}

void bind_model(py::module_& module) {
  py::class_<CadModel>(module, "Model",
                       "A CAD model: faces, edges and vertices numbered from 1 as in FreeCAD.")
      .def_property_readonly("face_count", &CadModel::face_count)
      .def_property_readonly("edge_count", &CadModel::edge_count)
      .def_property_readonly("vertex_count", &CadModel::vertex_count)
      .def_property_readonly("solid_count", &CadModel::solid_count)
      .def_property_readonly("shell_count", &CadModel::shell_count)
      .def_property_readonly("diagonal", &CadModel::diagonal, "Length of the bounding box's diagonal, in mm.")
      .def_property_readonly(
          "area", [](const CadModel& model) { return model.area(); }, "Sum of the face areas, in mm^2.")
      .def_property_readonly("problems", &CadModel::problems,
                             "Problems noticed while reading, one sentence each.")
      .def_property_readonly(
          "box",
          [](const CadModel& model) {
            const Vector3 low = model.box_min(), high = model.box_max();
            return std::pair(std::array{low.x(), low.y(), low.z()}, std::array{high.x(), high.y(), high.z()});
          },
          "Lower and upper corner of the bounding box.")
      .def("__repr__", [](const CadModel& model) {
        return py::str("<quadrille.Model: {} faces, {} edges, {} vertices>")
            .format(model.face_count(), model.edge_count(), model.vertex_count());
      });
}

void bind_mesh(py::module_& module) {
  py::class_<PythonMesh>(
      module, "Mesh",
      "An all-quad mesh. Arrays are read-only views, node indices start at 0, CAD numbers at 1.")
      .def_property_readonly("order", [](const PythonMesh& self) { return self.mesh.order; })
      .def_property_readonly(
          "points", [](const py::object& self) { return table<double>(mesh_of(self).mesh.points, self); },
          "(n, 3) float64: the nodes, corner nodes first, then midside nodes.")
      .def_property_readonly("quads", &quads,
                             "(m, 4) or (m, 8) int32: corner nodes counter-clockwise, then midside nodes.")
      .def_property_readonly("face_ids", &face_ids, "(m,) int32: CAD face of each quad.")
      .def_property_readonly(
          "segments", [](const py::object& self) { return table<int>(mesh_of(self).mesh.segments, self); },
          "(k, 4) int32: first node, second node, midside node or -1, CAD edge.")
      .def_property_readonly(
          "corners", [](const py::object& self) { return table<int>(mesh_of(self).mesh.corners, self); },
          "(c, 2) int32: node, CAD vertex.")
      .def_property_readonly("faces", &face_statuses, "What became of each CAD face: a list of dicts.")
      .def("quality", &quality_dict, py::arg("limits") = py::none(),
           "Counts and measures: a dict, named as in the command's report, with the criteria of industry "
           "under "
           "'criteria'. limits: a limits file, JSON or HyperMesh's.")
      .def(
          "qualities",
          [](const PythonMesh& self) {
            const std::vector<double> values = quad_qualities(self.mesh);
            return py::array_t<double>(static_cast<py::ssize_t>(values.size()), values.data());
          },
          "(m,) float64: q of each quad.")
      .def(
          "write",
          [](const PythonMesh& self, const std::filesystem::path& path, double msh_version,
             const std::string& title) {
            write_mesh(self.mesh, path, {msh_version, title, 0});
          },
          py::arg("path"), py::kw_only(), py::arg("msh_version") = 2.2, py::arg("title") = "",
          py::call_guard<py::gil_scoped_release>(),
          "Writes the mesh; the format follows from the ending: .msh, .inp, .unv, .bdf, .med, .vtu, .vtk.")
      .def(
          "picture",
          [](const PythonMesh& self, const std::filesystem::path& path, int width, int height) {
            write_picture(self.mesh, path, width, height);
          },
          py::arg("path"), py::kw_only(), py::arg("width") = 1600, py::arg("height") = 1200,
          py::call_guard<py::gil_scoped_release>(), "Draws the mesh, coloured by q, into a PNG.")
      .def("__repr__", [](const PythonMesh& self) {
        return py::str("<quadrille.Mesh: {} quads of order {}, {} nodes>")
            .format(self.mesh.quads.size(), self.mesh.order, self.mesh.points.size());
      });
}

/// A face of a middle surface as the command's report names it.
py::dict face_dict(const MiddleFace& face) {
  py::dict result;
  result["area"] = face.area;
  result["thickness"] = face.thickness;
  result["thickness_min"] = face.thinnest;
  result["thickness_max"] = face.thickest;
  result["solid"] = face.solid;
  result["solid_faces"] = face.solid_faces;
  result["step"] = face.step;
  return result;
}

MidSurface midsurface_of(const CadModel& model, bool partial) {
  MidSurfaceOptions options;
  options.partial = partial;
  ExecutionContext context;
  return midsurface(model, options, context);
}

void bind_midsurface(py::module_& module) {
  py::class_<MidSurface>(module, "MidSurface", "The middle surface of thin solids, with its thickness.")
      .def_property_readonly(
          "model", [](const MidSurface& self) { return self.model; }, "A Model, to be meshed like any other.")
      .def_property_readonly(
          "faces",
          [](const MidSurface& self) {
            py::list result;
            for (const MiddleFace& face : self.faces) result.append(face_dict(face));
            return result;
          },
          "By face number minus 1: dicts of area, thickness (mean, _min and _max), solid, solid_faces and "
          "step.")
      .def_readonly("volume", &MidSurface::volume, "Of the solids, in mm^3.")
      .def_readonly("shell_volume", &MidSurface::shell_volume, "Sum of area times thickness, in mm^3.")
      .def_readonly("parts", &MidSurface::parts, "Connected parts.")
      .def_readonly("free_edges", &MidSurface::free_edges)
      .def_readonly("unpaired", &MidSurface::unpaired, "Solid faces that are neither side nor rim of a wall.")
      .def_readonly("problems", &MidSurface::problems, "With partial: what would have been an error.")
      .def("write", &write_midsurface, py::arg("path"), py::call_guard<py::gil_scoped_release>(),
           "Writes the faces as .brep or .step, or what is known of them as .json.");
  module.def(
      "midsurface", &midsurface_of, py::arg("model"), py::kw_only(), py::arg("partial") = false,
      py::call_guard<py::gil_scoped_release>(),
      "The middle surface of each solid of a model. partial: give what could be paired where a solid is "
      "thin in\nplaces only, instead of raising quadrille.Error.");
}

void bind_functions(py::module_& module) {
  module.def(
      "read",
      [](const std::filesystem::path& path, bool isolated) {
        return read_model(isolated,
                          [&](const ReadOptions& options) { return CadModel::read(path, options); });
      },
      py::arg("path"), py::kw_only(), py::arg("isolated") = true,
      "Reads a STEP, IGES or BREP file. isolated: in a child process, so that a file that crashes "
      "OpenCASCADE\n"
      "raises quadrille.Error rather than ending the interpreter.");
  module.def(
      "read_brep",
      [](const std::string& text, const std::string& name, bool isolated) {
        return read_model(
            isolated, [&](const ReadOptions& options) { return CadModel::from_brep(text, name, options); });
      },
      py::arg("text"), py::arg("name") = "shape", py::kw_only(), py::arg("isolated") = true,
      "Parses a shape in OpenCASCADE's BREP text format. isolated: as for read().");
  module.def("suggested_size", &suggested_size, py::arg("model"), py::arg("quads") = 5000,
             "A size that gives about this many quads.");
  module.def("mesh", &mesh_model, py::arg("model"), py::kw_only(), py::arg("size") = py::none(),
             py::arg("elements_per_diagonal") = py::none(), py::arg("size_min") = py::none(),
             py::arg("elements_per_circle") = py::none(), py::arg("growth") = py::none(),
             py::arg("order") = 1, py::arg("faces") = py::tuple(), py::arg("sizes") = py::dict(),
             py::arg("size_field") = "", py::arg("strategy") = py::none(), py::arg("seed") = 1,
             py::arg("threads") = 0, py::arg("partial") = false, py::arg("force") = false,
             py::arg("progress") = py::none(),
             R"(Meshes a model's faces with quads only.

size: target edge length in mm (default: diagonal / elements_per_diagonal, which is 60)
size_min: no size goes below this (default: size / 8)
elements_per_circle: elements per 2 pi of curvature (default 12; 0 = off)
growth: largest growth of the size per length (default 0.3)
order: 1 or 2
faces: faces to mesh, as 3 or "Face3" (default: all)
sizes: sizes on CAD entities, {"Face3": 0.5, "Edge4": 1, "Vertex2": 0.1}
size_field: OpenVDB grid (.vdb) that caps the size
strategy: "direct" or "subdivide"
progress: called with (stage, fraction); returning False cancels, what it raises is raised here
Raises quadrille.Error.)");
}

}  // namespace

}  // namespace quadrille

PYBIND11_MODULE(_quadrille, module) {
  module.doc() = "The compiled half of the package quadrille.";
  module.attr("__version__") = quadrille::version();
  py::register_exception_translator(&quadrille::translate);
  quadrille::bind_model(module);
  quadrille::bind_mesh(module);
  quadrille::bind_midsurface(module);
  quadrille::bind_functions(module);
}
