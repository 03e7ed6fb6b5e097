-- stdlib/devices/init.lua
--- Drivers of hands, gloves and trackers on serial lines, and simulators of these devices.
return require "clench.lazy"("devices", {"barrett", "cyberglove", "dynamixel", "flock", "robotiq", "robotiq_3f", "simulated", "calibrate", "calibrate_tips", "save_calibration", "save_postures", "tracker_map", "glove_map", "fuzzy_grasp", "mirror"})
