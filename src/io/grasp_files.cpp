#include "clench/io/grasp_files.h"

#include <optional>

#include "clench/base/file.h"
#include "clench/base/suggest.h"
#include "clench/base/text.h"
#include "clench/io/grasp_lines.h"
#include "clench/io/graspit/grasp_lists.h"
#include "clench/io/grasps/grasp_arrays.h"
#include "clench/io/grasps/grasp_difference.h"
#include "clench/io/grasps/grasp_exchange.h"
#include "clench/io/grasps/grasp_table.h"
#include "clench/io/text/file_errors.h"
#include "clench/io/text/file_kind.h"
#include "clench/io/text/find_file.h"

namespace clench {

namespace fs = std::filesystem;

static constexpr size_t max_text = size_t{256} << 20;

static constexpr const char* format_names[] = {"jsonl",    "csv",          "npz",    "isaac_grasp",
                                               "graspgen", "multigripper", "graspit"};

const char* grasp_format_name(GraspFormat format) {
  return format_names[static_cast<size_t>(format)];
}

GraspFormat grasp_format(const std::string& name) {
  const std::vector<std::string> names(std::begin(format_names), std::end(format_names));
  for (size_t i = 0; i < names.size(); ++i)
    if (names[i] == name) return static_cast<GraspFormat>(i);
  fail("unknown format {}{}", in_quotes(name), instead_of(name, names));
}

// format by the contents: JSON by its keys, otherwise lines of numbers
static GraspFormat look_into(const fs::path& path) {
  const std::string start = read_start(path, 4096);
  const std::string_view text = trim(without_mark(start));
  if (text.starts_with("PK")) return GraspFormat::npz;
  if (text.find("isaac_grasp") != std::string_view::npos && !text.starts_with('{'))
    return GraspFormat::isaac_grasp;
  if (!text.empty() && (text[0] == '-' || text[0] == '#' || (text[0] >= '0' && text[0] <= '9')))
    return GraspFormat::graspit;
  // the first line of JSON lines is always a single line
  if (text.substr(0, text.find('\n')).find("clench grasps") != std::string_view::npos)
    return GraspFormat::lines;
  // the contents of a .json file select one of the two formats
  return ending_of(path) == ".json" ? GraspFormat::graspgen : GraspFormat::lines;
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

// by its keys
static GraspFormat format_of_tree(const ValueTree& tree, const std::string& file) {
  const ValueNode root = tree.root();
  if (const auto format = root.find("format"); format && format->text() == "isaac_grasp")
    return GraspFormat::isaac_grasp;
  if (root.find("gripper")) return GraspFormat::multigripper;
  if (root.find("grasps")) return GraspFormat::graspgen;
  fail(
      "{}: expected the keys of GraspGen (object, grasps) or of MultiGripperGrasp (gripper, "
      "object_id, pose), got neither",
      file);
}

/// Reads the contents of a file in the given format.   returns  the format
static GraspFormat read_grasp_contents(GraspFormat format, bool is_known, const std::string& file,
                                       std::string bytes, const GraspSink& sink,
                                       const ReadOptions& options) {
  const auto text = [&] {
    if (bytes.size() > max_text)
      fail("{}: expected a text file of at most {} MB, got {} bytes", file, max_text >> 20,
           bytes.size());
    return plain_text(std::move(bytes));
  };
  switch (format) {
    case GraspFormat::npz:
      read_grasp_arrays(file, bytes, sink, options);
      return format;
    case GraspFormat::csv:
      // line ends in quotes are literal
      read_grasp_table(file, bytes, sink, options);
      return format;
    case GraspFormat::graspit:
      read_planned_grasps(file, text(), sink, options);
      return format;
    case GraspFormat::lines:
      read_grasps(file, text(), sink, options);
      return format;
    default:
      break;
  }
  GraspCollector list(file, bytes.size(), sink);
  const ValueTree tree = parse_yaml(file, text());
  if (!is_known) format = format_of_tree(tree, file);
  if (format == GraspFormat::isaac_grasp) read_isaac_grasps(tree, file, list, options);
  if (format == GraspFormat::graspgen) read_graspgen(tree, file, list, options);
  if (format == GraspFormat::multigripper) read_multigripper(tree, file, list, options);
  return format;
}

GraspFormat read_grasp_file(const fs::path& path, const GraspSink& sink, const std::string& format,
                            const ReadOptions& options) {
  return of_file([&] {
    const fs::path found = find_file(path.string(), "", options);
    const GraspFormat of = format_to_read(found, format);
    const bool is_known = !format.empty() || of != GraspFormat::graspgen;
    return read_grasp_contents(of, is_known, found.filename().string(), read_bytes(found), sink,
                               options);
  });
}

std::vector<GraspSpec> read_grasp_file(const fs::path& path, const std::string& format,
                                       const ReadOptions& options) {
  std::vector<GraspSpec> out;
  read_grasp_file(path, {.add = [&](GraspSpec&& g) { out.push_back(std::move(g)); }}, format,
                  options);
  return out;
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

// parts of a grasp that lines of nine numbers cannot hold
static void report_planned_losses(std::vector<GraspSpec> grasps, const std::string& file,
                                  const WriteOptions& options) {
  for (GraspSpec& g : grasps) {
    g.measures.erase("quality");
    for (const char* held : {"run", "spread"}) g.info.erase(held);
  }
  report_lost(grasps, {.hand = false, .object = false}, file, "graspit", options);
}

static std::string contents_of(const std::vector<GraspSpec>& grasps, GraspFormat format,
                               const std::string& file, const WriteOptions& options) {
  switch (format) {
    case GraspFormat::csv:
      return grasp_table_text(grasps, file, options);
    case GraspFormat::npz:
      return grasp_arrays_bytes(grasps, file, options);
    case GraspFormat::isaac_grasp:
      return isaac_grasp_text(grasps, file, options);
    case GraspFormat::graspgen:
      return graspgen_text(grasps, file, options);
    case GraspFormat::multigripper:
      return multigripper_text(grasps, file, options);
    case GraspFormat::graspit:
      report_planned_losses(grasps, file, options);
      return planned_grasps_text(grasps, file);
    case GraspFormat::lines:
      break;
  }
  return grasps_text(grasps, options.notes);
}

// data that would not read back is rejected before it is saved
static void check_reads_back(const std::vector<GraspSpec>& grasps, GraspFormat format,
                             const std::string& file, const std::string& bytes) {
  size_t count = 0;
  const auto compare = [&](GraspSpec&& back) {
    const size_t i = count++;
    if (i >= grasps.size()) return;
    if (const std::string what = difference(grasps[i], back, format); !what.empty())
      fail("{}: grasps[{}]: {} would change when read back, so nothing is saved", file, i + 1,
           what);
  };
  try {
    read_grasp_contents(format, true, file, bytes, {.add = compare}, {});
  } catch (const Error& error) {
    const std::string said = error.what();
    if (said.ends_with("so nothing is saved")) throw;
    fail("{}: the list would not read back, so nothing is saved: {}", file, said);
  }
  if (count != grasps.size())
    fail("{}: the list would read back with {} grasps instead of {}, so nothing is saved", file,
         count, grasps.size());
}

void write_grasp_file(const std::vector<GraspSpec>& grasps, const fs::path& path,
                      const std::string& format, const WriteOptions& options) {
  const std::string file = path.filename().string();
  const GraspFormat of = grasp_format_to_write(path, format);
  if (options.compress && of != GraspFormat::npz)
    fail("{}: compress: only .npz is compressed, got {}", file, grasp_format_name(of));
  if (of != GraspFormat::lines && !options.notes.empty())
    options.diagnostics.warn(Place(file), "{} does not hold notes", grasp_format_name(of));
  const std::string bytes = contents_of(grasps, of, file, options);
  check_reads_back(grasps, of, file, bytes);
  write_file(path, bytes);
}

}  // namespace clench
