function render()
%RENDER  render()   Redraws the world where it is displayed.
  graspitServer('send', 'render');
end
