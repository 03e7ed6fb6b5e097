function varargout = eachItem(items, read)
% The reply to a list of items, each read by read(). For one index: the values themselves; otherwise cells.
  if ischar(items), count = lineNumbers(); else, count = numel(items); end
  outputs = max(1, nargout);
  results = cell(count, outputs);
  for i = 1:count, [results{i, :}] = read(); end
  for k = 1:outputs
    if isnumeric(items) && numel(items) == 1
      varargout{k} = results{1, k};
    else
      varargout{k} = results(:, k)';
    end
  end
end
