-- stdlib/study/init.lua
--- Studies of grasps: many measurements and their statistics.
return require "clench.lazy"("study", {"compare", "fall_off", "lift", "planner_speed", "predictors", "resistible_wrenches", "robustness", "shake", "shake_base", "tendon_design"})
