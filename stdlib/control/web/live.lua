--- The script of the live page that follows the world: JSON-RPC over a WebSocket, the places of bodies, contacts, forces and the camera. It follows the script of
--- the bodies; the script of the panels follows it.
return [==[
const caption = view.querySelector(".shown"), problem = document.getElementById("problem"), stats = document.documentElement.dataset;
const token = new URLSearchParams(location.search).get("token");
const rate = 30;  // of snapshots [Hz]
let socket = null, number = 0, latest = null;
const unanswered = new Map();  // requests without an answer, by id

function call(method, params) {
  return new Promise((resolve, reject) => {
    if (!socket || socket.readyState !== WebSocket.OPEN) return reject(new Error("there is no connection"));
    const id = ++number;
    unanswered.set(id, {resolve, reject});
    socket.send(JSON.stringify({jsonrpc: "2.0", id, method, params: params || {}}));
  });
}
const report = error => { problem.textContent = error ? error.message : ""; };

function receive(message) {
  if (message.method === "snapshot" && message.params.value) showState(message.params.value);
  if (message.method === "event") checkScene();
  const request = unanswered.get(message.id);
  if (!request) return;
  unanswered.delete(message.id);
  if (message.error) request.reject(new Error(message.error.message));
  else request.resolve(message.result);
}

async function begin() {
  await call("hello", {client: "live page", token: token || undefined});
  await call("subscribe", {event: "changed"});
  if (data.scene !== "") {
    await listRobots();
    await call("subscribe_state", {rate, poses: true, contacts: true});
  }
  stats.connected = "true";
  report(null);
}

function connect() {
  const address = new URL("socket" + location.search, location.href);
  address.protocol = location.protocol === "https:" ? "wss:" : "ws:";
  socket = new WebSocket(address);
  socket.onopen = () => begin().catch(report);
  socket.onmessage = event => receive(JSON.parse(event.data));
  socket.onclose = () => {
    caption.textContent = "no connection";
    stats.connected = "false";
    for (const request of unanswered.values()) request.reject(new Error("the connection was lost"));
    unanswered.clear();
    setTimeout(connect, 2000);
  };
}

// other bodies or shapes need another page; the camera stays
let checking = false;
async function checkScene() {
  if (checking) return;
  checking = true;
  await new Promise(resolve => setTimeout(resolve, 200));
  const scene = await call("world.list").then(list => list.scene, () => data.scene === "" ? "" : null);
  checking = false;
  if (scene === null || scene === data.scene) return;
  sessionStorage.setItem("camera", JSON.stringify({...orbit, target: orbit.target.toArray()}));
  location.reload();
}

// --- bodies, contacts and forces ---
const cones = new THREE.Group(), arrows = new THREE.Group();
scene.add(cones, arrows);
const forceLook = new THREE.MeshBasicMaterial({color: 0x1a56c4, depthTest: false, transparent: true});
const shaft = new THREE.CylinderBufferGeometry(1, 1, 1, 12).translate(0, 0.5, 0), tip = new THREE.ConeBufferGeometry(1, 1, 20).translate(0, 0.5, 0);
const isShown = name => document.getElementById(name).checked;
const sizes = () => parts.map((mesh, i) => data.parts[i].kind === "object" ? mesh.geometry.boundingSphere.radius : 0).filter(x => x > 0);
const size = Math.max(...sizes(), 0) || Math.max(...parts.map(mesh => mesh.geometry.boundingSphere.radius), 0.05);

function addArrow(at, force, scale) {
  const f = new THREE.Vector3(...force), length = f.length() * scale, width = 0.022 * size;
  if (!(length > 0.01 * size)) return;
  const turn = new THREE.Quaternion().setFromUnitVectors(new THREE.Vector3(0, 1, 0), f.normalize()), head = Math.min(4 * width, 0.5 * length);
  const line = new THREE.Mesh(shaft, forceLook), end = new THREE.Mesh(tip, forceLook);
  line.scale.set(width, length - head, width);
  end.scale.set(2.2 * width, head, 2.2 * width);
  for (const mesh of [line, end]) {
    mesh.quaternion.copy(turn);
    mesh.position.set(...at);
    mesh.renderOrder = 3;
    arrows.add(mesh);
  }
  end.position.addScaledVector(f, length - head);
}

// contact: as seen from the object, if only one of the two is one
function fromObject(contact, objects) {
  const turned = objects.has(contact.other) && !objects.has(contact.body);
  const of = v => turned ? v.map(x => -x) : v;
  return {...contact, body: turned ? contact.other : contact.body, other: turned ? contact.body : contact.other, normal: of(contact.normal), force: of(contact.force)};
}
const magnitude = v => Math.hypot(...v);

function showContacts(list) {
  cones.remove(...cones.children);
  arrows.remove(...arrows.children);
  const largest = Math.max(0, ...list.map(c => magnitude(c.force)));
  if (isShown("cones")) for (const c of list) addCone(cones, [...c.point, ...c.normal, c.mu, size]);
  if (isShown("forces") && largest > 0) for (const c of list) addArrow(c.point, c.force, 0.9 * size / largest);
  document.getElementById("scale").textContent = largest > 0 ? "longest arrow: " + largest.toPrecision(3) + " N" : "";
}

let isFirst = true;
function showState(state) {
  const objects = new Set(state.objects.map(one => one.body));
  state.contacts = (state.contacts || []).map(contact => fromObject(contact, objects));
  latest = state;
  stats.frames = Number(stats.frames || 0) + 1;
  caption.textContent = state.time.toFixed(3) + " s";
  refresh();
  if (isFirst) { isFirst = false; startView(); }
  showPanels(state);
}
refresh = () => {
  if (!latest) return;
  parts.forEach((mesh, i) => {
    const pose = latest.poses[data.parts[i].body];
    mesh.visible = pose !== undefined && !hidden.has(i);
    if (pose) place(mesh, pose);
  });
  showContacts(latest.contacts);
  redraw();
};

// --- the camera ---
function turn(azimuth, elevation) {
  orbit.azimuth = azimuth;
  orbit.elevation = elevation;
  redraw();
}
function frame() {
  const box = new THREE.Box3();
  addMoving(box);
  if (!box.isEmpty()) look(box);
  redraw();
}
function startView() {
  frame();
  const kept = JSON.parse(sessionStorage.getItem("camera") || "null");
  sessionStorage.removeItem("camera");
  if (kept) {
    Object.assign(orbit, {...kept, target: orbit.target.fromArray(kept.target)});
    redraw();
  }
  start();
}
for (const [name, angles] of [["front", [-Math.PI / 2, 0]], ["aside", [0, 0]], ["top", [-Math.PI / 2, 1.55]]])
  document.getElementById(name).addEventListener("click", () => turn(...angles));
document.getElementById("reset").addEventListener("click", frame);
for (const name of ["cones", "forces"]) document.getElementById(name).addEventListener("change", () => refresh());
document.getElementById("through").addEventListener("change", e => { setObjectOpacity(e.target.checked, 1); redraw(); });
setObjectOpacity(true, 1);
]==]
