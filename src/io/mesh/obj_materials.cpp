#include "clench/io/mesh/obj_materials.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>
#include <vector>

#include "clench/base/file.h"
#include "clench/base/text.h"
#include "clench/io/text/word_reader.h"

namespace clench {

Eigen::Vector2d MtlMaterial::placed(const Eigen::Vector2d& uv) const {
  return {image_offset.x() + image_scale.x() * uv.x(),
          1 - (image_offset.y() + image_scale.y() * (1 - uv.y()))};
}

Texture MtlMaterial::texture() const {
  const Wrap wrap = clamped ? Wrap::clamp : Wrap::repeat;
  const bool plain = !colored || color.isZero(0);
  return {image, wrap, wrap, plain ? Eigen::Vector3f::Ones() : color};
}

namespace {

/// Options of map_Kd, and the name of the image, which may contain blanks.
struct ImageStatement {
  bool clamped = false;
  Eigen::Vector2d scale = Eigen::Vector2d::Ones(), offset = Eigen::Vector2d::Zero();
  std::string file = {};
  std::string unused = {};  ///< an option without effect here; empty: none
};

/// source  Wavefront MTL: options of texture maps
ImageStatement image_statement(const std::string& text) {
  ImageStatement out;
  size_t at = 0;
  const auto next = [&](size_t from) {
    const size_t first = std::min(text.find_first_not_of(" \t", from), text.size());
    const size_t end = std::min(text.find_first_of(" \t", first), text.size());
    return std::pair(first, end);
  };
  for (auto [first, end] = next(0); first < end && text[first] == '-';
       std::tie(first, end) = next(at)) {
    const std::string option = text.substr(first, end - first);
    at = end;
    std::vector<double> values;
    const auto value = [&] {
      const auto [a, b] = next(at);
      return text.substr(a, b - a);
    };
    const bool word = option == "-imfchan" || option == "-type" || option == "-colorspace";
    std::string flag;
    if (word || value() == "on" || value() == "off") {
      flag = value();
      at = next(at).second;
    } else {
      for (auto number = parse_number(value()); number && values.size() < 3;
           number = parse_number(value())) {
        values.push_back(std::isfinite(*number) ? *number : 0);
        at = next(at).second;
      }
    }
    if (option == "-clamp")
      out.clamped = flag == "on";
    else if ((option == "-s" || option == "-o") && !values.empty())
      (option == "-s" ? out.scale : out.offset) = {values[0], values.size() > 1 ? values[1]
                                                              : option == "-s"  ? 1.0
                                                                                : 0.0};
    else if (option == "-mm" || option == "-t")
      out.unused = option;
  }
  out.file = text.substr(next(at).first);
  return out;
}

}  // namespace

void MtlMaterials::read(const std::filesystem::path& path, const MeshInput& input,
                        const WarnOnce& warn) {
  const std::string text = read_text(path);
  WordReader words(path.filename().string(), text);
  MtlMaterial* material = nullptr;
  while (words.next_line()) {
    const auto keyword = words.word();
    if (keyword == "newmtl") {
      material = &by_name[std::string(words.rest())];
      *material = {};
      continue;
    }
    if (material && keyword == "map_Kd") {
      const ImageStatement image = image_statement(std::string(words.rest()));
      material->clamped = image.clamped;
      material->image_scale = image.scale, material->image_offset = image.offset;
      material->image = images.find(image.file, path, input.options, [&](const std::string& s) {
        warn("image" + image.file, words.place(), s);
      });
      if (!image.unused.empty())
        warn("option" + image.unused, words.place(),
             fmt::format("map_Kd: the option {} is not used", image.unused));
      continue;
    }
    const bool color = keyword == "Kd", opaque = keyword == "d", transparent = keyword == "Tr";
    if (!material || !(color || opaque || transparent)) continue;
    const auto a = parse_number(words.word());
    const auto b = parse_number(words.word()), c = parse_number(words.word());
    if (color && a && b && c)
      material->color = Eigen::Vector3d(*a, *b, *c).cwiseMax(0).cwiseMin(1).cast<float>(),
      material->colored = true;
    else if (!color && a)
      material->transparency = static_cast<float>(std::clamp(opaque ? 1 - *a : *a, 0.0, 1.0));
    else
      input.diagnostics().warn(words.place(), "expected {} after {}; not used",
                               color ? "three numbers" : "a number", keyword);
  }
}

}  // namespace clench
