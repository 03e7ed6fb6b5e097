-- The centre of a neighbour.
local x = 1  -- plain
-- Wanted 3 numbers, got 2.
