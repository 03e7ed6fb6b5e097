-- stdlib/study/init.lua
--- Studies of grasps: many measurements, and what they say together.
return require "clench.lazy"("study", {"compare", "planner_speed", "robustness"})
