// Declarations shared by the bindings of planning.
#pragma once
#include "clench/planning/energy/energy.h"
#include "clench/planning/search/annealing.h"
#include "clench/script/bind/handles.h"
#include "clench/script/lua/object.h"
#include "clench/script/lua/script_function.h"
#include "clench/script/lua/table.h"

namespace clench {

// --- energy. ---

struct EnergyHandle {
  WorldPtr world;  ///< world of the energy; null: only a script's function
  std::shared_ptr<Energy> energy;
};

extern const Class energy_class;
extern const Library energy_library;

template <>
inline constexpr const Class* script_class<EnergyHandle> = &energy_class;

/// An independent copy of an energy, or of a function used as one.
/// world   the world that it must refer to, or a clone of it; null: set to its own
EnergyPtr read_energy(lua_State* L, int index, WorldPtr& world);

// --- annealing. ---

/// Variables of a search: `position`, `posture`, `semi_axes`, `limits`, `jumps`, `values`,
/// `targets`, `fixed`, `start`, `variables`.
SearchSpace read_space(lua_State* L, Table& options, const World& world, const HandAndObject& who);
/// A table indexed by names.
int push_values(lua_State* L, const SearchSpace& space, const Values& values);

struct AnnealingHandle {
  WorldPtr world;
  std::shared_ptr<Annealing> search;
};

extern const Class annealing_class;
extern const Library annealing_library;

template <>
inline constexpr const Class* script_class<AnnealingHandle> = &annealing_class;

}  // namespace clench
