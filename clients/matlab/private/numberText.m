function text = numberText(values)
% Numbers, separated by blanks, exactly.
  text = strtrim(sprintf('%.17g ', values));
end
