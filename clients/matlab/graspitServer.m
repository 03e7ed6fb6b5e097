function out = graspitServer(action, varargin)
%GRASPITSERVER  Connection of the wrappers with GraspIt!'s names: getRobotName, getDOFVals, moveDOFs, ...
%   graspitServer('open')               connects to the last address, at first to port 4765 of this machine
%   graspitServer('open', host, port)   connects to another address of this machine
%   graspitServer('close')
%   The wrappers connect on first use, and again after an error. They call graspitServer('send', line) and
%   line = graspitServer('line').
  persistent connection address
  out = [];
  switch action
    case 'open'
      graspitServer('close');
      if ~isempty(varargin) || isempty(address), address = {'127.0.0.1', 4765}; end
      address(1:numel(varargin)) = varargin;
      connection = ClenchConnection(address{:});
    case 'close'
      if ~isempty(connection), close(connection); end
      connection = [];
    case 'send'
      if isempty(connection), graspitServer('open'); end
      send(connection, varargin{1});
    case 'line'
      out = receive(connection, 60);
      if strncmp(out, 'Error', 5)
        graspitServer('close');  % replies to further lines of the command, which may follow, belong to no other command
        error('clench:Failed', '%s', regexprep(out, '^Error:?\s*', ''));
      end
    otherwise
      error('clench:InvalidParams', 'graspitServer: expected open, close, send or line, got %s', action);
  end
end
