#include "clench/io/mesh/collada_textures.h"

#include <fmt/format.h>

#include <charconv>

namespace clench {

namespace {

// a <newparam> with that sid in a profile or its technique
XmlElement effect_parameter(const XmlElement& profile, const std::string& sid) {
  for (const XmlElement& place : {profile, profile.child("technique")}) {
    if (!place) continue;
    for (const XmlElement& param : place.children("newparam"))
      if (param.attribute("sid") == sid) return param;
  }
  return {};
}

// Path named by a URI: "file:///a%20b.png".
std::string path_of(std::string uri) {
  if (uri.starts_with("file://")) uri = uri.substr(7);
  std::string out;
  for (size_t i = 0; i < uri.size(); ++i) {
    unsigned value = 0;
    const char* hexadecimal = uri.data() + i + 1;
    if (uri[i] == '%' && i + 2 < uri.size() &&
        std::from_chars(hexadecimal, hexadecimal + 2, value, 16).ptr == hexadecimal + 2) {
      out.push_back(static_cast<char>(value));
      i += 2;
    } else {
      out.push_back(uri[i]);
    }
  }
  return out;
}

Wrap wrap_of(const XmlElement& sampler, const char* name) {
  const XmlElement wrap = sampler ? sampler.child(name) : XmlElement();
  const std::string word = wrap ? wrap.text() : "WRAP";
  return word == "WRAP" ? Wrap::repeat : word.starts_with("MIRROR") ? Wrap::mirror : Wrap::clamp;
}

// input set of the coordinates that a <texture> names
std::optional<int> coordinate_set(const XmlElement& texture, const XmlElement& material) {
  const auto name = texture.attribute("texcoord");
  for (const XmlElement& bound : material.children("bind_vertex_input"))
    if (bound.attribute("semantic") == name && bound.attribute("input_set"))
      return bound.integer_attribute("input_set", 0);
  return {};
}

}  // namespace

XmlElement inner_element(XmlElement element, std::initializer_list<const char*> path) {
  for (const char* name : path)
    if (element) element = element.child(name);
  return element;
}

/// The image of an <image> of version 1.4 or 1.5.
std::shared_ptr<const Image> ColladaTextures::image(const XmlElement& element) {
  XmlElement from = element.child("init_from");
  if (const XmlElement ref = inner_element(from, {"ref"})) from = ref;
  const std::string name = from ? path_of(from.text()) : "";
  if (name.empty()) {
    work_.warnings.insert(fmt::format("image {}: it names no file; its color is gray",
                                      in_quotes(element.attribute("id").value_or(""))));
    return nullptr;
  }
  return files_.find(name, input_.path, input_.options,
                     [&](const std::string& sentence) { work_.warnings.insert(sentence); });
}

/// source  COLLADA 1.4.1 and 1.5.0: texture, sampler2D, surface, image
ColladaLook ColladaTextures::look(const XmlElement& texture, const XmlElement& profile,
                                  const XmlElement& material) {
  const std::string name = texture.expected_attribute("texture");
  const XmlElement sampler = inner_element(effect_parameter(profile, name), {"sampler2D"});
  XmlElement found;
  if (const XmlElement instance = inner_element(sampler, {"instance_image"})) {
    found = ids_.find(instance, "url");
  } else if (const XmlElement source = inner_element(sampler, {"source"})) {
    const XmlElement from =
        inner_element(effect_parameter(profile, source.text()), {"surface", "init_from"});
    if (from) found = ids_.named(from.text());
  } else {
    found = ids_.named(name);  // some exporters refer to the image directly
  }
  ColladaLook out;
  if (!found || found.name() != "image") {
    work_.warnings.insert(
        fmt::format("a texture {} that refers to no image is not used", in_quotes(name)));
    return out;
  }
  out.image = image(found);
  if (!out.image) return out;
  out.given = true;
  out.color.setOnes();
  out.set = coordinate_set(texture, material);
  const Texture made{out.image, wrap_of(sampler, "wrap_s"), wrap_of(sampler, "wrap_t")};
  const std::string key = fmt::format("{} {} {}", static_cast<const void*>(out.image.get()),
                                      static_cast<int>(made.wrap_u), static_cast<int>(made.wrap_v));
  const auto [number, is_new] =
      numbers_.emplace(key, static_cast<int>(work_.builder.textures.size()));
  if (is_new) work_.builder.textures.push_back(made);
  out.texture = number->second;
  return out;
}

}  // namespace clench
