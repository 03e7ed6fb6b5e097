--- Subscriptions of JSON-RPC clients: to events, in order and without loss, and to snapshots, of which only the latest is sent.
local described = require "clench.described"
local failure = require "clench.control.rpc.failure"
local queries = require "clench.control.rpc.queries"
local values = require "clench.control.rpc.values"

local max_subscriptions = 32  -- of one client
local of_world = {contact = true, contact_lost = true, limit = true}
local of_session = {changed = true, diagnostic = true, result = true}

local function new_number(context)
  local client = context.client
  client.subscriptions = client.subscriptions or {}
  local n = 0
  for _ in pairs(client.subscriptions) do n = n + 1 end
  if n >= max_subscriptions then failure.raise("refused", "a client has at most %d subscriptions", max_subscriptions) end
  client.subscription_count = (client.subscription_count or 0) + 1
  return client.subscription_count
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

local function subscribe(context, args)
  local event = args.event
  if not of_world[event] and not of_session[event] then
    failure.raise("params", "event: expected contact, contact_lost, limit, changed, diagnostic or result, got %s", described(event))
  end
  local number = new_number(context)
  local client, notify = context.client, context.notify
  local function send(value) notify(client, "event", {subscription = number, event = event, value = value}) end
  local stop = of_world[event] and follow_world(context.session, event, send) or context.session:subscribe(event, send)
  client.subscriptions[number] = stop
  return {subscription = number}
end

local function snapshot_of(world, parts)
  local value = queries.state(world)
  if parts.poses then value.poses = queries.poses(world) end
  if parts.contacts then value.contacts = queries.contacts(world) end
  return value
end

local function snapshot_text(world, parts) return world and clench.json.encode(values.of(snapshot_of(world, parts))) or "null" end

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
  for _, subscriber in ipairs {table.unpack(group.subscribers)} do
    local client = subscriber.client
    -- a client that has not yet received the last one is sent a later one
    if client.port.queued == 0 and text ~= subscriber.last then
      subscriber.last = text
      client:send(('{"jsonrpc":"2.0","method":"snapshot","params":{"subscription":%d,"value":%s}}\n'):format(subscriber.number, text))
    end
  end
end

-- subscribers to the same content at the same rate share a timer and a text
local function group_of(server, parts)
  local period = period_of(parts.rate)
  local key = ("%.17g %s %s"):format(period, parts.poses, parts.contacts)
  local groups = server.snapshot_groups or {}
  server.snapshot_groups = groups
  if not groups[key] then
    local group = {parts = parts, subscribers = {}}
    group.timer = clench.loop.every(period, function() send_snapshots(server, group) end)
    function group.finish()
      group.timer:remove()
      groups[key] = nil
    end
    groups[key] = group
  end
  return groups[key]
end

local function remove(group, subscriber)
  for i, one in ipairs(group.subscribers) do
    if one == subscriber then table.remove(group.subscribers, i) break end
  end
  if #group.subscribers == 0 then group.finish() end
end

local function subscribe_state(context, args)
  local number, client = new_number(context), context.client
  local group, subscriber = group_of(context.server, args), {client = client, number = number}
  table.insert(group.subscribers, subscriber)
  client.subscriptions[number] = function() remove(group, subscriber) end
  return {subscription = number}
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
