/// scale: compares time and memory per quad of a large mesh and a small mesh of one part, and of two threads
/// and one.

#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "mesher/quadrille.hpp"

namespace quadrille {
namespace {

struct Run {
  double quads = 0;
  double read = 0, mesh = 0, write = 0;  ///< wall-clock seconds
  double cpu = 0;                        ///< CPU seconds of meshing alone, all threads
  double peak_bytes = 0;                 ///< peak memory of the process
};

double wall() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double cpu() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

Run run_here(const std::filesystem::path& path, double size, int threads,
             const std::filesystem::path& output) {
  Run run;
  double start = wall();
  const CadModel model = CadModel::read(path);
  run.read = wall() - start;
  MeshOptions options;
  options.sizing.size = size;
  ExecutionContext context(threads);
  const double cpu_before = cpu();
  start = wall();
  const ShellMesh mesh = quadrille::mesh(model, options, context);
  run.mesh = wall() - start;
  run.cpu = cpu() - cpu_before;
  std::filesystem::remove(output);  // replacing a file of 100 MB takes as long as writing it
  start = wall();
  WriteOptions write_options;
  write_options.threads = threads;
  write_mesh(mesh, output, write_options);
  run.write = wall() - start;
  run.quads = static_cast<double>(mesh.quads.size());
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  run.peak_bytes = 1024.0 * static_cast<double>(usage.ru_maxrss);
  return run;
}

/// Runs in a process of its own, so that the peak memory is that of this run alone.
Run run_apart(const std::filesystem::path& path, double size, int threads,
              const std::filesystem::path& output) {
  int ends[2];
  if (::pipe(ends) != 0) throw failure("pipe", "no pipe can be made");
  std::fflush(nullptr);
  const pid_t child = ::fork();
  if (child == 0) {
    int code = 1;
    try {
      const Run run = run_here(path, size, threads, output);
      code = ::write(ends[1], &run, sizeof run) == sizeof run ? 0 : 1;
    } catch (const Error& error) {
      fmt::print(stderr, "scale: {}\n", error.what());
    }
    ::_exit(code);
  }
  ::close(ends[1]);
  Run run;
  const bool whole = child > 0 && ::read(ends[0], &run, sizeof run) == sizeof run;
  ::close(ends[0]);
  if (child > 0) ::waitpid(child, nullptr, 0);
  if (!whole) throw failure(path.string(), "the run failed");
  return run;
}

void print_run(const char* name, const Run& run) {
  const double n = run.quads;
  fmt::print("{:<18} {:>9.0f} {:>8.2f} {:>8.2f} {:>8.2f} {:>8.2f} {:>10.2f} {:>10.2f} {:>12.0f}\n", name, n,
             run.read, run.mesh, run.write, run.cpu, 1e6 * run.mesh / n, 1e6 * run.cpu / n,
             run.peak_bytes / n);
}

double size_for(const std::filesystem::path& path, double quads, const std::filesystem::path& output) {
  const CadModel model = CadModel::read(path);
  ExecutionContext context;
  double size = QuadEstimate(model, context).size_for(quads).size;
  // The estimate is not exact: correct the size by the square root of the ratio of the counts.
  for (int i = 0; i < 2; ++i) size *= std::sqrt(run_apart(path, size, 1, output).quads / quads);
  return size;
}

double load() {
  double average = 0;
  std::ifstream("/proc/loadavg") >> average;
  return average;
}

void compare(const std::filesystem::path& path, double many, double few, int repeats) {
  const auto output =
      std::filesystem::temp_directory_path() / fmt::format("quadrille-scale-{}.msh", ::getpid());
  const double fine = size_for(path, many, output), coarse = size_for(path, few, output);
  fmt::print("load before: {:.2f}\n\n{:<18} {:>9} {:>8} {:>8} {:>8} {:>8} {:>10} {:>10} {:>12}\n", load(), "",
             "quads", "read s", "mesh s", "write s", "CPU s", "us/quad", "CPU us", "peak B/quad");
  const auto best_of = [&](double size, int threads) {
    Run best;
    for (int i = 0; i < repeats; ++i) {
      const Run run = run_apart(path, size, threads, output);
      if (i == 0 || run.mesh < best.mesh) best = run;
    }
    return best;
  };
  const Run small = best_of(coarse, 1), large = best_of(fine, 1), two = best_of(fine, 2);
  std::filesystem::remove(output);
  print_run("small, 1 thread", small);
  print_run("large, 1 thread", large);
  print_run("large, 2 threads", two);
  fmt::print("\nCPU per quad, large compared with small: {:.2f}\n",
             large.cpu / large.quads / (small.cpu / small.quads));
  fmt::print("two threads and one: {:.2f} times meshing alone, {:.2f} times with reading and writing\n",
             large.mesh / two.mesh,
             (large.read + large.mesh + large.write) / (two.read + two.mesh + two.write));
}

int run(int argc, char** argv) {
  CLI::App app("Time and memory per quad, large compared with small and two threads with one");
  std::string model = QUADRILLE_SOURCE_DIR "/../shared/corpus/U_Joint_2.stp";
  double many = 1e6, few = 2e4;
  int repeats = 3;
  app.add_option("MODEL", model, "CAD file (default: U_Joint_2.stp of the corpus)");
  app.add_option("--quads", many, "of the large mesh, about (default 1 million)");
  app.add_option("--few", few, "quads of the small mesh, about (default 20 thousand)");
  app.add_option("--repeats", repeats, "runs of each, the fastest counts (default 3)");
  CLI11_PARSE(app, argc, argv);
  compare(model, many, few, repeats);
  return 0;
}

}  // namespace
}  // namespace quadrille

int main(int argc, char** argv) {
  try {
    return quadrille::run(argc, argv);
  } catch (const std::exception& problem) {
    fmt::print(stderr, "scale: {}\n", problem.what());
    return 1;
  }
}
