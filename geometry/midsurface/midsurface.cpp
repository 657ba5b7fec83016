/// Runs the steps for each solid: skin, walls, ends, pieces, joints, and checks of thickness and volume.

#include "geometry/midsurface/midsurface.hpp"

#include <BRepAdaptor_Surface.hxx>
#include <BRepBuilderAPI_Copy.hxx>
#include <BRepGProp.hxx>
#include <BRepMesh_IncrementalMesh.hxx>
#include <BRepTools.hxx>
#include <GProp_GProps.hxx>
#include <Standard_Failure.hxx>
#include <TopTools_MapOfShape.hxx>
#include <TopoDS_Shell.hxx>
#include <algorithm>
#include <boost/pending/disjoint_sets.hpp>
#include <cmath>
#include <deque>
#include <map>
#include <memory>
#include <set>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "geometry/base/error.hpp"
#include "geometry/base/place_text.hpp"
#include "geometry/cad/bounding_box.hpp"
#include "geometry/cad/cad_shape.hpp"
#include "geometry/cad/shape_parts.hpp"
#include "geometry/midsurface/checks.hpp"
#include "geometry/midsurface/edge_uses.hpp"
#include "geometry/midsurface/fitted_middle.hpp"
#include "geometry/midsurface/joining.hpp"
#include "geometry/midsurface/middle_geometry.hpp"
#include "geometry/midsurface/plain_faces.hpp"
#include "geometry/midsurface/skin.hpp"
#include "geometry/midsurface/solids.hpp"
#include "geometry/midsurface/wall_pieces.hpp"
#include "geometry/midsurface/walls.hpp"
#include "geometry/midsurface/widths.hpp"

namespace quadrille {

namespace {

template <class T>
void append(std::vector<T>& list, const std::vector<T>& more) {
  list.insert(list.end(), more.begin(), more.end());
}

/// The numbers of some of the skin's faces, ascending. \param faces their indices
template <class Indices>
std::vector<int> numbers_of(const Skin& skin, const Indices& faces) {
  std::vector<int> result;
  result.reserve(faces.size());
  for (const int face : faces) result.push_back(skin.faces()[face].number());
  sort_unique(result);
  return result;
}

/// The middle surface of one solid.
struct SolidMiddle {
  const Skin& skin;
  const MidSurfaceOptions& options;
  std::string name;  ///< of the solid, in sentences
  std::vector<JoinedFace> faces{};
  std::vector<Wall> walls{};
  Fillets fillets{};
  CountedTwice twice{};
  std::set<int> narrow{};  ///< indices of the skin's faces beside walls that are not much wider than thick
  double volume = 0;
  std::vector<std::string> problems{};  ///< what was left out or is imprecise, and why

  /// The names of some of the skin's faces. \param faces their indices
  template <class Indices>
  std::string names_of(const Indices& indices) const {
    return face_names(numbers_of(skin, indices));
  }
  /// Adds a problem with options.partial; otherwise throws it as an error. \param given what the option
  /// gives.
  void tell(const std::string& problem, std::string_view given = "the walls that were found") {
    if (!options.partial) throw failure(name, fmt::format("{}; `partial` gives {}", problem, given));
    problems.push_back(problem);
  }
  /// Runs work; reports it where OpenCASCADE fails. \param done in words, "made". \return whether it
  /// succeeded.
  bool attempt(std::string_view done, const std::function<void()>& work) {
    try {
      work();
      return true;
    } catch (const Standard_Failure&) {  // its text does not help users
      tell(fmt::format("{}: its middle surface cannot be {}, since OpenCASCADE fails on its geometry; check "
                       "and heal its faces",
                       name, done),
           "the rest");
      return false;
    }
  }
};

/// The volume between the triangles of a solid's faces. \param deflection largest distance from the faces.
double volume_of_triangles(const TopoDS_Shape& solid, double deflection) {
  const TopoDS_Shape copy = BRepBuilderAPI_Copy(solid, Standard_True, Standard_False).Shape();
  const BRepMesh_IncrementalMesh triangulated(copy, deflection, Standard_False, 0.4, Standard_False);
  GProp_GProps properties;
  BRepGProp::VolumeProperties(copy, properties, Standard_False, Standard_False, Standard_True);
  return std::abs(properties.Mass());
}

/// The volume within about a thousandth. OpenCASCADE's integral with a tolerance is exact for plain faces,
/// but may be off by a fifth for B-splines, whatever tolerance it reports.
double volume_of(const TopoDS_Shape& solid) {
  constexpr double tolerance = 1e-3;
  const std::vector<TopoDS_Shape> faces = list_of(solid, TopAbs_FACE);
  GProp_GProps properties;
  if (std::all_of(faces.begin(), faces.end(), [](const TopoDS_Shape& face) {
        return BRepAdaptor_Surface(TopoDS::Face(face), Standard_False).GetType() < GeomAbs_BezierSurface;
      })) {
    BRepGProp::VolumeProperties(solid, properties, 1e-6);
    return std::abs(properties.Mass());
  }
  const double error = BRepGProp::VolumePropertiesGK(solid, properties, tolerance);
  if (error >= 0 && error < 2 * tolerance) return std::abs(properties.Mass());
  double deflection = 1e-3 * std::sqrt(box_of(solid).SquareExtent());
  double volume = 0, coarse = HUGE_VAL;
  for (int i = 0; i < 5 && std::abs(volume - coarse) >= tolerance * volume; ++i, deflection *= 0.25) {
    coarse = volume;
    volume = volume_of_triangles(solid, deflection);
  }
  return volume;
}

/// A group number for each wall. Walls that bend into each other, or share a face as the halves of a tapered
/// flange do, form one group and have one width.
std::vector<int> width_groups(const std::vector<Wall>& walls, const std::vector<WallEnd>& ends) {
  boost::disjoint_sets_with_storage<> together(walls.size());
  for (const WallEnd& end : ends) together.union_set(end.wall, end.next);
  std::map<int, int> first;  // wall of each face
  for (int wall = 0; wall < static_cast<int>(walls.size()); ++wall) {
    for (const int next : walls[wall].goes_on) together.union_set(wall, next);
    for (const int face : both_sides(walls[wall]))
      together.union_set(first.try_emplace(face, wall).first->second, wall);
  }
  std::vector<int> group(walls.size());
  for (std::size_t i = 0; i < walls.size(); ++i) group[i] = static_cast<int>(together.find_set(i));
  return group;
}

/// The thickness of connected faces over their width.
double thickness_over_width(const std::vector<JoinedFace>& part) {
  double area = 0, volume = 0, perimeter = 0;  // the perimeter without holes
  TopTools_MapOfShape outer;
  for (const JoinedFace& face : part) {
    const double own = area_of(face.face);
    area += own;
    volume += own * face.coverage.mean;
    for (const TopoDS_Edge& edge : edges_of(BRepTools::OuterWire(face.face))) outer.Add(edge);
  }
  // The edge of a pocket is inner to the face around it, outer to the next one.
  for (const auto& [edge, around] : EdgeUses(part))
    if (around.size() == 1 && outer.Contains(edge)) perimeter += length_of(edge);
  return volume / (width_of(area, perimeter) * area);
}

/// Walls that are so many times as wide as thick make a shell that is within 3 % of the solid:
/// docs/midsurface.md.
constexpr double slender = 12;

/// For each face, the thickness of its connected part over the part's width.
std::vector<double> thickness_over_width(const SolidMiddle& middle, const std::vector<WallEnd>& ends) {
  std::vector<double> result(middle.faces.size(), 0);
  for (const auto& part : connected_parts(middle.faces, width_groups(middle.walls, ends))) {
    std::vector<JoinedFace> own;
    own.reserve(part.size());
    for (const std::size_t i : part) own.push_back(middle.faces[i]);
    const double ratio = thickness_over_width(own);
    for (const std::size_t i : part) result[i] = ratio;
  }
  return result;
}

/// The sentence for a solid that is not thin.
std::string not_thin_sentence(const std::string& solid, const MidSurfaceOptions& options) {
  return fmt::format(
      "{} is not a thin solid: walls thinner than {:g} times their width do not make up its volume; mesh it "
      "as a solid, or its skin with quadrille mesh",
      solid, options.thickest);
}

/// The walls with a B-spline middle that continue into others of that kind. They are nearly tangent to each
/// other along curves: OpenCASCADE takes seconds to cut each of them, and loses some.
std::set<int> blended_walls(const std::vector<Wall>& walls, const std::vector<WallEnd>& ends) {
  std::set<int> result;
  for (const WallEnd& end : ends) {
    if (walls[end.wall].ends && walls[end.next].ends) result.insert({end.wall, end.next});
  }
  return result;
}

/// The sentence that names the walls that cannot be joined.
std::string cannot_join(const SolidMiddle& middle, const std::set<int>& blended) {
  std::vector<int> faces;
  for (const int wall : blended) append(faces, both_sides(middle.walls[wall]));
  return fmt::format("{}: {} free-form walls continue into each other, which cannot be joined yet: {}",
                     middle.name, blended.size(), middle.names_of(faces));
}

/// If most of the volume of the middle surface is in walls that are not thin, throws an error; with
/// options.partial keeps the thin walls and reports the others. Leaves nothing of a solid that is not thin.
void drop_thick(const std::vector<WallEnd>& ends, SolidMiddle& middle) {
  const std::vector<double> ratios = thickness_over_width(middle, ends);
  double all = 0, thick_volume = 0, narrow_volume = 0;
  std::set<int> faces;
  std::vector<JoinedFace> thin;
  for (std::size_t i = 0; i < ratios.size(); ++i) {
    const JoinedFace& face = middle.faces[i];
    const std::set<int>& around = face.coverage.faces;
    const double volume = area_of(face.face) * face.coverage.mean;
    all += volume;
    if (ratios[i] > 1 / slender && !face.step) {
      narrow_volume += volume;
      middle.narrow.insert(around.begin(), around.end());
    }
    if (ratios[i] > middle.options.thickest) {
      thick_volume += volume;
      faces.insert(around.begin(), around.end());
    } else {
      thin.push_back(face);
    }
  }
  constexpr double hardly = 0.05;
  const bool is_thin = thick_volume <= 0.5 * all && all > 0;
  if (!is_thin || narrow_volume <= hardly * all) middle.narrow.clear();
  if (is_thin) return;
  middle.faces = std::move(thin);
  if (middle.faces.empty()) return;
  middle.tell(fmt::format("{} is thin only in places: {} are farther apart than {:g} times their width",
                          middle.name, middle.names_of(faces), middle.options.thickest));
}

/// Reports which fitted walls of the middle surface miss the tolerance even on the finest grid.
void check_fits(SolidMiddle& middle) {
  const double most = most_tolerances * middle.options.tolerance;
  std::set<int> checked;
  for (const JoinedFace& face : middle.faces) {
    const Wall& wall = middle.walls[face.wall];
    if (face.step || wall.off <= most * wall.thickness || !checked.insert(face.wall).second) continue;
    middle.tell(
        fmt::format("{}: the middle between {} is off by up to {} mm, more than {:g} % of the thickness",
                    middle.name, middle.names_of(both_sides(wall)), number_text(wall.off), 100 * most));
  }
}

/// \param told called with the fraction that is done. \param result with the solid's name. It gets no faces
/// if the solid is not thin.
void make_middle(const ExecutionContext& context, const std::function<void(double)>& told,
                 SolidMiddle& result) {
  const Skin& skin = result.skin;
  const double tolerance = result.options.tolerance;
  result.volume = volume_of(skin.solid());
  const std::vector<int> surfaces = surface_numbers(skin);
  result.walls = find_walls(skin, surfaces, tolerance, context);
  if (result.walls.empty()) return;
  const std::vector<WallEnd> ends = find_wall_ends(skin, result.walls, surfaces, context);
  constexpr std::size_t most_blended = 4;
  std::set<int> blended = blended_walls(result.walls, ends);
  if (blended.size() <= most_blended) blended.clear();
  if (!blended.empty()) result.tell(cannot_join(result, blended));
  std::vector<WallEnd> fences = find_rim_ends(skin, result.walls, surfaces, context);
  fences.insert(fences.end(), ends.begin(), ends.end());
  std::vector<std::vector<TopoDS_Face>> pieces(result.walls.size());
  for (std::size_t wall = 0; wall < pieces.size(); ++wall) {
    told(0.5 + 0.4 * static_cast<double>(wall) / static_cast<double>(pieces.size()));
    if (blended.count(static_cast<int>(wall)) != 0) continue;
    try {
      pieces[wall] = wall_pieces(skin, result.walls, static_cast<int>(wall), fences, context);
    } catch (const Standard_Failure&) {  // its text does not help users
      result.tell(fmt::format(
          "{}: the wall between {} cannot be cut out of its middle surface; heal or simplify these faces",
          result.name, result.names_of(both_sides(result.walls[wall]))));
    }
  }
  told(0.9);
  result.faces = join_walls(skin, result.walls, ends, pieces, tolerance, context);
  result.fillets = add_fillets(skin, result.walls, result.volume, context, result.faces);
  drop_thick(ends, result);
  check_fits(result);
}

/// A compound with a shell for each connected part; with single faces if more than two of them share an edge.
TopoDS_Compound assemble(const std::vector<JoinedFace>& faces) {
  std::set<std::size_t> branched;  // faces, one at each edge of more than two
  for (const auto& [edge, around] : EdgeUses(faces))
    if (around.size() > 2) branched.insert(around.front().face);
  std::vector<TopoDS_Shape> result;
  const BRep_Builder builder;
  for (const std::vector<std::size_t>& part : connected_parts(faces)) {
    TopoDS_Shell shell;
    builder.MakeShell(shell);
    for (const std::size_t i : part) builder.Add(shell, faces[i].face);
    if (std::none_of(part.begin(), part.end(), [&](std::size_t i) { return branched.count(i) != 0; }))
      result.push_back(shell);
    else
      for (const std::size_t i : part) result.push_back(faces[i].face);
  }
  return compound_of(result);
}

/// How area times thickness compares with the volume, in words.
std::string volume_sentence(const MidSurface& result, const std::string& name, double share) {
  std::string sentence = fmt::format(
      "{} {}: area times thickness of its middle surface is {:.1f} % of its volume", name,
      share < 1 ? "is thin only in places" : "has walls that overlap too much where they meet", 100 * share);
  if (!result.unpaired.empty()) sentence += "; without a partner: " + face_names(result.unpaired);
  if (!result.uneven.empty())
    sentence +=
        "; rays through the solid measure another thickness at the result's " + face_names(result.uneven);
  return sentence;
}

/// The sentence for what area times thickness counts twice. \param numbers of the faces there.
std::string twice_sentence(const CountedTwice& twice, double volume, const std::string& name,
                           const std::vector<int>& numbers) {
  std::vector<std::string> places;
  const auto add = [&](double part, std::string_view place) {
    if (part > 1e-3 * volume) places.push_back(fmt::format("{:.1f} % {}", 100 * part / volume, place));
  };
  add(twice.junctions, "where walls meet");
  add(twice.fillets, "in fillets, each of which stiffens every wall beside it");
  add(twice.steps, "in the faces that join the walls of a step");
  return fmt::format(
      "{}: area times thickness counts {:.1f} % of the volume twice ({}), at the result's {}: the mass of "
      "the shell is too large by that; scale the density there if it matters",
      name, 100 * twice.sum() / volume, fmt::join(places, ", "), face_names(numbers));
}

/// Compares area times thickness with the volume: what differs is a problem or a warning. What is counted
/// twice does not compensate for what is missing elsewhere. \param numbers of the faces of the result.
void check_volume(const SolidMiddle& middle, const TopTools_IndexedMapOfShape& numbers, MidSurface& result,
                  std::vector<std::string>& problems) {
  constexpr double most_missing = 0.05, most_twice = 0.1, worth_telling = 0.02;
  const CountedTwice& twice = middle.twice;
  const double once = (result.shell_volume - twice.sum()) / result.volume;
  const double overlapping = once + twice.junctions / result.volume;
  if (once < 1 - most_missing || overlapping > 1 + most_twice) {
    const double share = overlapping > 1 + most_twice ? overlapping : once;
    problems.push_back(volume_sentence(result, middle.name, share));
  } else if (once < 1 - worth_telling || once > 1 + worth_telling) {
    result.warnings.push_back(volume_sentence(result, middle.name, once));
  }
  if (twice.sum() <= worth_telling * result.volume) return;
  std::set<std::pair<double, int>> order;  // the largest volume first
  for (const auto& [face, volume] : twice.faces) {
    if (volume > 1e-3 * result.volume) order.emplace(-volume, numbers.FindIndex(middle.faces[face].face));
  }
  std::vector<int> faces;
  faces.reserve(order.size());
  for (const auto& [volume, number] : order) faces.push_back(number);
  result.warnings.push_back(twice_sentence(twice, result.volume, middle.name, faces));
}

/// Whether a face of the solid goes on in the plane of a wall's side: no fillet or slope does.
bool in_plane_of_side(const SolidMiddle& middle, int number) {
  const auto& faces = middle.skin.faces();
  const auto face = std::find_if(faces.begin(), faces.end(),
                                 [&](const SkinFace& other) { return other.number() == number; });
  if (face == faces.end() || face->surface().GetType() != GeomAbs_Plane) return false;
  return std::any_of(middle.walls.begin(), middle.walls.end(), [&](const Wall& wall) {
    const std::vector<int> sides = both_sides(wall);
    return std::any_of(sides.begin(), sides.end(),
                       [&](int side) { return on_one_surface(*face, faces[side], middle.skin.size()); });
  });
}

/// Where free edges end inside the material, by faces of the solid, and what to do about it.
std::string stray_sentence(const MidSurface& result, const SolidMiddle& middle) {
  constexpr std::size_t places_shown = 4;
  std::vector<std::string> places;
  for (const std::vector<int>& faces : result.stray_faces) {
    const std::string place = faces.size() > 1 ? fmt::format("between Face{} and Face{}", faces[0], faces[1])
                                               : "at " + face_names(faces);
    if (std::find(places.begin(), places.end(), place) == places.end()) places.push_back(place);
  }
  const std::size_t more = places.size() - std::min(places_shown, places.size());
  places.resize(places.size() - more);
  if (more > 0) places.push_back(fmt::format("and in {} more place{}", more, more == 1 ? "" : "s"));
  std::vector<int> alone = result.unpaired;  // the faces there that belong to no wall
  std::erase_if(alone, [&](int face) {
    return in_plane_of_side(middle, face) ||
           std::none_of(result.stray_faces.begin(), result.stray_faces.end(), [&](const auto& faces) {
             return std::find(faces.begin(), faces.end(), face) != faces.end();
           });
  });
  const std::string advice =
      alone.empty() ? ""
                    : "; without a partner: " + face_names(alone) + "; remove it if it is a fillet or slope";
  const bool one = result.stray_edges.size() == 1;
  return fmt::format(
      "{}: {} of the middle surface {} inside the material {} (faces of the solid): the walls there are not "
      "joined, or one is extended too far{}",
      middle.name, one ? "a free edge" : fmt::format("{} free edges", result.stray_edges.size()),
      one ? "ends" : "end", fmt::join(places, ", "), advice);
}

/// The parts into which the middle surface of a solid falls, by faces of the solid.
std::string parts_sentence(const SolidMiddle& middle) {
  const auto all = connected_parts(middle.faces);
  constexpr std::size_t parts_shown = 4;
  std::vector<std::string> parts;
  for (std::size_t p = 0; p < std::min(parts_shown, all.size()); ++p) {
    std::set<int> faces;
    for (const std::size_t i : all[p])
      faces.insert(middle.faces[i].coverage.faces.begin(), middle.faces[i].coverage.faces.end());
    parts.push_back(middle.names_of(faces));
  }
  if (all.size() > parts_shown) parts.push_back(fmt::format("and {} more", all.size() - parts_shown));
  return fmt::format(
      "{}: the middle surface is in {} separate parts although the solid is in one piece: between {}",
      middle.name, all.size(), fmt::join(parts, "; "));
}

/// One sentence for each check of a solid that failed. \param numbers of the faces of the result.
std::vector<std::string> find_problems(const SolidMiddle& middle, const TopTools_IndexedMapOfShape& numbers,
                                       MidSurface& checked) {
  std::vector<std::string> problems;
  check_volume(middle, numbers, checked, problems);
  if (middle.fillets.softer > 0)
    checked.warnings.push_back(fmt::format(
        "{}: the thickness beside the fillets or welds at {} holds less than they add to the stiffness: "
        "walls that bend or twist there are up to {:.0f} % too soft; mesh the solid if that matters",
        middle.name, middle.names_of(middle.fillets.left_out), 100 * middle.fillets.softer));
  if (!middle.narrow.empty())
    checked.warnings.push_back(fmt::format(
        "{}: walls are less than {:g} times as wide as thick (between {}): where such walls bend across, or "
        "the section distorts, a shell can be some 5 % too soft, more where they are narrower still; compare "
        "it with a mesh of the solid",
        middle.name, slender, middle.names_of(middle.narrow)));
  std::vector<int> hollow;
  for (const std::size_t face : hollow_joints(middle.skin, middle.faces))
    hollow.push_back(numbers.FindIndex(middle.faces[face].face));
  if (!hollow.empty())
    checked.warnings.push_back(fmt::format(
        "{}: hollow sections meet at the result's {}: a shell has no depth there and can be some 15 % too "
        "soft under loads that bend the walls of the joint; compare it with a mesh of the solid",
        middle.name, face_names(hollow)));
  if (checked.parts != 1) problems.push_back(parts_sentence(middle));
  if (!checked.stray_edges.empty()) problems.push_back(stray_sentence(checked, middle));
  return problems;
}

/// The checks of one solid's middle, and its figures. Writes the descriptions of its faces to `result`.
/// \param numbers of the faces of the result.
MidSurface check_solid(const SolidMiddle& middle, int solid, const TopTools_IndexedMapOfShape& numbers,
                       const ExecutionContext& context, MidSurface& result) {
  MidSurface checked{result.model};
  for (const auto& [joined, own, step, coverage] : middle.faces) {
    context.check();
    const Wall& wall = middle.walls[own];
    triangulate_middle(joined, wall.thickness);  // for samples
    MiddleFace& face = result.faces.at(numbers.FindIndex(joined) - 1);
    face = {.thinnest = coverage.thinnest,
            .thickest = coverage.thickest,
            .thickness = coverage.mean,
            .area = area_of(joined),
            .solid_faces = numbers_of(middle.skin, coverage.faces),
            .solid = solid,
            .step = step,
            .fitted = wall.fitted && !step};
    if (face.fitted) face.off = wall.off;
    checked.shell_volume += face.area * face.thickness;
  }
  checked.parts = static_cast<int>(connected_parts(middle.faces).size());
  checked.volume = middle.volume;
  check_rims(middle.skin, middle.walls, middle.faces, map_of(result.model.shape().shape, TopAbs_EDGE),
             context, checked);
  checked.counted_twice = middle.twice.sum();
  for (const std::size_t i : faces_of_wrong_thickness(middle.skin, middle.walls, middle.faces, context))
    checked.uneven.push_back(numbers.FindIndex(middle.faces[i].face));
  sort_unique(checked.unpaired);
  return checked;
}

/// Adds the checks of one solid to those of all.
void add_checked(const MidSurface& checked, MidSurface& result) {
  result.volume += checked.volume;
  result.shell_volume += checked.shell_volume;
  result.counted_twice += checked.counted_twice;
  result.solids += 1;
  result.parts += checked.parts;
  result.free_edges += checked.free_edges;
  append(result.rims, checked.rims);
  append(result.stray_edges, checked.stray_edges);
  append(result.stray_faces, checked.stray_faces);
  append(result.unpaired, checked.unpaired);
  append(result.uneven, checked.uneven);
  append(result.warnings, checked.warnings);
}

/// Describes the faces and checks them, solid by solid.
void check_solids(std::vector<SolidMiddle>& middles, ExecutionContext& context, MidSurface& result) {
  const auto& shape = result.model.shape().shape;
  const TopTools_IndexedMapOfShape numbers = map_of(shape, TopAbs_FACE);
  result.faces.resize(numbers.Extent());
  for (std::size_t solid = 0; solid < middles.size(); ++solid) {
    context.check();
    SolidMiddle& middle = middles[solid];
    const auto check = [&] {
      middle.twice = counted_twice(middle.walls, middle.faces, middle.fillets);
      MidSurface checked = check_solid(middle, static_cast<int>(solid) + 1, numbers, context, result);
      for (const std::string& problem : find_problems(middle, numbers, checked))
        middle.tell(problem, "it nevertheless");
      add_checked(checked, result);
    };
    if (!middle.faces.empty()) middle.attempt("checked", check);
    append(result.problems, middle.problems);
  }
  BRepTools::Clean(shape);  // removes the triangles used for sampling
  std::sort(result.rims.begin(), result.rims.end(),
            [](const MiddleRim& a, const MiddleRim& b) { return a.edge < b.edge; });
  sort_unique(result.unpaired);
}

/// See MidSurface::thickness_at. It keeps the skins.
std::function<double(int, const Vector3&)> thickness_source(const std::vector<SolidMiddle>& middles,
                                                            std::shared_ptr<const std::deque<Skin>> skins,
                                                            const MidSurface& result) {
  struct Face {
    Wall wall;
    Coverage coverage;
  };
  const TopTools_IndexedMapOfShape numbers = map_of(result.model.shape().shape, TopAbs_FACE);
  const auto faces = std::make_shared<std::vector<Face>>(result.faces.size());  // by number minus 1
  for (const SolidMiddle& middle : middles) {
    for (const JoinedFace& joined : middle.faces) {
      const int index = numbers.FindIndex(joined.face) - 1;
      Face& face = (*faces)[index] = {middle.walls[joined.wall], joined.coverage};
      if (!varies(result.faces[index])) face.coverage.thickest = face.coverage.thinnest;
    }
  }
  return [skins = std::move(skins), faces](int face, const Vector3& point) {
    const auto& [wall, coverage] = faces->at(face - 1);
    return thickness_at(coverage, wall, gp_Pnt(point.x(), point.y(), point.z()));
  };
}

/// The middle surface of each solid. \param name of the model.
std::vector<SolidMiddle> make_middles(const std::deque<Skin>& skins, const std::string& name,
                                      const MidSurfaceOptions& options, ExecutionContext& context) {
  std::vector<SolidMiddle> result;
  for (const Skin& skin : skins) {
    const auto told = [&, done = static_cast<double>(result.size())](double fraction) {
      context.report(Stage::midsurface, (done + fraction) / static_cast<double>(skins.size()));
    };
    told(0);
    SolidMiddle& middle = result.emplace_back(SolidMiddle{skin, options, name});
    if (skins.size() > 1) {
      std::vector<int> numbers;
      for (const SkinFace& face : skin.faces()) numbers.push_back(face.number());
      sort_unique(numbers);
      middle.name = fmt::format("{}: solid {} ({})", name, result.size(), face_names(numbers));
    }
    if (!middle.attempt("made", [&] { make_middle(context, told, middle); })) middle.faces.clear();
  }
  return result;
}

MidSurface make(const CadModel& model, const MidSurfaceOptions& options, ExecutionContext& context) {
  context.report(Stage::midsurface, 0);
  const std::string& name = model.shape().name;
  const TopoDS_Shape shape = with_plain_faces(BRepBuilderAPI_Copy(model.shape().shape).Shape());
  const auto skins = std::make_shared<const std::deque<Skin>>(skins_of(shape, options.join, context));
  if (skins->empty())
    throw failure(name, fmt::format("{} has no solid; a middle surface is made of solids", name));
  std::vector<SolidMiddle> middles = make_middles(*skins, name, options, context);
  std::vector<JoinedFace> all;
  std::vector<std::string> problems;
  for (const SolidMiddle& middle : middles) {
    append(all, middle.faces);
    append(problems, middle.problems);
  }
  if (all.empty())
    throw failure(name, problems.empty() ? not_thin_sentence(name, options) : problems.front());
  MidSurface result{CadModel(std::make_shared<CadShape>(assemble(all), name + " (middle surface)"))};
  result.face_names = model.face_names();
  check_solids(middles, context, result);
  for (const SolidMiddle& middle : middles) {
    if (middle.faces.empty() && middle.problems.empty())
      result.warnings.push_back("left out: " + not_thin_sentence(middle.name, options));
  }
  result.thickness_at = thickness_source(middles, skins, result);
  return result;
}

}  // namespace

MidSurface midsurface(const CadModel& model, const MidSurfaceOptions& options, ExecutionContext& context) {
  const StageTimer timer(context, Stage::midsurface);
  try {
    return make(model, options, context);
  } catch (const Standard_Failure&) {  // its text does not help users
    throw failure(model.shape().name,
                  fmt::format("{}: its middle surface cannot be made, since OpenCASCADE fails on its "
                              "geometry; check and heal its faces, or process its solids one by one",
                              model.shape().name));
  }
}

}  // namespace quadrille
