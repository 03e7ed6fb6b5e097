function names = getRobotName(robots)
%GETROBOTNAME  names = getRobotName(robots)   Names of robots by index from 1; of all by default, as cells.
  if nargin < 1, robots = 'ALL'; end
  graspitServer('send', ['getRobotName ' indexList(robots)]);
  names = eachItem(robots, @() graspitServer('line'));
end
