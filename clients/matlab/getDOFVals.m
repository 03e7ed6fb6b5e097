function values = getDOFVals(robots)
%GETDOFVALS  values = getDOFVals(robots)   DOFs of robots by index from 1 [rad, mm]; of all by default, as cells.
  if nargin < 1, robots = 'ALL'; end
  graspitServer('send', ['getDOFVals ' indexList(robots)]);
  values = eachItem(robots, @() numberRows(lineNumbers()));
end
