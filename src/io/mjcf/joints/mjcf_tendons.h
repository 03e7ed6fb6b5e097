// Fixed tendons of MJCF: weighted sums of joints, their limits, springs and friction.
#pragma once
#include "clench/io/mjcf/document/mjcf_document.h"
#include "clench/io/tree/tree_model.h"

namespace clench {

struct MjcfTendon {
  XmlValues values;
  std::string name;
  /// indices of joints in the tree, with coefficients other than 0
  std::vector<std::pair<int, double>> joints = {};
  bool complete = true;    ///< true if all its joints are in this robot
  bool elsewhere = false;  ///< true if some are in another robot
  bool spatial = false;
  std::optional<std::array<double, 2>> force_range = {};  ///< sum over all its actuators

  /// "hand.xml:31: tendon 'split'", for messages
  Place subject() const;
};

/// Attributes of a fixed tendon, with the defaults of its class.
/// throws  Error for an invalid number or word
MjcfTendon read_mjcf_tendon(MjcfDocument& document, const XmlElement& element);

/// Adds the tendon's limits, springs, damping and friction, in terms of leading joints; call it
/// after all couplings are known. The range of a tendon with a single leading joint becomes that
/// joint's range.
void add_tendon_dynamics(const MjcfTendon& tendon, MjcfDocument& document, const FileCache& cache,
                         TreeModel& tree);

/// The first coefficient of a force given as a polynomial of velocity or length; a warning names
/// the others unless they are 0.
double linear_part(const XmlValues& values, const char* name, const Place& subject,
                   MjcfDocument& document, const FileCache& cache);

}  // namespace clench
