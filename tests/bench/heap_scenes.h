// Heaps and structures of the dynamics bench: many bodies that touch one another.
#pragma once
#include "bench/dynamic_scene.h"

namespace clench::bench {

/// Boxes of random sizes and orientations that fall, four abreast, into a bin 30 cm wide.
DynamicScene bin_of_boxes(int count);
/// Scanned objects of /ycb of the third-party data, each several times, that fall turned into a bin of
/// 50 cm; no part where there is no such data.
DynamicScene bin_of_scans(int count);
/// Leaning pairs of cards, one pair fewer in each storey, with a plank across each storey.
/// gap  between bodies at the start [m]; the same below
DynamicScene card_house(int storeys, double gap);
/// Layers of three planks, each layer across the one below.
DynamicScene plank_tower(int layers, double gap);
/// Boxes side by side on the ground, side x side of them.
DynamicScene layer_of_boxes(int side, double gap);

}  // namespace clench::bench
