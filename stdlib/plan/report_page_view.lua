--- The script of a report page that draws a grasp in 3-D, with three.js (written for its version 111).
return [==[
"use strict";
const data = JSON.parse(document.getElementById("data").textContent);
const view = document.getElementById("view");

const bytes = text => Uint8Array.from(atob(text), c => c.charCodeAt(0)).buffer;

// triangles with normals of their own: smooth where neighbours differ by less than 35 degrees, sharp at edges
function geometryOf(mesh) {
  const p = new Float32Array(bytes(mesh.positions));
  const index = mesh.wide ? new Uint32Array(bytes(mesh.indices)) : new Uint16Array(bytes(mesh.indices));
  const count = index.length / 3, area = new Float32Array(3 * count), unit = new Float32Array(3 * count);
  const first = new Uint32Array(p.length / 3 + 1), around = new Uint32Array(index.length);
  for (let t = 0; t < count; ++t) {
    const [a, b, c] = [3 * index[3 * t], 3 * index[3 * t + 1], 3 * index[3 * t + 2]];
    const u = [p[b] - p[a], p[b + 1] - p[a + 1], p[b + 2] - p[a + 2]], v = [p[c] - p[a], p[c + 1] - p[a + 1], p[c + 2] - p[a + 2]];
    const n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
    const length = Math.hypot(...n) || 1;
    for (let k = 0; k < 3; ++k) { area[3 * t + k] = n[k]; unit[3 * t + k] = n[k] / length; }
  }
  for (const v of index) ++first[v + 1];
  for (let v = 1; v < first.length; ++v) first[v] += first[v - 1];
  const next = first.slice();
  for (let i = 0; i < index.length; ++i) around[next[index[i]]++] = (i / 3) | 0;
  const points = new Float32Array(3 * index.length), normals = new Float32Array(3 * index.length);
  const least = Math.cos(35 * Math.PI / 180);
  for (let i = 0; i < index.length; ++i) {
    const t = 3 * ((i / 3) | 0), v = index[i];
    let x = 0, y = 0, z = 0;
    for (let k = first[v]; k < first[v + 1]; ++k) {
      const o = 3 * around[k];
      if (unit[t] * unit[o] + unit[t + 1] * unit[o + 1] + unit[t + 2] * unit[o + 2] < least) continue;
      x += area[o]; y += area[o + 1]; z += area[o + 2];
    }
    const length = Math.hypot(x, y, z) || 1;
    points.set(p.subarray(3 * v, 3 * v + 3), 3 * i);
    normals.set([x / length, y / length, z / length], 3 * i);
  }
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.BufferAttribute(points, 3));
  geometry.setAttribute("normal", new THREE.BufferAttribute(normals, 3));
  geometry.computeBoundingSphere();
  return geometry;
}

const paint = (color, more) => {
  const material = new THREE.MeshStandardMaterial(Object.assign({color, roughness: 0.55, metalness: 0.05}, more));
  material.color.convertSRGBToLinear();
  return material;
};

function place(mesh, n) {
  mesh.position.set(n[0], n[1], n[2]);
  mesh.quaternion.set(n[4], n[5], n[6], n[3]);
}

let renderer = null;
try {
  renderer = new THREE.WebGLRenderer({antialias: true, alpha: true});
  renderer.gammaOutput = true;
  renderer.gammaFactor = 2.2;
} catch (_) {
  view.querySelector(".note").textContent = "This browser draws no WebGL: the table and its pictures remain.";
}
const scene = new THREE.Scene(), camera = new THREE.PerspectiveCamera(32, 1, 0.001, 100);
camera.up.set(0, 0, 1);
scene.add(camera);
scene.add(new THREE.HemisphereLight(0xffffff, 0x8a8f98, 0.6));
const lamp = new THREE.DirectionalLight(0xfff8f0, 0.7), fill = new THREE.DirectionalLight(0xe6eeff, 0.2);
lamp.position.set(-0.6, 0.9, 0.6);
fill.position.set(0.9, -0.1, 0.5);
camera.add(lamp, lamp.target, fill, fill.target);

const looks = {
  link: paint(0xa9b4c2), base: paint(0x59626e), obstacle: paint(0xcfc8b8),
  object: paint(0x4fa3b8, {transparent: true, opacity: 0.34, depthWrite: false}),
  cone: paint(0xf4511e, {side: THREE.DoubleSide}), point: paint(0x8e1b0a),
};
const geometries = data.meshes.map(geometryOf);
const solid = part => {
  const mesh = new THREE.Mesh(geometries[part.mesh], looks[part.kind]);
  if (part.kind === "object") mesh.renderOrder = 2;
  scene.add(mesh);
  return mesh;
};
const still = data.still.map(part => { const mesh = solid(part); place(mesh, part.pose); return mesh; });
const moving = data.parts.map(solid);
const touches = new THREE.Group();
place(touches, data.object_pose);
scene.add(touches);

// friction cones: the apex at the contact, the axis along the normal into the object
function showContacts(points) {
  touches.children.slice().forEach(child => { touches.remove(child); child.geometry.dispose(); });
  const height = 0.16 * data.object_radius;
  for (const [x, y, z, nx, ny, nz, mu] of points) {
    const normal = new THREE.Vector3(nx, ny, nz), at = new THREE.Vector3(x, y, z);
    const slope = Math.min(mu, 3), h = height / Math.sqrt(1 + slope * slope);
    const cone = new THREE.Mesh(new THREE.ConeBufferGeometry(h * slope, h, 40, 1, true), looks.cone);
    cone.quaternion.setFromUnitVectors(new THREE.Vector3(0, -1, 0), normal);
    cone.position.copy(at).addScaledVector(normal, h / 2);
    const dot = new THREE.Mesh(new THREE.SphereBufferGeometry(0.022 * data.object_radius, 16, 12), looks.point);
    dot.position.copy(at);
    touches.add(cone, dot);
  }
}

// the floor that tells lengths: squares of 5 cm below everything, where no obstacle stands
let grid = null;
if (data.still.length === 1 && data.still[0].kind === "object") {
  grid = new THREE.GridHelper(1, 20, 0x76828e, 0x9aa5b0);
  grid.rotation.x = Math.PI / 2;
  scene.add(grid);
  view.querySelector(".note").append(" \u00b7 squares: 5 cm");
}

// --- the camera: azimuth and elevation about a target ---
const orbit = {target: new THREE.Vector3(), distance: 1, azimuth: 0, elevation: 0.4, turned: false};

// the side from which fingers hide the fewest contacts, the hand's base is not in front, and no obstacle either
function sideThatShows(item) {
  const normals = item.points.map(p => new THREE.Vector3(p[3], p[4], p[5]).applyQuaternion(touches.quaternion));
  const way = new THREE.Vector3(...item.approach), ray = new THREE.Raycaster();
  const obstacles = still.filter((_, i) => data.still[i].kind === "obstacle");
  let best = [-1, 0.4], most = -Infinity;
  for (const elevation of [0.3, 0.6, 0.95]) for (let i = 0; i < 24; ++i) {
    const azimuth = i * Math.PI / 12, c = Math.cos(elevation);
    const d = new THREE.Vector3(c * Math.cos(azimuth), c * Math.sin(azimuth), Math.sin(elevation));
    ray.set(orbit.target, d);
    let score = -1.5 * Math.max(0, -d.dot(way) - 0.1) - 0.4 * elevation - 2 * (ray.intersectObjects(obstacles).length > 0);
    for (const n of normals) score += Math.min(0.3, d.dot(n)) / normals.length;
    if (score > most) { most = score; best = [azimuth, elevation]; }
  }
  return best;
}

function frame(item) {
  scene.updateMatrixWorld(true);
  const box = new THREE.Box3();
  still.filter((_, i) => data.still[i].kind === "object").concat(moving).forEach(mesh => box.expandByObject(mesh));
  const sphere = box.getBoundingSphere(new THREE.Sphere());
  const object = new THREE.Box3().setFromObject(still[0]).getCenter(new THREE.Vector3());
  orbit.target.copy(sphere.center).lerp(object, 0.35);
  orbit.distance = 0.8 * sphere.radius / Math.sin(camera.fov * Math.PI / 360);
  if (grid) { grid.position.set(object.x, object.y, box.min.z - 0.002); }
  if (orbit.turned) return;
  const [azimuth, elevation] = sideThatShows(item);
  orbit.azimuth = azimuth;
  orbit.elevation = elevation;
}

function draw() {
  if (!renderer) return;
  const {azimuth, elevation, distance, target} = orbit;
  camera.position.set(Math.cos(azimuth) * Math.cos(elevation), Math.sin(azimuth) * Math.cos(elevation), Math.sin(elevation));
  camera.position.multiplyScalar(distance).add(target);
  camera.near = distance / 100;
  camera.far = distance * 20;
  camera.updateProjectionMatrix();
  camera.lookAt(target);
  renderer.render(scene, camera);
}
let waiting = false;
const redraw = () => {
  if (waiting) return;
  waiting = true;
  requestAnimationFrame(() => { waiting = false; draw(); });
};

function resize() {
  if (!renderer) return;
  renderer.setPixelRatio(Math.min(window.devicePixelRatio || 1, 2));
  renderer.setSize(view.clientWidth, view.clientHeight);
  camera.aspect = view.clientWidth / view.clientHeight;
  draw();
}

let shown = 0;
function pose() {
  const item = data.grasps[shown];
  if (!item) return;
  const before = document.getElementById("before").checked && item.before;
  moving.forEach((mesh, i) => place(mesh, (before || item.poses)[i]));
  touches.visible = document.getElementById("contacts").checked && !before;
  redraw();
}
function show(number) {
  shown = number;
  showContacts(data.grasps[number].points);
  pose();
  frame(data.grasps[number]);
}

// --- what the mouse does ---
let held = null;
view.addEventListener("pointerdown", e => { held = {x: e.clientX, y: e.clientY, pan: e.button === 2 || e.shiftKey}; view.setPointerCapture(e.pointerId); });
view.addEventListener("pointerup", () => { held = null; });
view.addEventListener("pointercancel", () => { held = null; });
view.addEventListener("contextmenu", e => e.preventDefault());
view.addEventListener("pointermove", e => {
  if (!held) return;
  const dx = e.clientX - held.x, dy = e.clientY - held.y;
  held.x = e.clientX;
  held.y = e.clientY;
  if (held.pan) {
    const scale = 2 * orbit.distance * Math.tan(camera.fov * Math.PI / 360) / view.clientHeight;
    orbit.target.addScaledVector(new THREE.Vector3().setFromMatrixColumn(camera.matrix, 0), -dx * scale);
    orbit.target.addScaledVector(new THREE.Vector3().setFromMatrixColumn(camera.matrix, 1), dy * scale);
  } else {
    orbit.azimuth -= 0.008 * dx;
    orbit.elevation = Math.max(-1.55, Math.min(1.55, orbit.elevation + 0.008 * dy));
    orbit.turned = true;
  }
  redraw();
});
view.addEventListener("wheel", e => { e.preventDefault(); orbit.distance *= Math.exp(0.001 * e.deltaY); redraw(); }, {passive: false});
document.getElementById("reset").addEventListener("click", () => { orbit.turned = false; if (data.grasps[shown]) frame(data.grasps[shown]); redraw(); });
document.getElementById("contacts").addEventListener("change", pose);
document.getElementById("before").addEventListener("change", () => { pose(); if (data.grasps[shown]) frame(data.grasps[shown]); });
document.getElementById("through").addEventListener("change", e => {
  const look = looks.object;
  look.opacity = e.target.checked ? 0.34 : 1;
  look.depthWrite = !e.target.checked;
  redraw();
});
if (data.grasps.length === 0) view.querySelector(".note").textContent = "No grasp was found; what the search did is told below.";
if (renderer && data.grasps.length > 0) {
  view.appendChild(renderer.domElement);
  window.addEventListener("resize", resize);
}
]==]
