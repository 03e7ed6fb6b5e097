// Files to specs: the only door. Each format has its own file behind it.
#pragma once
#include "clench/io/text/find_file.h"
#include "clench/spec/world_spec.h"

namespace clench {

/// A body from .xml, .iv .wrl .vrml (millimeters), .off .ply .obj .stl .gltf .glb .dae, in any
/// case.
/// throws Error  "flask.iv:31: ..." one sentence: place, subject, expected, got
BodySpec read_body(const std::filesystem::path& path, const ReadOptions& options = {});

/// A robot from .cfg or .xml of GraspIt!, .urdf, .mjcf, or .xml that holds one of these.
RobotSpec read_robot(const std::filesystem::path& path, const ReadOptions& options = {});

/// A world from .wld, .xml or a scene of MJCF; with one thing in it from the file of a robot or a
/// body.
WorldSpec read_world(const std::filesystem::path& path, const ReadOptions& options = {});

}  // namespace clench
