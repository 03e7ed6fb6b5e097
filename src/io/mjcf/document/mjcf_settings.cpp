#include "clench/io/mjcf/document/mjcf_settings.h"

#include <algorithm>

#include "clench/base/suggest.h"
#include "clench/base/units.h"

namespace clench {

MjcfSettings::MjcfSettings() : angle_unit(units::degree) {}

void MjcfSettings::read(const XmlElement& element, UnusedXml& unused, Repairs& repairs) {
  const XmlValues values(element);
  if (values.has("angle"))
    angle_unit =
        values.word("angle", {"degree", "radian"}, "degree") == "degree" ? units::degree : 1;
  if (values.word("coordinate", {"local", "global"}, "local") == "global")
    values.fail("coordinate",
                "expected local, got 'global'; save the model again with MuJoCo 2.3.3");
  euler = values.text("eulerseq", euler);
  if (euler.size() != 3 || euler.find_first_not_of("xyzXYZ") != std::string::npos)
    values.fail("eulerseq", "expected three of xyzXYZ, got {}", in_quotes(euler));
  autolimits = values.boolean("autolimits", autolimits);
  strip_path = values.boolean("strippath", strip_path);
  mesh_dir = values.text("assetdir", mesh_dir);
  mesh_dir = values.text("meshdir", mesh_dir);
  texture_dir = values.text("texturedir", values.text("assetdir", texture_dir));
  if (values.has("inertiafromgeom")) {
    const std::string word = values.word("inertiafromgeom", {"true", "false", "auto"}, "auto");
    inertia_from_geoms = word == "true"    ? FromGeoms::always
                         : word == "false" ? FromGeoms::never
                                           : FromGeoms::missing;
  }
  if (values.has("inertiagrouprange")) {
    const auto range = values.range("inertiagrouprange", repairs);
    // groups are small integers
    constexpr double far = 1e6;
    for (int i = 0; i < 2; ++i)
      inertia_groups[i] = static_cast<int>(std::clamp(range[i], -far, far));
  }
  min_mass = values.not_negative("boundmass", min_mass, repairs);
  min_inertia = values.not_negative("boundinertia", min_inertia, repairs);
  total_mass = values.number("settotalmass", total_mass);
  balance_inertia = values.boolean("balanceinertia", balance_inertia);
  fit_bounds = values.boolean("fitaabb", fit_bounds);
  unused.attributes(
      element, {"angle", "coordinate", "eulerseq", "autolimits", "strippath", "assetdir", "meshdir",
                "texturedir", "inertiafromgeom", "inertiagrouprange", "boundmass", "boundinertia",
                "settotalmass", "balanceinertia", "fitaabb"});
}

}  // namespace clench
