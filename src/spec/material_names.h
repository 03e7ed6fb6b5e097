// The materials that every world knows from the start.
#pragma once
#include <array>
#include <string_view>

namespace clench {

/// In the order of the friction table (contact/materials.cpp).
inline constexpr std::array<std::string_view, 7> material_names = {
    "frictionless", "glass", "metal", "plastic", "wood", "rubber", "stone"};

}  // namespace clench
