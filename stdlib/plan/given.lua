--- Maps the options of a planner to the options of the command line that started it, by name. See clench.plan.assumptions.
return setmetatable({}, {__mode = "k"})
