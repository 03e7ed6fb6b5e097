--- The script of a report page that shows a grasp; it follows the script of the scene.
return [==[
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

// the floor as a scale of length: squares of 5 cm below everything, if there is no obstacle
let grid = null;
if (data.still.length === 1 && data.still[0].kind === "object") {
  grid = new THREE.GridHelper(1, 20, 0x76828e, 0x9aa5b0);
  grid.rotation.x = Math.PI / 2;
  scene.add(grid);
  view.querySelector(".note").append(" \u00b7 squares: 5 cm");
}

// the side from which fingers hide the fewest contacts, and neither the hand's base nor an obstacle is in front
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

document.getElementById("reset").addEventListener("click", () => { orbit.turned = false; if (data.grasps[shown]) frame(data.grasps[shown]); redraw(); });
document.getElementById("contacts").addEventListener("change", pose);
document.getElementById("before").addEventListener("change", () => { pose(); if (data.grasps[shown]) frame(data.grasps[shown]); });
document.getElementById("through").addEventListener("change", e => {
  setObjectOpacity(e.target.checked, 1);
  redraw();
});
if (data.grasps.length === 0) view.querySelector(".note").textContent = "No grasp was found; see the report of the search below.";
if (renderer && data.grasps.length > 0) {
  view.appendChild(renderer.domElement);
  window.addEventListener("resize", resize);
}
]==]
