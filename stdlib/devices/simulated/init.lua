-- stdlib/devices/simulated/init.lua
--- Programs that play devices on pseudo-terminals, with delays, bad and lost bytes, and unplugging on demand.
return require "clench.lazy"("devices.simulated", {"barrett", "cyberglove", "dynamixel", "flock", "robotiq", "robotiq_3f"})
