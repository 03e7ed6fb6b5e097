#include "clench/model/dynamic_state.h"

namespace clench {

// source  the polynomial that starts and ends at rest, without acceleration (Craig (2005),
//         Introduction to Robotics, 7.3)
static double quintic(const Trajectory& t, double s, bool slope) {
  const double d = t.to - t.from;
  if (slope) return d * s * s * (30 + s * (-60 + s * 30));
  return t.from + d * s * s * s * (10 + s * (-15 + s * 6));
}

double Trajectory::value(double time) const {
  if (time <= begin) return from;
  if (time >= begin + duration) return to;
  return quintic(*this, (time - begin) / duration, false);
}

double Trajectory::velocity(double time) const {
  if (time < begin || duration <= 0) return 0;
  if (time >= begin + duration) return 0;
  return quintic(*this, (time - begin) / duration, true) / duration;
}

}  // namespace clench
