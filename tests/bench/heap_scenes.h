// Heaps and structures of the dynamics bench: scenes with many contacts between bodies.
#pragma once
#include "bench/dynamic_scene.h"

namespace clench::bench {

/// Boxes of random sizes and orientations that fall, in layers of four, into a bin 30 cm wide.
DynamicScene bin_of_boxes(int count);
/// Scanned objects of /ycb of the third-party data, several copies of each, that fall in random
/// orientations into a bin of 50 cm; no parts if the data are missing.
DynamicScene bin_of_scans(int count);
/// Leaning pairs of cards, one pair fewer in each storey, with a plank across each storey.
/// gap  between bodies at the start [m]; the same below
DynamicScene card_house(int storeys, double gap);
/// Layers of three planks, each layer across the one below.
DynamicScene plank_tower(int layers, double gap);
/// A grid of side x side boxes on the ground.
DynamicScene layer_of_boxes(int side, double gap);

}  // namespace clench::bench
