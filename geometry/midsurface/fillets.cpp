/// Adds the material of fillets, which lies beside the corners of middle surfaces, to the thickness of strips
/// along these corners.

#include <BOPAlgo_Builder.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_MapOfShape.hxx>
#include <TopoDS.hxx>
#include <algorithm>
#include <cmath>
#include <map>

#include "geometry/midsurface/joining.hpp"
#include "geometry/midsurface/widths.hpp"

namespace quadrille {

namespace {

/// The volume that a fillet adds to the corner between its walls. Its section is taken as an arc.
double volume_of(const SkinFace& fillet, const std::vector<FilletBorder>& borders) {
  double turn = 0, length = 0;
  for (const FilletBorder& border : borders) {
    turn = std::max(turn, border.outward.Angle(borders.front().outward));
    length += border.length / static_cast<double>(borders.size());
  }
  constexpr double least = 0.1, most = 3;  // radians; outside of this range it is not a corner
  if (turn < least || turn > most) return 0;
  const double width = fillet.area() / length, radius = width / turn;
  return radius * radius * (std::tan(0.5 * turn) - 0.5 * turn) * length;
}

double shell_volume(const std::vector<JoinedFace>& faces) {
  double volume = 0;
  for (const JoinedFace& face : faces) volume += face.step ? 0 : area_of(face.face) * face.coverage.mean;
  return volume;
}

/// The faces, cut where the fillets begin. \param strips set to 1 for each face of the result that lies along
/// a corner, where its wall has no side; to 0 for others.
std::vector<JoinedFace> cut_faces(const BOPAlgo_Builder& fuse, const Skin& skin,
                                  const std::vector<Wall>& walls, const std::vector<JoinedFace>& faces,
                                  std::vector<char>& strips) {
  constexpr double least_share = 0.25;
  std::vector<JoinedFace> result;
  for (const JoinedFace& whole : faces) {
    const TopTools_ListOfShape pieces = images(fuse, whole.face);
    for (const TopoDS_Shape& piece : pieces) {
      JoinedFace part = whole;
      part.face = TopoDS::Face(piece);
      bool strip = false;
      if (pieces.Extent() > 1 && !whole.step) {
        triangulate(part.face, 0.2 * walls[whole.wall].thickness);
        const Coverage coverage = coverage_of(part.face, walls[whole.wall], skin);
        strip = coverage.share < least_share;
        if (!strip) {
          part.coverage = coverage;
        } else if (!walls[whole.wall].fitted && whole.coverage.thickest > 1.001 * whole.coverage.thinnest) {
          part.coverage = coverage_past_sides(part.face, walls[whole.wall], skin);
          part.coverage.faces = whole.coverage.faces;
        }
      }
      result.push_back(part);
      strips.push_back(strip ? 1 : 0);
    }
  }
  return result;
}

bool touches(const TopoDS_Face& face, const TopTools_MapOfShape& edges) {
  for (TopExp_Explorer it(face, TopAbs_EDGE); it.More(); it.Next()) {
    if (edges.Contains(it.Current())) return true;
  }
  return false;
}

/// The strips, by index into `faces`, of the border's wall that end at the border.
std::vector<std::size_t> strips_at(const BOPAlgo_Builder& fuse, const FilletBorder& border,
                                   const std::vector<JoinedFace>& faces, const std::vector<char>& strips) {
  TopTools_MapOfShape edges;
  for (const TopoDS_Shape& image : images(fuse, border.fence)) {
    for (TopExp_Explorer it(image, TopAbs_EDGE); it.More(); it.Next()) edges.Add(it.Current());
  }
  std::vector<std::size_t> result;
  for (std::size_t i = 0; i < faces.size(); ++i) {
    if (strips[i] != 0 && faces[i].wall == border.wall && touches(faces[i].face, edges)) result.push_back(i);
  }
  return result;
}

/// Distributes a volume over the strips as additional thickness.
void thicken(const std::vector<std::size_t>& strips, double volume, int fillet,
             std::vector<JoinedFace>& faces) {
  double area = 0;
  for (const std::size_t i : strips) area += area_of(faces[i].face);
  for (const std::size_t i : strips) {
    Coverage& coverage = faces[i].coverage;
    for (double* of : {&coverage.mean, &coverage.thinnest, &coverage.thickest, &coverage.added})
      *of += volume / area;
    coverage.faces.insert(fillet);
  }
}

}  // namespace

void add_fillets(const Skin& skin, const std::vector<Wall>& walls, double volume,
                 std::vector<JoinedFace>& faces) {
  constexpr double worth_it = 0.01;
  const double missing = volume - shell_volume(faces);
  if (missing < worth_it * volume) return;
  const std::map<int, std::vector<FilletBorder>> fillets = find_fillet_borders(skin, walls);
  double held = 0;
  for (const auto& [fillet, borders] : fillets) held += volume_of(skin.faces()[fillet], borders);
  if (held < 0.5 * worth_it * volume) return;
  BOPAlgo_Builder fuse;
  fuse.SetNonDestructive(Standard_True);
  fuse.SetUseOBB(Standard_True);
  for (const JoinedFace& face : faces) fuse.AddArgument(face.face);
  for (const auto& [fillet, borders] : fillets) {
    for (const FilletBorder& border : borders) fuse.AddArgument(border.fence);
  }
  fuse.Perform();
  if (fuse.HasErrors()) return;  // the faces stay as they are
  std::vector<char> strips;
  std::vector<JoinedFace> cut = cut_faces(fuse, skin, walls, faces, strips);
  // Of a wall that tapers, the strips alone may hold more or less than they did as parts of it.
  const double share = std::clamp((volume - shell_volume(cut)) / held, 0.0, 1.0);
  for (const auto& [fillet, borders] : fillets) {
    const double each =
        share * volume_of(skin.faces()[fillet], borders) / static_cast<double>(borders.size());
    for (const FilletBorder& border : borders)
      thicken(strips_at(fuse, border, cut, strips), each, fillet, cut);
  }
  drop_traces(cut);
  orient_alike(cut);
  faces = std::move(cut);
}

}  // namespace quadrille
