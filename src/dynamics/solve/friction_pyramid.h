// Contacts with pyramidal friction cones: a linear complementarity problem.
#pragma once
#include "clench/dynamics/solve/scaled_friction.h"

namespace clench {

/// Directions of friction, columns of length one: `edges` on a circle; with torsion five rings of a
/// sphere, at latitudes 90, 45, 0, -45 and -90 degrees, of 1, edges - 3, edges, edges - 3 and 1 (20
/// for 8).
/// source  Ciocarlie, Lackner & Allen (2007), Soft finger model with adaptive contact geometry
Eigen::MatrixXd pyramid_directions(int tangents, int edges);

/// The blocks with round cones inside their pyramids, the largest ones for contacts without
/// torsion.
/// edges  as of pyramid_directions
std::vector<FrictionProblem::Block> inscribed_cones(std::vector<FrictionProblem::Block> blocks,
                                                    int edges);

/// Impulses of a scaled problem, and their residual.
struct PyramidSolution {
  bool found = false;
  Eigen::VectorXd r;
  /// largest violation of any complementary pair, as a velocity of the problem
  double residual = 0;
  int iterations = 0;
};

/// Per contact r_t is a sum of edges times beta >= 0, sum of beta <= mu r_n, and friction acts
/// along the edges most opposed to sliding: D^T u_t + lambda >= 0 is complementary to beta, mu r_n
/// - sum of beta to lambda.
///
/// damping  damping * weights is added to the diagonal of S, and pulls r towards the center
/// edges    directions per contact; of all blocks, those of others empty
/// source   Stewart & Trinkle (1996), An implicit time-stepping scheme for rigid body dynamics
PyramidSolution solve_pyramid(const ScaledFriction& problem, double damping,
                              const Eigen::VectorXd& center,
                              const std::vector<Eigen::MatrixXd>& edges);

}  // namespace clench
