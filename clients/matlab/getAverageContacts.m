function [wrench, location] = getAverageContacts(bodies)
%GETAVERAGECONTACTS  [wrench, location] = getAverageContacts(bodies)   Mean wrench [N, N m] and location [mm] of contacts.
  if nargin < 1, bodies = 'ALL'; end
  graspitServer('send', ['getAverageContacts ' indexList(bodies)]);
  [wrench, location] = eachItem(bodies, @averageOf);
end

function [wrench, location] = averageOf()
  wrench = lineNumbers();
  location = lineNumbers();
end
