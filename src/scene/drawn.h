// Lists of items to be drawn, independent of the world and of graphics libraries.
#pragma once
#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "clench/base/id.h"
#include "clench/geometry/tree/shape.h"
#include "clench/math/pose.h"
#include "clench/scene/eye.h"
#include "clench/spec/skin.h"

namespace clench {

struct Body;

/// The part of a world that an entry of a scene shows, used for picking.
struct Shown {
  enum class Kind {
    nothing,
    body,
    contact,   ///< a patch of contacts
    site,      ///< the surfaces of a soft contact
    approach,  ///< the approach direction of a robot
    force,
    floor
  };
  Kind kind = Kind::nothing;
  Id<Body> body = {};   ///< of a contact or site: the touched body; of an approach: the base
  Id<Body> other = {};  ///< the body that touches it
  /// of a contact: index in touch_patches(contacts_on_objects(world)); of a site: in
  /// contacts(world)
  int index = -1;

  bool operator==(const Shown&) const = default;
};

/// Colors are display values (sRGB), each component in 0..1.
struct DrawMesh {
  std::shared_ptr<const Shape> shape;  ///< null: nothing is drawn
  Pose X_WM;
  Eigen::Vector3f color = Eigen::Vector3f(0.7f, 0.7f, 0.7f);
  std::vector<Eigen::Vector3f> triangle_colors = {};  ///< one per triangle, or empty
  SkinPtr skin = {};                                  ///< textures over the colors; null: none
  float opacity = 1;                                  ///< 0 invisible .. 1 opaque
  bool background = false;  ///< a floor: receives shadows, casts none, may extend beyond the frame
  bool framed = true;       ///< false: a computed view may leave it out, in part or completely
  bool hides = false;       ///< counts as opaque when a view is computed, however it is drawn
  Shown shown = {};
};

/// Friction cone: apex at the contact, opening along the axis. A half angle of 0 draws a needle.
struct DrawCone {
  /// world [m]; axis unit
  Eigen::Vector3d apex = Eigen::Vector3d::Zero(), axis = Eigen::Vector3d::UnitZ();
  double half_angle = 0;  ///< [rad], in [0, pi/2)
  double height = 0;      ///< [m]
  Eigen::Vector3f color = Eigen::Vector3f(1, 0.4f, 0.1f);
  Shown shown = {};
};

/// A force, a direction or an axis: a rod with a pointed head that ends at the tip.
struct DrawArrow {
  /// world [m]; an arrow of length zero is not drawn
  Eigen::Vector3d tail = Eigen::Vector3d::Zero(), tip = Eigen::Vector3d::UnitZ();
  double radius = 0.01;  ///< of the rod; its head is three times as wide [m]
  Eigen::Vector3f color = Eigen::Vector3f(1, 0.4f, 0.1f);
  Shown shown = {};
};

/// Text at a point or next to it, in front of everything else. Labels do not overlap: earlier ones
/// have priority, and one that does not fit is left out.
struct DrawLabel {
  Eigen::Vector3d p_W = Eigen::Vector3d::Zero();  ///< [m]
  std::string text = {};                          ///< UTF-8
  Eigen::Vector3f color = Eigen::Vector3f::Zero();
};

struct Scene {
  std::vector<DrawMesh> meshes;
  std::vector<DrawCone> cones;
  std::vector<DrawArrow> arrows = {};
  std::vector<DrawLabel> labels = {};
  std::vector<std::string> caption = {};  ///< lines in the lower left corner, UTF-8
  std::optional<double> ground = {};      ///< height of a floor plane that receives the shadow [m]
  /// points that a computed view should show, such as contacts; empty: cones and arrows. World [m]
  std::vector<Eigen::Vector3d> spots = {};
  /// points that a computed view must hold besides meshes, cones and arrows; world [m]
  std::vector<Eigen::Vector3d> held = {};
  std::optional<Eye> eye = {};  ///< empty: the view is computed to hold everything
};

}  // namespace clench
