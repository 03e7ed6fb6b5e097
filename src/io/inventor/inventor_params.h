// '#key' lines of Inventor and VRML files, which specify the material properties of a geometry
// file's body.
#pragma once
#include "clench/io/text/find_file.h"
#include "clench/spec/body_spec.h"

namespace clench {

/// Reads material, youngs, useFlockOfBirds, mass, cog, inertia_matrix into the body; if a key is
/// repeated, the last is used. `text` holds the contents of the file, `file` its name for errors.
/// throws Error  "box.iv:4: mass: expected a number > 0 [g], got -2"
void read_inventor_params(const std::string& text, const std::string& file,
                          const ReadOptions& options, BodySpec& body);

}  // namespace clench
