// Conversion factors from the units of files to SI. Used only by io, on the line that reads the
// number.
#pragma once
#include <numbers>

namespace clench::units {

inline constexpr double millimeter = 1e-3;                  ///< [m]
inline constexpr double gram = 1e-3;                        ///< [kg]
inline constexpr double degree = std::numbers::pi / 180.0;  ///< [rad]
inline constexpr double square_millimeter = 1e-6;           ///< [m^2]
inline constexpr double gram_millimeter = 1e-6;             ///< g mm/s^2 in [N]
inline constexpr double gram_square_millimeter = 1e-9;      ///< g mm^2/s^2 in [N m]
inline constexpr double newton_millimeter = 1e-3;           ///< [N m]
inline constexpr double newton_per_millimeter = 1e3;        ///< [N/m]
inline constexpr double gram_per_square_second = 1e-3;      ///< g/s^2 in [N/m]

}  // namespace clench::units
