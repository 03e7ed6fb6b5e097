#include "io/inventor.h"

#include <Inventor/SoPrimitiveVertex.h>
#include <Inventor/VRMLnodes/SoVRMLNodes.h>
#include <Inventor/actions/SoCallbackAction.h>
#include <Inventor/elements/SoLazyElement.h>
#include <Inventor/nodes/SoNodes.h>

#include <algorithm>
#include <set>

#include "base/error.h"
#include "base/units.h"
#include "io/inventor_faces.h"
#include "io/inventor_graph.h"
#include "io/triangulate.h"

namespace clench {

namespace {

constexpr int most_steps = 2'000'000;  // nodes visited, shared ones each time
constexpr size_t most_triangles = 2'000'000;

/// Walks a scene graph and gathers its triangles.
class Collector {
 public:
  Collector(std::string file, double unit) : file_(std::move(file)), unit_(unit) {}
  void apply(const InventorGraph& graph);

  GeometryBuilder builder;
  bool colors_given = false;
  std::set<std::string> warnings;
  std::set<std::string> units;  ///< named by nodes

 private:
  static SoCallbackAction::Response on_node(void* self, SoCallbackAction* action,
                                            const SoNode* node) {
    return static_cast<Collector*>(self)->enter(action, const_cast<SoNode*>(node));
  }
  static void on_triangle(void* self, SoCallbackAction* action, const SoPrimitiveVertex* a,
                          const SoPrimitiveVertex* b, const SoPrimitiveVertex* c) {
    static_cast<Collector*>(self)->add(action, {a->getPoint(), b->getPoint(), c->getPoint()},
                                       a->getMaterialIndex());
  }
  SoCallbackAction::Response enter(SoCallbackAction* action, SoNode* node);
  SoCallbackAction::Response enter_shape(SoCallbackAction* action, SoNode* node);
  void add_faces(SoCallbackAction* action, const FaceList& list);
  void add(SoCallbackAction* action, const std::array<SbVec3f, 3>& corners, int color,
           const SbColor* given = nullptr);

  std::string file_, error_;
  const SoNode* wrong_ = nullptr;  // what the error is about
  double unit_;                    // [m]
  int steps_ = 0;
  bool clockwise_ = false;  // how the shape at hand turns
};

void Collector::apply(const InventorGraph& graph) {
  SoCallbackAction action;
  action.addPreCallback(SoNode::getClassTypeId(), on_node, this);
  action.addTriangleCallback(SoShape::getClassTypeId(), on_triangle, this);
  // where a file says nothing about its faces they may be of any shape
  const Ref<SoSeparator> all(new SoSeparator);
  auto* hints = new SoShapeHints;
  hints->faceType = SoShapeHints::UNKNOWN_FACE_TYPE;
  all.get()->addChild(hints);
  all.get()->addChild(graph.root.get());
  action.apply(all.get());
  if (!error_.empty()) fail("{}: {}", graph.place(wrong_, file_), error_);
}

SoCallbackAction::Response Collector::enter(SoCallbackAction* action, SoNode* node) {
  const auto is = [&](SoType type) { return node->isOfType(type); };
  if (++steps_ > most_steps)
    error_ = fmt::format("wanted at most {} nodes, shared ones counted each time", most_steps);
  if (builder.triangle_count() > most_triangles)
    error_ = fmt::format("wanted at most {} triangles", most_triangles);
  if (!error_.empty()) return SoCallbackAction::ABORT;
  if (is(SoMaterial::getClassTypeId()) || is(SoBaseColor::getClassTypeId()) ||
      is(SoPackedColor::getClassTypeId()) || is(SoVRMLMaterial::getClassTypeId()))
    colors_given = true;
  if (is(SoUnits::getClassTypeId())) {
    SbString name;
    static_cast<SoUnits*>(node)->units.get(name);
    if (name != "METERS") units.insert(name.getString());  // which is what stands without any
  }
  if (!is(SoShape::getClassTypeId())) return SoCallbackAction::CONTINUE;

  // no exception may pass through Coin
  try {
    return enter_shape(action, node);
  } catch (const Error& error) {
    error_ = error.what();
    wrong_ = node;
  }
  return SoCallbackAction::ABORT;
}

SoCallbackAction::Response Collector::enter_shape(SoCallbackAction* action, SoNode* node) {
  if (const auto faces = list_faces(action, node)) {
    add_faces(action, *faces);
    return SoCallbackAction::PRUNE;
  }
  // the shapes given by their sizes are Coin's to cut into triangles
  const SoType round[] = {SoCube::getClassTypeId(),         SoSphere::getClassTypeId(),
                          SoCylinder::getClassTypeId(),     SoCone::getClassTypeId(),
                          SoVRMLBox::getClassTypeId(),      SoVRMLSphere::getClassTypeId(),
                          SoVRMLCylinder::getClassTypeId(), SoVRMLCone::getClassTypeId(),
                          SoVRMLExtrusion::getClassTypeId()};
  clockwise_ = node->isOfType(SoVRMLExtrusion::getClassTypeId()) &&
               !static_cast<SoVRMLExtrusion*>(node)->ccw.getValue();
  for (const SoType type : round)
    if (node->isOfType(type)) return SoCallbackAction::CONTINUE;
  const std::string name = node_name(node);
  const bool flat = name.find("Line") != std::string::npos ||
                    name.find("Point") != std::string::npos ||
                    name.find("Text") != std::string::npos;
  if (!flat) warnings.insert(fmt::format("{}: {} is not used as geometry", file_, name));
  return SoCallbackAction::PRUNE;
}

void Collector::add_faces(SoCallbackAction* action, const FaceList& list) {
  clockwise_ = list.clockwise;
  colors_given = colors_given || !list.colors.empty();
  std::vector<Eigen::Vector3d> corners;
  std::vector<SbVec3f> points;
  for (const auto& face : list.faces) {
    corners.clear();
    points.clear();
    for (int i = 0; i < face.count; ++i) {
      points.push_back(list.point(list.corners[face.first + i]));
      corners.emplace_back(points.back()[0], points.back()[1], points.back()[2]);
    }
    const int last_color = static_cast<int>(list.colors.size()) - 1;
    const SbColor* color =
        list.colors.empty() ? nullptr : &list.colors[std::clamp(face.color, 0, last_color)];
    for (const auto& t : triangulate(corners, list.convex))
      add(action, {points[t[0]], points[t[1]], points[t[2]]}, face.color, color);
  }
}

void Collector::add(SoCallbackAction* action, const std::array<SbVec3f, 3>& corners, int color,
                    const SbColor* given) {
  const SbMatrix& X = action->getModelMatrix();
  std::array<Eigen::Vector3d, 3> points;
  for (int i = 0; i < 3; ++i) {
    SbVec3f p;
    X.multVecMatrix(corners[i], p);
    points[i] = Eigen::Vector3d(p[0], p[1], p[2]) * unit_;
  }
  // a mirrored shape is inside out
  if (clockwise_ != (X.det3() < 0)) std::swap(points[1], points[2]);

  SoState* state = action->getState();
  const SoLazyElement* material = SoLazyElement::getInstance(state);
  const int colors = material->getNumDiffuse(), alphas = material->getNumTransparencies();
  SbColor diffuse(0.8f, 0.8f, 0.8f);
  if (given)
    diffuse = *given;
  else if (colors > 0)
    diffuse = SoLazyElement::getDiffuse(state, std::clamp(color, 0, colors - 1));
  const float alpha =
      alphas > 0 ? SoLazyElement::getTransparency(state, std::clamp(color, 0, alphas - 1)) : 0.0f;
  builder.add(points,
              Eigen::Vector3f(diffuse[0], diffuse[1], diffuse[2]).cwiseMax(0.0f).cwiseMin(1.0f),
              std::clamp(alpha, 0.0f, 1.0f));
}

}  // namespace

Geometry read_inventor(const std::filesystem::path& path, const std::string& text,
                       const ReadOptions& options) {
  const std::string file = path.filename().string();
  Collector collector(file, options.mesh_scale.value_or(units::millimetre));
  collector.builder.keeps_triangles = true;
  MeshReport& report = collector.builder.report;
  report.format = text.starts_with("#VRML") ? "VRML" : "Inventor";
  report.unit = options.mesh_scale.value_or(units::millimetre);
  report.unit_source = options.mesh_scale ? UnitSource::option : UnitSource::format;
  std::vector<std::string> warnings;
  {
    CoinLease coin;
    collector.apply(load_graph(coin, path, text, options, warnings));
  }
  // told when Coin is free again, for a listener may want to read, too
  warnings.insert(warnings.end(), collector.warnings.begin(), collector.warnings.end());
  if (options.warn)
    for (const auto& warning : warnings) options.warn(warning);
  if (options.note)
    for (const auto& unit : collector.units)
      options.note(
          fmt::format("{}: Units {} scales what follows it by its length beside METERS, "
                      "or beside that of the Units before it",
                      file, unit));
  return collector.builder.finish(collector.colors_given, file, options);
}

}  // namespace clench
