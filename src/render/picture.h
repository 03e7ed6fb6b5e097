// Pictures as values, and PNG files.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace clench {

/// RGB, 8 bits a channel, rows from the top.
struct Picture {
  int width = 0, height = 0;
  std::vector<uint8_t> pixels;
};

/// throws Error naming the path when it cannot be written
void save_png(const Picture& picture, const std::string& path);

}  // namespace clench
