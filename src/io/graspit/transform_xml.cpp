#include "clench/io/graspit/transform_xml.h"

#include <algorithm>

#include "clench/io/graspit/transform_tags.h"

namespace clench {

Pose read_transform_xml(const XmlElement& transform, const Listeners& listeners) {
  std::optional<Pose> total;  // the only one is kept to the bit
  for (const XmlElement& e : transform.children()) {
    std::string value = e.text();
    std::replace(value.begin(), value.end(), '\n', ' ');
    const Pose next = read_transform_element(e.as_line(value), e.name(), value, listeners);
    total = total ? *total * next : next;
  }
  transform.check({.many = {"translation", "rotation", "rotationMatrix", "fullTransform"}},
                  listeners.warn);
  return total.value_or(Pose{});
}

Pose read_transform_of(const XmlElement& element, const Listeners& listeners) {
  const XmlElement transform = element.child("transform");
  return transform ? read_transform_xml(transform, listeners) : Pose{};
}

}  // namespace clench
