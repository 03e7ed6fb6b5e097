#include "bench/peers.h"

namespace clench::bench {

std::vector<Peer> peers() {
  return {
#ifdef CLENCH_BENCH_FCL
      {.name = "FCL", .pair = fcl_pair},
#endif
#ifdef CLENCH_BENCH_ODE
      {.name = "ODE", .pair = ode_pair},
#endif
#ifdef CLENCH_BENCH_BULLET
      {.name = "Bullet", .pair = bullet_pair},
#endif
#ifdef CLENCH_BENCH_CGAL
      {.name = "CGAL", .point = cgal_point},
#endif
#ifdef CLENCH_BENCH_EMBREE
      {.name = "Embree", .point = embree_point},
#endif
  };
}

}  // namespace clench::bench
