// Parts shared by GraspIt!'s text and XML robots: chains of Denavit-Hartenberg joints, which become
// links of a tree, and DOFs, whose units depend on their joints.
#pragma once
#include <functional>

#include "clench/base/diagnostic.h"
#include "clench/io/text/joint_expression.h"
#include "clench/spec/chains.h"

namespace clench {

/// Robot classes are ignored, but unknown names are probably mistakes, and reported as a warning
/// that begins with `place`:
/// "hand.cfg:1: robot: unknown type 'Hnad' has no meaning; did you mean 'Hand'?"
void check_class(const std::string& name, const Place& place, const Diagnostics& diagnostics);

/// DOF kind by the letter r, b or c.   subject  begins the error: "Barrett.cfg:4: DOF 0"
DofKind dof_kind(std::string_view letter, const std::string& subject);

/// Converts the numbers of a DOF from the file's units to SI.   slides  true if its first joint is
/// prismatic
DofSpec in_si(DofSpec dof, bool slides);

/// Parses the expression of a joint in a robot with that number of DOFs.   subject  begins errors:
/// "hand.xml:31: joint 2"
/// throws Error "...: expected a joint expression such as d0*0.5+90 for theta, got 'x'"
JointExpression expected_expression(std::string_view text, JointKind kind, size_t dofs,
                                    const std::string& subject);

/// Constant parts of the four parameters of a joint. Frame after it = frame before * Rz(theta)
/// Tz(d) Tx(a) Rx(alpha), with q added to theta (revolute) or d (prismatic).
/// source  Denavit & Hartenberg (1955), distal
struct DenavitHartenberg {
  double theta = 0, d = 0, a = 0, alpha = 0;  ///< as written [degree, mm, mm, degree]
};

/// Number of joints that move a link of the given type in the dynamics of GraspIt!: Revolute,
/// Prismatic, Universal, Ball, Fixed.
/// throws Error "expected Revolute, Prismatic, Universal, Ball or Fixed, got 'Revolut'; did you
/// mean 'Revolute'?"
int joints_of_kind(std::string_view word);

/// For each DOF the kind of its first joint, which determines its unit: rad or mm.
using DofKinds = std::vector<std::optional<JointKind>>;

/// Builds the joints and links of one chain in the order of the file.
class ChainLinks {
 public:
  ChainLinks(const Pose& X_BC, DofKinds& dof_kinds) : dof_kinds_(dof_kinds), at_(X_BC) {}
  /// The numbers of the joint are in the file's units, too.
  /// throws Error "joint 2: theta: expected a number from -1e+09 to 1e+09 [rad], got 1e+20"
  void add_joint(JointSpec joint, const DenavitHartenberg& written);
  int joints() const { return static_cast<int>(joints_.size()); }
  int last_joint() const { return used_ - 1; }  ///< moves the last link; -1: none
  /// Adds the next link, which is moved by all joints up to `last_joint`. This must not be less
  /// than for the link before.
  void add_link(const BodySpec& body, int last_joint, RobotSpec& robot);

 private:
  DofKinds& dof_kinds_;
  std::vector<JointSpec> joints_;
  std::vector<Pose> after_;  // per joint, at q = 0, in the joint's frame
  Pose at_;                  // from the last link, or the base, to the next joint
  int used_ = 0;             // joints assigned to links so far
  int parent_ = -1;
};

}  // namespace clench
