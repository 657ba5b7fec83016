#pragma once
/// The report of one run as JSON.

#include <filesystem>
#include <nlohmann/json_fwd.hpp>

#include "geometry/base/execution_context.hpp"
#include "mesher/mesh/criteria.hpp"
#include "mesher/mesh/mesh_types.hpp"
#include "mesher/mesh/quality.hpp"

namespace quadrille {

/// The measures of a mesh for a report.
struct MeshMeasures {
  QualitySummary quality;
  CriteriaSummary criteria;  ///< by the usual limits
};

/// Measures on all threads.
MeshMeasures measure(const ShellMesh& mesh);

/// The report: counts (nodes, quads, triangles), quality (q_min, q_mean, sj_min, sj_mean, jacobian_min,
/// inverted, irregular_percent, histogram, ...), criteria (how many quads fail the usual limits, by criterion
/// and face, and the worst), seconds by stage, cpu_seconds and peak_bytes of the process, faces (name,
/// status, quads, q_min, note, off_geometry: how many of its nodes are off the geometry, and how
/// far), off_geometry (node, distance) for all of them, suppressed_features, filled_holes, crossed_edges
/// (name, faces, the distance of the quads that cross it, a line to draw it by), groups with names of the CAD
/// file, warnings, versions of the libraries. \param scale see WriteOptions; lengths in the report
/// are millimeters.
nlohmann::json make_report(const ShellMesh& mesh, const MeshMeasures& measures,
                           const ExecutionContext& context, const std::filesystem::path& input,
                           const std::vector<std::string>& warnings = {}, double scale = 1);

/// The names of faces (dimension 2), edges (1) or vertices (0), as reports list them.
nlohmann::json entity_names(int dimension, const std::vector<int>& numbers);

/// Writes a report to a file that appears whole or not at all. Throws Error (failure).
void write_report(const nlohmann::json& report, const std::filesystem::path& path);

}  // namespace quadrille
