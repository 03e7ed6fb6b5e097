#include "clench/io/graspit/eigengrasps.h"

#include <algorithm>

#include "clench/base/file.h"
#include "clench/base/text.h"
#include "clench/io/text/file_errors.h"
#include "clench/io/text/number_reader.h"
#include "clench/io/text/repairs.h"
#include "clench/io/text/xml.h"

namespace clench {

namespace {

namespace fs = std::filesystem;
using Eigen::VectorXd;

constexpr int max_dofs = 1000;  // same limit as for robots

void check_plausible_eigenvalues(const EigengraspSet& set, const std::vector<Place>& places,
                                 const ReadOptions& options) {
  for (size_t i = 0; i < set.grasps.size(); ++i)
    if (const double x = set.grasps[i].eigenvalue; x < 0)
      options.diagnostics.suspected(places[i].of("eigengrasp {}", i + 1),
                                    "its eigenvalue is {}, and variances are >= 0", x);
}

/// Places in the file of the parts of a set.
struct Places {
  EigengraspPlaces errors;    // as shown in errors
  std::vector<Place> grasps;  // one per eigengrasp
};

void tell_count(Repairs& repairs, const Place& place, int declared, int given) {
  repairs.add("count", place, "{} DOF{} declared, and numbers of {} are given; {} are used",
              declared, declared == 1 ? " is" : "s are", given, given);
}

/// Adds an eigengrasp, up to one per DOF.
void add_grasp(EigengraspSpec grasp, const Place& place, EigengraspSet& set, Places& places,
               Repairs& repairs) {
  if (static_cast<int>(set.grasps.size()) >= set.dofs) {
    repairs.add("surplus", place,
                "expected at most {} eigengrasps, one per DOF; this one is not used", set.dofs);
    return;
  }
  set.grasps.push_back(std::move(grasp));
  places.errors.grasps.push_back(place.text());
  places.grasps.push_back(place);
}

// --- text ---

bool begins_block(std::string_view keyword) {
  return keyword == "eg" || keyword == "origin" || keyword == "norm";
}

/// Number of values that all lines of vectors have at least.
int given_dofs(const std::string& text) {
  LineReader lines("", text);
  std::optional<int> least;
  while (lines.skip_to_full()) {
    if (!begins_block(lower_case(lines.next().word(0))) || !lines.skip_to_full()) continue;
    lines.next();  // the eigenvalue
    if (!lines.skip_to_full()) continue;
    const Line line = lines.next();
    int count = 0;
    while (parse_number(line.word(count))) ++count;
    least = std::min(least.value_or(count), count);
  }
  return least.value_or(0);
}

class EgrReader {
 public:
  EgrReader(const std::string& file, std::string text, const ReadOptions& options)
      : options_(options),
        repairs_(options.diagnostics),
        given_(given_dofs(text)),
        lines_(file, std::move(text)) {}
  EigengraspSet read();

 private:
  double read_eigenvalue(const std::string& what);
  VectorXd read_values(const std::string& what);
  void read_block(const std::string& keyword, const Line& line);
  void note_junk(const Line& line);

  const ReadOptions& options_;
  Repairs repairs_;
  int given_;  // number of values that all vectors have at least
  LineReader lines_;
  EigengraspSet set_;
  Places places_;
  int junk_lines_ = 0;
  Diagnostic junk_;  // first of these lines; it is reported with their number
};

EigengraspSet EgrReader::read() {
  const Line head = lines_.next_full("DIMENSIONS and the number of DOFs");
  if (lower_case(head.word(0)) != "dimensions")
    head.fail("expected DIMENSIONS and the number of DOFs, got {}", in_quotes(head.word(0)));
  set_.dofs = head.integer(1, "DIMENSIONS", 1, max_dofs);
  warn_of_surplus(head, 2, options_.diagnostics);
  // if all blocks have more values than declared, their number is used
  if (given_ > set_.dofs && given_ <= max_dofs) {
    tell_count(repairs_, head.place(), set_.dofs, given_);
    set_.dofs = given_;
  }
  while (lines_.skip_to_full()) {
    const Line line = lines_.next();
    const std::string keyword = lower_case(line.word(0));
    if (begins_block(keyword))
      read_block(keyword, line);
    else
      note_junk(line);
  }
  if (junk_lines_ == 1) junk_.text += " belongs to no block and is not used";
  if (junk_lines_ > 1)
    junk_.text += fmt::format(" and {} more belong to no block and are not used", junk_lines_ - 1);
  if (junk_lines_ > 0) options_.diagnostics.warn(junk_);
  repairs_.tell();
  check_eigengrasps(set_, lines_.file(), places_.errors);
  check_plausible_eigenvalues(set_, places_.grasps, options_);
  return std::move(set_);
}

void EgrReader::note_junk(const Line& line) {
  if (junk_lines_++ > 0) return;
  junk_ = {line.place(), fmt::format("the line {}", in_quotes(line.text()))};
}

double EgrReader::read_eigenvalue(const std::string& what) {
  const Line line = lines_.next_full(what + ": its eigenvalue");
  warn_of_surplus(line, 1, options_.diagnostics);
  return line.number(0, what + ": eigenvalue");
}

// a line with too few values is continued on the next one
VectorXd EgrReader::read_values(const std::string& what) {
  VectorXd values(set_.dofs);
  for (int i = 0; i < set_.dofs;) {
    const Line line =
        lines_.next_full(fmt::format("{}: number {} of {}", what, i + 1, set_.dofs)).before('#');
    int k = 0;
    while (k < line.size() && i < set_.dofs) values[i++] = line.number(k++, what);
    warn_of_surplus(line, k, options_.diagnostics);
  }
  return values;
}

void EgrReader::read_block(const std::string& keyword, const Line& line) {
  warn_of_surplus(line, 1, options_.diagnostics);
  if (keyword == "eg") {
    EigengraspSpec grasp;
    const std::string what = fmt::format("eigengrasp {}", set_.grasps.size() + 1);
    grasp.eigenvalue = read_eigenvalue(what);
    grasp.vector = read_values(what);
    add_grasp(std::move(grasp), line.place(), set_, places_, repairs_);
    return;
  }
  auto& target = keyword == "norm" ? set_.norm : set_.origin;
  if (target) options_.diagnostics.warn(line.place(), "a second {}; the first one counts", keyword);
  read_eigenvalue(keyword);  // required but unused
  const VectorXd values = read_values(keyword);
  if (!target)
    (keyword == "norm" ? places_.errors.norm : places_.errors.origin) = line.place().text();
  if (!target) target = values;
}

// --- XML ---

class EigengraspXml {
 public:
  EigengraspXml(const std::string& file, const std::string& text, const ReadOptions& options)
      : file_(file, text), options_(options), repairs_(options.diagnostics) {}
  EigengraspSet read();

 private:
  void count_dofs(const XmlElement& root);
  VectorXd read_values(const XmlElement& block, double missing);
  EigengraspSpec read_grasp(const XmlElement& block);

  XmlFile file_;
  const ReadOptions& options_;
  Repairs repairs_;
  EigengraspSet set_;
  Places places_;
};

EigengraspSet EigengraspXml::read() {
  const XmlElement root = file_.root();
  if (root.name() != "EigenGrasps")
    root.fail("expected an element <EigenGrasps>, got <{}>", excerpt(root.name()));
  root.check({.once = {"ORIGIN", "NORM"}, .many = {"EG"}, .attributes = {"dimensions"}},
             options_.diagnostics);
  count_dofs(root);
  for (const XmlElement& block : root.children("EG"))
    add_grasp(read_grasp(block), block.place(), set_, places_, repairs_);
  for (const auto& [name, target, missing] :
       {std::tuple("ORIGIN", &set_.origin, 0.0), {"NORM", &set_.norm, 1.0}})
    if (const XmlElement block = root.child(name)) {
      block.check({.once = {"EigenValue", "DimVals"}}, options_.diagnostics);
      *target = read_values(block, missing);
      (target == &set_.norm ? places_.errors.norm : places_.errors.origin) = block.place().text();
    }
  repairs_.tell();
  check_eigengrasps(set_, file_.file(), places_.errors);
  check_plausible_eigenvalues(set_, places_.grasps, options_);
  return std::move(set_);
}

/// Number of the DOF named by an attribute "d3"; empty for other names.
std::optional<int> numbered_dof(const std::string& name) {
  const auto number = name.starts_with('d') ? parse_integer(name.substr(1)) : std::nullopt;
  return number && *number >= 0 && *number < max_dofs ? number : std::nullopt;
}

/// If more DOFs are used than declared, their number is used.
void EigengraspXml::count_dofs(const XmlElement& root) {
  set_.dofs = root.integer_attribute("dimensions", 1, max_dofs);
  int given = set_.dofs;
  for (const char* kind : {"EG", "ORIGIN", "NORM"})
    for (const XmlElement& block : root.children(kind))
      if (const XmlElement list = block.child("DimVals"))
        for (const std::string& name : list.attributes())
          given = std::max(given, numbered_dof(name).value_or(-1) + 1);
  if (given > set_.dofs) tell_count(repairs_, root.place(), set_.dofs, given);
  set_.dofs = given;
}

EigengraspSpec EigengraspXml::read_grasp(const XmlElement& block) {
  block.check({.once = {"EigenValue", "Limits", "DimVals"}}, options_.diagnostics);
  EigengraspSpec grasp;
  if (const XmlElement value = block.child("EigenValue")) {
    value.check({.attributes = {"value"}}, options_.diagnostics);
    if (value.attribute("value")) grasp.eigenvalue = value.number_attribute("value");
  }
  if (const XmlElement limits = block.child("Limits")) {
    limits.check({.attributes = {"min", "max"}}, options_.diagnostics);
    double low = limits.number_attribute("min"), high = limits.number_attribute("max");
    repairs_.order(low, high, limits.place().of("Limits"));
    grasp.limits = {low, high};
  }
  grasp.vector = read_values(block, 0);
  return grasp;
}

// `missing` replaces absent values
VectorXd EigengraspXml::read_values(const XmlElement& block, double missing) {
  VectorXd values = VectorXd::Constant(set_.dofs, missing);
  const XmlElement list = block.expected("DimVals");
  for (const std::string& name : list.attributes()) {
    const auto number = numbered_dof(name);
    if (!number) list.fail("DimVals: expected d0 to d{}, got {}", set_.dofs - 1, in_quotes(name));
    values[*number] = list.number_attribute(name);
  }
  return values;
}

// --- writing ---

std::string plain_text(const EigengraspSet& set) {
  std::string out = fmt::format("DIMENSIONS {}\n", set.dofs);
  const auto block = [&](const char* keyword, double eigenvalue, const VectorXd& values) {
    out += fmt::format("\n{}\n{}\n{}\n", keyword, eigenvalue, listed(values));
  };
  for (const auto& grasp : set.grasps) block("EG", grasp.eigenvalue, grasp.vector);
  if (set.origin) block("ORIGIN", 0, *set.origin);
  if (set.norm) block("NORM", 0, *set.norm);
  return out;
}

}  // namespace

std::string eigengrasps_xml(const EigengraspSet& set) {
  std::string out =
      fmt::format("<?xml version=\"1.0\"?>\n<EigenGrasps dimensions=\"{}\">\n", set.dofs);
  const auto block = [&](const char* name, double eigenvalue, const VectorXd& values,
                         const std::optional<std::array<double, 2>>& limits) {
    out += fmt::format("  <{}>\n    <EigenValue value=\"{}\"/>\n", name, eigenvalue);
    if (limits)
      out += fmt::format("    <Limits min=\"{}\" max=\"{}\"/>\n", (*limits)[0], (*limits)[1]);
    out += "    <DimVals";
    for (int i = 0; i < values.size(); ++i) out += fmt::format(" d{}=\"{}\"", i, values[i]);
    out += fmt::format("/>\n  </{}>\n", name);
  };
  for (const auto& grasp : set.grasps) block("EG", grasp.eigenvalue, grasp.vector, grasp.limits);
  if (set.origin) block("ORIGIN", 0, *set.origin, {});
  if (set.norm) block("NORM", 0, *set.norm, {});
  return out + "</EigenGrasps>\n";
}

EigengraspSet read_eigengrasps(const fs::path& path, const ReadOptions& options) {
  return of_file([&] {
    std::string text = read_text(path);
    const std::string file = path.filename().string();
    if (trim(text).starts_with('<')) return EigengraspXml(file, text, options).read();
    return EgrReader(file, std::move(text), options).read();
  });
}

std::string eigengrasps_text(const EigengraspSet& set, const fs::path& path) {
  const std::string file = path.filename().string();
  check_eigengrasps(set, file);
  const std::string ending = lower_case(path.extension().string());
  if (ending == ".xml") return eigengrasps_xml(set);
  if (ending != ".egr")
    fail("{}: expected a file of eigengrasps, .egr or .xml, got {}", file, in_quotes(ending));
  return plain_text(set);
}

void write_eigengrasps(const EigengraspSet& set, const fs::path& path,
                       const Diagnostics& diagnostics) {
  const std::string text = eigengrasps_text(set, path);
  const bool limited = std::ranges::any_of(
      set.grasps, [](const EigengraspSpec& grasp) { return grasp.limits.has_value(); });
  if (limited && lower_case(path.extension().string()) == ".egr")
    diagnostics.warn(Place(path.filename().string()),
                     "the text format cannot store limits of amplitudes; .xml can");
  write_file(path, text);
}

}  // namespace clench
