function actual = moveDOFs(robot, values, steps)
%MOVEDOFS  actual = moveDOFs(robot, values, steps)   Moves a robot's DOFs to values, until the first contact.
%   steps: of each DOF, of which only the ratios matter; by default all arrive together.
  if nargin < 3
    steps = abs(values - getDOFVals(robot));
    steps(steps == 0) = 1;
  end
  if numel(robot) ~= 1, error('clench:InvalidParams', 'moveDOFs: expected the index of one robot'); end
  indexList(robot);  % checks it
  count = numel(values);
  graspitServer('send', sprintf('moveDOFs %d %d %s %s', robot - 1, count, numberText(values), numberText(steps)));
  actual = numberRows(count);
end
