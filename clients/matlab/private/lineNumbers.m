function values = lineNumbers()
% The numbers of the next line of a reply, as a row.
  values = sscanf(graspitServer('line'), '%f')';
end
