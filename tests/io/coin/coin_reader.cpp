#include "coin_reader.h"

#include <Inventor/SoDB.h>
#include <Inventor/SoInput.h>
#include <Inventor/SoPrimitiveVertex.h>
#include <Inventor/VRMLnodes/SoVRMLNodes.h>
#include <Inventor/actions/SoCallbackAction.h>
#include <Inventor/elements/SoLazyElement.h>
#include <Inventor/errors/SoDebugError.h>
#include <Inventor/errors/SoReadError.h>
#include <Inventor/nodes/SoNodes.h>

#include <algorithm>

namespace clench::test {

namespace {

struct Gathering {
  CoinTriangles found;
  bool vrml_clockwise = false;  // true if the current VRML shape is clockwise
};

bool is_clockwise(const SoNode* node) {
  if (node->isOfType(SoVRMLIndexedFaceSet::getClassTypeId()))
    return !static_cast<const SoVRMLIndexedFaceSet*>(node)->ccw.getValue();
  if (node->isOfType(SoVRMLElevationGrid::getClassTypeId()))
    return !static_cast<const SoVRMLElevationGrid*>(node)->ccw.getValue();
  if (node->isOfType(SoVRMLExtrusion::getClassTypeId()))
    return !static_cast<const SoVRMLExtrusion*>(node)->ccw.getValue();
  return false;
}

SoCallbackAction::Response on_node(void* self, SoCallbackAction* action, const SoNode* node) {
  const bool listed = node->isOfType(SoVertexShape::getClassTypeId());
  static_cast<Gathering*>(self)->vrml_clockwise =
      listed ? action->getVertexOrdering() == SoShapeHints::CLOCKWISE : is_clockwise(node);
  return SoCallbackAction::CONTINUE;
}

void on_triangle(void* self, SoCallbackAction* action, const SoPrimitiveVertex* a,
                 const SoPrimitiveVertex* b, const SoPrimitiveVertex* c) {
  auto& gathering = *static_cast<Gathering*>(self);
  const SbMatrix& X = action->getModelMatrix();
  CoinTriangle out;
  const SoPrimitiveVertex* corners[] = {a, b, c};
  for (int i = 0; i < 3; ++i) {
    SbVec3f p;
    X.multVecMatrix(corners[i]->getPoint(), p);
    out.corners[i] = {p[0], p[1], p[2]};
  }
  if (gathering.vrml_clockwise != (X.det3() < 0)) std::swap(out.corners[1], out.corners[2]);
  SoState* state = action->getState();
  const auto at = [&](int count) { return std::clamp(a->getMaterialIndex(), 0, count - 1); };
  const SoLazyElement* material = SoLazyElement::getInstance(state);
  const SbColor color = SoLazyElement::getDiffuse(state, at(material->getNumDiffuse()));
  out.color = {color[0], color[1], color[2]};
  out.transparency = SoLazyElement::getTransparency(state, at(material->getNumTransparencies()));
  gathering.found.list.push_back(out);
}

CoinTriangles read(SoInput& input) {
  Gathering gathering;
  SoReadError::setHandlerCallback(
      [](const SoError* error, void* self) {
        auto& first = static_cast<Gathering*>(self)->found.error;
        if (first.empty()) first = error->getDebugString().getString();
      },
      &gathering);
  SoDebugError::setHandlerCallback([](const SoError*, void*) {}, nullptr);
  SoSeparator* root = SoDB::readAll(&input);
  if (!root) return gathering.found;
  root->ref();
  // if a file does not describe its faces, they may have any shape
  auto* all = new SoSeparator;
  all->ref();
  auto* hints = new SoShapeHints;
  hints->faceType = SoShapeHints::UNKNOWN_FACE_TYPE;
  all->addChild(hints);
  all->addChild(root);
  SoCallbackAction action;
  action.addPreCallback(SoShape::getClassTypeId(), on_node, &gathering);
  action.addTriangleCallback(SoShape::getClassTypeId(), on_triangle, &gathering);
  action.apply(all);
  all->unref();
  root->unref();
  return gathering.found;
}

}  // namespace

CoinTriangles read_by_coin(const std::filesystem::path& path) {
  SoDB::init();
  SoInput input;
  input.addDirectoryFirst(path.parent_path().c_str());
  if (!input.openFile(path.c_str())) return {.list = {}, .error = "no such file"};
  return read(input);
}

CoinTriangles read_by_coin(const std::string& text) {
  SoDB::init();
  SoInput input;
  input.setBuffer(const_cast<char*>(text.data()), text.size());
  return read(input);
}

}  // namespace clench::test
