-- stdlib/devices/simulated/init.lua
--- Simulators of devices on pseudo-terminals, with delays, changed and lost bytes, and unplugging on demand.
return require "clench.lazy"("devices.simulated", {"barrett", "cyberglove", "dynamixel", "flock", "robotiq", "robotiq_3f"})
