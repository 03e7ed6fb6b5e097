// Friction of geoms under the combination rule of MuJoCo, and pairs that do not collide.
#pragma once
#include <map>
#include <string>
#include <vector>

#include "clench/io/mjcf_write/written_scene.h"

namespace clench {

/// Two bodies of a scene whose geoms are listed as pairs, with a separate coefficient.
struct FrictionPair {
  int a = 0, b = 0;
  double mu = 0;
};

struct WrittenContacts {
  std::map<std::string, double> friction;     ///< of geoms, by material
  std::vector<FrictionPair> pairs;            ///< those that the friction of geoms cannot express
  std::vector<std::array<int, 2>> excluded;   ///< indices of bodies
  std::vector<std::array<unsigned, 2>> bits;  ///< contype, conaffinity of each body
  std::vector<std::string> losses;
};

/// MuJoCo uses the larger friction of two geoms. Each material receives the smallest coefficient
/// that it has with any material that it can touch; pairs that differ then are listed.
WrittenContacts plan_contacts(const SceneRequest& request, const WrittenScene& scene);

}  // namespace clench
