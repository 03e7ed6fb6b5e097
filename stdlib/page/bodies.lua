--- The script of a page that shows bodies: their meshes, a list with a checkbox for each, friction cones, the floor, and a view that contains them. It follows the
--- script of the scene; the script of the page's content follows it, and sets `refresh`.
return [==[
looks.object = paint(0x4fa3b8, {transparent: true, opacity: 1});
const parts = data.parts.map(solid);
let refresh = redraw;  // called when a checkbox has changed

// friction cones: the apex at the contact, the axis along the normal into the body
const unitCone = new THREE.ConeBufferGeometry(1, 1, 40, 1, true), unitSphere = new THREE.SphereBufferGeometry(1, 16, 12);
function addCone(to, [x, y, z, nx, ny, nz, mu, radius]) {
  const normal = new THREE.Vector3(nx, ny, nz), at = new THREE.Vector3(x, y, z), height = 0.16 * radius;
  const slope = Math.min(mu, 3), h = height / Math.sqrt(1 + slope * slope);
  const cone = new THREE.Mesh(unitCone, looks.cone);
  cone.scale.set(Math.max(h * slope, 1e-9), h, Math.max(h * slope, 1e-9));
  cone.quaternion.setFromUnitVectors(new THREE.Vector3(0, -1, 0), normal);
  cone.position.copy(at).addScaledVector(normal, h / 2);
  const dot = new THREE.Mesh(unitSphere, looks.point);
  dot.scale.setScalar(0.022 * radius);
  dot.position.copy(at);
  to.add(cone, dot);
}

// the bodies, each with a checkbox that hides it
const hidden = new Set(), bodies = document.getElementById("bodies");
function addBox(to, part, i) {
  const label = document.createElement("label"), box = document.createElement("input");
  box.type = "checkbox";
  box.checked = true;
  box.addEventListener("change", () => { if (box.checked) hidden.delete(i); else hidden.add(i); refresh(); });
  label.append(box, " " + part.name);
  to.append(label);
}

// the floor, a scale of length, if there is none
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

// the view of a box, with the floor below it
function look(box) {
  const sphere = box.getBoundingSphere(new THREE.Sphere());
  orbit.target.copy(sphere.center);
  orbit.azimuth = -0.9;
  orbit.elevation = 0.45;
  orbit.distance = distanceTo(box);
  grid.position.set(sphere.center.x, sphere.center.y, box.min.z - 0.002);
}
// adds the visible parts that can move to a box
function addMoving(box) {
  scene.updateMatrixWorld(true);
  const moving = parts.filter((_, i) => data.parts[i].kind !== "obstacle");
  (moving.length > 0 ? moving : parts).forEach(mesh => { if (mesh.visible) box.expandByObject(mesh); });
}

function start() {
  if (!renderer) return;
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
]==]
