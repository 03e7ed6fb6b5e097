function code = computeNewVelocities(dt)
%COMPUTENEWVELOCITIES  code = computeNewVelocities(dt)   Computes the velocities after dt [s]; code: 0, or 1 if the solver did not converge.
  graspitServer('send', ['computeNewVelocities ' numberText(dt)]);
  code = lineNumbers();
end
