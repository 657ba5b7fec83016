/// The tables of Giuliani & Krivodonova (2018): coloring against Gmsh's Blossom on identical triangulations.
///
///     paper [--first N] [--domains N] [--colorings N] [--blossom-limit TRIANGLES] [--best-limit TRIANGLES]
///           [--aligned-limit TRIANGLES] [--gmsh PROGRAM] [--out FOLDER]
///
/// All times are processor times of one thread, also for Blossom (as Gmsh prints it), so other work on the
/// machine hardly affects them. Short runs of both are repeated and the least time is taken. The paper's time
/// covers coloring, removal of blanks, choice of the color and its alternating paths. The time of "all"
/// covers everything from arrays of triangles to arrays of quads.
///
/// Makes the triangulations from --first to --domains of six (rectangle 1 2 3, Lake Ontario 1 2 3), pairs
/// each by coloring (paper's mode), by Quadrille's default and by Blossom, improves all alike,
/// prints a table and writes FOLDER/paper.json.

#include <fmt/format.h>
#include <malloc.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>

#include "bench/best_pairing.hpp"
#include "bench/field_aligned.hpp"
#include "bench/planar_triangulation.hpp"
#include "geometry/base/error.hpp"
#include "mesher/io/io.hpp"
#include "mesher/mesh/quality.hpp"
#include "mesher/pairing/costed_coloring.hpp"
#include "mesher/pairing/recombine.hpp"
#include "mesher/quads/triangulated_surface.hpp"

#include "bench/paper_steps.hpp"  // after CGAL's headers, which do not stand OpenCASCADE's before them

namespace quadrille::bench {

namespace {

using nlohmann::json;

struct Domain {
  const char* name;
  bool lake;
  double size;
  double growth;                         // of the size, per distance from the boundary
  double paper_coloring, paper_blossom;  // seconds in the paper
};

constexpr std::array<Domain, 6> domains{{{"rectangle 1", false, 0.0256, 0, 0.0063, 0.12},
                                         {"rectangle 2", false, 0.01288, 0, 0.042, 0.39},
                                         {"rectangle 3", false, 0.006432, 0, 0.50, 5.34},
                                         {"Lake Ontario 1", true, 0.1555, 0.1, 0.06, 7.12},
                                         {"Lake Ontario 2", true, 0.07465, 0.048, 1.35, 449},
                                         {"Lake Ontario 3", true, 0.03752, 0.02413, 10.1, 1667}}};

/// Processor time of this thread.
class Stopwatch {
 public:
  double seconds() const { return now() - start_; }

 private:
  static double now() {
    timespec time{};
    ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
  }

  double start_ = now();
};

std::vector<Ring> rings_of(const Domain& domain) {
  if (!domain.lake) return {{{0, 0}, {1, 0}, {1, 3.5}, {0, 3.5}}};
  return read_rings(std::filesystem::path(QUADRILLE_SOURCE_DIR) / "bench/data/lake_ontario.txt");
}

TriangleMesh make(const Domain& domain) {
  return triangulate(rings_of(domain), {domain.size, domain.growth}, 1);
}

ShellMesh to_shell(const QuadMesh& quads) {
  ShellMesh shell;
  shell.points = quads.points;
  shell.quads = quads.quads;
  shell.triangles = quads.triangles;
  shell.quad_faces.assign(shell.quads.size(), 1);
  shell.triangle_faces.assign(shell.triangles.size(), 1);
  return shell;
}

json measures(const QuadMesh& quads) {
  const QualitySummary summary = quality(to_shell(quads));
  return {{"quads", summary.quads},
          {"triangles", summary.triangles},
          {"q_mean", summary.q_mean},
          {"q_min", summary.q_min},
          {"irregular_percent", summary.irregular_percent},
          {"inverted", summary.inverted},
          {"histogram", summary.q_histogram}};
}

json improved(const TriangleMesh& mesh, const QuadMesh& quads) {
  ExecutionContext context(1);
  std::vector<int> renumbered;
  const Stopwatch watch;
  const QuadMesh result = improve_on(mesh, quads, {}, renumbered, context);
  const double seconds = watch.seconds();
  json entry = measures(result);
  entry["seconds"] = seconds;
  return entry;
}

/// The least time of up to nine runs; starts no further run after two seconds.
template <class Run>
double best_seconds(Run&& run) {
  double best = 1e300;
  const Stopwatch all;
  for (int k = 0; k < 9 && (k == 0 || all.seconds() < 2); ++k) {
    const Stopwatch watch;
    run();
    best = std::min(best, watch.seconds());
  }
  return best;
}

/// Resident memory now, or its peak since reset_peak(), in bytes.
std::int64_t resident_bytes(const char* which) {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (line.rfind(which, 0) == 0) return 1024 * std::stoll(line.substr(line.find(':') + 1));
  }
  throw failure("memory", "/proc/self/status does not contain the memory used");
}

/// Peak memory of a pairing with its input and output, in bytes per triangle. Measured in a process of its
/// own, so that holes that earlier pairings left in the heap do not matter.
double bytes_per_triangle(const TriangleMesh& mesh, const RecombineOptions& options) {
  std::array<int, 2> ends{};
  if (::pipe(ends.data()) != 0) throw failure("memory", "no pipe to a child process");
  const pid_t child = ::fork();
  if (child < 0) throw failure("memory", "no child process");
  if (child == 0) {
    ::malloc_trim(0);
    std::ofstream("/proc/self/clear_refs") << "5";
    const std::int64_t before = resident_bytes("VmRSS");
    ExecutionContext context(1);
    recombine(mesh, options, context);
    const std::int64_t more = resident_bytes("VmHWM") - before;
    ::_exit(::write(ends[1], &more, sizeof more) == sizeof more ? 0 : 1);
  }
  std::int64_t more = 0;
  const bool told = ::read(ends[0], &more, sizeof more) == sizeof more;
  ::close(ends[0]);
  ::close(ends[1]);
  int status = 0;
  if (::waitpid(child, &status, 0) != child || status != 0 || !told)
    throw failure("memory", "the child process failed");
  const auto triangles = static_cast<double>(mesh.triangles.size());
  return (static_cast<double>(more) + 24.0 * static_cast<double>(mesh.points.size())) / triangles + 12;
}

json run_memory(const TriangleMesh& mesh) {
  RecombineOptions coloring;
  coloring.method = Method::paper;
  json entry = {{"coloring", bytes_per_triangle(mesh, coloring)}, {"default", bytes_per_triangle(mesh, {})}};
  fmt::print("  peak memory, bytes a triangle: coloring {:.0f}, default {:.0f}\n",
             entry["coloring"].get<double>(), entry["default"].get<double>());
  std::fflush(stdout);
  return entry;
}

json run_quadrille(const TriangleMesh& mesh, const RecombineOptions& options) {
  ExecutionContext context(1);
  QuadMesh quads;
  const double seconds = best_seconds([&] { quads = recombine(mesh, options, context); });
  json entry = measures(quads);
  entry["seconds"] = seconds;
  entry["improved"] = improved(mesh, quads);
  return entry;
}

/// The paper's last steps: collapses the triangles that the color leaves and averages nodes of poor quads.
json run_paper_end(const TriangleMesh& mesh) {
  RecombineOptions options;
  options.method = Method::paper;
  options.leftovers = Leftovers::leave;
  ExecutionContext context(1);
  QuadMesh quads = recombine(mesh, options, context);
  json entry = {{"triangles", quads.triangles.size()}};
  entry["collapsed"] = collapse_boundary_triangles(quads);
  entry["before"] = measures(quads);
  const Stopwatch watch;
  smooth_poor(quads);
  entry["seconds"] = watch.seconds();
  entry["after"] = measures(quads);
  return entry;
}

/// Times the stages of the paper's mode: neighbors, greedy coloring, removal of blanks, boundary.
json time_coloring(const TriangleMesh& mesh) {
  double connect = 1e300, greedy = 1e300, blanks = 1e300, boundary = 1e300;
  int greedy_blanks = 0, left = 0, boundary_left = 0;
  best_seconds([&] {
    Random random(1);
    const Stopwatch a;
    EdgeColoring coloring(mesh);
    connect = std::min(connect, a.seconds());
    const Stopwatch b;
    greedy_blanks = color_greedily(coloring, random);
    greedy = std::min(greedy, b.seconds());
    const Stopwatch c;
    left = remove_blanks(coloring, random);
    blanks = std::min(blanks, c.seconds());
    const Stopwatch d;
    const std::vector<Side> sides = coloring.boundary();
    boundary_left = clear_boundary(coloring, sides, least_boundary_color(coloring, sides), random);
    boundary = std::min(boundary, d.seconds());
  });
  return {{"coloring_seconds", greedy + blanks + boundary},
          {"connect_seconds", connect},
          {"greedy_seconds", greedy},
          {"greedy_blanks", greedy_blanks},
          {"blanks_seconds", blanks},
          {"blanks_left", left},
          {"boundary_seconds", boundary},
          {"boundary_left", boundary_left}};
}

void write_msh(const TriangleMesh& mesh, const std::filesystem::path& path) {
  ShellMesh shell;
  shell.points = mesh.points;
  shell.triangles = mesh.triangles;
  shell.triangle_faces.assign(mesh.triangles.size(), 1);
  write_mesh(shell, path);
}

/// Runs Gmsh once on blossom.geo. \return the wall and CPU seconds that it prints for Blossom.
std::array<double, 2> time_blossom(const std::string& gmsh, const std::filesystem::path& folder) {
  const std::string command = fmt::format("cd '{}' && {} blossom.geo - 2>&1", folder.string(), gmsh);
  std::FILE* pipe = ::popen(command.c_str(), "r");
  if (!pipe) throw failure(gmsh, gmsh + ": cannot be started");
  double wall = -1, cpu = -1;
  char line[1024];
  while (std::fgets(line, sizeof line, pipe)) {
    std::sscanf(line, "Info : Blossom recombination completed (Wall %lfs, CPU %lfs)", &wall, &cpu);
  }
  if (::pclose(pipe) != 0 || wall < 0) throw failure(gmsh, gmsh + ": Blossom did not complete");
  return {wall, cpu};
}

/// The sharpest corner of a domain and its limit on quality: boundary points stay, so the quad there has at
/// most this angle, and q is at most the angle over 90 degrees.
struct SharpestCorner {
  int point = -1;
  double degrees = 360;
  double q_bound() const { return std::min(1.0, degrees / 90); }
};

SharpestCorner sharpest_corner(const TriangleMesh& mesh) {
  const EdgeColoring connected(mesh);
  std::vector<char> boundary(mesh.points.size(), 0);
  for (Side side : connected.boundary()) boundary[mesh.triangles[triangle_of(side)][index_of(side)]] = 1;
  std::vector<double> degrees(mesh.points.size(), 0);
  for (const auto& corners : mesh.triangles) {
    for (int i = 0; i < 3; ++i) {
      const Vector3& p = mesh.points[corners[i]];
      const Vector3 a = mesh.points[corners[next_index(i)]] - p,
                    b = mesh.points[corners[previous_index(i)]] - p;
      degrees[corners[i]] += std::atan2(a.cross(b).norm(), a.dot(b)) * 180 / std::numbers::pi;
    }
  }
  SharpestCorner sharpest;
  for (int v = 0; v < static_cast<int>(degrees.size()); ++v) {
    if (boundary[v] && degrees[v] < sharpest.degrees) sharpest = {v, degrees[v]};
  }
  return sharpest;
}

/// Gmsh's Blossom on a file, without its topological optimization.
json run_blossom(const TriangleMesh& mesh, const std::string& gmsh, const std::filesystem::path& folder) {
  const std::filesystem::path input = folder / "triangles.msh", output = folder / "blossom.msh";
  const std::filesystem::path script = folder / "blossom.geo";
  write_msh(mesh, input);
  std::ofstream(script)
      << "Merge \"" << input.filename().string() << "\";\nMesh.RecombinationAlgorithm = 1;\n"
      << "Mesh.RecombineOptimizeTopology = 0;\nMesh.MshFileVersion = 2.2;\nRecombineMesh;\nSave \""
      << output.filename().string() << "\";\n";
  auto [wall, cpu] = time_blossom(gmsh, folder);
  for (int again = 0; again < 4 && cpu < 1; ++again) {
    const auto [next_wall, next_cpu] = time_blossom(gmsh, folder);
    wall = std::min(wall, next_wall);
    cpu = std::min(cpu, next_cpu);
  }
  const ShellMesh read = read_mesh(output);
  QuadMesh quads;
  quads.points = read.points;
  quads.quads = read.quads;
  quads.triangles = read.triangles;
  json entry = measures(quads);
  const Vector3& corner = mesh.points[sharpest_corner(mesh).point];
  const auto at_corner = [&](const auto& element) {
    return std::any_of(element.begin(), element.end(),
                       [&](int v) { return (quads.points[v] - corner).norm() < 1e-9; });
  };
  entry["triangles_at_sharpest_corner"] =
      std::count_if(quads.triangles.begin(), quads.triangles.end(), at_corner);
  entry["quads_at_sharpest_corner"] = std::count_if(quads.quads.begin(), quads.quads.end(), at_corner);
  entry["seconds"] = cpu;
  entry["wall_seconds"] = wall;
  // Blossom does not move points, so the same triangulation serves as the surface for smoothing.
  entry["improved"] = improved(mesh, quads);
  return entry;
}

#ifdef QUADRILLE_LEMON
/// The pairing with the greatest mean q that leaves no triangles. Its "bound" is the greatest sum of q of any
/// pairing, divided by half the number of triangles: the mean if leftover triangles count as quads of q 0.
json run_best(const TriangleMesh& mesh) {
  const CostedColoring graph(mesh);
  QuadMesh possible;
  possible.points = mesh.points;
  std::vector<PossiblePair> pairs;
  for (int t = 0; t < graph.size(); ++t) {
    for (int i = 0; i < 3; ++i) {
      const Side side = make_side(t, i), twin = graph.twin(side);
      if (twin < side) continue;
      const auto& quad = possible.quads.emplace_back(std::array<int, 4>{
          graph.corner_at(side), graph.apex_of(twin), graph.end_of(side), graph.apex_of(side)});
      const auto& points = mesh.points;
      pairs.push_back(
          {t, triangle_of(twin), quad_q(points[quad[0]], points[quad[1]], points[quad[2]], points[quad[3]])});
    }
  }
  const auto take = [&](bool perfect) {
    QuadMesh quads;
    quads.points = mesh.points;
    for (int k : best_pairing(graph.size(), pairs, perfect)) quads.quads.push_back(possible.quads[k]);
    return quads;
  };
  const Stopwatch watch;
  const QuadMesh best = take(true);
  const double seconds = watch.seconds();
  json entry = measures(best);
  entry["seconds"] = seconds;
  const json free = measures(take(false));
  const std::size_t most_pairs = graph.size() / 2;
  entry["bound"] =
      free["q_mean"].get<double>() * free["quads"].get<double>() / static_cast<double>(most_pairs);
  return entry;
}
#endif

void print_row(const char* method, const json& entry) {
  const json& after = entry["improved"];
  fmt::print(
      "  {:9} {:10.4f} s  left {:5}  q {:.3f} / {:.3f}  irregular {:5.2f} %   improved: q {:.3f} / {:.3f}  "
      "irregular {:5.2f} %  ({:.2f} s)\n",
      method, entry["seconds"].get<double>(), entry["triangles"].get<int>(), entry["q_mean"].get<double>(),
      entry["q_min"].get<double>(), entry["irregular_percent"].get<double>(), after["q_mean"].get<double>(),
      after["q_min"].get<double>(), after["irregular_percent"].get<double>(), after["seconds"].get<double>());
  std::fflush(stdout);
}

/// Extra columns of the table: points along a cross field instead of random ones.
json run_field_aligned(const Domain& domain, int blossom_limit, const std::string& gmsh,
                       const std::filesystem::path& folder) {
  const TriangleMesh mesh = triangulate_along_field(rings_of(domain), {domain.size, domain.growth});
  fmt::print(" on field-aligned points: {} triangles\n", mesh.triangles.size());
  json entry = {{"triangles", mesh.triangles.size()}};
  RecombineOptions options;
  options.method = Method::paper;
  entry["coloring"] = run_quadrille(mesh, options);
  print_row("coloring", entry["coloring"]);
  entry["default"] = run_quadrille(mesh, {});
  print_row("default", entry["default"]);
  if (static_cast<int>(mesh.triangles.size()) > blossom_limit) return entry;
  entry["blossom"] = run_blossom(mesh, gmsh, folder);
  print_row("Blossom", entry["blossom"]);
  return entry;
}

json run_domain(const Domain& domain, int blossom_limit, [[maybe_unused]] int best_limit,
                const std::string& gmsh, const std::filesystem::path& folder) {
  const TriangleMesh mesh = make(domain);
  const double count = static_cast<double>(mesh.triangles.size());
  fmt::print("{}: {} triangles; mean q / minimum q\n", domain.name, mesh.triangles.size());
  json entry = {
      {"name", domain.name},
      {"triangles", mesh.triangles.size()},
      {"paper", {{"coloring_seconds", domain.paper_coloring}, {"blossom_seconds", domain.paper_blossom}}}};
  std::fflush(stdout);  // else child processes would print it once more
  entry["bytes_per_triangle"] = run_memory(mesh);
  const SharpestCorner corner = sharpest_corner(mesh);
  entry["sharpest_corner"] = {{"degrees", corner.degrees}, {"q_bound", corner.q_bound()}};
  fmt::print(
      "  sharpest corner {:.2f} degrees: all quads, the boundary kept, have a minimum q of at most {:.3f}\n",
      corner.degrees, corner.q_bound());
  entry["stages"] = time_coloring(mesh);
  const json& stages = entry["stages"];
  const auto per_triangle = [&](const char* stage) { return 1e6 * stages[stage].get<double>() / count; };
  fmt::print(
      "  coloring {:.3f} + blanks {:.3f} + boundary {:.3f} us a triangle ({:.1f} % blank, {} left, {} "
      "boundary edges "
      "left); neighbors {:.3f}\n",
      per_triangle("greedy_seconds"), per_triangle("blanks_seconds"), per_triangle("boundary_seconds"),
      100 * stages["greedy_blanks"].get<double>() / count, stages["blanks_left"].get<int>(),
      stages["boundary_left"].get<int>(), per_triangle("connect_seconds"));
  RecombineOptions options;
  options.method = Method::paper;
  entry["coloring"] = run_quadrille(mesh, options);
  print_row("coloring", entry["coloring"]);
  entry["paper_end"] = run_paper_end(mesh);
  const json& end = entry["paper_end"];
  fmt::print(
      "  paper's end: {} triangles left, {} collapsed, q {:.3f} / {:.3f}; nodes of quads below 0.5 averaged: "
      "q {:.3f} / {:.3f}\n",
      end["triangles"].get<int>(), end["collapsed"].get<int>(), end["before"]["q_mean"].get<double>(),
      end["before"]["q_min"].get<double>(), end["after"]["q_mean"].get<double>(),
      end["after"]["q_min"].get<double>());
  options = {};
  entry["default"] = run_quadrille(mesh, options);
  print_row("default", entry["default"]);
#ifdef QUADRILLE_LEMON
  if (static_cast<int>(count) <= best_limit) {
    entry["best"] = run_best(mesh);
    const json& best = entry["best"];
    fmt::print("  best of all pairings: q {:.4f}, irregular {:.2f} % ({:.2f} s with LEMON); ",
               best["q_mean"].get<double>(), best["irregular_percent"].get<double>(),
               best["seconds"].get<double>());
    fmt::print("were triangles left and counted as 0: q {:.4f}\n", best["bound"].get<double>());
  }
#endif
  if (static_cast<int>(count) > blossom_limit) {
    fmt::print("  Blossom not run above {} triangles (--blossom-limit)\n", blossom_limit);
    return entry;
  }
  entry["blossom"] = run_blossom(mesh, gmsh, folder);
  print_row("Blossom", entry["blossom"]);
  fmt::print("  at the sharpest corner, Blossom has {} quads and {} triangles\n",
             entry["blossom"]["quads_at_sharpest_corner"].get<int>(),
             entry["blossom"]["triangles_at_sharpest_corner"].get<int>());
  const double blossom = entry["blossom"]["seconds"];
  fmt::print(
      "  Blossom / coloring {:.0f} (paper's count; paper {:.1f}), / all of coloring {:.0f}, / default "
      "{:.0f}\n",
      blossom / stages["coloring_seconds"].get<double>(), domain.paper_blossom / domain.paper_coloring,
      blossom / entry["coloring"]["seconds"].get<double>(),
      blossom / entry["default"]["seconds"].get<double>());
  std::fflush(stdout);
  return entry;
}

/// Mean q of many colorings of the first rectangle: figure 10.
json run_colorings(int count) {
  const TriangleMesh mesh = make(domains[0]);
  json means = json::array();
  double low = 1, high = 0, sum = 0;
  for (int seed = 1; seed <= count; ++seed) {
    RecombineOptions options;
    options.method = Method::paper;
    options.seed = static_cast<std::uint64_t>(seed);
    ExecutionContext context(1);
    const QuadMesh quads = recombine(mesh, options, context);
    double mean = 0;
    for (const auto& [a, b, c, d] : quads.quads) {
      mean += quad_q(quads.points[a], quads.points[b], quads.points[c], quads.points[d]);
    }
    mean /= static_cast<double>(quads.quads.size());
    means.push_back(mean);
    low = std::min(low, mean);
    high = std::max(high, mean);
    sum += mean;
  }
  fmt::print("mean q of {} colorings of rectangle 1: {:.4f} to {:.4f}, mean {:.4f} (paper 0.505 to 0.522)\n",
             count, low, high, sum / count);
  return means;
}

int run(int argc, char** argv) {
  CLI::App app("The tables of Giuliani & Krivodonova (2018), coloring against Gmsh's Blossom");
  int first = 1, domain_count = 4, colorings = 0, blossom_limit = 300'000, best_limit = 300'000,
      aligned_limit = 300'000;
  std::string gmsh = "gmsh";
  std::filesystem::path folder = ".";
  app.add_option("--first", first, "the first of the triangulations to make (default 1)")
      ->check(CLI::Range(1, 6));
  app.add_option("--domains", domain_count, "the last of the six triangulations to make (default 4)")
      ->check(CLI::Range(0, 6));
  app.add_option("--colorings", colorings,
                 "figure 10: how many colorings of the first rectangle (default 0)");
  app.add_option("--blossom-limit", blossom_limit, "largest triangulation given to Blossom (default 300000)");
  app.add_option("--best-limit", best_limit,
                 "largest triangulation whose best pairing is sought, with LEMON (default 300000)");
  app.add_option("--aligned-limit", aligned_limit,
                 "largest triangulation that is also made with field-aligned points (default 300000)");
  app.add_option("--gmsh", gmsh, "the gmsh program");
  app.add_option("--out", folder, "folder for paper.json and the meshes");
  CLI11_PARSE(app, argc, argv);
  std::filesystem::create_directories(folder);
  json results = {{"domains", json::array()}};
  for (int k = first - 1; k < domain_count; ++k) {
    json entry = run_domain(domains[k], blossom_limit, best_limit, gmsh, folder);
    if (entry["triangles"].get<int>() <= aligned_limit) {
      entry["field_aligned"] = run_field_aligned(domains[k], blossom_limit, gmsh, folder);
    }
    results["domains"].push_back(entry);
  }
  if (colorings > 0) results["colorings"] = run_colorings(colorings);
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  results["peak_bytes"] = static_cast<std::int64_t>(usage.ru_maxrss) * 1024;
  std::ofstream(folder / "paper.json") << results.dump(1) << "\n";
  return 0;
}

}  // namespace

}  // namespace quadrille::bench

int main(int argc, char** argv) {
  try {
    return quadrille::bench::run(argc, argv);
  } catch (const std::exception& error) {
    fmt::print(stderr, "paper: {}\n", error.what());
    return 1;
  }
}
