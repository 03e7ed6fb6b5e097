#include "clench/io/mjcf/document/mjcf_options.h"

#include <set>

#include "clench/base/text.h"

namespace clench {

/// Reads the switches of the simulation, and warns of those that would change its results here.
/// returns  true if gravity is on
static bool read_flags(const XmlElement& element, const FileCache& cache, WorldSpec& world) {
  // off by default
  const std::set<std::string> enabled = {"override", "energy",    "fwdinv", "invdiscrete",
                                         "sleep",    "diagexact", "ipc",    "sensornoise"};
  // options of MuJoCo's solver, or of outputs other than the motion
  const std::set<std::string> harmless = {"warmstart", "refsafe",   "sensor",     "sensornoise",
                                          "midphase",  "eulerdamp", "autoreset",  "nativeccd",
                                          "island",    "multiccd",  "energy",     "fwdinv",
                                          "sleep",     "diagexact", "invdiscrete"};
  const XmlValues flags(element);
  bool gravity = true;
  std::vector<std::string> lost, idle;
  for (const std::string& name : element.attributes()) {
    const bool usual = !enabled.contains(name);
    const bool on = flags.word(name.c_str(), {"enable", "disable"}, "enable") == "enable";
    if (on == usual) continue;
    if (name == "gravity") gravity = false;
    if (name == "contact" || name == "constraint") world.collision_on = false;
    // actuation is read with the actuators
    if (name == "gravity" || name == "contact" || name == "filterparent" || name == "actuation")
      continue;
    if (harmless.contains(name))
      idle.push_back(name);
    else
      lost.push_back(fmt::format("{}=\"{}\"", excerpt(name), on ? "enable" : "disable"));
  }
  if (!world.collision_on)
    cache.diagnostics().note(element.place().of("flag"),
                             "the file disables contacts; nothing collides");
  if (!idle.empty())
    cache.diagnostics().note(element.place().of("flag"),
                             "settings of MuJoCo's solver are not used: {}", name_list(idle));
  if (!lost.empty())
    cache.diagnostics().warn(element.place().of("flag"), "not used: {}", name_list(lost));
  return gravity;
}

void read_mjcf_options(MjcfDocument& document, const FileCache& cache, WorldSpec& world) {
  world.gravity = Eigen::Vector3d(0, 0, -9.81);  // default of MuJoCo
  bool gravity_on = true;
  for (const MjcfNode& node : document.root().children) {
    if (node.name() != "option") continue;
    const XmlValues values(node.element);
    document.unused().attributes(node.element, {"gravity", "timestep", "actuatorgroupdisable"});
    if (values.has("timestep")) {
      world.time_step = values.number("timestep", 0);
      if (const auto wrong = fault(time_step_rule, *world.time_step); !wrong.empty())
        values.fail("timestep", "{}", wrong);
    }
    for (const MjcfNode& child : node.children)
      if (child.name() == "flag")
        gravity_on = read_flags(child.element, cache, world) && gravity_on;
      else
        document.unused().element(child.element);
    if (!values.has("gravity")) continue;
    const Eigen::Vector3d gravity = values.vec3("gravity", {0, 0, 0});
    for (const double x : gravity)
      if (const auto wrong = fault(gravity_rule, x); !wrong.empty())
        values.fail("gravity", "{}", wrong);
    world.gravity = gravity;
  }
  if (!gravity_on) world.gravity = Eigen::Vector3d::Zero();
}

}  // namespace clench
