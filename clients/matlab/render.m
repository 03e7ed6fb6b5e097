function render()
%RENDER  render()   Draws the world again, where it is shown.
  graspitServer('send', 'render');
end
