--- Bounds of what studies of moving grasps are given: beyond them a simulation gives no numbers, or does not end.
local bounds = {seconds = 1e6, speed = 1e6, mass = 1e12, force = 1e15}

bounds.acceleration = 1e6  -- as of the gravity of a world [m/s^2]

--- Refuses a force that accelerates the object beyond all that a world simulates.
function bounds.check_force(read, name, force, mass)
  local largest = bounds.acceleration * mass
  if force > largest then
    read:expected(name, ("at most %g N, which accelerates %g kg by %g m/s^2"):format(largest, mass, bounds.acceleration), force)
  end
end

local steps_per_period = 10  -- with fewer, the largest speed of a sine is off by more than 5 %

--- Refuses a frequency that the steps of a world do not follow.
function bounds.check_frequency(read, frequency, time_step)
  local largest = 1 / (steps_per_period * time_step)
  if frequency > largest * (1 + 1e-9) then
    read:expected("frequency", ("at most %g Hz, %d time steps of %g s in a period"):format(largest, steps_per_period, time_step), frequency)
  end
end

return bounds
