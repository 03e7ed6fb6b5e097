// Heaps and structures in our engine and in others: time and accuracy of all steps.
#pragma once
#include "bench/dynamic_engine.h"

namespace clench::bench {

/// Results of one engine on one scene.
struct HeapFigures {
  std::string scene, engine;
  int bodies = 0;          ///< that can move
  double seconds = 0;      ///< processor time of all steps [s]
  double penetration = 0;  ///< largest depth of two bodies, at five instants [m]
  double residual = 0;     ///< largest of all steps, of our engine; NaN of others [m/s]
  double fallen = 0;       ///< by how much the watched part sank [m]
};

/// Bins of 20, 50 and 100 boxes until they rest, of 30 scanned objects where there are any, a card
/// house and a plank tower.
/// h      time step [s]
/// brief  only a few steps of small scenes
std::vector<HeapFigures> race_heaps(const std::vector<EngineKind>& engines, double h, bool brief);

/// Exponent with which the time grows with the number of bodies, from the smallest to the largest
/// bin.
double growth_exponent(const std::vector<HeapFigures>& figures, const std::string& engine);

}  // namespace clench::bench
