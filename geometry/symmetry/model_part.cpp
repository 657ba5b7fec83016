#include "geometry/symmetry/model_part.hpp"

#include <BRepAdaptor_Surface.hxx>
#include <BRepAlgoAPI_Splitter.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_Transform.hxx>
#include <BRepGProp.hxx>
#include <BRepTopAdaptor_FClass2d.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <GProp_GProps.hxx>
#include <Message_ProgressIndicator.hxx>
#include <ShapeAnalysis_Curve.hxx>
#include <Standard_Failure.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedDataMapOfShapeListOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Compound.hxx>
#include <gp_Pln.hxx>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numeric>
#include <utility>

#include "geometry/surfaces/edge_curve.hpp"
#include "geometry/surfaces/face_surface.hpp"

namespace quadrille {

namespace {

/// Stops OpenCASCADE's cutting when the work was cancelled.
class Asking : public Message_ProgressIndicator {
 public:
  explicit Asking(const ExecutionContext& context) : context_(context) {}
  Standard_Boolean UserBreak() override {
    try {
      context_.check();
    } catch (const Error&) {
      return Standard_True;
    }
    return Standard_False;
  }
  void Show(const Message_ProgressScope&, const Standard_Boolean) override {}

 private:
  const ExecutionContext& context_;
};

TopoDS_Face own_face(const CadFace& face) {
  return TopoDS::Face(face.face.Oriented(face.reversed ? TopAbs_REVERSED : TopAbs_FORWARD));
}

double area_of(const TopoDS_Shape& face) {
  GProp_GProps properties;
  BRepGProp::SurfaceProperties(face, properties);
  return std::abs(properties.Mass());
}

class Cutter {
 public:
  Cutter(const CadModel& model, std::vector<MirrorPlane> planes, const ExecutionContext& context)
      : shape_(model.shape()), context_(context), planes_(std::move(planes)) {
    for (unsigned image = 0; image < 1U << planes_.size(); ++image) images_.push_back(composed(image));
    find_components();
  }

  std::optional<ModelPart> run() {
    if (!cut()) return std::nullopt;
    keep_positive();
    if (kept_.empty()) return std::nullopt;
    auto part = std::make_shared<CadShape>(compound_, shape_.name);
    if (part->faces.size() != kept_.size() || part->edges.size() != count(TopAbs_EDGE) ||
        part->vertices.size() != count(TopAbs_VERTEX))
      return std::nullopt;
    ModelPart result{CadModel(part), planes_, {}, {}, {}};
    find_in_planes(*part, result);
    for (unsigned image = 0; image < images_.size(); ++image)
      result.images.push_back(named(*part, image, result));
    if (!makes_up_model(*part, result)) return std::nullopt;
    return result;
  }

 private:
  /// The combined mirror image in all planes of an image, without normal and offset.
  MirrorPlane composed(unsigned image) const {
    MirrorPlane result;
    const auto identity = [](std::size_t n) {
      std::vector<int> numbers(n);
      for (std::size_t i = 0; i < n; ++i) numbers[i] = static_cast<int>(i);
      return numbers;
    };
    result.faces = identity(shape_.faces.size());
    result.edges = identity(shape_.edges.size());
    result.vertices = identity(shape_.vertices.size());
    result.turned.assign(shape_.faces.size(), 0);
    const auto map = [](std::vector<int>& numbers, const std::vector<int>& images) {
      for (int& number : numbers) number = number < 0 ? -1 : images[number];
    };
    for (std::size_t i = 0; i < planes_.size(); ++i) {
      if ((image >> i & 1U) == 0) continue;
      for (std::size_t face = 0; face < result.faces.size(); ++face)
        result.turned[face] ^= planes_[i].turned[result.faces[face]];
      map(result.faces, planes_[i].faces);
      map(result.edges, planes_[i].edges);
      map(result.vertices, planes_[i].vertices);
    }
    return result;
  }

  gp_Trsf transformation(unsigned image) const {
    gp_Trsf all;
    for (std::size_t i = 0; i < planes_.size(); ++i) {
      if ((image >> i & 1U) == 0) continue;
      const Vector3& n = planes_[i].normal;
      const Vector3 foot = planes_[i].offset * n;
      gp_Trsf one;
      one.SetMirror(gp_Ax2(gp_Pnt(foot.x(), foot.y(), foot.z()), gp_Dir(n.x(), n.y(), n.z())));
      all = one * all;
    }
    return all;
  }

  /// Finds the components: faces connected by shared edges or vertices. Each component is cut by itself, so
  /// that parts that merely touch stay apart.
  void find_components() {
    TopTools_IndexedDataMapOfShapeListOfShape users;
    TopTools_IndexedMapOfShape faces;
    for (const CadFace& face : shape_.faces) {
      faces.Add(face.face);
      TopExp::MapShapesAndAncestors(face.face, TopAbs_VERTEX, TopAbs_FACE, users);
    }
    component_of_.resize(shape_.faces.size());
    std::iota(component_of_.begin(), component_of_.end(), 0);
    const auto root = [&](int face) {
      while (component_of_[face] != face) face = component_of_[face] = component_of_[component_of_[face]];
      return face;
    };
    for (int i = 1; i <= users.Extent(); ++i) {
      const int first = root(faces.FindIndex(users(i).First()) - 1);
      for (const TopoDS_Shape& face : users(i)) component_of_[root(faces.FindIndex(face) - 1)] = first;
    }
    for (std::size_t i = 0; i < component_of_.size(); ++i) component_of_[i] = root(static_cast<int>(i));
    for (int i = 1; i <= users.Extent(); ++i)
      vertices_.push_back({users.FindKey(i), 0, faces.FindIndex(users(i).First()) - 1});
    TopTools_IndexedMapOfShape map;
    for (const Vertex& vertex : vertices_) map.Add(vertex.shape);
    for (const CadEdge& edge : shape_.edges) {
      TopoDS_Vertex first, last;
      TopExp::Vertices(edge.edge, first, last);
      if (!first.IsNull() && map.Contains(first))
        vertices_[map.FindIndex(first) - 1].number = edge.first_vertex;
      if (!last.IsNull() && map.Contains(last)) vertices_[map.FindIndex(last) - 1].number = edge.last_vertex;
    }
  }

  bool cut() {
    std::vector<TopTools_ListOfShape> tools(shape_.faces.size());
    imprint(tools);
    splitters_.resize(shape_.faces.size());
    const Vector3 middle = 0.5 * (shape_.box_min + shape_.box_max);
    for (std::size_t i = 0; i < splitters_.size(); ++i) {
      const int component = static_cast<int>(i);
      if (component_of_[i] != component) continue;
      for (const MirrorPlane& plane : planes_) {
        if (component_of_[plane.faces[i]] != component) continue;  // its image is another component
        const Vector3 foot = middle - plane.distance(middle) * plane.normal;
        const gp_Pln surface(gp_Pnt(foot.x(), foot.y(), foot.z()),
                             gp_Dir(plane.normal.x(), plane.normal.y(), plane.normal.z()));
        const double reach = shape_.diagonal();
        tools[i].Append(BRepBuilderAPI_MakeFace(surface, -reach, reach, -reach, reach).Face());
      }
      if (!tools[i].IsEmpty() && !cut_component(component, tools[i])) return false;
    }
    return true;
  }

  bool cut_component(int component, const TopTools_ListOfShape& tools) {
    TopoDS_Compound whole;
    BRep_Builder().MakeCompound(whole);
    for (std::size_t i = 0; i < shape_.faces.size(); ++i) {
      if (component_of_[i] == component) BRep_Builder().Add(whole, own_face(shape_.faces[i]));
    }
    TopTools_ListOfShape arguments;
    arguments.Append(whole);
    splitters_[component] = std::make_unique<BRepAlgoAPI_Splitter>();
    BRepAlgoAPI_Splitter& splitter = *splitters_[component];
    splitter.SetArguments(arguments);
    splitter.SetTools(tools);
    splitter.SetNonDestructive(Standard_True);
    splitter.SetRunParallel(Standard_False);
    const Handle(Message_ProgressIndicator) asking = new Asking(context_);
    splitter.Build(asking->Start());
    context_.check();
    return splitter.IsDone() && !splitter.HasErrors();
  }

  /// Mirrors the seams and vertices that have no image in the model. Adds the images that lie on the kept
  /// side to the tools of the components that they lie on.
  void imprint(std::vector<TopTools_ListOfShape>& tools) {
    for (unsigned image = 1; image < images_.size(); ++image) {
      const gp_Trsf move = transformation(image);
      std::vector<char> done(shape_.vertices.size() + 1, 0);
      for (std::size_t i = 0; i < shape_.edges.size(); ++i) {
        const CadEdge& edge = shape_.edges[i];
        if (edge.degenerate || edge.faces.empty() || images_[image].edges[i] >= 0) continue;
        const EdgeCurve curve(edge);
        const std::array<double, 3> shares{0.25, 0.5, 0.75};
        if (std::none_of(shares.begin(), shares.end(), [&](double share) {
              return is_wanted(curve.point(edge.first + share * (edge.last - edge.first)), move);
            }))
          continue;
        add_tool(edge.edge, image, static_cast<int>(i), edge.faces.front() - 1, tools);
        done[edge.first_vertex] = done[edge.last_vertex] = 1;
      }
      for (const Vertex& vertex : vertices_) {
        if (vertex.number == 0 || done[vertex.number] != 0 || images_[image].vertices[vertex.number - 1] >= 0)
          continue;
        if (is_wanted(shape_.vertices[vertex.number - 1], move))
          add_tool(vertex.shape, image, vertex.number - 1, vertex.face, tools);
      }
    }
  }

  void add_tool(const TopoDS_Shape& shape, unsigned image, int source, int face,
                std::vector<TopTools_ListOfShape>& tools) {
    const TopoDS_Shape copy = BRepBuilderAPI_Transform(shape, transformation(image), Standard_True).Shape();
    const int component = component_of_[images_[image].faces[face]];
    tools[component].Append(copy);
    imprinted_.push_back({copy, image, source, component});
  }

  /// Whether the image of a point lies on the kept side, or in the planes, and differs from the point.
  bool is_wanted(const Vector3& point, const gp_Trsf& move) const {
    const gp_Pnt at = gp_Pnt(point.x(), point.y(), point.z()).Transformed(move);
    return (to_vector(at) - point).norm() > near() &&
           std::all_of(planes_.begin(), planes_.end(),
                       [&](const MirrorPlane& plane) { return plane.distance(to_vector(at)) > -near(); });
  }

  double near() const { return 1e-6 * shape_.diagonal(); }

  TopTools_ListOfShape pieces_of(const TopoDS_Shape& shape, int component) {
    TopTools_ListOfShape pieces;
    BRepAlgoAPI_Splitter* splitter = splitters_[component].get();
    if (splitter != nullptr) pieces = splitter->Modified(shape);
    if (pieces.IsEmpty() && (splitter == nullptr || !splitter->IsDeleted(shape))) pieces.Append(shape);
    return pieces;
  }

  void keep_positive() {
    BRep_Builder().MakeCompound(compound_);
    for (std::size_t i = 0; i < shape_.faces.size(); ++i) {
      for (const TopoDS_Shape& piece : pieces_of(own_face(shape_.faces[i]), component_of_[i])) {
        if (!is_positive(TopoDS::Face(piece))) continue;
        BRep_Builder().Add(compound_, piece);
        kept_.push_back({piece, static_cast<int>(i)});
      }
    }
  }

  /// Whether a piece lies on the positive side of all planes, decided by its point farthest from each plane.
  bool is_positive(const TopoDS_Face& piece) const {
    std::vector<double> farthest(planes_.size(), 0);
    const auto look = [&](const gp_Pnt& point) {
      for (std::size_t i = 0; i < planes_.size(); ++i) {
        const double distance = planes_[i].distance(to_vector(point));
        if (std::abs(distance) > std::abs(farthest[i])) farthest[i] = distance;
      }
    };
    for (TopExp_Explorer it(piece, TopAbs_EDGE); it.More(); it.Next()) {
      const TopoDS_Edge& edge = TopoDS::Edge(it.Current());
      if (BRep_Tool::Degenerated(edge)) continue;
      const BRepAdaptor_Curve curve(edge);
      for (const double share : {0.0, 0.25, 0.5, 0.75, 1.0})
        look(curve.Value(curve.FirstParameter() + share * (curve.LastParameter() - curve.FirstParameter())));
    }
    const BRepAdaptor_Surface surface(piece);
    const BRepTopAdaptor_FClass2d inside(piece, 1e-9);
    for (int i = 1; i < 8; ++i) {
      for (int j = 1; j < 8; ++j) {
        const double u =
            surface.FirstUParameter() + i / 8.0 * (surface.LastUParameter() - surface.FirstUParameter());
        const double v =
            surface.FirstVParameter() + j / 8.0 * (surface.LastVParameter() - surface.FirstVParameter());
        if (inside.Perform(gp_Pnt2d(u, v)) == TopAbs_IN) look(surface.Value(u, v));
      }
    }
    return std::all_of(farthest.begin(), farthest.end(), [](double distance) { return distance > 0; });
  }

  std::size_t count(TopAbs_ShapeEnum kind) const {
    TopTools_IndexedMapOfShape map;
    TopExp::MapShapes(compound_, kind, map);
    return static_cast<std::size_t>(map.Extent());
  }

  void find_in_planes(const CadShape& part, ModelPart& result) const {
    const auto planes_at = [&](const std::vector<Vector3>& points, double tolerance) {
      unsigned in = 0;
      for (std::size_t i = 0; i < planes_.size(); ++i) {
        const bool all = std::all_of(points.begin(), points.end(), [&](const Vector3& point) {
          return std::abs(planes_[i].distance(point)) <= std::max(tolerance, near());
        });
        if (all) in |= 1U << i;
      }
      return in;
    };
    for (const CadEdge& edge : part.edges) {
      std::vector<Vector3> points;
      if (edge.degenerate) {
        if (edge.first_vertex > 0) points.push_back(part.vertices[edge.first_vertex - 1]);
      } else {
        const EdgeCurve curve(edge);
        for (const double share : {0.0, 0.2, 0.4, 0.6, 0.8, 1.0})
          points.push_back(curve.point(edge.first + share * (edge.last - edge.first)));
      }
      result.edges_in.push_back(planes_at(points, edge.tolerance));
    }
    for (std::size_t i = 0; i < part.vertices.size(); ++i)
      result.vertices_in.push_back(planes_at({part.vertices[i]}, part.vertex_tolerances[i]));
  }

  /// The model's numbers of the part's faces, edges and vertices in an image of the part.
  ModelPart::Image named(const CadShape& part, unsigned image, const ModelPart& result) {
    ModelPart::Image names;
    names.faces.assign(part.faces.size(), 0);
    names.turned.assign(part.faces.size(), 0);
    names.edges.assign(part.edges.size(), 0);
    names.vertices.assign(part.vertices.size(), 0);
    TopTools_IndexedMapOfShape faces;
    TopExp::MapShapes(compound_, TopAbs_FACE, faces);
    for (const auto& [piece, source] : kept_) {
      const int index = faces.FindIndex(piece) - 1;
      names.faces[index] = images_[image].faces[source] + 1;
      names.turned[index] = images_[image].turned[source];
    }
    name_edges_and_vertices(image, names);
    // What lies in a plane is its own mirror image there, even a seam.
    for (std::size_t i = 0; i < names.edges.size(); ++i) {
      if (names.edges[i] == 0)
        names.edges[i] = of_lower(result, image, i, result.edges_in, &ModelPart::Image::edges);
    }
    for (std::size_t i = 0; i < names.vertices.size(); ++i) {
      if (names.vertices[i] == 0)
        names.vertices[i] = of_lower(result, image, i, result.vertices_in, &ModelPart::Image::vertices);
    }
    names.against.assign(part.edges.size(), 0);
    for (std::size_t i = 0; i < names.edges.size(); ++i) {
      if (names.edges[i] == 0) continue;
      names.against[i] = runs_against(part.edges[i], result, image, shape_.edges[names.edges[i] - 1]);
    }
    return names;
  }

  /// Numbers edges and vertices by tracing the model's through the cut.
  void name_edges_and_vertices(unsigned image, ModelPart::Image& names) {
    TopTools_IndexedMapOfShape edges, vertices;
    TopExp::MapShapes(compound_, TopAbs_EDGE, edges);
    TopExp::MapShapes(compound_, TopAbs_VERTEX, vertices);
    const auto name = [&](const TopoDS_Shape& source, int component, int number) {
      if (number < 0 || source.IsNull()) return;
      const bool is_edge = source.ShapeType() == TopAbs_EDGE;
      for (const TopoDS_Shape& piece : pieces_of(source, component)) {
        const int index = (is_edge ? edges : vertices).FindIndex(piece) - 1;
        if (index >= 0) (is_edge ? names.edges : names.vertices)[index] = number + 1;
      }
    };
    for (const Imprint& tool : imprinted_) {
      // The copy is the source mirrored by tool.image; mirrored by `image` too it is in image ^ tool.image.
      const MirrorPlane& there = images_[image ^ tool.image];
      const bool is_edge = tool.copy.ShapeType() == TopAbs_EDGE;
      name(tool.copy, tool.component, (is_edge ? there.edges : there.vertices)[tool.source]);
      if (!is_edge) continue;
      const CadEdge& edge = shape_.edges[tool.source];
      TopoDS_Vertex first, last;
      TopExp::Vertices(TopoDS::Edge(tool.copy), first, last);
      if (edge.first_vertex > 0) name(first, tool.component, there.vertices[edge.first_vertex - 1]);
      if (edge.last_vertex > 0) name(last, tool.component, there.vertices[edge.last_vertex - 1]);
    }
    for (std::size_t i = 0; i < shape_.edges.size(); ++i) {
      const CadEdge& edge = shape_.edges[i];
      if (!edge.faces.empty())
        name(edge.edge, component_of_[edge.faces.front() - 1], images_[image].edges[i]);
    }
    for (const Vertex& vertex : vertices_) {
      if (vertex.number > 0)
        name(vertex.shape, component_of_[vertex.face], images_[image].vertices[vertex.number - 1]);
    }
  }

  static bool runs_against(const CadEdge& edge, const ModelPart& result, unsigned image,
                           const CadEdge& whole) {
    if (edge.degenerate || whole.degenerate) return false;
    const EdgeCurve curve(edge);
    const double middle = 0.5 * (edge.first + edge.last);
    const Vector3 at = curve.point(middle);
    const Vector3 place = result.mirrored(at, image);
    const Vector3 way = result.mirrored(at + curve.derivative(middle), image) - place;
    gp_Pnt foot;
    double parameter = 0;
    ShapeAnalysis_Curve().Project(BRepAdaptor_Curve(whole.edge), gp_Pnt(place.x(), place.y(), place.z()),
                                  1e-9, foot, parameter, Standard_False);
    return way.dot(EdgeCurve(whole).derivative(parameter)) < 0;
  }

  /// The number of an edge or vertex in the image without the planes that it lies in; 0 if it lies in none.
  static int of_lower(const ModelPart& part, unsigned image, std::size_t index,
                      const std::vector<unsigned>& in, std::vector<int> ModelPart::Image::*names) {
    const unsigned lower = image & ~in[index];
    return lower == image ? 0 : (part.images[lower].*names)[index];
  }

  /// Whether the images have the face areas, all the edges and vertices, and at each edge the number of faces
  /// of the model.
  bool makes_up_model(const CadShape& part, const ModelPart& result) const {
    std::vector<double> area(shape_.faces.size(), 0);
    std::vector<char> edges(shape_.edges.size(), 0), vertices(shape_.vertices.size(), 0);
    std::vector<double> pieces;
    for (const CadFace& face : part.faces) pieces.push_back(area_of(face.face));
    for (unsigned image = 0; image < images_.size(); ++image) {
      const ModelPart::Image& names = result.images[image];
      for (std::size_t i = 0; i < pieces.size(); ++i) area[names.faces[i] - 1] += pieces[i];
      for (std::size_t i = 0; i < names.edges.size(); ++i) {
        if (names.edges[i] == 0) continue;
        edges[names.edges[i] - 1] = 1;
        const std::size_t uses = shape_.edges[names.edges[i] - 1].faces.size();
        if (result.edges_in[i] == 0 && part.edges[i].faces.size() != uses) return false;
      }
      for (const int vertex : names.vertices) {
        if (vertex > 0) vertices[vertex - 1] = 1;
      }
    }
    for (std::size_t i = 0; i < area.size(); ++i) {
      context_.check();
      const double whole = area_of(shape_.faces[i].face);
      if (std::abs(area[i] - whole) > 1e-2 * whole + near() * near()) return false;
    }
    for (const CadFace& face : shape_.faces) {
      for (const InnerVertex& vertex : face.inner_vertices) {
        if (!vertices[vertex.vertex - 1]) return false;
      }
    }
    for (std::size_t i = 0; i < edges.size(); ++i) {
      const CadEdge& edge = shape_.edges[i];
      if (edge.degenerate || edge.faces.empty()) continue;
      if (!edges[i]) return false;
      for (const int vertex : {edge.first_vertex, edge.last_vertex}) {
        if (vertex > 0 && !vertices[vertex - 1]) return false;
      }
    }
    return true;
  }

  struct Imprint {
    TopoDS_Shape copy;
    unsigned image = 0;
    int source = 0;  // edge or vertex of the model, from 0
    int component = 0;
  };
  struct Vertex {
    TopoDS_Shape shape;
    int number = 0;  // from 1; 0 = on no edge
    int face = 0;    // one of its faces, from 0
  };
  struct Piece {
    TopoDS_Shape face;
    int source = 0;  // face of the model, from 0
  };

  const CadShape& shape_;
  const ExecutionContext& context_;
  std::vector<MirrorPlane> planes_;
  std::vector<MirrorPlane> images_;  // by number of the image, see composed()
  std::vector<int> component_of_;    // (faces) index of one face of the component, the same for all
  std::vector<Vertex> vertices_;
  std::vector<std::unique_ptr<BRepAlgoAPI_Splitter>> splitters_;  // by component; null = not cut
  std::vector<Imprint> imprinted_;
  std::vector<Piece> kept_;
  TopoDS_Compound compound_;
};

}  // namespace

std::optional<ModelPart> cut_at_planes(const CadModel& model, std::vector<MirrorPlane> planes,
                                       const ExecutionContext& context) {
  try {
    return Cutter(model, std::move(planes), context).run();
  } catch (const Standard_Failure&) {
    return std::nullopt;
  }
}

}  // namespace quadrille
