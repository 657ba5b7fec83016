#pragma once
/// Reading with OpenCASCADE's readers of exchange formats, with the same result in every run.

#include <BRepLib.hxx>
#include <IFSelect_ReturnStatus.hxx>
#include <Interface_Static.hxx>
#include <ShapeAlgo.hxx>
#include <ShapeAlgo_AlgoContainer.hxx>
#include <ShapeAlgo_ToolContainer.hxx>
#include <ShapeFix_Face.hxx>
#include <ShapeFix_Shape.hxx>
#include <Standard_Failure.hxx>
#include <TopTools_DataMapOfShapeInteger.hxx>
#include <TopTools_MapOfShape.hxx>
#include <TopoDS_Vertex.hxx>
#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "geometry/base/module_loader.hpp"
#include "geometry/cad/face_names.hpp"
#include "geometry/cad/shape_parts.hpp"

namespace quadrille {

/// OpenCASCADE's shape healing, on a shape whose plane faces keep the parametric curves of their edges:
/// without them, every step of healing, and of meshing after it, would compute them again.
class Healing : public ShapeFix_Shape {
 public:
  /// The readers call this last before they heal, when they have handed over the shape.
  void SetMaxTolerance(const double tolerance) override {
    ShapeFix_Shape::SetMaxTolerance(tolerance);
    for (TopExp_Explorer face(Shape(), TopAbs_FACE); face.More(); face.Next())
      for (TopExp_Explorer edge(face.Current(), TopAbs_EDGE); edge.More(); edge.Next())
        BRepLib::BuildPCurveForEdgeOnPlane(TopoDS::Edge(edge.Current()), TopoDS::Face(face.Current()));
  }
};

class HealingTools : public ShapeAlgo_ToolContainer {
 public:
  /// \param with_loops whether self-touching wires are cut into pieces, or left as they are in the file.
  explicit HealingTools(bool with_loops) : with_loops_(with_loops) {}
  Handle(ShapeFix_Shape) FixShape() const override {
    Handle(ShapeFix_Shape) fix = new Healing;
    if (!with_loops_) fix->FixFaceTool()->FixLoopWiresMode() = Standard_False;
    return fix;
  }

 private:
  bool with_loops_;
};

/// While it exists, readers heal with HealingTools, whatever a settings file says (CSF_STEPDefaults,
/// CSF_IGESDefaults). It restores the previous state, since the surrounding program may read files too.
class HealingScope {
 public:
  explicit HealingScope(bool with_loops) {
    ShapeAlgo::Init();
    tools_ = ShapeAlgo::AlgoContainer()->ToolContainer();
    ShapeAlgo::AlgoContainer()->SetToolContainer(new HealingTools(with_loops));
    for (std::size_t i = 0; i < settings.size(); ++i) {
      before_[i] = Interface_Static::CVal(settings[i]);
      Interface_Static::SetCVal(settings[i], "none");
    }
  }
  ~HealingScope() {
    for (std::size_t i = 0; i < settings.size(); ++i)
      Interface_Static::SetCVal(settings[i], before_[i].c_str());
    ShapeAlgo::AlgoContainer()->SetToolContainer(tools_);
  }
  HealingScope(const HealingScope&) = delete;
  HealingScope& operator=(const HealingScope&) = delete;

 private:
  static constexpr std::array settings{"read.step.resource.name", "read.iges.resource.name"};
  Handle(ShapeAlgo_ToolContainer) tools_;
  std::array<std::string, settings.size()> before_;
};

/// Whether the wires of a face touch themselves or each other at a vertex, and an edge bounds the face from
/// both sides (a seam or a slit). ShapeFix_Face::FixLoopWire then joins pieces by ends that TopExp::Vertices
/// takes from a hash map of addresses, so the order and numbers of the edges change from run to run.
inline bool touches_beside_seam(const TopoDS_Shape& face) {
  TopTools_MapOfShape once, twice;
  for (const TopoDS_Edge& edge : edges_of(face))
    if (!once.Add(edge)) twice.Add(edge);
  if (twice.IsEmpty()) return false;
  TopTools_DataMapOfShapeInteger ends;
  for (const TopoDS_Edge& edge : edges_of(face)) {
    if (twice.Contains(edge)) continue;
    TopoDS_Vertex first, last;
    TopExp::Vertices(edge, first, last);
    for (const TopoDS_Vertex& vertex : {first, last}) {
      if (vertex.IsNull()) continue;
      if (!ends.IsBound(vertex)) ends.Bind(vertex, 0);
      if (++ends.ChangeFind(vertex) > 2) return true;
    }
  }
  return false;
}

/// \param names_of(reader, shape) the names of its faces. \returns whether the file is readable.
template <class Reader, class NamesOf>
bool read_file(const std::string& path, bool with_loops, NamedShape& read, NamesOf names_of) {
  Reader reader;  // defines the settings
  const HealingScope healing(with_loops);
  Interface_Static::SetCVal("xstep.cascade.unit", "MM");
  if (reader.ReadFile(path.c_str()) != IFSelect_RetDone) return false;
  reader.TransferRoots();
  read.shape = reader.OneShape();
  read.names = names_of(reader, read.shape);
  return true;
}

/// Reads a file. Where healing may give another shape in every run, reads it again without that healing.
/// \returns an empty string, or a sentence that says what went wrong.
template <class Reader, class NamesOf>
std::string transfer(const std::string& path, const char* format, NamedShape& read, NamesOf names_of) {
  try {
    bool readable = read_file<Reader>(path, true, read, names_of);
    const auto faces = readable ? list_of(read.shape, TopAbs_FACE) : std::vector<TopoDS_Shape>();
    if (std::any_of(faces.begin(), faces.end(), touches_beside_seam))
      readable = read_file<Reader>(path, false, read, names_of);
    return readable ? std::string() : fmt::format("{} is not a readable {} file", path, format);
  } catch (const Standard_Failure& problem) {
    return fmt::format("{} could not be read as {} ({})", path, format, problem.GetMessageString());
  }
}

}  // namespace quadrille
