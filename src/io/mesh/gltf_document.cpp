#include "clench/io/mesh/gltf_document.h"

#include <algorithm>
#include <cmath>

#include "clench/base/convert.h"
#include "clench/base/file.h"
#include "clench/base/text.h"
#include "clench/io/mesh/geometry_builder.h"

namespace clench {

using nlohmann::json;

namespace {

// parsed JSON takes ten times as much memory
constexpr size_t max_json_bytes = size_t{100} << 20;

/// source  RFC 4648; white space is skipped
std::optional<std::string> decode_base64(std::string_view text) {
  std::string out;
  out.reserve(text.size() / 4 * 3);
  uint32_t bits = 0;
  int held = 0;
  while (!text.empty() && text.back() == '=') text.remove_suffix(1);
  for (const char c : text) {
    int value = -1;
    if (c >= 'A' && c <= 'Z') value = c - 'A';
    if (c >= 'a' && c <= 'z') value = c - 'a' + 26;
    if (c >= '0' && c <= '9') value = c - '0' + 52;
    if (c == '+' || c == '-') value = 62;
    if (c == '/' || c == '_') value = 63;
    if (value < 0) return {};
    bits = bits << 6 | static_cast<uint32_t>(value);
    held += 6;
    if (held < 8) continue;
    held -= 8;
    out += static_cast<char>(bits >> held & 0xff);
  }
  return out;
}

/// Decodes "my%20mug.bin" into a file name.
std::string decode_percent(std::string_view text) {
  const auto digit = [](char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
  };
  std::string out;
  for (size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '%' && i + 2 < text.size() && digit(text[i + 1]) >= 0 &&
        digit(text[i + 2]) >= 0) {
      out += static_cast<char>(digit(text[i + 1]) * 16 + digit(text[i + 2]));
      i += 2;
    } else {
      out += text[i];
    }
  }
  return out;
}

// code of the first component type; the others have the order of NumberType
constexpr int first_type = 5120;

bool is_component_type(int type) {
  constexpr int int32 = first_type + static_cast<int>(NumberType::int32);
  return type >= first_type && type <= 5126 && type != int32;
}

/// source  glTF 2.0, section 3.6.2.2 and, for normalized ones, 3.11
double component(ByteReader& bytes, NumberType type, bool normalized) {
  const double value = bytes.next(type);
  if (!normalized || type >= NumberType::uint32) return value;
  constexpr double largest[] = {127, 255, 32767, 65535};
  return std::max(value / largest[static_cast<int>(type)], -1.0);
}

}  // namespace

GltfDocument::GltfDocument(const MeshInput& input)
    : input_(input), file_(input.file()), bytes_(input.bytes.size()) {
  std::string chunk;
  if (input.bytes.starts_with("glTF")) split_glb(input.bytes, chunk);
  const std::string& text = binary_ ? chunk : input.bytes;
  if (text.size() > max_json_bytes)
    fail("expected at most {} MB of JSON, got {}", max_json_bytes >> 20, text.size() >> 20);
  try {
    json_ = json::parse(text);
  } catch (const json::parse_error& error) {
    const size_t at = std::min(error.byte, text.size());
    const auto line = 1 + std::count(text.begin(), text.begin() + static_cast<long>(at), '\n');
    clench::fail("{}:{}: expected JSON, got something else at byte {} of it", file_, line, at);
  } catch (const json::out_of_range&) {
    fail("expected JSON with numbers of at most 1.8e308, got a larger one");
  }
  if (!json_.is_object()) fail("expected a JSON object, got a JSON {}", json_.type_name());
  check_version();
}

/// source  glTF 2.0, section 4.4
void GltfDocument::split_glb(const std::string& bytes, std::string& text) {
  binary_ = true;
  constexpr uint32_t json_chunk = 0x4E4F534A, binary_chunk = 0x004E4942;
  ByteReader reader(bytes);
  reader.skip(4);
  const auto version = reader.next<uint32_t>();
  if (version != 2) fail("expected glTF of version 2, got version {}", version);
  reader.skip(4);
  bool any = false;
  while (reader.left() >= 8) {
    const auto length = reader.next<uint32_t>(), type = reader.next<uint32_t>();
    if (length > reader.left())
      fail("expected a chunk of {} bytes, got {} to the end of the file", length, reader.left());
    if (type == json_chunk && !any)
      text = bytes.substr(reader.position(), length);
    else if (type == binary_chunk && glb_buffer_.empty())
      glb_buffer_ = bytes.substr(reader.position(), length);
    any = any || type == json_chunk;
    reader.skip(length);
  }
  if (!any) fail("expected a chunk of JSON, got none");
}

void GltfDocument::check_version() const {
  const GltfValue asset = member(root(), "asset"), version = member(asset, "version");
  if (!version || !version.json->is_string()) fail("expected asset.version 2.0, got none");
  const auto& text = version.json->get_ref<const std::string&>();
  if (!text.starts_with("2.")) fail("expected glTF of version 2, got {}", in_quotes(text));
  for (const GltfValue& required : items(member(root(), "extensionsRequired"))) {
    const std::string name = required.json->is_string() ? required.json->get<std::string>() : "";
    // materials, and integer coordinates, which are accepted in every accessor here
    const bool harmless = name.starts_with("KHR_materials") || name.starts_with("KHR_texture") ||
                          name.starts_with("KHR_lights") || name.starts_with("EXT_texture") ||
                          name == "KHR_mesh_quantization";
    if (!harmless)
      fail("it cannot be read without the extension {}, which is not supported", in_quotes(name));
  }
}

GltfValue GltfDocument::member(const GltfValue& object, const char* key) const {
  if (!object || !object.json->is_object()) return {};
  const auto found = object.json->find(key);
  if (found == object.json->end()) return {};
  return {&*found, object.name.empty() ? key : object.name + "." + key};
}

std::vector<GltfValue> GltfDocument::items(const GltfValue& array) const {
  std::vector<GltfValue> out;
  if (!array) return out;
  if (!array.json->is_array())
    fail("{}: expected an array, got a {}", array.name, array.json->type_name());
  for (size_t i = 0; i < array.json->size(); ++i)
    out.push_back({&(*array.json)[i], fmt::format("{}[{}]", array.name, i)});
  return out;
}

int GltfDocument::count(const char* array) const {
  const GltfValue found = member(root(), array);
  return found && found.json->is_array() ? static_cast<int>(found.json->size()) : 0;
}

GltfValue GltfDocument::item(const char* array, int i, const std::string& expected_by) const {
  const int available = count(array);
  if (i < 0 || i >= available)
    fail("{}: expected one of {} {}, got {}", expected_by, available, array, i);
  return {&json_[array][static_cast<size_t>(i)], fmt::format("{}[{}]", array, i)};
}

int GltfDocument::integer(const GltfValue& object, const char* key, int fallback, int low) const {
  const GltfValue found = member(object, key);
  if (!found) return fallback;
  const bool whole = found.json->is_number_integer();
  if (!whole || *found.json < low || *found.json > std::numeric_limits<int>::max())
    fail("{}: {}", found.name,
         integer_fault(found.json->dump(), low, std::numeric_limits<int>::max()));
  return found.json->get<int>();
}

int GltfDocument::expected_integer(const GltfValue& object, const char* key, int low) const {
  if (!member(object, key)) fail("{}: expected '{}', got none", object.name, key);
  return integer(object, key, 0, low);
}

std::vector<double> GltfDocument::numbers(const GltfValue& array, int count) const {
  std::vector<double> out;
  for (const GltfValue& item : items(array)) {
    if (!item.json->is_number()) fail("{}: expected a number", item.name);
    out.push_back(item.json->get<double>());
    if (!std::isfinite(out.back())) fail("{}: expected a finite number", item.name);
  }
  if (static_cast<int>(out.size()) != count)
    fail("{}: expected {} numbers, got {}", array.name, count, out.size());
  return out;
}

std::string GltfDocument::bytes_at(const GltfValue& uri) const {
  if (!uri.json->is_string()) fail("{}: expected a name", uri.name);
  const auto& name = uri.json->get_ref<const std::string&>();
  if (!name.starts_with("data:"))
    return read_bytes(find_file(decode_percent(name), input_.path, input_.options));
  const size_t comma = name.find(";base64,");
  auto decoded = comma == std::string::npos
                     ? std::nullopt
                     : decode_base64(std::string_view(name).substr(comma + 8));
  if (!decoded) fail("{}: expected data in base64", uri.name);
  return std::move(*decoded);
}

std::string GltfDocument::image_bytes(int image, const std::string& expected_by) {
  const GltfValue value = item("images", image, expected_by);
  if (const GltfValue uri = member(value, "uri")) return bytes_at(uri);
  const GltfValue view = item("bufferViews", expected_integer(value, "bufferView"), value.name);
  const std::string& data = buffer(expected_integer(view, "buffer"), view.name);
  const int64_t start = integer(view, "byteOffset", 0),
                length = expected_integer(view, "byteLength");
  if (start + length > static_cast<int64_t>(data.size()))
    fail("{}: expected {} bytes of its buffer, got {}", view.name, start + length, data.size());
  return data.substr(static_cast<size_t>(start), static_cast<size_t>(length));
}

const std::string& GltfDocument::buffer(int i, const std::string& expected_by) {
  const GltfValue value = item("buffers", i, expected_by), uri = member(value, "uri");
  if (const auto found = buffers_.find(i); found != buffers_.end()) return found->second;
  std::string bytes;
  if (!uri) {
    if (i != 0 || !binary_) fail("{}: expected a uri, got none", value.name);
    bytes = std::move(glb_buffer_);
  } else {
    bytes = bytes_at(uri);
  }
  const int length = expected_integer(value, "byteLength", 1);
  if (bytes.size() < static_cast<size_t>(length))
    fail("{}: expected {} bytes, got {}", value.name, length, bytes.size());
  if (uri) bytes_ += bytes.size();
  return buffers_.emplace(i, std::move(bytes)).first->second;
}

GltfDocument::Span GltfDocument::span(int accessor, const char* shape, int components,
                                      const std::string& expected_by) {
  const GltfValue value = item("accessors", accessor, expected_by);
  if (member(value, "sparse")) fail("{}: sparse accessors are not supported", value.name);
  const GltfValue given = member(value, "type");
  if (!given || *given.json != shape) fail("{}: expected the type {}", value.name, shape);
  Span out;
  out.name = value.name;
  out.count = expected_integer(value, "count", 1);
  const int type = expected_integer(value, "componentType");
  if (!is_component_type(type)) fail("{}: unknown componentType {}", value.name, type);
  out.type = static_cast<NumberType>(type - first_type);
  const int bytes = static_cast<int>(bytes_of(out.type)) * components;
  const GltfValue normalized = member(value, "normalized");
  out.normalized = normalized && *normalized.json == true;

  const GltfValue view = item("bufferViews", expected_integer(value, "bufferView"), value.name);
  const std::string& data = buffer(expected_integer(view, "buffer"), view.name);
  out.stride = integer(view, "byteStride", bytes, bytes);
  const int64_t start = integer(view, "byteOffset", 0),
                length = expected_integer(view, "byteLength"),
                offset = integer(value, "byteOffset", 0);
  if (start + length > static_cast<int64_t>(data.size()))
    fail("{}: expected {} bytes of its buffer, got {}", view.name, start + length, data.size());
  const int64_t expected = offset + int64_t{out.stride} * (out.count - 1) + bytes;
  if (expected > length)
    fail("{}: expected {} bytes of {}, got {}", value.name, expected, view.name, length);
  out.first = data.data() + start + offset;
  return out;
}

std::vector<double> GltfDocument::read_floats(int accessor, int components,
                                              const std::string& expected_by) {
  static constexpr const char* types[] = {"", "SCALAR", "VEC2", "VEC3", "VEC4"};
  const Span s = span(accessor, types[components], components, expected_by);
  const size_t bytes = bytes_of(s.type) * static_cast<size_t>(components);
  std::vector<double> out;
  out.reserve(static_cast<size_t>(s.count) * static_cast<size_t>(components));
  for (int i = 0; i < s.count; ++i) {
    ByteReader reader(std::string_view(s.first + int64_t{i} * s.stride, bytes));
    for (int k = 0; k < components; ++k) {
      out.push_back(component(reader, s.type, s.normalized));
      if (!std::isfinite(out.back()))
        fail("{}: item {}: expected finite numbers, got {}", s.name, i, out.back());
    }
  }
  return out;
}

std::vector<int> GltfDocument::read_indices(int accessor, const std::string& expected_by) {
  const Span s = span(accessor, "SCALAR", 1, expected_by);
  if (s.type != NumberType::uint8 && s.type != NumberType::uint16 && s.type != NumberType::uint32)
    fail("{}: expected indices of an unsigned componentType, got {}", s.name,
         first_type + static_cast<int>(s.type));
  std::vector<int> out;
  out.reserve(static_cast<size_t>(s.count));
  for (int i = 0; i < s.count; ++i) {
    ByteReader reader(std::string_view(s.first + int64_t{i} * s.stride, bytes_of(s.type)));
    out.push_back(floor_int(reader.next(s.type)));
  }
  return out;
}

}  // namespace clench
