#include "io/eigengrasps.h"

#include <algorithm>

#include "base/file.h"
#include "base/text.h"
#include "io/xml.h"

namespace clench {

namespace {

namespace fs = std::filesystem;
using Eigen::VectorXd;

constexpr int most_dofs = 1000;  // as of robots

void warn(const ReadOptions& options, const std::string& sentence) {
  if (options.warn && !sentence.empty()) options.warn(sentence);
}

void doubt_eigenvalues(const EigengraspSet& set, const EigengraspPlaces& places,
                       const ReadOptions& options) {
  for (size_t i = 0; i < set.grasps.size(); ++i)
    if (const double x = set.grasps[i].eigenvalue; x < 0)
      options.doubted(fmt::format("{}: eigengrasp {}: its eigenvalue is {}, and variances are >= 0",
                                  places.grasps[i], i + 1, x));
}

// --- text ---

class EgrReader {
 public:
  EgrReader(const std::string& file, std::string text, const ReadOptions& options)
      : lines_(file, std::move(text)), options_(options) {}
  EigengraspSet read();

 private:
  double read_eigenvalue(const std::string& what);
  VectorXd read_values(const std::string& what);
  void read_block(const std::string& keyword, const Line& line);
  void note_junk(const Line& line);

  LineReader lines_;
  const ReadOptions& options_;
  EigengraspSet set_;
  EigengraspPlaces places_;
  int junk_lines_ = 0;
  std::string junk_;  // the first, as it will be told
};

EigengraspSet EgrReader::read() {
  const Line head = lines_.next_full("DIMENSIONS and the number of DOFs");
  if (lower_case(head.word(0)) != "dimensions")
    head.fail("wanted DIMENSIONS and the number of DOFs, got {}", in_quotes(head.word(0)));
  set_.dofs = head.integer(1, "DIMENSIONS", 1, most_dofs);
  warn(options_, head.surplus(2));
  while (lines_.skip_to_full()) {
    const Line line = lines_.next();
    const std::string keyword = lower_case(line.word(0));
    if (keyword == "eg" || keyword == "origin" || keyword == "norm")
      read_block(keyword, line);
    else
      note_junk(line);
  }
  if (junk_lines_ == 1) warn(options_, junk_ + " belongs to no block and is not used");
  if (junk_lines_ > 1)
    warn(options_,
         fmt::format("{} and {} more belong to no block and are not used", junk_, junk_lines_ - 1));
  check_eigengrasps(set_, lines_.file(), places_);
  doubt_eigenvalues(set_, places_, options_);
  return std::move(set_);
}

void EgrReader::note_junk(const Line& line) {
  if (junk_lines_++ > 0) return;
  junk_ = fmt::format("{}: the line {}", line.place(), in_quotes(line.text()));
}

double EgrReader::read_eigenvalue(const std::string& what) {
  const Line line = lines_.next_full(what + ": its eigenvalue");
  warn(options_, line.surplus(1));
  return line.number(0, what + ": eigenvalue");
}

// a line that is too short goes on in the next one
VectorXd EgrReader::read_values(const std::string& what) {
  VectorXd values(set_.dofs);
  for (int i = 0; i < set_.dofs;) {
    const Line line =
        lines_.next_full(fmt::format("{}: number {} of {}", what, i + 1, set_.dofs)).before('#');
    int k = 0;
    while (k < line.size() && i < set_.dofs) values[i++] = line.number(k++, what);
    warn(options_, line.surplus(k));
  }
  return values;
}

void EgrReader::read_block(const std::string& keyword, const Line& line) {
  warn(options_, line.surplus(1));
  if (keyword == "eg") {
    if (static_cast<int>(set_.grasps.size()) == set_.dofs)
      line.fail("wanted at most {} eigengrasps, one a DOF", set_.dofs);
    EigengraspSpec grasp;
    const std::string what = fmt::format("eigengrasp {}", set_.grasps.size() + 1);
    grasp.eigenvalue = read_eigenvalue(what);
    grasp.vector = read_values(what);
    set_.grasps.push_back(std::move(grasp));
    places_.grasps.push_back(line.place());
    return;
  }
  auto& target = keyword == "norm" ? set_.norm : set_.origin;
  if (target)
    warn(options_, fmt::format("{}: a second {}; the first one counts", line.place(), keyword));
  read_eigenvalue(keyword);  // stands there, and means nothing
  const VectorXd values = read_values(keyword);
  if (!target) (keyword == "norm" ? places_.norm : places_.origin) = line.place();
  if (!target) target = values;
}

// --- XML ---

class EigengraspXml {
 public:
  EigengraspXml(const std::string& file, const std::string& text, const ReadOptions& options)
      : file_(file, text), options_(options) {}
  EigengraspSet read();

 private:
  VectorXd read_values(const XmlElement& block, double missing);
  EigengraspSpec read_grasp(const XmlElement& block);

  XmlFile file_;
  const ReadOptions& options_;
  EigengraspSet set_;
  EigengraspPlaces places_;
};

EigengraspSet EigengraspXml::read() {
  const XmlElement root = file_.root();
  if (root.name() != "EigenGrasps")
    root.fail("wanted an element <EigenGrasps>, got <{}>", root.name().substr(0, 40));
  root.check({.once = {"ORIGIN", "NORM"}, .many = {"EG"}, .attributes = {"dimensions"}},
             options_.warn);
  set_.dofs = root.integer_attribute("dimensions", 1, most_dofs);
  for (const XmlElement& block : root.children("EG")) {
    if (static_cast<int>(set_.grasps.size()) == set_.dofs)
      block.fail("wanted at most {} eigengrasps, one a DOF", set_.dofs);
    set_.grasps.push_back(read_grasp(block));
    places_.grasps.push_back(block.place());
  }
  for (const auto& [name, target, missing] :
       {std::tuple("ORIGIN", &set_.origin, 0.0), {"NORM", &set_.norm, 1.0}})
    if (const XmlElement block = root.child(name)) {
      block.check({.once = {"EigenValue", "DimVals"}}, options_.warn);
      *target = read_values(block, missing);
      (target == &set_.norm ? places_.norm : places_.origin) = block.place();
    }
  check_eigengrasps(set_, file_.file(), places_);
  doubt_eigenvalues(set_, places_, options_);
  return std::move(set_);
}

EigengraspSpec EigengraspXml::read_grasp(const XmlElement& block) {
  block.check({.once = {"EigenValue", "Limits", "DimVals"}}, options_.warn);
  EigengraspSpec grasp;
  if (const XmlElement value = block.child("EigenValue")) {
    value.check({.attributes = {"value"}}, options_.warn);
    if (value.attribute("value")) grasp.eigenvalue = value.number_attribute("value");
  }
  if (const XmlElement limits = block.child("Limits")) {
    limits.check({.attributes = {"min", "max"}}, options_.warn);
    grasp.limits = {limits.number_attribute("min"), limits.number_attribute("max")};
    if ((*grasp.limits)[0] > (*grasp.limits)[1])
      limits.fail("Limits: min {} exceeds max {}", (*grasp.limits)[0], (*grasp.limits)[1]);
  }
  grasp.vector = read_values(block, 0);
  return grasp;
}

// values that are not there are `missing`
VectorXd EigengraspXml::read_values(const XmlElement& block, double missing) {
  VectorXd values = VectorXd::Constant(set_.dofs, missing);
  const XmlElement list = block.wanted("DimVals");
  for (const std::string& name : list.attributes()) {
    const auto number = name.starts_with('d') ? parse_integer(name.substr(1)) : std::nullopt;
    if (!number || *number < 0 || *number >= set_.dofs)
      list.fail("DimVals: wanted d0 to d{}, got {}", set_.dofs - 1, in_quotes(name));
    values[*number] = list.number_attribute(name);
  }
  return values;
}

// --- writing ---

std::string text_of(const EigengraspSet& set) {
  std::string out = fmt::format("DIMENSIONS {}\n", set.dofs);
  const auto block = [&](const char* keyword, double eigenvalue, const VectorXd& values) {
    out += fmt::format("\n{}\n{}\n", keyword, eigenvalue);
    for (int i = 0; i < values.size(); ++i) out += fmt::format("{}{}", i ? " " : "", values[i]);
    out += '\n';
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
  std::string text = read_text(path);
  const std::string file = path.filename().string();
  if (trim(text).starts_with('<')) return EigengraspXml(file, text, options).read();
  return EgrReader(file, std::move(text), options).read();
}

std::string eigengrasps_text(const EigengraspSet& set, const fs::path& path) {
  const std::string file = path.filename().string();
  check_eigengrasps(set, file);
  const std::string ending = lower_case(path.extension().string());
  if (ending == ".xml") return eigengrasps_xml(set);
  if (ending != ".egr")
    fail("{}: wanted a file of eigengrasps, .egr or .xml, got {}", file, in_quotes(ending));
  return text_of(set);
}

void write_eigengrasps(const EigengraspSet& set, const fs::path& path,
                       const std::function<void(const std::string&)>& warn) {
  const std::string text = eigengrasps_text(set, path);
  const bool limited = std::ranges::any_of(
      set.grasps, [](const EigengraspSpec& grasp) { return grasp.limits.has_value(); });
  if (limited && warn && lower_case(path.extension().string()) == ".egr")
    warn(fmt::format("{}: the text format has no place for limits of amplitudes; .xml has",
                     path.filename().string()));
  write_file(path, text);
}

}  // namespace clench
