// The materials predefined in every world.
#pragma once
#include <array>
#include <string_view>

namespace clench {

/// In the order of the friction table (contact/materials.cpp).
inline constexpr std::array<std::string_view, 7> material_names = {
    "frictionless", "glass", "metal", "plastic", "wood", "rubber", "stone"};

/// throws Error  "unknown material 'rubbr'; did you mean 'rubber'?"
void check_material(std::string_view name);

}  // namespace clench
