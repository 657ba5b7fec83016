/// Reading CAD files through OpenCASCADE.

#include "geometry/cad/cad_model.hpp"

#include <BRepGProp.hxx>
#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <GProp_GProps.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <Message_PrinterOStream.hxx>
#include <Standard_Failure.hxx>
#include <algorithm>
#include <boost/interprocess/streams/bufferstream.hpp>
#include <fstream>
#include <istream>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "geometry/base/error.hpp"
#include "geometry/base/file_access.hpp"
#include "geometry/base/module_loader.hpp"
#include "geometry/cad/cad_shape.hpp"
#include "geometry/cad/imprinting.hpp"
#include "geometry/cad/isolated_reading.hpp"
#include "geometry/cad/readers/exchange_module.hpp"
#include "geometry/cad/sewing.hpp"

namespace quadrille {

namespace {

/// Without this, OpenCASCADE prints its transfer log to standard output.
void silence_opencascade() {
  Message::DefaultMessenger()->RemovePrinters(STANDARD_TYPE(Message_PrinterOStream));
}

/// \param prefix of the module that reads the format.
NamedShape read_exchange(const std::filesystem::path& path, const std::string& prefix) {
  const Module module(prefix);
  NamedShape read;
  const std::string problem = module.function<ExchangeReadFunction>("_read")(path.string(), read);
  if (!problem.empty()) throw failure(path.string(), problem);
  return {read.shape, names_of_groups(read.names)};
}

/// Whether the stream begins as a BREP file does. OpenCASCADE would print to standard output if it did not.
bool begins_as_brep(std::istream& stream) {
  std::string line;
  for (int i = 0; i < 5 && std::getline(stream, line); ++i) {
    if (line.find("CASCADE Topology V") != std::string::npos) {
      stream.clear();
      stream.seekg(0);
      return true;
    }
  }
  return false;
}

TopoDS_Shape read_brep(std::istream& stream, const std::string& name) {
  if (!begins_as_brep(stream)) throw failure(name, fmt::format("{} is not a readable BREP file", name));
  TopoDS_Shape shape;
  const BRep_Builder builder;
  // OpenCASCADE's reader loops forever when the text ends too early.
  stream.exceptions(std::ios::failbit | std::ios::badbit);
  try {
    BRepTools::Read(shape, stream, builder);
  } catch (const std::ios_base::failure&) {
    throw failure(name, fmt::format("{} is not a readable BREP file: it is cut off or damaged", name));
  }
  if (shape.IsNull()) throw failure(name, fmt::format("{} is not a readable BREP file", name));
  return shape;
}

/// Millimeters, about a light hour. The costs of elements are kept in single precision.
constexpr double largest_diagonal = 1e15;

CadModel build(const NamedShape& read, const std::string& name) {
  if (read.shape.IsNull()) throw failure(name, fmt::format("{} holds no shape", name));
  auto result = std::make_shared<CadShape>(read.shape, name);
  result->face_names = read.names;
  if (result->faces.empty()) throw failure(name, fmt::format("{} has no face to mesh", name));
  if (!(result->diagonal() > 0) || !(result->diagonal() < largest_diagonal)) {
    throw failure(name,
                  fmt::format("{} holds a shape of zero or infinite size: the file may be damaged", name));
  }
  return CadModel(std::move(result));
}

/// Reads and builds the model, in a child process if asked for. OpenCASCADE's exceptions become an Error.
template <class Read>
CadModel guarded(const std::string& name, const ReadOptions& options, Read read) {
  silence_opencascade();
  try {
    if (!options.isolated) return build(read(), name);
    const auto read_and_check = [&] {
      NamedShape made = read();
      build(made, name);
      return made;
    };
    return build(read_isolated(name, read_and_check, options.context, options.time_limit), name);
  } catch (const Standard_Failure& problem) {
    throw failure(name, fmt::format("{} could not be read as CAD ({})", name, problem.GetMessageString()));
  }
}

/// The first sentences of a list, and how many more there are.
std::string first_few(const std::vector<std::string>& all) {
  constexpr std::size_t max_shown = 8;
  const std::size_t shown = std::min(all.size(), max_shown);
  std::string text =
      fmt::format("{}", fmt::join(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(shown), "; "));
  if (all.size() > shown) text += fmt::format("; and {} more", all.size() - shown);
  return text;
}

/// Stores what each face became by imprinting, and reports the changes.
void keep_pieces(CadShape& shape, std::vector<std::vector<int>> pieces) {
  const std::vector<std::string> changes = changes_of_faces(pieces);
  if (!changes.empty())
    shape.problems.push_back(fmt::format("imprinting changed {} of {} faces: {}", changes.size(),
                                         pieces.size(), first_few(changes)));
  shape.face_pieces = std::move(pieces);
}

/// Reports which faces were reversed, and where normals cannot agree.
void tell(const Orientation& orientation, std::vector<std::string>& problems) {
  const auto names = [](const char* kind, const std::vector<int>& numbers) {
    std::vector<std::string> all;
    all.reserve(numbers.size());
    for (const int number : numbers) all.push_back(fmt::format("{}{}", kind, number));
    return first_few(all);
  };
  const auto& [turned, unlike] = orientation;
  if (!turned.empty())
    problems.push_back(fmt::format("{} faces were reversed so that joined faces are oriented alike: {}",
                                   turned.size(), names("Face", turned)));
  if (!unlike.empty())
    problems.push_back(
        fmt::format("normals cannot agree across {} edges, where three or more faces meet or the surface is "
                    "one-sided: {}",
                    unlike.size(), names("Edge", unlike)));
}

}  // namespace

CadModel CadModel::read(const std::filesystem::path& path, const ReadOptions& options) {
  const std::string name = path.string();
  require_readable(path);
  const std::string extension = lower_ending(path);
  if (extension == ".step" || extension == ".stp")
    return guarded(name, options, [&] { return read_exchange(path, "quadrille_step"); });
  if (extension == ".iges" || extension == ".igs")
    return guarded(name, options, [&] { return read_exchange(path, "quadrille_iges"); });
  if (extension == ".brep" || extension == ".brp")
    return guarded(name, options, [&] {
      std::ifstream stream(path, std::ios::binary);
      return read_brep(stream, name);
    });
  throw usage_error(name,
                    fmt::format("{} has an unknown ending: STEP (.step, .stp), IGES (.iges, .igs) and BREP "
                                "(.brep, .brp) can be read",
                                name));
}

CadModel CadModel::from_brep(std::string_view text, const std::string& name, const ReadOptions& options) {
  return guarded(name, options, [&] {
    boost::interprocess::ibufferstream stream(text.data(), text.size());
    return read_brep(stream, name);
  });
}

CadModel CadModel::sewn(double tolerance) const {
  const std::string& name = shape_->name;
  if (!(tolerance > 0) || !(tolerance < diagonal())) {
    throw usage_error(
        "sew", fmt::format("`sew` must be positive and smaller than the model, whose diagonal is {:.6g}, "
                           "not {:.6g}",
                           diagonal(), tolerance));
  }
  try {
    const Sewn made = sew(shape_->shape, tolerance);
    if (!made.coincident.empty()) {
      const auto [first, second] = made.coincident.front();
      const char* remedy = shape_->face_pieces.empty()
                               ? "use `imprint` to join parts that touch; sewing joins edges only"
                               : "they are within the tolerance of `sew` after `imprint`; try a smaller one";
      throw failure(name, fmt::format("Face{} and Face{} coincide, {} such pair(s) in all: {}", first, second,
                                      made.coincident.size(), remedy));
    }
    auto result = std::make_shared<CadShape>(made.shape, name);
    if (result->faces.size() != shape_->faces.size()) {
      throw failure(
          name, fmt::format("{} loses faces when it is sewn with a tolerance of {:.6g}: try a smaller one",
                            name, tolerance));
    }
    result->problems.push_back(fmt::format("{} edges were joined to others by sewing", made.joined));
    tell(made.orientation, result->problems);
    keep_pieces(*result, shape_->face_pieces);
    result->face_names = shape_->face_names;
    if (!shape_->face_pieces.empty())
      for (const std::string& told : shape_->problems)
        if (std::find(result->problems.begin(), result->problems.end(), told) == result->problems.end())
          result->problems.push_back(told);
    return CadModel(std::move(result));
  } catch (const Standard_Failure& problem) {
    throw failure(name, fmt::format("{} cannot be sewn with a tolerance of {:.6g} ({})", name, tolerance,
                                    problem.GetMessageString()));
  }
}

CadModel CadModel::imprinted(double tolerance) const {
  const std::string& name = shape_->name;
  if (!(tolerance >= 0) || !(tolerance < diagonal()))
    throw usage_error(
        "sew", fmt::format("`sew` must be smaller than the model, whose diagonal is {:.6g}, not {:.6g}",
                           diagonal(), tolerance));
  try {
    Imprint made = imprint(shape_->shape, tolerance);
    auto result = std::make_shared<CadShape>(made.shape, name);
    for (const auto& [text, faces] : shape_->face_names)
      for (const int face : faces)
        result->face_names[text].insert(made.pieces[face - 1].begin(), made.pieces[face - 1].end());
    keep_pieces(*result, std::move(made.pieces));
    tell(made.orientation, result->problems);
    result->edge_pieces = std::move(made.edge_pieces);
    result->vertex_pieces = std::move(made.vertex_pieces);
    return CadModel(std::move(result));
  } catch (const Standard_Failure& problem) {
    throw failure(name, fmt::format("{} cannot be imprinted ({}): mesh its parts one by one, or repair it in "
                                    "the program that made it",
                                    name, problem.GetMessageString()));
  }
}

int CadModel::face_count() const {
  return static_cast<int>(shape_->faces.size());
}
int CadModel::edge_count() const {
  return static_cast<int>(shape_->edges.size());
}
int CadModel::vertex_count() const {
  return static_cast<int>(shape_->vertices.size());
}
int CadModel::solid_count() const {
  return shape_->solids;
}
int CadModel::shell_count() const {
  return shape_->shells;
}
double CadModel::diagonal() const {
  return shape_->diagonal();
}
Vector3 CadModel::box_min() const {
  return shape_->box_min;
}
Vector3 CadModel::box_max() const {
  return shape_->box_max;
}
const std::vector<std::string>& CadModel::problems() const {
  return shape_->problems;
}
const std::map<std::string, std::set<int>>& CadModel::face_names() const {
  return shape_->face_names;
}
const std::vector<std::vector<int>>& CadModel::pieces() const {
  return shape_->face_pieces;
}
const std::vector<std::vector<int>>& CadModel::edge_pieces() const {
  return shape_->edge_pieces;
}
const std::vector<std::vector<int>>& CadModel::vertex_pieces() const {
  return shape_->vertex_pieces;
}

double CadModel::area(const ExecutionContext& context) const {
  double sum = 0;
  for (const FaceId id : shape_->faces.ids()) {
    context.check();
    GProp_GProps properties;
    try {
      BRepGProp::SurfaceProperties(shape_->faces[id].face, properties, 1e-4);
    } catch (const Standard_Failure&) {
      const std::string face = fmt::format("Face{}", id.number());
      throw failure(face, fmt::format("the area of {} cannot be measured: the file may be damaged", face));
    }
    sum += std::abs(properties.Mass());
  }
  return sum;
}

}  // namespace quadrille
