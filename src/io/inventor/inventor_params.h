// The '#key' lines of Inventor and VRML files, by which a geometry file says what its body is made
// of.
#pragma once
#include "clench/io/text/find_file.h"
#include "clench/spec/body_spec.h"

namespace clench {

/// Reads material, youngs, useFlockOfBirds, mass, cog, inertia_matrix into the body; the last of a
/// key counts. `text` is what the file holds, `file` its name in errors.
/// throws Error  "box.iv:4: mass: expected a number > 0 [g], got -2"
void read_inventor_params(const std::string& text, const std::string& file,
                          const ReadOptions& options, BodySpec& body);

}  // namespace clench
