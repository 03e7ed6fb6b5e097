#include "clench/io/grasp_lines.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "clench/base/file.h"
#include "clench/base/printable.h"
#include "clench/base/suggest.h"
#include "clench/base/text.h"
#include "clench/io/grasps/dof_labels.h"
#include "clench/io/grasps/identity_texts.h"
#include "clench/io/text/file_errors.h"
#include "clench/io/text/find_file.h"

namespace clench {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using Eigen::Vector3d;

static constexpr const char* format_name = "clench grasps";
static constexpr const char* unit_names = "m, kg, s, rad, N";
static constexpr int format_version = 1;
static constexpr size_t max_grasps = 10'000'000, max_list = 10'000,  // of a list in a grasp
    max_values = 250'000;                                            // of a line

// --- writing ---

static Json list_of(const Vector3d& v) { return {v.x(), v.y(), v.z()}; }

static Json numbers_of(const std::map<std::string, double>& named) {
  Json out = Json::object();
  for (const auto& [name, x] : named)
    if (std::isfinite(x)) out[name] = x;
  return out;
}

static Json json_of(const Pose& X) {
  const Eigen::Quaterniond& q = X.rotation;
  return {{"xyz", list_of(X.position)}, {"quat", {q.w(), q.x(), q.y(), q.z()}}};
}

static Json json_of(const GraspSpec& g) {
  Json out = {{"hand", g.hand_name}, {"object", g.object_name}};
  if (!g.hand_file.empty()) out["hand_file"] = g.hand_file;
  if (!g.object_file.empty()) out["object_file"] = g.object_file;
  for (const auto& [key, text] : identity_texts)
    if (!(g.*text).empty()) out[key] = g.*text;
  if (g.X_OH) out["pose"] = json_of(*g.X_OH);
  out["dofs"] = g.dofs;
  if (!g.dof_names.empty()) out["dof_names"] = g.dof_names;
  if (!g.dof_units.empty()) out["dof_units"] = g.dof_units;
  out["joints"] = g.joints;
  if (!g.joint_names.empty()) out["joint_names"] = g.joint_names;
  if (!g.joint_units.empty()) out["joint_units"] = g.joint_units;
  if (!g.joint_offsets.empty()) out["joint_offsets"] = g.joint_offsets;
  Json points = Json::array();
  for (size_t i = 0; i < g.points.size(); ++i) {
    const PointContact& p = g.points[i];
    Json point = {{"point", list_of(p.p_O)}, {"normal", list_of(p.n_O)}, {"mu", p.mu}};
    if (p.torsion_radius > 0) point["torsion_radius"] = p.torsion_radius;
    if (i < g.links.size()) point["link"] = g.links[i];
    points.push_back(std::move(point));
  }
  out["points"] = std::move(points);
  out["com"] = list_of(g.com);
  out["rho"] = g.rho;
  out["largest_radius"] = g.largest_radius;
  out["gyration_radius"] = g.gyration_radius;
  out["edges"] = g.options.edges;
  out["soft"] = g.options.soft;
  out["normal_force"] = g.options.normal_force.values;
  out["modulus"] = g.options.modulus == ModulusRule::larger ? "larger" : "series";
  out["measures"] = numbers_of(g.measures);
  out["info"] = numbers_of(g.info);
  if (!g.labels.empty()) out["labels"] = g.labels;
  if (g.pregrasp) {
    out["pregrasp"] = json_of(g.pregrasp->X_OH);
    out["pregrasp"]["dofs"] = g.pregrasp->dofs;
  }
  if (!g.squeeze.empty()) out["squeeze"] = g.squeeze;
  if (g.collision_free) out["collision_free"] = *g.collision_free;
  return out;
}

/// A line of JSON, in which control and bidirectional characters are escaped. Invalid UTF-8 is
/// replaced, so that the other data is kept.
static std::string line_of(const Json& value) {
  const std::string text = value.dump(-1, ' ', false, Json::error_handler_t::replace);
  std::string out;
  for (size_t i = 0, size = 0; i < text.size(); i += size) {
    const size_t control = control_size(text, i);
    size = std::max<size_t>(control, 1);
    // such characters occur only in strings
    if (control)
      out +=
          fmt::format("\\u{:04x}", static_cast<uint32_t>(letters_of(text.substr(i, size)).front()));
    else
      out += text[i];
  }
  return out;
}

std::string grasp_line(const GraspSpec& grasp) { return line_of(json_of(grasp)); }

std::string grasps_head(const std::string& notes) {
  Json head = {{"format", format_name},
               {"version", format_version},
               {"units", unit_names},
               {"pose", "of the hand's base in the object's frame; quat is w x y z"}};
  if (!notes.empty()) head["notes"] = Json::parse(notes);
  return line_of(head);
}

std::string grasps_text(const std::vector<GraspSpec>& grasps, const std::string& notes) {
  std::string text = grasps_head(notes) + "\n";
  for (const GraspSpec& grasp : grasps) text += grasp_line(grasp) + "\n";
  return text;
}

void write_grasps(const std::vector<GraspSpec>& grasps, const fs::path& path,
                  const std::string& notes) {
  write_file(path, grasps_text(grasps, notes));
}

// --- reading ---

namespace {

using Parsed = nlohmann::json;  // sorted keys: long objects do not take quadratic time

/// Parses a line into a tree. Values are counted during parsing, so that a line takes bounded
/// memory.
class LineParser : public nlohmann::json_sax<Parsed> {
 public:
  explicit LineParser(const Line& line) : line_(line) {}

  /// returns  nothing if the text ends before the value is complete
  std::optional<Parsed> parse() {
    if (Parsed::sax_parse(line_.text(), this)) return std::move(root_);
    if (is_cut_) return {};
    line_.fail("expected a line of JSON, got {}", in_quotes(line_.text()));
  }

  bool null() override { return add(nullptr); }
  bool boolean(bool x) override { return add(x); }
  bool number_integer(number_integer_t x) override { return add(x); }
  bool number_unsigned(number_unsigned_t x) override { return add(x); }
  bool number_float(number_float_t x, const string_t&) override { return add(x); }
  bool string(string_t& text) override { return add(std::move(text)); }
  bool binary(binary_t&) override { return false; }
  bool start_object(size_t) override { return open(Parsed::object()); }
  bool start_array(size_t) override { return open(Parsed::array()); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }
  bool key(string_t& name) override {
    const auto [place, is_new] = open_.back()->emplace(name, nullptr);
    if (!is_new) line_.fail("key {} appears twice", in_quotes(name));
    value_ = &*place;
    return true;
  }
  bool parse_error(size_t byte, const std::string&, const nlohmann::detail::exception& e) override {
    is_cut_ = e.id == syntax_error && byte > line_.text().size();
    return false;
  }

 private:
  // position of the next value: after its key, at the end of a list, or the root
  Parsed& put(Parsed&& value) {
    if (++count_ > max_values)
      line_.fail("expected at most {} values in a line, got more", max_values);
    if (open_.empty()) return root_ = std::move(value);
    if (open_.back()->is_object()) return *value_ = std::move(value);
    open_.back()->push_back(std::move(value));
    return open_.back()->back();
  }
  bool add(Parsed&& value) {
    put(std::move(value));
    return true;
  }
  bool open(Parsed&& value) {
    if (open_.size() == max_depth)
      line_.fail("expected lists and objects at most {} deep, got more", max_depth);
    open_.push_back(&put(std::move(value)));
    return true;
  }
  bool close() {
    open_.pop_back();
    return true;
  }

  static constexpr size_t max_depth = 8;
  static constexpr int syntax_error = 101;  // code in parse errors of nlohmann

  const Line& line_;
  bool is_cut_ = false;
  Parsed root_;
  std::vector<Parsed*> open_;
  Parsed* value_ = nullptr;
  size_t count_ = 0;
};

/// An object of a line, read key by key; keys that were not read are an error.
class Fields {
 public:
  Fields(const Parsed& json, std::string place) : json_(json), place_(std::move(place)) {
    if (!json.is_object()) refuse("an object", json);
  }

  const Parsed* find(const char* key) {
    known_.push_back(key);
    const auto found = json_.find(key);
    return found == json_.end() ? nullptr : &*found;
  }
  const Parsed& get(const char* key) {
    if (const Parsed* found = find(key)) return *found;
    fail("{}: expected a key '{}', got none", place_, key);
  }
  double number(const char* key, double low) {
    const Parsed& value = get(key);
    if (!value.is_number() || !(value.get<double>() >= low))
      Fields::refuse(at(key), low == 0 ? "a number >= 0" : "a number", value);
    return value.get<double>();
  }
  double positive(const char* key) {
    const double x = number(key, 0);
    if (x == 0) refuse(at(key), "a number > 0", get(key));
    return x;
  }
  std::string text(const char* key, bool needed) {
    const Parsed* value = needed ? &get(key) : find(key);
    if (!value) return "";
    if (!value->is_string()) refuse(at(key), "a string", *value);
    return value->get<std::string>();
  }
  std::vector<double> numbers(const char* key, int count = -1) {
    const Parsed& list = get(key);
    const std::string expected = count < 0 ? "a list of numbers" : fmt::format("{} numbers", count);
    if (!list.is_array() || (count >= 0 ? list.size() != size_t(count) : list.size() > max_list))
      refuse(at(key), expected, list);
    for (const Parsed& x : list)
      if (!x.is_number()) refuse(at(key), expected, x);
    return list.get<std::vector<double>>();
  }
  std::vector<std::string> texts(const char* key, size_t count) {
    const Parsed& list = get(key);
    const std::string expected = fmt::format("a list of {} strings", count);
    if (!list.is_array() || list.size() != count) refuse(at(key), expected, list);
    for (const Parsed& x : list)
      if (!x.is_string()) refuse(at(key), expected, x);
    return list.get<std::vector<std::string>>();
  }
  Vector3d vec3(const char* key) {
    const auto x = numbers(key, 3);
    return Vector3d::Map(x.data());
  }
  bool boolean(const char* key) {
    const Parsed& value = get(key);
    if (!value.is_boolean()) refuse(at(key), "true or false", value);
    return value.get<bool>();
  }
  /// Numbers or strings by name.
  template <class T>
  std::map<std::string, T> named(const char* key) {
    constexpr bool texts = std::is_same_v<T, std::string>;
    const Parsed& object = get(key);
    if (!object.is_object())
      refuse(at(key), texts ? "an object of strings" : "an object of numbers", object);
    for (const auto& [name, x] : object.items())
      if (texts ? !x.is_string() : !x.is_number())
        refuse(at(key) + "." + excerpt(name), texts ? "a string" : "a number", x);
    return object.get<std::map<std::string, T>>();
  }
  std::string at(const char* key) const { return fmt::format("{}: {}", place_, key); }
  void done() const {
    for (const auto& [key, value] : json_.items())
      if (std::find(known_.begin(), known_.end(), key) == known_.end())
        fail("{}: unknown key {}{}", place_, in_quotes(key), did_you_mean(key, known_));
  }
  [[noreturn]] static void refuse(const std::string& place, const std::string& expected,
                                  const Parsed& got) {
    fail("{}: expected {}, got {}", place, expected,
         excerpt(got.dump(-1, ' ', false, Parsed::error_handler_t::replace)));
  }

 private:
  [[noreturn]] void refuse(const std::string& expected, const Parsed& got) const {
    refuse(place_, expected, got);
  }

  const Parsed& json_;
  std::string place_;
  std::vector<std::string> known_;
};

PointContact read_point(Fields& fields) {
  PointContact out{
      .p_O = fields.vec3("point"), .n_O = fields.vec3("normal"), .mu = fields.number("mu", 0)};
  // a written normal has unit length up to rounding
  if (!(std::abs(out.n_O.norm() - 1) < 1e-6))
    Fields::refuse(fields.at("normal"), "a vector of length 1", fields.get("normal"));
  if (fields.find("torsion_radius")) out.torsion_radius = fields.number("torsion_radius", 0);
  return out;
}

Pose read_pose(Fields& fields) {
  const auto q = fields.numbers("quat", 4);
  Pose out;
  out.position = fields.vec3("xyz");
  out.rotation = Eigen::Quaterniond(q[0], q[1], q[2], q[3]);
  if (!(std::abs(out.rotation.norm() - 1) < 1e-6))
    Fields::refuse(fields.at("quat"), "a quaternion of length 1", fields.get("quat"));
  return out;
}

Pose read_pose(const Parsed& json, const std::string& place) {
  Fields fields(json, place);
  const Pose out = read_pose(fields);
  fields.done();
  return out;
}

PregraspState read_pregrasp(const Parsed& json, const std::string& place) {
  Fields fields(json, place);
  PregraspState out{read_pose(fields), fields.numbers("dofs")};
  fields.done();
  return out;
}

void read_joint_labels(Fields& fields, GraspSpec& out) {
  // labels without joint positions are ignored
  if (!fields.find("joints")) {
    for (const char* key : {"joint_names", "joint_units", "joint_offsets"}) fields.find(key);
    return;
  }
  for (const auto& [key, list] :
       {std::pair{"joint_names", &out.joint_names}, {"joint_units", &out.joint_units}})
    if (fields.find(key)) *list = fields.texts(key, out.joints.size());
  check_dof_names(fields.at("joint_names"), out.joint_names);
  check_dof_units(fields.at("joint_units"), out.joint_units);
  if (fields.find("joint_offsets"))
    out.joint_offsets = fields.numbers("joint_offsets", static_cast<int>(out.joints.size()));
}

/// Edges of the friction pyramids; 0 and "exact" select round cones.
int read_edges(Fields& fields) {
  const Parsed& value = fields.get("edges");
  if (value == "exact") return round_edges;
  const double edges = value.is_number() ? value.get<double>() : -1;
  if (edges != std::floor(edges) || edges > max_edges || (edges < 3 && edges != round_edges))
    Fields::refuse(
        fields.at("edges"),
        fmt::format("a whole number from 3 to {}, or \"exact\" or 0 for round cones", max_edges),
        value);
  return static_cast<int>(edges);
}

GraspSpec read_line(const Parsed& json, const std::string& place) {
  Fields fields(json, place);
  GraspSpec out;
  out.hand_name = fields.text("hand", true);
  out.object_name = fields.text("object", true);
  out.hand_file = fields.text("hand_file", false);
  out.object_file = fields.text("object_file", false);
  for (const auto& [key, text] : identity_texts) out.*text = fields.text(key, false);
  if (const Parsed* pose = fields.find("pose")) out.X_OH = read_pose(*pose, fields.at("pose"));
  out.dofs = fields.numbers("dofs");
  for (const auto& [key, list] :
       {std::pair{"dof_names", &out.dof_names}, {"dof_units", &out.dof_units}})
    if (fields.find(key)) *list = fields.texts(key, out.dofs.size());
  check_dof_names(fields.at("dof_names"), out.dof_names);
  check_dof_units(fields.at("dof_units"), out.dof_units);
  // optional: the DOFs determine the joints
  if (fields.find("joints")) out.joints = fields.numbers("joints");
  read_joint_labels(fields, out);
  const Parsed& points = fields.get("points");
  if (!points.is_array() || points.size() > max_list)
    Fields::refuse(fields.at("points"), "a list of contacts", points);
  for (const Parsed& item : points) {
    Fields point(item, fmt::format("{}: points[{}]", place, out.points.size() + 1));
    out.points.push_back(read_point(point));
    out.links.push_back(point.text("link", false));
    point.done();
  }
  out.com = fields.vec3("com");
  out.rho = fields.positive("rho");
  out.largest_radius = fields.positive("largest_radius");
  out.gyration_radius = fields.positive("gyration_radius");
  out.options.edges = read_edges(fields);
  out.options.rho = out.rho;
  out.options.soft = fields.boolean("soft");
  out.options.normal_force = fields.numbers("normal_force");
  const std::string modulus = fields.text("modulus", true);
  if (modulus != "series" && modulus != "larger")
    Fields::refuse(fields.at("modulus"), "'series' or 'larger'", fields.get("modulus"));
  out.options.modulus = modulus == "larger" ? ModulusRule::larger : ModulusRule::series;
  out.measures = fields.named<double>("measures");
  out.info = fields.named<double>("info");
  if (fields.find("labels")) out.labels = fields.named<std::string>("labels");
  if (const Parsed* pregrasp = fields.find("pregrasp"))
    out.pregrasp = read_pregrasp(*pregrasp, fields.at("pregrasp"));
  if (fields.find("squeeze"))
    out.squeeze = fields.numbers("squeeze", static_cast<int>(out.dofs.size()));
  if (fields.find("collision_free")) out.collision_free = fields.boolean("collision_free");
  fields.done();
  return out;
}

void check_head(const Parsed& json, const std::string& place) {
  const bool ours = json.is_object() && json.contains("format") && json["format"] == format_name;
  if (!ours)
    Fields::refuse(place, fmt::format("a list of grasps, \"format\": \"{}\"", format_name), json);
  const Parsed* number = json.contains("version") ? &json["version"] : nullptr;
  if (!number || *number != format_version)
    fail("{}: expected version {}, got {}", place, format_version,
         number ? excerpt(number->dump()) : "none");
  if (json.contains("units") && json["units"] != unit_names)
    Fields::refuse(place + ": units", fmt::format("\"{}\"", unit_names), json["units"]);
}

}  // namespace

void read_grasps(const std::string& file, std::string text, const GraspSink& sink,
                 const ReadOptions& options) {
  GraspCollector list(file, text.size(), sink);
  // a line of a grasp has about a dozen keys
  constexpr size_t shortest = 200;
  list.expect(text.size() / shortest);
  const bool has_last_end = text.ends_with('\n');
  LineReader lines(file, std::move(text));
  size_t count = 0;
  bool head = false;
  while (!lines.done()) {
    const Line line = lines.next();
    if (line.blank()) continue;
    options.progress.check();
    const std::optional<Parsed> value = LineParser(line).parse();
    if (!value) {
      // a killed program or a full disk leaves an incomplete line
      if (!head || !lines.done() || has_last_end)
        line.fail("expected a line of JSON, got {}", in_quotes(line.text()));
      options.diagnostics.warn(line.place(), "the last line is cut short and is skipped, got {}",
                               in_quotes(line.text()));
      break;
    }
    if (!head) {
      check_head(*value, line.place().text());
      head = true;
      continue;
    }
    if (++count > max_grasps) line.fail("expected at most {} grasps", max_grasps);
    list.add(read_line(*value, line.place().text()));
  }
  if (!head) fail("{}: expected a list of grasps, got an empty file", file);
}

std::vector<GraspSpec> read_grasps(const fs::path& path, const ReadOptions& options) {
  return of_file([&] {
    std::vector<GraspSpec> out;
    read_grasps(path.filename().string(), read_text(find_file(path.string(), "", options)),
                {.add = [&](GraspSpec&& g) { out.push_back(std::move(g)); }}, options);
    return out;
  });
}

}  // namespace clench
