#include "clench/io/graspit/graspit_readers.h"

#include "clench/base/suggest.h"
#include "clench/base/text.h"
#include "clench/base/units.h"
#include "clench/io/graspit/robot_files.h"
#include "clench/io/graspit/robot_parts.h"
#include "clench/io/graspit/transform_list.h"
#include "clench/io/text/file_errors.h"
#include "clench/io/text/number_reader.h"
#include "clench/io/text/repair_names.h"
#include "clench/io/text/repairs.h"
#include "clench/spec/compliant_coupling.h"

namespace clench {

namespace {

namespace fs = std::filesystem;

constexpr int max_parts =
    // limit of DOFs, chains, joints, links: far above any hand, but small enough for the memory
    1000;

/// Numbers of a DOF as written; their units depend on the kind of its joints, which are read later.
struct DofLine {
  Line line;
  DofSpec dof = {};
};

class CfgReader {
 public:
  CfgReader(const fs::path& path, FileCache& cache)
      : path_(path),
        cache_(cache),
        repairs_(cache.diagnostics()),
        lines_(path.filename().string(), read_text(path)) {}
  RobotSpec read();

 private:
  Line expected(std::string_view what) { return lines_.next_full(what).before('#'); }
  void used_up(const Line& line, int used) { warn_of_surplus(line, used, cache_.diagnostics()); }
  int count(const char* what, int low);
  void read_dofs();
  void read_chain(int number);
  void read_joint(ChainLinks& chain, int number);
  void read_link(ChainLinks& chain, int number, const std::string& name);
  void read_optional_blocks();
  void read_tracker();
  void read_approach();
  NamedFile named_file(const char* what);
  BodySpec body(const Line& line, const std::string& name);
  void set_dof_units();
  void check_ranges();

  const fs::path& path_;
  FileCache& cache_;
  Repairs repairs_;
  LineReader lines_;
  std::vector<DofLine> dof_lines_;
  DofKinds dof_kinds_;
  NamedFiles named_;
  RobotSpec robot_;
};

int CfgReader::count(const char* what, int low) {
  const Line line = expected(what);
  const int value = line.integer(0, what, low, max_parts);
  used_up(line, 1);
  return value;
}

BodySpec CfgReader::body(const Line& line, const std::string& name) {
  BodySpec out = cache_.part(std::string(line.word(0)), path_, line.place());
  out.name = name;
  return out;
}

RobotSpec CfgReader::read() {
  robot_.name = path_.stem().string();
  robot_.source = path_.generic_string();
  const Line head = expected("the robot's class");
  robot_.class_name = head.word(0);
  check_class(robot_.class_name, head.place(), cache_.diagnostics());
  used_up(head, 1);
  const Line palm = expected("the palm's file");
  used_up(palm, 1);
  robot_.base = body(palm, robot_.name + "_base");
  read_dofs();
  const int chains = count("number of chains", 0);
  for (int c = 0; c < chains; ++c) read_chain(c);
  set_dof_units();
  couple_by_springs(robot_);
  check_ranges();
  read_optional_blocks();
  check_read_robot(robot_, head.place(), cache_.options());
  repairs_.tell();
  read_robot_files(robot_, named_, path_, cache_.options());
  return std::move(robot_);
}

/// check_robot checks the range of each quantity later; here only overflow of products is
/// prevented.
static double in_bounds(double x, const char* what, const std::string& place) {
  check(number_rule.called(what), x, place);
  return x;
}

void CfgReader::read_dofs() {
  const int dofs = count("number of DOFs", 0);
  for (int i = 0; i < dofs; ++i) {
    const Line line = expected(fmt::format("the line of DOF {}", i));
    const Place place = line.place().of("DOF {}", i);
    DofSpec dof{.kind = dof_kind(line.word(0), place.text())};
    const auto number = [&](int k, const char* what) {
      if (k > 2 && k >= line.size()) {
        repairs_.add("missing", place, "{} is missing; 0 is used", what);
        return 0.0;
      }
      return in_bounds(line.number(k, fmt::format("DOF {}: {}", i, what)), what, place.text());
    };
    const auto magnitude = [&](int k, const char* what) {
      return repairs_.magnitude(number(k, what), place.of(what));
    };
    dof.default_velocity = number(1, "default velocity");
    dof.max_effort = magnitude(2, "max effort");
    dof.kp = number(3, "Kp");
    dof.kd = number(4, "Kd");
    dof.dragger_scale = number(5, "dragger scale");
    const bool breaks = dof.kind == DofKind::breakaway;
    if (breaks) dof.breakaway_torque = magnitude(6, "breakaway torque");
    used_up(line, breaks ? 7 : 6);
    dof_lines_.push_back({line, dof});
  }
  dof_kinds_.resize(dofs);
}

void CfgReader::read_chain(int number) {
  const int joints = count("number of joints", 0), links = count("number of links", 1);
  const Line transform = lines_.peek();
  ChainLinks chain(read_transform_list(lines_, cache_.diagnostics()), dof_kinds_);
  for (int j = 0; j < joints; ++j) read_joint(chain, j);
  for (int l = 0; l < links; ++l)
    read_link(chain, l, fmt::format("{}_chain{}_link{}", robot_.name, number, l));
  if (chain.last_joint() + 1 < joints)
    cache_.diagnostics().warn(transform.place().of("chain {}", number),
                              "joints from {} on move no link, and are not used",
                              chain.last_joint() + 1);
}

void CfgReader::read_joint(ChainLinks& chain, int number) {
  const Line line = expected(fmt::format("the line of joint {}", number));
  const Place place = line.place().of("joint {}", number);
  const auto value = [&](int i, const char* what) {
    return in_bounds(line.number(i, fmt::format("joint {}: {}", number, what)), what, place.text());
  };
  JointSpec joint;

  // the DOF is in the theta column of a revolute joint, in the d column of a prismatic one
  joint.kind = line.word(0).starts_with('d') ? JointKind::revolute : JointKind::prismatic;
  const bool revolute = joint.kind == JointKind::revolute;
  const std::string_view text = line.word(revolute ? 0 : 1);
  // reports a word in this column first
  if (!revolute && !parse_joint_expression(text)) value(0, "theta");
  const auto [dof, ratio, offset] =
      expected_expression(text, joint.kind, dof_lines_.size(), place.text());
  joint.dof = dof;
  joint.ratio = ratio;
  check_each(number_rule, {{"offset", offset}, {"ratio", ratio}}, place.text());

  const DenavitHartenberg numbers = {.theta = revolute ? offset : value(0, "theta"),
                                     .d = revolute ? value(1, "d") : offset,
                                     .a = value(2, "a"),
                                     .alpha = value(3, "alpha")};
  joint.min = value(4, "min");
  joint.max = value(5, "max");
  repairs_.order(joint.min, joint.max, place);
  const auto loss = [&](int i, const char* what) {
    if (line.size() <= i) return 0.0;
    return repairs_.magnitude(value(i, what), place.of(what));
  };
  joint.viscous = loss(6, "viscous friction");
  joint.coulomb = loss(7, "Coulomb friction");
  joint.spring = loss(8, "spring stiffness");
  if (line.size() > 9) joint.rest = value(9, "rest value");
  used_up(line, 10);
  errors_at(line, [&] { chain.add_joint(joint, numbers); });
}

void CfgReader::read_link(ChainLinks& chain, int number, const std::string& name) {
  const Line kind_line = expected(fmt::format("the joint type of link {}", number));
  errors_at(kind_line.place().of("link {}", number),
            [&] { return joints_of_kind(kind_line.word(0)); });
  used_up(kind_line, 1);
  const Line line = expected(fmt::format("the file of link {}", number));
  used_up(line, 2);
  const int before = chain.last_joint(), joints = chain.joints();
  int last = before + 1;
  if (line.size() > 1) {
    // joints that move the link before also move this one
    last = line.integer(1, fmt::format("link {}: last joint", number), before, joints - 1);
  } else {
    cache_.diagnostics().note(line.place().of("link {}", number),
                              "its last joint is not given; joint {} moves it", last);
  }
  if (last >= joints)
    line.fail("link {}: expected a joint to move it, got {} joints for {} links", number, joints,
              number + 1);
  chain.add_link(body(line, name), last, robot_);
}

void CfgReader::set_dof_units() {
  for (size_t i = 0; i < dof_lines_.size(); ++i) {
    const auto& [line, dof] = dof_lines_[i];
    if (!dof_kinds_[i]) cache_.diagnostics().suspected(line.place(), "DOF {} moves no joint", i);
    robot_.dofs.push_back(in_si(dof, dof_kinds_[i] == JointKind::prismatic));
  }
}

void CfgReader::check_ranges() {
  for (size_t i = 0; i < dof_lines_.size(); ++i) {
    const auto range = dof_range(robot_, static_cast<int>(i));
    if (range[0] > range[1]) dof_lines_[i].line.fail("DOF {}: {}", i, no_range(range));
  }
}

NamedFile CfgReader::named_file(const char* what) {
  const Line line = expected(fmt::format("the file of {}", what));
  return {std::string(line.text()), line.place().of(what)};
}

void CfgReader::read_tracker() {
  TrackerSpec tracker;
  // some files omit the number
  if (lines_.skip_to_full() && begins_transform(lines_.peek())) {
    cache_.diagnostics().note(lines_.peek().place().of("FlockOfBirds"),
                              "no bird number, 0 is used");
  } else {
    const Line line = expected("a bird number");
    tracker.number = repairs_.count(line.word(0), line.place().of("FlockOfBirds"));
  }
  tracker.X_BS = read_transform_list(lines_, cache_.diagnostics());
  robot_.tracker = tracker;
}

void CfgReader::read_approach() {
  const auto vector = [&](const char* what) {
    const Line line = expected(what);
    used_up(line, 3);
    return std::pair(
        line, Eigen::Vector3d(line.number(0, what), line.number(1, what), line.number(2, what)));
  };
  const Eigen::Vector3d point = vector("approach point").second * units::millimeter;
  const auto direction = vector("approach direction");
  robot_.X_BA = errors_at(direction.first, [&] { return approach_frame(point, direction.second); });
}

void CfgReader::read_optional_blocks() {
  while (lines_.skip_to_full()) {
    const Line line = lines_.next().before('#');
    const std::string_view key = line.word(0);
    if (key == "EigenGrasps")
      named_.eigengrasps = named_file("EigenGrasps");
    else if (key == "VirtualContacts")
      named_.virtual_contacts = named_file("VirtualContacts");
    else if (key == "CyberGlove")
      named_.glove_calibration = named_file("CyberGlove");
    else if (key == "FlockOfBirds")
      read_tracker();
    else if (key == "Approach")
      read_approach();
    else {
      const std::vector<std::string> keywords = {"EigenGrasps", "FlockOfBirds", "Approach",
                                                 "VirtualContacts", "CyberGlove"};
      cache_.diagnostics().warn(line.place(), "unknown keyword {} is not used{}", in_quotes(key),
                                did_you_mean(key, keywords));
    }
  }
}

}  // namespace

RobotSpec read_robot_cfg(const fs::path& path, FileCache& cache) {
  return CfgReader(path, cache).read();
}

}  // namespace clench
