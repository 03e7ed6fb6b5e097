function passed = stepDynamics()
%STEPDYNAMICS  passed = stepDynamics()   One step of the dynamics; the time that has passed [s].
  graspitServer('send', 'step dynamics');
  passed = lineNumbers();
end
