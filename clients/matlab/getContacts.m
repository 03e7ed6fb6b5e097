function [wrenches, locations, errors] = getContacts(bodies)
%GETCONTACTS  [wrenches, locations, errors] = getContacts(bodies)   Contacts of bodies by index from 1; of all by default.
%   wrenches  per contact fx fy fz tx ty tz on the body, in the contact frame [N, N m]
%   locations per contact, in the body's frame [mm]
%   errors    per contact max(0, threshold / 2 - gap) [mm]
%   For one index: matrices with a row per contact; otherwise cells of matrices.
  if nargin < 1, bodies = 'ALL'; end
  kinds = max(1, nargout);
  graspitServer('send', sprintf('getContacts %d %s', kinds, indexList(bodies)));
  [wrenches, locations, errors] = eachItem(bodies, @() contactsOf(kinds));
end

function [wrenches, locations, errors] = contactsOf(kinds)
  count = lineNumbers();
  wrenches = zeros(count, 6);
  locations = zeros(count, 3);
  errors = zeros(count, 1);
  for i = 1:count
    wrenches(i, :) = lineNumbers();
    if kinds > 1, locations(i, :) = lineNumbers(); end
    if kinds > 2, errors(i) = lineNumbers(); end
  end
end
