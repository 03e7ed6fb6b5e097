// contact: a point where one body touches another, as it was when it was asked for.
#pragma once
#include "script/handles.h"

namespace clench {

struct ContactHandle {
  WorldPtr world;
  Contact contact;
  std::shared_ptr<const SoftPatch> patch = nullptr;  ///< once it was asked for
};

extern const Class contact_class;

template <>
inline const Class& class_of<ContactHandle>() {
  return contact_class;
}

/// A list of contacts.
int push_contacts(lua_State* L, const WorldPtr& world, const std::vector<Contact>& contacts);

}  // namespace clench
