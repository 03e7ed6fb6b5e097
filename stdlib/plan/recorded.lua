--- Journals of searches by the options of their planner, which finds its own here. See clench.plan.journal.
return setmetatable({}, {__mode = "k"})
