#include "clench/io/write/saved_files.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>

#include "clench/base/hash.h"
#include "clench/base/text.h"
#include "clench/base/units.h"
#include "clench/io/graspit/world_parts.h"
#include "clench/io/mesh/write_mesh.h"
#include "clench/io/read/load.h"
#include "clench/io/text/confine.h"
#include "clench/io/text/xml.h"
#include "clench/spec/material_names.h"

namespace clench {

namespace fs = std::filesystem;

static fs::path absolute_folder(const fs::path& folder) {
  if (folder.empty()) return {};
  const fs::path plain = fs::absolute(folder).lexically_normal();
  return plain.has_filename() ? plain : plain.parent_path();
}

SavedFiles::SavedFiles(const fs::path& path, const WriteOptions& options)
    : path_(fs::absolute(path).lexically_normal()),
      folder_(path_.parent_path()),
      root_(absolute_folder(options.root)),
      reading_{.root = root_, .confine = options.confine},
      cache_(reading_, all_formats),
      diagnostics_(options.diagnostics) {}

// --- names ---

/// `file` relative to the folder; empty if it does not lie below it.
static std::string below(const fs::path& file, const fs::path& folder) {
  if (folder.empty()) return "";
  for (const bool links : {false, true}) {
    std::error_code code;
    const fs::path from = links ? fs::weakly_canonical(folder, code) : folder;
    const fs::path to = links ? fs::weakly_canonical(file, code) : file;
    const fs::path rest = to.lexically_relative(from);
    if (!rest.empty() && *rest.begin() != ".." && *rest.begin() != ".")
      return rest.generic_string();
  }
  return "";
}

bool SavedFiles::finds(const std::string& name, const std::string& file) const {
  if (name.empty()) return false;
  try {
    std::error_code code;
    return fs::equivalent(find_file(name, path_, {.root = root_}), file, code) && !code;
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::file) throw;
    return false;
  }
}

std::string SavedFiles::below_root(const std::string& file) const { return below(file, root_); }

std::string SavedFiles::name(const std::string& file) const {
  for (const std::string& near : {below_root(file), below(file, folder_)})
    if (finds(near, file)) return near;
  return file;
}

std::string SavedFiles::name(const RobotSpec& robot) const {
  const std::string& body = robot.files.body;
  return name(robot.file) + (body.empty() ? "" : "#" + body);
}

// --- contents of files ---

void SavedFiles::check_within(const std::string& file) const {
  if (!lies_within(file, reading_.confine)) fail_outside(file, reading_);
}

const BodySpec* SavedFiles::again(const BodySpec& body) {
  if (body.file.empty()) return nullptr;
  std::string reason;
  try {
    check_within(body.file);
    const BodySpec& read = cache_.body(body.file);
    const bool same = (!read.shape && !body.shape) ||
                      (read.shape && body.shape && read.shape->hash() == body.shape->hash());
    if (same) return &read;
    reason = "its file gives another surface when it is read again: " + body.file;
  } catch (const Error& error) {
    reason = error.what();
  }
  if (warned_.insert(body.name).second)
    diagnostics_.warn(Place(path_.filename().string()), "'{}' is saved with its triangles, for {}",
                      excerpt(body.name), reason);
  return nullptr;
}

const RobotSpec& SavedFiles::again(const RobotSpec& robot) {
  if (robot.file.empty())
    fail("robot '{}' cannot be saved: it does not come from a file", excerpt(robot.name));
  const RobotSpec* read = nullptr;
  try {
    check_within(robot.file);
    if (robot.files.folder.empty() && robot.files.packages.empty()) {
      read = &cache_.robot(robot.file, robot.files.body);
    } else {
      ReadOptions options = reading_;
      options.folder = robot.files.folder;
      options.packages.insert(robot.files.packages.begin(), robot.files.packages.end());
      read = &(given_[robot.name] =
                   FileCache(options, all_formats).robot(robot.file, robot.files.body));
    }
  } catch (const Error& error) {
    fail(error.kind(), "robot '{}' cannot be saved: {}", excerpt(robot.name), error.what());
  }
  const bool same = read->dofs.size() == robot.dofs.size() &&
                    std::ranges::equal(read->links, robot.links, [](const auto& a, const auto& b) {
                      return a.parent == b.parent && a.joints.size() == b.joints.size();
                    });
  if (!same)
    fail("robot '{}' cannot be saved: its file gives another robot when it is read again: {}",
         excerpt(robot.name), robot.file);
  return *read;
}

void SavedFiles::warn_of_folders(const RobotSpec& robot) const {
  const bool folder = !robot.files.folder.empty(), packages = !robot.files.packages.empty();
  if (!folder && !packages) return;
  const char* options = folder && packages ? "the options 'folder' and 'package'"
                        : folder           ? "the option 'folder'"
                                           : "the option 'package'";
  diagnostics_.lost(
      path_.filename().string(),
      fmt::format("{} that robot '{}' was read with; .lua does", options, excerpt(robot.name)));
}

// --- files written next to the world ---

/// A name that is valid in every file system and needs no escapes in other formats.
static std::string file_stem(const std::string& name) {
  std::string stem = name.substr(0, 100);
  for (char& c : stem)
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '-') c = '_';
  return stem;
}

fs::path SavedFiles::write_beside(const std::string& name, const std::vector<Beside>& files) {
  Hasher hash;
  for (const Beside& file : files) hash.add(file.text);
  const fs::path own = folder_ / fmt::format("{}_files", path_.stem().string()) /
                       fmt::format("{:08x}", static_cast<uint32_t>(hash.value()));
  const std::string stem = file_stem(name);
  for (const Beside& file : files) {
    const fs::path path = own / (stem + file.ending);
    check_target(path, reading_.confine);
    beside_.write(path, file.text);
  }
  return own / (stem + files.front().ending);
}

fs::path SavedFiles::write_surface(const BodySpec& body) {
  if (!body.shape) return {};
  return write_beside(body.name, {{".off", off_text(body.shape->mesh())}});
}

std::string body_elements(const BodySpec& body, const std::string& surface,
                          const std::string& indent) {
  std::string out;
  const auto add = [&](const char* name, const std::string& value) {
    out += fmt::format("{}<{}>{}</{}>\n", indent, name, value, name);
  };
  // custom materials are not part of the format
  if (std::ranges::count(material_names, body.material)) add("material", body.material);
  if (body.elastic_modulus) add("youngs", fmt::format("{}", *body.elastic_modulus));
  if (body.tracker) add("useFlockOfBirds", fmt::format("{}", *body.tracker));
  add("mass", number_in(body.mass, units::gram));
  // a mesh that readers repair has another center and inertia
  const bool repaired = body.shape && !body.shape->closed() &&
                        (body.shape->faults().duplicate_triangles > 0 ||
                         body.shape->faults().degenerate_triangles > 0);
  if (body.com || repaired) add("cog", millimeters(com_of(body)));
  if (body.inertia_per_mass || repaired) {
    const Eigen::Matrix3d inertia = inertia_of(body);
    const Eigen::Matrix3d even = 0.5 * (inertia + inertia.transpose());
    std::vector<std::string> rows;
    for (int i = 0; i < 9; ++i)
      rows.push_back(number_in(even(i / 3, i % 3), units::square_millimeter));
    add("inertia_matrix", fmt::format("{}", fmt::join(rows, " ")));
  }
  if (surface.empty()) return out;
  out +=
      fmt::format("{}<geometryFile type=\"off\">{}</geometryFile>\n", indent, xml_escaped(surface));
  // the surface is in meters; converting it to millimeters would lose digits
  add("geometryScaling", "1000");
  return out;
}

std::string body_xml_text(const BodySpec& body, const std::string& surface) {
  return "<?xml version=\"1.0\" ?>\n<root>\n" + body_elements(body, surface, "  ") + "</root>\n";
}

fs::path SavedFiles::write_body(const BodySpec& body) {
  if (!body.shape) return write_beside(body.name, {{".xml", body_xml_text(body, "")}});
  return write_beside(body.name, {{".xml", body_xml_text(body, file_stem(body.name) + ".off")},
                                  {".off", off_text(body.shape->mesh())}});
}

}  // namespace clench
