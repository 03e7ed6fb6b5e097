function cells = asCells(items, values, name)
% A cell with a vector per item.
  if ~iscell(values), values = {values}; end
  if ischar(items) || numel(values) ~= numel(items)
    error('clench:InvalidParams', '%s: expected a vector per robot, by index', name);
  end
  cells = values;
end
