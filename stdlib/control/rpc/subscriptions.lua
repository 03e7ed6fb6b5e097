--- Subscriptions of JSON-RPC clients: to events, in order and without loss, and to snapshots, of which only the latest is sent.
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
    failure.raise("params", "event: expected contact, contact_lost, limit, changed, diagnostic or result, got %s", event)
  end
  local number = new_number(context)
  local client, notify = context.client, context.notify
  local function send(value) notify(client, "event", {subscription = number, event = event, value = value}) end
  local stop = of_world[event] and follow_world(context.session, event, send) or context.session:subscribe(event, send)
  client.subscriptions[number] = stop
  return {subscription = number}
end

-- the text of a snapshot, created once for all clients with the same request at the same time
local function snapshot_text(server)
  local world = server.session.world
  if not world then return "null" end
  local kept = server.snapshot
  local now = clench.loop.time()
  if not kept or now - kept.time > 0.0005 then
    kept = {time = now, text = clench.json.encode(values.of(queries.state(world)))}
    server.snapshot = kept
  end
  return kept.text
end

local function subscribe_state(context, args)
  local number = new_number(context)
  local client, server, last = context.client, context.server, nil
  local timer = clench.loop.every(1 / args.rate, function()
    if client.port.queued > 0 then return end  -- a later one replaces it
    local text = snapshot_text(server)
    if text == last then return end
    last = text
    client:send(('{"jsonrpc":"2.0","method":"snapshot","params":{"subscription":%d,"value":%s}}\n'):format(number, text))
  end)
  client.subscriptions[number] = function() timer:remove() end
  return {subscription = number}
end

local subscriptions = {}

--- Ends all subscriptions of a client that has disconnected.
function subscriptions.drop(client)
  for _, stop in pairs(client.subscriptions or {}) do stop() end
  client.subscriptions = {}
end

subscriptions.methods = {
  {name = "subscribe", text = "Sends each event of a kind as a notification \"event\": in order, and none is lost.",
   parameters = {{name = "event", type = "string", text = "contact, contact_lost, limit (of the running world); changed, diagnostic, result (of the session)"}}, run = subscribe},
  {name = "subscribe_state", text = "Sends the state of the world as a notification \"snapshot\" whenever it has changed, as of world.state.",
   parameters = {{name = "rate", type = "number", min = 0.01, max = 1000, default = 30, unit = "Hz", text = "maximum rate"}}, run = subscribe_state},
  {name = "unsubscribe", text = "Ends a subscription.", parameters = {{name = "subscription", type = "integer", text = "its number"}}, run = function(context, args)
    local list = context.client.subscriptions or {}
    local stop = list[args.subscription] or failure.raise("params", "subscription: there is no subscription %d", args.subscription)
    stop()
    list[args.subscription] = nil
  end},
}

return subscriptions
