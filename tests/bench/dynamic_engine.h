// An engine that steps a scene of the dynamics bench.
#pragma once
#include <functional>
#include <memory>

#include "bench/dynamic_scene.h"
#include "clench/model/world.h"

namespace clench::bench {

class DynamicEngine {
 public:
  virtual ~DynamicEngine() = default;
  virtual void step(int count) = 0;
  virtual Pose pose(int part) const = 0;  ///< of its center of mass
  virtual Eigen::Vector3d velocity(int part) const = 0;
};

/// An engine by name, with a function that builds a scene in it.   h  time step [s]
struct EngineKind {
  std::string name;
  double gap;  ///< gap between its bodies at rest [m]
  std::function<std::unique_ptr<DynamicEngine>(const DynamicScene& scene, double h)> make;
};

EngineKind our_engine();
enum class OdeMethod { quick_step, world_step };
/// meshes  triangle meshes like those of Clench, instead of ODE's primitives
EngineKind ode_engine(OdeMethod method, bool meshes);
EngineKind bullet_engine();

/// The world of Clench's engine; other engines have none.
const World& world_of(const DynamicEngine& ours);

/// Contact forces, which only Clench's engine measures.
struct GripForces {
  double tangential = 0;  ///< on the watched part, against its weight [N]
  double jitter = 0;      ///< largest change of a pad's force per step, relative to the force
};
GripForces our_grip(const DynamicScene& scene, double h, double seconds);

}  // namespace clench::bench
