#include "clench/io/grasps/grasp_table.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "clench/base/suggest.h"
#include "clench/base/text.h"
#include "clench/io/grasps/dof_labels.h"
#include "clench/io/grasps/grasp_columns.h"
#include "clench/io/text/csv.h"
#include "clench/io/text/number_reader.h"

namespace clench {

using Row = std::map<std::string, std::string>;

static constexpr const char* pose_columns[] = {"x [m]", "y [m]", "z [m]", "qw", "qx", "qy", "qz"};

static constexpr std::pair<const char*, std::string GraspSpec::*> text_columns[] = {
    {"hand", &GraspSpec::hand_name},
    {"object", &GraspSpec::object_name},
    {"hand_file", &GraspSpec::hand_file},
    {"object_file", &GraspSpec::object_file},
    {"hand_fingerprint", &GraspSpec::hand_fingerprint},
    {"object_fingerprint", &GraspSpec::object_fingerprint},
    {"settings_fingerprint", &GraspSpec::settings_fingerprint},
    {"engine_version", &GraspSpec::engine_version}};

// --- writing ---

static std::string text_cell(const std::string& text) { return text.empty() ? "" : csv_cell(text); }

// a number that is not finite is written as unknown
static std::string number_cell(double x) { return std::isfinite(x) ? real_text(x) : ""; }

// a seed and other counts are integers
static std::string note_cell(double x) {
  return x == std::floor(x) && std::abs(x) < 9e15 ? fmt::format("{:.0f}", x) : number_cell(x);
}

// for values of unknown unit
static constexpr const char* any_unit = "rad or m";

/// "dof NAME [rad]" of each value, or "dof_1 [rad]", in order.
static std::vector<std::string> value_columns(const std::string& kind, size_t count,
                                              const std::vector<std::string>& names,
                                              const std::vector<std::string>& units) {
  std::vector<std::string> out;
  for (size_t i = 0; i < count; ++i) {
    const std::string unit = i < units.size() && !units[i].empty() ? units[i] : any_unit;
    out.push_back(names.empty() ? fmt::format("{}_{} [{}]", kind, i + 1, unit)
                                : fmt::format("{} {} [{}]", kind, names[i], unit));
  }
  return out;
}

using Cells = std::vector<std::pair<std::string, std::string>>;

static void add_values(const std::string& kind, const std::vector<double>& values,
                       const std::vector<std::string>& names, const std::vector<std::string>& units,
                       Cells& out) {
  const auto columns = value_columns(kind, values.size(), names, units);
  for (size_t i = 0; i < values.size(); ++i) out.emplace_back(columns[i], real_text(values[i]));
}

static void add_joints(const GraspSpec& g, Cells& out) {
  std::vector<double> values;
  for (size_t j = 0; j < g.joints.size(); ++j) values.push_back(g.joint_value(j));
  add_values("joint", values, g.joint_names, g.joint_units, out);
  add_values("joint_offset", g.joint_offsets, g.joint_names, g.joint_units, out);
}

/// Values of DOFs and joints in order.
static Cells posture_cells(const GraspSpec& g, bool with_joints) {
  Cells out;
  add_values("dof", g.dofs, g.dof_names, g.dof_units, out);
  if (with_joints) add_joints(g, out);
  const auto add_other = [&](const char* kind, const std::vector<double>& dofs) {
    if (dofs.size() == g.dofs.size()) add_values(kind, dofs, g.dof_names, g.dof_units, out);
  };
  if (g.pregrasp) add_other("pregrasp dof", g.pregrasp->dofs);
  add_other("squeeze dof", g.squeeze);
  return out;
}

/// True if the joints of all hands have a common order: a table has one order for all rows.
static bool is_one_joint_order(const std::vector<GraspSpec>& grasps) {
  std::map<std::string, size_t> places;
  for (const GraspSpec& g : grasps) {
    Cells cells;
    add_joints(g, cells);
    size_t last = 0;
    for (const auto& cell : cells) {
      const size_t place = places.try_emplace(cell.first, places.size() + 1).first->second;
      if (place <= last) return false;
      last = place;
    }
  }
  return true;
}

static Row row_of(const GraspSpec& g, bool with_joints) {
  Row row;
  for (const auto& [name, text] : text_columns)
    if (!(g.*text).empty()) row[name] = csv_cell(g.*text);
  if (g.X_OH) {
    const auto numbers = pose_numbers(*g.X_OH);
    for (size_t i = 0; i < 7; ++i) row[pose_columns[i]] = real_text(numbers[i]);
  }
  for (const auto& [name, cell] : posture_cells(g, with_joints)) row[name] = cell;
  for (const auto& [name, text] : part_cells(g))
    row[name] = parse_number(text) || text == "true" || text == "false" ? text : csv_cell(text);
  for (const auto& [name, x] : g.measures)
    row[name == "epsilon" ? name : "measure " + name] = number_cell(x);
  for (const auto& [name, x] : g.info) {
    if (name == "energy")
      row[name] = number_cell(x);
    else
      row[name == "seed" ? name : "info " + name] = note_cell(x);
  }
  for (const auto& [name, text] : g.labels)
    row[name == "planner" ? name : "label " + name] = csv_cell(text);
  if (g.collision_free) row["collision_free"] = *g.collision_free ? "true" : "false";
  return row;
}

std::string grasp_table_text(const std::vector<GraspSpec>& grasps, const std::string& file,
                             const WriteOptions& options) {
  std::vector<std::string> columns = {"hand",    "object", "planner",       "seed",
                                      "epsilon", "energy", "collision_free"};
  columns.insert(columns.end(), std::begin(pose_columns), std::end(pose_columns));
  std::set<std::string> known(columns.begin(), columns.end());
  const bool with_joints = is_one_joint_order(grasps);
  const auto add = [&](const std::string& column) {
    if (known.insert(column).second) columns.push_back(column);
  };
  // DOFs and joints in order, parts in order; then the rest by name
  for (const bool of_dofs : {true, false})
    for (const GraspSpec& g : grasps)
      for (const auto& [column, cell] : posture_cells(g, with_joints))
        if (column.starts_with("dof") == of_dofs) add(column);
  std::vector<Row> rows;
  for (const GraspSpec& g : grasps) rows.push_back(row_of(g, with_joints));
  for (const std::string& column : part_column_names())
    if (std::ranges::any_of(rows, [&](const Row& row) { return row.contains(column); }))
      add(column);
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
  report_lost(grasps, everything(with_joints), file, "csv", options);
  return out;
}

// --- reading ---

namespace {

enum class ColumnRole {
  unused,
  text,
  planner,
  label,
  epsilon,
  measure,
  note,
  collision_free,
  dof,
  numbered_dof,
  joint,
  joint_offset,
  pregrasp_dof,
  squeeze_dof,
  pose,
  part
};

/// A column with its role and its key: "dof thumb [rad]" is the DOF "thumb", in rad.
struct Column {
  std::string name = {};
  ColumnRole role = ColumnRole::unused;
  std::string key = {}, unit = {};
  bool numbered = false;  ///< a joint without a name
  size_t number = 0;      ///< index of the pose component, part or text
};

// splits "thumb [rad]" into name and unit
void split_unit(Column& column) {
  const size_t bracket = column.key.rfind(" [");
  if (!column.key.ends_with(']') || bracket == std::string::npos) return;
  column.unit = column.key.substr(bracket + 2, column.key.size() - bracket - 3);
  column.key.resize(bracket);
}

// splits " thumb [rad]" or "_1 [rad]", the text after the kind of value
void split_name(Column& column) {
  split_unit(column);
  column.numbered = column.key.starts_with('_');
  if (column.key.empty() || (!column.numbered && column.key[0] != ' ') ||
      (column.numbered && !parse_integer(column.key.substr(1))))
    column.role = ColumnRole::unused;
  else
    column.key.erase(0, 1);
}

Column column_of(std::string name) {
  static constexpr std::pair<std::string_view, ColumnRole> prefixes[] = {
      {"dof ", ColumnRole::dof},
      {"dof_", ColumnRole::numbered_dof},
      {"joint_offset", ColumnRole::joint_offset},
      {"joint", ColumnRole::joint},
      {"pregrasp dof", ColumnRole::pregrasp_dof},
      {"squeeze dof", ColumnRole::squeeze_dof},
      {"measure ", ColumnRole::measure},
      {"info ", ColumnRole::note},
      {"label ", ColumnRole::label}};
  static constexpr std::pair<std::string_view, ColumnRole> names[] = {
      {"planner", ColumnRole::planner},
      {"seed", ColumnRole::note},
      {"energy", ColumnRole::note},
      {"epsilon", ColumnRole::epsilon},
      {"collision_free", ColumnRole::collision_free}};
  Column out{.name = std::move(name)};
  for (const auto& [prefix, role] : prefixes)
    if (out.name.starts_with(prefix)) {
      out.role = role;
      out.key = out.name.substr(prefix.size());
      if (role == ColumnRole::dof || role == ColumnRole::numbered_dof) split_unit(out);
      if (role == ColumnRole::numbered_dof && !parse_integer(out.key))
        out.role = ColumnRole::unused;
      if (role >= ColumnRole::joint && role <= ColumnRole::squeeze_dof) split_name(out);
      return out;
    }
  for (const auto& [known, role] : names)
    if (out.name == known) {
      out.role = role;
      out.key = out.name;
    }
  for (size_t i = 0; i < std::size(text_columns); ++i)
    if (out.name == text_columns[i].first) out.role = ColumnRole::text, out.number = i;
  for (size_t i = 0; i < std::size(pose_columns); ++i)
    if (out.name == pose_columns[i]) out.role = ColumnRole::pose, out.number = i;
  static const std::vector<std::string> parts = part_column_names();
  for (size_t i = 0; i < parts.size(); ++i)
    if (out.name == parts[i]) out.role = ColumnRole::part, out.number = i;
  return out;
}

class TableReader {
 public:
  TableReader(const std::string& file, const CsvRecord& head, const ReadOptions& options)
      : file_(file) {
    for (const CsvCell& name : head.cells) columns_.push_back(column_of(name.text));
    check_columns(fmt::format("{}:{}", file, head.line));
    std::vector<std::string> unused;
    for (const Column& c : columns_)
      if (c.role == ColumnRole::unused) unused.push_back(excerpt(c.name));
    if (!unused.empty())
      options.diagnostics.warn(Place(file), "columns {} are not used", name_list(unused));
  }

  /// True if there are fewer cells than columns, or the last cell may be an incomplete number.
  bool lacks_cells(const CsvRecord& record) const {
    const std::string& last = record.cells.back().text;
    return record.cells.size() < columns_.size() ||
           (!last.empty() && !parse_number(last) && parse_number(last + "1"));
  }

  GraspSpec read(const CsvRecord& record) const {
    if (record.cells.size() != columns_.size())
      fail("{}:{}: expected {} cells, got {}", file_, record.line, columns_.size(),
           record.cells.size());
    GraspSpec g;
    std::optional<double> pose[7];
    bool has_units = false;
    std::vector<double> before;
    PartReader parts;
    for (size_t c = 0; c < columns_.size(); ++c) {
      const Column& column = columns_[c];
      const CsvCell& cell = record.cells[c];
      if (cell.text.empty() && !cell.quoted) continue;
      switch (column.role) {
        case ColumnRole::unused:
          break;
        case ColumnRole::text:
          g.*text_columns[column.number].second = cell.text;
          break;
        case ColumnRole::planner:
        case ColumnRole::label:
          g.labels[column.key] = cell.text;
          break;
        case ColumnRole::epsilon:
        case ColumnRole::measure:
          if (cell.text != "inf" && cell.text != "nan" && cell.text != "-inf")
            g.measures[column.key] = number(column, cell, record.line);
          break;
        case ColumnRole::note:
          g.info[column.key] = number(column, cell, record.line);
          break;
        case ColumnRole::collision_free:
          if (cell.text != "true" && cell.text != "false")
            fail("{}:{}: collision_free: expected true or false, got {}", file_, record.line,
                 in_quotes(cell.text));
          g.collision_free = cell.text == "true";
          break;
        case ColumnRole::dof:
        case ColumnRole::numbered_dof:
          g.dofs.push_back(number(column, cell, record.line));
          if (column.role == ColumnRole::dof) g.dof_names.push_back(column.key);
          g.dof_units.push_back(column.unit == any_unit ? "" : column.unit);
          has_units = has_units || !g.dof_units.back().empty();
          break;
        case ColumnRole::joint:
          g.joints.push_back(number(column, cell, record.line));
          if (!column.numbered) g.joint_names.push_back(column.key);
          g.joint_units.push_back(column.unit == any_unit ? "" : column.unit);
          break;
        case ColumnRole::joint_offset:
          g.joint_offsets.push_back(number(column, cell, record.line));
          break;
        case ColumnRole::pregrasp_dof:
          before.push_back(number(column, cell, record.line));
          break;
        case ColumnRole::squeeze_dof:
          g.squeeze.push_back(number(column, cell, record.line));
          break;
        case ColumnRole::part:
          parts.read(column.number, cell.text,
                     fmt::format("{}:{}: {}", file_, record.line, column.name));
          break;
        case ColumnRole::pose:
          pose[column.number] = number(column, cell, record.line);
          break;
      }
    }
    if (!has_units) g.dof_units.clear();
    if (!g.dof_names.empty() && g.dof_names.size() != g.dofs.size())
      fail("{}:{}: expected DOFs with names or with numbers, got both", file_, record.line);
    if (std::ranges::any_of(pose, [](const auto& x) { return x.has_value(); }))
      g.X_OH = pose_of(pose, record.line);
    const std::string place = fmt::format("{}:{}", file_, record.line);
    finish_joints(g, place);
    if (!before.empty()) g.pregrasp = PregraspState{Pose{}, before};
    for (const auto* other : {&before, &g.squeeze})
      if (!other->empty() && other->size() != g.dofs.size())
        fail("{}: expected as many values of each posture as DOFs, {}, got {}", place,
             g.dofs.size(), other->size());
    parts.finish(g, place);
    return g;
  }

 private:
  void check_columns(const std::string& place) const {
    std::set<std::string_view> known;
    std::vector<std::string> dofs, numbered;
    for (const Column& c : columns_) {
      if (!known.insert(c.name).second)
        fail("{}: column {} appears twice", place, in_quotes(c.name));
      if (c.role >= ColumnRole::dof && c.role <= ColumnRole::squeeze_dof)
        check_dof_unit(fmt::format("{}: {}", place, excerpt(c.name)), c.unit);
      if (c.role != ColumnRole::dof && c.role != ColumnRole::numbered_dof) continue;
      (c.role == ColumnRole::dof ? dofs : numbered).push_back(c.key);
    }
    for (const char* name : pose_columns)
      if (!known.contains(name)) fail("{}: expected a column '{}', got none", place, name);
    // columns may differ only in their units
    check_dof_names(place + ": DOF", dofs);
    check_dof_names(place + ": DOF", numbered);
    // numbered from 1 in order
    for (size_t i = 0; i < numbered.size(); ++i)
      if (parse_integer(numbered[i]) != static_cast<int>(i) + 1)
        fail("{}: expected a column dof_{}, got dof_{}", place, i + 1, excerpt(numbered[i]));
  }

  static void finish_joints(GraspSpec& g, const std::string& place) {
    if (!g.joint_names.empty() && g.joint_names.size() != g.joints.size())
      fail("{}: expected joints with names or with numbers, got both", place);
    if (std::ranges::all_of(g.joint_units, &std::string::empty)) g.joint_units.clear();
    if (g.joint_offsets.empty()) return;
    if (g.joint_offsets.size() != g.joints.size())
      fail("{}: expected as many offsets as joints, {}, got {}", place, g.joints.size(),
           g.joint_offsets.size());
    for (size_t j = 0; j < g.joints.size(); ++j) g.joints[j] -= g.joint_offsets[j];
  }

  double number(const Column& column, const CsvCell& cell, int line) const {
    const auto x = parse_number(cell.text);
    if (!x)
      fail("{}:{}: {}: expected a number, got {}", file_, line, excerpt(column.name),
           in_quotes(cell.text));
    return *x;
  }

  Pose pose_of(const std::optional<double> (&pose)[7], int line) const {
    for (size_t i = 0; i < 7; ++i)
      if (!pose[i]) fail("{}:{}: {}: expected a number, got nothing", file_, line, pose_columns[i]);
    const auto q = made_unit({*pose[3], *pose[4], *pose[5], *pose[6]});
    if (!q)
      fail("{}:{}: expected a quaternion of length 1, got ({} {} {} {})", file_, line, *pose[3],
           *pose[4], *pose[5], *pose[6]);
    return {*q, {*pose[0], *pose[1], *pose[2]}};
  }

  const std::string& file_;
  std::vector<Column> columns_;
};

}  // namespace

static void warn_of_cut_row(const std::string& file, const CsvRecord& record,
                            const ReadOptions& options) {
  options.diagnostics.warn(Place(file, record.line),
                           "the last line is cut short and is skipped, got {}",
                           in_quotes(record.cells.front().text));
}

/// Warns of a last row that has all cells but no line end: its last cell may be incomplete.
static void warn_of_open_row(const std::string& file, size_t rows, const CsvRecord& record,
                             const CsvReader& reader, const ReadOptions& options) {
  if (rows == 0 || !reader.ends_in_open_line()) return;
  options.diagnostics.warn(Place(file, record.line),
                           "the last line has no end and may be cut short; its last cell is {}",
                           in_quotes(record.cells.back().text));
}

void read_grasp_table(const std::string& file, std::string_view text, const GraspSink& sink,
                      const ReadOptions& options) {
  CsvReader reader(file, text);
  CsvRecord record;
  bool more = reader.next(record);
  while (more && record.is_empty()) more = reader.next(record);
  if (!more) fail("{}: expected names of columns, got an empty file", file);
  GraspCollector list(file, text.size(), sink);
  // a column is stored with name, role and key
  size_t names = 0;
  for (const CsvCell& cell : record.cells) names += sizeof(Column) + 3 * cell.text.size() + 200;
  list.budget().take(names);
  const TableReader table(file, record, options);
  // a row has at least the commas between the numbers of a pose
  list.expect(text.size() / std::size(pose_columns));
  // a killed program or a full disk leaves an incomplete row
  size_t rows = 0;
  const auto is_cut = [&] { return rows > 0 && reader.ends_in_open_line(); };
  for (;; ++rows) {
    options.progress.check();
    try {
      while ((more = reader.next(record)) && record.is_empty()) {
      }
    } catch (const Error&) {
      if (!is_cut()) throw;
      return warn_of_cut_row(file, record, options);
    }
    if (!more) return warn_of_open_row(file, rows, record, reader, options);
    if (table.lacks_cells(record) && is_cut()) return warn_of_cut_row(file, record, options);
    list.add(table.read(record));
  }
}

}  // namespace clench
