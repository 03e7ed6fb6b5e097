function actual = setDOFForces(robots, forces)
%SETDOFFORCES  actual = setDOFForces(robots, forces)   Sets efforts of motors [1e-9 N m, 1e-6 N], clamped to their limits; actual: those that were set.
%   forces: a vector; for several robots a cell of vectors.
  given = asCells(robots, forces, 'setDOFForces');
  text = ['setDOFForces ' indexList(robots)];
  for i = 1:numel(given), text = [text sprintf(' %d ', numel(given{i})) numberText(given{i})]; end
  graspitServer('send', text);
  actual = cell(1, numel(given));
  for i = 1:numel(given), actual{i} = numberRows(numel(given{i})); end
  if numel(robots) == 1, actual = actual{1}; end
end
