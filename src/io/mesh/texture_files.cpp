#include "clench/io/mesh/texture_files.h"

#include <fmt/format.h>

#include "clench/base/error.h"
#include "clench/base/file.h"
#include "clench/io/text/find_file.h"

namespace clench {

static constexpr size_t max_texture_files = 100;  // limit of images per file

std::shared_ptr<const Image> TextureFiles::decode(const std::string& key, const std::string& shown,
                                                  const std::function<std::string()>& read,
                                                  const Warn& warn) {
  const auto [at, is_new] = images_.try_emplace(key);
  if (!is_new) return at->second;
  if (images_.size() > max_texture_files) {
    if (images_.size() == max_texture_files + 1)
      warn(fmt::format("{}: expected at most {} images; this one and further ones are not used",
                       shown, max_texture_files));
    return nullptr;
  }
  try {
    at->second = image_within(std::make_shared<const Image>(decode_image(read(), shown, &budget_)),
                              largest_texture_side);
  } catch (const Error& error) {
    warn(fmt::format("{}; the color of the material is used", error.what()));
  }
  return at->second;
}

std::shared_ptr<const Image> TextureFiles::find(const std::string& name,
                                                const std::filesystem::path& referrer,
                                                const ReadOptions& options, const Warn& warn) {
  const std::string shown = std::filesystem::path(name).filename().string();
  const auto read = [&] { return read_bytes(find_file(name, referrer, options)); };
  return decode(referrer.string() + '\n' + name, shown, read, warn);
}

}  // namespace clench
