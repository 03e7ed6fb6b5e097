#include "clench/io/grasp_files.h"

#include <optional>

#include "clench/base/file.h"
#include "clench/base/suggest.h"
#include "clench/base/text.h"
#include "clench/io/grasp_lines.h"
#include "clench/io/graspit/grasp_lists.h"
#include "clench/io/grasps/grasp_arrays.h"
#include "clench/io/grasps/grasp_exchange.h"
#include "clench/io/grasps/grasp_table.h"
#include "clench/io/text/file_errors.h"
#include "clench/io/text/file_kind.h"
#include "clench/io/text/find_file.h"

namespace clench {

namespace fs = std::filesystem;

// in the order of GraspFormat
static const std::vector<std::string>& format_names() {
  static const std::vector<std::string> names = {
      "jsonl", "csv", "npz", "isaac_grasp", "graspgen", "multigripper", "graspit"};
  return names;
}

GraspFormat grasp_format(const std::string& name) {
  const auto& names = format_names();
  for (size_t i = 0; i < names.size(); ++i)
    if (names[i] == name) return static_cast<GraspFormat>(i);
  fail("unknown format {}{}", in_quotes(name), instead_of(name, names));
}

const char* grasp_format_name(GraspFormat format) {
  return format_names()[static_cast<size_t>(format)].c_str();
}

// what the file itself says: JSON by its keys, else lines of numbers
static GraspFormat look_into(const fs::path& path) {
  const std::string start = read_start(path, 4096);
  const std::string_view text = trim(without_mark(start));
  if (text.starts_with("PK")) return GraspFormat::npz;
  if (text.find("isaac_grasp") != std::string_view::npos && !text.starts_with('{'))
    return GraspFormat::isaac_grasp;
  if (!text.empty() && (text[0] == '-' || text[0] == '#' || (text[0] >= '0' && text[0] <= '9')))
    return GraspFormat::graspit;
  // a head of ours stands on one line
  if (text.substr(0, text.find('\n')).find("clench grasps") != std::string_view::npos)
    return GraspFormat::lines;
  if (ending_of(path) != ".json") return GraspFormat::lines;
  const std::string file = path.filename().string();
  const YamlNode root = parse_yaml(file, read_text(path));
  if (root.find("gripper")) return GraspFormat::multigripper;
  if (root.find("grasps")) return GraspFormat::graspgen;
  fail(
      "{}: expected the keys of GraspGen (object, grasps) or of MultiGripperGrasp (gripper, "
      "object_id, pose), got neither",
      file);
}

static std::optional<GraspFormat> format_of(const std::string& ending) {
  if (ending == ".jsonl") return GraspFormat::lines;
  if (ending == ".csv") return GraspFormat::csv;
  if (ending == ".npz") return GraspFormat::npz;
  if (ending == ".yaml" || ending == ".yml") return GraspFormat::isaac_grasp;
  return std::nullopt;
}

static GraspFormat format_to_read(const fs::path& path, const std::string& format) {
  if (!format.empty()) return grasp_format(format);
  if (const auto known = format_of(ending_of(path))) return *known;
  return look_into(path);
}

std::vector<GraspSpec> read_grasp_file(const fs::path& path, const std::string& format,
                                       const ReadOptions& options) {
  return of_file([&] {
    const fs::path found = find_file(path.string(), "", options);
    const std::string file = found.filename().string();
    const auto tree = [&] { return parse_yaml(file, read_text(found)); };
    switch (format_to_read(found, format)) {
      case GraspFormat::csv:
        return read_grasp_table(found, options);
      case GraspFormat::npz:
        return read_grasp_arrays(found, options);
      case GraspFormat::isaac_grasp:
        return read_isaac_grasps(tree(), file, options);
      case GraspFormat::graspgen:
        return read_graspgen(tree(), file, options);
      case GraspFormat::multigripper:
        return read_multigripper(tree(), file, options);
      case GraspFormat::graspit:
        return read_planned_grasps(found, options);
      case GraspFormat::lines:
        break;
    }
    return read_grasps(path, options);
  });
}

GraspFormat grasp_format_to_write(const fs::path& path, const std::string& format) {
  if (!format.empty()) return grasp_format(format);
  const std::string ending = ending_of(path), file = path.filename().string();
  if (ending.empty()) return GraspFormat::lines;
  if (const auto known = format_of(ending)) return *known;
  if (ending == ".json")
    fail(
        "{}: .json may be several formats; expected format = \"graspgen\" or \"multigripper\", got "
        "none",
        file);
  fail("expected a name that ends in .jsonl, .csv, .npz, .yaml or .json, or a format, got {}",
       in_quotes(file));
}

void write_grasp_file(const std::vector<GraspSpec>& grasps, const fs::path& path,
                      const std::string& format, const WriteOptions& options) {
  const std::string file = path.filename().string();
  const GraspFormat known = grasp_format_to_write(path, format);
  if (known != GraspFormat::lines && !options.notes.empty() && options.warn)
    options.warn(fmt::format("{}: {} does not hold notes", file, grasp_format_name(known)));
  switch (known) {
    case GraspFormat::csv:
      return write_grasp_table(grasps, path, options);
    case GraspFormat::npz:
      return write_grasp_arrays(grasps, path, options);
    case GraspFormat::isaac_grasp:
      return write_file(path, isaac_grasp_text(grasps, file, options));
    case GraspFormat::graspgen:
      return write_file(path, graspgen_text(grasps, file, options));
    case GraspFormat::multigripper:
      return write_file(path, multigripper_text(grasps, file, options));
    case GraspFormat::graspit:
      report_lost(grasps, {}, file, "graspit", options);
      return write_planned_grasps(grasps, path);
    case GraspFormat::lines:
      return write_grasps(grasps, path, options.notes);
  }
}

}  // namespace clench
