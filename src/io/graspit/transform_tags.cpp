#include "clench/io/graspit/transform_tags.h"

#include <algorithm>

namespace clench {

// one element as a line of the text formats
Pose read_transform_element(const Line& line, std::string_view tag, std::string_view value,
                            const Diagnostics& diagnostics) {
  if (tag == "fullTransform") return read_full_transform(line, trim(value), diagnostics);
  const char* key = tag == "translation"      ? "t "
                    : tag == "rotation"       ? "r "
                    : tag == "rotationMatrix" ? "R "
                                              : nullptr;
  if (!key)
    line.fail("expected translation, rotation, rotationMatrix or fullTransform, got <{}>",
              excerpt(tag));
  const std::string file = line.place().file;
  LineReader one(file, std::string(line.number() - 1, '\n') + key + std::string(value));
  Line entry;
  while (!one.done()) entry = one.next();
  return read_transform(entry, one, diagnostics);
}

Pose read_tagged_transform(const Line& line, LineReader& lines, const Diagnostics& diagnostics) {
  // the element as one text, white space between its parts
  const std::string_view name = line.text().substr(1, line.text().find_first_of("> ") - 1);
  const std::string closing = "</" + std::string(name) + ">";
  std::string text(line.text());
  while (text.find(closing) == std::string::npos) {
    if (lines.done())
      line.fail("expected </{0}> for <{0}>, got the end of the file", excerpt(name));
    text += ' ';
    text += lines.next().text();
  }
  if (name == "transform") {
    text = text.substr(text.find('>') + 1);
    text = text.substr(0, text.find(closing));
  }

  std::optional<Pose> total;  // a single transform is kept bit-exactly
  std::string_view rest = trim(text);
  while (!rest.empty()) {
    const size_t head = rest.find('>');
    if (rest.front() != '<' || head == std::string_view::npos || head < 2)
      line.fail("transform: expected an element such as <translation>, got {}", in_quotes(rest));
    const std::string_view tag = trim(rest.substr(1, head - 1));
    const std::string end = "</" + std::string(tag) + ">";
    const size_t tail = rest.find(end, head);
    if (tail == std::string_view::npos)
      line.fail("transform: expected </{0}> for <{0}>", excerpt(tag));
    const Pose next =
        read_transform_element(line, tag, rest.substr(head + 1, tail - head - 1), diagnostics);
    total = total ? *total * next : next;
    rest = trim(rest.substr(tail + end.size()));
  }
  return total.value_or(Pose{});
}

Pose read_transform_of(const XmlElement& element, const Diagnostics& diagnostics) {
  const XmlElement transform = element.child("transform");
  if (!transform) return {};
  std::optional<Pose> total;  // a single transform is kept bit-exactly
  for (const XmlElement& e : transform.children()) {
    std::string value = e.text();
    std::replace(value.begin(), value.end(), '\n', ' ');
    const Pose next = read_transform_element(e.as_line(value), e.name(), value, diagnostics);
    total = total ? *total * next : next;
  }
  transform.check({.many = {"translation", "rotation", "rotationMatrix", "fullTransform"}},
                  diagnostics);
  return total.value_or(Pose{});
}

}  // namespace clench
