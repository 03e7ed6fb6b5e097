// Newton's method for contacts with friction: determines which contacts are open, stick or slide,
// and their impulses.
#pragma once
#include <Eigen/Core>
#include <vector>

#include "clench/base/progress.h"
#include "clench/dynamics/solve/natural_map.h"
#include "clench/dynamics/solve/scaled_friction.h"
#include "clench/math/decompositions.h"

namespace clench {

/// Solves a scaled problem with `damping * weights` added to the diagonal of S, so that the load of
/// redundant contacts is shared uniquely. Given which blocks are open, sticking or sliding (and in
/// which direction), at a bound or between bounds, all impulses follow from one linear system of
/// the free rows; they determine the next state of each block.
///
/// source  Alart & Curnier (1991), A mixed formulation for frictional contact problems prone to
///         Newton like solution methods
class FrictionNewton {
 public:
  struct End {
    bool converged = false;
    int iterations = 0;
  };
  /// q    replaces the problem's
  /// rho  the natural map's weight of velocities, by which states are chosen; one value may
  ///      converge where another does not
  /// r    in: initial impulses; out: the solution, or the impulses with the least residual if it
  ///      does not converge
  End solve(const ScaledFriction& problem, const Eigen::VectorXd& q, double damping, double rho,
            int max_iterations, Eigen::VectorXd& r);
  /// Starts from impulses whose states are nearly the right ones, such as those of the last step:
  /// they solve a problem with another q, and while q is moved continuously to the given one,
  /// states change one after another where the path reaches their bounds. No state is guessed, so
  /// that redundant contacts at the boundary of their cones cause no wrong choice.
  ///
  /// r       in: initial impulses; out: the solution, only if it converged
  /// source  Robinson (1992), Normal maps induced by linear transformations, for r and u as one
  ///         unknown, P(z) and d (P(z) - z); Dirkse & Ferris (1995), The PATH solver, for the path
  ///         from piece to piece
  End follow(const ScaledFriction& problem, const Eigen::VectorXd& q, double damping,
             int max_iterations, Eigen::VectorXd& r);
  /// One step towards a solution of the undamped problem, which does not change components that S
  /// leaves undetermined.
  /// u        S r + q
  /// returns  false: the matrix is singular
  bool refine(const ScaledFriction& problem, double damping, const Eigen::VectorXd& u,
              Eigen::VectorXd& r);
  /// Progress whose stop request ends the following calls with Stopped.
  void watch(const Progress& progress) { progress_ = progress; }

 private:
  using State = BlockState;
  /// A free direction of impulses and its equation: for a row, u = 0; along the normal of a sliding
  /// contact, whose friction is proportional, the same; across the sliding direction, factor t.u +
  /// diagonal t.r = 0.
  struct Direction {
    int row = 0;
    int tangents = 0;  // 0: only the row
    bool across = false;
    double factor = 1, diagonal = 0, t[3] = {};
  };
  /// Half the squared norm of the natural map; sets states.
  double classify(const ScaledFriction& problem, const Eigen::VectorXd& r,
                  const Eigen::VectorXd& u);
  /// The part of r that the states alone determine, and the directions that remain.
  void decide(const ScaledFriction& problem, Eigen::VectorXd& r);
  bool factor(const ScaledFriction& problem, double damping);
  /// next  the solution of the linear system of the states at r
  /// keep  reuse the last matrix if the states are the same
  bool step(const ScaledFriction& problem, double damping, const Eigen::VectorXd& r,
            const Eigen::VectorXd& u, bool keep, Eigen::VectorXd& next);
  bool slides() const;
  /// follow: states and z = r - u / d of impulses r, adjusted so that they solve the problem.
  void begin_path(const ScaledFriction& problem, const Eigen::VectorXd& r,
                  const Eigen::VectorXd& u);
  void find_slides(const ScaledFriction& problem);
  /// The alpha, up to `most`, at which a block leaves its state along z + alpha by, and the state
  /// that it enters.
  double leaves(const ScaledFriction::ScaledBlock& block, State state, const double* z,
                const double* by, double most, State& next) const;

  std::vector<State> states_, factored_;
  std::vector<double>
      // four per block: change of the friction per change of the normal impulse, and its direction
      slide_;
  std::vector<Direction> directions_;
  Eigen::VectorXd u_, next_, u_next_, best_, right_, along_, shift_, z_, change_;
  Eigen::MatrixXd columns_;
  Eigen::MatrixXd matrix_;
  bool symmetric_ = true;
  DenseCholesky cholesky_;  // of a symmetric matrix
  DenseLu lu_;
  Progress progress_;
  double factored_damping_ = -1, rho_ = 1;
};

}  // namespace clench
