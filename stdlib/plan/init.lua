-- stdlib/plan/init.lua
--- Planners: searches for grasps, written in Lua over the engine's annealing, energies and motions. Each takes one table of options and returns a run:
--- `grasps`, a list, and `report`, the statistics of the search.
return require "clench.lazy"("plan", {"anneal", "loop", "guided", "list", "sample", "random", "primitive", "antipodal", "online", "start"})
