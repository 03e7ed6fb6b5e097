// Friction cones in pictures: one per contact patch.
#pragma once
#include <span>
#include <vector>

#include "clench/model/find.h"
#include "clench/scene/drawn.h"
#include "clench/scene/scene_options.h"

namespace clench {

/// Coplanar contacts of two bodies that share a normal: a face on a face touches at the corners of
/// its outline.
struct TouchPatch {
  std::vector<Contact> contacts;                  ///< at least one, in the given order
  Eigen::Vector3d p_W = Eigen::Vector3d::Zero();  ///< mean of the contact points [m]
  Eigen::Vector3d n_W = Eigen::Vector3d::Zero();  ///< unit, into the object
};

/// Groups contacts into patches, in the order of their first contacts.
std::vector<TouchPatch> touch_patches(std::span<const Contact> contacts);

/// One cone per patch, with its apex at the center of the patch and the size set by the options.
/// The force of a patch is that of all its contacts; zero friction draws a needle.
/// throws  Error as make_scene does
std::vector<DrawCone> contact_cones(const World& world, std::span<const TouchPatch> patches,
                                    const SceneOptions& options);

/// Points that show the patches: along their normals within the object; world [m].
std::vector<Eigen::Vector3d> patch_spots(const World& world, std::span<const TouchPatch> patches);

}  // namespace clench
