// Newton's method for contacts with friction: which open, stick, slide, and what follows.
#pragma once
#include <Eigen/Core>
#include <vector>

#include "clench/base/progress.h"
#include "clench/dynamics/solve/natural_map.h"
#include "clench/dynamics/solve/scaled_friction.h"
#include "clench/math/decompositions.h"

namespace clench {

/// Solves a scaled problem with `damping * weights` added to the diagonal of S, so that redundant
/// contacts share their load in one way. Given which blocks are open, sticking or sliding (and
/// where to), at a bound or between, all impulses follow from one linear system of the rows that
/// are free; they say what each block is next.
///
/// source  Alart & Curnier (1991), A mixed formulation for frictional contact problems prone to
///         Newton like solution methods
class FrictionNewton {
 public:
  struct End {
    bool converged = false;
    int iterations = 0;
  };
  /// q    instead of the problem's
  /// rho  the natural map's weight of velocities, by which states are told; one of them may lead
  ///      where another does not
  /// r    from there on; the result, or where there is none the least fault met
  End solve(const ScaledFriction& problem, const Eigen::VectorXd& q, double damping, double rho,
            int max_iterations, Eigen::VectorXd& r);
  /// From impulses whose states are nearly the right ones, such as those of the step before: they
  /// solve a problem of other q, and while q goes over into the one given, states change one after
  /// another where the path meets their bounds. No state is guessed, so that redundant contacts at
  /// the boundary of their cones do not lead astray.
  ///
  /// r       from there on; the result only where it converged
  /// source  Robinson (1992), Normal maps induced by linear transformations, for r and u as one
  ///         unknown, P(z) and d (P(z) - z); Dirkse & Ferris (1995), The PATH solver, for the path
  ///         from piece to piece
  End follow(const ScaledFriction& problem, const Eigen::VectorXd& q, double damping,
             int max_iterations, Eigen::VectorXd& r);
  /// One step towards a solution of the problem without damping, which only keeps what S leaves
  /// open as it is.
  /// u        S r + q
  /// returns  false: the matrix is singular
  bool refine(const ScaledFriction& problem, double damping, const Eigen::VectorXd& u,
              Eigen::VectorXd& r);
  /// What follows may be stopped by it, with Stopped.
  void watch(const Progress& progress) { progress_ = progress; }

 private:
  using State = BlockState;
  /// A free direction of impulses and its equation: of a row, u = 0; along the normal of a sliding
  /// contact, whose friction follows, the same; across the sliding, factor t.u + diagonal t.r = 0.
  struct Direction {
    int row = 0;
    int tangents = 0;  // 0: the row alone
    bool across = false;
    double factor = 1, diagonal = 0, t[3] = {};
  };
  /// Half the square of the natural map; sets states.
  double classify(const ScaledFriction& problem, const Eigen::VectorXd& r,
                  const Eigen::VectorXd& u);
  /// What is decided of r by the states alone, and the directions that are not.
  void decide(const ScaledFriction& problem, Eigen::VectorXd& r);
  bool factor(const ScaledFriction& problem, double damping);
  /// next  the solution of the linear system of the states at r
  /// keep  the last matrix serves again if the states are the same
  bool step(const ScaledFriction& problem, double damping, const Eigen::VectorXd& r,
            const Eigen::VectorXd& u, bool keep, Eigen::VectorXd& next);
  bool slides() const;
  /// follow: states and z = r - u / d of impulses r, where they do not solve the problem so that
  /// they do.
  void begin_path(const ScaledFriction& problem, const Eigen::VectorXd& r,
                  const Eigen::VectorXd& u);
  void find_slides(const ScaledFriction& problem);
  /// Where a block leaves its state along z + alpha by, at most `most`, and into which.
  double leaves(const ScaledFriction::ScaledBlock& block, State state, const double* z,
                const double* by, double most, State& next) const;

  std::vector<State> states_, factored_;
  std::vector<double>
      slide_;  // four per block: of what the friction changes as the normal does not, and where to
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
