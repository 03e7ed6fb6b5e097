#include "io/file_kind.h"

#include <algorithm>
#include <iterator>

#include "base/text.h"
#include "io/xml.h"

namespace clench {

namespace {

using Format = GeometryFormat;

struct Ending {
  std::string_view text;
  FileKind kind;
  Format format = Format::none;
};

// a Lua file may hold anything; those that name a world return one
constexpr Ending known_endings[] = {
    {".wld", FileKind::world},
    {".lua", FileKind::world},
    {".cfg", FileKind::robot},
    {".urdf", FileKind::robot},
    {".xacro", FileKind::robot},
    {".mjcf", FileKind::robot},
    {".egr", FileKind::eigengrasps},
    {".vgr", FileKind::virtual_contacts},
    {".iv", FileKind::body, Format::inventor},
    {".wrl", FileKind::body, Format::inventor},
    {".vrml", FileKind::body, Format::inventor},
    {".off", FileKind::body, Format::off},
    {".ply", FileKind::body, Format::ply},
    {".obj", FileKind::body, Format::obj},
    {".stl", FileKind::body, Format::stl},
    {".gltf", FileKind::body, Format::gltf},
    {".glb", FileKind::body, Format::gltf},
    {".dae", FileKind::body, Format::collada},
};

struct Root {
  std::string_view text;
  FileKind kind;
};

// the outermost element of a body is called as its author likes
constexpr Root roots[] = {
    {"world", FileKind::world},
    {"robot", FileKind::robot},
    {"mujoco", FileKind::robot},
    {"EigenGrasps", FileKind::eigengrasps},
    {"virtual_contacts", FileKind::virtual_contacts},
};

template <class Entries>
auto find(const Entries& entries, std::string_view text) {
  const auto* found = std::ranges::find_if(entries, [&](const auto& e) { return e.text == text; });
  return found == std::end(entries) ? nullptr : found;
}

}  // namespace

FileKind file_kind(const std::filesystem::path& path) {
  const std::string ending = ending_of(path);
  if (ending == ".xml") {
    const std::string text = read_text(path);
    const Root* root = find(roots, xml_root_name(text));
    return root ? root->kind : FileKind::body;
  }
  const Ending* known = find(known_endings, ending);
  if (!known)
    fail("{}: wanted a model, a world, eigengrasps or virtual contacts, got {}",
         path.filename().string(), in_quotes(ending));
  return known->kind;
}

const char* kind_name(FileKind kind) {
  static constexpr const char* names[] = {"body", "robot", "world", "eigengrasps",
                                          "virtual contacts"};
  return names[static_cast<int>(kind)];
}

std::string ending_of(const std::filesystem::path& path) {
  return lower_case(path.extension().string());
}

GeometryFormat geometry_format(std::string_view ending) {
  const Ending* known = find(known_endings, ending);
  return known ? known->format : Format::none;
}

bool is_inventor(const std::filesystem::path& path) {
  return geometry_format(ending_of(path)) == Format::inventor;
}

std::vector<std::string> geometry_endings() {
  std::vector<std::string> out;
  for (const Ending& e : known_endings)
    if (e.format != Format::none) out.emplace_back(e.text);
  return out;
}

std::vector<std::string> body_endings() {
  std::vector<std::string> out = geometry_endings();
  out.insert(out.begin(), ".xml");
  return out;
}

std::vector<std::string> endings_of(GeometryFormat format) {
  std::vector<std::string> out;
  for (const Ending& e : known_endings)
    if (e.format == format) out.emplace_back(e.text);
  return out;
}

std::string one_of(const std::vector<std::string>& endings) {
  std::string out;
  for (size_t i = 0; i < endings.size(); ++i)
    out += (i == 0 ? "" : i + 1 == endings.size() ? " or " : ", ") + endings[i];
  return out;
}

}  // namespace clench
