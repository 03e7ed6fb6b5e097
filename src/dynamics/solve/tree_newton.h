// Newton's method for contacts with friction in the coordinates of trees of bodies: its systems
// have one unknown per coordinate, and are as sparse as the contacts.
#pragma once
#include "clench/dynamics/solve/natural_map.h"
#include "clench/dynamics/solve/tree_friction.h"
#include "clench/math/block_lu.h"

namespace clench {

/// Takes the steps of FrictionNewton, but eliminates the impulses instead of the velocities. Given
/// the states of all blocks, the impulses of a block follow from the velocities of its rows,
/// dr = change - G Y^T dz; the motion of the trees solves (1 + Y G Y^T) dz = Y change.
///
/// source  Alart & Curnier (1991), A mixed formulation for frictional contact problems prone to
///         Newton like solution methods; Rockafellar (1976), Monotone operators and the proximal
///         point algorithm, for the damping
class TreeNewton {
 public:
  struct End {
    bool converged = false;
    int iterations = 0;
  };
  /// Damping towards a center: the velocities of rows gain damping * weight * (r - center).
  struct Pull {
    double damping = 0;
    const Eigen::VectorXd& center;
    double rho = 1;  ///< the natural map's weight of velocities, by which states are chosen
  };
  /// Lays out the systems of a problem; to be called before solve() and refine().
  void set(const TreeFriction& problem);
  /// Solves a damped problem, or reduces the norm of its natural map to `enough` times that at r.
  /// r  in: initial impulses; out: the result, or the best impulses found if it does not converge
  End solve(const TreeFriction& problem, const Pull& pull, double enough, int max_iterations,
            Eigen::VectorXd& r);
  /// One step from r towards a solution of the undamped problem.
  /// damping  regularizes the step, > 0
  /// returns  false: the system is singular
  bool refine(const TreeFriction& problem, double damping, Eigen::VectorXd& r);

 private:
  using State = BlockState;
  struct Law {  // of one block: dr = change - G Y^T dz; G by columns
    double G[16];
    double change[4];
  };
  double classify(const TreeFriction& problem, const Eigen::VectorXd& r, const Eigen::VectorXd& u,
                  double rho);
  void find_law(const TreeFriction::Block& block, size_t number, double damping, const double* r,
                const double* u, Law& law) const;
  void find_sliding_law(const TreeFriction::Block& block, size_t number, double by, const double* r,
                        const double* u, Law& law) const;
  void add_to_system(const TreeFriction& problem, const TreeFriction::Block& block, size_t number);
  bool step(const TreeFriction& problem, double damping, const Eigen::VectorXd& r,
            const Eigen::VectorXd& u, Eigen::VectorXd& next);
  double visit(const TreeFriction& problem, const Pull& pull, const Eigen::VectorXd& r,
               Eigen::VectorXd& u);
  double shorten(const TreeFriction& problem, const Pull& pull, double energy, double next_energy,
                 const Eigen::VectorXd& r);
  bool slides() const;

  double rho_ = 1;
  std::vector<State> states_;
  // four per block that slides: friction over the norm of the tangential part, and its direction
  std::vector<double> slide_;
  std::vector<Law> laws_;
  std::vector<std::array<int, 4>> places_;  // by block: its four blocks of the system; -1: none
  BlockLu system_;
  Eigen::VectorXd motion_, u_, next_, u_next_, full_, best_;
};

}  // namespace clench
