#pragma once
/// Lines of edges along which faces that are not grids get rows of given heights. Internal.

#include <array>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "geometry/cad/cad_shape.hpp"
#include "geometry/sizing/edge_spacing.hpp"
#include "geometry/sizing/sizing_options.hpp"
#include "mesher/edges/face_sides.hpp"
#include "mesher/edges/tiny_features.hpp"

namespace quadrille {

/// The total of heights or lengths.
double sum_of(const std::vector<double>& lengths);

/// Heights of the rows that layers request.
std::vector<double> heights_of(const SizeLayers& layers);

/// Consecutive edges of a wire with rows beside them.
struct RowLine {
  enum class End {
    none,   ///< the line is closed
    meets,  ///< the rows end on the edge beside the line: its first segments are as long as they need
    free    ///< that edge runs away at a large angle: the rows end in a separate line
  };
  std::vector<EdgeId> edges;                      ///< in the order of the wire
  std::vector<double> heights;                    ///< of the rows, from the edges inward
  std::array<End, 2> ends{End::none, End::none};  ///< before the first edge, and after the last
  bool is_closed() const { return ends[0] == End::none; }
};

using RowLinesOfFaces = std::map<FaceId, std::vector<RowLine>>;

/// Whether a face has rows along a line that is not closed.
bool has_chain(const RowLinesOfFaces& lines, FaceId face);

/// The lengths of the segments at both ends of an edge where rows end on it, from the end inward.
struct EdgeHeads {
  std::vector<double> first, last;
  int segments() const { return static_cast<int>(first.size() + last.size()); }
  /// The places of an edge's nodes as shares of its length; none if the heads leave no segment between them.
  /// \param place_of gives the place of the k-th node of so many segments between the heads
  std::vector<double> shares(double length, int segments,
                             const std::function<double(int k, int between)>& place_of) const;
};

struct RowLines {
  RowLinesOfFaces of_faces;
  EdgeFlags along;  ///< 1 = some face has rows along the edge
  std::map<EdgeId, EdgeHeads> heads;
  /// Vertices where rows end beside faces without rows: sizes around them follow the heights.
  std::map<VertexId, SizeLayers> steps;
  std::map<int, std::string> without;  ///< (edge numbers) why an edge with layers has no rows
};

/// Finds the lines in faces that are not grids: closed loops and open chains of edges with the same layers.
/// At the ends of a chain, the rows meet the next edge if the face's angle there is between 40 and 140
/// degrees, and end freely if it is larger. An edge on which they end must have room for them in nine tenths
/// of its length and no division or layers of its own, and the face must use it once. \param sides outlines
/// \param used 1 = the face is meshed \param prescribed divisions of edges, which stay
RowLines find_row_lines(const CadShape& shape, const FaceOutlines& sides, const FaceFlags& used,
                        const TinyFeatures& tiny, const PrescribedEdges& prescribed,
                        const ByElement<SizeLayers>& layers);

}  // namespace quadrille
