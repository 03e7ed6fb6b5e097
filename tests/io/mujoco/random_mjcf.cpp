#include "random_mjcf.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "clench/base/random.h"

namespace clench::test {

namespace {

/// Text of an element with its attributes and children.
class Element {
 public:
  explicit Element(std::string name) : name_(std::move(name)) {}
  Element& set(const std::string& key, const std::string& value) {
    attributes_ += fmt::format(" {}=\"{}\"", key, value);
    return *this;
  }
  Element& add(const Element& child) {
    children_ += child.text();
    return *this;
  }
  std::string text() const {
    return children_.empty()
               ? fmt::format("<{}{}/>\n", name_, attributes_)
               : fmt::format("<{}{}>\n{}</{}>\n", name_, attributes_, children_, name_);
  }

 private:
  std::string name_, attributes_, children_;
};

class Generator {
 public:
  explicit Generator(uint64_t seed) : random_(seed) {}

  std::string model() {
    Element root("mujoco");
    root.add(compiler()).add(classes()).add(assets());
    Element world("worldbody");
    for (int i = 0, n = integer(1, 3); i < n; ++i) world.add(body(0));
    if (chance(0.3)) world.add(geom(true));
    return root.add(world).text();
  }

 private:
  static constexpr const char* joint_types[] = {"hinge", "slide", "ball"};

  bool chance(double p) { return random_.uniform() < p; }
  int integer(int low, int high) {
    return low + static_cast<int>(random_.uniform() * (high - low + 1));
  }
  double number(double low, double high) {
    return std::round(random_.uniform(low, high) * 1e4) / 1e4;
  }
  std::string numbers(int count, double low, double high) {
    std::string out;
    for (int i = 0; i < count; ++i) out += fmt::format("{}{}", i ? " " : "", number(low, high));
    return out;
  }
  std::string angle(double low, double high) {  // given in radians
    const double x = random_.uniform(low, high);
    return fmt::format("{:.6g}", radian_ ? x : x * 180 / std::numbers::pi);
  }
  template <class List>
  std::string one_of(const List& list) {
    return std::string(list[integer(0, static_cast<int>(std::size(list)) - 1)]);
  }

  Element compiler() {
    Element out("compiler");
    radian_ = chance(0.5);
    if (radian_ || chance(0.5)) out.set("angle", radian_ ? "radian" : "degree");
    if (chance(0.5)) {
      constexpr std::string_view letters[] = {"x", "y", "z", "X", "Y", "Z"};
      out.set("eulerseq", one_of(letters) + one_of(letters) + one_of(letters));
    }
    if (chance(0.3)) out.set("inertiafromgeom", chance(0.5) ? "true" : "auto");
    if (chance(0.3)) out.set("inertiagrouprange", chance(0.5) ? "0 1" : "1 5");
    if (chance(0.2)) out.set("boundmass", "0.5");
    if (chance(0.2)) out.set("boundinertia", "0.01");
    if (chance(0.2)) out.set("settotalmass", "7");
    autolimits_ = chance(0.7);
    return out.set("autolimits", autolimits_ ? "true" : "false").set("coordinate", "local");
  }

  Element class_of(const std::string& name) {
    Element out("default");
    if (!name.empty()) out.set("class", name);
    if (chance(0.7)) {
      Element joint("joint");
      if (chance(0.5)) joint.set("damping", numbers(1, 0, 2));
      if (chance(0.5)) joint.set("armature", numbers(1, 0, 0.1));
      if (chance(0.3)) joint.set("axis", numbers(3, 0.1, 1));
      if (chance(0.3)) joint.set("frictionloss", numbers(1, 0, 0.1));
      if (chance(0.3)) joint.set("stiffness", numbers(1, 0, 5));
      out.add(joint);
    }
    if (chance(0.7)) {
      Element geom("geom");
      if (chance(0.3)) geom.set("type", chance(0.5) ? "capsule" : "sphere");
      if (chance(0.5)) geom.set("density", numbers(1, 100, 3000));
      if (chance(0.5)) geom.set("size", numbers(2, 0.02, 0.2));
      if (chance(0.3)) geom.set("quat", numbers(4, 0.1, 1));
      if (chance(0.3)) geom.set("pos", numbers(3, -0.2, 0.2));
      if (chance(0.2)) geom.set("mass", numbers(1, 0.1, 2));
      out.add(geom);
    }
    return out;
  }

  Element classes() {
    Element main = class_of(chance(0.5) ? "main" : "");
    Element a = class_of("a");
    a.add(class_of("b"));
    return main.add(a).add(class_of("c")).add(Element("default").set("class", "plain"));
  }

  Element assets() {
    Element out("asset");
    for (const char* name : {"m0", "m1"}) {
      Element mesh("mesh");
      mesh.set("name", name).set("vertex", numbers(3 * integer(6, 12), -0.3, 0.3));
      if (chance(0.5)) mesh.set("scale", (chance(0.3) ? "-" : "") + numbers(3, 0.3, 2));
      if (chance(0.5)) mesh.set("refpos", numbers(3, -0.2, 0.2));
      if (chance(0.5)) mesh.set("refquat", numbers(4, 0.1, 1));
      out.add(mesh);
    }
    return out;
  }

  void orient(Element& element, double p) {
    if (!chance(p)) return;
    switch (integer(0, 4)) {
      case 0:
        element.set("quat", numbers(4, -1, 1));
        break;
      case 1:
        element.set("axisangle", numbers(3, -1, 1) + ' ' + angle(-3, 3));
        break;
      case 2:
        element.set("euler", angle(-3, 3) + ' ' + angle(-3, 3) + ' ' + angle(-3, 3));
        break;
      case 3:
        element.set("xyaxes", numbers(3, 0.2, 1) + ' ' + numbers(3, -1, -0.2));
        break;
      default:
        element.set("zaxis", chance(0.2) ? "0 0 -1" : numbers(3, -1, 1));
    }
  }
  void place(Element& element, double p) {
    if (chance(p)) element.set("pos", numbers(3, -0.5, 0.5));
    orient(element, p);
  }
  void choose_class(Element& element, double p) {
    constexpr std::string_view names[] = {"a", "b", "c", "main"};
    if (chance(p)) element.set("class", one_of(names));
  }

  /// first  the group of the geom is in all ranges of groups
  Element geom(bool of_world = false, bool first = false) {
    constexpr std::string_view types[] = {"sphere",    "capsule", "cylinder",
                                          "ellipsoid", "box",     "mesh"};
    Element out("geom");
    choose_class(out, 0.3);
    const std::string type = one_of(types);
    out.set("type", type);
    bool placed = false;
    if (type == "mesh") {
      out.set("mesh", chance(0.5) ? "m0" : "m1");
    } else if (type != "sphere" && chance(0.3)) {
      // MuJoCo 2.2.2 rejects a position given together with it, which a class may contain
      out = Element("geom");
      out.set("class", "plain").set("type", type);
      out.set("fromto", numbers(3, -0.5, 0) + ' ' + numbers(3, 0.1, 0.5));
      out.set("size", numbers(1, 0.02, 0.2));
      placed = true;
    } else {
      out.set("size", numbers(3, 0.02, 0.3));
    }
    if (!placed) place(out, 0.6);
    if (chance(0.3)) out.set("mass", numbers(1, 0.1, 3));
    if (chance(0.3)) out.set("density", numbers(1, 100, 3000));
    if (first)
      out.set("group", "1");
    else if (chance(0.3))
      out.set("group", std::to_string(integer(0, of_world ? 2 : 4)));
    if (chance(0.2)) out.set("contype", "0").set("conaffinity", "0");
    return out;
  }

  Element inertial() {
    Element out("inertial");
    out.set("pos", numbers(3, -0.2, 0.2)).set("mass", numbers(1, 0.1, 3));
    if (chance(0.5)) {
      orient(out, 0.5);
      return out.set("diaginertia", numbers(3, 0.02, 0.03));
    }
    // diagonally dominant
    return out.set("fullinertia", numbers(3, 0.02, 0.025) + ' ' + numbers(3, -0.001, 0.001));
  }

  Element joint(const std::string& type) {
    Element out("joint");
    choose_class(out, 0.4);
    out.set("name", fmt::format("j{}", joints_++));
    if (type != "hinge" || chance(0.5)) out.set("type", type);
    if (chance(0.6)) out.set("axis", numbers(3, -1, 1));
    if (chance(0.6)) out.set("pos", numbers(3, -0.3, 0.3));
    const bool turns = type != "slide";
    if (type != "ball" && chance(0.6)) {
      out.set("range", turns ? angle(-2, -0.1) + ' ' + angle(0.6, 2)
                             : numbers(1, -0.5, -0.1) + ' ' + numbers(1, 0.6, 1));
      if (!autolimits_)
        out.set("limited", chance(0.8) ? "true" : "false");
      else if (chance(0.2))
        out.set("limited", chance(0.5) ? "true" : "false");
    }
    if (type != "ball" && chance(0.3)) out.set("ref", turns ? angle(0, 0.5) : numbers(1, 0, 0.5));
    if (chance(0.3)) out.set("stiffness", numbers(1, 0, 5));
    if (type != "ball" && chance(0.3))
      out.set("springref", turns ? angle(-1, 1) : numbers(1, -0.5, 0.5));
    if (chance(0.3)) out.set("damping", numbers(1, 0, 2));
    if (chance(0.3)) out.set("armature", numbers(1, 0, 0.1));
    if (chance(0.3)) out.set("frictionloss", numbers(1, 0, 0.1));
    return out;
  }

  Element body(int depth) {
    Element out("body");
    if (chance(0.8)) out.set("name", fmt::format("b{}", bodies_));
    ++bodies_;
    place(out, 0.8);
    constexpr std::string_view names[] = {"a", "b", "c"};
    if (chance(0.2)) out.set("childclass", one_of(names));
    if (depth == 0 && chance(0.3)) {
      if (chance(0.5))
        out.add(Element("freejoint"));
      else
        out.add(Element("joint").set("type", "free").set("class", "plain"));
    } else if (chance(depth == 0 ? 0.3 : 0.7)) {
      for (int i = 0, n = integer(1, 2); i < n; ++i) {
        // rotations cannot follow a ball joint
        const std::string type =
            i == 0 && n == 1 ? one_of(joint_types) : joint_types[integer(0, 1)];
        out.add(joint(type));
      }
    }
    if (chance(0.3)) out.add(inertial());
    out.add(geom(false, true).set("name", fmt::format("g{}", bodies_)));
    for (int i = 0, n = integer(0, 2); i < n; ++i) out.add(geom());
    for (int i = 0, n = depth < 3 ? integer(0, 2) : 0; i < n; ++i) out.add(body(depth + 1));
    return out;
  }

  Random random_;
  bool radian_ = false, autolimits_ = true;
  int bodies_ = 0, joints_ = 0;
};

}  // namespace

std::string random_mjcf(uint64_t seed) { return Generator(seed).model(); }

}  // namespace clench::test
