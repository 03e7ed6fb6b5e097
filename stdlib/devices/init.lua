-- stdlib/devices/init.lua
--- Drivers of hands, gloves and trackers on serial lines, and simulators of these devices.
return require "clench.lazy"("devices", {"barrett", "cyberglove", "dynamixel", "flock", "robotiq", "robotiq_3f", "simulated", "calibrate", "save_calibration", "tracker_map", "glove_map", "fuzzy_grasp", "mirror"})
