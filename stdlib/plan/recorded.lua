--- Maps the options of a planner to the journal of its search. See clench.plan.journal.
return setmetatable({}, {__mode = "k"})
