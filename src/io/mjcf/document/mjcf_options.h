// <option> of an MJCF scene: gravity, time step, and the switches of <flag>.
#pragma once
#include "clench/io/mjcf/document/mjcf_document.h"
#include "clench/spec/world_spec.h"

namespace clench {

/// Sets gravity, time_step and collision_on. Warns of other options that would change the
/// simulation.
/// throws  Error for an invalid number or word
void read_mjcf_options(MjcfDocument& document, const FileCache& cache, WorldSpec& world);

}  // namespace clench
