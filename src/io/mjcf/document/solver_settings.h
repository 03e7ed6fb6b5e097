// Settings of MuJoCo's solver in scenes written by Clench. Contacts of a World are rigid and have
// no such settings, so readers accept these values and report all others.
#pragma once
#include <optional>
#include <string>

#include "clench/io/mjcf/document/mjcf_document.h"

namespace clench {

inline constexpr const char* written_cone = "elliptic";
inline constexpr const char* written_impratio = "10";
inline constexpr const char* written_integrator = "implicit";
inline constexpr const char* written_solimp = "0.95 0.99 0.0001";
/// solref of contacts: as stiff as the time step [s] allows
std::string written_solref(double time_step);

/// True if an attribute of an <option>, <size>, <geom> or <pair> has the value that is written
/// here, or only limits the memory of MuJoCo.
/// time_step  of the file, 0 if it gives none [s]
bool is_written_setting(const XmlElement& element, const std::string& attribute, double time_step);

/// Prevents the document from reporting these settings as unused.
void accept_written_settings(MjcfDocument& document);

/// The contact threshold [m] that a written scene stores as the margin of its geoms; empty for
/// other scenes.
std::optional<double> written_threshold(const MjcfDocument& document);

}  // namespace clench
