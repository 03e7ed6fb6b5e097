function code = computeNewVelocities(dt)
%COMPUTENEWVELOCITIES  code = computeNewVelocities(dt)   Velocities after dt [s]; 0, or 1 if the solver has not reached its accuracy.
  graspitServer('send', ['computeNewVelocities ' numberText(dt)]);
  code = lineNumbers();
end
