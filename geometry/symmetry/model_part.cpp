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
#include <set>
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
  using Tools = IdVector<FaceId, TopTools_ListOfShape>;  // by component
  struct Imprint {
    TopoDS_Shape copy;
    unsigned image = 0;
    EdgeId edge;      // of the model, or
    VertexId vertex;  // of the model
    FaceId component{};
  };
  struct Vertex {
    TopoDS_Shape shape;
    VertexId id;  // none on no edge
    FaceId face;  // one of its faces
  };
  struct Piece {
    TopoDS_Shape face;
    FaceId source;  // of the model
  };

  /// The combined mirror image in all planes of an image, without normal and offset.
  MirrorPlane composed(unsigned image) const {
    MirrorPlane result;
    for (const FaceId face : shape_.faces.ids()) result.faces.push_back(face);
    for (const EdgeId edge : shape_.edges.ids()) result.edges.push_back(edge);
    for (const VertexId vertex : shape_.vertices.ids()) result.vertices.push_back(vertex);
    result.turned.assign(shape_.faces.size(), 0);
    const auto map = [](auto& ids, const auto& images) {
      for (auto& id : ids) {
        if (id.exists()) id = images[id];
      }
    };
    for (std::size_t i = 0; i < planes_.size(); ++i) {
      if ((image >> i & 1U) == 0) continue;
      for (const FaceId face : result.faces.ids())
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
    for (const FaceId face : shape_.faces.ids()) component_of_.push_back(face);
    const auto root = [&](FaceId face) {
      while (component_of_[face] != face) face = component_of_[face] = component_of_[component_of_[face]];
      return face;
    };
    const auto id_of = [&](const TopoDS_Shape& face) { return FaceId::from_number(faces.FindIndex(face)); };
    for (int i = 1; i <= users.Extent(); ++i) {
      const FaceId first = root(id_of(users(i).First()));
      for (const TopoDS_Shape& face : users(i)) component_of_[root(id_of(face))] = first;
    }
    for (const FaceId face : component_of_.ids()) component_of_[face] = root(face);
    for (int i = 1; i <= users.Extent(); ++i)
      vertices_.push_back({users.FindKey(i), {}, id_of(users(i).First())});
    TopTools_IndexedMapOfShape map;
    for (const Vertex& vertex : vertices_) map.Add(vertex.shape);
    for (const CadEdge& edge : shape_.edges) {
      TopoDS_Vertex first, last;
      TopExp::Vertices(edge.edge, first, last);
      if (!first.IsNull() && map.Contains(first)) vertices_[map.FindIndex(first) - 1].id = edge.first_vertex;
      if (!last.IsNull() && map.Contains(last)) vertices_[map.FindIndex(last) - 1].id = edge.last_vertex;
    }
  }

  bool cut() {
    Tools tools(shape_.faces.size());
    imprint(tools);
    splitters_.resize(shape_.faces.size());
    const Vector3 middle = 0.5 * (shape_.box_min + shape_.box_max);
    for (const FaceId component : shape_.faces.ids()) {
      if (component_of_[component] != component) continue;
      for (const MirrorPlane& plane : planes_) {
        if (component_of_[plane.faces[component]] != component) continue;  // its image is another component
        const Vector3 foot = middle - plane.distance(middle) * plane.normal;
        const gp_Pln surface(gp_Pnt(foot.x(), foot.y(), foot.z()),
                             gp_Dir(plane.normal.x(), plane.normal.y(), plane.normal.z()));
        const double reach = shape_.diagonal();
        tools[component].Append(BRepBuilderAPI_MakeFace(surface, -reach, reach, -reach, reach).Face());
      }
      if (!tools[component].IsEmpty() && !cut_component(component, tools[component])) return false;
    }
    return true;
  }

  bool cut_component(FaceId component, const TopTools_ListOfShape& tools) {
    TopoDS_Compound whole;
    BRep_Builder().MakeCompound(whole);
    for (const FaceId face : shape_.faces.ids()) {
      if (component_of_[face] == component) BRep_Builder().Add(whole, own_face(shape_.faces[face]));
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
  void imprint(Tools& tools) {
    for (unsigned image = 1; image < images_.size(); ++image) {
      const gp_Trsf move = transformation(image);
      std::set<VertexId> done;
      for (const EdgeId id : shape_.edges.ids()) {
        const CadEdge& edge = shape_.edges[id];
        if (edge.degenerate || edge.faces.empty() || images_[image].edges[id].exists()) continue;
        const EdgeCurve curve(edge);
        const std::array<double, 3> shares{0.25, 0.5, 0.75};
        if (std::none_of(shares.begin(), shares.end(), [&](double share) {
              return is_wanted(curve.point(edge.first + share * (edge.last - edge.first)), move);
            }))
          continue;
        add_tool({edge.edge, image, id, {}}, edge.faces.front(), tools);
        done.insert({edge.first_vertex, edge.last_vertex});
      }
      for (const Vertex& vertex : vertices_) {
        if (!vertex.id.exists() || done.contains(vertex.id) || images_[image].vertices[vertex.id].exists())
          continue;
        if (is_wanted(shape_.vertices[vertex.id], move))
          add_tool({vertex.shape, image, {}, vertex.id}, vertex.face, tools);
      }
    }
  }

  /// \param tool with the model's own edge or vertex. \param face that this bounds.
  void add_tool(Imprint tool, FaceId face, Tools& tools) {
    tool.copy = BRepBuilderAPI_Transform(tool.copy, transformation(tool.image), Standard_True).Shape();
    tool.component = component_of_[images_[tool.image].faces[face]];
    tools[tool.component].Append(tool.copy);
    imprinted_.push_back(tool);
  }

  /// Whether the image of a point lies on the kept side, or in the planes, and differs from the point.
  bool is_wanted(const Vector3& point, const gp_Trsf& move) const {
    const gp_Pnt at = gp_Pnt(point.x(), point.y(), point.z()).Transformed(move);
    return (to_vector(at) - point).norm() > near() &&
           std::all_of(planes_.begin(), planes_.end(),
                       [&](const MirrorPlane& plane) { return plane.distance(to_vector(at)) > -near(); });
  }

  double near() const { return 1e-6 * shape_.diagonal(); }

  TopTools_ListOfShape pieces_of(const TopoDS_Shape& shape, FaceId component) {
    TopTools_ListOfShape pieces;
    BRepAlgoAPI_Splitter* splitter = splitters_[component].get();
    if (splitter != nullptr) pieces = splitter->Modified(shape);
    if (pieces.IsEmpty() && (splitter == nullptr || !splitter->IsDeleted(shape))) pieces.Append(shape);
    return pieces;
  }

  void keep_positive() {
    BRep_Builder().MakeCompound(compound_);
    for (const FaceId face : shape_.faces.ids()) {
      for (const TopoDS_Shape& piece : pieces_of(own_face(shape_.faces[face]), component_of_[face])) {
        if (!is_positive(TopoDS::Face(piece))) continue;
        BRep_Builder().Add(compound_, piece);
        kept_.push_back({piece, face});
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
        if (edge.first_vertex.exists()) points.push_back(part.vertices[edge.first_vertex]);
      } else {
        const EdgeCurve curve(edge);
        for (const double share : {0.0, 0.2, 0.4, 0.6, 0.8, 1.0})
          points.push_back(curve.point(edge.first + share * (edge.last - edge.first)));
      }
      result.edges_in.push_back(planes_at(points, edge.tolerance));
    }
    for (const VertexId vertex : part.vertices.ids())
      result.vertices_in.push_back(planes_at({part.vertices[vertex]}, part.vertex_tolerances[vertex]));
  }

  /// The model's faces, edges and vertices that the part's become in an image.
  ModelPart::Image named(const CadShape& part, unsigned image, const ModelPart& result) {
    ModelPart::Image names;
    names.faces.resize(part.faces.size());
    names.turned.resize(part.faces.size());
    names.edges.resize(part.edges.size());
    names.vertices.resize(part.vertices.size());
    TopTools_IndexedMapOfShape faces;
    TopExp::MapShapes(compound_, TopAbs_FACE, faces);
    for (const auto& [piece, source] : kept_) {
      const FaceId face = FaceId::from_number(faces.FindIndex(piece));
      names.faces[face] = images_[image].faces[source];
      names.turned[face] = images_[image].turned[source];
    }
    name_edges_and_vertices(image, names);
    // What lies in a plane is its own mirror image there, even a seam.
    for (const EdgeId edge : names.edges.ids()) {
      const unsigned lower = image & ~result.edges_in[edge];
      if (!names.edges[edge].exists() && lower != image) names.edges[edge] = result.images[lower].edges[edge];
    }
    for (const VertexId vertex : names.vertices.ids()) {
      const unsigned lower = image & ~result.vertices_in[vertex];
      if (!names.vertices[vertex].exists() && lower != image)
        names.vertices[vertex] = result.images[lower].vertices[vertex];
    }
    names.against.resize(part.edges.size());
    for (const EdgeId edge : names.edges.ids()) {
      if (names.edges[edge].exists())
        names.against[edge] = runs_against(part.edges[edge], result, image, shape_.edges[names.edges[edge]]);
    }
    return names;
  }

  /// Names edges and vertices by tracing the model's through the cut.
  void name_edges_and_vertices(unsigned image, ModelPart::Image& names) {
    TopTools_IndexedMapOfShape edges, vertices;
    TopExp::MapShapes(compound_, TopAbs_EDGE, edges);
    TopExp::MapShapes(compound_, TopAbs_VERTEX, vertices);
    const auto name_edge = [&](const TopoDS_Shape& source, FaceId component, EdgeId name) {
      if (!name.exists()) return;
      for (const TopoDS_Shape& piece : pieces_of(source, component)) {
        if (const EdgeId edge = EdgeId::from_number(edges.FindIndex(piece)); edge.exists())
          names.edges[edge] = name;
      }
    };
    const auto name_vertex = [&](const TopoDS_Shape& source, FaceId component, VertexId name) {
      if (!name.exists() || source.IsNull()) return;
      for (const TopoDS_Shape& piece : pieces_of(source, component)) {
        if (const VertexId vertex = VertexId::from_number(vertices.FindIndex(piece)); vertex.exists())
          names.vertices[vertex] = name;
      }
    };
    for (const Imprint& tool : imprinted_) {
      // The copy is the source mirrored by tool.image; mirrored by `image` too it is in image ^ tool.image.
      const MirrorPlane& there = images_[image ^ tool.image];
      if (tool.vertex.exists()) name_vertex(tool.copy, tool.component, there.vertices[tool.vertex]);
      if (!tool.edge.exists()) continue;
      name_edge(tool.copy, tool.component, there.edges[tool.edge]);
      const CadEdge& edge = shape_.edges[tool.edge];
      TopoDS_Vertex first, last;
      TopExp::Vertices(TopoDS::Edge(tool.copy), first, last);
      if (edge.first_vertex.exists()) name_vertex(first, tool.component, there.vertices[edge.first_vertex]);
      if (edge.last_vertex.exists()) name_vertex(last, tool.component, there.vertices[edge.last_vertex]);
    }
    for (const EdgeId id : shape_.edges.ids()) {
      const CadEdge& edge = shape_.edges[id];
      if (!edge.faces.empty())
        name_edge(edge.edge, component_of_[edge.faces.front()], images_[image].edges[id]);
    }
    for (const Vertex& vertex : vertices_) {
      if (vertex.id.exists())
        name_vertex(vertex.shape, component_of_[vertex.face], images_[image].vertices[vertex.id]);
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

  /// Whether the images have the face areas, all the edges and vertices, and at each edge the number of faces
  /// of the model.
  bool makes_up_model(const CadShape& part, const ModelPart& result) const {
    IdVector<FaceId, double> area(shape_.faces.size()), pieces;
    IdVector<EdgeId, char> edges(shape_.edges.size());
    VertexFlags vertices(shape_.vertices.size());
    for (const CadFace& face : part.faces) pieces.push_back(area_of(face.face));
    for (const ModelPart::Image& names : result.images) {
      for (const FaceId piece : pieces.ids()) area[names.faces[piece]] += pieces[piece];
      for (const EdgeId edge : names.edges.ids()) {
        const EdgeId name = names.edges[edge];
        if (!name.exists()) continue;
        edges[name] = 1;
        if (result.edges_in[edge] == 0 && part.edges[edge].faces.size() != shape_.edges[name].faces.size())
          return false;
      }
      for (const VertexId name : names.vertices) {
        if (name.exists()) vertices[name] = 1;
      }
    }
    for (const FaceId face : area.ids()) {
      context_.check();
      const double whole = area_of(shape_.faces[face].face);
      if (std::abs(area[face] - whole) > 1e-2 * whole + near() * near()) return false;
    }
    for (const CadFace& face : shape_.faces) {
      for (const InnerVertex& vertex : face.inner_vertices) {
        if (!vertices[vertex.vertex]) return false;
      }
    }
    for (const EdgeId id : edges.ids()) {
      const CadEdge& edge = shape_.edges[id];
      if (edge.degenerate || edge.faces.empty()) continue;
      if (!edges[id]) return false;
      for (const VertexId vertex : {edge.first_vertex, edge.last_vertex}) {
        if (vertex.exists() && !vertices[vertex]) return false;
      }
    }
    return true;
  }

  const CadShape& shape_;
  const ExecutionContext& context_;
  std::vector<MirrorPlane> planes_;
  std::vector<MirrorPlane> images_;        // by number of the image, see composed()
  IdVector<FaceId, FaceId> component_of_;  // one face of the component, the same for all of it
  std::vector<Vertex> vertices_;
  IdVector<FaceId, std::unique_ptr<BRepAlgoAPI_Splitter>> splitters_;  // by component; null = not cut
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
