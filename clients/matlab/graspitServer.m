function out = graspitServer(action, varargin)
%GRASPITSERVER  Connection of the wrappers with GraspIt!'s names: getRobotName, getDOFVals, moveDOFs, ...
%   graspitServer('open')               connects to clench serve on this machine, port 4765
%   graspitServer('open', host, port)   elsewhere on this machine
%   graspitServer('close')
%   The wrappers connect themselves on first use. For them: graspitServer('send', line), line = graspitServer('line').
  persistent connection
  out = [];
  switch action
    case 'open'
      if ~isempty(connection), close(connection); end
      given = {'127.0.0.1', 4765};
      given(1:numel(varargin)) = varargin;
      connection = [];
      connection = ClenchConnection(given{:});
    case 'close'
      if ~isempty(connection), close(connection); end
      connection = [];
    case 'send'
      if isempty(connection), graspitServer('open'); end
      send(connection, varargin{1});
    case 'line'
      out = receive(connection, 60);
      if strncmp(out, 'Error', 5), error('clench:Failed', '%s', regexprep(out, '^Error:?\s*', '')); end
    otherwise
      error('clench:InvalidParams', 'graspitServer: expected open, close, send or line, got %s', action);
  end
end
