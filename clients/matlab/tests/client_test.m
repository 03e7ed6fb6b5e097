% Both clients against clench serve worlds/barrett_mug.wld, by each available transport:
%   CLENCH_URL='tcp://127.0.0.1:4765/?token=...' CLENCH_PROCESS=1234 octave-cli clients/matlab/tests/client_test.m
function client_test()
  folder = fileparts(mfilename('fullpath'));
  addpath(fullfile(folder, '..'));
  transports = {'bash'};
  if exist('OCTAVE_VERSION', 'builtin')
    try
      pkg('load', 'instrument-control');
    catch
    end
  else
    transports = {};
  end
  if exist('tcpclient') ~= 0, transports{end + 1} = 'tcpclient'; end
  url = getenv('CLENCH_URL');
  for i = 1:numel(transports)
    client = ClenchClient(url, transports{i});
    commandsAct(client);
    valuesTravelWhole(client);
    errorsHaveIdentifiers(client, url, transports{i});
    notificationsArrive(client);
    searchesAreJobs(client);
    parts = regexp(url, ':(\d+)/', 'tokens', 'once');
    graspitServer('open', '127.0.0.1', str2double(parts{1}), transports{i});
    wrappersAgree(client);
    wrappersMove(client);
    wrappersStep(client);
    wrappersRefuse();
    graspitServer('close');
    connectionsEndInAnyOrder(client, url, transports{i});
    last{i} = ClenchClient(url, transports{i});
    printf('passed by %s\n', transports{i});
  end
  lostConnectionsAreErrors(last);
end

% ends the server
function lostConnectionsAreErrors(clients)
  system(['kill ' getenv('CLENCH_PROCESS')]);
  for i = 1:numel(clients), fails(@() clients{i}.call('world.hash'), 'clench:ConnectionLost'); end
  disp('passed at the end of the server');
end

function connectionsEndInAnyOrder(client, url, transport)
  second = ClenchClient(url, transport);
  client.close();
  fails(@() client.call('world.hash'), 'clench:ConnectionLost');
  second.call('world.hash');
  second.close();
end

function same(got, expected, what)
  if ~isequal(got, expected), error('%s: expected %s, got %s', what, disp(expected), disp(got)); end
end

function near(got, expected, tolerance, what)
  if ~isequal(size(got), size(expected)) || any(abs(got(:) - expected(:)) > tolerance)
    error('%s: expected %s, got %s', what, mat2str(expected), mat2str(got));
  end
end

function fails(call, identifier, part)
  try
    call();
  catch problem
    same(problem.identifier, identifier, ['identifier of: ' problem.message]);
    if nargin > 2 && isempty(strfind(problem.message, part)), error('expected ''%s'' in: %s', part, problem.message); end
    return
  end
  error('expected an error %s', identifier);
end

function commandsAct(c)
  c.call('grasp.open');
  before = c.call('world.hash');
  result = c.call('grasp.autograsp', 'hand', 'barrett');
  same(result.moved, true, 'autograsp moves');
  if isequal(c.call('world.hash'), before), error('the world has not changed'); end
  same(c.call('session.undo'), 'Auto Grasp', 'undo');
  same(c.call('world.hash'), before, 'hash after undo');
  c.set('barrett', 'dofs', [0.1 0.2 0.3 0.4]);
  near(c.get('barrett', 'dofs'), [0.1; 0.2; 0.3; 0.4], 1e-15, 'dofs');
  c.call('session.undo');
  c.set('mug', 'mass', 0.25);
  same(c.get('mug', 'mass'), 0.25, 'mass');
  c.call('session.undo');
  result = c.call('dynamics.step', struct('count', 2));
  same(result.applied, true, 'a long command');
  c.call('session.undo');
  began = c.get('', 'time');
  state = c.call('step', 'targets', struct('barrett', [0 1 1 1]), 'dt', 0.01);
  near(state.time, began + 0.01, 1e-12, 'step');
end

function valuesTravelWhole(c)
  name = ['a ' char([195 164]) ' "box"'];  % two bytes of UTF-8
  if ~exist('OCTAVE_VERSION', 'builtin'), name = ['a ' char(228) ' "box"']; end
  answer = c.call('describe', 'method', 'world.hash');
  same(answer.reads, true, 'describe');
  fails(@() c.call('body.mass', 'body', name, 'mass', 1), 'clench:Failed', name);
  same(c.call('world.raycast', 'origin', [0 0 9], 'direction', [0 0 1]), [], 'null');
  if numel(c.call('world.state').robots(1).dofs) ~= 4, error('a state has four DOFs'); end
end

function errorsHaveIdentifiers(c, url, transport)
  fails(@() c.call('no.such'), 'clench:MethodNotFound');
  fails(@() c.call('grasp.autograsp', 'speeed', 1), 'clench:InvalidParams');
  fails(@() c.call('world.save_as', 'path', 'x.wld'), 'clench:Refused');
  fails(@() c.call('world.hash', 'x'), 'clench:InvalidParams', 'expected names and values');
  fails(@() c.set('mug', 'name', 'x'), 'clench:InvalidParams');
  fails(@() ClenchClient(url(1:end - 1), transport), 'clench:Unauthorized');
  fails(@() ClenchClient('http://x', transport), 'clench:InvalidParams');
  fails(@() ClenchClient('tcp://127.0.0.1:1/?token=x', transport), 'clench:ConnectionLost');
end

function notificationsArrive(c)
  number = c.subscribe('changed');
  c.set('mug', 'mass', 0.5);
  [method, params] = c.nextNotification(10);
  same({method, params.subscription, params.event}, {'event', number, 'changed'}, 'notification');
  c.call('unsubscribe', 'subscription', number);
  c.call('session.undo');
  fails(@() c.nextNotification(0.05), 'clench:Timeout');
  c.call('world.hash');
end

function searchesAreJobs(c)
  job = c.plan('sample', 'object', 'mug', 'count', 1, 'seed', 1, 'refine', 1);
  found = c.wait(job, 60);
  same(numel(found.grasps), 1, 'grasps of a search');
  while true  % notifications of the job
    try
      c.nextNotification(0);
    catch
      break
    end
  end
end

% wrappers and JSON-RPC report the same values
function wrappersAgree(c)
  world = c.call('world.list');
  same(getRobotName(), {'barrett'}, 'getRobotName');
  same(getRobotName(1), 'barrett', 'getRobotName');
  names = getBodyName();
  same(numel(names), numel(world.bodies), 'getBodyName');
  mug = find(strcmp(names, 'mug'));
  same(getBodyName([mug 1]), {'mug', names{1}}, 'getBodyName of a list');
  dofs = c.get('barrett', 'dofs');
  near(getDOFVals(1), dofs', 1e-6, 'getDOFVals');
  near(getDOFVals(){1}, dofs', 1e-6, 'getDOFVals of all');
  c.call('grasp.autograsp');
  contacts = c.call('world.contacts', 'a', 'barrett', 'b', 'mug');
  [wrenches, locations, errors] = getContacts(mug);
  same([size(wrenches), size(locations), size(errors)], [numel(contacts) 6 numel(contacts) 3 numel(contacts) 1], 'getContacts');
  pose = c.get('mug', 'pose');
  near(pose.quat', [1 0 0 0], 1e-9, 'the mug is not turned');
  found = sortrows(round(locations * 1e3));
  expected = zeros(numel(contacts), 3);
  for i = 1:numel(contacts), expected(i, :) = 1e3 * (contacts(i).point' - pose.xyz'); end
  near(found, sortrows(round(expected * 1e3)), 1, 'locations [um]');
  [wrench, location] = getAverageContacts(mug);
  near(wrench, mean(wrenches, 1), 1e-6, 'mean wrench');
  near(location, mean(locations, 1), 1e-3, 'mean location');
  all = getContacts('ALL');
  same(numel(all), numel(names), 'getContacts of all');
  same(size(all{mug}), size(wrenches), 'getContacts of all');
  c.call('session.undo');
end

function wrappersMove(c)
  c.call('grasp.open');
  actual = moveDOFs(1, [0 0.3 0.2 0.1], [1 1 1 1]);
  near(actual, [0 0.3 0.2 0.1], 1e-6, 'moveDOFs');
  near(c.get('barrett', 'dofs')', actual, 1e-6, 'moveDOFs');
  near(moveDOFs(1, [0 0.1 0.1 0.1]), [0 0.1 0.1 0.1], 1e-6, 'moveDOFs without steps');
  near(setDOFVals(1, [0 0.2 0.2 0.2], [1 1 1 1]), [0 0.2 0.2 0.2], 1e-6, 'setDOFVals');
  near(setDOFForces(1, [0 1 1 1]), [0 1 1 1], 1e-6, 'setDOFForces');
  same(c.get('barrett', 'controller'), 'effort', 'controller');
  before = c.get('barrett', 'pose');
  moveToContacts();
  getRobotName(1);
  after = c.get('barrett', 'pose');
  if norm(after.xyz - before.xyz) > 0.0301, error('moveToContacts goes at most 30 mm'); end
  render();
end

function wrappersStep(c)
  began = c.get('', 'time');
  passed = moveDynamicBodies(0.001);
  same(computeNewVelocities(0.001), 0, 'computeNewVelocities');
  passed = passed + moveDynamicBodies() + stepDynamics();
  near(c.get('', 'time'), began + passed, 1e-9, 'time');
end

function wrappersRefuse()
  fails(@() getDOFVals(7), 'clench:Failed', 'Cannot find robot 6');
  fails(@() moveDOFs(1, [1 2], [1 1]), 'clench:Failed', 'robot has 4 DOF');
  same(getRobotName(1), 'barrett', 'the connection continues');
  fails(@() setDOFVals(1, [1 2], [1 1]), 'clench:Failed', 'robot has 4 DOF');
  same(getRobotName(1), 'barrett', 'replies to the lines of a rejected command are dropped');
  graspitServer('send', 'moveToContacts 5');
  fails(@() getRobotName(1), 'clench:Failed', 'one word too many: 5');
  fails(@() moveDynamicBodies(-1), 'clench:Failed', 'expected a time > 0');
  fails(@() getBodyName(0), 'clench:InvalidParams', 'expected indices from 1');
  fails(@() getBodyName('all'), 'clench:InvalidParams');
  fails(@() setDOFForces([1 2], [0 0 0 0]), 'clench:InvalidParams', 'a vector per robot');
  same(getRobotName(1), 'barrett', 'the connection continues');
end
