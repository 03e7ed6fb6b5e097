// Faces of the Inventor and VRML shapes that list their points. Coin only parses them: its own
// triangles come from code that trusts every index of a file. Included by the inventor files only.
#pragma once
#include <Inventor/actions/SoCallbackAction.h>
#include <Inventor/nodes/SoNode.h>

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace clench {

struct FaceList {
  struct Face {
    int first = 0, count = 0;  ///< of `corners`
    int color = 0;             ///< index of its colour
  };
  int point_count = 0;
  std::function<SbVec3f(int)> point;
  std::vector<int> corners;  ///< indices of points, checked
  std::vector<Face> faces;
  std::vector<SbColor> colors;  ///< empty: the colours of the material in force
  bool convex = false;          ///< the file says that all are
  bool clockwise = false;       ///< corners run clockwise seen from outside
};

/// "IndexedFaceSet", also for the VRML 2 node.
std::string node_name(const SoNode* node);

/// The faces of a shape that lists its points; empty when it is no such shape.
/// throws Error  "IndexedFaceSet: number 7 of coordIndex: wanted -1 or one of 8 points, got 12"
std::optional<FaceList> list_faces(SoCallbackAction* action, SoNode* shape);

}  // namespace clench
