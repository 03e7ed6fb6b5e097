// Reads files into specs: the only entry points. Each format has a separate source file.
#pragma once
#include "clench/io/text/find_file.h"
#include "clench/spec/world_spec.h"

namespace clench {

/// A body from .xml, .iv .wrl .vrml (millimeters), .off .ply .obj .stl .gltf .glb .dae, in upper or
/// lower case.
/// throws Error  "flask.iv:31: ..." one sentence: place, subject, expected, got
BodySpec read_body(const std::filesystem::path& path, const ReadOptions& options = {});

/// A robot from a GraspIt! .cfg or .xml, .urdf, .mjcf, or an .xml file that holds one of these.
RobotSpec read_robot(const std::filesystem::path& path, const ReadOptions& options = {});

/// A world from .wld, .xml or an MJCF scene; from the file of a robot or a body, a world that
/// contains only that.
WorldSpec read_world(const std::filesystem::path& path, const ReadOptions& options = {});

}  // namespace clench
