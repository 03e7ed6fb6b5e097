#include "clench/script/lua/check.h"

#include "clench/base/error.h"

namespace clench {

void fail_self(lua_State* L, const Class& kind) {
  const std::string name = subject(L);
  const bool closed = has_class(L, 1, kind);
  if (closed) fail("{}: the {} was closed", name, kind.name);
  const bool method = name.find(':') != std::string::npos;
  fail("{}: expected {}{}, got {}{}", name, with_article(kind.name),
       method ? " before the colon" : "", described(L, 1), method ? "; use " + name + "(...)" : "");
}

void fail_object(const What& what, const Class& kind, int index) {
  const std::string expected = with_article(kind.name);
  if (has_class(what.L, index, kind))
    fail("{}: expected {}, got one that was closed", what.text(), expected);
  fail_expected(what, expected, index);
}

}  // namespace clench
