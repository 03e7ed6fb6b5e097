#include "clench/io/graspit/tendons_xml.h"

#include <algorithm>

#include "clench/base/suggest.h"
#include "clench/base/units.h"

namespace clench {

namespace {

/// A direction as a unit vector.
Eigen::Vector3d direction(const XmlElement& element) {
  const Eigen::Vector3d v = element.vector();
  const double length = v.stableNorm();
  if (!(length > 1e-9) || !std::isfinite(length))
    element.fail("{}: expected a direction, got ({}, {}, {})", element.name(), v.x(), v.y(), v.z());
  return v / length;
}

double not_negative(const XmlElement& element, Repairs& repairs) {
  return repairs.magnitude(element.number(), element.place().of(element.name()));
}

/// <chain> and <link>, both -1 for the base.
int link_of(const XmlElement& element, const FindLink& find) {
  const int chain = element.expected("chain").integer(-1);
  return find(element, {chain, element.expected("link").integer(-1)});
}

double friction_of(const XmlElement& element, Repairs& repairs) {
  const XmlElement friction = element.child("friction");
  return friction ? not_negative(friction, repairs) : 0;
}

/// A length in meters; GraspIt! writes -1 for none.
std::optional<double> length_of(const XmlElement& element, const char* name, Repairs& repairs) {
  const XmlElement child = element.child(name);
  if (!child) return {};
  const double value = child.number();
  if (value == -1) return {};
  return not_negative(child, repairs) * units::millimeter;
}

TendonSpec read_tendon(const XmlElement& element, const FindLink& find,
                       const Diagnostics& diagnostics, Repairs& repairs) {
  element.check({.once = {"stiffness", "restLength", "preTensionLength"},
                 .many = {"insertionPoint"},
                 .attributes = {"name"}},
                diagnostics);
  TendonSpec tendon;
  tendon.name = element.expected_attribute("name");
  if (const XmlElement stiffness = element.child("stiffness"))
    tendon.stiffness = not_negative(stiffness, repairs) * units::newton_per_millimeter;
  tendon.rest_length = length_of(element, "restLength", repairs);
  tendon.pre_tension_length = length_of(element, "preTensionLength", repairs);
  for (const XmlElement& e : element.children("insertionPoint")) {
    e.check({.once = {"chain", "link", "position", "friction"}}, diagnostics);
    TendonPoint point;
    point.link = link_of(e, find);
    point.p_L = e.expected("position").vector() * units::millimeter;
    point.friction = friction_of(e, repairs);
    tendon.points.push_back(point);
  }
  if (tendon.points.size() < 2)
    element.fail("tendon: expected at least 2 insertion points, got {}", tendon.points.size());
  return tendon;
}

TendonWrapper read_wrapper(const XmlElement& element, const FindLink& find,
                           const Diagnostics& diagnostics, Repairs& repairs) {
  element.check(
      {.once = {"chain", "link", "friction", "position", "orientation", "radius", "length"},
       .many = {"exemption", "wrapping_side"}},
      diagnostics);
  TendonWrapper wrapper;
  wrapper.link = link_of(element, find);
  wrapper.friction = friction_of(element, repairs);
  wrapper.p_L = element.expected("position").vector() * units::millimeter;
  wrapper.axis_L = direction(element.expected("orientation"));
  wrapper.radius = not_negative(element.expected("radius"), repairs) * units::millimeter;
  if (const XmlElement length = element.child("length"))
    wrapper.length = not_negative(length, repairs) * units::millimeter;
  for (const XmlElement& e : element.children("exemption")) {
    e.check({.attributes = {"tendon"}}, diagnostics);
    wrapper.exempt.push_back(e.expected_attribute("tendon"));
  }
  for (const XmlElement& e : element.children("wrapping_side")) {
    e.check({.once = {"orientation"}, .attributes = {"tendon"}}, diagnostics);
    wrapper.sides.push_back({e.expected_attribute("tendon"), direction(e.expected("orientation"))});
  }
  return wrapper;
}

/// Warns of unknown tendons named by wrappers.
void check_names(const std::vector<XmlElement>& wrappers, const std::vector<TendonSpec>& tendons,
                 const Diagnostics& diagnostics) {
  std::vector<std::string> names;
  for (const TendonSpec& tendon : tendons) names.push_back(tendon.name);
  for (const XmlElement& wrapper : wrappers)
    for (const char* kind : {"exemption", "wrapping_side"})
      for (const XmlElement& e : wrapper.children(kind))
        if (const std::string name = e.expected_attribute("tendon");
            std::ranges::find(names, name) == names.end())
          diagnostics.warn(e.place().of(kind), "there is no tendon {}{}", in_quotes(name),
                           did_you_mean(name, names));
}

}  // namespace

void read_tendons(const XmlElement& robot, const FindLink& find, const Diagnostics& diagnostics,
                  Repairs& repairs, RobotSpec& out) {
  const auto tendons = robot.children("tendon"), wrappers = robot.children("tendonWrapper");
  for (const XmlElement& e : tendons)
    out.tendons.push_back(read_tendon(e, find, diagnostics, repairs));
  for (const XmlElement& e : wrappers)
    out.wrappers.push_back(read_wrapper(e, find, diagnostics, repairs));
  if (diagnostics) check_names(wrappers, out.tendons, diagnostics);
  if (diagnostics && !(tendons.empty() && wrappers.empty()))
    diagnostics.warn((tendons.empty() ? wrappers : tendons).front().place(),
                     "tendons and their wrappers are kept, {} and {}, but have no effect",
                     tendons.size(), wrappers.size());
}

void read_tactile(const XmlElement& chain, int number, const FindLink& find,
                  const Diagnostics& diagnostics, Repairs& repairs, RobotSpec& out) {
  for (const XmlElement& e : chain.children("filter")) {
    e.check({.attributes = {"params"}}, diagnostics);
    TactileSpec sensor;
    sensor.link = find(e, {number, e.integer(0)});
    const std::string params = e.expected_attribute("params");
    const auto words = split_words(params, ",", 7);
    double x[6];
    for (size_t i = 0; i < 6; ++i) {
      const auto value = i < words.size() ? parse_number(words[i]) : std::nullopt;
      if (!value || words.size() != 6)
        e.fail("filter: params: expected 6 numbers x0,y0,z0,x1,y1,z1, got {}", in_quotes(params));
      x[i] = *value * units::millimeter;
    }
    sensor.low_L = Eigen::Vector3d(x[0], x[1], x[2]);
    sensor.high_L = Eigen::Vector3d(x[3], x[4], x[5]);
    if ((sensor.low_L.array() > sensor.high_L.array()).any()) {
      repairs.add("corners", e.place().of("filter"), "params: the corners {} are put in order",
                  in_quotes(params));
      const Eigen::Vector3d low = sensor.low_L.cwiseMin(sensor.high_L);
      sensor.high_L = sensor.low_L.cwiseMax(sensor.high_L);
      sensor.low_L = low;
    }
    out.tactile.push_back(sensor);
  }
}

}  // namespace clench
