#include "clench/render/view/render_options.h"

#include <cstdint>
#include <utility>

#include "clench/base/error.h"

namespace clench {

// takes some minutes without graphics hardware
static constexpr int64_t max_drawn = int64_t{1} << 30;
// of a draft that is reduced, which is completely in memory
static constexpr int64_t max_large = int64_t{1} << 27;

void check(const RenderOptions& options) {
  for (const auto& [name, value] :
       {std::pair("width", options.width), std::pair("height", options.height)})
    if (value < options.min_size || value > options.max_size)
      fail("picture: {} must be between {} and {} pixels, got {}", name, options.min_size,
           options.max_size, value);
  if (options.samples < 1 || options.samples > 256)
    fail("picture: samples must be between 1 and 256, got {}", options.samples);
  if (options.draft_scale < 1 || options.draft_scale > options.max_draft_scale)
    fail("picture: scale of a draft must be between 1 and {}, got {}", options.max_draft_scale,
         options.draft_scale);
  const int64_t pixels = int64_t{options.width} * options.height;
  if (const int64_t large = pixels * options.draft_scale * options.draft_scale;
      options.draft_scale > 1 && large > max_large)
    fail(ErrorKind::limit, "picture: expected at most {} pixels times samples of a draft, got {}",
         max_large, large);
  const int64_t drawn = pixels * options.samples;
  if (drawn > max_drawn)
    fail(ErrorKind::limit, "picture: expected at most {} pixels times samples, got {}", max_drawn,
         drawn);
  if (!(options.outline >= 0 && options.outline <= 32))
    fail("picture: outline must be between 0 and 32 pixels, got {}", options.outline);
  if (!(options.letters >= 0 && options.letters <= 200))
    fail("picture: letters must be between 0 and 200 pixels, got {}", options.letters);
}

}  // namespace clench
