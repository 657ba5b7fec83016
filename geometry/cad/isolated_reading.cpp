/// The child sends the shape that it read in OpenCASCADE's binary format; crashes and delays become errors.

#include "geometry/cad/isolated_reading.hpp"

#include <BinTools.hxx>
#include <Standard_Failure.hxx>

#include <fmt/format.h>

#include "geometry/base/error.hpp"
#include "geometry/cad/cad_model.hpp"
#include "geometry/cad/cad_shape.hpp"

namespace quadrille {

namespace {

void send(const std::string& name, const std::function<TopoDS_Shape()>& read, std::ostream& out) {
  try {
    BinTools::Write(read(), out);
  } catch (const Standard_Failure& problem) {
    throw failure(name, fmt::format("{} could not be read as CAD ({})", name, problem.GetMessageString()));
  }
}

}  // namespace

std::string reading_too_long(const std::string& name, double time_limit) {
  return fmt::format(
      "{}: reading it takes longer than {:g} s: it may be damaged; `read_time_limit` allows more", name,
      time_limit);
}

TopoDS_Shape read_isolated(const std::string& name, const std::function<TopoDS_Shape()>& read,
                           ExecutionContext* context, double time_limit, std::size_t memory,
                           const IsolatedTask& task) {
  IsolatedWork options;
  options.subject = name;
  options.crashed = fmt::format("{}: reading this file crashed: it may be damaged", name);
  options.too_long = reading_too_long(name, time_limit);
  options.time_limit = time_limit;
  options.memory = memory;
  options.context = context;
  options.task = task;
  const auto work = [&](std::ostream& out) { send(name, read, out); };
  TopoDS_Shape shape;
  run_isolated(options, work, [&](std::istream& in) { BinTools::Read(shape, in); });
  return shape;
}

void send_shape(const std::filesystem::path& path, std::ostream& out) {
  send(
      path.string(), [&] { return CadModel::read(path).shape().shape; }, out);
}

}  // namespace quadrille
