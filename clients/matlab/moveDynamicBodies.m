function passed = moveDynamicBodies(dt)
%MOVEDYNAMICBODIES  passed = moveDynamicBodies(dt)   Moves bodies for dt [s], the world's time step by default; the time that has passed.
  if nargin < 1
    graspitServer('send', 'moveDynamicBodies');
  else
    graspitServer('send', ['moveDynamicBodies ' numberText(dt)]);
  end
  passed = lineNumbers();
end
