classdef ClenchConnection < handle
%CLENCHCONNECTION  Lines of text over TCP, for ClenchClient and graspitServer.
%   c = ClenchConnection(host, port)   connects by tcpclient, a part of MATLAB and of Octave's package
%                                      instrument-control; without it, through bash and its /dev/tcp
%   c = ClenchConnection(host, port, transport)   'tcpclient' or 'bash'
%   send(c, line)              sends a line
%   line = receive(c, seconds) the next line; an error if none arrives in time, or the connection has ended
%   close(c)

  properties (SetAccess = private)
    transport = ''
  end
  properties (Access = private)
    port = []                      % of tcpclient
    input = -1                     % pipes of bash
    output = -1
    process = -1
    buffer = zeros(1, 0, 'uint8')  % bytes that have arrived
    scanned = 0                    % leading bytes of the buffer without a line end
    isOpen = false
  end

  methods
    function self = ClenchConnection(host, port, transport)
      found = hasTcpclient();
      if nargin < 3
        transport = 'bash';
        if found, transport = 'tcpclient'; end
      end
      self.transport = transport;
      switch transport
        case 'tcpclient', openPort(self, host, port);
        case 'bash', openPipes(self, host, port);
        otherwise, error('clench:InvalidParams', 'transport: expected tcpclient or bash, got %s', transport);
      end
      self.isOpen = true;
    end

    function send(self, line)
      checkOpen(self);
      bytes = [unicode2native(line, 'UTF-8'), uint8(10)];
      try
        if strcmp(self.transport, 'tcpclient')
          write(self.port, bytes);
        else
          if fwrite(self.input, bytes) ~= numel(bytes), error('incomplete write'); end
          fflush(self.input);
        end
      catch problem
        lose(self, problem.message);
      end
    end

    function line = receive(self, seconds)
      if nargin < 2, seconds = Inf; end
      checkOpen(self);
      began = tic();
      pauseTime = 0.0002;
      while true
        ending = find(self.buffer(self.scanned + 1:end) == 10, 1);
        if ~isempty(ending), break; end
        self.scanned = numel(self.buffer);
        chunk = readSome(self);
        self.buffer = [self.buffer, chunk];
        if isempty(chunk)
          if toc(began) > seconds, error('clench:Timeout', 'the server did not answer in time'); end
          if hasEnded(self), lose(self, 'closed by the server'); end
          pause(pauseTime);
          pauseTime = min(0.01, 2 * pauseTime);
        end
      end
      last = self.scanned + ending;
      line = native2unicode(self.buffer(1:last - 1), 'UTF-8');
      self.buffer = self.buffer(last + 1:end);
      self.scanned = 0;
    end

    function close(self)
      if ~self.isOpen, return; end
      self.isOpen = false;
      if strcmp(self.transport, 'tcpclient')
        self.port = [];  % the last reference: this closes it
      else
        fclose(self.input);
        fclose(self.output);
        waitpid(self.process);
      end
    end
  end

  methods (Access = private)
    function openPort(self, host, port)
      try
        self.port = tcpclient(host, port);
      catch problem
        error('clench:ConnectionLost', 'no server at %s:%d: %s', host, port, problem.message);
      end
    end

    function openPipes(self, host, port)
      % pipes of other connections are closed, as those would otherwise not end while this one is open; Octave blocks SIGTERM
      script = ['for f in /dev/fd/*; do f=${f##*/}; if ((f > 2)); then eval "exec $f>&-"; fi; done; ' ...
                'exec 2>/dev/null; exec 3<>"/dev/tcp/$0/$1" 4<&0 || exit 1; echo; ' ...
                'cat <&3 & reader=$!; cat <&4 >&3 & writer=$!; wait -n; kill -9 $reader $writer'];
      [self.input, self.output, self.process] = popen2('bash', {'-c', script, host, sprintf('%d', port)});
      self.isOpen = true;
      try
        receive(self, 20);  % an empty line
      catch
        close(self);
        error('clench:ConnectionLost', 'no server at %s:%d', host, port);
      end
    end

    function chunk = readSome(self)
      if strcmp(self.transport, 'tcpclient')
        chunk = zeros(1, 0, 'uint8');
        try
          count = self.port.NumBytesAvailable;
          if count == 0 && isOctave()  % to wait for one byte fails if the server has closed the connection
            self.port.Timeout = 0.01;
            count = 1;
          end
          if count > 0, chunk = reshape(uint8(read(self.port, count)), 1, []); end
        catch problem
          lose(self, problem.message);
        end
      else
        chunk = reshape(uint8(fread(self.output, 65536, 'uint8')), 1, []);
        fclear(self.output);
      end
    end

    function ended = hasEnded(self)
      ended = strcmp(self.transport, 'bash') && waitpid(self.process, WNOHANG()) ~= 0;
    end

    function lose(self, why)
      close(self);
      error('clench:ConnectionLost', 'the connection is lost: %s', why);
    end

    function checkOpen(self)
      if ~self.isOpen, error('clench:ConnectionLost', 'the connection is closed'); end
    end
  end
end

function is = isOctave()
  is = exist('OCTAVE_VERSION', 'builtin') ~= 0;
end

function has = hasTcpclient()
  if isOctave()
    try
      pkg('load', 'instrument-control');
    catch
    end
  end
  has = exist('tcpclient') ~= 0;
end
