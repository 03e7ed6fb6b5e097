// What the text robots and the XML robots of the original say alike: chains of joints after
// Denavit and Hartenberg, which become links of a tree, and DOFs, in units that depend on joints.
#pragma once
#include <functional>

#include "clench/base/diagnostic.h"
#include "clench/io/text/joint_expression.h"
#include "clench/spec/chains.h"

namespace clench {

/// The classes that robots name mean nothing to us, but a word that is none is a mistake: which is
/// warned of. `place` begins the sentence:
/// "hand.cfg:1: robot: unknown type 'Hnad' has no meaning; did you mean 'Hand'?"
void check_class(const std::string& name, const Place& place, const Diagnostics& diagnostics);

/// By the letter r, b or c.   `subject`  begins the error: "Barrett.cfg:4: DOF 0"
DofKind dof_kind(std::string_view letter, const std::string& subject);

/// A DOF whose numbers are as written, in SI.   `slides`  is its first joint prismatic?
DofSpec in_si(DofSpec dof, bool slides);

/// How a joint of a robot of so many DOFs moves.   `subject`  begins errors: "hand.xml:31: joint 2"
/// throws Error "...: expected a joint expression such as d0*0.5+90 for theta, got 'x'"
JointExpression expected_expression(std::string_view text, JointKind kind, size_t dofs,
                                    const std::string& subject);

/// Constant parts of the four numbers of a joint. Frame after it = frame before * Rz(theta) Tz(d)
/// Tx(a) Rx(alpha), with q added to theta (revolute) or d (prismatic).
/// source  Denavit & Hartenberg (1955), distal
struct DenavitHartenberg {
  double theta = 0, d = 0, a = 0, alpha = 0;  ///< as written [degree, mm, mm, degree]
};

/// Number of joints that the dynamics of the original give a link of a kind: Revolute, Prismatic,
/// Universal, Ball, Fixed.
/// throws Error "expected Revolute, Prismatic, Universal, Ball or Fixed, got 'Revolut'; did you
/// mean 'Revolute'?"
int joints_of_kind(std::string_view word);

/// Of each DOF that of its first joint, in whose unit it counts: rad or mm.
using DofKinds = std::vector<std::optional<JointKind>>;

/// Joints and links of one chain, as they come.
class ChainLinks {
 public:
  ChainLinks(const Pose& X_BC, DofKinds& dof_kinds) : dof_kinds_(dof_kinds), at_(X_BC) {}
  /// The numbers of the joint are as written, too.
  /// throws Error "joint 2: theta: expected a number from -1e+09 to 1e+09 [rad], got 1e+20"
  void add_joint(JointSpec joint, const DenavitHartenberg& written);
  int joints() const { return static_cast<int>(joints_.size()); }
  int last_joint() const { return used_ - 1; }  ///< that moves the last link; -1: none
  /// The next link: all joints up to `last_joint` move it, which is not before those of the link
  /// before.
  void add_link(const BodySpec& body, int last_joint, RobotSpec& robot);

 private:
  DofKinds& dof_kinds_;
  std::vector<JointSpec> joints_;
  std::vector<Pose> after_;  // of each joint, at q = 0, in its own frame
  Pose at_;                  // from the last link, or the base, to the next joint
  int used_ = 0;             // joints that have their link
  int parent_ = -1;
};

}  // namespace clench
