// Fixed tendons of MJCF: weighted sums of joints, their limits, springs and friction.
#pragma once
#include "clench/io/mjcf/mjcf_document.h"
#include "clench/io/tree/tree_model.h"

namespace clench {

struct MjcfTendon {
  XmlValues values;
  std::string name;
  std::vector<std::pair<int, double>> joints = {};  ///< of the tree, and coefficients, none 0
  bool complete = true;                             ///< are all its joints of this robot?
  bool elsewhere = false;                           ///< are some of another robot?
  bool spatial = false;
  std::optional<std::array<double, 2>> force_range = {};  ///< of all its actuators together

  /// "hand.xml:31: tendon 'split'", for sentences
  std::string subject() const;
};

/// Attributes of a fixed tendon, with the defaults of its class.
/// throws  Error for a number or word that is none
MjcfTendon read_mjcf_tendon(MjcfDocument& document, const XmlElement& element);

/// What the tendon does beside carrying the force of its actuators, in terms of the joints that
/// lead; ties are final. A range of a single leading joint becomes a range of that joint.
void add_tendon_dynamics(const MjcfTendon& tendon, MjcfDocument& document, const FileCache& cache,
                         TreeModel& tree);

/// The first of the coefficients of a force that is a polynomial of velocity or length; a warning
/// names the others unless they are 0.
double linear_part(const XmlValues& values, const char* name, const std::string& subject,
                   MjcfDocument& document, const FileCache& cache);

}  // namespace clench
