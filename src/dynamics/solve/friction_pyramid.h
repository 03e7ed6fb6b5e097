// Contacts whose friction cone is a pyramid: a linear complementarity problem.
#pragma once
#include "clench/dynamics/solve/scaled_friction.h"

namespace clench {

/// Directions that friction may take, columns of length one: `edges` on a circle; with torsion five
/// rings of a sphere, at latitudes 90, 45, 0, -45 and -90 degrees, of 1, edges - 3, edges, edges -
/// 3 and 1 (20 for 8).
/// source  Ciocarlie, Lackner & Allen (2007), Soft finger model with adaptive contact geometry
Eigen::MatrixXd pyramid_directions(int tangents, int edges);

/// The blocks with round cones that lie inside their pyramids, as large as can be for contacts without
/// torsion.   edges  as of pyramid_directions
std::vector<FrictionProblem::Block> inscribed_cones(std::vector<FrictionProblem::Block> blocks,
                                                    int edges);

/// Impulses of a scaled problem, and how true they are.
struct PyramidSolution {
  bool found = false;
  Eigen::VectorXd r;
  double residual = 0;  ///< largest fault of any complementary pair, as a velocity of the problem
  int iterations = 0;
};

/// Per contact r_t is a sum of edges times beta >= 0, sum of beta <= mu r_n, and friction acts
/// along those edges that the contact slides against most: D^T u_t + lambda >= 0 is complementary
/// to beta, mu r_n - sum of beta to lambda.
///
/// damping  its multiple of weights is added to the diagonal of S, and pulls r to the centre
/// edges    directions per contact; of all blocks, of others empty
/// source   Stewart & Trinkle (1996), An implicit time-stepping scheme for rigid body dynamics
PyramidSolution solve_pyramid(const ScaledFriction& problem, double damping,
                              const Eigen::VectorXd& centre,
                              const std::vector<Eigen::MatrixXd>& edges);

}  // namespace clench
