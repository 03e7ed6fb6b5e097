#include "io/inventor_primitives.h"

#include <Inventor/VRMLnodes/SoVRMLNodes.h>
#include <Inventor/actions/SoCallbackAction.h>
#include <Inventor/nodes/SoNodes.h>

#include <set>

#include "base/text.h"
#include "base/units.h"
#include "io/body_xml.h"
#include "io/inventor_faces.h"
#include "io/inventor_graph.h"

namespace clench {

namespace fs = std::filesystem;
using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

constexpr int most_visits = 100'000;  // nodes visited, shared ones each time
constexpr size_t most_found = 10'000;
constexpr double digits =
    1e-4;  // matrices of scene graphs have six digits, and several are multiplied

/// A primitive before it is placed: millimetres, in its own frame.
struct Solid {
  PrimitiveKind kind;
  Vector3d size = Vector3d::Zero();
  double radius = 0, height = 0;
};

template <class Node>
Node* as(SoNode* node) {
  return node->isOfType(Node::getClassTypeId()) ? static_cast<Node*>(node) : nullptr;
}

std::optional<Solid> primitive_of(SoNode* node) {
  using Kind = PrimitiveKind;
  if (const auto* n = as<SoCube>(node))
    return Solid{.kind = Kind::box,
                 .size = Vector3d(n->width.getValue(), n->height.getValue(), n->depth.getValue())};
  if (const auto* n = as<SoVRMLBox>(node)) {
    const SbVec3f s = n->size.getValue();
    return Solid{.kind = Kind::box, .size = Vector3d(s[0], s[1], s[2])};
  }
  if (const auto* n = as<SoSphere>(node))
    return Solid{.kind = Kind::sphere, .radius = n->radius.getValue()};
  if (const auto* n = as<SoVRMLSphere>(node))
    return Solid{.kind = Kind::sphere, .radius = n->radius.getValue()};
  const auto round = [](Kind kind, double radius, double height) {
    return Solid{.kind = kind, .radius = radius, .height = height};
  };
  if (const auto* n = as<SoCylinder>(node))
    return round(Kind::cylinder, n->radius.getValue(), n->height.getValue());
  if (const auto* n = as<SoVRMLCylinder>(node))
    return round(Kind::cylinder, n->radius.getValue(), n->height.getValue());
  if (const auto* n = as<SoCone>(node))
    return round(Kind::cone, n->bottomRadius.getValue(), n->height.getValue());
  if (const auto* n = as<SoVRMLCone>(node))
    return round(Kind::cone, n->bottomRadius.getValue(), n->height.getValue());
  return {};
}

const char* name_of(PrimitiveKind kind) {
  static constexpr const char* names[] = {"box", "sphere", "cylinder", "cone"};
  return names[static_cast<int>(kind)];
}

/// Walks a scene graph and gathers its primitives.
class PrimitiveCollector {
 public:
  PrimitiveCollector(std::string file, const InventorGraph& graph)
      : file_(std::move(file)), graph_(graph) {}
  void apply(SoNode* root);

  std::vector<Primitive> found;
  std::set<std::string> warnings;

 private:
  static SoCallbackAction::Response on_node(void* self, SoCallbackAction* action,
                                            const SoNode* node) {
    return static_cast<PrimitiveCollector*>(self)->enter(action, const_cast<SoNode*>(node));
  }
  SoCallbackAction::Response enter(SoCallbackAction* action, SoNode* node);
  Primitive placed(const Solid& shape, const SbMatrix& X);

  std::string file_, error_, place_;  // of the node at hand
  const InventorGraph& graph_;
  int steps_ = 0;
};

void PrimitiveCollector::apply(SoNode* root) {
  SoCallbackAction action;
  action.addPreCallback(SoNode::getClassTypeId(), on_node, this);
  action.apply(root);
  if (!error_.empty()) throw Error(error_);
}

SoCallbackAction::Response PrimitiveCollector::enter(SoCallbackAction* action, SoNode* node) {
  if (++steps_ > most_visits || found.size() > most_found)
    error_ = fmt::format("{}: wanted at most {} primitives and {} nodes", file_, most_found,
                         most_visits);
  if (!error_.empty()) return SoCallbackAction::ABORT;
  place_ = graph_.place(node, file_);
  // no exception may pass through Coin
  try {
    if (const auto shape = primitive_of(node))
      found.push_back(placed(*shape, action->getModelMatrix()));
    else if (node->isOfType(SoShape::getClassTypeId()))
      warnings.insert(
          fmt::format("{}: {} is no primitive and is not used", file_, node_name(node)));
    else
      return SoCallbackAction::CONTINUE;
    return SoCallbackAction::PRUNE;
  } catch (const Error& error) {
    error_ = error.what();
  }
  return SoCallbackAction::ABORT;
}

Primitive PrimitiveCollector::placed(const Solid& shape, const SbMatrix& X) {
  const char* name = name_of(shape.kind);
  const bool box = shape.kind == PrimitiveKind::box, ball = shape.kind == PrimitiveKind::sphere;
  const double least =
      box ? shape.size.minCoeff() : std::min(shape.radius, ball ? shape.radius : shape.height);
  if (!(least > 0)) fail("{}: {}: wanted sizes > 0, got {}", place_, name, least);

  // turn and scale of each axis; Coin multiplies rows
  Matrix3d axes;
  Vector3d position;
  for (int i = 0; i < 3; ++i) {
    position[i] = X[3][i];
    for (int j = 0; j < 3; ++j) axes(j, i) = X[i][j];
  }
  const Vector3d scale = axes.colwise().norm();
  if (!axes.allFinite() || !position.allFinite() || !(scale.minCoeff() > 0))
    fail("{}: {}: wanted a finite scale other than 0", place_, name);
  axes = axes * scale.cwiseInverse().asDiagonal();
  if ((axes.transpose() * axes - Matrix3d::Identity()).cwiseAbs().maxCoeff() > digits)
    fail("{}: {}: it is skewed, and is none any more", place_, name);
  if (axes.determinant() < 0) axes.col(0) *= -1;  // all of them are the same mirrored
  const double across = std::max(scale.x(), scale.z());
  const bool oval = ball ? scale.maxCoeff() - scale.minCoeff() > digits * scale.maxCoeff()
                         : std::abs(scale.x() - scale.z()) > digits * across;
  if (!box && oval)
    warnings.insert(fmt::format("{}: {}: it is oval; the largest radius is used", file_, name));

  Primitive out{.kind = shape.kind,
                .X_OP = {Eigen::Quaterniond(axes).normalized(), position * units::millimetre}};
  out.size = shape.size.cwiseProduct(scale) * units::millimetre;
  out.radius = shape.radius * (ball ? scale.maxCoeff() : across) * units::millimetre;
  out.height = shape.height * scale.y() * units::millimetre;
  return out;
}

/// The file that an XML body names; without a path where it names none, which is warned of.
PlacedFile geometry_of_body(const fs::path& path, const ReadOptions& options) {
  const XmlFile body(path);
  check_body_root(body);
  const auto found = read_placed_file(body.root(), path, options);
  if (!found && options.warn)
    options.warn(fmt::format("{}: no <geometryFile>: no primitives", body.root().place()));
  return found.value_or(PlacedFile());
}

/// Millimetres to millimetres; Coin multiplies rows.
SoMatrixTransform* new_placement(const PlacedFile& file) {
  const Pose X_BG = file.X_BG.value_or(Pose{});
  const Matrix3d axes = X_BG.rotation.toRotationMatrix() * file.scaling.asDiagonal();
  SbMatrix X = SbMatrix::identity();
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) X[i][j] = static_cast<float>(axes(j, i));
    X[3][i] = static_cast<float>(X_BG.position[i] / units::millimetre);
  }
  auto* placement = new SoMatrixTransform;
  placement->matrix = X;
  return placement;
}

}  // namespace

std::vector<Primitive> read_primitives(const fs::path& path, const ReadOptions& options) {
  // what somebody has simplified already
  const fs::path beside =
      path.parent_path() / "primitives" / fs::path(path.filename()).replace_extension(".iv");
  PlacedFile source{.path = path};
  if (is_readable(beside, options))
    source.path = beside;
  else if (ending_of(path) == ".xml")
    source = geometry_of_body(path, options);
  if (source.path.empty()) return {};
  const std::string file = source.path.filename().string(), ending = ending_of(source.path);
  if (source.format == GeometryFormat::none) source.format = geometry_format(ending);
  if (source.format != GeometryFormat::inventor)
    fail("{}: wanted primitives from {}, got {}", file,
         one_of(endings_of(GeometryFormat::inventor)), in_quotes(ending));

  std::vector<Primitive> found;
  std::vector<std::string> warnings;
  {
    const std::string text = read_text(source.path);
    CoinLease coin;
    const Ref<SoSeparator> all(new SoSeparator);
    all.get()->addChild(new_placement(source));
    const InventorGraph graph = load_graph(coin, source.path, text, options, warnings);
    all.get()->addChild(graph.root.get());
    PrimitiveCollector collector(file, graph);
    collector.apply(all.get());
    warnings.insert(warnings.end(), collector.warnings.begin(), collector.warnings.end());
    found = std::move(collector.found);
  }
  // told when Coin is free again, for a listener may want to read, too
  if (options.warn)
    for (const auto& warning : warnings) options.warn(warning);
  return found;
}

}  // namespace clench
