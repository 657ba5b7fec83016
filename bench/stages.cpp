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
#include <vector>

#include "field.hpp"
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

std::vector<std::string> sample_paths() {
  std::vector<std::string> paths;
  for (const auto& entry : std::filesystem::directory_iterator(QUADRILLE_SOURCE_DIR "/examples/models")) {
    paths.push_back(entry.path().string());
  }
  std::sort(paths.begin(), paths.end());
  return paths;
}

std::size_t count_quads(const std::filesystem::path& mesh) {
  try {
    return read_mesh(mesh).quads.size();
  } catch (const Error&) {
    return 0;
  }
}

int run(int argc, char** argv) {
  CLI::App app("Microseconds a quad of each stage");
  std::vector<std::string> models;
  std::vector<double> divisions{60, 150, 300};
  int threads = 1, repeat = 3;
  bool gmsh = false, direct = false, field = false;
  SizingOptions sizing;
  app.add_option("MODEL", models, "CAD files (default: the sample parts)");
  app.add_option("--elements-per-diagonal", divisions,
                 "sizes, as the diagonal over these (default: 60 150 300)")
      ->delimiter(',');
  app.add_option("--threads", threads, "threads (default 1)");
  app.add_option("--repeat", repeat, "runs of each, the fastest counts (default 3)")
      ->check(CLI::PositiveNumber);
  app.add_flag("--gmsh", gmsh,
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
    print_fields(models, sizing, threads, repeat);
    return 0;
  }
  if (models.empty()) models = sample_paths();

  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / fmt::format("quadrille-bench-{}", ::getpid());
  std::filesystem::create_directory(folder);
  MeshOptions options;
  options.strategy = direct ? Strategy::direct : Strategy::subdivide;
  fmt::print("microseconds a quad: stages and total by the clock, summed over threads{}\n",
             gmsh ? "; cpu, gmsh and their ratio are CPU time, Gmsh's with its start" : "");
  fmt::print("{:<26}{:>6}{:>9}", "model", "n", "quads");
  for (const auto& stage : stages) fmt::print("{:>12}", stage);
  fmt::print("{:>9}{:>8}{}\n", "total", "q", gmsh ? "     cpu    gmsh   ratio" : "");
  for (const std::string& model : models) {
    for (const double n : divisions) {
      Run best;
      for (int i = 0; i < repeat; ++i) {
        Run now = run_once(model, n, options, threads, folder / "mesh.msh");
        if (i == 0 || now.total() < best.total()) best = std::move(now);
      }
      const double scale = 1e6 / static_cast<double>(std::max<std::size_t>(best.quads, 1));
      fmt::print("{:<26}{:>6}{:>9}", std::filesystem::path(model).filename().string(), n, best.quads);
      for (const auto& stage : stages) fmt::print("{:>12.3f}", scale * best.seconds[stage]);
      fmt::print("{:>9.3f}{:>8.3f}", scale * best.total(), best.q_mean);
      if (gmsh) {
        const double size = CadModel::read(model).diagonal() / n;
        double seconds = gmsh_seconds(model, size, folder / "gmsh.msh");
        for (int i = 1; i < repeat; ++i)
          seconds = std::min(seconds, gmsh_seconds(model, size, folder / "gmsh.msh"));
        const std::size_t quads = seconds < 0 ? 0 : count_quads(folder / "gmsh.msh");
        const double ours = scale * best.cpu;
        fmt::print("{:>8.1f}", ours);
        if (quads == 0) {
          fmt::print("  failed");
        } else {
          const double theirs = 1e6 * seconds / static_cast<double>(quads);
          fmt::print("{:>8.1f}{:>8.1f}", theirs, theirs / ours);
        }
      }
      fmt::print("\n");
    }
  }
  std::filesystem::remove_all(folder);
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
