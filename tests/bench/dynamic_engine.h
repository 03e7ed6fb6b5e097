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
  virtual Pose pose(int part) const = 0;  ///< of its center
  virtual Eigen::Vector3d velocity(int part) const = 0;
};

/// An engine by name, and how it makes a scene its own.   h  length of its steps [s]
struct EngineKind {
  std::string name;
  double gap;  ///< at which its bodies rest [m]
  std::function<std::unique_ptr<DynamicEngine>(const DynamicScene& scene, double h)> make;
};

EngineKind our_engine();
enum class OdeMethod { quick_step, world_step };
/// meshes  the same triangles as ours, in place of its primitives
EngineKind ode_engine(OdeMethod method, bool meshes);
EngineKind bullet_engine();

/// The world of our engine; other engines have none.
const World& world_of(const DynamicEngine& ours);

/// Our engine on more than a scene: its contacts.
struct GripForces {
  double tangential = 0;  ///< on the watched part, against its weight [N]
  double jitter = 0;      ///< largest change of a pad's force from step to step, as a part of it
};
GripForces our_grip(const DynamicScene& scene, double h, double seconds);

}  // namespace clench::bench
