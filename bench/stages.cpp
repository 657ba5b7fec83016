/// bench: microseconds per quad of each stage, on the sample parts or on given CAD files; with --gmsh, also
/// of Gmsh in the same run.

#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "field.hpp"
#include "geometry/base/error.hpp"
#include "geometry/base/file_access.hpp"
#include "mesher/quadrille.hpp"

namespace quadrille {
namespace {

const std::vector<std::string> stages{"read",      "size",    "sample", "triangulate", "color",
                                      "recombine", "improve", "slide",  "assemble",    "write"};

struct Run {
  std::size_t quads = 0;
  double q_mean = 0;
  double cpu = 0;  ///< CPU seconds of all threads and child processes
  std::map<std::string, double> seconds;
  double total() const {
    double sum = 0;
    for (const auto& [stage, time] : seconds) sum += time;
    return sum;
  }
};

/// CPU seconds of this process and of its children that have ended.
double cpu_seconds() {
  double sum = 0;
  for (const auto who : {RUSAGE_SELF, RUSAGE_CHILDREN}) {
    rusage usage{};
    ::getrusage(who, &usage);
    for (const timeval& time : {usage.ru_utime, usage.ru_stime})
      sum += static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  }
  return sum;
}

Run run_once(const std::filesystem::path& path, double divisions, const MeshOptions& base, int threads,
             const std::filesystem::path& output) {
  const double before = cpu_seconds();
  ExecutionContext context(threads);
  std::optional<CadModel> model;
  {
    const StageTimer timer(context, Stage::read);
    model = CadModel::read(path);
  }
  MeshOptions options = base;
  options.sizing.size = model->diagonal() / divisions;
  const ShellMesh mesh = quadrille::mesh(*model, options, context);
  {
    const StageTimer timer(context, Stage::write);
    write_mesh(mesh, output);
  }
  const double cpu = cpu_seconds() - before;
  return {mesh.quads.size(), quality(mesh).q_mean, cpu, context.seconds()};
}

/// CPU seconds of Gmsh's best all-quad mode: Blossom at twice the size, then midpoint subdivision. Negative
/// if Gmsh failed.
double gmsh_seconds(const std::filesystem::path& path, double size, const std::filesystem::path& output) {
  const double before = cpu_seconds();
  const std::string double_size = fmt::format("{}", 2 * size), least_size = fmt::format("{}", size / 4);
  std::fflush(nullptr);  // else the child would print buffered text once more
  const pid_t child = ::fork();
  if (child == 0) {
    if (!std::freopen("/dev/null", "w", stdout) || !std::freopen("/dev/null", "w", stderr)) ::_exit(127);
    ::execlp("gmsh", "gmsh", path.c_str(), "-2", "-clmax", double_size.c_str(), "-clmin", least_size.c_str(),
             "-setnumber", "Mesh.MeshSizeFromCurvature", "6", "-setnumber", "Mesh.RecombineAll", "1",
             "-setnumber", "Mesh.RecombinationAlgorithm", "1", "-setnumber", "Mesh.SubdivisionAlgorithm", "1",
             "-setnumber", "Mesh.Algorithm", "6", "-nt", "1", "-format", "msh22", "-o", output.c_str(),
             static_cast<char*>(nullptr));
    ::_exit(127);
  }
  int status = 0;
  if (child < 0 || ::waitpid(child, &status, 0) != child || !WIFEXITED(status) || WEXITSTATUS(status) != 0)
    return -1;
  return cpu_seconds() - before;
}

/// The CAD files that are named or lie in the named folders, in alphabetical order.
std::vector<std::filesystem::path> cad_files(const std::vector<std::string>& named) {
  constexpr std::string_view endings[] = {".step", ".stp", ".iges", ".igs", ".brep", ".brp"};
  std::vector<std::filesystem::path> files;
  for (const std::filesystem::path path : named) {
    if (!std::filesystem::is_directory(path)) {
      files.push_back(path);
      continue;
    }
    for (const auto& entry : std::filesystem::directory_iterator(path))
      if (std::ranges::find(endings, lower_ending(entry.path())) != std::end(endings))
        files.push_back(entry.path());
  }
  std::ranges::sort(files);
  return files;
}

std::size_t count_quads(const std::filesystem::path& mesh) {
  try {
    return read_mesh(mesh).quads.size();
  } catch (const Error&) {
    return 0;
  }
}

struct BenchOptions {
  MeshOptions mesh;
  int threads = 1, repeat = 3;
  bool gmsh = false;
  std::filesystem::path folder;  ///< for output
};

/// Runs of one part, or the sums over several.
struct Measured {
  Run ours;
  std::size_t gmsh_quads = 0;  ///< 0 = it failed
  double gmsh_seconds = 0;

  void add(const Measured& other) {
    const std::size_t all = ours.quads + other.ours.quads;
    if (all > 0)
      ours.q_mean = (ours.q_mean * static_cast<double>(ours.quads) +
                     other.ours.q_mean * static_cast<double>(other.ours.quads)) /
                    static_cast<double>(all);
    ours.quads = all;
    ours.cpu += other.ours.cpu;
    for (const auto& [stage, time] : other.ours.seconds) ours.seconds[stage] += time;
    gmsh_quads += other.gmsh_quads;
    gmsh_seconds += other.gmsh_quads > 0 ? other.gmsh_seconds : 0;
  }
};

/// The fastest of several runs. Throws Error as meshing does.
Measured measure(const std::filesystem::path& model, double divisions, const BenchOptions& options) {
  Measured result;
  for (int i = 0; i < options.repeat; ++i) {
    Run now = run_once(model, divisions, options.mesh, options.threads, options.folder / "mesh.msh");
    if (i == 0 || now.total() < result.ours.total()) result.ours = std::move(now);
  }
  if (!options.gmsh) return result;
  const double size = CadModel::read(model).diagonal() / divisions;
  const std::filesystem::path output = options.folder / "gmsh.msh";
  result.gmsh_seconds = gmsh_seconds(model, size, output);
  for (int i = 1; i < options.repeat && result.gmsh_seconds >= 0; ++i)
    result.gmsh_seconds = std::min(result.gmsh_seconds, gmsh_seconds(model, size, output));
  if (result.gmsh_seconds >= 0) result.gmsh_quads = count_quads(output);
  return result;
}

void print_row(const std::string& name, double divisions, const Measured& row, bool gmsh) {
  const double scale = 1e6 / static_cast<double>(std::max<std::size_t>(row.ours.quads, 1));
  fmt::print("{:<26}{:>6}{:>9}", name.substr(0, 25), divisions, row.ours.quads);
  for (const auto& stage : stages) {
    const auto found = row.ours.seconds.find(stage);
    fmt::print("{:>12.3f}", found == row.ours.seconds.end() ? 0 : scale * found->second);
  }
  fmt::print("{:>9.3f}{:>8.3f}", scale * row.ours.total(), row.ours.q_mean);
  const double cpu = scale * row.ours.cpu;
  if (gmsh && row.gmsh_quads == 0) {
    fmt::print("{:>8.1f}  failed", cpu);
  } else if (gmsh) {
    const double theirs = 1e6 * row.gmsh_seconds / static_cast<double>(row.gmsh_quads);
    fmt::print("{:>8.1f}{:>8.1f}{:>8.2f}", cpu, theirs, theirs / cpu);
  }
  fmt::print("\n");
  std::fflush(stdout);
}

/// A row for each part, and one of the sums for each size.
void print_table(const std::vector<std::filesystem::path>& models, const std::vector<double>& divisions,
                 const BenchOptions& options) {
  fmt::print("microseconds per quad: stages and total by the clock, summed over threads{}\n",
             options.gmsh ? "; cpu, gmsh and their ratio are CPU time, Gmsh's with its start" : "");
  fmt::print("{:<26}{:>6}{:>9}", "model", "n", "quads");
  for (const auto& stage : stages) fmt::print("{:>12}", stage);
  fmt::print("{:>9}{:>8}{}\n", "total", "q", options.gmsh ? "     cpu    gmsh   ratio" : "");
  for (const double n : divisions) {
    Measured sum;
    for (const std::filesystem::path& model : models) {
      try {
        const Measured row = measure(model, n, options);
        print_row(model.filename().string(), n, row, options.gmsh);
        sum.add(row);
      } catch (const Error& error) {
        fmt::print("{:<26}{:>6}  {}\n", model.filename().string().substr(0, 25), n, error.what());
      }
    }
    if (models.size() > 1) print_row("all", n, sum, options.gmsh);
  }
}

int run(int argc, char** argv) {
  CLI::App app("Microseconds per quad of each stage");
  std::vector<std::string> models;
  std::vector<double> divisions{60, 150, 300};
  BenchOptions options;
  bool direct = false, field = false;
  SizingOptions sizing;
  app.add_option("MODEL", models, "CAD files, or folders of them (default: the sample parts)");
  app.add_option("--elements-per-diagonal", divisions,
                 "sizes, as the diagonal over these (default: 60 150 300)")
      ->delimiter(',');
  app.add_option("--threads", options.threads, "threads (default 1)");
  app.add_option("--repeat", options.repeat, "runs of each, the fastest counts (default 3)")
      ->check(CLI::PositiveNumber);
  app.add_flag("--gmsh", options.gmsh,
               "run Gmsh on the same part at the same size, and print the ratio of the times a quad");
  app.add_flag("--direct", direct, "the direct strategy");
  app.add_flag(
      "--field", field,
      "memory and time of the sizing field by levels instead, with both gradations, at the first of the "
      "sizes (default model: a plate of 1 m with a fillet of 0.1 mm)");
  app.add_option("--size-min", sizing.size_min, "of the field, mm");
  CLI11_PARSE(app, argc, argv);
  if (field) {
    sizing.elements_per_diagonal = divisions.front();
    print_fields(models, sizing, options.threads, options.repeat);
    return 0;
  }
  if (models.empty()) models = {QUADRILLE_SOURCE_DIR "/examples/models"};
  options.folder = std::filesystem::temp_directory_path() / fmt::format("quadrille-bench-{}", ::getpid());
  std::filesystem::create_directory(options.folder);
  options.mesh.strategy = direct ? Strategy::direct : Strategy::subdivide;
  print_table(cad_files(models), divisions, options);
  std::filesystem::remove_all(options.folder);
  return 0;
}

}  // namespace
}  // namespace quadrille

int main(int argc, char** argv) {
  try {
    return quadrille::run(argc, argv);
  } catch (const std::exception& problem) {
    fmt::print(stderr, "bench: {}\n", problem.what());
    return 1;
  }
}
