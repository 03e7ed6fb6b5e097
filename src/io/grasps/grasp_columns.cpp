#include "clench/io/grasps/grasp_columns.h"

#include <algorithm>
#include <cmath>

#include "clench/base/text.h"
#include "clench/io/grasps/grasp_writing.h"
#include "clench/io/text/json_tree.h"
#include "clench/io/text/number_reader.h"
#include "clench/io/text/yaml.h"

namespace clench {

namespace {

constexpr size_t pregrasp_numbers = 7;
constexpr const char* pregrasp_columns[pregrasp_numbers] = {
    "pregrasp x [m]", "pregrasp y [m]", "pregrasp z [m]", "pregrasp qw",
    "pregrasp qx",    "pregrasp qy",    "pregrasp qz"};

/// Parts other than the pose of the pregrasp.
enum class GraspPart {
  com_x,
  com_y,
  com_z,
  rho,
  largest_radius,
  gyration_radius,
  edges,
  soft,
  normal_force,
  modulus,
  contacts
};
constexpr const char* part_columns[] = {"com x [m]",
                                        "com y [m]",
                                        "com z [m]",
                                        "rho [m]",
                                        "largest_radius [m]",
                                        "gyration_radius [m]",
                                        "edges",
                                        "soft",
                                        "normal_force [N]",
                                        "modulus",
                                        "contacts"};

double GraspSpec::*const part_lengths[] = {&GraspSpec::rho, &GraspSpec::largest_radius,
                                           &GraspSpec::gyration_radius};

// numbers separated by blanks
std::string spaced_numbers(const std::vector<double>& numbers) {
  std::string out;
  for (const double x : numbers) out += (out.empty() ? "" : " ") + real_text(x);
  return out;
}

std::string vector_list(const Eigen::Vector3d& v) { return real_list({v.x(), v.y(), v.z()}); }

// like the `points` of JSON lines
std::string contacts_text(const GraspSpec& g) {
  std::string out;
  for (size_t i = 0; i < g.points.size(); ++i) {
    const PointContact& p = g.points[i];
    out += fmt::format("{}{{\"point\": {}, \"normal\": {}, \"mu\": {}", out.empty() ? "" : ", ",
                       vector_list(p.p_O), vector_list(p.n_O), real_text(p.mu));
    if (p.torsion_radius > 0) out += ", \"torsion_radius\": " + real_text(p.torsion_radius);
    if (i < g.links.size()) out += ", \"link\": " + yaml_quoted(g.links[i]);
    out += "}";
  }
  return "[" + out + "]";
}

// false if all settings have the values of a grasp that was not measured
bool is_measured(const GraspSpec& g) {
  const GraspSpec plain;
  return !g.points.empty() || g.com != plain.com || g.rho != 1 || g.largest_radius != 1 ||
         g.gyration_radius != 1 || g.options.edges != plain.options.edges || !g.options.soft ||
         g.options.normal_force.values != plain.options.normal_force.values ||
         g.options.modulus != plain.options.modulus;
}

const char* column_of_part(GraspPart part) { return part_columns[static_cast<size_t>(part)]; }

double cell_number(std::string_view text, const std::string& place, const char* expected,
                   double low) {
  const auto x = parse_number(text);
  if (!x || !std::isfinite(*x) || *x < low)
    fail("{}: expected {}, got {}", place, expected, in_quotes(text));
  return *x;
}

// --- contacts ---

class ContactCells {
 public:
  explicit ContactCells(const std::string& place) : place_(place) {}

  void read(std::string_view text, GraspSpec& out) const {
    ValueTree tree(place_);
    if (const auto fault = read_json_tree(text, tree)) fail("{}: {}", place_, fault->sentence);
    if (tree.root().kind() != ValueKind::list) refuse("a list of contacts", tree.root());
    for (size_t i = 0; i < tree.root().size(); ++i) {
      const ValueNode one = tree.root().item(i);
      const auto normal = vector(one, "normal");
      if (!(std::abs(normal.norm() - 1) < 1e-6)) refuse("a normal of length 1", one);
      PointContact point{.p_O = vector(one, "point"), .n_O = normal, .mu = number(one, "mu")};
      if (one.find("torsion_radius")) point.torsion_radius = number(one, "torsion_radius");
      out.points.push_back(point);
      const auto link = one.find("link");
      out.links.emplace_back(link ? link->text() : "");
    }
  }

 private:
  [[noreturn]] void refuse(const char* expected, const ValueNode& got) const {
    fail("{}: expected {}, got {}", place_, expected, got.described());
  }
  ValueNode get(const ValueNode& one, const char* key) const {
    const auto found = one.find(key);
    if (!found) fail("{}: expected a key '{}' in each contact, got none", place_, key);
    return *found;
  }
  double number(const ValueNode& one, const char* key) const {
    return cell_number(get(one, key).text(), place_ + ": " + key, "a number >= 0", 0);
  }
  Eigen::Vector3d vector(const ValueNode& one, const char* key) const {
    const ValueNode list = get(one, key);
    if (list.kind() != ValueKind::list || list.size() != 3) refuse("3 numbers", list);
    Eigen::Vector3d out;
    for (int i = 0; i < 3; ++i)
      out[i] = cell_number(list.item(static_cast<size_t>(i)).text(), place_ + ": " + key,
                           "a number", -INFINITY);
    return out;
  }

  const std::string& place_;
};

void read_normal_force(std::string_view text, const std::string& place, GraspSpec& out) {
  out.options.normal_force.values.clear();
  for (const auto word : split_words(text))
    out.options.normal_force.values.push_back(cell_number(word, place, "numbers >= 0", 0));
}

}  // namespace

std::vector<std::string> part_column_names() {
  std::vector<std::string> out(std::begin(pregrasp_columns), std::end(pregrasp_columns));
  out.insert(out.end(), std::begin(part_columns), std::end(part_columns));
  return out;
}

std::vector<std::pair<std::string, std::string>> part_cells(const GraspSpec& g) {
  std::vector<std::pair<std::string, std::string>> out;
  if (g.pregrasp) {
    const auto numbers = pose_numbers(g.pregrasp->X_OH);
    for (size_t i = 0; i < pregrasp_numbers; ++i)
      out.emplace_back(pregrasp_columns[i], real_text(numbers[i]));
  }
  if (!is_measured(g)) return out;
  for (int i = 0; i < 3; ++i) {
    out.emplace_back(part_columns[i], real_text(g.com[i]));
    out.emplace_back(part_columns[3 + i], real_text(g.*part_lengths[i]));
  }
  out.emplace_back(column_of_part(GraspPart::edges), fmt::format("{}", g.options.edges));
  out.emplace_back(column_of_part(GraspPart::soft), g.options.soft ? "true" : "false");
  out.emplace_back(column_of_part(GraspPart::normal_force),
                   spaced_numbers(g.options.normal_force.values));
  out.emplace_back(column_of_part(GraspPart::modulus),
                   g.options.modulus == ModulusRule::larger ? "larger" : "series");
  out.emplace_back(column_of_part(GraspPart::contacts), contacts_text(g));
  return out;
}

void PartReader::read(size_t column, std::string_view text, const std::string& place) {
  if (column < pregrasp_numbers) {
    pregrasp_[column] = cell_number(text, place, "a number", -INFINITY);
    ++pregrasp_cells_;
    return;
  }
  const size_t part = column - pregrasp_numbers;
  seen_.push_back(part);
  switch (static_cast<GraspPart>(part)) {
    using enum GraspPart;
    case com_x:
    case com_y:
    case com_z:
      parts_.com[static_cast<int>(part)] = cell_number(text, place, "a number", -INFINITY);
      break;
    case rho:
    case largest_radius:
    case gyration_radius:
      parts_.*part_lengths[part - static_cast<size_t>(rho)] =
          cell_number(text, place, "a number > 0", 5e-324);
      break;
    case edges: {
      const auto count = parse_integer(text);
      if (!count || ((*count < 3 || *count > max_edges) && *count != round_edges))
        fail("{}: expected 0, or a whole number from 3 to {}, got {}", place, max_edges,
             in_quotes(text));
      parts_.options.edges = *count;
      break;
    }
    case soft:
      if (text != "true" && text != "false")
        fail("{}: expected true or false, got {}", place, in_quotes(text));
      parts_.options.soft = text == "true";
      break;
    case normal_force:
      read_normal_force(text, place, parts_);
      break;
    case modulus:
      if (text != "series" && text != "larger")
        fail("{}: expected series or larger, got {}", place, in_quotes(text));
      parts_.options.modulus = text == "larger" ? ModulusRule::larger : ModulusRule::series;
      break;
    case contacts:
      ContactCells(place).read(text, parts_);
      break;
  }
}

void PartReader::finish(GraspSpec& g, const std::string& place) {
  if (pregrasp_cells_ > 0) {
    if (pregrasp_cells_ != static_cast<int>(pregrasp_numbers))
      fail("{}: pregrasp: expected 7 numbers, got {}", place, pregrasp_cells_);
    const double* x = pregrasp_;
    Pose pose;
    pose.position = {x[0], x[1], x[2]};
    pose.rotation = Eigen::Quaterniond(x[3], x[4], x[5], x[6]);
    if (!(std::abs(pose.rotation.norm() - 1) < 1e-6))
      fail("{}: pregrasp: expected a quaternion of length 1, got ({} {} {} {})", place, x[3], x[4],
           x[5], x[6]);
    if (!g.pregrasp) g.pregrasp.emplace();
    g.pregrasp->X_OH = pose;
  } else if (g.pregrasp && g.X_OH) {
    g.pregrasp->X_OH = *g.X_OH;
  }
  if (seen_.empty()) return;
  g.com = parts_.com;
  for (const auto length : part_lengths) g.*length = parts_.*length;
  g.options = parts_.options;
  if (std::ranges::count(seen_, static_cast<size_t>(GraspPart::rho))) g.options.rho = g.rho;
  g.points = std::move(parts_.points);
  g.links = std::move(parts_.links);
}

}  // namespace clench
