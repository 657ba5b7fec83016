/// The child sends the names of faces and the shape, in OpenCASCADE's binary format; crashes and delays
/// become errors.

#include "geometry/cad/isolated_reading.hpp"

#include <BinTools.hxx>
#include <Standard_Failure.hxx>
#include <iomanip>
#include <sstream>

#include <fmt/format.h>

#include "geometry/base/error.hpp"
#include "geometry/base/isolated_work.hpp"

namespace quadrille {

namespace {

void send(const std::string& name, const std::function<NamedShape()>& read, std::ostream& out) {
  try {
    const NamedShape made = read();
    for (const auto& [text, faces] : made.names) {
      out << std::quoted(text);
      for (const int face : faces) out << ' ' << face;
      out << '\n';
    }
    out << '\n';
    BinTools::Write(made.shape, out);
  } catch (const Standard_Failure& problem) {
    throw failure(name, fmt::format("{} could not be read as CAD ({})", name, problem.GetMessageString()));
  }
}

NamedShape receive(std::istream& in) {
  NamedShape result;
  for (std::string line; std::getline(in, line) && !line.empty();) {
    std::istringstream words(line);
    std::string text;
    words >> std::quoted(text);
    for (int face = 0; words >> face;) result.names[text].insert(face);
  }
  BinTools::Read(result.shape, in);
  return result;
}

}  // namespace

std::string reading_too_long(const std::string& name, double time_limit) {
  return fmt::format(
      "{}: reading it takes longer than {:g} s: it may be damaged; `read_time_limit` allows more", name,
      time_limit);
}

NamedShape read_isolated(const std::string& name, const std::function<NamedShape()>& read,
                         ExecutionContext* context, double time_limit) {
  IsolatedWork options;
  options.subject = name;
  options.crashed = fmt::format("{}: reading this file crashed: it may be damaged", name);
  options.too_long = reading_too_long(name, time_limit);
  options.time_limit = time_limit;
  options.context = context;
  const auto work = [&](std::ostream& out) { send(name, read, out); };
  std::istringstream in(run_isolated(options, work));
  return receive(in);
}

}  // namespace quadrille
