#include "clench/io/text/grasp_sink.h"

#include <algorithm>

namespace clench {

namespace {

// header of a heap block and rounding of its size
constexpr size_t heap_block = 16;
// a grasp in a list of a script: the spec, its contacts and wrench spaces
constexpr size_t grasp_bytes = sizeof(GraspSpec) + 80;
// node of a map: three links, a color, and its heap block
constexpr size_t node_bytes = 32 + heap_block;

size_t memory_of(const std::string& text) {
  return text.capacity() < sizeof(std::string) / 2 ? 0 : text.capacity() + heap_block;
}

template <class T>
size_t memory_of(const std::vector<T>& list) {
  size_t out = list.empty() ? 0 : list.capacity() * sizeof(T) + heap_block;
  if constexpr (std::is_same_v<T, std::string>)
    for (const std::string& text : list) out += memory_of(text);
  return out;
}

template <class T>
size_t memory_of(const std::map<std::string, T>& named) {
  size_t out = 0;
  for (const auto& [name, value] : named) {
    out += node_bytes + sizeof(name) + sizeof(value) + memory_of(name);
    if constexpr (std::is_same_v<T, std::string>) out += memory_of(value);
  }
  return out;
}

}  // namespace

size_t memory_of(const GraspSpec& g) {
  size_t out = grasp_bytes;
  for (const std::string* text :
       {&g.hand_name, &g.object_name, &g.hand_file, &g.object_file, &g.hand_fingerprint,
        &g.object_fingerprint, &g.settings_fingerprint, &g.engine_version})
    out += memory_of(*text);
  for (const auto* numbers : {&g.dofs, &g.joints, &g.options.normal_force.values})
    out += memory_of(*numbers);
  for (const auto* texts : {&g.dof_names, &g.dof_units, &g.links}) out += memory_of(*texts);
  out += memory_of(g.points) + memory_of(g.measures) + memory_of(g.info) + memory_of(g.labels);
  if (g.pregrasp) out += memory_of(g.pregrasp->dofs);
  return out;
}

void GraspCollector::expect(size_t count) {
  if (sink_.expect) sink_.expect(std::min(count, budget_.left() / grasp_bytes));
}

void GraspCollector::add(GraspSpec&& grasp) {
  budget_.take(memory_of(grasp));
  sink_.add(std::move(grasp));
}

}  // namespace clench
