#include "io/file_kind.h"

#include <algorithm>
#include <iterator>
#include <string_view>

#include "base/text.h"
#include "io/xml.h"

namespace clench {

struct Mark {
  std::string_view text;
  FileKind kind;
};

// a Lua file may hold anything; those that name a world return one
static constexpr Mark endings[] = {
    {".wld", FileKind::world},       {".lua", FileKind::world},
    {".cfg", FileKind::robot},       {".urdf", FileKind::robot},
    {".xacro", FileKind::robot},     {".mjcf", FileKind::robot},
    {".egr", FileKind::eigengrasps}, {".vgr", FileKind::virtual_contacts},
    {".iv", FileKind::body},         {".wrl", FileKind::body},
    {".obj", FileKind::body},        {".stl", FileKind::body},
    {".ply", FileKind::body},        {".off", FileKind::body},
    {".gltf", FileKind::body},       {".glb", FileKind::body},
    {".dae", FileKind::body},
};

// the outermost element of a body is called as its author likes
static constexpr Mark roots[] = {
    {"world", FileKind::world},
    {"robot", FileKind::robot},
    {"mujoco", FileKind::robot},
    {"EigenGrasps", FileKind::eigengrasps},
    {"virtual_contacts", FileKind::virtual_contacts},
};

FileKind file_kind(const std::filesystem::path& path) {
  const std::string ending = lower_case(path.extension().string());
  const auto find = [](const auto& marks, std::string_view text) {
    return std::find_if(std::begin(marks), std::end(marks),
                        [&](const Mark& mark) { return mark.text == text; });
  };
  if (ending == ".xml") {
    const std::string text = read_text(path);
    const auto* root = find(roots, xml_root_name(text));
    return root == std::end(roots) ? FileKind::body : root->kind;
  }
  const auto* mark = find(endings, ending);
  if (mark == std::end(endings))
    fail("{}: wanted a model, a world, eigengrasps or virtual contacts, got {}",
         path.filename().string(), in_quotes(ending));
  return mark->kind;
}

const char* kind_name(FileKind kind) {
  static constexpr const char* names[] = {"body", "robot", "world", "eigengrasps",
                                          "virtual contacts"};
  return names[static_cast<int>(kind)];
}

}  // namespace clench
