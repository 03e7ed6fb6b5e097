function text = numberText(values)
% Numbers separated by blanks, with all digits.
  text = strtrim(sprintf('%.17g ', values));
end
