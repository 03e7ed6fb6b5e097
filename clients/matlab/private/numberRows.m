function values = numberRows(count)
% The next lines of a reply with one number each, as a row.
  values = zeros(1, count);
  for i = 1:count, values(i) = lineNumbers(); end
end
