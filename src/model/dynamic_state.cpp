#include "clench/model/dynamic_state.h"

namespace clench {

// source  the polynomial with given ends and slopes and no curvature there (Craig (2005), Introduction to Robotics, 7.3)
static double quintic(const Trajectory& t, double s, bool slope) {
  const double d = t.to - t.from, v0 = t.from_velocity * t.duration, v1 = t.to_velocity * t.duration;
  const double c3 = 10 * d - 6 * v0 - 4 * v1, c4 = -15 * d + 8 * v0 + 7 * v1, c5 = 6 * d - 3 * (v0 + v1);
  if (slope) return v0 + s * s * (3 * c3 + s * (4 * c4 + s * 5 * c5));
  return t.from + s * (v0 + s * s * (c3 + s * (c4 + s * c5)));
}

double Trajectory::value(double time) const {
  if (time <= begin) return from;
  if (time >= begin + duration) return to;
  return quintic(*this, (time - begin) / duration, false);
}

double Trajectory::velocity(double time) const {
  if (time < begin || duration <= 0) return 0;
  if (time >= begin + duration) return time > begin + duration ? 0 : to_velocity;
  return quintic(*this, (time - begin) / duration, true) / duration;
}

template <class T>
static size_t bytes_of(const std::vector<T>& items) {
  return items.capacity() * sizeof(T);
}

size_t DynamicState::bytes() const {
  size_t sum = sizeof *this + bytes_of(twists) + bytes_of(told) + bytes_of(dof_velocities) + bytes_of(joint_velocities) +
               bytes_of(controls) + bytes_of(dof_efforts) + bytes_of(loads) + bytes_of(manifolds) +
               bytes_of(swept) + bytes_of(impulses);
  for (const Manifold& m : manifolds) sum += bytes_of(m.points);
  return sum;
}

}  // namespace clench
