// vec3: three numbers with the operators of a vector. Wherever one is expected, {x, y, z} will do.
#pragma once
#include <Eigen/Core>

#include "script/object.h"

namespace clench {

extern const Class vec3_class;
extern const Library vec3_library;

template <>
inline const Class& class_of<Eigen::Vector3d>() {
  return vec3_class;
}

/// "(0.1, 0, -2)", six digits
std::string vec3_text(const Eigen::Vector3d& v);

}  // namespace clench
