#include "clench/io/graspit/virtual_contacts.h"
#include "clench/io/text/file_errors.h"

#include "clench/base/file.h"
#include "clench/base/text.h"
#include "clench/base/units.h"
#include "clench/io/text/number_reader.h"
#include "clench/io/text/repairs.h"
#include "clench/io/text/xml.h"

namespace clench {

namespace fs = std::filesystem;
using Eigen::Vector3d;

namespace {

constexpr int max_chains = 1000;  // same limit as for robots

// forces have no unit, torques per force are lengths
Vector6d edge_in_meters(Vector6d edge) {
  edge.tail<3>() *= units::millimeter;
  return edge;
}

/// Redundant pose of a contact as stated in the file.
struct StatedPose {
  Vector3d location, translation, normal;  // millimeters
  Eigen::Quaterniond rotation;
};

// tolerances for the two redundant statements, by the digits that files contain
constexpr double same_length = 0.01;  // [mm]
constexpr double same_angle = 0.01;   // [rad]

Pose contact_pose(const StatedPose& place, const Place& subject, const Diagnostics& diagnostics) {
  if (diagnostics && !((place.location - place.translation).norm() <= same_length))
    diagnostics.warn(subject, "location and translation differ; the translation is used");
  const Vector3d z = place.rotation * Vector3d::UnitZ();
  const double angle = std::atan2(z.cross(place.normal).norm(), z.dot(place.normal));
  if (diagnostics && !(angle <= same_angle))
    diagnostics.warn(subject, "normal and rotation differ by {:.3g} rad; the rotation is used",
                     angle);
  return {place.rotation, place.translation * units::millimeter};
}

/// Chain and link of a contact in a file. `read` returns the integer with a given name and minimum.
template <class Read>
ChainPlace read_place(Read read) {
  const int chain = read("finger", -1);
  if (chain >= 0) return {chain, read("link", 0)};
  // the palm has no links: files write -1 or an arbitrary number
  read("link", std::numeric_limits<int>::min());
  return {};
}

void add(VirtualContactSet& set, ChainPlace place, VirtualContactSpec contact) {
  set.places.push_back(place);
  set.contacts.push_back(std::move(contact));
}

// --- text ---

FrictionEdges read_edges(NumberReader& numbers, const std::string& what) {
  const int count = numbers.integer(what + ": number of friction edges", 0, max_friction_edges);
  FrictionEdges edges(6, count);
  for (int e = 0; e < count; ++e)
    edges.col(e) =
        edge_in_meters(numbers.numbers(6, fmt::format("{}: friction edge {}", what, e + 1)));
  return edges;
}

/// `repairs`: null to reject numbers < 0, which show that the file has the other layout
double read_mu(NumberReader& numbers, const std::string& what, Repairs* repairs) {
  const double mu = numbers.number(what + ": friction coefficient");
  if (mu < 0 && !repairs)
    numbers.line().fail("{}: friction coefficient: expected >= 0, got {}", what, mu);
  if (!repairs) return mu;
  return repairs->magnitude(mu, numbers.line().place().of(what).of("friction coefficient"));
}

void read_vgr_contact(NumberReader& numbers, int number, const Diagnostics& diagnostics,
                      Repairs& repairs, VirtualContactSet& set) {
  const std::string what = fmt::format("contact {}", number);
  VirtualContactSpec contact;
  const ChainPlace on = read_place([&](const char* name, int min) {
    return numbers.integer(fmt::format("{}: {}", what, name), min, max_chains);
  });
  contact.edges = read_edges(numbers, what);
  StatedPose place;
  place.location = numbers.vector(what + ": location");
  place.rotation = numbers.quaternion(what + ": rotation");
  place.translation = numbers.vector(what + ": translation");
  place.normal = numbers.vector(what + ": normal");
  contact.X_LC = contact_pose(place, numbers.line().place().of(what), diagnostics);
  contact.mu = read_mu(numbers, what, &repairs);
  check_virtual_contact(contact, fmt::format("{}: {}", numbers.line().place(), what));
  add(set, on, std::move(contact));
}

VirtualContactSet read_vgr(const std::string& file, std::string text,
                           const Diagnostics& diagnostics, Repairs& repairs) {
  LineReader lines(file, std::move(text));
  VirtualContactSet set;
  set.robot = lines.next_full("the robot's name").text();
  NumberReader numbers(lines);
  const int count = numbers.integer("number of contacts", 0);
  for (int i = 0; i < count; ++i) read_vgr_contact(numbers, i + 1, diagnostics, repairs, set);
  numbers.finish(diagnostics);
  return set;
}

// --- XML ---

/// The actual number is used, not the declared one.
void check_count(const XmlElement& declared, int given, const char* what, Repairs& repairs) {
  if (const std::string text = declared.text(); parse_integer(text) != given)
    repairs.add("count", declared.place().of(declared.name()),
                "expected {}, as there are as many {}, got {}; those count", given, what,
                in_quotes(text));
}

void read_xml_contact(const XmlElement& e, const Diagnostics& diagnostics, Repairs& repairs,
                      VirtualContactSet& set) {
  e.check({.once = {"finger_number", "link_number", "num_friction_edges", "friction_edges",
                    "location", "rotation", "translation", "normal", "sCof"}},
          diagnostics);
  VirtualContactSpec contact;
  const ChainPlace on = read_place([&](const std::string& name, int min) {
    return e.expected(name + "_number").integer(min, max_chains);
  });
  const XmlElement list = e.expected("friction_edges");
  list.check({.many = {"friction_edge"}}, diagnostics);
  const auto edges = list.children("friction_edge");
  const int count = static_cast<int>(edges.size());
  if (count > max_friction_edges)
    list.fail("expected at most {} friction edges, got {}", max_friction_edges, count);
  if (const XmlElement said = e.child("num_friction_edges"))
    check_count(said, count, "friction edges", repairs);
  contact.edges.resize(6, count);
  for (int i = 0; i < count; ++i)
    contact.edges.col(i) = edge_in_meters(Vector6d(edges[i].numbers(6).data()));

  const XmlElement rotation = e.expected("rotation");
  const auto x = rotation.numbers(4);
  const auto q = made_unit(Eigen::Vector4d(x.data()));
  if (!q)
    rotation.fail("rotation: expected a quaternion of length 1, got ({} {} {} {})", x[0], x[1],
                  x[2], x[3]);
  const StatedPose place{.location = e.expected("location").vector(),
                         .translation = e.expected("translation").vector(),
                         .normal = e.expected("normal").vector(),
                         .rotation = *q};
  contact.X_LC = contact_pose(place, e.place(), diagnostics);
  const XmlElement mu = e.expected("sCof");
  contact.mu = repairs.magnitude(mu.number(), mu.place().of("sCof"));
  check_virtual_contact(contact, e.place().text());
  add(set, on, std::move(contact));
}

VirtualContactSet read_xml(const std::string& name, const std::string& text,
                           const Diagnostics& diagnostics, Repairs& repairs) {
  const XmlFile file(name, text);
  const XmlElement root = file.root();
  if (root.name() != "virtual_contacts")
    root.fail("expected an element <virtual_contacts>, got <{}>", excerpt(root.name()));
  root.check({.once = {"robot_name", "num_contacts"}, .many = {"virtual_contact"}}, diagnostics);
  VirtualContactSet set;
  if (const XmlElement robot = root.child("robot_name")) set.robot = robot.text();
  for (const XmlElement& e : root.children("virtual_contact"))
    read_xml_contact(e, diagnostics, repairs, set);
  if (const XmlElement count = root.child("num_contacts"))
    check_count(count, static_cast<int>(set.contacts.size()), "contacts", repairs);
  return set;
}

// --- writing ---

/// Numbers of a contact as text for both formats.
struct Written {
  explicit Written(const Pose& X_LC, const FrictionEdges& friction) {
    const Eigen::Quaterniond& q = X_LC.rotation;
    rotation = fmt::format("{} {} {} {}", q.w(), q.x(), q.y(), q.z());
    location = listed(X_LC.position / units::millimeter);
    normal = listed(q * Vector3d::UnitZ());
    for (int e = 0; e < friction.cols(); ++e) {
      Vector6d edge = friction.col(e);
      edge.tail<3>() /= units::millimeter;
      edges.push_back(listed(edge));
    }
  }
  std::string rotation, location, normal;
  std::vector<std::string> edges;
};

std::string plain_text(const VirtualContactSet& set) {
  // the first line is the name; it must not look like a comment or contain line ends
  std::string name = set.robot.empty() || set.robot.front() == '#' ? '_' + set.robot : set.robot;
  for (char& c : name)
    if (static_cast<unsigned char>(c) < ' ') c = '_';
  std::string out = fmt::format("{}\n{}\n", name, set.contacts.size());
  for (size_t i = 0; i < set.contacts.size(); ++i) {
    const VirtualContactSpec& contact = set.contacts[i];
    const Written w(contact.X_LC, contact.edges);
    out += fmt::format("{} {}\n{}\n", set.places[i].chain, set.places[i].link, w.edges.size());
    for (const auto& edge : w.edges) out += edge + '\n';
    for (const auto* line : {&w.location, &w.rotation, &w.location, &w.normal}) out += *line + '\n';
    out += fmt::format("{}\n", contact.mu);
  }
  return out;
}

}  // namespace

std::vector<VirtualContactSpec> contacts_on(const RobotSpec& robot, VirtualContactSet set) {
  const auto chains = chains_of(robot);
  for (size_t i = 0; i < set.contacts.size(); ++i) {
    const auto [chain, number] = set.places[i];
    if (chain >= static_cast<int>(chains.size()))
      fail("contact {}: '{}' has no chain {}", i + 1, excerpt(robot.name), chain);
    const auto link = link_at(chains, set.places[i]);
    if (!link)
      fail("contact {}: chain {} of '{}' has no link {}", i + 1, chain, excerpt(robot.name),
           number);
    set.contacts[i].link = *link;
  }
  return std::move(set.contacts);
}

VirtualContactSet contact_set(std::string name, const std::vector<Chain>& chains,
                              std::vector<VirtualContactSpec> contacts) {
  VirtualContactSet set{std::move(name), {}, std::move(contacts)};
  for (const auto& contact : set.contacts) set.places.push_back(place_of(chains, contact.link));
  return set;
}

std::string virtual_contacts_xml(const VirtualContactSet& set) {
  std::string out = fmt::format(
      "<?xml version=\"1.0\"?>\n<virtual_contacts>\n  <robot_name>{}</robot_name>\n  "
      "<num_contacts>{}</num_contacts>\n",
      xml_escaped(set.robot), set.contacts.size());
  const auto add = [&](const char* name, const std::string& text, const char* indent = "    ") {
    out += fmt::format("{}<{}>{}</{}>\n", indent, name, text, name);
  };
  for (size_t i = 0; i < set.contacts.size(); ++i) {
    const VirtualContactSpec& contact = set.contacts[i];
    const Written w(contact.X_LC, contact.edges);
    out += "  <virtual_contact>\n";
    add("finger_number", fmt::format("{}", set.places[i].chain));
    add("link_number", fmt::format("{}", set.places[i].link));
    add("num_friction_edges", fmt::format("{}", w.edges.size()));
    out += "    <friction_edges>\n";
    for (const auto& edge : w.edges) add("friction_edge", edge, "      ");
    out += "    </friction_edges>\n";
    add("location", w.location);
    add("rotation", w.rotation);
    add("translation", w.location);
    add("normal", w.normal);
    add("sCof", fmt::format("{}", contact.mu));
    out += "  </virtual_contact>\n";
  }
  return out + "</virtual_contacts>\n";
}

VirtualContactSet read_virtual_contacts(const fs::path& path, const ReadOptions& options) {
  return of_file([&] {
    std::string text = read_text(path);
    const std::string file = path.filename().string();
    Repairs repairs(options.diagnostics);
    VirtualContactSet set = trim(text).starts_with('<')
                                ? read_xml(file, text, options.diagnostics, repairs)
                                : read_vgr(file, std::move(text), options.diagnostics, repairs);
    repairs.tell();
    return set;
  });
}

std::string virtual_contacts_text(const VirtualContactSet& set, const fs::path& path) {
  const std::string file = path.filename().string();
  for (size_t i = 0; i < set.contacts.size(); ++i)
    check_virtual_contact(set.contacts[i], fmt::format("{}: contact {}", file, i + 1));
  const std::string ending = lower_case(path.extension().string());
  if (ending != ".vgr" && ending != ".xml")
    fail("{}: expected a file of virtual contacts, .vgr or .xml, got {}", file, in_quotes(ending));
  return ending == ".xml" ? virtual_contacts_xml(set) : plain_text(set);
}

void write_virtual_contacts(const VirtualContactSet& set, const fs::path& path) {
  write_file(path, virtual_contacts_text(set, path));
}

// --- contacts on objects ---

static std::vector<ObjectContact> read_list(NumberReader& numbers, bool placed, Repairs* repairs) {
  const int count = numbers.integer("number of contacts", 0);
  std::vector<ObjectContact> contacts;
  for (int i = 0; i < count; ++i) {
    const std::string what = fmt::format("contact {}", i + 1);
    ObjectContact c;
    c.placed = placed;
    c.edges = read_edges(numbers, what);
    c.X_OC.rotation = numbers.quaternion(what + ": rotation");
    if (placed) c.X_OC.position = numbers.vector(what + ": translation") * units::millimeter;
    const Vector3d normal = numbers.vector(what + ": normal");
    const double length = normal.stableNorm();
    if (!(length > 1e-6)) numbers.line().fail("{}: normal: expected a direction, got zero", what);
    c.n_O = normal / length;
    c.mu = read_mu(numbers, what, repairs);
    check_virtual_contact({.X_LC = c.X_OC, .mu = c.mu, .edges = c.edges},
                          fmt::format("{}: {}", numbers.line().place(), what));
    contacts.push_back(std::move(c));
  }
  return contacts;
}

std::vector<ObjectContact> read_object_contacts(const fs::path& path, const ReadOptions& options) {
  return of_file([&] {
    const std::string text = read_text(path), file = path.filename().string();
    // in only one of the two layouts the contacts use up all numbers
    LineReader bare_lines(file, text), lines(file, text);
    NumberReader bare_numbers(bare_lines), numbers(lines);
    try {
      auto contacts = read_list(bare_numbers, false, nullptr);
      if (!bare_numbers.more() && !contacts.empty()) {
        options.diagnostics.warn(Place(file),
                                 "the points of the contacts are left out; they are not placed");
        return contacts;
      }
    } catch (const Error& error) {
      // not this layout; try the other one, and report its errors
      if (error.kind() != ErrorKind::input) throw;
    }
    Repairs repairs(options.diagnostics);
    auto contacts = read_list(numbers, true, &repairs);
    repairs.tell();
    numbers.finish(options.diagnostics);
    return contacts;
  });
}

void write_object_contacts(const std::vector<ObjectContact>& contacts, const fs::path& path) {
  std::string out = fmt::format("{}\n", contacts.size());
  for (size_t i = 0; i < contacts.size(); ++i) {
    const ObjectContact& c = contacts[i];
    const std::string subject = fmt::format("{}: contact {}", path.filename().string(), i + 1);
    if (!c.placed) fail("{}: expected a contact with a point", subject);
    check_virtual_contact({.X_LC = c.X_OC, .mu = c.mu, .edges = c.edges}, subject);
    const Written w(c.X_OC, c.edges);
    out += fmt::format("{}\n", w.edges.size());
    for (const auto& edge : w.edges) out += edge + '\n';
    for (const auto* line : {&w.rotation, &w.location}) out += *line + '\n';
    out += fmt::format("{}\n{}\n", listed(c.n_O), c.mu);
  }
  write_file(path, out);
}

}  // namespace clench
