// What the bindings of planning share.
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
  WorldPtr world;  ///< that it is about; null: a script's function alone
  std::shared_ptr<Energy> energy;
};

extern const Class energy_class;
extern const Library energy_library;

template <>
inline constexpr const Class* script_class<EnergyHandle> = &energy_class;

/// An energy, or a function as one; a copy of its own.
/// world   it must be about this one, or a clone of it; null: becomes its own
EnergyPtr read_energy(lua_State* L, int index, WorldPtr& world);

// --- annealing. ---

/// What a search varies: `position`, `posture`, `semi_axes`, `limits`, `jumps`, `values`,
/// `targets`, `fixed`, `start`, `variables`.
SearchSpace read_space(lua_State* L, Table& options, const World& world, const HandAndObject& who);
/// A table by names.
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
