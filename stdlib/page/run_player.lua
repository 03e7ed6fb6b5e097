--- The script of a page that plays a recorded run; it follows the script of the bodies.
return [==[
const frames = new Float32Array(bytes(data.frames)), times = data.times;
const first = times[0], last = times[times.length - 1], width = 7 * parts.length;
const slider = document.getElementById("time"), button = document.getElementById("play"), caption = view.querySelector(".shown");
slider.min = first;
slider.max = last > first ? last : first + 1;

// between two frames positions are interpolated linearly, and rotations along the shorter arc
const from = new THREE.Quaternion(), to = new THREE.Quaternion();
function showAt(time) {
  let k = 0;
  while (k + 1 < times.length && times[k + 1] <= time) ++k;
  const n = Math.min(k + 1, times.length - 1);
  const part = n > k ? Math.max(0, Math.min(1, (time - times[k]) / (times[n] - times[k]))) : 0;
  parts.forEach((mesh, i) => {
    const a = width * k + 7 * i, b = width * n + 7 * i;
    mesh.visible = !Number.isNaN(frames[a]) && !hidden.has(i);
    if (!mesh.visible) return;
    const other = Number.isNaN(frames[b]) ? a : b;
    for (const [j, axis] of ["x", "y", "z"].entries()) mesh.position[axis] = frames[a + j] + part * (frames[other + j] - frames[a + j]);
    from.set(frames[a + 4], frames[a + 5], frames[a + 6], frames[a + 3]);
    to.set(frames[other + 4], frames[other + 5], frames[other + 6], frames[other + 3]);
    THREE.Quaternion.slerp(from, to, mesh.quaternion, part);
  });
  slider.value = time;
  caption.textContent = (time - first).toFixed(2) + " s";
  redraw();
}

for (const contact of data.contacts || []) addCone(scene, contact);
data.parts.forEach((part, i) => addBox(bodies, part, i));
refresh = () => showAt(Number(slider.value));

// the view contains the bodies of the first and the last frame
function frame() {
  const box = new THREE.Box3(), now = Number(slider.value);
  for (const time of [last, first]) {
    showAt(time);
    addMoving(box);
  }
  showAt(now);
  look(box);
}

let plays = times.length > 1 && data.plays !== false, now = first, before = null;
const speed = document.getElementById("speed");
speed.value = [0.1, 0.25, 0.5, 1, 2].reduce((a, b) => Math.abs(b - data.speed) < Math.abs(a - data.speed) ? b : a);
function tick(clock) {
  if (plays) {
    if (before !== null) now += Number(speed.value) * (clock - before) / 1000;
    if (now > last) now = first;
    showAt(now);
  }
  before = clock;
  requestAnimationFrame(tick);
}
function toggle() { plays = !plays; button.textContent = plays ? "pause" : "play"; }
button.textContent = plays ? "pause" : "play";
button.addEventListener("click", toggle);
document.addEventListener("keydown", e => { if (e.key === " " && e.target.tagName !== "BUTTON") { e.preventDefault(); toggle(); } });
slider.addEventListener("input", () => { if (plays) toggle(); now = Number(slider.value); showAt(now); });
document.getElementById("reset").addEventListener("click", () => { frame(); redraw(); });
document.getElementById("through").addEventListener("change", e => {
  setObjectOpacity(e.target.checked, 1);
  redraw();
});

slider.value = first;
frame();
start();
requestAnimationFrame(tick);
]==]
