// virtual_contact: a place on a link where a hand would like to touch.
#pragma once
#include "script/handles.h"

namespace clench {

struct VirtualContactHandle {
  RobotHandle robot;
  VirtualContactSpec contact;
};

extern const Class virtual_contact_class;

template <>
inline const Class& class_of<VirtualContactHandle>() {
  return virtual_contact_class;
}

inline size_t owned_bytes(const VirtualContactHandle& handle) {
  return static_cast<size_t>(handle.contact.edges.size()) * sizeof(double);
}

/// A list of virtual contacts.
int push_virtual_contacts(lua_State* L, const RobotHandle& robot,
                          const std::vector<VirtualContactSpec>& contacts);

/// The virtual contact that a value stands for: one of any hand's, a contact of the robot, or a table
/// {link = body | name | number, chain = number, frame = pose | point = , normal = , mu = , edges = }.
/// throws  Error that names what is wrong
VirtualContactSpec read_virtual_contact(lua_State* L, int i, const What& what,
                                        const RobotHandle& robot);

}  // namespace clench
