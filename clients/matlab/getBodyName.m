function names = getBodyName(bodies)
%GETBODYNAME  names = getBodyName(bodies)   Names of bodies by index from 1, links of robots among them; of all by default.
  if nargin < 1, bodies = 'ALL'; end
  graspitServer('send', ['getBodyName ' indexList(bodies)]);
  names = eachItem(bodies, @() graspitServer('line'));
end
