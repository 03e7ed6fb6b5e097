--- Subscriptions of JSON-RPC clients: to events, in order and without loss, and to snapshots, of which only the latest is sent.
local described = require "clench.described"
local failure = require "clench.control.rpc.failure"
local queries = require "clench.control.rpc.queries"
local values = require "clench.control.rpc.values"

local max_subscriptions = 32  -- of one client
local of_world = {contact = true, contact_lost = true, limit = true}
local of_session = {changed = true, diagnostic = true, result = true}

local function check_number(client)
  client.subscriptions = client.subscriptions or {}
  local n = 0
  for _ in pairs(client.subscriptions) do n = n + 1 end
  if n >= max_subscriptions then failure.raise("refused", "a client has at most %d subscriptions", max_subscriptions) end
end

-- listens to a world, and to the one that replaces it
local function follow_world(session, event, f)
  local handle, world
  local function attach()
    if session.world == world then return end
    if handle then handle:remove() end
    world = session.world
    handle = world and world:on(event, f)
  end
  attach()
  local unsubscribe = session:subscribe("changed", attach)
  return function()
    unsubscribe()
    if handle then handle:remove() end
  end
end

local function remove(group, subscriber)
  for i, one in ipairs(group.subscribers) do
    if one == subscriber then table.remove(group.subscribers, i) break end
  end
  if #group.subscribers == 0 then group.finish() end
end

-- adds a client to a group, until it unsubscribes; returns the result of the request
local function join(context, group)
  local client = context.client
  client.subscription_count = (client.subscription_count or 0) + 1
  local number = client.subscription_count
  local subscriber = {client = client, head = group.head:format(number)}
  table.insert(group.subscribers, subscriber)
  client.subscriptions[number] = function() remove(group, subscriber) end
  return {subscription = number}
end

-- sends an event to all subscribers of a group
local function send_event(group, value)
  local tail = values.text(values.of(value)) .. "}}\n"
  for _, subscriber in ipairs {table.unpack(group.subscribers)} do subscriber.client:send(subscriber.head .. tail) end
end

-- subscribers to the same event share a listener and a text
local function event_group_of(server, event)
  local groups, session = server.event_groups or {}, server.session
  server.event_groups = groups
  if not groups[event] then
    local group = {subscribers = {}, head = ('{"jsonrpc":"2.0","method":"event","params":{"event":"%s","subscription":%%d,"value":'):format(event)}
    local function send(value) send_event(group, value) end
    local stop = of_world[event] and follow_world(session, event, send) or session:subscribe(event, send)
    function group.finish()
      stop()
      groups[event] = nil
    end
    groups[event] = group
  end
  return groups[event]
end

local function subscribe(context, args)
  local event = args.event
  if not of_world[event] and not of_session[event] then
    failure.raise("params", "event: expected contact, contact_lost, limit, changed, diagnostic or result, got %s", described(event))
  end
  check_number(context.client)
  return join(context, event_group_of(context.server, event))
end

local function snapshot_of(world, parts)
  local value = queries.state(world)
  if parts.poses then value.poses = queries.poses(world) end
  if parts.contacts then value.contacts = queries.contacts(world) end
  return value
end

local function snapshot_text(world, parts) return world and values.text(values.of(snapshot_of(world, parts))) or "null" end

local reused_for = 4  -- times as long as it took to make it

-- The text of a snapshot. Groups of other rates share it for a short time, so that however many there are, they leave time for requests.
local function shared_text(server, parts)
  local world, now, key = server.session.world, clench.clock(), ("%s %s"):format(parts.poses, parts.contacts)
  local texts = server.snapshot_texts or {}
  server.snapshot_texts = texts
  local kept = texts[key]
  if kept and kept.world == world and now < kept.until_time then return kept.text end
  local text = snapshot_text(world, parts)
  texts[key] = {world = world, text = text, until_time = now + reused_for * (clench.clock() - now)}
  return text
end

-- the period of a rate: above 50 Hz whole milliseconds, so that similar rates share a timer [s]
local function period_of(rate) return rate > 50 and math.ceil(1000 / rate - 1e-9) / 1000 or 1 / rate end

-- sends a snapshot to the subscribers of a group whose last one differs from it
local function send_snapshots(server, group)
  local text = shared_text(server, group.parts)
  local tail = text .. "}}\n"
  for _, subscriber in ipairs {table.unpack(group.subscribers)} do
    local client = subscriber.client
    -- a client that has not yet received the last one is sent a later one
    if client.port.queued == 0 and text ~= subscriber.last then
      subscriber.last = text
      client:send(subscriber.head .. tail)
    end
  end
end

-- subscribers to the same content at the same rate share a timer and a text
local function state_group_of(server, parts)
  local period = period_of(parts.rate)
  local key = ("%.17g %s %s"):format(period, parts.poses, parts.contacts)
  local groups = server.snapshot_groups or {}
  server.snapshot_groups = groups
  if not groups[key] then
    local group = {parts = parts, subscribers = {}, head = '{"jsonrpc":"2.0","method":"snapshot","params":{"subscription":%d,"value":'}
    group.timer = clench.loop.every(period, function() send_snapshots(server, group) end)
    function group.finish()
      group.timer:remove()
      groups[key] = nil
    end
    groups[key] = group
  end
  return groups[key]
end

local function subscribe_state(context, args)
  check_number(context.client)
  return join(context, state_group_of(context.server, args))
end

local subscriptions = {}

--- Ends all subscriptions of a client that has disconnected.
function subscriptions.drop(client)
  for _, stop in pairs(client.subscriptions or {}) do stop() end
  client.subscriptions = {}
end

subscriptions.methods = {
  {name = "subscribe", reads = true, text = "Sends each event of a kind as a notification \"event\": in order, and none is lost.",
   parameters = {{name = "event", type = "string", text = "contact, contact_lost, limit (of the running world); changed, diagnostic, result (of the session)"}}, run = subscribe},
  {name = "subscribe_state", reads = true, text = "Sends the state of the world as a notification \"snapshot\" whenever it has changed, as of world.state.",
   parameters = {{name = "rate", type = "number", min = 0.01, max = 1000, default = 30, unit = "Hz", text = "maximum rate"},
                 {name = "poses", type = "boolean", default = false, text = "true: with the poses of all bodies, seven numbers each: x y z [m], quaternion w x y z"},
                 {name = "contacts", type = "boolean", default = false, text = "true: with all contacts, as of world.contacts"}}, run = subscribe_state},
  {name = "unsubscribe", reads = true, text = "Ends a subscription.", parameters = {{name = "subscription", type = "integer", text = "its number"}}, run = function(context, args)
    local list = context.client.subscriptions or {}
    local stop = list[args.subscription] or failure.raise("params", "subscription: there is no subscription %d", args.subscription)
    stop()
    list[args.subscription] = nil
  end},
}

return subscriptions
