// Settings of MuJoCo's solver in the scenes that are written here. Contacts of a World are rigid and
// have no such settings, so a reader accepts these values, and reports all others.
#pragma once
#include <optional>
#include <string>

#include "clench/io/mjcf/mjcf_document.h"

namespace clench {

inline constexpr const char* written_cone = "elliptic";
inline constexpr const char* written_impratio = "10";
inline constexpr const char* written_integrator = "implicit";
inline constexpr const char* written_solimp = "0.95 0.99 0.0001";
/// solref of contacts: as stiff as the time step [s] allows
std::string written_solref(double time_step);

/// Has an attribute of an <option>, <size>, <geom> or <pair> the value that is written here, or
/// does it set no more than how much memory MuJoCo takes?
/// time_step  of the file, 0 if it gives none [s]
bool is_written_setting(const XmlElement& element, const std::string& attribute, double time_step);

/// Makes the document report no settings as unused that are written here.
void accept_written_settings(MjcfDocument& document);

/// The contact threshold [m] that a written scene keeps as the margin of its geoms; none in others.
std::optional<double> written_threshold(const MjcfDocument& document);

}  // namespace clench
