#include "clench/io/grasps/grasp_table.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "clench/base/file.h"
#include "clench/base/suggest.h"
#include "clench/base/text.h"
#include "clench/io/grasps/dof_labels.h"
#include "clench/io/text/csv.h"
#include "clench/io/text/number_reader.h"

namespace clench {

namespace fs = std::filesystem;

using Row = std::map<std::string, std::string>;

static constexpr const char* pose_columns[] = {"x [m]", "y [m]", "z [m]", "qw", "qx", "qy", "qz"};

static constexpr std::pair<const char*, std::string GraspSpec::*> text_columns[] = {
    {"hand", &GraspSpec::hand_name},
    {"object", &GraspSpec::object_name},
    {"hand_file", &GraspSpec::hand_file},
    {"object_file", &GraspSpec::object_file}};

// --- writing ---

static std::string text_cell(const std::string& text) { return text.empty() ? "" : csv_cell(text); }

// a seed and other counts are integers
static std::string note_cell(double x) {
  return x == std::floor(x) && std::abs(x) < 9e15 ? fmt::format("{:.0f}", x) : real_text(x);
}

/// Of each DOF, in their order.
static std::vector<std::string> dof_columns(const GraspSpec& g) {
  std::vector<std::string> out;
  const auto names = dof_names_of(g);
  for (size_t i = 0; i < g.dofs.size(); ++i)
    out.push_back(
        fmt::format("dof {} [{}]", names[i], i < g.dof_units.size() ? g.dof_units[i] : "rad or m"));
  return out;
}

static Row row_of(const GraspSpec& g) {
  Row row;
  for (const auto& [name, text] : text_columns) row[name] = text_cell(g.*text);
  if (g.X_OH) {
    const auto numbers = pose_numbers(*g.X_OH);
    for (size_t i = 0; i < 7; ++i) row[pose_columns[i]] = real_text(numbers[i]);
  }
  const auto dofs = dof_columns(g);
  for (size_t i = 0; i < dofs.size(); ++i) row[dofs[i]] = real_text(g.dofs[i]);
  for (const auto& [name, x] : g.measures)
    row[name == "epsilon" ? name : "measure " + name] = real_text(x);
  for (const auto& [name, x] : g.info) {
    if (name == "energy")
      row[name] = real_text(x);
    else
      row[name == "seed" ? name : "info " + name] = note_cell(x);
  }
  for (const auto& [name, text] : g.labels)
    row[name == "planner" ? name : "label " + name] = text_cell(text);
  if (g.collision_free) row["collision_free"] = *g.collision_free ? "true" : "false";
  return row;
}

void write_grasp_table(const std::vector<GraspSpec>& grasps, const fs::path& path,
                       const WriteOptions& options) {
  std::vector<std::string> columns = {"hand",    "object", "planner",       "seed",
                                      "epsilon", "energy", "collision_free"};
  columns.insert(columns.end(), std::begin(pose_columns), std::end(pose_columns));
  std::set<std::string> known(columns.begin(), columns.end());
  // DOFs in their order; then the rest by name
  for (const GraspSpec& g : grasps)
    for (const std::string& column : dof_columns(g))
      if (known.insert(column).second) columns.push_back(column);
  std::vector<Row> rows;
  for (const GraspSpec& g : grasps) rows.push_back(row_of(g));
  std::set<std::string> rest = {"hand_file", "object_file"};
  for (const Row& row : rows)
    for (const auto& [name, cell] : row)
      if (!known.contains(name)) rest.insert(name);
  columns.insert(columns.end(), rest.begin(), rest.end());
  std::string out;
  for (const auto& name : columns) out += (out.empty() ? "" : ",") + text_cell(name);
  out += '\n';
  for (const Row& row : rows) {
    for (size_t c = 0; c < columns.size(); ++c) {
      const auto cell = row.find(columns[c]);
      out += (c ? "," : "") + (cell == row.end() ? "" : cell->second);
    }
    out += '\n';
  }
  report_lost(grasps, {.dofs = true, .epsilon = true, .notes = true}, path.filename().string(),
              "csv", options);
  write_file(path, out);
}

// --- reading ---

namespace {

// a grasp's own names, whatever their column is called: "dof thumb [rad]" is "thumb", in rad
struct Column {
  std::string name = {}, kind = {}, key = {}, unit = {};
};

Column column_of(const std::string& name) {
  Column out{.name = name};
  const size_t space = name.find(' ');
  const std::string first = name.substr(0, space);
  if (space != std::string::npos &&
      (first == "dof" || first == "measure" || first == "info" || first == "label")) {
    out.kind = first;
    out.key = name.substr(space + 1);
  }
  if (out.kind == "dof" && out.key.ends_with(']') && out.key.rfind(" [") != std::string::npos) {
    const size_t bracket = out.key.rfind(" [");
    out.unit = out.key.substr(bracket + 2, out.key.size() - bracket - 3);
    out.key.resize(bracket);
  }
  return out;
}

/// Units and names of the DOFs, whose columns may differ in their unit alone.
void check_dof_columns(const std::vector<Column>& columns, const std::string& place) {
  std::vector<std::string> names;
  for (const Column& c : columns) {
    if (c.kind != "dof") continue;
    check_dof_unit(fmt::format("{}: {}", place, excerpt(c.name)), c.unit);
    names.push_back(c.key);
  }
  check_dof_names(place + ": DOF", names);
}

}  // namespace

std::vector<GraspSpec> read_grasp_table(const fs::path& path, const ReadOptions& options) {
  const std::string file = path.filename().string();
  auto records = read_csv(file, read_text(path));
  std::erase_if(records, &CsvRecord::is_empty);
  if (records.empty()) fail("{}: expected names of columns, got an empty file", file);
  std::vector<Column> columns;
  for (const CsvCell& name : records[0].cells) columns.push_back(column_of(name.text));
  const auto has = [&](const std::string& name) {
    return std::ranges::find(columns, name, &Column::name) != columns.end();
  };
  for (const char* name : pose_columns)
    if (!has(name)) fail("{}:{}: expected a column '{}', got none", file, records[0].line, name);
  static const std::vector<std::string> single = {"hand",        "object",  "hand_file",
                                                  "object_file", "planner", "seed",
                                                  "epsilon",     "energy",  "collision_free"};
  std::vector<std::string> unused;
  for (const Column& c : columns) {
    if (std::ranges::count(columns, c.name, &Column::name) > 1)
      fail("{}:{}: column {} stands there twice", file, records[0].line, in_quotes(c.name));
    const bool known = !c.kind.empty() || std::ranges::count(single, c.name) ||
                       std::ranges::count(pose_columns, c.name);
    if (!known) unused.push_back(c.name);
  }
  check_dof_columns(columns, fmt::format("{}:{}", file, records[0].line));
  if (!unused.empty() && options.warn)
    options.warn(fmt::format("{}: columns {} are not used", file, name_list(unused)));

  std::vector<GraspSpec> out;
  for (size_t r = 1; r < records.size(); ++r) {
    options.progress.check();
    const CsvRecord& record = records[r];
    if (record.cells.size() != columns.size())
      fail("{}:{}: expected {} cells, got {}", file, record.line, columns.size(),
           record.cells.size());
    GraspSpec& g = out.emplace_back();
    std::map<std::string, double> pose;
    for (size_t c = 0; c < columns.size(); ++c) {
      const Column& column = columns[c];
      const std::string& cell = record.cells[c].text;
      if (cell.empty()) continue;
      const auto number = [&] {
        const auto x = parse_number(cell);
        if (!x)
          fail("{}:{}: {}: expected a number, got {}", file, record.line, excerpt(column.name),
               in_quotes(cell));
        return *x;
      };
      const auto text = std::ranges::find_if(
          text_columns, [&](const auto& known) { return column.name == known.first; });
      if (text != std::end(text_columns))
        g.*text->second = cell;
      else if (column.name == "planner")
        g.labels["planner"] = cell;
      else if (column.kind == "label")
        g.labels[column.key] = cell;
      else if (column.name == "epsilon")
        g.measures["epsilon"] = number();
      else if (column.kind == "measure") {
        if (cell != "inf" && cell != "nan" && cell != "-inf") g.measures[column.key] = number();
      } else if (column.name == "seed" || column.name == "energy")
        g.info[column.name] = number();
      else if (column.kind == "info")
        g.info[column.key] = number();
      else if (column.name == "collision_free") {
        if (cell != "true" && cell != "false")
          fail("{}:{}: collision_free: expected true or false, got {}", file, record.line,
               in_quotes(cell));
        g.collision_free = cell == "true";
      } else if (column.kind == "dof") {
        g.dofs.push_back(number());
        g.dof_names.push_back(column.key);
        g.dof_units.push_back(column.unit);
      } else if (std::ranges::count(pose_columns, column.name)) {
        pose[column.name] = number();
      }
    }
    if (pose.empty()) continue;
    const auto x = [&](int i) {
      const auto found = pose.find(pose_columns[i]);
      if (found == pose.end())
        fail("{}:{}: {}: expected a number, got nothing", file, record.line, pose_columns[i]);
      return found->second;
    };
    const auto q = made_unit({x(3), x(4), x(5), x(6)});
    if (!q)
      fail("{}:{}: expected a quaternion of length 1, got ({} {} {} {})", file, record.line, x(3),
           x(4), x(5), x(6));
    g.X_OH = Pose{*q, {x(0), x(1), x(2)}};
  }
  return out;
}

}  // namespace clench
