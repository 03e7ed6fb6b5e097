-- stdlib/devices/init.lua
--- Hands, gloves and trackers at serial lines, and programs that play them.
return require "clench.lazy"("devices", {"barrett", "cyberglove", "dynamixel", "flock", "robotiq", "robotiq_3f", "simulated", "calibrate", "save_calibration", "tracker_map", "glove_map", "fuzzy_grasp", "mirror"})
