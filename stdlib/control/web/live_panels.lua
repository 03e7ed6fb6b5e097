--- The script of the live page's panels: the tree of bodies, DOFs with their sliders, contacts and plots. It follows the script of the world, and connects.
return [==[
const element = (kind, text, to) => {
  const made = document.createElement(kind);
  if (text !== undefined) made.textContent = text;
  if (to) to.append(made);
  return made;
};
const shown = x => x === null ? "–" : Math.abs(x) >= 1e5 ? x.toExponential(2) : x.toFixed(Math.abs(x) < 10 ? 3 : 1);

// --- the tree: robots with their links, then other bodies ---
const branches = {};
data.parts.forEach((part, i) => {
  if (part.robot !== undefined && !branches[part.robot]) {
    branches[part.robot] = element("details", undefined, bodies);
    branches[part.robot].open = true;
    element("summary", part.robot, branches[part.robot]);
  }
});
data.parts.forEach((part, i) => addBox(part.robot === undefined ? bodies : branches[part.robot], part, i));

// --- DOFs: a slider for each where the server lets the page move them ---
const rows = new Map();  // by robot: {dofs, inputs, outputs, held, isSending, next}
function addDof(robot, row, i, name, limits, to) {
  const label = element("label", undefined, to), words = element("span", name, label);
  words.title = name;
  const input = element("input", undefined, label), output = element("output", "", label);
  input.type = "range";
  const [low, high] = limits || [null, null];
  input.min = low === null ? -Math.PI : low;
  input.max = high === null ? Math.PI : high;
  input.step = "any";
  input.disabled = !data.control;
  input.addEventListener("pointerdown", () => { row.held = i; });
  for (const kind of ["pointerup", "pointercancel", "change"]) input.addEventListener(kind, () => { row.held = null; });
  input.addEventListener("input", () => { row.next = row.inputs.map((one, k) => k === i ? Number(input.value) : row.dofs[k]); send(robot, row); });
  row.inputs.push(input);
  row.outputs.push(output);
}
// one request at a time; of positions that come meanwhile the last one counts
async function send(robot, row) {
  if (row.isSending) return;
  row.isSending = true;
  while (row.next) {
    const dofs = row.next;
    row.next = null;
    await call("grasp.dofs", {hand: robot, dofs}).then(() => report(null), report);
  }
  row.isSending = false;
}
async function listRobots() {
  const list = await call("world.list"), panel = document.getElementById("dofs");
  panel.textContent = "";
  rows.clear();
  for (const robot of list.robots) {
    const {dof_limits, dof_names, dofs} = await call("get", {of: robot, fields: ["dof_limits", "dof_names", "dofs"]});
    const row = {dofs, inputs: [], outputs: [], held: null, isSending: false, next: null};
    element("h3", robot, panel);
    dofs.forEach((_, i) => addDof(robot, row, i, dof_names[i], dof_limits[i], panel));
    rows.set(robot, row);
  }
  if (data.control) addUndo(panel);
  else if (list.robots.length > 0) element("p", "This page shows the world only: the server was started without --control.", panel);
}
function addUndo(panel) {
  const place = element("div", undefined, panel);
  for (const verb of ["undo", "redo"]) {
    const button = element("button", verb, place);
    button.type = "button";
    button.addEventListener("click", () => call("session." + verb).then(() => report(null), report));
  }
}
function showDofs(state) {
  for (const {robot, dofs} of state.robots) {
    const row = rows.get(robot);
    if (!row) continue;
    row.dofs = dofs;
    dofs.forEach((value, i) => {
      if (row.held !== i && document.activeElement !== row.inputs[i] || !data.control) row.inputs[i].value = value;
      row.outputs[i].textContent = shown(value);
    });
  }
}

// --- contacts ---
const maxRows = 40;
function showTouches(list) {
  const table = document.getElementById("touches");
  document.getElementById("count").textContent = list.length;
  table.textContent = "";
  if (list.length === 0) return;
  const head = element("tr", undefined, table);
  for (const word of ["bodies", "force [N]", "gap [mm]"]) element("th", word, head);
  for (const c of list.slice(0, maxRows)) {
    const row = element("tr", undefined, table);
    for (const word of [c.body + " · " + c.other, shown(magnitude(c.force)), shown(1000 * c.gap)]) element("td", word, row);
  }
  if (list.length > maxRows) element("td", "and " + (list.length - maxRows) + " more", element("tr", undefined, table));
}

// --- plots of quantities over the last seconds ---
const span = 20;  // [s]
function quantitiesOf(state) {
  const found = new Map();
  for (const one of state.robots) for (const [field, word] of [["dofs", "DOF"], ["dof_velocities", "velocity of DOF"], ["dof_efforts", "effort of DOF"]])
    (one[field] || []).forEach((x, i) => found.set(one.robot + ": " + word + " " + (i + 1), x));
  for (const one of state.objects) {
    ["x", "y", "z"].forEach((axis, i) => found.set(one.body + ": " + axis + " [m]", one.pose.xyz[i]));
    found.set(one.body + ": speed [m/s]", magnitude(one.velocity.linear));
  }
  found.set("contacts", state.contacts.length);
  found.set("largest contact force [N]", Math.max(0, ...state.contacts.map(c => magnitude(c.force))));
  return found;
}
const plots = new Map();  // by name: {canvas, last, points}
function addPlot(name) {
  if (plots.has(name)) return;
  const figure = element("figure", undefined, document.getElementById("plots")), words = element("figcaption", undefined, figure);
  element("span", name, words);
  const last = element("output", "", words), close = element("button", "×", words);
  close.type = "button";
  close.setAttribute("aria-label", "close " + name);
  const plot = {canvas: element("canvas", undefined, figure), last, points: []};
  close.addEventListener("click", () => { plots.delete(name); figure.remove(); });
  plots.set(name, plot);
}
function drawPlot({canvas, points}) {
  const ratio = window.devicePixelRatio || 1, width = canvas.clientWidth, height = canvas.clientHeight, now = performance.now() / 1000;
  canvas.width = width * ratio;
  canvas.height = height * ratio;
  const pen = canvas.getContext("2d");
  pen.scale(ratio, ratio);
  const min = Math.min(...points.map(p => p[1])), max = Math.max(...points.map(p => p[1]));
  const margin = Math.max((max - min) * 0.1, 1e-9, 1e-4 * Math.abs(max)), low = min - margin, high = max + margin;
  pen.strokeStyle = "#1f6feb";
  pen.lineWidth = 1.5;
  pen.beginPath();
  let before = null;
  for (const [time, x] of [...points, [now, points[points.length - 1][1]]]) {
    const u = width * (1 - (now - time) / span), v = height * (high - x) / (high - low);
    if (before !== null) pen.lineTo(u, before);  // a state holds until the next
    pen.lineTo(u, v);
    before = v;
  }
  pen.stroke();
  pen.fillStyle = "#5d6b7a";
  pen.font = "10px sans-serif";
  pen.fillText(shown(max), 3, 11);
  pen.fillText(shown(min), 3, height - 4);
}
function addPoints(state) {
  const now = performance.now() / 1000, found = quantitiesOf(state);
  for (const [name, plot] of plots) {
    const x = found.get(name);
    if (typeof x !== "number") continue;
    plot.points.push([now, x]);
    while (plot.points.length > 1 && plot.points[1][0] < now - span) plot.points.shift();
    plot.last.textContent = shown(x);
  }
}
const choice = document.getElementById("quantity");
function listQuantities(state) {
  if (choice.options.length > 0) return;
  for (const name of quantitiesOf(state).keys()) element("option", name, choice);
}
document.getElementById("plot").addEventListener("click", () => { addPlot(choice.value); if (latest) addPoints(latest); });
setInterval(() => { for (const plot of plots.values()) if (plot.points.length > 0) drawPlot(plot); }, 100);

function showPanels(state) {
  listQuantities(state);
  showDofs(state);
  showTouches(state.contacts);
  addPoints(state);
}

connect();
]==]
