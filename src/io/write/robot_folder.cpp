#include "clench/io/write/robot_folder.h"

#include <algorithm>
#include <cctype>
#include <iterator>

#include "clench/base/error.h"
#include "clench/base/hash.h"
#include "clench/io/graspit/eigengrasps.h"
#include "clench/io/text/confine.h"

namespace clench {

namespace fs = std::filesystem;

// letters, digits, '-' and '_': text formats of robots name their files as one word
static std::string plain(const std::string& name) {
  std::string out = name.substr(0, 100);
  for (char& c : out)
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '-') c = '_';
  return out.empty() ? "part" : out;
}

// equal for two names only if the names are equal
static std::string own_stem(const std::string& name) {
  const std::string out = plain(name);
  if (out == name) return out;
  Hasher hash;
  hash.add(name);
  return fmt::format("{}_{:08x}", out, static_cast<uint32_t>(hash.value()));
}

std::string part_name(const BodySpec& body, const RobotSpec& robot) {
  if (!body.file.empty()) return fs::path(body.file).stem().string();
  const std::string prefix = robot.name + "_";
  return body.name.starts_with(prefix) ? body.name.substr(prefix.size()) : body.name;
}

RobotFolder::RobotFolder(const fs::path& path, const WriteOptions& options)
    : path_(path),
      file_(path.filename().string()),
      stem_(own_stem(path.stem().string())),
      own_(stem_ + '_' + plain(path.extension().string().substr(1))),
      diagnostics_(options.diagnostics),
      confine_(options.confine) {}

std::string RobotFolder::add(const std::string& folder, const std::string& part,
                             const std::string& ending, const std::string& text) {
  std::string& name = names_[folder + '\n' + ending + '\n' + text];
  if (!name.empty()) return name;
  const std::string stem = plain(part);
  name = stem + ending;
  for (int i = 2; texts_.contains(folder + name); ++i)
    name = fmt::format("{}_{}{}", stem, i, ending);
  texts_[folder + name] = text;
  return name;
}

// --- surfaces ---

/// Materials of a surface of several colors, by their numbers.
struct ObjMaterials {
  std::vector<Eigen::Vector3f> colors;
  int number(const Eigen::Vector3f& color) {
    const size_t out = std::ranges::find(colors, color) - colors.begin();
    if (out == colors.size()) colors.push_back(color);
    return static_cast<int>(out);
  }
};

std::string RobotFolder::mesh(const Mesh& mesh, const Appearance& looks, const std::string& part) {
  const std::string folder = stem_ + "_files/";
  const bool colored = looks.given && looks.triangle_colors.size() == mesh.triangles.size();
  ObjMaterials materials;
  std::string text = "# meters\n", faces;
  for (const auto& p : mesh.vertices)
    fmt::format_to(std::back_inserter(text), "v {} {} {}\n", p.x(), p.y(), p.z());
  int before = -1;
  for (size_t i = 0; i < mesh.triangles.size(); ++i) {
    const int material = colored ? materials.number(looks.triangle_colors[i]) : -1;
    if (material != before) fmt::format_to(std::back_inserter(faces), "usemtl m{}\n", material);
    before = material;
    const Triangle& t = mesh.triangles[i];
    fmt::format_to(std::back_inserter(faces), "f {} {} {}\n", t[0] + 1, t[1] + 1, t[2] + 1);
  }
  if (colored) {
    std::string mtl;
    for (size_t i = 0; i < materials.colors.size(); ++i) {
      const Eigen::Vector3f& c = materials.colors[i];
      mtl += fmt::format("newmtl m{}\nKd {} {} {}\nd {}\n", i, within_one(c.x()), within_one(c.y()),
                         within_one(c.z()), 1 - double{within_one(looks.transparency)});
    }
    text = "mtllib " + add(folder, part, ".mtl", mtl) + "\n" + text;
  }
  return folder + add(folder, part, ".obj", text + faces);
}

// --- files that a robot's file names ---

std::string RobotFolder::named_file(const std::string& folder, const std::string& ending) const {
  return folder + "/" + own_ + ending;
}

std::string RobotFolder::eigengrasps(const EigengraspSet& set) {
  const bool limited = std::ranges::any_of(
      set.grasps, [](const EigengraspSpec& grasp) { return grasp.limits.has_value(); });
  const std::string name = named_file("eigen", limited ? ".xml" : ".egr");
  texts_[name] = eigengrasps_text(set, name);
  return name;
}

std::string RobotFolder::virtual_contacts(const VirtualContactSet& set) {
  const std::string name = named_file("virtual", ".vgr");
  texts_[name] = virtual_contacts_text(set, name);
  return name;
}

std::string RobotFolder::glove(const GloveCalibration& glove) {
  const auto row = [](const auto& values) {
    std::string out;
    for (Eigen::Index i = 0; i < values.size(); ++i)
      out += fmt::format("{}{}", i ? " " : "", values[i]);
    return out + "\n";
  };
  std::string text = fmt::format("{} {}\n", glove.slopes.rows(), glove.slopes.cols());
  for (Eigen::Index d = 0; d < glove.slopes.rows(); ++d) text += row(glove.slopes.row(d));
  const std::string name = named_file("glove", ".txt");
  texts_[name] = text + row(glove.intercepts);
  return name;
}

// --- writing ---

void RobotFolder::write_parts() {
  for (const auto& [name, text] : texts_) {
    check_target(path_.parent_path() / name, confine_);
    written_.write(path_.parent_path() / name, text);
  }
  texts_.clear();
}

void RobotFolder::write(const std::string& text) {
  write_parts();
  write_file(path_, text);
  written_.keep();
}

}  // namespace clench
