// Images that files name as textures; each is read once, within a memory budget.
#pragma once
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>

#include "clench/io/mesh/image_file.h"
#include "clench/io/text/read_options.h"

namespace clench {

/// Longest side of stored images; larger ones are halved until they fit [pixels].
inline constexpr int largest_texture_side = 4096;

class TextureFiles {
 public:
  using Warn = std::function<void(const std::string& sentence)>;

  /// The image that a file names.
  /// warn     called once for each image that cannot be read
  /// returns  null if it cannot be read
  std::shared_ptr<const Image> find(const std::string& name, const std::filesystem::path& referrer,
                                    const ReadOptions& options, const Warn& warn);
  /// The image decoded from the bytes that `read` returns, stored under a key; otherwise as find.
  std::shared_ptr<const Image> decode(const std::string& key, const std::string& shown,
                                      const std::function<std::string()>& read, const Warn& warn);

 private:
  ImageBudget budget_;
  std::map<std::string, std::shared_ptr<const Image>> images_;  // null: not readable
};

}  // namespace clench
