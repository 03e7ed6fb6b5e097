// Heaps and structures in our engine and in others: the time of all steps, and what it bought.
#pragma once
#include "bench/dynamic_engine.h"

namespace clench::bench {

/// What one engine made of one scene.
struct HeapFigures {
  std::string scene, engine;
  int bodies = 0;
  double seconds = 0;      ///< of processor time, all steps together
  double penetration = 0;  ///< largest depth of two bodies, at five instants [m]
  double residual = 0;     ///< of ours, largest of all steps; others: NaN [m/s]
  double fallen = 0;       ///< by how much the watched part sank [m]
};

/// Bins of 20, 50 and 100 boxes until they rest, of 30 scanned objects where there are any, a card
/// house and a plank tower.
/// brief  a few steps of the smallest
std::vector<HeapFigures> race_heaps(const std::vector<EngineKind>& engines, double h, bool brief);

/// By how much the power of bodies grows that the time grows with, from the first to the last bin.
double growth_exponent(const std::vector<HeapFigures>& figures, const std::string& engine);

}  // namespace clench::bench
