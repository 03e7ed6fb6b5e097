// Elements of MJCF that generate others: <replicate> and <attach>.
#pragma once
#include <cstdint>

#include "clench/io/mjcf/document/mjcf_document.h"

namespace clench {

/// Limits on the elements that <replicate> and <attach> generate in a file, and on those that they
/// search for names, counted once per search.
inline constexpr int max_generated_elements = 100'000;
inline constexpr int64_t max_searched_elements = 20'000'000;

/// Replaces each <replicate> and <attach> below <worldbody> by the elements that it generates:
/// frames with renamed copies of bodies and geoms. Tendons, actuators, equalities and contact
/// filters that refer to copied elements are copied, too.
/// returns  the document
/// throws  Error  "scene.xml:12: attach: model: no model 'hnd'; did you mean 'hand'?"
MjcfDocument& expand_mjcf(MjcfDocument& document, FileCache& cache);

}  // namespace clench
