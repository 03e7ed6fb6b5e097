// clench.random: random numbers that are the same on every machine.
#pragma once
#include "base/random.h"
#include "script/object.h"

namespace clench {

extern const Class random_class;
extern const Library random_library;

template <>
inline const Class& class_of<Random>() {
  return random_class;
}

}  // namespace clench
