// Checks of single shape nodes of Coin, which reads past the end of its arrays when a file says so.
// Included by the inventor files only.
#pragma once
#include <Inventor/actions/SoCallbackAction.h>
#include <Inventor/nodes/SoNode.h>

#include <string>

namespace clench {

/// What to do with a shape.
struct ShapeVerdict {
  bool use = false;      ///< it has triangles, and they can be asked for
  std::string error;     ///< not empty: "IndexedFaceSet: index 7 of coordIndex: ..."
  std::string warning;   ///< why it is not used, where that may surprise
};

/// Takes out what could lead Coin astray and has no effect on triangles: normals, texture coordinates,
/// material indices that do not fit.
ShapeVerdict check_shape(SoCallbackAction* action, SoNode* shape);

}  // namespace clench
