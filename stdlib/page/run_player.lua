--- The script of a page that plays a recorded run; it follows the script of the scene.
return [==[
looks.object = paint(0x4fa3b8, {transparent: true, opacity: 1});
const parts = data.parts.map(solid), frames = new Float32Array(bytes(data.frames)), times = data.times;
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

// friction cones of a world at rest: the apex at the contact, the axis along the normal into the body
for (const [x, y, z, nx, ny, nz, mu, radius] of data.contacts || []) {
  const normal = new THREE.Vector3(nx, ny, nz), at = new THREE.Vector3(x, y, z), height = 0.16 * radius;
  const slope = Math.min(mu, 3), h = height / Math.sqrt(1 + slope * slope);
  const cone = new THREE.Mesh(new THREE.ConeBufferGeometry(h * slope, h, 40, 1, true), looks.cone);
  cone.quaternion.setFromUnitVectors(new THREE.Vector3(0, -1, 0), normal);
  cone.position.copy(at).addScaledVector(normal, h / 2);
  const dot = new THREE.Mesh(new THREE.SphereBufferGeometry(0.022 * radius, 16, 12), looks.point);
  dot.position.copy(at);
  scene.add(cone, dot);
}

// the bodies, each with a checkbox that hides it
const hidden = new Set(), bodies = document.getElementById("bodies");
data.parts.forEach((part, i) => {
  const label = document.createElement("label"), box = document.createElement("input");
  box.type = "checkbox";
  box.checked = true;
  box.addEventListener("change", () => { if (box.checked) hidden.delete(i); else hidden.add(i); showAt(Number(slider.value)); });
  label.append(box, " " + part.name);
  bodies.append(label);
});

// the view contains all moving parts of the first and the last frame; the floor, a scale of length, lies below them
const grid = new THREE.GridHelper(2, 40, 0x76828e, 0x9aa5b0);
grid.rotation.x = Math.PI / 2;
const hasObstacles = data.parts.some(part => part.kind === "obstacle");
if (!hasObstacles) { scene.add(grid); view.querySelector(".note").append(" \u00b7 squares: 5 cm"); }
// the camera distance at which all corners of a box are in the view, with a margin
function distanceTo(box) {
  const {azimuth, elevation, target} = orbit, tangent = Math.tan(camera.fov * Math.PI / 360), aspect = view.clientWidth / view.clientHeight || 1;
  const back = new THREE.Vector3(Math.cos(azimuth) * Math.cos(elevation), Math.sin(azimuth) * Math.cos(elevation), Math.sin(elevation));
  const right = new THREE.Vector3(-Math.sin(azimuth), Math.cos(azimuth), 0), up = back.clone().cross(right);
  let distance = 1e-3;
  for (const x of [box.min.x, box.max.x]) for (const y of [box.min.y, box.max.y]) for (const z of [box.min.z, box.max.z]) {
    const corner = new THREE.Vector3(x, y, z).sub(target);
    distance = Math.max(distance, corner.dot(back) + 1.06 * Math.max(Math.abs(corner.dot(up)), Math.abs(corner.dot(right)) / aspect) / tangent);
  }
  return distance;
}
function frame() {
  const box = new THREE.Box3(), now = Number(slider.value);
  for (const time of [last, first]) {
    showAt(time);
    scene.updateMatrixWorld(true);
    const moving = parts.filter((_, i) => data.parts[i].kind !== "obstacle");
    (moving.length > 0 ? moving : parts).forEach(mesh => { if (mesh.visible) box.expandByObject(mesh); });
  }
  showAt(now);
  const sphere = box.getBoundingSphere(new THREE.Sphere());
  orbit.target.copy(sphere.center);
  orbit.azimuth = -0.9;
  orbit.elevation = 0.45;
  orbit.distance = distanceTo(box);
  grid.position.set(sphere.center.x, sphere.center.y, box.min.z - 0.002);
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
if (renderer) {
  view.appendChild(renderer.domElement);
  window.addEventListener("resize", resize);
  resize();
  // number of sampled pixels that are not background
  const gl = renderer.getContext(), size = [gl.drawingBufferWidth, gl.drawingBufferHeight], pixel = new Uint8Array(4);
  let covered = 0;
  for (let x = 1; x < 24; ++x) for (let y = 1; y < 24; ++y) {
    gl.readPixels(size[0] * x / 24 | 0, size[1] * y / 24 | 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
    covered += pixel[3] > 0;
  }
  document.documentElement.dataset.drawn = covered;
}
requestAnimationFrame(tick);
]==]
