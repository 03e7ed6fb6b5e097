classdef ClenchClient < handle
%CLENCHCLIENT  Client of a Clench server (clench serve), by JSON-RPC 2.0.
%   c = ClenchClient()      connects to port 4765 of this machine, with the token stored by the server
%   c = ClenchClient(url)   as clench serve prints it, 'tcp://127.0.0.1:4765/?token=...'
%   result = c.call(method, name, value, ...)   a method of the server with arguments by name
%   value = c.get(address, field)         a field of a body or robot; c.get('', field): of the world
%   c.set(address, field, value)          dofs, pose, mass or material, by a command that can be undone
%   c.subscribe(event), c.subscribeState(rate), [method, params] = c.nextNotification(seconds)
%   job = c.plan(planner, name, value, ...), result = c.wait(job, seconds)
%   c.close()
%
%   Units are m, kg, s, N, rad. A list with one element is given as a cell, {0.5}. Errors have the identifiers
%   clench:Failed, clench:InvalidParams, clench:MethodNotFound, clench:Unauthorized, clench:Refused,
%   clench:ConnectionLost, clench:Timeout.

  properties
    timeout = Inf  % for each answer [s]; MATLAB's tcpclient does not detect earlier that a server has ended
  end
  properties (SetAccess = private)
    version = ''   % of the server
    methodNames = {}
  end
  properties (Access = private)
    connection = []
    number = 0
    notifications = {}
  end

  methods
    function self = ClenchClient(url, transport)
      if nargin < 1, url = 'tcp://127.0.0.1:4765'; end
      [host, port, token] = addressOf(url);
      if nargin < 2
        self.connection = ClenchConnection(host, port);
      else
        self.connection = ClenchConnection(host, port, transport);
      end
      try
        arguments = {'client', 'matlab'};
        if ~isempty(token), arguments = [arguments, {'token', token}]; end
        found = self.call('hello', arguments{:});
      catch problem
        self.close();
        rethrow(problem);
      end
      self.version = found.version;
      self.methodNames = found.methods;
    end

    function result = call(self, method, varargin)
      self.number = self.number + 1;
      message = struct('jsonrpc', '2.0', 'id', self.number, 'method', method);
      message.params = paramsOf(method, varargin);
      send(self.connection, jsonencode(message));
      began = tic();
      while true
        answer = self.receive(self.timeout - toc(began));
        if isfield(answer, 'method')
          self.notifications{end + 1} = answer;
        elseif isempty(answer.id) || isequal(answer.id, self.number)
          break
        end  % otherwise it is the answer to a call that has timed out
      end
      if isfield(answer, 'error'), raise(answer.error); end
      result = answer.result;
    end

    function value = get(self, address, field)
      found = self.call('get', 'of', address, 'fields', {field});
      value = [];
      if isfield(found, field), value = found.(field); end
    end

    function set(self, address, field, value)
      switch field
        case 'dofs', self.call('grasp.dofs', 'hand', address, 'dofs', listOf(value));
        case 'pose', self.call('body.move', 'body', address, 'pose', value);
        case 'mass', self.call('body.mass', 'body', address, 'mass', value);
        case 'material', self.call('body.material', 'body', address, 'material', value);
        otherwise, error('clench:InvalidParams', 'set: expected dofs, pose, mass or material, got %s', field);
      end
    end

    function number = subscribe(self, event)
      found = self.call('subscribe', 'event', event);
      number = found.subscription;
    end

    function number = subscribeState(self, rate)
      found = self.call('subscribe_state', 'rate', rate);
      number = found.subscription;
    end

    function [method, params] = nextNotification(self, seconds)
      if nargin < 2, seconds = Inf; end
      began = tic();
      while isempty(self.notifications)
        answer = self.receive(seconds - toc(began));
        if isfield(answer, 'method'), self.notifications{end + 1} = answer; end
      end
      method = self.notifications{1}.method;
      params = self.notifications{1}.params;
      self.notifications(1) = [];
    end

    function job = plan(self, planner, varargin)
      found = self.call('plan.start', 'planner', planner, 'options', paramsOf('plan', varargin));
      job = found.job;
    end

    function result = wait(self, job, seconds)
      if nargin < 3, seconds = Inf; end
      began = tic();
      while true
        found = self.call('job.state', 'job', job);
        if any(strcmp(found.state, {'done', 'failed', 'stopped'})), break; end
        if toc(began) > seconds, error('clench:Timeout', 'job %d has not ended yet', job); end
        pause(0.05);
      end
      result = self.call('job.result', 'job', job);
    end

    function close(self)
      if ~isempty(self.connection), close(self.connection); end
    end
  end

  methods (Access = private)
    function message = receive(self, seconds)
      line = receive(self.connection, seconds);
      try
        message = jsondecode(line);
      catch
        error('clench:InternalError', 'not a message: %s', line(1:min(60, end)));
      end
    end
  end
end

% named arguments: pairs, or one struct
function params = paramsOf(method, given)
  params = struct();
  if numel(given) == 1 && isstruct(given{1})
    params = given{1};
    return
  end
  if mod(numel(given), 2) ~= 0 || ~all(cellfun(@ischar, given(1:2:end)))
    error('clench:InvalidParams', '%s: expected names and values, or one struct', method);
  end
  for i = 1:2:numel(given), params.(given{i}) = given{i + 1}; end
end

% numbers as a list, also a single one
function list = listOf(value)
  list = value;
  if isnumeric(value) && isscalar(value), list = {value}; end
end

function [host, port, token] = addressOf(url)
  parts = regexp(url, '^tcp://([^/?\[\]]+|\[[^\]]*\]):(\d+)/?(\?.*)?$', 'tokens', 'once');
  if isempty(parts), error('clench:InvalidParams', 'expected a URL such as tcp://127.0.0.1:4765/?token=..., got %s', url); end
  host = strrep(strrep(parts{1}, '[', ''), ']', '');
  port = str2double(parts{2});
  found = regexp(url, '[?&]token=([\w-]+)', 'tokens', 'once');
  if isempty(found), token = storedToken(port); else, token = found{1}; end
end

% the token stored by clench serve; '' if there is none
function token = storedToken(port)
  token = '';
  path = sprintf('%s/clench-%d.token', getenv('XDG_RUNTIME_DIR'), port);
  if isempty(getenv('XDG_RUNTIME_DIR')), path = sprintf('%s/.clench-%d.token', getenv('HOME'), port); end
  file = fopen(path, 'r');
  if file < 0, return; end
  token = strtrim(fgetl(file));
  fclose(file);
end

function raise(problem)
  codes = [-32700, -32600, -32601, -32602, -32603, -32000, -32001, -32002];
  names = {'ParseError', 'InvalidRequest', 'MethodNotFound', 'InvalidParams', 'InternalError', 'Failed', 'Unauthorized', 'Refused'};
  known = find(codes == problem.code, 1);
  name = 'Error';
  if ~isempty(known), name = names{known}; end
  error(['clench:' name], '%s', problem.message);
end
