--- Maps the options of a planner to what the command line was given for its search, by name. See clench.plan.assumptions.
return setmetatable({}, {__mode = "k"})
