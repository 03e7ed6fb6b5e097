// Heaps and structures in Clench's engine and in others: time and accuracy of all steps.
#pragma once
#include "bench/dynamic_engine.h"

namespace clench::bench {

/// Results of one engine on one scene.
struct HeapFigures {
  std::string scene, engine;
  int bodies = 0;          ///< movable bodies
  double seconds = 0;      ///< processor time of all steps [s]
  double penetration = 0;  ///< largest penetration of two bodies, at five instants [m]
  double residual = 0;     ///< largest over all steps, for Clench's engine; NaN for others [m/s]
  double fallen = 0;       ///< distance that the watched part sank [m]
};

/// Bins of 20, 50 and 100 boxes until they are at rest, a bin of 30 scanned objects if these are
/// present, a card house and a plank tower.
/// h      time step [s]
/// brief  only a few steps of small scenes
std::vector<HeapFigures> race_heaps(const std::vector<EngineKind>& engines, double h, bool brief);

/// Exponent with which the time grows with the number of bodies, from the smallest to the largest
/// bin.
double growth_exponent(const std::vector<HeapFigures>& figures, const std::string& engine);

}  // namespace clench::bench
