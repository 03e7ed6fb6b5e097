function actual = setDOFVals(robots, values, steps)
%SETDOFVALS  actual = setDOFVals(robots, values, steps)   Moves DOFs of robots to values, until the first contact, as in version 0.9.
%   values, steps: vectors; for several robots cells of vectors. actual: likewise.
  values = asCells(robots, values, 'setDOFVals');
  steps = asCells(robots, steps, 'setDOFVals');
  graspitServer('send', ['setDOFVals ' indexList(robots)]);
  for i = 1:numel(values)
    graspitServer('send', sprintf('%d', numel(values{i})));
    graspitServer('send', numberText(values{i}));
    graspitServer('send', numberText(steps{i}));
  end
  actual = cell(1, numel(values));
  for i = 1:numel(values), actual{i} = numberRows(numel(values{i})); end
  if numel(robots) == 1, actual = actual{1}; end
end
