-- scripts/models/sets.lua
--- The sets of models that scripts/make_models.lua writes, each a list of files.
return {"arms", "barrett", "dlr", "grippers", "human", "robonaut", "shadow", "objects", "tools", "primitives",
        "obstacles", "worlds"}
