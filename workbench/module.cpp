/// The compiled half of the Python package: quadrille._quadrille. Uses public headers alone.

#include <pybind11/functional.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <array>
#include <exception>
#include <memory>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "mesher/quadrille.hpp"
#include "mesher/settings.hpp"
#include "workbench/python_mesh.hpp"

namespace py = pybind11;

namespace quadrille {

namespace {

/// \param limits path of a limits file; without one, the usual limits hold.
py::object quality_dict(const PythonMesh& mesh, const std::optional<std::filesystem::path>& limits) {
  std::string text;
  {
    const py::gil_scoped_release release;
    text = quality_json(mesh.mesh, limits ? read_limits(*limits) : limits_of(mesh.mesh));
  }
  return py::module_::import("json").attr("loads")(text);
}

py::list face_statuses(const PythonMesh& mesh) {
  py::list result;
  for (const ShellMesh::Face& face : mesh.mesh.faces) {
    result.append(
        py::dict(py::arg("face") = face.face, py::arg("status") = name_of(face.status),
                 py::arg("note") = face.note, py::arg("quads") = face.quads, py::arg("q_min") = face.q_min,
                 py::arg("seconds") = face.seconds, py::arg("off_geometry") = face.off_geometry,
                 py::arg("off_geometry_max") = face.off_geometry_max, py::arg("attempts") = face.attempts));
  }
  return result;
}

/// Calls a Python function from the mesher's threads. An exception from the function, or from Ctrl-C, cancels
/// the work and is stored; rethrow() raises it later.
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

Error wrong_type(const Setting& setting, const py::handle& value) {
  return usage_error(std::string(setting.name),
                     fmt::format("`{}` takes a value of the kind {}, not {}", setting.name, setting.kind(),
                                 py::repr(value).cast<std::string>()));
}

double number(const Setting& setting, const py::handle& value) {
  const double result = PyBool_Check(value.ptr()) ? -1 : PyFloat_AsDouble(value.ptr());
  if (!PyErr_Occurred() && !PyBool_Check(value.ptr())) return result;
  PyErr_Clear();
  throw wrong_type(setting, value);
}

/// The name of a face that is given as 3 or "Face3": "Face3".
std::string face_name(const Setting& setting, const py::handle& face) {
  if (PyBool_Check(face.ptr())) throw wrong_type(setting, face);
  if (PyIndex_Check(face.ptr()))
    return fmt::format("Face{}", py::int_(py::reinterpret_borrow<py::object>(face)).cast<long>());
  if (!py::isinstance<py::str>(face)) throw wrong_type(setting, face);
  return face.cast<std::string>();
}

/// Entries as texts. They are given as texts, or as a dict that maps names to one or more numbers:
/// {"Edge4": 20}, {"Edge4": (0.1, 1.2, 6)}. Those of numbers alone may be tuples in a list, [(1, 2, 3)].
std::vector<std::string> entries(const Setting& setting, const py::handle& value) {
  if (py::isinstance<py::str>(value) || !py::isinstance<py::iterable>(value))
    throw wrong_type(setting, value);
  std::vector<std::string> texts;
  const auto numbers = [&](const py::handle& own) {
    if (py::isinstance<py::str>(own)) return own.cast<std::string>();
    std::vector<double> found;
    if (py::isinstance<py::iterable>(own)) {
      for (const py::handle part : own.cast<py::iterable>()) found.push_back(number(setting, part));
    } else {
      found.push_back(number(setting, own));
    }
    return fmt::format("{}", fmt::join(found, ","));
  };
  if (py::isinstance<py::dict>(value)) {
    for (const auto& [name, own] : value.cast<py::dict>())
      texts.push_back(fmt::format("{}={}", name.cast<std::string>(), numbers(own)));
    return texts;
  }
  for (const py::handle entry : value.cast<py::iterable>()) texts.push_back(numbers(entry));
  return texts;
}

/// Converts a Python value for a setting. Throws Error (usage) if it is of another kind.
SettingValue setting_value(const Setting& setting, const py::handle& value) {
  const std::string_view kind = setting.kind();
  if (kind == "number" || kind == "count") return number(setting, value);
  try {
    if (kind == "flag") {
      if (!PyBool_Check(value.ptr())) throw wrong_type(setting, value);
      return value.cast<bool>();
    }
    if (kind == "choice" || kind == "text") return value.cast<std::string>();
    if (kind == "file") return value.cast<std::filesystem::path>().string();
    if (kind == "names" || kind == "words") {
      if (py::isinstance<py::str>(value) || !py::isinstance<py::iterable>(value))
        throw wrong_type(setting, value);
      if (kind == "words") return value.cast<std::vector<std::string>>();
      std::vector<std::string> names;
      for (const py::handle face : value.cast<py::iterable>()) names.push_back(face_name(setting, face));
      return names;
    }
    if (kind == "entries") return entries(setting, value);
    if (!py::isinstance<py::dict>(value)) throw wrong_type(setting, value);
    std::map<std::string, double> sizes;
    for (const auto& [name, size] : value.cast<py::dict>())
      sizes[name.cast<std::string>()] = number(setting, size);
    return sizes;
  } catch (const py::cast_error&) {
    throw wrong_type(setting, value);
  }
}

/// The settings that keyword arguments give; None leaves a setting at its default. Throws TypeError for
/// unknown names.
Settings settings_of(const py::kwargs& arguments, Setting::Use use, const char* function) {
  Settings settings;
  for (const auto& [key, value] : arguments) {
    const Setting* setting = find_setting(key.cast<std::string>());
    if (setting == nullptr || setting->use != use) {
      throw py::type_error(
          fmt::format("{}() got an unexpected keyword argument '{}'", function, key.cast<std::string>()));
    }
    if (!value.is_none()) assign(settings, *setting, setting_value(*setting, value));
  }
  return settings;
}

/// Help for a function's settings, one line each.
std::string settings_help(Setting::Use use) {
  std::string text;
  for (const Setting& setting : all_settings()) {
    if (setting.use != use) continue;
    text += fmt::format("{}: {}", setting.name, setting.help);
    if (!setting.unit.empty()) text += fmt::format(", in {}", setting.unit);
    if (!setting.otherwise.empty()) text += fmt::format(" (default: {})", setting.otherwise);
    text += "\n";
  }
  return text;
}

/// The settings of a function as text for its signature: ", size=None, order=None".
std::string settings_signature(Setting::Use use) {
  std::string text;
  for (const Setting& setting : all_settings())
    if (setting.use == use) text += fmt::format(", {}=None", setting.name);
  return text;
}

/// Does work, given its context, without holding Python's lock. Ctrl-C and `progress` can interrupt it.
template <class Work>
auto interruptible(int threads, const py::object& progress, Work work) {
  ProgressCall call(progress);
  ExecutionContext context(threads, std::ref(call));
  try {
    const py::gil_scoped_release release;
    return work(context);
  } catch (const Error&) {
    call.rethrow();
    throw;
  }
}

/// Calls `read` with its options, and imprints and sews the model if the settings ask for it.
template <class Read>
CadModel read_model(bool isolated, const Settings& settings, Read read) {
  return interruptible(1, py::none(), [&](ExecutionContext& context) {
    context.expect({Stage::read});
    return joined(settings, read(ReadOptions{isolated, &context, settings.read_time_limit}));
  });
}

/// \param Model CadModel or MidSurface.
template <class Model>
PythonMesh mesh_model(const Model& model, const py::object& progress, const py::kwargs& arguments) {
  const Settings settings = settings_of(arguments, Setting::Use::mesh, "mesh");
  return interruptible(settings.threads, progress, [&](ExecutionContext& context) {
    if (settings.time_limit > 0) context.limit_time(settings.time_limit);
    return PythonMesh(mesh(model, settings.mesh, context));
  });
}

PythonMesh remesh_surface(const PythonMesh& surface, double size, double feature_angle,
                          const std::optional<double>& merge, int order, const py::object& progress,
                          const py::kwargs& arguments) {
  if (merge && !(*merge >= 0)) throw usage_error("merge", "`merge` must not be negative");
  for (const auto& [key, value] : arguments) {
    const std::string name = key.cast<std::string>();
    if (name != "force" && name != "time_limit" && name != "threads")
      throw py::type_error(fmt::format("remesh() got an unexpected keyword argument '{}'", name));
  }
  const Settings settings = settings_of(arguments, Setting::Use::mesh, "remesh");
  RemeshOptions options;
  options.size = size;
  options.feature_angle = feature_angle;
  options.merge = merge.value_or(-1);
  options.order = order;
  options.force = settings.mesh.force;
  std::vector<std::string> notes;
  RemeshFidelity fidelity;
  PythonMesh result = interruptible(settings.threads, progress, [&](ExecutionContext& context) {
    context.expect({Stage::sample, Stage::triangulate, Stage::mesh, Stage::assemble});
    if (settings.time_limit > 0) context.limit_time(settings.time_limit);
    return PythonMesh(remesh(surface.mesh, options, &fidelity, notes, context));
  });
  result.fidelity = fidelity;
  for (const std::string& note : notes) py::module_::import("warnings").attr("warn")(note);
  return result;
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

/// Turns quadrille::Error into the package's own exception quadrille.Error, which is written in Python.
void translate(std::exception_ptr pointer) {
  try {
    if (pointer) std::rethrow_exception(std::move(pointer));
  } catch (const Error& error) {
    const py::object type = py::module_::import("quadrille.core.errors").attr("Error");
    std::string sentence = error.what();
    for (std::size_t start = 0; (start = sentence.find('`', start)) != std::string::npos;) {
      const std::size_t end = sentence.find('`', start + 1);
      if (end == std::string::npos) break;
      const std::string name = sentence.substr(start + 1, end - start - 1);
      const bool own = !option_of(name).empty();
      if (own) sentence.replace(start, end + 1 - start, name);  // Python's own names need no quotes
      start = own ? start + name.size() : end;
    }
    const py::object value = type(sentence, kind_name(error.kind()), error.subject());
    PyErr_SetObject(type.ptr(), value.ptr());
  }
}

void bind_model(py::module_& module) {
  py::class_<CadModel>(module, "Model",
                       "A CAD model: faces, edges and vertices numbered from 1 as in FreeCAD.")
      .def_property_readonly("face_count", &CadModel::face_count, "Faces, numbered from 1.")
      .def_property_readonly("edge_count", &CadModel::edge_count, "Edges, numbered from 1.")
      .def_property_readonly("vertex_count", &CadModel::vertex_count, "Vertices, numbered from 1.")
      .def_property_readonly("solid_count", &CadModel::solid_count, "Solids.")
      .def_property_readonly("shell_count", &CadModel::shell_count, "Shells, those of solids among them.")
      .def_property_readonly("diagonal", &CadModel::diagonal, "Length of the bounding box's diagonal, in mm.")
      .def_property_readonly(
          "area", [](const CadModel& model) { return model.area(); }, "Sum of the face areas, in mm^2.")
      .def_property_readonly("problems", &CadModel::problems,
                             "Problems noticed while reading, one sentence each.")
      .def_property_readonly("face_names", &CadModel::face_names,
                             "Names in a STEP file, and the numbers of the faces that have each.")
      .def_property_readonly("pieces", &CadModel::pieces,
                             "After read(imprint=True): for each face of the file, the numbers of the faces "
                             "that it became.")
      .def_property_readonly(
          "box",
          [](const CadModel& model) {
            const Vector3 low = model.box_min(), high = model.box_max();
            return std::pair(std::array{low.x(), low.y(), low.z()}, std::array{high.x(), high.y(), high.z()});
          },
          "Lower and upper corner of the bounding box: two lists of three numbers, mm.")
      .def("__repr__", [](const CadModel& model) {
        return py::str("<quadrille.Model: {} faces, {} edges, {} vertices>")
            .format(model.face_count(), model.edge_count(), model.vertex_count());
      });
}

void bind_mesh(py::module_& module) {
  py::class_<PythonMesh> mesh(
      module, "Mesh",
      "An all-quad mesh. Arrays are read-only views, node indices start at 0, CAD numbers at 1.");
  bind_arrays(mesh);
  mesh.def_property_readonly(
          "order", [](const PythonMesh& self) { return self.mesh.order; },
          "1: quads of four nodes, 2: of eight.")
      .def_property_readonly("faces", &face_statuses, "What became of each CAD face: a list of dicts.")
      .def("quality", &quality_dict, py::arg("limits") = py::none(),
           documented("quality(self, limits=None)",
                      "Counts and measures: a dict, named as in the command's report, with the industry "
                      "criteria under\n'criteria'. limits: a limits file, JSON or HyperMesh's.")
               .c_str())
      .def(
          "qualities",
          [](const PythonMesh& self) {
            const std::vector<double> values = quad_qualities(self.mesh);
            return py::array_t<double>(static_cast<py::ssize_t>(values.size()), values.data());
          },
          documented("qualities(self)", "(m,) float64: q of each quad, 0 to 1.").c_str())
      .def(
          "write",
          [](const PythonMesh& self, const std::filesystem::path& path, const std::string& title,
             const py::kwargs& arguments) {
            WriteOptions options = settings_of(arguments, Setting::Use::write, "write").write;
            options.title = title;
            const py::gil_scoped_release release;
            write_mesh(self.mesh, path, options);
          },
          py::arg("path"), py::kw_only(), py::arg("title") = "",
          documented("write(self, path, *, title=''" + settings_signature(Setting::Use::write) + ")",
                     "Writes the mesh, lengths in mm times `scale`; the format follows from the ending: " +
                         written_endings("or") + ".\n\n" + settings_help(Setting::Use::write))
              .c_str())
      .def(
          "picture",
          [](const PythonMesh& self, const std::filesystem::path& path, int width, int height) {
            write_picture(self.mesh, path, width, height);
          },
          py::arg("path"), py::kw_only(), py::arg("width") = 1600, py::arg("height") = 1200,
          py::call_guard<py::gil_scoped_release>(),
          documented("picture(self, path, *, width=1600, height=1200)",
                     "Draws the mesh, colored by q, into a PNG of so many pixels.")
              .c_str())
      .def("__repr__", [](const PythonMesh& self) {
        return py::str("<quadrille.Mesh: {} quads of order {}, {} nodes>")
            .format(self.mesh.quads.size(), self.mesh.order, self.mesh.points.size());
      });
}

/// A middle face as a dict, with the keys that the command's report uses.
py::dict face_dict(const MiddleFace& face) {
  py::dict result;
  result["area"] = face.area;
  result["thickness"] = face.thickness;
  result["thickness_min"] = face.thinnest;
  result["thickness_max"] = face.thickest;
  result["solid"] = face.solid;
  result["solid_faces"] = face.solid_faces;
  result["step"] = face.step;
  result["fitted"] = face.fitted;
  result["off"] = face.off;
  return result;
}

MidSurface midsurface_of(const CadModel& model, bool partial, bool join) {
  MidSurfaceOptions options;
  options.partial = partial;
  options.join = join;
  return interruptible(0, py::none(),
                       [&](ExecutionContext& context) { return midsurface(model, options, context); });
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
          "By face number minus 1: dicts of area in mm^2, thickness (mean, _min and _max) in mm, solid, "
          "solid_faces,\nstep, fitted (there is no exact middle) and off, its largest error in mm.")
      .def_property_readonly(
          "rims",
          [](const MidSurface& self) {
            py::list result;
            for (const MiddleRim& rim : self.rims) result.append(py::make_tuple(rim.edge, rim.solid_faces));
            return result;
          },
          "The free edges: (edge number, solid faces that it lies on).")
      .def_readonly("volume", &MidSurface::volume, "Of the solids, in mm^3.")
      .def_readonly("shell_volume", &MidSurface::shell_volume,
                    "Sum of area times thickness over all faces, in mm^3.")
      .def_readonly("parts", &MidSurface::parts, "Connected parts.")
      .def_readonly("free_edges", &MidSurface::free_edges, "Edges of one face only.")
      .def_readonly("unpaired", &MidSurface::unpaired, "Solid faces that are neither side nor rim of a wall.")
      .def_readonly(
          "counted_twice", &MidSurface::counted_twice,
          "Volume that shell_volume counts twice where walls meet, in fillets and at steps, in mm^3.")
      .def_readonly("warnings", &MidSurface::warnings, "Inaccuracies that are not errors.")
      .def_readonly("problems", &MidSurface::problems, "With partial: what would have been an error.")
      .def("write", &write_midsurface, py::arg("path"), py::call_guard<py::gil_scoped_release>(),
           documented("write(self, path)",
                      "Writes the faces as .brep or .step, or what is known of them as "
                      ".json.")
               .c_str());
  module.def(
      "midsurface", &midsurface_of, py::arg("model"), py::kw_only(), py::arg("partial") = false,
      py::arg("join") = false,
      documented(
          "midsurface(model, *, partial=False, join=False)",
          "The MidSurface of the solids of a model. partial: give what could be paired where a solid is "
          "thin in\nplaces only, instead of raising quadrille.Error. join: treat solids that touch as one "
          "part, as if welded.")
          .c_str());
}

void bind_functions(py::module_& module) {
  const std::string isolated_help =
      "isolated: in a child process, so that a file that crashes OpenCASCADE raises quadrille.Error rather "
      "than "
      "ending\nthe interpreter, and one that takes too long is given up\n" +
      settings_help(Setting::Use::read);
  module.def(
      "read",
      [](const std::filesystem::path& path, bool isolated, const py::kwargs& arguments) {
        return read_model(isolated, settings_of(arguments, Setting::Use::read, "read"),
                          [&](const ReadOptions& options) { return CadModel::read(path, options); });
      },
      py::arg("path"), py::kw_only(), py::arg("isolated") = true,
      documented("read(path, *, isolated=True" + settings_signature(Setting::Use::read) + ")",
                 "Reads a STEP, IGES or BREP file: a Model, lengths in mm.\n\n" + isolated_help)
          .c_str());
  module.def(
      "read_brep",
      [](const std::string& text, const std::string& name, bool isolated, const py::kwargs& arguments) {
        return read_model(
            isolated, settings_of(arguments, Setting::Use::read, "read_brep"),
            [&](const ReadOptions& options) { return CadModel::from_brep(text, name, options); });
      },
      py::arg("text"), py::arg("name") = "shape", py::kw_only(), py::arg("isolated") = true,
      documented(
          "read_brep(text, name='shape', *, isolated=True" + settings_signature(Setting::Use::read) + ")",
          "Parses a shape in OpenCASCADE's BREP text format: a Model.\n\n" + isolated_help)
          .c_str());
  module.def(
      "read_mesh",
      [](const std::filesystem::path& path) {
        const py::gil_scoped_release release;
        return PythonMesh(read_mesh(path));
      },
      py::arg("path"),
      documented("read_mesh(path)",
                 "Reads a surface mesh: " + read_endings("or") + ". Raises quadrille.Error.")
          .c_str());
  bind_recombine(module);
  module.def(
      "remesh", &remesh_surface, py::arg("surface"), py::kw_only(), py::arg("size"),
      py::arg("feature_angle") = 40.0, py::arg("merge") = py::none(), py::arg("order") = 1,
      py::arg("progress") = py::none(),
      documented(
          "remesh(surface, *, size, feature_angle=40.0, merge=None, order=1, progress=None, force=None, "
          "time_limit=None, threads=None)",
          "Remeshes a triangulated surface, a Mesh such as read_mesh() returns, with quads only.\n\n"
          "size: length of elements, mm; feature_angle: neighbors belong to two faces from this angle\n"
          "between normals on, degrees, 0 = no faces by shape; merge: nodes at most this far apart are\n"
          "merged, mm; order: 1 or 2; force, time_limit, threads, progress: as for mesh(). Groups of faces\n"
          "and edges are kept; the distances from the surface are in fidelity. Repairs and losses give a\n"
          "warning. Raises quadrille.Error.")
          .c_str());
  module.def(
      "suggested_size",
      [](const CadModel& model, int quads) {
        return interruptible(0, py::none(), [&](ExecutionContext& context) {
          return QuadEstimate(model, context).size_for(quads).size;
        });
      },
      py::arg("model"), py::arg("quads") = 5000,
      documented("suggested_size(model, quads=5000)", "A size, in mm, that gives about this many quads.")
          .c_str());
  module.def(
      "settings", [] { return py::module_::import("json").attr("loads")(settings_table().dump()); },
      documented("settings()",
                 "The table of settings: a list of dicts, as `quadrille settings --json` gives it.")
          .c_str());
  module.def("mesh", &mesh_model<MidSurface>, py::arg("model"), py::kw_only(),
             py::arg("progress") = py::none());
  module.def(
      "mesh", &mesh_model<CadModel>, py::arg("model"), py::kw_only(), py::arg("progress") = py::none(),
      documented(
          "mesh(model, *, progress=None" + settings_signature(Setting::Use::mesh) + ")",
          "A Mesh of quads only on the faces of a Model, or of a MidSurface: it then knows the "
          "thickness of each face.\n\n" +
              settings_help(Setting::Use::mesh) +
              "progress: called with the stage's name and the fraction of all the work done; returning False "
              "cancels, "
              "what it\nraises is raised here\nRaises quadrille.Error.")
          .c_str());
}

}  // namespace

}  // namespace quadrille

PYBIND11_MODULE(_quadrille, module) {
  py::options options;
  options.disable_function_signatures();  // docstrings have their own
  module.doc() = "The compiled half of the package quadrille.";
  module.attr("__version__") = quadrille::version();
  py::register_exception_translator(&quadrille::translate);
  quadrille::bind_model(module);
  quadrille::bind_mesh(module);
  quadrille::bind_midsurface(module);
  quadrille::bind_functions(module);
}
