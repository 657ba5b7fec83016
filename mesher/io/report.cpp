#include "mesher/io/report.hpp"

#include <CGAL/version.h>
#include <openvdb/version.h>
#include <sys/resource.h>

#include <Standard_Version.hxx>
#include <nlohmann/json.hpp>

#include "mesher/io/atomic_file.hpp"

namespace quadrille {

namespace {

using nlohmann::json;

json quality_to_json(const QualitySummary& summary) {
  return {{"q_min", summary.q_min},
          {"q_mean", summary.q_mean},
          {"sj_min", summary.sj_min},
          {"sj_mean", summary.sj_mean},
          {"inverted", summary.inverted},
          {"irregular_percent", summary.irregular_percent},
          {"histogram", summary.q_histogram},
          {"valence_counts", summary.valence_counts},
          {"aspect_mean", summary.aspect_mean},
          {"aspect_max", summary.aspect_max},
          {"warping_max_degrees", summary.warping_max_degrees},
          {"edge_min", summary.edge_min},
          {"edge_median", summary.edge_median},
          {"edge_max", summary.edge_max}};
}

json seconds_to_json(const ExecutionContext& context) {
  json seconds = json::object();
  for (const char* stage :
       {"read", "size", "sample", "triangulate", "color", "recombine", "improve", "write"})
    seconds[stage] = 0.0;
  for (const auto& [stage, value] : context.seconds()) seconds[stage] = value;
  return seconds;
}

json faces_to_json(const ShellMesh& mesh) {
  json faces = json::array();
  for (const ShellMesh::FaceStatus& face : mesh.faces)
    faces.push_back({{"name", "Face" + std::to_string(face.face)},
                     {"status", face.status},
                     {"quads", face.quads},
                     {"q_min", face.q_min},
                     {"seconds", face.seconds},
                     {"note", face.note}});
  return faces;
}

double seconds_of(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * time.tv_usec;
}

}  // namespace

json make_report(const ShellMesh& mesh, const QualitySummary& summary, const ExecutionContext& context,
                 const std::filesystem::path& input, const std::vector<std::string>& warnings) {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return {{"input", input.string()},
          {"order", mesh.order},
          {"counts", {{"nodes", summary.nodes}, {"quads", summary.quads}, {"triangles", summary.triangles}}},
          {"quality", quality_to_json(summary)},
          {"seconds", seconds_to_json(context)},
          {"cpu_seconds", seconds_of(usage.ru_utime) + seconds_of(usage.ru_stime)},
          {"peak_bytes", static_cast<std::int64_t>(usage.ru_maxrss) * 1024},
          {"faces", faces_to_json(mesh)},
          {"warnings", warnings},
          {"versions",
           {{"quadrille", QUADRILLE_VERSION},
            {"opencascade", OCC_VERSION_COMPLETE},
            {"openvdb", OPENVDB_LIBRARY_VERSION_STRING},
            {"cgal", CGAL_VERSION_STR}}}};
}

void write_report(const ShellMesh& mesh, const QualitySummary& summary, const ExecutionContext& context,
                  const std::filesystem::path& input, const std::filesystem::path& path,
                  const std::vector<std::string>& warnings) {
  // File names need not be UTF-8, JSON must.
  constexpr auto replace = json::error_handler_t::replace;
  write_file(path, make_report(mesh, summary, context, input, warnings).dump(2, ' ', false, replace) + "\n");
}

}  // namespace quadrille
