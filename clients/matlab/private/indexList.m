function text = indexList(items)
% Bodies or robots, numbered from 1, as the protocol's list of indices from 0; 'ALL': all.
  if ischar(items)
    if ~strcmp(items, 'ALL'), error('clench:InvalidParams', 'expected indices from 1, or ''ALL'', got ''%s''', items); end
    text = 'ALL';
    return
  end
  if ~isnumeric(items) || any(items < 1) || any(items ~= round(items))
    error('clench:InvalidParams', 'expected indices from 1, or ''ALL''');
  end
  text = strtrim(sprintf('%d ', numel(items), items - 1));
end
