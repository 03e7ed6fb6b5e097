// The font that tests of pictures share.
#pragma once
#include "clench/render/figure/lettering.h"

namespace clench::test {

/// The font of pictures, read by the first test case that writes.
inline const Font& letters() {
  static const Font font;
  return font;
}

}  // namespace clench::test
