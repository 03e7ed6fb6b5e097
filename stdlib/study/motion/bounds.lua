--- Bounds of the inputs of studies of moving grasps: beyond them a simulation returns no finite numbers, or does not end.
local bounds = {seconds = 1e6, speed = 1e6, mass = 1e12, force = 1e15}

bounds.acceleration = 1e6  -- same bound as for the gravity of a world [m/s^2]

--- Rejects a force that accelerates the object beyond the range of simulations.
function bounds.check_force(read, name, force, mass)
  local largest = bounds.acceleration * mass
  if force > largest then
    read:expected(name, ("at most %g N, which accelerates %g kg by %g m/s^2"):format(largest, mass, bounds.acceleration), force)
  end
end

local steps_per_period = 10  -- with fewer, the error of a sine's maximum speed exceeds 5 %

--- Rejects a frequency that the time step of a world cannot resolve.
function bounds.check_frequency(read, frequency, time_step)
  local largest = 1 / (steps_per_period * time_step)
  if frequency > largest * (1 + 1e-9) then
    read:expected("frequency", ("at most %g Hz, %d time steps of %g s in a period"):format(largest, steps_per_period, time_step), frequency)
  end
end

return bounds
