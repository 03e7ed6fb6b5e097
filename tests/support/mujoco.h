// MuJoCo's model and data, freed at the end of their scope.
#pragma once
#include <mujoco/mujoco.h>

#include <memory>

namespace clench::test {

struct MujocoDeleter {
  void operator()(mjModel* m) const { mj_deleteModel(m); }
  void operator()(mjData* d) const { mj_deleteData(d); }
};
using MujocoModel = std::unique_ptr<mjModel, MujocoDeleter>;
using MujocoData = std::unique_ptr<mjData, MujocoDeleter>;

}  // namespace clench::test
